//! The step size: a first guess, then dual averaging towards an acceptance.
//!
//! `log e_(k+1) = mu - sqrt(k) / gamma * mean_k(target - accept)`, and the average of these iterates, weighted
//! towards the later ones, is what is kept (Hoffman & Gelman 2014, eq. 6 and algorithm 5).

use super::leapfrog::{Phase, leapfrog};
use super::metric::Metric;
use super::potential::Potential;
use super::transition::acceptance;
use niwaki_math::Stream;
use niwaki_math::bits;
use serde::{Deserialize, Serialize};

/// How strongly the log step is drawn to `mu` (Hoffman & Gelman 2014, section 3.2.1: gamma).
const SHRINKAGE: f64 = 0.05;
/// Damps the first iterations (t0).
const OFFSET: f64 = 10.0;
/// How fast old iterates are forgotten (kappa).
const FORGETTING: f64 = 0.75;

/// A step size that is being adapted.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct DualAveraging {
    /// The target acceptance.
    #[serde(with = "bits")]
    pub target: f64,
    #[serde(with = "bits")]
    mu: f64,
    #[serde(with = "bits")]
    log_step: f64,
    #[serde(with = "bits")]
    log_mean: f64,
    #[serde(with = "bits")]
    error: f64,
    #[serde(with = "bits")]
    count: f64,
}

impl DualAveraging {
    /// Start from a guess; iterates are drawn towards ten times the guess.
    pub fn new(first: f64, target: f64) -> DualAveraging {
        let mu = (10.0 * first).ln();
        DualAveraging { target, mu, log_step: first.ln(), log_mean: 0.0, error: 0.0, count: 0.0 }
    }

    /// Adapt to the acceptance of a transition, in `[0, 1]`.
    pub fn update(&mut self, accept: f64) {
        self.count += 1.0;
        let weight = 1.0 / (self.count + OFFSET);
        self.error += weight * (self.target - accept - self.error);
        self.log_step = self.mu - self.count.sqrt() / SHRINKAGE * self.error;
        let weight = self.count.powf(-FORGETTING);
        self.log_mean += weight * (self.log_step - self.log_mean);
    }

    /// The next step size during adaptation.
    pub fn current(&self) -> f64 {
        self.log_step.exp()
    }

    /// The final step size.
    pub fn settled(&self) -> f64 {
        if self.count > 0.0 { self.log_mean.exp() } else { self.current() }
    }
}

/// A step with which one leapfrog step is accepted with probability about 0.8: doubled or halved from `from` until
/// the acceptance crosses that. The whole energy counts, kinetic too (Hoffman & Gelman 2014, algorithm 4; 0.8 as in
/// Stan). Each try draws a new momentum.
pub fn first_guess(
    target: &mut (impl Potential + ?Sized),
    metric: &Metric,
    phase: &Phase,
    from: f64,
    stream: &mut Stream,
) -> f64 {
    const MOST_TRIES: u32 = 60;
    let mut accepted = |step: f64| {
        let mut moved = phase.clone();
        moved.refresh(metric, stream);
        let before = moved.energy();
        let refused = leapfrog(target, metric, &mut moved, step, 1).is_err();
        !refused && acceptance(before - moved.energy()) > 0.8
    };
    let growing = accepted(from);
    let factor = if growing { 2.0 } else { 0.5 };
    let mut step = from;
    for _ in 0..MOST_TRIES {
        let next = step * factor;
        if accepted(next) != growing {
            // The larger of the two was refused, the smaller taken.
            return if growing { step } else { next };
        }
        step = next;
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hamiltonian::potential::tests::normals;

    #[test]
    fn dual_averaging_finds_the_step_of_a_wanted_acceptance() {
        // Acceptance exp(-step), with noise: the step sought is -ln(0.65).
        for first in [1e-3, 1.0, 100.0] {
            let mut average = DualAveraging::new(first, 0.65);
            let mut stream = Stream::new(5, 0, 0, 0);
            for _ in 0..3000 {
                let noise = 0.2 * (stream.uniform() - 0.5);
                average.update(((-average.current()).exp() + noise).clamp(0.0, 1.0));
            }
            assert!((average.settled() + 0.65_f64.ln()).abs() < 0.03, "{}", average.settled());
        }
    }

    #[test]
    fn the_first_guess_has_the_scale_of_the_target() {
        for scale in [1e-6, 1.0, 1e5] {
            let mut target = normals(vec![scale; 3]);
            let phase = Phase::at(&mut target, &[scale, -scale, 0.2 * scale]).expect("a point of the target");
            let guess = first_guess(&mut target, &Metric::unit(3), &phase, 1.0, &mut Stream::new(1, 0, 0, 0));
            assert!((0.1..4.0).contains(&(guess / scale)), "{guess} {scale}");
        }
    }
}
