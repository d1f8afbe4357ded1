//! The acceptance ratio of a proposal that may change the set of choices.
//!
//! ```text
//! log a =   log prior' - log prior + beta (log score' - log score)
//!         + stale - fresh          log densities of removed choices, less those of new choices; redrawn choices are in both
//!         + backward - forward     log densities of proposing the changed values, back and there
//!         + selection              log probability that this move is chosen, back less there
//! ```
//!
//! Differences are computed exactly and then rounded, so that a ratio is correct however large its cancelling terms are.
//! Dissertation 3.2, with selection weights in place of the numbers of choices.

use niwaki_math::streams::open_unit;
use niwaki_math::{RngCore, Total, grid};

/// The terms of the acceptance ratio, nats.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a> {
    /// Change of the log density of the choices.
    pub prior: &'a Total,
    /// Change of factors, observations and sketches.
    pub score: &'a Total,
    /// The power of the score.
    pub beta: f64,
    /// Log densities of removed and redrawn choices, before the proposal.
    pub stale: &'a Total,
    /// Log densities of new and redrawn choices, after the proposal.
    pub fresh: &'a Total,
    /// Log density of proposing the old values from the new ones.
    pub backward: f64,
    /// Log density of proposing the new values from the old ones.
    pub forward: f64,
    /// Log probability of choosing this move after the proposal, less the log probability before.
    pub selection: f64,
}

impl Terms<'_> {
    /// Log of the acceptance ratio; NaN counts as impossible (an infinity less an infinity).
    #[inline(always)]
    pub fn log_ratio(&self) -> f64 {
        let (prior, score) = (self.prior.near(), self.score.near());
        let (stale, fresh) = (self.stale.near(), self.fresh.near());
        let ratio =
            (prior + self.beta * score) + (stale - fresh) + (self.backward - self.forward) + self.selection;
        if ratio.is_nan() { self.wide_log_ratio() } else { ratio }
    }

    /// Log of the acceptance ratio where a sum is too large to be exact as an `f64`: terms that may cancel are added first.
    #[cold]
    #[inline(never)]
    fn wide_log_ratio(&self) -> f64 {
        if [self.prior, self.score, self.stale, self.fresh].iter().all(|sum| !sum.near().is_nan()) {
            return f64::NAN;
        }
        let mut sum = self.prior.less(self.fresh);
        sum.add_total(self.stale);
        sum.add(grid(self.backward));
        sum.remove(grid(self.forward));
        if self.beta == 1.0 {
            sum.add_total(self.score);
            return sum.value() + self.selection;
        }
        sum.value() + self.beta * self.score.value() + self.selection
    }
}

/// Log probability of picking a choice of unchanged weight after a proposal, less the log probability before. The arguments are
/// the sums of all weights before and after.
#[inline(always)]
pub fn selected(total: u64, after: u64) -> f64 {
    if after == total { 0.0 } else { (total as f64 / after as f64).ln() }
}

/// Accept a proposal with probability `min(1, exp(log_ratio))`, by the next number of `rng`.
#[inline(always)]
pub fn accepts(log_ratio: f64, rng: &mut impl RngCore) -> bool {
    let u = open_unit(rng);
    log_ratio >= 0.0 || u.ln() < log_ratio
}

/// The decision on a proposal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Decision {
    /// Whether the proposal was equal to the present state.
    pub is_same: bool,
    /// Whether the proposal was accepted.
    pub accepted: bool,
    /// Log of the acceptance ratio; minus infinity for an impossible proposal.
    pub log_ratio: f64,
}

/// The log probability that two chains exchange their states. `powers` are the powers of the score of the colder and of the
/// hotter chain; the log score of the hotter chain is larger by `gain` nats.
#[inline]
pub fn log_exchange(powers: (f64, f64), gain: f64) -> f64 {
    (powers.0 - powers.1) * gain
}
