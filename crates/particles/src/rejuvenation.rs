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
//! So a particle that has ended is moved at the first barrier after its end, among runs with as many barriers as it
//! has. It is not moved again until the end of the search, when all particles are moved once without bound.
//! For the same reason the evidence is unbiased
//! for moves at fixed barriers, and consistent for moves after a resampling that is itself decided by the weights.

use crate::moves::{move_ended, move_running};
use crate::population::Population;
use crate::settings::{Moment, Settings};
use niwaki_chain::plan::Plan;
use niwaki_chain::walk::counts::Count;
use niwaki_propose::particle::Particle;
use niwaki_run::fresh::Fresh;
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::answers::At;
use std::collections::HashMap;

/// Forward runs from which the spreads of the sites' distributions are read.
const FIRST_RUNS: u64 = 4;

/// Counts of moves: of particles that still ran, and of those that had ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MoveCounts {
    /// Moves of running particles.
    pub running: Count,
    /// Moves of ended particles.
    pub ended: Count,
}

impl std::ops::AddAssign for MoveCounts {
    fn add_assign(&mut self, other: MoveCounts) {
        self.running += other.running;
        self.ended += other.ended;
    }
}

/// How the particles of a population are moved, and what came of it.
pub(super) struct Moves {
    /// The kernel, where there is one.
    pub mover: Option<Mover>,
    /// Moves so far.
    pub counts: MoveCounts,
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
    /// The leaf that proposes, move by move.
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
        self.settled();
        let Some(mover) = &mut self.moves.mover else { return Ok(()) };
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
            power: self.powers.now,
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
        self.swarm.in_batches(batch)?.into_iter().for_each(|moved| self.moves.counts += moved);
        Ok(())
    }
}
