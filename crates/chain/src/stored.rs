//! Chains as data, at a border between two proposals. A restored chain resumes with the same bits.
//!
//! The data of the run are the values of its choices, in the order of their numbers. Restoring runs the program with these values:
//! scores and sketches are exact, so they are equal to the bit, which is checked. The data also have the results of the proposals
//! so far: step sizes, scales, the place in the kernel, counts, the best state, the samples.

use crate::ladder::Ladder;
use crate::plan;
use crate::plan::Plan;
use crate::walk::best::Best;
use crate::walk::counts::Count;
use crate::walk::state::State;
use crate::{Chain, Settings};
use niwaki_math::bits;
use niwaki_run::checkpoint::unfit;
use niwaki_run::log::Log;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::invalid::Counts;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::Arc;

/// A state as data.
#[derive(Serialize, Deserialize)]
pub struct StoredState {
    /// The choices, in the order of their numbers.
    choices: Log,
    #[serde(with = "bits")]
    log_prior: f64,
    #[serde(with = "bits")]
    log_score: f64,
    moved: u64,
}

impl StoredState {
    /// Store a state without an open transaction.
    pub fn of(state: &State, program: &Program) -> StoredState {
        StoredState {
            choices: state.choices(program).collect(),
            log_prior: state.trace.totals().log_prior.value(),
            log_score: state.log_score(),
            moved: state.moved,
        }
    }

    /// Restore the state.
    ///
    /// # Errors
    /// A fault of the program; choices that do not belong to a run, or whose scores have changed.
    pub fn state(&self, task: &Task) -> Result<State, Failure> {
        let choices: Vec<_> =
            self.choices.entries().into_iter().map(|entry| (entry.address(), entry.value)).collect();
        let mut state = State::of_choices(task, &choices)?;
        let scores = (state.trace.totals().log_prior.value(), state.log_score());
        if (scores.0.to_bits(), scores.1.to_bits()) != (self.log_prior.to_bits(), self.log_score.to_bits()) {
            return Err(unfit(
                "its choices score differently here: a function of Python answers differently",
            ));
        }
        state.moved = self.moved;
        Ok(state)
    }
}

/// A chain as data; `S` are its samples.
#[derive(Serialize, Deserialize)]
struct StoredChain<S> {
    state: StoredState,
    best: Run,
    samples: S,
    thin: u64,
    spreads: Vec<u64>,
    visit: u64,
    grown: u64,
    sites: Vec<Count>,
    many: Count,
    plan: plan::Stored,
}

/// A ladder of chains as data, with its goal of proposals.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredLadder<S> {
    rungs: Vec<StoredChain<S>>,
    exchanges: Vec<(u64, u64)>,
    end: u64,
    invalid: Counts,
}

impl Chain {
    fn stored(&self, program: &Program) -> StoredChain<Vec<&Run>> {
        StoredChain {
            state: StoredState::of(&self.state, program),
            best: self.best.stored(&self.state, program),
            samples: self.samples.all.iter().map(Arc::as_ref).collect(),
            thin: self.samples.thin,
            spreads: self.spreads.iter().map(|spread| spread.to_bits()).collect(),
            visit: self.visit,
            grown: self.grown,
            sites: self.counts.sites.clone(),
            many: self.counts.many,
            plan: self.plan.stored(),
        }
    }

    /// Restore the `number`-th chain of a seed.
    fn restored(
        task: &Task,
        settings: &Settings,
        number: u64,
        stored: StoredChain<Vec<Run>>,
    ) -> Result<Chain, Failure> {
        let state = stored.state.state(task)?;
        let plan = Plan::new(&settings.kernel)?;
        let mut chain = Chain::at(task, settings, number, plan, state, &HashMap::new())?;
        let fits = chain.plan.restore(stored.plan)
            && chain.counts.sites.len() == stored.sites.len()
            && chain.spreads.len() == stored.spreads.len();
        if !fits {
            return Err(unfit("it is of chains by another kernel"));
        }
        chain.spreads = stored.spreads.into_iter().map(f64::from_bits).collect();
        (chain.counts.sites, chain.counts.many) = (stored.sites, stored.many);
        chain.best = Best::restored(stored.best);
        chain.samples.restore(stored.samples, stored.thin);
        (chain.visit, chain.grown) = (stored.visit, stored.grown);
        Ok(chain)
    }
}

impl Ladder {
    /// Store the ladder. `invalid` are the invalid runs counted so far.
    pub(super) fn stored(&self, program: &Program, invalid: Counts) -> StoredLadder<Vec<&Run>> {
        let rungs = self.rungs.iter().map(|rung| rung.stored(program)).collect();
        StoredLadder { rungs, exchanges: self.exchanges.clone(), end: self.end, invalid }
    }

    /// Restore the `number`-th ladder of a seed.
    ///
    /// # Errors
    /// The errors of [`StoredState::state`]; data of another kernel.
    pub(super) fn restored(
        task: &Task,
        settings: &Settings,
        number: u64,
        stored: StoredLadder<Vec<Run>>,
    ) -> Result<Ladder, Failure> {
        let StoredLadder { rungs, exchanges, end, invalid } = stored;
        let mut ladder = Ladder::without_rungs(settings, number);
        if rungs.len() != settings.powers.len() || exchanges.len() != ladder.exchanges.len() {
            return Err(unfit("it is of chains at other powers"));
        }
        for (rung, stored) in rungs.into_iter().enumerate() {
            ladder.add(rung, settings, |rung_settings, number| {
                Chain::restored(task, rung_settings, number, stored)
            })?;
        }
        (ladder.exchanges, ladder.end, ladder.invalid) = (exchanges, end, invalid);
        Ok(ladder)
    }
}
