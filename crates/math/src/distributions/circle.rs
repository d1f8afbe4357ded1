//! von_mises: the bell curve of angles.

use crate::scalar::Scalar;
use crate::streams::{RngCore, open_unit};
use std::f64::consts::{PI, TAU};

/// `k cos(x - mean) - ln(2 pi I_0(k))` for angles within half a turn of zero.
///
/// The density is written relative to its peak, `-2 k sin^2((x - mean) / 2) - ln(2 pi exp(-k) I_0(k))`, so that a large `k`
/// loses no digits.
#[inline(never)]
pub(super) fn log_density<S: Scalar>(mean: S, concentration: S, x: S) -> S {
    if x.abs() > S::from_f64(PI) || x.value().is_nan() {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let sin = ((x - mean) * S::from_f64(0.5)).sin();
    concentration * sin * sin * S::from_f64(-2.0) - concentration.ln_bessel_i0e() - S::from_f64(TAU.ln())
}

/// Best & Fisher 1979, section 2, in which the wrapped Cauchy proposal has `s = (1 + sqrt(1 + 4 k^2)) / (2 k)`.
///
/// This code writes everything with `s - 1`, `1 - cos` and `1 - f`, which stay exact for any `k`.
#[inline(never)]
pub(super) fn sample(mean: f64, concentration: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let k = concentration;
    if k < 1e-12 {
        return TAU * open_unit(rng) - PI;
    }
    let root = 1.0_f64.hypot(2.0 * k);
    // Halves, because `2 k` may overflow.
    let above_one = (0.5 + 0.5 / (root + 2.0 * k)) / k;
    let angle = loop {
        let half_sin = (0.5 * PI * open_unit(rng)).sin();
        let one_less_z = 2.0 * half_sin * half_sin;
        let one_less_f = above_one * one_less_z / (above_one + 2.0 - one_less_z);
        let c = k * (above_one + one_less_f);
        let u = open_unit(rng);
        if c * (2.0 - c) > u || (c / u).ln() + 1.0 - c >= 0.0 {
            break 2.0 * (0.5 * one_less_f).sqrt().min(1.0).asin();
        }
    };
    let signed = if rng.next_u64() >> 63 == 0 { angle } else { -angle };
    wrap(mean + signed)
}

/// The angle moved by whole turns to within half a turn of zero.
fn wrap(angle: f64) -> f64 {
    let turn = angle - TAU * (angle / TAU).round();
    turn.clamp(-PI, PI)
}

#[cfg(test)]
mod tests {
    //! Densities integrate to one over the circle, and draws follow them, for any concentration.
    use super::super::testing::*;
    use crate::{Draw, Family, Stream};
    use std::f64::consts::PI;

    #[test]
    fn draws_follow_the_density() {
        for (mean, k) in [(0.0, 0.0), (1.0, 1e-9), (3.0, 0.5), (-2.0, 4.0), (0.3, 60.0), (9.0, 700.0)] {
            continuous_agrees(&dist(Family::VonMises, &[mean, k]), -PI, PI);
        }
        let narrow = dist(Family::VonMises, &[0.5, 1e12]);
        continuous_agrees(&narrow, 0.5 - 1.2e-5, 0.5 + 1.2e-5);
    }

    #[test]
    fn the_largest_concentration_draws_the_mean() {
        let narrow = dist(Family::VonMises, &[0.5, f64::MAX]);
        let mut draws = Stream::new(1, 0, 7, 0);
        for _ in 0..100 {
            let Draw::Real(x) = narrow.sample(&mut draws) else { panic!("an angle") };
            assert_eq!(x, 0.5);
            assert!(narrow.log_density(&Draw::Real(x)) > 0.0);
        }
    }

    #[test]
    fn angles_beyond_half_a_turn_have_no_density() {
        assert_eq!(dist(Family::VonMises, &[0.0, 1.0]).log_density(&Draw::Real(3.2)), f64::NEG_INFINITY);
    }
}
