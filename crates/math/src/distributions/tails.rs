//! Families with heavier tails than the bell curve: laplace, cauchy, student_t.

use super::waiting::log_gamma_draw;
use crate::scalar::Scalar;
use crate::special::ln_gamma_half_step;
use crate::streams::{RngCore, open_unit};
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::PI;

/// `-|x - loc| / scale - ln(2 scale)`.
#[inline]
pub(super) fn laplace_log_density<S: Scalar>(loc: S, scale: S, x: S) -> S {
    -((x - loc) / scale).abs() - scale.ln() - S::from_f64(std::f64::consts::LN_2)
}

/// A draw by inversion from the nearer end, so that both tails keep their digits.
#[inline]
pub(super) fn laplace_sample(loc: f64, scale: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let u = open_unit(rng);
    let z = if u < 0.5 { (2.0 * u).ln() } else { -(2.0 * (1.0 - u)).ln() };
    (loc + scale * z).clamp(f64::MIN, f64::MAX)
}

/// `-ln(1 + z^2) - ln(pi scale)` with `z = (x - loc) / scale`.
#[inline]
pub(super) fn cauchy_log_density<S: Scalar>(loc: S, scale: S, x: S) -> S {
    -ln_1p_square(x - loc, scale) - scale.ln() - S::from_f64(PI.ln())
}

/// `ln(1 + (distance / unit)^2)`, also if the quotient or its square would overflow.
#[inline]
fn ln_1p_square<S: Scalar>(distance: S, unit: S) -> S {
    let z = distance / unit;
    if z.value().abs() < 1e100 {
        (z * z).ln_1p()
    } else {
        S::from_f64(2.0) * (distance.abs().ln() - unit.ln())
    }
}

/// The tangent of a uniform angle.
#[inline(never)]
pub(super) fn cauchy_sample(loc: f64, scale: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    (loc + scale * (PI * (open_unit(rng) - 0.5)).tan()).clamp(f64::MIN, f64::MAX)
}

/// `ln gamma((df + 1) / 2) - ln gamma(df / 2) - ln(pi df) / 2 - ln scale - (df + 1) / 2 ln(1 + z^2 / df)`.
#[inline(never)]
pub(super) fn student_t_log_density<S: Scalar>(df: S, loc: S, scale: S, x: S) -> S {
    let c = S::from_f64;
    let half = c(0.5);
    let log_norm = ln_gamma_half_step(half * df) - half * (c(PI) * df).ln() - scale.ln();
    log_norm - half * (df + c(1.0)) * ln_1p_square(x - loc, scale * df.sqrt())
}

/// A standard Gaussian divided by the root of an independent chi-square's mean.
#[inline(never)]
pub(super) fn student_t_sample(df: f64, loc: f64, scale: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let z: f64 = StandardNormal.sample(rng);
    let log_gamma = log_gamma_draw(0.5 * df, rng);
    let stretch = (0.5 * ((0.5 * df).ln() - log_gamma)).exp().min(f64::MAX);
    (loc + scale * (z * stretch)).clamp(f64::MIN, f64::MAX)
}

#[cfg(test)]
mod tests {
    //! Densities integrate to one, and draws follow them.
    use super::super::testing::*;
    use crate::{Draw, Family};

    #[test]
    fn draws_follow_the_density() {
        continuous_agrees(&dist(Family::Laplace, &[1.0, 0.5]), -20.0, 22.0);
        continuous_agrees(&dist(Family::StudentT, &[9.0, 1.0, 2.0]), -400.0, 402.0);
        continuous_agrees(&dist(Family::StudentT, &[1e12, 0.0, 1.0]), -12.0, 12.0);
    }

    #[test]
    fn one_degree_of_freedom_is_cauchy() {
        let (t, cauchy) = (dist(Family::StudentT, &[1.0, 0.5, 2.0]), dist(Family::Cauchy, &[0.5, 2.0]));
        for x in [-1e200, -3.0, 0.5, 0.7, 1e9, 1e300] {
            let x = Draw::Real(x);
            assert!(
                (t.log_density(&x) - cauchy.log_density(&x)).abs() < 1e-12 * cauchy.log_density(&x).abs()
            );
        }
    }

    #[test]
    fn a_cauchy_has_half_its_mass_within_one_scale() {
        // 10000 fair coins stay within 5000 +- 250, except with probability 6e-7.
        let d = dist(Family::Cauchy, &[3.0, 2.0]);
        let inside = (0..10_000)
            .filter(|k| matches!(d.sample(&mut stream(*k)), Draw::Real(x) if (x - 3.0).abs() < 2.0));
        assert!((4750..=5250).contains(&inside.count()));
    }
}
