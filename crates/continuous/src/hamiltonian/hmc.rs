//! Hamiltonian Monte Carlo with a fixed length: draw a momentum, integrate, accept or stay.
//!
//! Accepts with probability `min(1, exp(H(x, p) - H(x', p')))` (dissertation 4.3; Neal 2011, section 3.3). The
//! number of steps may be jittered: it is drawn before the trajectory starts, so that a length which happens to be a
//! period of the target does no harm (Neal 2011, section 3.2).

use super::leapfrog::{Phase, leapfrog};
use super::metric::Metric;
use super::potential::{Cause, Potential, Stop};
use super::transition::{Divergence, Transition, acceptance};
use niwaki_math::Stream;

/// A kernel of fixed length.
#[derive(Clone, Debug)]
pub struct Hmc {
    /// The number of leapfrog steps of a trajectory (`L` in the dissertation).
    pub steps: u32,
    /// The number of steps is uniform within this share of `steps`; 0 for a constant one.
    pub jitter: f64,
    /// An energy error above this many nats is a divergence.
    pub max_energy_error: f64,
    /// The start of the trajectory, for rejections.
    before: Option<Phase>,
}

impl Hmc {
    /// Create a kernel with `steps` leapfrog steps, at least one, and `jitter` in `[0, 1]`.
    pub fn new(steps: u32, jitter: f64, max_energy_error: f64) -> Hmc {
        Hmc { steps: steps.max(1), jitter, max_energy_error, before: None }
    }

    /// Draw the number of steps of a trajectory.
    pub(super) fn length(&self, stream: &mut Stream) -> u32 {
        if self.jitter == 0.0 {
            return self.steps;
        }
        let reach = (f64::from(self.steps) * self.jitter).floor();
        let offset = (stream.uniform() * (2.0 * reach + 1.0)).floor() - reach;
        (f64::from(self.steps) + offset).max(1.0) as u32
    }

    /// Make a transition of `phase`.
    pub fn step(
        &mut self,
        target: &mut (impl Potential + ?Sized),
        metric: &Metric,
        step: f64,
        phase: &mut Phase,
        stream: &mut Stream,
    ) -> Transition {
        phase.refresh(metric, stream);
        let steps = self.length(stream);
        self.go(target, metric, step, phase, steps, stream)
    }

    /// The rest of a transition: `steps` steps from the momentum that `phase` has, and whether to stay there.
    pub(super) fn go(
        &mut self,
        target: &mut (impl Potential + ?Sized),
        metric: &Metric,
        step: f64,
        phase: &mut Phase,
        steps: u32,
        stream: &mut Stream,
    ) -> Transition {
        let start = self.begin(phase, steps);
        let refused = leapfrog(target, metric, phase, step, start.steps).err();
        if refused.is_some() {
            metric.velocity(&phase.p, &mut phase.v);
        }
        self.end(start, refused, phase, stream)
    }

    /// Store the start of the trajectory, and draw its momentum.
    pub(super) fn begin(&mut self, phase: &Phase, steps: u32) -> Start {
        let before = self.before.get_or_insert_with(|| phase.clone());
        before.copy_from(phase);
        Start { steps, energy: before.energy() }
    }

    /// Accept the end of the trajectory, or reset the point. Momentum and velocity are those at the end.
    ///
    /// Between the ends only the gradient is evaluated, so a divergence is noticed at the end, or where numbers overflow:
    /// there the kinetic energy shows that the trajectory had diverged before.
    pub(super) fn end(
        &mut self,
        start: Start,
        refused: Option<Stop>,
        phase: &mut Phase,
        stream: &mut Stream,
    ) -> Transition {
        let Start { steps, energy: start_energy } = start;
        let before = self.before.get_or_insert_with(|| phase.clone());
        let overflows = matches!(refused, Some(Stop { cause: Cause::Impossible | Cause::NotFinite, .. }));
        let ran_off = overflows && phase.kinetic() - before.kinetic() > self.max_energy_error;
        let refused = refused.filter(|_| !ran_off);
        let energy_error = match refused {
            Some(_) => f64::NAN,
            None if ran_off => f64::INFINITY,
            None => phase.energy() - start_energy,
        };
        let accept = acceptance(-energy_error);
        let diverged = energy_error.is_nan() || energy_error > self.max_energy_error;
        let divergence = diverged.then(|| Divergence {
            start: before.x.clone(),
            end: phase.x.clone(),
            energy_error,
            stop: refused,
        });
        let moved = !diverged && stream.uniform() < accept;
        if !moved {
            phase.copy_from(before);
        }
        Transition { accept, moved, steps, depth: 0, start_energy, energy: phase.energy(), divergence }
    }
}

/// The start of a trajectory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// The number of leapfrog steps.
    pub(super) steps: u32,
    /// The Hamiltonian at the start, nats.
    pub(super) energy: f64,
}

#[cfg(test)]
mod tests {
    //! A refused trajectory leaves the point where it was and is reported; jitter is uniform.
    use super::*;
    use crate::hamiltonian::potential::tests::{By, normals};

    #[test]
    fn a_stop_ends_the_trajectory_as_a_rejection() {
        let guard = Stop { cause: Cause::Guard, place: 7 };
        let mut walled = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 0.0;
            if x[0].abs() < 1.0 { Ok(0.0) } else { Err(guard) }
        });
        let metric = Metric::unit(1);
        let mut phase = Phase::at(&mut walled, &[0.25]).expect("a point of the target");
        let mut hmc = Hmc::new(1000, 0.0, 1000.0);
        let result = hmc.step(&mut walled, &metric, 0.5, &mut phase, &mut Stream::new(1, 0, 0, 0));
        let divergence = result.divergence.expect("the wall is met");
        assert_eq!((phase.x[0], result.moved, result.accept), (0.25, false, 0.0));
        assert_eq!((divergence.stop, divergence.start), (Some(guard), vec![0.25]));
        assert!(divergence.end[0].abs() >= 1.0 && divergence.energy_error.is_nan());
    }

    #[test]
    fn an_energy_that_is_not_a_number_is_rejected() {
        // The value is NaN beyond 1: `evaluate` refuses it. A step that is too long ends in a huge energy error.
        let mut narrow = normals(vec![1e-3]);
        let mut phase = Phase::at(&mut narrow, &[1e-3]).expect("a point of the target");
        let mut hmc = Hmc::new(50, 0.0, 1000.0);
        let result = hmc.step(&mut narrow, &Metric::unit(1), 1.0, &mut phase, &mut Stream::new(1, 0, 0, 0));
        assert!(!result.moved && result.divergence.is_some() && result.accept == 0.0);
        assert_eq!(phase.x, [1e-3]);
    }

    #[test]
    fn a_trajectory_that_ran_off_before_it_overflowed_diverged_by_its_energy() {
        let mut narrow = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = -x[0] * x[0] * x[0];
            Ok(-0.25 * x[0].powi(4))
        });
        let mut phase = Phase::at(&mut narrow, &[3.0]).expect("a point of the target");
        let mut hmc = Hmc::new(50, 0.0, 1000.0);
        let result = hmc.step(&mut narrow, &Metric::unit(1), 2.0, &mut phase, &mut Stream::new(1, 0, 0, 0));
        let divergence = result.divergence.expect("steps of two are far too long");
        assert_eq!((divergence.stop, divergence.energy_error), (None, f64::INFINITY));
        assert_eq!((phase.x[0], result.accept), (3.0, 0.0));
    }

    #[test]
    fn jittered_lengths_are_uniform_around_the_middle() {
        // Chi-square with 10 degrees of freedom, false alarm 1e-6: threshold 47.6.
        let hmc = Hmc::new(10, 0.5, 1000.0);
        let mut counts = [0.0; 16];
        (0..11_000).for_each(|k| counts[hmc.length(&mut Stream::new(3, 0, 0, k)) as usize] += 1.0);
        let statistic: f64 = counts[5..=15].iter().map(|c: &f64| (c - 1000.0).powi(2) / 1000.0).sum();
        assert!(counts[..5].iter().all(|c| *c == 0.0) && statistic < 47.6, "{statistic}");
    }
}
