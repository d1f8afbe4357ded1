//! Proposals for one choice: a new value, and the log densities of proposing it and of proposing the old one from it.

use crate::walk::accept::Decision;
use crate::walk::state::State;
use niwaki_math::{Dist, Stream, StreamKey, grid};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::{Propose, Proposed};
use niwaki_vm::value::Value;

/// A move of one choice.
pub trait Move {
    /// Whether it draws from the choice's own distribution, and gives the log density of what it drew.
    const FROM_PRIOR: bool = false;

    /// Looks at the state of a chain before a choice of it, by number, is changed.
    #[inline(always)]
    fn look(&mut self, _: &State, _: &Program, _choice: usize) {}

    /// A new value for a choice at the site with this number; random bits come from `rng`.
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        site: usize,
        dist: &Dist,
        old: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault>;

    /// The log density of the way back, once the run with the new value is there and not kept yet; `None` where it is the
    /// one that was proposed.
    #[inline(always)]
    fn look_back(&mut self, _: &State, _: &Program, _choice: usize) -> Option<f64> {
        None
    }

    /// Adapts to the decision on its proposal, while the chain warms up.
    #[inline(always)]
    fn learn(&mut self, _site: usize, _decision: Decision) {}
}

/// From the choice's own distribution.
pub(crate) struct FromPrior;

impl Move for FromPrior {
    const FROM_PRIOR: bool = true;

    #[inline(always)]
    fn propose(
        &mut self,
        _: &At<'_, f64>,
        _: usize,
        dist: &Dist,
        _: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let (draw, log) = dist.sample_and_score(rng);
        Ok(Proposed { value: draw.into(), forward: grid(log), backward: log_density })
    }
}

/// A move of the choice at one site, in the form that the machine calls.
pub(super) struct MoveProposal<'a, M> {
    pub proposer: &'a mut M,
    pub site: usize,
    /// The random bits of its new value.
    pub moves: StreamKey,
    /// Whether to keep the old value in `old`.
    pub noting: bool,
    pub old: Option<(u128, Value)>,
}

impl<M: Move> Propose<f64> for MoveProposal<'_, M> {
    const FROM_PRIOR: bool = M::FROM_PRIOR;

    #[inline]
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        old: &Value,
        log_density: f64,
    ) -> Result<Proposed<f64>, Fault> {
        let address = at.address();
        if self.noting {
            self.old = Some((address, old.clone()));
        }
        self.proposer.propose(at, self.site, dist, old, log_density, &mut self.moves.at(address))
    }
}
