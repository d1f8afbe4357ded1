//! The acceptance ratio of a proposal that may change what there is.
//!
//! ```text
//! log a =   log prior' - log prior + beta (log score' - log score)
//!         + stale - fresh          choices that went or were drawn anew: their log densities, before and after
//!         + backward - forward     log densities of proposing the changed values, back and there
//!         + log odds' - log odds   log probability that this move is chosen, back and there
//! ```
//!
//! Each log density is a multiple of 2^-32, so that the first two lines are exact. Dissertation 3.2, with the odds of
//! a choice in place of the ratio of the numbers of choices.

use crate::hamiltonian::{Kernel, Metric, Phase, Potential, Transition};
use niwaki_math::Stream;
use niwaki_vm::code::Program;
use niwaki_vm::machine::kept::Trace;

/// What decides over a proposal, nats.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// Change of the log density of the choices.
    pub prior: f64,
    /// Change of factors, observations and sketches, times the inverse temperature.
    pub score: f64,
    /// Log densities of the choices that went, or were drawn anew.
    pub stale: f64,
    /// Log densities of the choices that came, or were drawn anew.
    pub fresh: f64,
    /// Log density of proposing the old values from the new ones.
    pub backward: f64,
    /// Log density of proposing the new values from the old ones.
    pub forward: f64,
    /// Log probability of choosing this move, afterwards less before.
    pub odds: f64,
}

/// How a chain decides. Searches use [`MetropolisHastings`]; the tests also hold mutants of it, which must be found out.
pub trait Rules: Send {
    /// Whether densities over coordinates leave their Jacobians out.
    const DROPS_JACOBIAN: bool = false;

    /// Log of the acceptance ratio; NaN where two infinities meet, which counts as impossible.
    #[inline(always)]
    fn log_ratio(t: &Terms) -> f64 {
        (t.prior + t.score) + (t.stale - t.fresh) + (t.backward - t.forward) + t.odds
    }

    /// Log of the probability with which chains that follow these powers of the score exchange their states, which have
    /// these log scores, nats: the colder one's first.
    #[inline]
    fn log_exchange(powers: (f64, f64), scores: (f64, f64)) -> f64 {
        (powers.0 - powers.1) * (scores.1 - scores.0)
    }

    /// One transition along the gradient.
    fn travel<P: Potential>(
        kernel: &mut Kernel,
        target: &mut P,
        metric: &Metric,
        step: f64,
        phase: &mut Phase,
        stream: &mut Stream,
    ) -> Transition {
        kernel.step(target, metric, step, phase, stream)
    }

    /// Told of a chain's trace before its first proposal.
    fn begin(_trace: &mut Trace) {}

    /// Undoes a proposal.
    #[inline(always)]
    fn undo(trace: &mut Trace, program: &Program) {
        trace.rollback(program);
    }
}

/// The rules.
#[derive(Clone, Copy, Debug, Default)]
pub struct MetropolisHastings;

impl Rules for MetropolisHastings {}
