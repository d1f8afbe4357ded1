//! Bounded numbers: uniform, beta.

use super::waiting::log_gamma_draw;
use crate::scalar::Scalar;
use crate::streams::{RngCore, open_unit};

/// `-ln(hi - lo)`; both ends belong to the support, since rounding can reach them.
#[inline]
pub(super) fn uniform_log_density<S: Scalar>(lo: S, hi: S, x: S) -> S {
    if x >= lo && x <= hi { -(hi - lo).ln() } else { S::from_f64(f64::NEG_INFINITY) }
}

/// `lo + (hi - lo) u`.
#[inline]
pub(super) fn uniform_sample(lo: f64, hi: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    (lo + (hi - lo) * open_unit(rng)).min(hi)
}

/// `(a - 1) ln x + (b - 1) ln(1 - x) - ln B(a, b)`, inside the open interval.
#[inline(never)]
pub(super) fn beta_log_density<S: Scalar>(a: S, b: S, x: S) -> S {
    let one = S::from_f64(1.0);
    if !(x > S::from_f64(0.0) && x < one) {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let log_norm = a.ln_gamma() + b.ln_gamma() - (a + b).ln_gamma();
    (a - one) * x.ln() + (b - one) * (-x).ln_1p() - log_norm
}

/// `X / (X + Y)` of two gamma draws, by their logarithms: with small `a` and `b` both underflow.
#[inline(never)]
pub(super) fn beta_sample(a: f64, b: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let log_ratio = log_gamma_draw(a, rng) - log_gamma_draw(b, rng);
    let x = if log_ratio < 0.0 {
        log_ratio.exp() / (1.0 + log_ratio.exp())
    } else {
        1.0 / (1.0 + (-log_ratio).exp())
    };
    x.clamp(f64::MIN_POSITIVE, 1.0 - 0.5 * f64::EPSILON)
}

#[cfg(test)]
mod tests {
    //! Densities integrate to one, and draws follow them.
    use super::super::testing::*;
    use crate::{Draw, Family};

    #[test]
    fn draws_follow_the_density() {
        for (lo, hi) in [(0.0, 1.0), (-1e-3, 1e3), (7.0, 7.0 + 1e-9)] {
            continuous_agrees(&dist(Family::Uniform, &[lo, hi]), lo, hi);
        }
        for (a, b) in [(1.0, 1.0), (2.0, 5.0), (80.0, 3.0), (400.0, 400.0)] {
            continuous_agrees(&dist(Family::Beta, &[a, b]), 0.0, 1.0);
        }
    }

    #[test]
    fn tiny_betas_draw_numbers_inside_and_fall_on_both_sides() {
        let d = dist(Family::Beta, &[1e-4, 1e-4]);
        let mut low = 0;
        for k in 0..200 {
            let x = d.sample(&mut stream(k));
            assert!(d.log_density(&x).is_finite());
            low += usize::from(matches!(x, Draw::Real(x) if x < 0.5));
        }
        // 200 fair coins stay within 100 +- 40 but for 2e-8.
        assert!((60..=140).contains(&low), "{low}");
    }
}
