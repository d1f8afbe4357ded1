//! What becomes of an open transaction: it is kept or undone, on the trace and on the sketches together.

use super::Chain;
use super::accept::{Rules, Terms};
use crate::{Failure, Task};
use niwaki_math::{RngCore, Stream, streams::open_unit};
use niwaki_vm::machine::kept::{Change, Trace};
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;

/// What became of a proposal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Decision {
    /// Whether the proposal was the present state.
    pub same: bool,
    /// Whether it was kept.
    pub accepted: bool,
    /// Log of the acceptance ratio; minus infinity for an impossible proposal.
    pub log_ratio: f64,
}

impl<R: Rules> Chain<R> {
    /// Decides over the open transaction. `odds` is the log probability of choosing the move, afterwards less before;
    /// `moved` names the choices that the proposal itself changed, with their values before. The acceptance draw is
    /// the next number of `rng`.
    #[inline(always)]
    pub(super) fn decide<M: IntoIterator<Item = (u128, Value)>>(
        &mut self,
        task: &Task,
        change: Change,
        beta: f64,
        rng: &mut Stream,
        odds: impl FnOnce(&Self, &Trace) -> f64,
        moved: impl FnOnce(&Trace) -> M,
    ) -> Result<Decision, Failure> {
        let program = &*task.program;
        match change {
            Change::Same => {
                self.state.trace.commit(program);
                self.last = Decision { same: true, accepted: true, log_ratio: 0.0 };
                return Ok(self.last);
            }
            Change::Impossible => {
                self.state.trace.rollback(program);
                self.last = Decision { same: false, accepted: false, log_ratio: f64::NEG_INFINITY };
                return Ok(self.last);
            }
            Change::Done => {}
        }
        if let Err(failure) = self.state.look() {
            self.state.look_back();
            self.state.trace.rollback(program);
            return Err(failure);
        }
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
            odds: odds(self, trace),
        };
        let log_ratio = R::log_ratio(&terms);
        let u = open_unit(rng);
        let barriers = || self.state.primitives as i64 + totals.factors + changed.factors;
        let fits = self.barriers.is_none_or(|n| barriers() == n as i64);
        let accepted =
            fits && !changed.is_impossible() && (log_ratio >= 0.0 || u.ln() < log_ratio) && !self.undoing;
        if accepted {
            if self.best.is_noting() {
                let moved = moved(&self.state.trace);
                self.best.note(&self.state, program, moved);
            }
            for table in &mut self.tables {
                table.follow(&self.state.trace, program);
            }
            self.state.trace.commit(program);
            self.best.compare(&self.state, program, self.visit);
        } else {
            self.state.look_back();
            self.state.trace.rollback(program);
        }
        self.last = Decision { same: false, accepted, log_ratio };
        Ok(self.last)
    }

    /// A proposal met a fault. Where a distribution is invalid, the proposal is impossible, and counted.
    ///
    /// # Errors
    /// Any other fault; the chain is back in its last state.
    #[cold]
    pub(super) fn give_up(&mut self, task: &Task, met: Box<RunFault>) -> Result<Change, Failure> {
        if task.invalid.count(&met).is_some() {
            return Ok(Change::Impossible);
        }
        self.state.trace.rollback(&task.program);
        Err(met.into())
    }
}

/// A number below `n`, evenly (up to `n / 2^64`).
#[inline(always)]
pub(crate) fn below(rng: &mut Stream, n: u64) -> u64 {
    ((u128::from(rng.next_u64()) * u128::from(n)) >> 64) as u64
}
