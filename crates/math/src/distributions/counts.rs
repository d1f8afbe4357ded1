//! Counts of events: poisson, binomial.
//!
//! With `k` events, the log probabilities are differences of terms that grow like `k ln k`. Loader's form
//! ("Fast and accurate computation of binomial probabilities", 2000) avoids such terms. It uses the deviance
//! `D(x, m) = x ln(x / m) + m - x` and the error `e` of Stirling's formula:
//!
//! ```text
//! ln poisson(k; r)     = -e(k) - D(k, r) - ln(2 pi k) / 2
//! ln binomial(k; n, p) = e(n) - e(k) - e(n - k) - D(k, n p) - D(n - k, n (1 - p)) + ln(n / (2 pi k (n - k))) / 2
//! ```

use crate::scalar::Scalar;
use crate::streams::RngCore;
use rand_distr::Distribution;
use std::f64::consts::TAU;

/// Largest rate: above it, counts would not fit into an integer.
pub(super) const LARGEST_RATE: f64 = 1e15;

/// `ln k! - (k ln k - k + ln(2 pi k) / 2)`, the error of Stirling's formula.
fn stirling_error(k: f64) -> f64 {
    if k < 16.0 {
        return libm::lgamma(k + 1.0) - (k * k.ln() - k + 0.5 * (TAU * k).ln());
    }
    let r = 1.0 / k;
    let r2 = r * r;
    let tail =
        1.0 / 1260.0 - r2 * (1.0 / 1680.0 - r2 * (1.0 / 1188.0 - r2 * (691.0 / 360_360.0 - r2 / 156.0)));
    r * (1.0 / 12.0 - r2 * (1.0 / 360.0 - r2 * tail))
}

/// `D(x, m) = x ln(x / m) + m - x` for positive `x` and `m`; never negative.
pub(super) fn deviance<S: Scalar>(x: f64, m: S) -> S {
    let c = S::from_f64;
    let v = (c(x) - m) / (c(x) + m);
    if v.abs() >= c(0.1) {
        return c(x) * (c(x) / m).ln() + m - c(x);
    }
    // Near m the three terms cancel: ln(x / m) = 2 artanh(v), as a series in v.
    let square = v * v;
    let mut sum = c(0.0);
    let mut power = v;
    for j in 1..=10 {
        power = power * square;
        sum = sum + power * c(1.0 / f64::from(2 * j + 1));
    }
    (c(x) - m) * v + c(2.0 * x) * sum
}

/// `k ln r - r - ln k!`.
#[inline(never)]
pub(super) fn poisson_log_density<S: Scalar>(rate: S, k: i64) -> S {
    if k < 0 || (k > 0 && rate.value() == 0.0) {
        return S::from_f64(f64::NEG_INFINITY);
    }
    if k == 0 {
        return -rate;
    }
    let k = k as f64;
    -deviance(k, rate) - S::from_f64(stirling_error(k) + 0.5 * (TAU * k).ln())
}

/// A draw of `rand_distr`'s sampler.
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "counts beyond the largest integer are replaced by it")]
pub(super) fn poisson_sample(rate: f64, rng: &mut (impl RngCore + ?Sized)) -> i64 {
    rand_distr::Poisson::new(rate).map_or(0, |d| d.sample(rng) as i64)
}

/// `ln C(n, k) + k ln p + (n - k) ln(1 - p)`.
#[inline(never)]
pub(super) fn binomial_log_density<S: Scalar>(n: i64, p: S, k: i64) -> S {
    let never = S::from_f64(f64::NEG_INFINITY);
    if k < 0 || k > n {
        return never;
    }
    let (successes, failures, trials) = (k as f64, (n - k) as f64, n as f64);
    // With 0 or `n` successes only one power is left; the other term would be 0 * ln 0.
    if k == 0 || k == n {
        let some = if k == 0 { (-p).ln_1p() } else { p.ln() };
        return if n == 0 { S::from_f64(0.0) } else { S::from_f64(trials) * some };
    }
    if p.value() <= 0.0 || p.value() >= 1.0 {
        return never;
    }
    let (unity, size) = (S::from_f64(1.0), S::from_f64(trials));
    let fixed = stirling_error(trials) - stirling_error(successes) - stirling_error(failures)
        + 0.5 * (trials / (TAU * successes * failures)).ln();
    S::from_f64(fixed) - deviance(successes, size * p) - deviance(failures, size * (unity - p))
}

/// A draw of `rand_distr`'s sampler.
#[inline(never)]
pub(super) fn binomial_sample(n: i64, p: f64, rng: &mut (impl RngCore + ?Sized)) -> i64 {
    rand_distr::Binomial::new(n.max(0) as u64, p).map_or(0, |d| d.sample(rng) as i64)
}

#[cfg(test)]
mod tests {
    //! Probabilities sum to one, draws follow them, and large counts keep their digits.
    use super::super::testing::*;
    use super::*;
    use crate::{Dist, Family};

    #[test]
    fn probabilities_sum_to_one_and_draws_follow_them() {
        for rate in [0.0, 1e-6, 0.4, 7.0, 40.0, 900.0] {
            discrete_agrees(&dist(Family::Poisson, &[rate]), 0..=2000);
        }
        for (n, p) in [(0, 0.3), (1, 0.2), (9, 0.0), (9, 1.0), (12, 0.7), (90, 0.5), (5000, 0.03)] {
            discrete_agrees(&Dist::Binomial { n, p }, 0..=n);
        }
    }

    #[test]
    fn small_counts_agree_with_factorials() {
        for (k, factorial) in [(1, 1.0), (2, 2.0), (5, 120.0), (10, 3_628_800.0_f64)] {
            let plain = f64::from(k) * 2.5_f64.ln() - 2.5 - factorial.ln();
            assert!((poisson_log_density(2.5, i64::from(k)) / plain - 1.0).abs() < 1e-14, "{k}");
        }
    }

    #[test]
    fn large_counts_keep_their_digits() {
        // At its mean m a Poisson has probability 1 / sqrt(2 pi m) (1 - 1/(12 m) + ...).
        for m in [1e6, 1e10, 1e14] {
            let close = -0.5 * (TAU * m).ln() - 1.0 / (12.0 * m);
            assert!((poisson_log_density(m, m as i64) / close - 1.0).abs() < 1e-14, "{m}");
        }
    }
}
