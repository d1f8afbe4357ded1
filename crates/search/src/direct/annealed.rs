//! Annealed importance sampling (Neal 2001, "Annealed importance sampling"). Particles go from the prior to the posterior on a
//! ladder of laws; at each rung a chain moves them.
//!
//! ```text
//! f_k(x) = prior(x) exp(b_k s(x))           0 = b_0 < b_1 < ... < b_n = 1; s: the log score
//! x_0 ~ prior,  x_k ~ T_k(. | x_(k-1))      T_k leaves f_k invariant
//! log w = sum over k of (b_k - b_(k-1)) s(x_(k-1))
//! ```
//!
//! The weight of rung `k` is computed at the state *before* the moves of this rung. Then the mean of `w` is unbiased for the
//! evidence, and weighted particles follow the posterior, for any number of moves and any mixing: the weights correct the
//! errors of the moves.
//!
//! This code differs from the paper: a prior may have impossible runs, on which a chain cannot stand. So `f_0` is the prior of the
//! possible runs, drawn by repeated tries, and its constant is the probability that a run is possible. If `n` possible runs took
//! `N` tries, `(n - 1) / (N - 1)` is an unbiased estimate of this probability (Haldane 1945, inverse sampling). It is independent
//! of the runs themselves, so its product with the mean of `w` is unbiased too. The estimate needs two particles.
//!
//! No move depends on the history of a particle: kernels do not adapt, and scales of proposals come from separate forward
//! runs. Particles are independent, so they are equal on any number of threads.

use niwaki_chain::Chain;
use niwaki_chain::kernel::Kernel;
use niwaki_chain::plan::Plan;
use niwaki_chain::walk::counts::Count;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_particles::rejuvenation::spreads;
use niwaki_run::run::Run;
use niwaki_run::weights::{Normalised, log_step};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// The powers of a ladder are evenly spaced numbers to this power (Friel & Pettitt 2008, section 3), since the law changes fastest
/// near the prior.
const BEND: i32 = 4;

/// The powers of the score: a number of rungs, or a list of powers.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Powers {
    /// A number of rungs.
    Rungs(usize),
    /// A list of powers.
    List(Vec<f64>),
}

impl Powers {
    /// The powers after 0, in order, the last 1.
    pub fn ladder(&self) -> Vec<f64> {
        match self {
            Powers::Rungs(n) => (1..=*n).map(|k| (k as f64 / *n as f64).powi(BEND)).collect(),
            Powers::List(powers) => powers.clone(),
        }
    }

    /// Whether the powers rise from above 0 to 1.
    pub(crate) fn rise(&self) -> bool {
        let powers = self.ladder();
        powers.is_sorted_by(|low, high| low < high)
            && powers.first() > Some(&0.0)
            && powers.last() == Some(&1.0)
    }
}

/// The settings.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The number of particles, at least two.
    pub particles: usize,
    /// The powers after 0.
    pub powers: Vec<f64>,
    /// The kernel that moves particles.
    pub kernel: Kernel,
    /// Proposals for each particle at each rung.
    pub moves: u64,
    /// Most forward runs for the first state of a particle.
    pub tries: u64,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// The result of annealed importance sampling.
pub struct Annealed {
    /// The particles at the end of the ladder, with their weights, whose mean is the evidence.
    pub runs: Vec<Run>,
    /// Log of the evidence, nats; `None` if the search was stopped.
    pub log_evidence: Option<f64>,
    /// The effective sample size of the weights.
    pub effective: f64,
    /// The powers after 0.
    pub powers: Vec<f64>,
    /// Number of forward runs for the first states.
    pub tries: u64,
    /// Proposals, and accepted proposals.
    pub moved: Count,
    /// Whether the search was stopped.
    pub interrupted: bool,
}

/// A particle at the top of the ladder.
struct Arrival {
    run: Run,
    tries: u64,
    moved: Count,
}

/// Moves particles from the prior to the posterior.
///
/// `watch` is called after each rung of each particle: with the log score after the last rung, with minus infinity before. When
/// it returns false, unfinished particles are dropped.
///
/// # Errors
/// No possible first state, a fault of the program, or a stop before the first particle is finished.
pub fn annealed(
    task: &Task,
    settings: &Settings,
    watch: &(dyn Fn(f64) -> bool + Sync),
) -> Result<Annealed, Failure> {
    let climb = Climb {
        task,
        settings,
        spreads: spreads(task, settings.seed)?,
        stopped: AtomicBool::new(false),
        watch,
    };
    let all: Vec<Option<Arrival>> = (0..settings.particles as u64)
        .into_par_iter()
        .map(|number| climb.particle(number))
        .collect::<Result<_, Failure>>()?;
    let interrupted = all.iter().any(Option::is_none);
    let (mut runs, mut tries, mut moved) = (Vec::with_capacity(all.len()), 0, Count::default());
    for arrival in all.into_iter().flatten() {
        tries += arrival.tries;
        moved += arrival.moved;
        runs.push(arrival.run);
    }
    if runs.is_empty() {
        return Err(Fault::new(
            "out-of-time",
            "the search was stopped before the first particle was finished",
        )
        .into());
    }
    let log_possible = log_possible(runs.len() as u64, tries);
    runs.iter_mut().for_each(|run| run.log_weight += log_possible);
    let mut weights = Normalised::default();
    weights.read(runs.iter().map(|run| run.log_weight));
    let log_evidence = (!interrupted).then_some(weights.log_mean);
    let (effective, powers) = (weights.effective, settings.powers.clone());
    Ok(Annealed { runs, log_evidence, effective, powers, tries, moved, interrupted })
}

/// Log of an unbiased estimate of the probability that a run is possible, from the tries that some runs took. For a
/// single run it is the share of its tries, which only a stopped search uses.
fn log_possible(runs: u64, tries: u64) -> f64 {
    let less = u64::from(runs > 1);
    ((runs - less) as f64 / (tries - less) as f64).ln()
}

/// The inputs that all particles share.
struct Climb<'a> {
    task: &'a Task,
    settings: &'a Settings,
    spreads: HashMap<u128, f64>,
    stopped: AtomicBool,
    watch: &'a (dyn Fn(f64) -> bool + Sync),
}

impl Climb<'_> {
    /// Moves a particle from a run of the prior to the end of the ladder; `None` if the search was stopped before.
    fn particle(&self, number: u64) -> Result<Option<Arrival>, Failure> {
        if self.stopped.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let Climb { task, settings, .. } = self;
        let chain_settings = niwaki_chain::Settings {
            seed: settings.seed,
            kernel: settings.kernel.clone(),
            thin: 0,
            tries: settings.tries,
            ..niwaki_chain::Settings::default()
        };
        let plan = Plan::new(&chain_settings.kernel)?;
        let (state, _, tries) =
            State::tried(task, Streams::new(chain_settings.seed, number), chain_settings.tries, None)?;
        if number == 0 {
            plan.check(&state, task)?;
        }
        let mut chain: Chain = Chain::at(task, &chain_settings, number, plan, state, &self.spreads)?;
        let (mut power, mut log_weight) = (0.0, 0.0);
        for &next in &settings.powers {
            let score = chain.state.score();
            log_weight += log_step(next, &score, power, &score);
            chain.restrict(next, None);
            if !chain.state.trace.is_empty() {
                chain.advance(task, settings.moves, &mut |_, _| true)?;
            }
            power = next;
            self.look(f64::NEG_INFINITY);
            if self.stopped.load(Ordering::Relaxed) {
                return Ok(None);
            }
        }
        let run = Run { log_weight, ..chain.now(&task.program) };
        self.look(run.log_score);
        Ok(Some(Arrival { run, tries, moved: chain.counts.all() }))
    }

    fn look(&self, score: f64) {
        if !(self.watch)(score) {
            self.stopped.store(true, Ordering::Relaxed);
        }
    }
}
