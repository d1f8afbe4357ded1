//! Conditional SMC and particle Gibbs with ancestor sampling: a Markov kernel on whole runs that leaves the posterior
//! as it is, for any number of particles above one (Andrieu, Doucet & Holenstein 2010, section 2.4.3; Lindsten, Jordan
//! & Schon 2014, algorithm 2).
//!
//! A sweep is SMC in which one particle holds the present run of the chain, its order choices and barriers included; at a
//! resampling the others are drawn by weight. Then one of the final set is drawn by weight, and is the next run of
//! the chain. With ancestor sampling the held run's past is drawn anew at each resampling. Prefix `i` with
//! weight `w_i` is followed by the rest `x'` of the held run with probability in proportion to
//!
//! ```text
//! w_i  p(x', order | prefix i)  s(prefix i, x')^T / s(prefix i)^(T_n)
//! ```
//!
//! A proposal for the choices has no part in it: the sweep leaves the law of the choices, `p s^T`, invariant, and the
//! rest is not drawn but held, so its density under the prior remains (Lindsten et al., eq. 15: the target of the whole
//! over that of the prefix). What the proposal drew of the prefix is in `w_i`. The held run's own weight counts
//! `log p - log q` of its choices like that of any other particle, although they were not drawn. It is computed anew as
//! the run is followed, so it is that of the prefix after its ancestor was drawn.
//!
//! The order of the held run is drawn anew before each sweep, by the order policy given its choices: a Gibbs step on the order
//! alone. Without it a past that is kept would keep its order, too. What a guide says of the held choices is computed as the
//! run is followed, so it is that of the new order. An order that is impossible at some barrier is not taken.
//!
//! What a forecast counted of the prefix ([`look_ahead`](niwaki_propose::look_ahead)) is in `w_i` and divided out above: the whole
//! run is followed to its end, where it has none. The held run has its forecasts as it is followed, like any other.
//!
//! The weight above is zero where the prefix leads to other addresses, to other barriers or to another family at an
//! address.
//!
//! Only independent draws have this simple conditional form, so resampling is multinomial whatever the setting is. With
//! [`Resampling::Tempered`](niwaki_run::resampling::Resampling::Tempered) it is multinomial by tempered weights, and all copies, the held run
//! too, carry the rest of their weights. This is exact. Let `r` be the probabilities of the draws, `q` the densities of
//! the choices and `g` the steps of the score. All particles of SMC together have the density `psi`. The weight at the end
//! of the path of particle `k` is `w_k`. The chain's target on all particles and `k` is their product:
//!
//! ```text
//! psi = product of q and r over all particles,   w_k = product over the path of p g / (q N r),   target = psi w_k
//! ```
//!
//! Along the path of `k` both `q` and `r` cancel, so the path follows the posterior; the other particles, given the path,
//! follow what is left of `psi`: SMC with that path held. There `r` may depend on all weights, the held one too. For
//! the same reason the ancestor of the held run is drawn by its whole weight `w_i`, carried parts
//! included, and not by `r_i`: up to a barrier, `psi` without `q` and `r` of the path of `i` is in proportion to
//! `psi w_i / (p g of that path)`.

use crate::many::Watch;
use crate::partial_run::{FollowSettings, PartialRun, Step, follow};
use crate::population::Population;
use crate::settings::Settings;
use crate::smc::{Progress, run, run_of};
use niwaki_math::streams::RngCore;
use niwaki_propose::particle::Particle;
use niwaki_propose::sweep::{Particles, sweep};
use niwaki_run::log::Entry;
use niwaki_run::order::Order;
use niwaki_run::record::Record;
use niwaki_run::run::Run;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::Normalised;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::Machine;

/// The result of a chain of whole runs.
#[derive(Default)]
pub struct Chain {
    /// The state after each sweep, from the first possible run on; weights are equal.
    pub states: Vec<Run>,
    /// The number of tried moves: ancestors drawn for the held run, or proposals.
    pub tries: usize,
    /// The number of moves that changed the state: different ancestors, or accepted proposals.
    pub moves: usize,
    /// The share of renewed choices of each sweep.
    pub renewed: Vec<f64>,
    /// Populations in which every particle became impossible; their estimate is zero, and counts.
    pub died: usize,
    /// Log of the mean of the populations' estimates of the evidence, nats; where they are independent of the chain,
    /// at power 1 and not stopped.
    pub log_evidence: Option<f64>,
    /// Whether `watch` stopped the chain before the last sweep.
    pub interrupted: bool,
}

/// The treatment of the past of the held run at a resampling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ancestors {
    /// Keep the past.
    Kept,
    /// Redraw the past.
    Sampled,
}

/// The seed of a sweep.
pub(super) fn sweep_seed(seed: u64, sweep: usize) -> u64 {
    Reserved::Sweep.stream(seed, sweep as u128, 0).next_u64()
}

/// The index of the particle of the final set that becomes the next state of the chain.
pub(super) fn draw_index(weights: &Normalised, seed: u64, sweep: usize) -> usize {
    weights.index(Reserved::Sweep.stream(seed, sweep as u128, 1).uniform())
}

/// Run `sweeps` sweeps of particle Gibbs. The chain starts from a run with the choices `from`, or from a run of SMC's final set.
/// `watch` is called after each barrier; when it returns false, the sweeps so far are returned.
///
/// # Errors
/// A fault of the program, or first populations that all died.
pub fn particle_gibbs(
    task: &Task,
    settings: &Settings,
    ancestors: Ancestors,
    sweeps: usize,
    from: Option<&[Entry]>,
    watch: &mut Watch<'_>,
) -> Result<Chain, Failure> {
    let mut chain = Chain::default();
    let mut orders = Reserved::Order.stream(settings.seed, 0, 0);
    let mut machine = task.machine();
    let with = FollowSettings { task, order: &settings.order, origins: false, weigh: &|_| Box::default() };
    let mut held = |entries: &[Entry]| {
        let mut draw = || orders.uniform();
        let choices: Vec<Entry> = entries.iter().filter(|entry| !entry.is_order()).cloned().collect();
        let ordered_anew = PartialRun::of(with, &mut machine, &choices, usize::MAX, &mut draw)?;
        match ordered_anew {
            Some(run) if is_possible(task, settings, &mut machine, &run)? => Ok(run),
            _ => PartialRun::of(with, &mut machine, entries, usize::MAX, &mut draw)?
                .ok_or_else(Failure::no_start),
        }
    };
    let mut now = match from {
        Some(entries) => held(entries)?,
        None => {
            let Some(first) = first_run(task, settings, sweeps, &mut chain, watch)? else {
                chain.interrupted = true;
                return Ok(chain);
            };
            held(&first.log.entries())?
        }
    };
    for sweep in 1..=sweeps {
        let sweep_settings = Settings { seed: sweep_seed(settings.seed, sweep), ..settings.clone() };
        let Some(state) = conditional(task, &sweep_settings, ancestors, &now, &mut chain, watch)? else {
            chain.interrupted = true;
            break;
        };
        let next = held(&state.log.entries())?;
        chain.renewed.push(next.renewed(&now));
        chain.states.push(state);
        now = next;
    }
    Ok(chain)
}

/// Whether a run is possible at each of its barriers, and not only at its end.
fn is_possible(
    task: &Task,
    settings: &Settings,
    machine: &mut Machine<'_>,
    run: &PartialRun,
) -> Result<bool, Failure> {
    let start = task.start(machine, settings.order == Order::DepthFirst)?;
    let mut particle = Particle::start(start, Record::start(&task.sketches), 0, settings.seed);
    let segments = run.segments();
    for (number, segment) in (1..).zip(&segments) {
        if follow(&mut particle, machine, task, segment, number == segments.len(), None, None)?.is_none() {
            return Ok(false);
        }
    }
    Ok(true)
}

/// A run of the first population that survives, of at most one more than there are sweeps. `None` when it was stopped.
fn first_run(
    task: &Task,
    settings: &Settings,
    sweeps: usize,
    chain: &mut Chain,
    watch: &mut Watch<'_>,
) -> Result<Option<Run>, Failure> {
    let mut seed = settings.seed;
    loop {
        match run(task, &Settings { seed, ..settings.clone() }, false, watch) {
            Ok(result) if result.interrupted => return Ok(None),
            Ok(mut result) => {
                let mut weights = Normalised::default();
                weights.read(result.particles.iter().map(|p| p.log_weight));
                return Ok(Some(result.particles.swap_remove(draw_index(&weights, seed, 0))));
            }
            Err(failure) if failure.is_impossible() && chain.died < sweeps => chain.died += 1,
            Err(failure) => return Err(failure),
        }
        seed = Reserved::Sweep.stream(settings.seed, chain.died as u128, 2).next_u64();
    }
}

/// Run a sweep: SMC with a held run, and a draw from its final set. `None` if `watch` stopped it.
fn conditional(
    task: &Task,
    settings: &Settings,
    ancestors: Ancestors,
    run: &PartialRun,
    chain: &mut Chain,
    watch: &mut Watch<'_>,
) -> Result<Option<Run>, Failure> {
    let population = Population::start(task, settings, false)?;
    let task = population.task.clone();
    let (machine, segments) = (task.machine(), run.segments());
    let mut conditional = Conditional { population, task: &task, machine, segments, ancestors, chain };
    if !sweep(&mut conditional, Some(0), &mut |_, now| watch(now))? {
        return Ok(None);
    }
    let mut population = conditional.population;
    population.finish();
    let index = draw_index(&population.estimate.weights, settings.seed, 0);
    Ok(Some(Run { log_weight: 0.0, ..run_of(population.settled().swap_remove(index)) }))
}

/// A population with a particle that follows the present run of a chain.
struct Conditional<'a> {
    population: Population<'a>,
    task: &'a Task,
    machine: Machine<'a>,
    /// The run, from barrier to barrier.
    segments: Vec<&'a [Step]>,
    ancestors: Ancestors,
    /// The number of drawn ancestors.
    chain: &'a mut Chain,
}

impl Particles for Conditional<'_> {
    type Seen = Progress;

    fn running(&mut self) -> usize {
        self.population.running()
    }

    fn advance(&mut self, held: Option<usize>) -> Result<(), Failure> {
        let Conditional { population, task, machine, segments, .. } = self;
        population.advance(held)?;
        if let (Some(held), Some(segment)) = (held, segments.get(population.barriers)) {
            let last = population.barriers + 1 == segments.len();
            let settings = population.settings;
            let (proposal, ahead) = (settings.proposal.as_deref(), settings.look_ahead.as_ref());
            let particle = &mut population.swarm.alone()[held];
            if follow(particle, machine, task, segment, last, proposal, ahead)?.is_none() {
                return Err(Failure::no_start());
            }
        }
        Ok(())
    }

    fn weigh(&mut self) -> Result<Progress, Failure> {
        self.population.weigh()
    }

    fn is_low(&self) -> bool {
        self.population.is_low()
    }

    fn resample(&mut self, held: Option<usize>) -> Result<Option<usize>, Failure> {
        let parent = match (held, self.ancestors) {
            (Some(held), Ancestors::Sampled) => {
                let parent = sample_ancestor(&mut self.population, &self.segments, held)?;
                self.chain.tries += 1;
                self.chain.moves += usize::from(parent != held);
                Some(parent)
            }
            _ => held,
        };
        self.population.resample(parent)
    }
}

/// Draw a new past for the held run; return the index of the particle that gives it.
fn sample_ancestor(
    population: &mut Population<'_>,
    segments: &[&[Step]],
    held: usize,
) -> Result<usize, Failure> {
    let rest = segments.get(population.barriers..).unwrap_or(&[]);
    let (task, settings, power) = (&population.task, population.settings, population.powers.now);
    let log_weight = |machine: &mut Machine<'_>, p: &mut Particle| -> Result<f64, Failure> {
        if p.log_weight == f64::NEG_INFINITY {
            return Ok(f64::NEG_INFINITY);
        }
        if rest.is_empty() || p.state.has_ended() {
            let both = rest.is_empty() && p.state.has_ended();
            // Nothing follows: only the declared power adds something.
            let change = (settings.power - power) * p.weighed.value();
            return Ok(if both { p.log_weight + change } else { f64::NEG_INFINITY });
        }
        let mut trial = p.fork();
        let mut log_order = 0.0;
        for (number, segment) in rest.iter().enumerate() {
            match follow(&mut trial, machine, task, segment, number + 1 == rest.len(), None, None)? {
                Some(log) => log_order += log,
                None => return Ok(f64::NEG_INFINITY),
            }
        }
        let log_prior = trial.record.log_prior.less(&p.record.log_prior).value();
        let score = trial.record.score();
        let log_scores = if (settings.power, power) == (1.0, 1.0) {
            score.less(&p.weighed).value()
        } else {
            settings.power * score.value() - power * p.weighed.value()
        };
        Ok(p.log_weight - power * p.foreseen + log_prior + log_order + log_scores)
    };
    let logs = population.swarm.in_batches(|particles| {
        let mut machine = task.machine();
        particles.iter_mut().map(|p| log_weight(&mut machine, p)).collect::<Result<Vec<f64>, _>>()
    })?;
    let mut weights = Normalised::default();
    if !weights.read(logs.iter().flatten().copied()) {
        return Ok(held);
    }
    let mut random = Reserved::Ancestor.stream(settings.seed, population.barriers as u128, 0);
    Ok(weights.index(random.uniform()))
}
