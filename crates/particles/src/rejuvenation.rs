//! Rejuvenation: Markov moves that leave the particles' law at this barrier invariant and make copies different
//! again (Gilks & Berzuini 2001).
//!
//! The law at barrier n is `F_n(x, order) = p_n(x) q(order | x) s(x)^T`, over runs that are paused at their n-th
//! barrier and runs that ended before it. A particle that still runs keeps its skeleton (`partial_run`); what a changed
//! value reaches is done again up to where each activation is suspended, and stops there. One that has ended may change its
//! structure, but not become longer: a longer run is, at this barrier, a run that is paused, and has its weight there.
//! Moves see the score so far and no later one.
//!
//! The moves of a particle must not depend on the other particles. A kernel that is the same for every population
//! leaves each expectation as it is. A kernel that is left out because all others have ended does not.
//! So a particle that has ended is moved at the barrier at which that is seen, among runs with as many barriers as it
//! has, and not again until the end, when all are moved once without bound. For the same reason the evidence is unbiased
//! for moves at fixed barriers, and consistent for moves after a resampling that is itself decided by the weights.

use crate::final_chains::FinalChains;
use crate::moves::{move_ended, move_running};
use crate::population::{BATCH, Population};
use crate::settings::{Settings, Weights};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::plan::Plan;
use niwaki_chain::walk::counts::Count;
use niwaki_propose::particle::Particle;
use niwaki_run::fresh::Fresh;
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::HashMap;

/// Forward runs from which the spreads of the sites' distributions are read.
const FIRST_RUNS: u64 = 4;

/// When to move: a number of barriers, or a word.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Moment {
    /// After each resampling, and once when all have ended.
    Resampled,
    /// Once, when all have ended.
    End,
    /// At every so-many-th barrier, and once when all have ended.
    #[serde(untagged)]
    Every(usize),
}

/// How particles are moved.
#[derive(Clone, Debug)]
pub struct Rejuvenation {
    /// How to propose.
    pub kernel: Kernel,
    /// Proposals for each particle, each time.
    pub moves: u64,
    /// When.
    pub at: Moment,
    /// The chains that replace the final set; where there are none, every particle of the set is moved.
    pub final_chains: Option<FinalChains>,
}

impl Rejuvenation {
    /// Refuses settings that make no sense.
    pub(super) fn check(&self, weights: Weights) -> Result<(), Fault> {
        if weights == Weights::Absolute {
            return Err(Fault::new(
                "bad-setting",
                "absolute weights have no target distribution, which a move needs",
            )
            .with_help("use ratio weights"));
        }
        let none = self.final_chains.is_some_and(|wanted| wanted.chains == 0 || wanted.draws == 0);
        if self.moves == 0 || self.at == Moment::Every(0) || none {
            return Err(Fault::new("bad-setting", "a number of moves, barriers, chains or draws is 0")
                .with_help("use at least one"));
        }
        if self.kernel.any(&|part| matches!(part, Kernel::Anneal { .. })) {
            let what = "an annealing kernel changes the distribution of the particles";
            return Err(Fault::new("bad-kernel", what)
                .with_help("anneal the particles, and move them by the kernel inside `anneal`"));
        }
        let follows = |part: &Kernel| matches!(part, Kernel::Leaf(own) if own.trajectory().is_some());
        if self.at != Moment::End && self.kernel.any(&follows) {
            let what = "a particle that still runs has no gradient to follow";
            return Err(Fault::new("bad-kernel", what)
                .with_help("move the particles at the end, or without `hmc_step()` and `nuts_step()`"));
        }
        Ok(())
    }
}

/// Counts of moves: of particles that still ran, and of those that had ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MoveCounts {
    /// Of particles that still ran.
    pub running: Count,
    /// Of particles that had ended.
    pub ended: Count,
}

impl std::ops::AddAssign for MoveCounts {
    fn add_assign(&mut self, other: MoveCounts) {
        self.running += other.running;
        self.ended += other.ended;
    }
}

/// A kernel ready to move particles.
#[derive(Clone, Debug)]
pub(super) struct Mover {
    pub plan: Plan,
    /// Spread of each site's distribution, by the site's key: it must not depend on the state of a particle.
    pub spreads: HashMap<u128, f64>,
    /// Numbers of the sites, by key.
    pub numbers: HashMap<u128, usize>,
    /// Places in the plan of the leaves that do not take all choices alike.
    pub choosy: Vec<usize>,
    /// Rounds so far.
    rounds: u64,
}

/// One round of moves, the same for every particle.
pub(super) struct Round<'a> {
    pub task: &'a Task,
    pub settings: &'a Settings,
    pub mover: &'a Mover,
    /// Which leaf proposes, move by move.
    pub schedule: Vec<usize>,
    /// The power of the score in the law that the particles follow.
    pub power: f64,
    /// Barriers so far.
    pub barriers: usize,
    /// How many barriers a run has that ended just now; `None` at the end, where any number is allowed.
    pub ending: Option<usize>,
    /// No other round has this number.
    pub number: u64,
}

/// The spreads of the sites' distributions in a few runs from the prior, by the sites' keys.
///
/// # Errors
/// A fault of the program.
pub fn spreads(task: &Task, seed: u64) -> Result<HashMap<u128, f64>, Failure> {
    let mut spreads = HashMap::new();
    for run in 0..FIRST_RUNS {
        let key = Reserved::Spread.key(seed, run);
        let mut answers = Fresh { spreads: Some(&mut spreads), ..Fresh::plain(key, &*task.hosts) };
        let mut machine = task.machine();
        // Of an invalid run, the sites up to its fault.
        if let Err(met) = task.begin(&mut machine, &mut answers)
            && !met.is_invalid()
        {
            return Err(met.into());
        }
    }
    Ok(spreads)
}

impl Mover {
    pub fn of(task: &Task, settings: &Settings) -> Result<Option<Mover>, Failure> {
        let Some(rejuvenation) = &settings.rejuvenate else { return Ok(None) };
        let sites = task.program.functions.iter().flat_map(|f| &f.sites);
        let numbers: HashMap<u128, usize> = sites.enumerate().map(|(n, site)| (site.key, n)).collect();
        let mut plan = Plan::new(&rejuvenation.kernel)?;
        plan.leaves.iter_mut().try_for_each(|leaf| leaf.prepare(task))?;
        let choosy = (0..plan.leaves.len()).filter(|n| !plan.leaves[*n].selection.is_all()).collect();
        let spreads = spreads(task, settings.seed)?;
        Ok(Some(Mover { plan, spreads, numbers, choosy, rounds: 0 }))
    }

    /// The selection weights of a choice, for each leaf that does not take all alike.
    pub fn weights(&self, at: &At<'_, f64>) -> Box<[u64]> {
        let depth = || at.path().split('/').filter(|part| !part.contains('[')).count() - 1;
        let selections = self.choosy.iter().map(|n| &self.plan.leaves[*n].selection);
        selections.map(|selection| selection.weigh(|| at.path(), depth)).collect()
    }

    /// The spread at a site.
    pub fn spread(&self, site: u128) -> f64 {
        self.spreads.get(&site).copied().unwrap_or(1.0)
    }
}

impl Population<'_> {
    /// Moves the particles where they are due. `resampled` says whether they were just resampled; `None` means that all
    /// have ended and are weighed by the declared power.
    pub fn move_particles(&mut self, resampled: Option<bool>) -> Result<(), Failure> {
        let Some(rejuvenation) = &self.settings.rejuvenate else { return Ok(()) };
        let due = match (rejuvenation.at, resampled) {
            (_, None) => true,
            (Moment::Every(n), Some(_)) => self.barriers.is_multiple_of(n),
            (Moment::Resampled, Some(resampled)) => resampled,
            _ => false,
        };
        if !due {
            return Ok(());
        }
        self.settle();
        let Some(mover) = &mut self.mover else { return Ok(()) };
        let before = mover.clone();
        let number = mover.rounds;
        mover.rounds += 1;
        let mut rng = Reserved::MoveSchedule.stream(self.settings.seed, u128::from(number), 0);
        let schedule = (0..rejuvenation.moves).map(|_| mover.plan.next(&mut rng).0).collect();
        let ending = resampled.map(|_| self.barriers - 1);
        let round = Round {
            task: &self.task,
            settings: self.settings,
            mover: &before,
            schedule,
            power: self.power,
            barriers: self.barriers,
            ending,
            number,
        };
        let batch = |particles: &mut [Particle]| {
            let (mut machine, mut moved) = (round.task.machine(), MoveCounts::default());
            let mut leaves = round.mover.plan.leaves.clone();
            for p in particles.iter_mut().filter(|p| !p.weighed.is_impossible()) {
                if p.state.has_ended() {
                    moved.ended += move_ended(p, &round)?;
                } else {
                    moved.running += move_running(p, &mut machine, &round, &mut leaves)?;
                }
            }
            Ok(moved)
        };
        let all: Vec<Result<MoveCounts, Failure>> = if self.parallel {
            self.particles.par_chunks_mut(BATCH).map(batch).collect()
        } else {
            vec![batch(&mut self.particles)]
        };
        for moved in all {
            self.moved += moved?;
        }
        Ok(())
    }
}
