//! The report of a transition, and the choice between HMC and NUTS.

use super::hmc::Hmc;
use super::leapfrog::Phase;
use super::metric::Metric;
use super::nuts::Nuts;
use super::potential::{Cause, Potential, Stop};
use niwaki_math::Stream;

/// The result of a transition.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// The mean acceptance probability over the trajectory's proposals, in `[0, 1]`, to which the step size adapts.
    pub accept: f64,
    /// Whether the point moved.
    pub moved: bool,
    /// The number of leapfrog steps, each with a gradient.
    pub steps: u32,
    /// Doublings of a trajectory that finds its own length; 0 for a fixed length.
    pub depth: u32,
    /// The Hamiltonian at the start, with the fresh momentum, nats.
    pub start_energy: f64,
    /// The Hamiltonian at the new point, nats.
    pub energy: f64,
    /// The reason why the trajectory broke off, if it did.
    pub divergence: Option<Divergence>,
}

/// A trajectory that broke off.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// The start of the trajectory, unconstrained.
    pub start: Vec<f64>,
    /// The point where it broke off, unconstrained; its numbers may not be finite.
    pub end: Vec<f64>,
    /// The drift of the energy, nats; NaN if the target refused the point.
    pub energy_error: f64,
    /// The refusal of the target, if it was the reason.
    pub stop: Option<Stop>,
}

/// Trajectories that broke off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct BrokenOff {
    /// Refusals of the target after the warm-up, by [`Cause`].
    pub refused: [u64; Cause::COUNT],
    /// Trajectories after the warm-up whose energy drifted.
    pub drifted: u64,
    /// Trajectories in the warm-up, for any reason.
    pub in_warmup: u64,
}

impl BrokenOff {
    /// Counts a trajectory; `stop` is the target's refusal, if that was the reason.
    pub fn count(&mut self, stop: Option<Stop>, warming: bool) {
        match stop {
            _ if warming => self.in_warmup += 1,
            Some(stop) => self.refused[stop.cause as usize] += 1,
            None => self.drifted += 1,
        }
    }
}

impl std::ops::AddAssign for BrokenOff {
    fn add_assign(&mut self, other: BrokenOff) {
        self.refused.iter_mut().zip(other.refused).for_each(|(sum, count)| *sum += count);
        self.drifted += other.drifted;
        self.in_warmup += other.in_warmup;
    }
}

/// A kernel with its working memory.
#[derive(Clone, Debug)]
pub enum Kernel {
    /// A fixed number of leapfrog steps.
    Hmc(Hmc),
    /// A number of steps until the trajectory turns back.
    Nuts(Nuts),
}

impl Kernel {
    /// Make a transition of `phase` with a new momentum.
    pub fn step(
        &mut self,
        target: &mut (impl Potential + ?Sized),
        metric: &Metric,
        step: f64,
        phase: &mut Phase,
        stream: &mut Stream,
    ) -> Transition {
        match self {
            Kernel::Hmc(hmc) => hmc.step(target, metric, step, phase, stream),
            Kernel::Nuts(nuts) => nuts.step(target, metric, step, phase, stream),
        }
    }
}

/// `min(1, exp(log_ratio))`, and 0 for a NaN. (`f64::min(1.0, NaN)` is 1: it would accept what diverged.)
#[inline]
pub fn acceptance(log_ratio: f64) -> f64 {
    if log_ratio >= 0.0 {
        1.0
    } else if log_ratio < 0.0 {
        log_ratio.exp()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_not_accepted() {
        assert_eq!(acceptance(f64::NAN), 0.0);
        assert_eq!(acceptance(f64::NEG_INFINITY), 0.0);
        assert_eq!((acceptance(3.0), acceptance(0.0), acceptance(-1.0)), (1.0, 1.0, (-1.0_f64).exp()));
    }
}
