//! Log weights: normalisation, means, effective sample size, draws, steps between scores. Sums run in the order of the
//! particles, so that they are the same for any number of threads.

use niwaki_math::Total;
use niwaki_math::log_sums::log_sum_exp;

/// Weights relative to the largest, with the log of their mean and the effective sample size.
#[derive(Default)]
pub struct Normalised {
    /// `exp(w_i - max)`.
    pub relative: Vec<f64>,
    /// Log of the mean weight, nats.
    pub log_mean: f64,
    /// `(sum w)^2 / sum w^2`, between 1 and the number of particles.
    pub effective: f64,
}

impl Normalised {
    /// Normalise log weights; return false when every weight is zero.
    pub fn read(&mut self, logs: impl Iterator<Item = f64> + Clone) -> bool {
        let max = logs.clone().fold(f64::NEG_INFINITY, f64::max);
        if max == f64::NEG_INFINITY {
            return false;
        }
        self.relative.clear();
        let mut exps = Exps::default();
        self.relative.extend(logs.map(|w| exps.of(w - max)));
        let (mut sum, mut squares) = (0.0, 0.0);
        for w in &self.relative {
            sum += w;
            squares += w * w;
        }
        self.log_mean = max + (sum / self.relative.len() as f64).ln();
        self.effective = sum * sum / squares;
        true
    }

    /// Draw a particle index by inversion. `u` is uniform between 0 and 1.
    pub fn index(&self, u: f64) -> usize {
        index(&self.relative, u)
    }
}

/// A cache of `exp`: many arguments are equal, because scores are often sums of few different terms.
struct Exps {
    /// Arguments with their `exp`, by a hash of the argument.
    entries: [(f64, f64); Exps::SIZE],
}

impl Default for Exps {
    fn default() -> Exps {
        Exps { entries: [(0.0, 1.0); Exps::SIZE] }
    }
}

impl Exps {
    const SIZE: usize = 64;

    #[inline(always)]
    fn of(&mut self, x: f64) -> f64 {
        let place = x.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (u64::BITS - Exps::SIZE.ilog2());
        let entry = &mut self.entries[place as usize % Exps::SIZE];
        if entry.0 != x {
            *entry = (x, x.exp());
        }
        entry.1
    }
}

/// Draw an index by inversion, with probability proportional to its weight. `u` is uniform between 0 and 1.
pub fn index(weights: &[f64], u: f64) -> usize {
    let mut left = u * weights.iter().sum::<f64>();
    let last = weights.iter().rposition(|w| *w > 0.0).unwrap_or(0);
    let at = weights[..last].iter().position(|w| {
        left -= w;
        left < 0.0
    });
    at.unwrap_or(last)
}

/// [`log_step`] of scores that are exact as `f64`.
#[inline(always)]
pub fn near_log_step(next: f64, score: f64, power: f64, weighed: f64) -> f64 {
    // Equal powers by one product: the difference of scores is exact.
    if next == power { next * (score - weighed) } else { next * score - power * weighed }
}

/// The log weight, nats, of a step from the score `weighed` at `power` to `score` at the power `next`. At power zero the score
/// counts only where the run is impossible.
#[inline(always)]
pub fn log_step(next: f64, score: &Total, power: f64, weighed: &Total) -> f64 {
    let log = near_log_step(next, score.near(), power, weighed.near());
    if log.is_nan() { wide_log_step(next, score, power, weighed) } else { log }
}

/// [`log_step`] where a score is impossible or too large to be exact as an `f64`.
#[cold]
#[inline(never)]
fn wide_log_step(next: f64, score: &Total, power: f64, weighed: &Total) -> f64 {
    if score.is_impossible() {
        f64::NEG_INFINITY
    } else if next == power {
        next * score.less(weighed).value()
    } else {
        next * score.value() - power * weighed.value()
    }
}

/// The conditional effective sample size, as a share of the particles, of a step from weights `old` (logs) by
/// increments `step` (logs): `(sum W u)^2 / sum W u^2` with `W` normalised (Zhou, Johansen & Aston 2016, eq. 13).
///
/// Weights that were not reset for long differ by thousands of nats, and the particle with the largest `W` need not be
/// the one with the largest `u`: each of the three sums is relative to its own largest term.
pub fn conditional_share(
    old: impl Iterator<Item = f64> + Clone,
    step: impl Iterator<Item = f64> + Clone,
) -> f64 {
    let both = old.clone().zip(step);
    let sum = log_sum_exp(both.clone().map(|(w, u)| w + u));
    if sum == f64::NEG_INFINITY {
        return 0.0;
    }
    (2.0 * sum - log_sum_exp(both.map(|(w, u)| w + 2.0 * u)) - log_sum_exp(old)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cached_exps_equal_exp_to_the_bit() {
        let mut exps = Exps::default();
        let few = [0.0, -0.0, f64::NEG_INFINITY, -700.0, -1.5];
        let many = (0..2000).map(|k| f64::from(k % 400) * -0.37);
        for x in many.flat_map(|x| [x, few[(x.to_bits() % 5) as usize]]) {
            assert_eq!(exps.of(x).to_bits(), x.exp().to_bits());
        }
    }

    #[test]
    fn the_conditional_share_is_one_for_equal_steps_and_counts_survivors() {
        let old = || [0.0, -1.0, 0.5, 0.0].into_iter();
        assert!((conditional_share(old(), [3.0; 4].into_iter()) - 1.0).abs() < 1e-12);
        let half = [0.0, f64::NEG_INFINITY, f64::NEG_INFINITY, 0.0];
        let equal = || [0.0; 4].into_iter();
        assert!((conditional_share(equal(), half.into_iter()) - 0.5).abs() < 1e-12);
        // No particle with a weight survives the step.
        let survivors = [f64::NEG_INFINITY, 0.0, 0.0, f64::NEG_INFINITY];
        assert_eq!(conditional_share(half.into_iter(), survivors.into_iter()), 0.0);
    }

    /// A constant in all weights or in all steps changes nothing; by hand, for weights 1 and 3 and steps 1 and 1/3:
    /// `(1/4 + 3/4 1/3)^2 / (1/4 + 3/4 1/9) = 3/4`.
    #[test]
    fn the_conditional_share_is_the_same_at_any_size_of_the_weights() {
        let (w, u) = ([0.0, 3.0f64.ln()], [0.0, -(3.0f64.ln())]);
        for by in [0.0, -1e5, 1e5] {
            for up in [0.0, -1e5, 1e5] {
                let share = conditional_share(w.map(|w| w + by).into_iter(), u.map(|u| u + up).into_iter());
                assert!((share - 0.75).abs() < 1e-9, "{by}, {up}: {share}");
            }
        }
        // All of the weight on one particle: whatever the steps are, it stays effective.
        let share = conditional_share([1e5, -1e5].into_iter(), [-1e4, 0.0].into_iter());
        assert!((share - 1.0).abs() < 1e-9, "{share}");
    }

    #[test]
    fn an_index_is_drawn_by_its_share() {
        let mut w = Normalised::default();
        assert!(w.read([0.0f64.ln(), 1.0f64.ln(), 3.0f64.ln(), 0.0f64.ln()].into_iter()));
        assert_eq!([0.001, 0.2499, 0.2501, 0.9999].map(|u| w.index(u)), [1, 1, 2, 2]);
    }
}
