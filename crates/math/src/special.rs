//! Special functions that the libraries in use lack, or compute with a loss of digits.

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
/// From 50 on, an asymptotic series of the difference: the two logarithms grow without bound while their
/// difference does not, so at `x = 1e10` their subtraction keeps five digits.
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

/// The probability that a standard Gaussian exceeds `z`; no digits are lost in the upper tail.
pub fn normal_tail(z: f64) -> f64 {
    0.5 * libm::erfc(z * std::f64::consts::FRAC_1_SQRT_2)
}

/// `c[0] + c[1] x + c[2] x^2 + ...`.
fn polynomial<const N: usize>(c: [f64; N], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// The quantile of the standard Gaussian at probability `p`; minus infinity at 0, plus infinity at 1.
///
/// Rational approximations of Wichura 1988 (algorithm AS 241, PPND16), relative error about 1e-16. For an upper tail,
/// pass the tail's probability and reverse the sign of the result.
pub fn normal_quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * polynomial(CENTER.0, r) / polynomial(CENTER.1, r);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    if tail <= 0.0 {
        return if q < 0.0 { f64::NEG_INFINITY } else { f64::INFINITY };
    }
    let r = (-tail.ln()).sqrt();
    let size = if r <= 5.0 {
        polynomial(NEAR.0, r - 1.6) / polynomial(NEAR.1, r - 1.6)
    } else {
        polynomial(FAR.0, r - 5.0) / polynomial(FAR.1, r - 5.0)
    };
    if q < 0.0 { -size } else { size }
}

/// Numerator and denominator of AS 241 for `p` within 0.425 of a half.
const CENTER: ([f64; 8], [f64; 8]) = (
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
);
/// Numerator and denominator of AS 241 for tails down to `exp(-25)`.
const NEAR: ([f64; 8], [f64; 8]) = (
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
);
/// Numerator and denominator of AS 241 for tails below `exp(-25)`.
const FAR: ([f64; 8], [f64; 8]) = (
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        1.242_660_947_388_078_4e-3,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
);

/// Ten-point Gauss-Legendre rule on `[-1, 1]`: (node, weight) of one node of each symmetric pair.
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
        let integral = integrate(2.0_f64, |t| t.powi(19));
        assert!((integral / (2.0_f64.powi(20) / 20.0) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn quantiles_of_the_bell_curve_undo_its_tails() {
        assert_eq!(normal_tail(0.0), 0.5);
        assert_eq!((normal_quantile(0.0), normal_quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
        for k in 0..=740 {
            let z = -37.0 + 0.05 * f64::from(k);
            // The tolerance is the change of z when the tail changes by one part in 2^52; it falls as z moves out.
            let back = normal_quantile(normal_tail(-z));
            assert!((back - z).abs() < 4e-15 * z.abs().max(1.0), "{z} {back}");
        }
        for p in [0.3, 0.07, 0.93, 1e-3] {
            assert!((normal_quantile(p) + normal_quantile(1.0 - p)).abs() < 1e-13, "{p}");
        }
        // The tail beyond 2 is the integral of the density.
        let density = |t: f64| (-0.5 * t * t).exp() / TAU.sqrt();
        let sum: f64 = (0..80).map(|k| integrate(0.5, |t| density(2.0 + 0.5 * f64::from(k) + t))).sum();
        assert!((normal_tail(2.0) / sum - 1.0).abs() < 1e-14);
    }
}
