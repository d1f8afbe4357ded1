//! Whole numbers and truth values: bernoulli, discrete_uniform, geometric.

use crate::scalar::{EachLog, Logs, Scalar};
use crate::streams::{RngCore, open_unit};

/// `ln p` for true, `ln(1 - p)` for false.
#[inline]
pub(super) fn bernoulli_log_density<S: Scalar>(p: S, x: bool) -> S {
    bernoulli_log_density_with(p, x, &mut EachLog)
}

/// [`bernoulli_log_density`] with logarithms from elsewhere.
#[inline(always)]
pub(super) fn bernoulli_log_density_with<S: Scalar>(p: S, x: bool, logs: &mut impl Logs<S>) -> S {
    if x { logs.ln(p) } else { logs.ln_of_rest(p) }
}

/// True when the first uniform falls below `p`.
#[inline]
pub(super) fn bernoulli_sample(p: f64, rng: &mut (impl RngCore + ?Sized)) -> bool {
    open_unit(rng) < p
}

/// The number of values, as a float (up to 2^64).
#[inline]
pub(super) fn discrete_uniform_size(lo: i64, hi: i64) -> f64 {
    hi.wrapping_sub(lo) as u64 as f64 + 1.0
}

/// `-ln(hi - lo + 1)`.
#[inline]
pub(super) fn discrete_uniform_log_density(lo: i64, hi: i64, x: i64) -> f64 {
    if x < lo || x > hi { f64::NEG_INFINITY } else { -discrete_uniform_size(lo, hi).ln() }
}

/// The high half of the product of 64 random bits and the range. The few products that would make some values more
/// likely than others are drawn again (Lemire 2019, alg. 5).
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the two halves of a product")]
pub(super) fn discrete_uniform_sample(lo: i64, hi: i64, rng: &mut (impl RngCore + ?Sized)) -> i64 {
    let span = (hi.wrapping_sub(lo) as u64).wrapping_add(1);
    if span == 0 {
        return rng.next_u64() as i64;
    }
    loop {
        let product = u128::from(rng.next_u64()) * u128::from(span);
        let low = product as u64;
        if low >= span || low >= span.wrapping_neg() % span {
            return lo.wrapping_add((product >> 64) as i64);
        }
    }
}

/// `x ln(1 - p) + ln p`.
#[inline]
pub(super) fn geometric_log_density<S: Scalar>(p: S, x: i64) -> S {
    match x {
        ..0 => S::from_f64(f64::NEG_INFINITY),
        // Zero failures add nothing; with p = 1 the product would be 0 times infinity.
        0 => p.ln(),
        _ => S::from_f64(x as f64) * (-p).ln_1p() + p.ln(),
    }
}

/// A draw by inversion; the largest `i64` replaces larger counts.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "counts beyond the largest integer are replaced by it")]
pub(super) fn geometric_sample(p: f64, rng: &mut (impl RngCore + ?Sized)) -> i64 {
    (open_unit(rng).ln() / (-p).ln_1p()).floor() as i64
}

#[cfg(test)]
mod tests {
    //! Probabilities sum to one and draws follow them.
    use super::super::testing::*;
    use crate::{Dist, Draw, Family};

    #[test]
    fn probabilities_sum_to_one_and_draws_follow_them() {
        for p in [0.0, 1e-9, 0.3, 1.0] {
            discrete_agrees(&dist(Family::Bernoulli, &[p]), 0..=1);
        }
        for p in [0.05, 0.5, 1.0] {
            discrete_agrees(&dist(Family::Geometric, &[p]), 0..=1000);
        }
        for (lo, hi) in [(3, 3), (-4, 9), (0, 99)] {
            discrete_agrees(&Dist::DiscreteUniform { lo, hi }, lo..=hi);
        }
    }

    #[test]
    fn extreme_ranges_and_probabilities_are_drawn() {
        let all = Dist::<f64>::DiscreteUniform { lo: i64::MIN, hi: i64::MAX };
        assert!((all.log_density(&Draw::Int(7)) + 64.0 * 2.0_f64.ln()).abs() < 1e-12);
        assert!(matches!(all.sample(&mut stream(1)), Draw::Int(_)));
        let rare = dist(Family::Geometric, &[1e-300]);
        assert_eq!(rare.sample(&mut stream(1)), Draw::Int(i64::MAX));
        assert!(rare.log_density(&Draw::Int(i64::MAX)).is_finite());
    }
}
