//! Ranks of whole numbers as normal scores. The score of `k` is the number that a standard Gaussian falls below with the
//! probability that the distribution gives at most `k`.
//!
//! The scores of all `k` cut the line into one piece for each value. So a density on the line gives each value the
//! probability of its piece.
//!
//! | family | P(at most k) |
//! | --- | --- |
//! | discrete_uniform, geometric | in closed form |
//! | poisson, binomial, variance up to 100 | the sum of the probabilities, from `k` to the nearer end |
//! | poisson, binomial, larger variance | the signed root of twice the deviance at `k + 1/2`: off by 0.02 at most |

use super::counts::{binomial_log_density, deviance, poisson_log_density};
use super::family::Dist;
use super::whole::discrete_uniform_size;
use crate::special::{normal_quantile, normal_tail};

/// Largest variance for which probabilities are summed; beyond, the sums have too many terms.
const LARGEST_SUM: f64 = 100.0;

/// The score of two probabilities that sum to one, computed from the smaller.
fn score(below: f64, above: f64) -> f64 {
    if below <= above { normal_quantile(below) } else { -normal_quantile(above) }
}

/// The score from the sum of probabilities towards the nearer end. If more than half of the draws are at most a value below
/// the mean, the sum above has more digits.
fn nearer(is_below: bool, below: impl Fn() -> f64, above: impl Fn() -> f64) -> f64 {
    if is_below {
        let below = below();
        if below <= 0.5 {
            return score(below, 1.0 - below);
        }
    }
    let above = above();
    score(1.0 - above, above)
}

/// `first (1 + ratio(1) + ratio(1) ratio(2) + ...)`, for decreasing ratios.
fn series(first: f64, ratio: impl Fn(f64) -> f64) -> f64 {
    let (mut term, mut sum, mut j) = (first, 0.0, 1.0);
    while term > 1e-17 * sum {
        sum += term;
        term *= ratio(j);
        j += 1.0;
    }
    sum
}

/// A score from the deviance at `k + 1/2`.
fn signed_root(x: f64, mean: f64, deviance: f64) -> f64 {
    (2.0 * deviance.max(0.0)).sqrt().copysign(x - mean)
}

/// The score of a Poisson.
fn poisson(rate: f64, k: i64) -> f64 {
    let x = k as f64;
    if rate > LARGEST_SUM {
        return signed_root(x + 0.5, rate, deviance(x + 0.5, rate));
    }
    let below = || series(poisson_log_density(rate, k).exp(), |j| (x - j + 1.0) / rate);
    let above = || series(poisson_log_density(rate, k + 1).exp(), |j| rate / (x + 1.0 + j));
    nearer(x < rate, below, above)
}

/// The score of a binomial.
fn binomial(n: i64, p: f64, k: i64) -> f64 {
    let (x, trials) = (k as f64, n as f64);
    let mean = trials * p;
    if mean * (1.0 - p) > LARGEST_SUM {
        let (success, failure) = (x + 0.5, trials - x - 0.5);
        let both = deviance(success, mean) + deviance(failure, trials * (1.0 - p));
        return signed_root(success, mean, both);
    }
    let quotient = p / (1.0 - p);
    let first = |k: i64| binomial_log_density(n, p, k).exp();
    let below = || series(first(k), |j| (x - j + 1.0) / ((trials - x + j) * quotient));
    let above = || series(first(k + 1), |j| (trials - x - j) * quotient / (x + 1.0 + j));
    nearer(x < mean, below, above)
}

impl Dist {
    /// The normal score of `k`: the number that a standard Gaussian falls below with the probability of at most `k`. It never
    /// falls with `k`, is minus infinity below the smallest value and plus infinity from the largest on. With variances above 100
    /// its error is at most 0.02. `None` for families other than poisson, binomial, geometric and discrete_uniform.
    ///
    /// ```
    /// use niwaki_math::Dist;
    /// let die = Dist::DiscreteUniform { lo: 1, hi: 6 };
    /// assert_eq!(die.normal_score(3), Some(0.0));
    /// assert_eq!(die.normal_score(6), Some(f64::INFINITY));
    /// ```
    pub fn normal_score(&self, k: i64) -> Option<f64> {
        let (lo, hi) = match *self {
            Dist::Poisson { .. } | Dist::Geometric { .. } => (0, i64::MAX),
            Dist::Binomial { n, .. } => (0, n),
            Dist::DiscreteUniform { lo, hi } => (lo, hi),
            _ => return None,
        };
        if k < lo || k >= hi {
            return Some(if k < lo { f64::NEG_INFINITY } else { f64::INFINITY });
        }
        Some(match *self {
            Dist::Poisson { rate } => poisson(rate, k),
            Dist::Binomial { n, p } => binomial(n, p, k),
            Dist::Geometric { p } => {
                let log_above = (k as f64 + 1.0) * (-p).ln_1p();
                score(-log_above.exp_m1(), log_above.exp())
            }
            _ => {
                let size = discrete_uniform_size(lo, hi);
                score(discrete_uniform_size(lo, k) / size, discrete_uniform_size(k + 1, hi) / size)
            }
        })
    }

    /// The least `k` whose [`Dist::normal_score`] is at least `z`: a Gaussian `z` gives a draw of the distribution.
    ///
    /// The search starts at a guess from mean and deviation, and doubles its steps.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a first guess: what is out of range becomes an end of it"
    )]
    pub fn at_normal_score(&self, z: f64) -> Option<i64> {
        let guess = match *self {
            Dist::Poisson { rate } => rate + rate.sqrt() * z,
            Dist::Binomial { n, p } => n as f64 * p + (n as f64 * p * (1.0 - p)).sqrt() * z,
            Dist::Geometric { p } => normal_tail(z).ln() / (-p).ln_1p() - 1.0,
            Dist::DiscreteUniform { lo, hi } => {
                lo as f64 + discrete_uniform_size(lo, hi) * normal_tail(-z) - 1.0
            }
            _ => return None,
        };
        let (lo, hi) = match *self {
            Dist::Binomial { n, .. } => (0, n),
            Dist::DiscreteUniform { lo, hi } => (lo, hi),
            _ => (0, i64::MAX),
        };
        let reached = |k: i64| self.normal_score(k).is_some_and(|score| score >= z);
        let start = (guess.ceil() as i64).clamp(lo, hi);
        // The answer is at most `above` and greater than `below`, which may be one less than the smallest value.
        let (mut below, mut above) = (lo.saturating_sub(1), hi);
        let mut step = 1;
        if reached(start) {
            above = start;
            while above > lo {
                let k = above.saturating_sub(step).max(lo);
                if !reached(k) {
                    below = k;
                    break;
                }
                above = k;
                step = step.saturating_mul(2);
            }
        } else {
            below = start;
            while below < hi {
                let k = below.saturating_add(step).min(hi);
                if reached(k) {
                    above = k;
                    break;
                }
                below = k;
                step = step.saturating_mul(2);
            }
        }
        while above > lo && below < above - 1 {
            let middle = below + (above - below) / 2;
            *(if reached(middle) { &mut above } else { &mut below }) = middle;
        }
        Some(above)
    }
}

#[cfg(test)]
mod tests {
    //! Scores agree with those of summed probabilities, never fall, and are inverted.
    use super::*;
    use crate::Draw;

    fn families() -> Vec<Dist> {
        vec![
            Dist::Poisson { rate: 0.0 },
            Dist::Poisson { rate: 1e-59 },
            Dist::Poisson { rate: 0.3 },
            Dist::Poisson { rate: 99.0 },
            Dist::Poisson { rate: 5000.0 },
            Dist::Binomial { n: 0, p: 0.5 },
            Dist::Binomial { n: 9, p: 0.2 },
            Dist::Binomial { n: 9, p: 0.0 },
            Dist::Binomial { n: 9, p: 1e-40 },
            Dist::Binomial { n: 9, p: 1.0 },
            Dist::Binomial { n: 3000, p: 0.99 },
            Dist::Binomial { n: 3000, p: 0.4 },
            Dist::Geometric { p: 0.02 },
            Dist::Geometric { p: 1.0 },
            Dist::DiscreteUniform { lo: -3, hi: 80 },
        ]
    }

    #[test]
    fn scores_agree_with_sums_and_never_fall() {
        for d in families() {
            let (mut below, mut last) = (0.0, f64::NEG_INFINITY);
            let large = d.normal_score(2500).is_some_and(f64::is_finite);
            for k in -5..6000 {
                below += d.log_density(&Draw::Int(k)).exp();
                let score = d.normal_score(k).unwrap();
                assert!(score >= last, "{d:?} at {k}: {score} after {last}");
                last = score;
                let expected = normal_quantile(below);
                if expected.abs() < 5.0 {
                    let near =
                        if large || matches!(d, Dist::Binomial { n: 3000, p: 0.4 }) { 0.02 } else { 1e-7 };
                    assert!((score - expected).abs() < near, "{d:?} at {k}: {score} for {expected}");
                }
            }
        }
    }

    #[test]
    fn scores_are_inverted() {
        let mut all = families();
        all.push(Dist::Poisson { rate: 1e15 });
        all.push(Dist::Binomial { n: i64::MAX, p: 0.3 });
        all.push(Dist::Geometric { p: 1e-300 });
        all.push(Dist::DiscreteUniform { lo: i64::MIN, hi: i64::MAX });
        for d in all {
            for z in [-30.0, -8.0, -2.1, -0.3, 0.0, 0.4, 1.9, 8.0, 30.0] {
                let k = d.at_normal_score(z).unwrap();
                assert!(d.normal_score(k).unwrap() >= z, "{d:?} {z} {k}");
                let before = k.checked_sub(1).map_or(f64::NEG_INFINITY, |k| d.normal_score(k).unwrap());
                assert!(before < z, "{d:?} {z} {k}");
            }
        }
    }
}
