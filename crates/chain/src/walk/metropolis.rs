//! Metropolis-Hastings with one choice (dissertation 3.2).
//!
//! 1. *Pick* a choice of the present run: evenly, or by selection weights; `W` is their sum.
//! 2. *Propose* a new value `x' ~ q(. | x)` for it ([`proposal`](crate::walk::proposal)).
//! 3. *Rerun* from that choice. All code that reads the value runs again; new choices are drawn from their priors.
//! 4. *Accept* with probability `min(1, a)`, where `p` is the density of all choices and `s` the score:
//!
//! ```text
//! log a =   log p' - log p + beta (log s' - log s)
//!         + stale - fresh                        removed choices, new choices: their log densities
//!         + log q(x | x') - log q(x' | x)        backward - forward
//!         + log 1 / W' - log 1 / W               selection: the picked choice weighs the same before and after
//! ```
//!
//! 5. *Keep* the proposed run, or *undo* it, on the trace and on the sketches together.
//!
//! Kernels that change many choices differ in the first two steps and in the selection, and share all further steps (`decide`).

use super::Walk;
use crate::walk::accept::{Decision, Terms, accepts, selected};
use crate::walk::proposal::{Move, MoveProposal};
use crate::walk::streams::below;
use niwaki_math::{RngCore, Stream};
use niwaki_run::fresh::Fresh;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::{Change, Changed};
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;

/// The number of proposals after which memory that is prefetched is read.
const PREFETCH: u64 = 4;

impl Walk {
    /// Make a proposal for a choice. The choice is picked uniformly, or by the weights of a table.
    #[inline(always)]
    pub(crate) fn single<M: Move>(
        &mut self,
        task: &Task,
        machine: &mut Machine<'_>,
        proposer: &mut M,
        table: Option<usize>,
        beta: f64,
    ) -> Result<(), Failure> {
        let visit = self.visit;
        self.visit += 1;
        let Some((choice, total, mut rng)) = self.pick(&task.program, visit, table) else { return Ok(()) };
        let site = self.counts.number(self.state.trace.site_of(choice));
        proposer.look(&self.state, &task.program, choice);
        let noting = self.best.is_noting();
        let mut proposal =
            MoveProposal { proposer, site, moves: self.streams.moves(visit), noting, old: None };
        let mut answers = Fresh::plain(self.streams.fresh(visit), &*task.hosts);
        let (trace, strategy) = (&mut self.state.trace, self.strategy);
        let change = match machine.propose(trace, choice, strategy, &mut proposal, &mut answers) {
            Ok(change) => change,
            Err(met) => self.give_up(task, met)?,
        };
        let (old, outside) = (proposal.old.take(), self.state.trace.left_support());
        if change == Change::Done
            && let Some(backward) = proposer.look_back(&self.state, &task.program, choice)
        {
            self.state.trace.set_backward(backward);
        }
        let selection = |chain: &Self| {
            let trace = &chain.state.trace;
            let after =
                table.map_or(trace.len_after() as u64, |t| chain.tables[t].total_after(trace, &task.program));
            selected(total, after)
        };
        let decision = self.decide(task, change, beta, &mut rng, selection, old)?;
        let count = &mut self.counts.sites[site];
        count.proposed += 1;
        count.accepted += u64::from(decision.accepted);
        count.outside += u64::from(outside);
        if self.warming(visit).is_some() && !decision.is_same {
            proposer.learn(site, decision);
        }
        Ok(())
    }

    /// Pick the choice that a proposal changes; with the sum of all weights and the random numbers that follow. `None` if no choice
    /// can be picked.
    #[inline(always)]
    fn pick(&self, program: &Program, visit: u64, table: Option<usize>) -> Option<(usize, u64, Stream)> {
        let trace = &self.state.trace;
        let total = table.map_or(trace.len() as u64, |t| self.tables[t].total());
        if total == 0 {
            return None;
        }
        let first = |visit| {
            let mut rng = self.streams.decisions(visit);
            (below(&mut rng, total), rng)
        };
        let (at, rng) = first(visit);
        let Some(t) = table else {
            trace.prefetch(program, first(visit + PREFETCH).0 as usize);
            return Some((at as usize, total, rng));
        };
        Some((self.tables[t].find(at), total, rng))
    }

    /// Accept or reject the open transaction. `selection` is the log probability of choosing the move after the proposal, less the
    /// log probability before. `moved` are the choices that the proposal itself changed, with their previous values. The next number
    /// of `rng` is the acceptance draw.
    #[inline(always)]
    pub(crate) fn decide(
        &mut self,
        task: &Task,
        change: Change,
        beta: f64,
        rng: &mut impl RngCore,
        selection: impl FnOnce(&Self) -> f64,
        moved: impl IntoIterator<Item = (u128, Value)>,
    ) -> Result<Decision, Failure> {
        let program = &*task.program;
        match change {
            Change::Unchanged => {
                self.state.trace.commit(program);
                self.last = Decision { is_same: true, accepted: true, log_ratio: 0.0 };
                return Ok(self.last);
            }
            Change::Impossible => {
                self.state.trace.rollback(program);
                self.last = Decision { is_same: false, accepted: false, log_ratio: f64::NEG_INFINITY };
                return Ok(self.last);
            }
            Change::Done => {}
        }
        self.show(program)?;
        let trace = &self.state.trace;
        let (totals, changed) = (trace.totals(), trace.change());
        let (fresh, stale) = trace.fresh_and_stale();
        let (forward, backward) = trace.forward_and_backward();
        let with_sketches = self.state.sketch_change().map(|change| changed.log_factors.plus(&change));
        let terms = Terms {
            prior: &changed.log_prior,
            score: with_sketches.as_ref().unwrap_or(&changed.log_factors),
            beta,
            stale,
            fresh,
            backward,
            forward,
            selection: selection(self),
        };
        let log_ratio = terms.log_ratio();
        let barriers = || self.state.primitives as i64 + totals.factors + changed.factors;
        let fits = self.barriers.is_none_or(|n| barriers() == n as i64);
        let accepted = accepts(log_ratio, rng) && fits && !changed.is_impossible();
        if accepted {
            self.keep(program, moved);
        } else {
            self.state.restore_sketches();
            self.state.trace.rollback(program);
        }
        self.last = Decision { is_same: false, accepted, log_ratio };
        Ok(self.last)
    }

    /// Update the sketches with the scene of the open transaction.
    ///
    /// # Errors
    /// A sketch scores NaN; the chain returns to its last state.
    #[inline(always)]
    pub(crate) fn show(&mut self, program: &Program) -> Result<(), Failure> {
        self.state.update_sketches().inspect_err(|_| {
            self.state.restore_sketches();
            self.state.trace.rollback(program);
        })
    }

    /// Keep the open transaction.
    #[inline(always)]
    pub(crate) fn keep(&mut self, program: &Program, moved: impl IntoIterator<Item = (u128, Value)>) {
        if self.best.is_noting() {
            self.best.note(&self.state, program, moved);
        }
        for table in &mut self.tables {
            table.follow(&self.state.trace, program);
        }
        self.state.trace.commit(program);
        self.best.compare(&self.state, program, self.visit);
    }

    /// Handle a fault of a proposal. A fault that makes the run invalid makes the proposal impossible, and is counted.
    ///
    /// # Errors
    /// Any other fault; the chain returns to its last state.
    #[cold]
    pub(crate) fn give_up(&mut self, task: &Task, met: Box<RunFault>) -> Result<Change, Failure> {
        if task.invalid.count(&met).is_some() {
            return Ok(Change::Impossible);
        }
        self.state.trace.rollback(&task.program);
        Err(met.into())
    }

    /// Gives several choices new values, and runs again what depends on them. The visit numbers the draws of new choices.
    ///
    /// # Errors
    /// A fault that makes no run invalid; the chain returns to its last state.
    pub(crate) fn change(
        &mut self,
        task: &Task,
        machine: &mut Machine,
        visit: u64,
        changes: Vec<Changed<f64>>,
    ) -> Result<Change, Failure> {
        let mut answers = Fresh::plain(self.streams.fresh(visit), &*task.hosts);
        let changed = machine.change(&mut self.state.trace, changes, self.strategy, &mut answers);
        changed.or_else(|met| self.give_up(task, met))
    }
}
