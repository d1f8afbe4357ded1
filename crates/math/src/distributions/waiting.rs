//! Waiting times: exponential, gamma, inverse_gamma; and the logarithm of a gamma draw, which other families use.

use crate::scalar::Scalar;
use crate::streams::{RngCore, open_unit};
use rand_distr::{Distribution, Exp1};

/// `ln rate - rate x`.
#[inline]
pub(super) fn exponential_log_density<S: Scalar>(rate: S, x: S) -> S {
    if x < S::from_f64(0.0) { S::from_f64(f64::NEG_INFINITY) } else { rate.ln() - rate * x }
}

/// A draw of `rand_distr`'s ziggurat, scaled.
#[inline]
pub(super) fn exponential_sample(rate: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let e: f64 = Exp1.sample(rng);
    (e / rate).min(f64::MAX)
}

/// `(shape - 1) ln x - x / scale - shape ln scale - ln gamma(shape)`.
#[inline]
pub(super) fn gamma_log_density<S: Scalar>(shape: S, scale: S, x: S) -> S {
    if x <= S::from_f64(0.0) {
        // With shape 1, an exponential, the density at zero is finite.
        let is_exponential = x == S::from_f64(0.0) && shape == S::from_f64(1.0);
        return if is_exponential { -scale.ln() } else { S::from_f64(f64::NEG_INFINITY) };
    }
    gamma_log_density_at(shape, scale, x, x.ln())
}

/// [`gamma_log_density`] above zero, for a known logarithm of `x`.
#[inline]
pub(super) fn gamma_log_density_at<S: Scalar>(shape: S, scale: S, x: S, log_x: S) -> S {
    // Two logarithms, since the quotient may underflow.
    let log = log_x - scale.ln();
    (shape - S::from_f64(1.0)) * log - x / scale - scale.ln() - shape.ln_gamma()
}

/// The logarithm of a gamma draw of scale one: small shapes draw numbers far below the smallest float.
///
/// A shape below one is raised by one and the draw multiplied by `u^(1 / shape)` (Marsaglia & Tsang 2000,
/// section 6).
#[inline(never)]
pub(super) fn log_gamma_draw(shape: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let (raised, log_power) =
        if shape < 1.0 { (shape + 1.0, open_unit(rng).ln() / shape) } else { (shape, 0.0) };
    let g = rand_distr::Gamma::new(raised, 1.0).map_or(raised, |d| d.sample(rng));
    g.max(f64::MIN_POSITIVE).ln() + log_power
}

/// A draw of `rand_distr`'s sampler for a shape of at least one.
#[inline]
pub(super) fn gamma_draw(shape: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    rand_distr::Gamma::new(shape, 1.0).map_or(shape, |d| d.sample(rng)).max(f64::MIN_POSITIVE)
}

/// A draw of `rand_distr`'s sampler, scaled.
#[inline(never)]
pub(super) fn gamma_sample(shape: f64, scale: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let x = if shape < 1.0 {
        (log_gamma_draw(shape, rng) + scale.ln()).exp()
    } else {
        rand_distr::Gamma::new(shape, 1.0).map_or(shape, |d| d.sample(rng)) * scale
    };
    x.clamp(f64::MIN_POSITIVE, f64::MAX)
}

/// `shape ln scale - (shape + 1) ln x - scale / x - ln gamma(shape)`.
#[inline]
pub(super) fn inverse_gamma_log_density<S: Scalar>(shape: S, scale: S, x: S) -> S {
    if x <= S::from_f64(0.0) {
        return S::from_f64(f64::NEG_INFINITY);
    }
    inverse_gamma_log_density_at(shape, scale, x, x.ln())
}

/// [`inverse_gamma_log_density`] above zero, for a known logarithm of `x`.
#[inline]
pub(super) fn inverse_gamma_log_density_at<S: Scalar>(shape: S, scale: S, x: S, log_x: S) -> S {
    let log = scale.ln() - log_x;
    (shape + S::from_f64(1.0)) * log - scale / x - scale.ln() - shape.ln_gamma()
}

/// The quotient of `scale` and a gamma draw.
#[inline(never)]
pub(super) fn inverse_gamma_sample(shape: f64, scale: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    (scale.ln() - log_gamma_draw(shape, rng)).exp().clamp(f64::MIN_POSITIVE, f64::MAX)
}

#[cfg(test)]
mod tests {
    //! Densities integrate to one, and draws follow them.
    use super::super::testing::*;
    use crate::Family;

    #[test]
    fn draws_follow_the_density() {
        for rate in [0.02, 1.0, 1e4] {
            continuous_agrees(&dist(Family::Exponential, &[rate]), 0.0, 40.0 / rate);
        }
        for (shape, scale) in [(1.0, 2.0), (2.5, 0.1), (300.0, 1.0)] {
            continuous_agrees(
                &dist(Family::Gamma, &[shape, scale]),
                0.0,
                scale * (shape + 12.0 * shape.sqrt() + 40.0),
            );
        }
        continuous_agrees(&dist(Family::InverseGamma, &[6.0, 2.0]), 0.0, 300.0);
    }

    #[test]
    fn tiny_shapes_draw_positive_numbers() {
        for family in [Family::Gamma, Family::InverseGamma] {
            let d = dist(family, &[1e-3, 1.0]);
            for k in 0..100 {
                assert!(d.log_density(&d.sample(&mut stream(k))).is_finite());
            }
        }
    }
}
