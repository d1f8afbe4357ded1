//! Functions over many numbers: `exp`, `log`, `pow`, `sin`, `cos` without branches, so that the compiler makes vector
//! code of the loops; other functions number by number.
//!
//! The code is compiled for AVX-512, for AVX2 and for any processor, and chosen at run time. It uses only additions,
//! multiplications and divisions in a fixed order, none fused, so the bits are equal on every machine. Errors are below one
//! unit in the last place for `exp` and `log`; `pow` is `exp(b log a)`, which loses about `|b log a|` units.

#![allow(unsafe_code)] // Calls of functions compiled for AVX2 or AVX-512, after a test of the processor.

use crate::operation::{Op, apply, max, min};

/// 1.5 * 2^52: adding and subtracting it rounds to a whole number, whose bits are then the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
const LN2_HI: f64 = 6.931_471_803_691_238e-1;
const LN2_LO: f64 = 1.908_214_929_270_587_7e-10;

/// The exponential. Reduction by Cody & Waite; Taylor series to the 13th power on half of `ln 2`.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    let x = if x > 710.0 { 710.0 } else { x };
    let x = if x < -746.0 { -746.0 } else { x };
    let k = (x * std::f64::consts::LOG2_E + ROUND) - ROUND;
    let r = (x - k * LN2_HI) - k * LN2_LO;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (1.0 / 2.0 + r * (1.0 / 6.0)) + r2 * (1.0 / 24.0 + r * (1.0 / 120.0));
    let mid = (1.0 / 720.0 + r * (1.0 / 5040.0)) + r2 * (1.0 / 40320.0 + r * (1.0 / 362_880.0));
    let high = (1.0 / 3_628_800.0 + r * (1.0 / 39_916_800.0))
        + r2 * (1.0 / 479_001_600.0 + r * (1.0 / 6_227_020_800.0));
    let p = 1.0 + (r + r2 * (low + r4 * (mid + r4 * high)));
    // 2^k in two factors, since a single factor would overflow or underflow too early.
    let half = (k * 0.5 + ROUND) - ROUND;
    let power = |n: f64| f64::from_bits(((n + ROUND).to_bits() << 52).wrapping_add(1023 << 52));
    p * power(half) * power(k - half)
}

/// Natural logarithm, by the method of fdlibm: `log(1 + f)` as a series in `f / (2 + f)`.
#[inline(always)]
pub(crate) fn log(x: f64) -> f64 {
    const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    let tiny = x < f64::MIN_POSITIVE;
    let scaled = if tiny { x * 18_014_398_509_481_984.0 } else { x };
    let bits = scaled.to_bits();
    // The exponent, raised by 2048 so that it is never negative, as the mantissa of a float.
    let exponent = bits.wrapping_sub(SQRT_HALF).wrapping_add(2048 << 52) >> 52;
    let k = f64::from_bits((exponent & 0xfff) | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 2048.0);
    let m = f64::from_bits(bits.wrapping_sub((exponent.wrapping_sub(2048)) << 52));
    let k = if tiny { k - 54.0 } else { k };
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let t1 =
        w * (3.999_999_999_940_942e-1 + w * (2.222_219_843_214_978_4e-1 + w * 1.531_383_769_920_937_3e-1));
    let t2 = z
        * (6.666_666_666_666_735e-1
            + w * (2.857_142_874_366_239e-1
                + w * (1.818_357_216_161_805e-1 + w * 1.479_819_860_511_658_6e-1)));
    let square = 0.5 * f * f;
    let y = k * LN2_HI - ((square - (s * (square + (t1 + t2)) + k * LN2_LO)) - f);
    let y = if x == 0.0 { f64::NEG_INFINITY } else { y };
    let y = if x < 0.0 { f64::NAN } else { y };
    if x < f64::INFINITY { y } else { x }
}

/// `a` to the power `b`, `a` not negative.
#[inline(always)]
pub(crate) fn pow(a: f64, b: f64) -> f64 {
    exp(b * log(a))
}

/// Sine and cosine for angles up to 1e5; reduction to an eighth of a turn by `pi / 2` in three parts.
#[inline(always)]
fn sin_cos(x: f64) -> (f64, f64, u64) {
    let k = (x * std::f64::consts::FRAC_2_PI + ROUND) - ROUND;
    let r =
        ((x - k * 1.570_796_326_734_125_6) - k * 6.077_100_506_303_966e-11) - k * 2.022_266_248_795_950_6e-21;
    let z = r * r;
    let sin = r + r
        * z
        * (-1.666_666_666_666_663_2e-1
            + z * (8.333_333_333_322_49e-3
                + z * (-1.984_126_982_985_795e-4
                    + z * (2.755_731_370_707_006_8e-6
                        + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10)))));
    let cos = 1.0 - 0.5 * z
        + z * z
            * (4.166_666_666_666_66e-2
                + z * (-1.388_888_888_887_411e-3
                    + z * (2.480_158_728_947_673e-5
                        + z * (-2.755_731_435_139_066_3e-7
                            + z * (2.087_572_321_298_175e-9 - z * 1.135_964_755_778_819_5e-11)))));
    (sin, cos, (k + ROUND).to_bits())
}

#[inline(always)]
fn sin(x: f64) -> f64 {
    let (s, c, quarter) = sin_cos(x);
    let y = if quarter & 1 == 0 { s } else { c };
    if quarter & 2 == 0 { y } else { -y }
}

#[inline(always)]
fn cos(x: f64) -> f64 {
    let (s, c, quarter) = sin_cos(x);
    let y = if quarter & 1 == 0 { c } else { s };
    if quarter.wrapping_add(1) & 2 == 0 { y } else { -y }
}

/// Largest angle by this reduction; beyond it the three parts of `pi / 2` lose digits.
const LARGEST_ANGLE: f64 = 1e5;

macro_rules! one {
    ($f:expr, $a:expr, $to:expr) => {
        for (to, a) in $to.iter_mut().zip($a) {
            *to = $f(*a);
        }
    };
}
macro_rules! two {
    ($f:expr, $a:expr, $b:expr, $to:expr) => {
        for (to, (a, b)) in $to.iter_mut().zip($a.iter().zip($b)) {
            *to = $f(*a, *b);
        }
    };
}

/// Replaces the results of larger angles one by one, so that the result of an angle never depends on its neighbours.
#[inline(always)]
fn large_angles(f: fn(f64) -> f64, a: &[f64], to: &mut [f64]) {
    let small = a.iter().fold(true, |all, a| all & (a.abs() < LARGEST_ANGLE));
    if small {
        return;
    }
    for (to, a) in to.iter_mut().zip(a) {
        if a.is_nan() || a.abs() >= LARGEST_ANGLE {
            *to = f(*a);
        }
    }
}

#[inline(always)]
pub(crate) fn any(op: Op, a: &[f64], b: &[f64], c: &[f64], to: &mut [f64]) {
    match op {
        Op::Add => two!(|a: f64, b: f64| a + b, a, b, to),
        Op::Sub => two!(|a: f64, b: f64| a - b, a, b, to),
        Op::Mul => two!(|a: f64, b: f64| a * b, a, b, to),
        Op::Div => two!(|a: f64, b: f64| a / b, a, b, to),
        Op::Neg => one!(|a: f64| -a, a, to),
        Op::Sqrt => one!(f64::sqrt, a, to),
        Op::Round => one!(f64::round_ties_even, a, to),
        Op::Abs => one!(f64::abs, a, to),
        Op::Min => two!(min, a, b, to),
        Op::Max => two!(max, a, b, to),
        Op::Less => two!(|a: f64, b: f64| if a < b { 1.0 } else { 0.0 }, a, b, to),
        Op::Select => {
            for (k, to) in to.iter_mut().enumerate() {
                *to = if a[k] != 0.0 { b[k] } else { c[k] };
            }
        }
        Op::Exp => one!(exp, a, to),
        Op::Log => one!(log, a, to),
        Op::Pow => two!(pow, a, b, to),
        Op::Sin => {
            one!(sin, a, to);
            large_angles(libm::sin, a, to);
        }
        Op::Cos => {
            one!(cos, a, to);
            large_angles(libm::cos, a, to);
        }
        op if op.arity() == 2 => two!(|a, b| apply(op, a, b, 0.0), a, b, to),
        op => one!(|a| apply(op, a, 0.0, 0.0), a, to),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn any_avx2(op: Op, a: &[f64], b: &[f64], c: &[f64], to: &mut [f64]) {
    any(op, a, b, c, to);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn any_avx512(op: Op, a: &[f64], b: &[f64], c: &[f64], to: &mut [f64]) {
    any(op, a, b, c, to);
}

/// The widest vectors of this processor for which code was compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vectors {
    /// 512 bits.
    Avx512,
    /// 256 bits.
    Avx2,
    /// The vectors of any processor.
    Any,
}

impl Vectors {
    /// The widest vectors available; detected once.
    #[inline]
    pub fn here() -> Vectors {
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::is_x86_feature_detected as has;
            if has!("avx512f") && has!("avx512dq") && has!("avx512vl") && has!("avx512bw") {
                return Vectors::Avx512;
            }
            if has!("avx2") {
                return Vectors::Avx2;
            }
        }
        Vectors::Any
    }
}

/// `to[k] = op(a[k], b[k], c[k])`. Slices of arguments that the operation does not have may be empty.
///
/// # Panics
/// If the slices of a select are shorter than `to`.
#[inline]
pub fn apply_all(op: Op, a: &[f64], b: &[f64], c: &[f64], to: &mut [f64]) {
    match Vectors::here() {
        // SAFETY: the processor has AVX-512.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { any_avx512(op, a, b, c, to) },
        // SAFETY: the processor has AVX2.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { any_avx2(op, a, b, c, to) },
        _ => any(op, a, b, c, to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(name: &str, x: f64, actual: f64, expected: f64, units: f64) {
        let are_equal = actual == expected || actual.is_nan() && expected.is_nan();
        let size = expected.abs().max(f64::MIN_POSITIVE);
        assert!(
            are_equal || (actual - expected).abs() <= units * f64::EPSILON * size,
            "{name}({x}): {actual} {expected}"
        );
    }

    #[test]
    fn kernels_agree_with_libm_over_their_domains() {
        let mut x = -750.0;
        while x < 715.0 {
            // Below, results are subnormal, so the error is absolute.
            close("exp", x, exp(x), libm::exp(x), if x < -708.0 { 1e16 } else { 1.0 });
            x += 0.0137;
        }
        for x in [5e-324, 1e-320, 3e-310, 2.3e-308] {
            close("log", x, log(x), libm::log(x), 1.0);
        }
        let mut x = 1e-300;
        while x < 1e308 {
            close("log", x, log(x), libm::log(x), 1.0);
            close("pow", x, pow(x, 0.3), libm::pow(x, 0.3), 250.0);
            x *= 1.0037;
        }
        for k in -2000..2000 {
            let x = 1.0 + f64::from(k) * 1e-4;
            close("log", x, log(x), libm::log(x), 1.0);
            let x = f64::from(k) * 0.37;
            let near = |a: f64, b: f64| (a - b).abs() < 2e-16;
            assert!(
                near(sin(x), libm::sin(x)) && near(cos(x), libm::cos(x)),
                "{x} {} {}",
                sin(x),
                libm::sin(x)
            );
        }
    }

    #[test]
    fn ends_of_the_line_agree_with_libm() {
        for x in [0.0, -0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 710.5, -800.0] {
            close("exp", x, exp(x), libm::exp(x), 1.0);
            close("log", x, log(x), libm::log(x), 1.0);
        }
        assert_eq!(pow(0.0, 2.0), 0.0);
        assert!(pow(-1.0, 0.5).is_nan());
        let mut to = [0.0; 2];
        apply_all(Op::Sin, &[1e9, f64::INFINITY], &[], &[], &mut to);
        assert!(to[0] == libm::sin(1e9) && to[1].is_nan());
        // A neighbour beyond the reduction changes nothing.
        let (mut alone, mut beside) = ([0.0; 1], [0.0; 2]);
        for op in [Op::Sin, Op::Cos] {
            for k in 0..1000 {
                let x = f64::from(k) * 1.7;
                apply_all(op, &[x], &[], &[], &mut alone);
                apply_all(op, &[x, 1e9], &[], &[], &mut beside);
                assert_eq!(alone[0].to_bits(), beside[0].to_bits());
            }
        }
    }

    #[test]
    fn all_compilations_give_equal_bits() {
        let a: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.123).collect();
        for op in [Op::Exp, Op::Log, Op::Sin, Op::Cos, Op::Pow] {
            let (mut actual, mut expected) = (vec![0.0; 1000], vec![0.0; 1000]);
            apply_all(op, &a, &a, &[], &mut actual);
            any(op, &a, &a, &[], &mut expected);
            let has_equal_bits =
                |actual: &[f64]| actual.iter().zip(&expected).all(|(x, y)| x.to_bits() == y.to_bits());
            assert!(has_equal_bits(&actual), "{op:?}");
            #[cfg(target_arch = "x86_64")]
            if Vectors::here() != Vectors::Any {
                // SAFETY: the processor has AVX2, or what holds it.
                unsafe { any_avx2(op, &a, &a, &[], &mut actual) };
                assert!(has_equal_bits(&actual), "{op:?}");
            }
        }
    }
}
