//! The special functions that the crates in use lack, or compute with a loss of digits.

use crate::scalar::Scalar;
use std::f64::consts::TAU;

/// `ln(exp(-|x|) I_0(x))`, the scaled modified Bessel function of order zero.
///
/// Below 20 the power series `sum (x^2/4)^k / k!^2` (all terms positive: no cancellation); from 20 on the
/// asymptotic series (Abramowitz & Stegun 9.7.1), whose smallest term there is below 1e-17.
pub fn ln_bessel_i0e(x: f64) -> f64 {
    let x = x.abs();
    let (mut term, mut sum) = (1.0, 1.0);
    if x < 20.0 {
        let quarter = 0.25 * x * x;
        let mut k = 1.0;
        while term > 1e-18 * sum {
            term *= quarter / (k * k);
            sum += term;
            k += 1.0;
        }
        sum.ln() - x
    } else {
        for k in 1..40 {
            let odd = f64::from(2 * k - 1);
            term *= odd * odd / (8.0 * x * f64::from(k));
            sum += term;
            if term < 1e-18 {
                break;
            }
        }
        sum.ln() - 0.5 * (TAU * x).ln()
    }
}

/// `ln gamma(x + 1/2) - ln gamma(x)` for positive `x`.
///
/// From 50 on by its own asymptotic series, since the two logarithms grow without bound while their
/// difference does not: at `x = 1e10` subtracting them keeps five digits.
pub fn ln_gamma_half_step<S: Scalar>(x: S) -> S {
    let c = S::from_f64;
    if x < c(50.0) {
        return (x + c(0.5)).ln_gamma() - x.ln_gamma();
    }
    let r = c(1.0) / x;
    let r2 = r * r;
    c(0.5) * x.ln()
        + r * (c(-1.0 / 8.0) + r2 * (c(1.0 / 192.0) + r2 * (c(-1.0 / 640.0) + r2 * c(17.0 / 14336.0))))
}

/// Ten-point Gauss-Legendre rule on `[-1, 1]`: (node, weight), one of each symmetric pair.
const GAUSS_LEGENDRE: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Integral of a smooth function over `[0, width]` by ten points.
pub fn integrate<S: Scalar>(width: S, f: impl Fn(S) -> S) -> S {
    let half = width * S::from_f64(0.5);
    let mut sum = S::from_f64(0.0);
    for (node, weight) in GAUSS_LEGENDRE {
        let pair = f(half * S::from_f64(1.0 - node)) + f(half * S::from_f64(1.0 + node));
        sum = sum + pair * S::from_f64(weight);
    }
    sum * half
}

#[cfg(test)]
mod tests {
    //! Each function agrees with a second method.
    use super::*;

    #[test]
    fn bessel_agrees_with_its_integral_and_across_the_seam() {
        // I_0(x) exp(-x) = 1/pi integral of exp(x (cos t - 1)) over [0, pi]; periodic, so the midpoint rule
        // converges geometrically.
        for x in [0.0, 0.3, 5.0, 19.999, 20.0, 80.0, 700.0] {
            let n = 4000;
            let mean: f64 = (0..n)
                .map(|k| (x * ((std::f64::consts::PI * (k as f64 + 0.5) / n as f64).cos() - 1.0)).exp())
                .sum::<f64>()
                / n as f64;
            assert!((ln_bessel_i0e(x) - mean.ln()).abs() < 1e-13, "{x}");
        }
        assert!((ln_bessel_i0e(1e12) + 0.5 * (TAU * 1e12_f64).ln()).abs() < 1e-12);
    }

    #[test]
    fn half_steps_of_ln_gamma_agree_across_the_seam() {
        for x in [50.0, 60.0, 200.0] {
            let plain = libm::lgamma(x + 0.5) - libm::lgamma(x);
            assert!((ln_gamma_half_step(x) - plain).abs() < 2e-13 * libm::lgamma(x), "{x}");
        }
    }

    #[test]
    fn ten_points_integrate_degree_nineteen_exactly() {
        let got = integrate(2.0_f64, |t| t.powi(19));
        assert!((got / (2.0_f64.powi(20) / 20.0) - 1.0).abs() < 1e-14);
    }
}
