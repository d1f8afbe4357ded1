//! The bell curve: gaussian, and log_normal, whose logarithm is gaussian.

use crate::scalar::Scalar;
use crate::streams::RngCore;
use rand_distr::{Distribution, StandardNormal};

/// `ln(2 pi) / 2`.
pub(super) const HALF_LN_TAU: f64 = 0.918_938_533_204_672_7;

/// `-z^2 / 2 - ln sd - ln(2 pi) / 2` with `z = (x - mean) / sd`.
#[inline]
pub(super) fn gaussian_log_density<S: Scalar>(mean: S, sd: S, x: S) -> S {
    gaussian_log_density_with(mean, sd, sd.ln(), x)
}

/// [`gaussian_log_density`] for a known logarithm of the deviation.
#[inline(always)]
pub(super) fn gaussian_log_density_with<S: Scalar>(mean: S, sd: S, log_sd: S, x: S) -> S {
    let z = (x - mean) / sd;
    S::from_f64(-0.5) * z * z - log_sd - S::from_f64(HALF_LN_TAU)
}

/// A draw of `rand_distr`'s ziggurat, moved and scaled.
#[inline]
pub(super) fn gaussian_sample(mean: f64, sd: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let z: f64 = StandardNormal.sample(rng);
    (mean + sd * z).clamp(f64::MIN, f64::MAX)
}

/// The Gaussian density of `ln x`, times the Jacobian `1 / x`.
#[inline]
pub(super) fn log_normal_log_density<S: Scalar>(mean: S, sd: S, x: S) -> S {
    if x <= S::from_f64(0.0) {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let log = x.ln();
    gaussian_log_density(mean, sd, log) - log
}

/// Whether every draw has a score. The logarithm of a draw is rounded, and at most 745 for the largest number of 64 bits, which
/// stands for all draws beyond. The square of its distance from `mean`, in units of `sd`, must be a number.
#[inline]
pub(super) fn log_normal_has_scores<S: Scalar>(mean: S, sd: S) -> bool {
    (mean.abs() + S::from_f64(745.0)) / sd <= S::from_f64(1e150)
}

/// The exponential of a Gaussian draw.
#[inline]
pub(super) fn log_normal_sample(mean: f64, sd: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    gaussian_sample(mean, sd, rng).exp().clamp(f64::MIN_POSITIVE, f64::MAX)
}

#[cfg(test)]
mod tests {
    //! Densities integrate to one, and draws have the distribution function of the integral.
    use super::super::testing::*;
    use crate::{Dist, Draw, Family, Param};

    #[test]
    fn draws_follow_the_density() {
        for (mean, sd) in [(0.0, 1.0), (-3.0, 0.01), (1e6, 250.0)] {
            continuous_agrees(&dist(Family::Gaussian, &[mean, sd]), mean - 12.0 * sd, mean + 12.0 * sd);
        }
        continuous_agrees(&dist(Family::LogNormal, &[0.5, 0.4]), 0.0, 60.0);
    }

    #[test]
    fn draws_beyond_the_floats_are_the_last_float() {
        let wide = dist(Family::LogNormal, &[0.0, 1e6]);
        for k in 0..50 {
            let x = wide.sample(&mut stream(k));
            assert!(wide.log_density(&x).is_finite());
        }
        assert_eq!(wide.log_density(&Draw::Real(f64::INFINITY)), f64::NEG_INFINITY);
    }

    #[test]
    fn means_whose_draws_have_no_score_are_refused() {
        let new = |mean, sd| Dist::new(Family::LogNormal, &[Param::Real(mean), Param::Real(sd)]);
        assert!(new(1e277, 2.4).is_err() && Dist::of_reals(Family::LogNormal, -1e277, 2.4).is_none());
        for (mean, sd) in [(1e100, 1.0), (-1e149, 1.0), (-700.0, 1e-10), (0.3, 1e-147)] {
            let far = new(mean, sd).unwrap();
            assert!(far.log_density(&far.sample(&mut stream(1))).is_finite(), "{mean} {sd}");
        }
    }
}
