//! SMC of a single population, and its result.

use crate::population::Population;
use crate::rejuvenation::MoveCounts;
use crate::settings::{Settings, Weights};
use niwaki_propose::particle::Particle;
use niwaki_propose::sweep::sweep;
use niwaki_run::losses::Losses;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::value::Value;

/// The result of SMC.
#[derive(Default)]
pub struct Result {
    /// The final set, with equal weights after a last resampling.
    pub particles: Vec<Run>,
    /// Estimate of the log of the final law's normalising constant, the scores raised to the declared power,
    /// nats. `None` for absolute weights, which have none, and where the search was stopped.
    pub log_normaliser: Option<f64>,
    /// The log of the model's evidence: `log_normaliser` at power 1, else `None`. The evidence (not its log) is unbiased, unless the
    /// powers were adapted, or particles moved after resamplings that the weights decided: then
    /// consistent.
    pub log_evidence: Option<f64>,
    /// The number of barriers; for several populations, the largest number.
    pub barriers: usize,
    /// The number of particle steps: runs of a particle to a barrier.
    pub steps: u64,
    /// The number of barriers with resampling.
    pub resampled: usize,
    /// The number of ancestors of the final set at the first barrier.
    pub ancestors: usize,
    /// Whether `watch` stopped the search before all particles had ended.
    pub interrupted: bool,
    /// The sizes of the populations, in order. With the seed, they reproduce the search.
    pub plan: Vec<usize>,
    /// Populations in which every particle became impossible; their evidence is zero, and counts.
    pub died: usize,
    /// The power at each barrier where it is not constant; of several populations, those of the first that
    /// lived.
    pub powers: Vec<f64>,
    /// Counts of rejuvenation moves.
    pub moved: MoveCounts,
    /// Losses: particles that became impossible at barriers where other particles survived.
    pub losses: Losses,
}

/// The progress of a run, for `watch`.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// The number of barriers so far.
    pub barriers: usize,
    /// The number of ended particles.
    pub ended: usize,
    /// The best log score of a possible particle.
    pub best: f64,
}

/// Run a population of particles. `watch` is called after each barrier; when it returns false, the search stops and returns
/// the result so far.
///
/// # Errors
/// Invalid settings; a fault of the program; a population in which every particle is impossible.
pub fn smc(
    task: &Task,
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> std::result::Result<Result, Failure> {
    run(task, settings, false, watch)
}

/// Like [`smc`]; `serial` runs on a single thread.
pub(super) fn run(
    task: &Task,
    settings: &Settings,
    serial: bool,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> std::result::Result<Result, Failure> {
    let mut population = Population::start(task, settings, serial)?;
    let interrupted = !grow(&mut population, &mut |_, now| watch(now))?;
    let chains = if interrupted { None } else { population.final_chains(watch)? };
    let stopped = chains.as_ref().is_some_and(|(_, stopped)| *stopped);
    if chains.is_none() {
        population.move_particles(None)?;
    }
    let log_normaliser =
        (settings.weights == Weights::Ratio && !interrupted).then_some(population.estimate.log_normaliser);
    Ok(Result {
        log_normaliser,
        log_evidence: log_normaliser.filter(|_| settings.power == 1.0),
        barriers: population.barriers,
        steps: population.counts.steps,
        resampled: population.counts.resampled,
        ancestors: population.ancestry.ancestors(),
        interrupted: interrupted || stopped,
        plan: vec![settings.particles],
        died: 0,
        moved: population.moves.counts,
        losses: population.losses,
        powers: population.powers.each,
        particles: match chains {
            Some((states, _)) => states,
            None => population.swarm.particles.into_iter().map(run_of).collect(),
        },
    })
}

/// Grows the particles of a population until all have ended, and weighs them. `watch` sees it at each barrier before it is
/// resampled; when it returns false, the population is left as it is, and so is the return value.
pub(super) fn grow(
    population: &mut Population<'_>,
    watch: &mut dyn FnMut(&mut Population<'_>, Progress) -> bool,
) -> std::result::Result<bool, Failure> {
    let whole = sweep(population, None, watch)?;
    population.finish();
    Ok(whole)
}

/// The run of a particle.
pub(super) fn run_of(p: Particle) -> Run {
    let has_ended = p.state.has_ended();
    let value = if has_ended { p.state.result() } else { Value::None };
    Run::of(p.record, value, p.log_weight, has_ended)
}
