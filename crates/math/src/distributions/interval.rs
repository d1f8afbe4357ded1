//! Bounded numbers: uniform, beta.

use super::waiting::log_gamma_draw;
use crate::scalar::{EachLog, Logs, Scalar};
use crate::streams::{RngCore, open_unit};

/// `-ln(hi - lo)`; both ends are in the support, since rounding can reach them.
#[inline]
pub(super) fn uniform_log_density<S: Scalar>(lo: S, hi: S, x: S) -> S {
    uniform_log_density_with(lo, hi, x, &mut EachLog)
}

/// [`uniform_log_density`] with logarithms from elsewhere.
#[inline(always)]
pub(super) fn uniform_log_density_with<S: Scalar>(lo: S, hi: S, x: S, logs: &mut impl Logs<S>) -> S {
    if x >= lo && x <= hi { -logs.ln(hi - lo) } else { S::from_f64(f64::NEG_INFINITY) }
}

/// `lo + (hi - lo) u`.
#[inline]
pub(super) fn uniform_sample(lo: f64, hi: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    (lo + (hi - lo) * open_unit(rng)).min(hi)
}

/// `(a - 1) ln x + (b - 1) ln(1 - x) - ln B(a, b)`; at an end its limit if that is finite.
#[inline(never)]
pub(super) fn beta_log_density<S: Scalar>(a: S, b: S, x: S) -> S {
    let unity = S::from_f64(1.0);
    let log_norm = || a.ln_gamma() + b.ln_gamma() - (a + b).ln_gamma();
    if !(x > S::from_f64(0.0) && x < unity) {
        let is_flat = x == S::from_f64(0.0) && a == unity || x == unity && b == unity;
        return if is_flat { -log_norm() } else { S::from_f64(f64::NEG_INFINITY) };
    }
    let log_norm = log_norm();
    (a - unity) * x.ln() + (b - unity) * (-x).ln_1p() - log_norm
}

/// `X / (X + Y)` of two gamma draws, by their logarithms: with small `a` and `b` both underflow.
#[inline(never)]
pub(super) fn beta_sample(a: f64, b: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let log_ratio = log_gamma_draw(a, rng) - log_gamma_draw(b, rng);
    let x = if log_ratio < 0.0 {
        log_ratio.exp() / (1.0 + log_ratio.exp())
    } else if log_ratio < 30.0 {
        1.0 / (1.0 + (-log_ratio).exp())
    } else {
        // The distance from one keeps the digits.
        1.0 - (-log_ratio).exp()
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
    fn ends_have_the_finite_limit_of_the_density() {
        let at = |family, parameters: &[f64], x: f64| dist(family, parameters).log_density(&Draw::Real(x));
        assert_eq!(at(Family::Beta, &[1.0, 1.0], 0.0), 0.0);
        assert_eq!(at(Family::Beta, &[1.0, 1.0], 1.0), 0.0);
        assert!((at(Family::Beta, &[1.0, 3.0], 0.0) - 3.0_f64.ln()).abs() < 1e-12);
        assert_eq!(at(Family::Gamma, &[1.0, 2.0], 0.0), -(2.0_f64.ln()));
        assert_eq!(at(Family::Exponential, &[1.0], 0.0), 0.0);
        assert_eq!(at(Family::Uniform, &[0.0, 1.0], 1.0), 0.0);
        // The limit is zero or infinite: the end is outside.
        for (family, parameters, x) in [
            (Family::Beta, &[1.0, 3.0][..], 1.0),
            (Family::Beta, &[0.5, 1.0], 0.0),
            (Family::Gamma, &[2.0, 1.0], 0.0),
            (Family::Gamma, &[0.5, 1.0], 0.0),
            (Family::InverseGamma, &[1.0, 1.0], 0.0),
            (Family::LogNormal, &[0.0, 1.0], 0.0),
        ] {
            assert_eq!(at(family, parameters, x), f64::NEG_INFINITY, "{family}");
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
        // 200 fair coins stay within 100 +- 40, except with probability 2e-8.
        assert!((60..=140).contains(&low), "{low}");
    }
}
