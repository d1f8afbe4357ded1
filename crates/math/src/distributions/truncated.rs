//! truncated_gaussian: a Gaussian conditioned to lie between two bounds, also far out in its tail.
//!
//! In standard units `z = (x - mean) / sd` the bounds are `a < b`. If both are on one side (say `0 <= a`), everything is
//! computed relative to the near bound, not to the peak, which may be `exp(-1e300)` away:
//!
//! ```text
//! density = exp(-(z - a)(z + a) / 2) / (sqrt(2 pi) sd M),     M = exp(a^2 / 2) (Phi(b) - Phi(a))
//! M = (erfcx(a / sqrt 2) - exp(-(b - a)(a + b) / 2) erfcx(b / sqrt 2)) / 2
//! ```
//!
//! Quadrature gives `M` when that difference would cancel. Drawing: Robert 1995, "Simulation of truncated
//! normal variables", sections 2.1 and 2.2, with offsets from the near bound. Bounds below the mean are mirrored.

use super::bell::HALF_LN_TAU;
use crate::scalar::Scalar;
use crate::special::integrate;
use crate::streams::{RngCore, open_unit};
use rand_distr::{Distribution, Exp1, StandardNormal};
use std::f64::consts::FRAC_1_SQRT_2;

/// Whether the bounds in standard units, and twice their size, are finite.
pub(super) fn is_in_reach<S: Scalar>(mean: S, sd: S, lo: S, hi: S) -> bool {
    let is_near = |bound: S| ((bound - mean) / sd).abs() <= S::from_f64(1e307);
    is_near(lo) && is_near(hi)
}

/// Log density at `x`; the parameters are finite, `sd > 0`, `lo < hi`.
#[inline(never)]
pub(super) fn log_density<S: Scalar>(mean: S, sd: S, lo: S, hi: S, x: S) -> S {
    if !(x >= lo && x <= hi) {
        return S::from_f64(f64::NEG_INFINITY);
    }
    if hi <= mean {
        return one_side(-mean, sd, -hi, -lo, -x);
    }
    if lo >= mean {
        return one_side(mean, sd, lo, hi, x);
    }
    let c = S::from_f64;
    let z = (x - mean) / sd;
    // The error functions have opposite signs, so their difference is a sum.
    let up = ((hi - mean) / sd * c(FRAC_1_SQRT_2)).erf();
    let down = ((lo - mean) / sd * c(FRAC_1_SQRT_2)).erf();
    let mass = c(0.5) * (up - down);
    c(-0.5) * z * z - sd.ln() - c(HALF_LN_TAU) - mass.ln()
}

/// Log density if `mean <= lo`.
fn one_side<S: Scalar>(mean: S, sd: S, lo: S, hi: S, x: S) -> S {
    let c = S::from_f64;
    let (a, b, width) = ((lo - mean) / sd, (hi - mean) / sd, (hi - lo) / sd);
    let fall = |t: S| c(-0.5) * t * (a + a + t);
    // ln(sqrt(2 pi) M): the integral of exp(fall) over the width.
    let log_area = if width * (c(1.0) + a) < c(1.0) {
        integrate(width, |t| fall(t).exp()).ln()
    } else {
        let near = (a * c(FRAC_1_SQRT_2)).erfcx();
        let far = fall(width).exp() * (b * c(FRAC_1_SQRT_2)).erfcx();
        (c(0.5) * (near - far)).ln() + c(HALF_LN_TAU)
    };
    fall((x - lo) / sd) - sd.ln() - log_area
}

/// A draw; the parameters are finite, `sd > 0`, `lo < hi`.
#[inline(never)]
pub(super) fn sample(mean: f64, sd: f64, lo: f64, hi: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    let x = if hi <= mean {
        hi - sd * offset((mean - hi) / sd, (hi - lo) / sd, rng)
    } else if lo >= mean {
        lo + sd * offset((lo - mean) / sd, (hi - lo) / sd, rng)
    } else {
        mean + sd * around_the_peak((lo - mean) / sd, (hi - mean) / sd, rng)
    };
    x.clamp(lo, hi)
}

/// A standard Gaussian given `a <= z <= b` with `a < 0 < b`; at least one in four proposals is accepted.
fn around_the_peak(a: f64, b: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    if b - a < 2.5 {
        loop {
            let z = a + (b - a) * open_unit(rng);
            if open_unit(rng) < (-0.5 * z * z).exp() {
                return z;
            }
        }
    }
    loop {
        let z: f64 = StandardNormal.sample(rng);
        if a <= z && z <= b {
            return z;
        }
    }
}

/// `t = z - a` for a standard Gaussian given `0 <= a <= z <= a + width`.
fn offset(a: f64, width: f64, rng: &mut (impl RngCore + ?Sized)) -> f64 {
    // Robert's best rate of an exponential proposal from `a` on; `hypot`, since squares may overflow.
    let rate = 0.5 * (a + a.hypot(2.0));
    if rate * width < 1.5 {
        // The density falls by less than exp(-2.7) over the width, so a uniform proposal is good.
        loop {
            let t = width * open_unit(rng);
            if open_unit(rng) < (-0.5 * t * (a + a + t)).exp() {
                return t;
            }
        }
    }
    loop {
        let e: f64 = Exp1.sample(rng);
        let t = e / rate;
        let miss = a + t - rate;
        if t <= width && open_unit(rng) < (-0.5 * miss * miss).exp() {
            return t;
        }
    }
}

#[cfg(test)]
mod tests {
    //! Densities integrate to one and draws follow them, at the peak, beside it and far out.
    use super::super::testing::*;
    use crate::{Dist, Draw, Family, Param};

    fn truncated(mean: f64, sd: f64, lo: f64, hi: f64) -> Dist {
        dist(Family::TruncatedGaussian, &[mean, sd, lo, hi])
    }

    #[test]
    fn draws_follow_the_density() {
        let bounds = [
            (-1.0, 2.0),
            (-9.0, 0.3),
            (-0.1, 0.2),
            (0.0, 9.0),
            (0.0, 0.1),
            (2.0, 2.5),
            (8.0, 11.0),
            (-40.0, -38.0),
        ];
        for (lo, hi) in bounds {
            continuous_agrees(&truncated(0.0, 1.0, lo, hi), lo, hi);
            continuous_agrees(
                &truncated(5.0, 0.1, 5.0 + 0.1 * lo, 5.0 + 0.1 * hi),
                5.0 + 0.1 * lo,
                5.0 + 0.1 * hi,
            );
        }
        continuous_agrees(&truncated(0.0, 1.0, 1e5, 1e5 + 3e-4), 1e5, 1e5 + 3e-4);
    }

    #[test]
    fn the_two_formulas_for_the_mass_agree_at_their_seam() {
        // The density at the near bound is one over an area that changes by exp(fall) * 2e-9 across the seam.
        for a in [0.0, 0.7, 6.0, 30.0] {
            let width = 1.0 / (1.0 + a);
            let at = |w: f64| truncated(0.0, 1.0, a, a + w).log_density(&Draw::Real(a));
            let (below, above) = (at(width * (1.0 - 1e-9)), at(width * (1.0 + 1e-9)));
            assert!((below - above).abs() < 1e-8 && below >= above - 1e-12, "{a}: {below} {above}");
        }
    }

    #[test]
    fn far_out_the_density_is_exponential() {
        let d = truncated(0.0, 1.0, 1e8, 2e8);
        assert!((d.log_density(&Draw::Real(1e8)) - 1e8_f64.ln()).abs() < 1e-12);
        for k in 0..100 {
            let x = d.sample(&mut stream(k));
            assert!(d.log_density(&x).is_finite());
        }
        let absurd = truncated(0.0, 1e-100, 1e200, 2e200);
        assert!(absurd.log_density(&absurd.sample(&mut stream(1))) > 0.0);
    }

    #[test]
    fn mirrored_bounds_mirror_the_density() {
        for (lo, hi, x) in [(1.0, 4.0, 1.5), (-2.0, 5.0, 3.0), (30.0, 31.0, 30.01)] {
            let (right, left) = (truncated(0.0, 1.0, lo, hi), truncated(0.0, 1.0, -hi, -lo));
            assert_eq!(right.log_density(&Draw::Real(x)), left.log_density(&Draw::Real(-x)));
        }
    }

    #[test]
    fn bounds_out_of_reach_are_refused_and_far_bounds_work() {
        let new = |sd: f64| Dist::new(Family::TruncatedGaussian, &[0.5, sd, 1.0, 2.0].map(Param::Real));
        assert!(new(1e-307).is_err());
        let far = new(1e-299).unwrap();
        let draw = far.sample(&mut stream(1));
        assert!(draw == Draw::Real(1.0) && far.log_density(&draw).is_finite());
        let (moved, there, back) = far.moved(&draw, 0.3, &mut stream(2)).unwrap();
        assert!(
            (moved == draw || far.log_density(&moved) == f64::NEG_INFINITY)
                && !there.is_nan()
                && !back.is_nan()
        );
    }
}
