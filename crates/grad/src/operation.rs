//! The operations of a graph, and their values.
//!
//! All other parts of this crate (simplification, differentiation, tape, machine code, the JAX text) are tables over
//! [`Op`].

use libm::{asin, atan, log1p, tan};

/// The operation of a node of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum Op {
    /// A number.
    Constant,
    /// One of the unconstrained coordinates.
    Input,
    /// `a + b`.
    Add,
    /// `a - b`.
    Sub,
    /// `a * b`.
    Mul,
    /// `a / b`.
    Div,
    /// `-a`.
    Neg,
    /// Square root.
    Sqrt,
    /// The nearest whole number; of two equally near ones, the even one.
    Round,
    /// Distance from zero.
    Abs,
    /// The smaller of two; NaN if either is NaN.
    Min,
    /// The larger of two; NaN if either is NaN.
    Max,
    /// 1 if `a < b`, else 0.
    Less,
    /// `b` if `a` is not 0, else `c`. Both are computed, and the value of the other is ignored.
    Select,
    /// e to this power.
    Exp,
    /// Natural logarithm.
    Log,
    /// `log(1 + a)`.
    Log1p,
    /// `exp(a) - 1`.
    Expm1,
    /// Sine of radians.
    Sin,
    /// Cosine of radians.
    Cos,
    /// Tangent of radians.
    Tan,
    /// Angle with this sine.
    Asin,
    /// Angle with this cosine.
    Acos,
    /// Angle with this tangent.
    Atan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// Logarithm of the gamma function's absolute value.
    LnGamma,
    /// The derivative of [`Op::LnGamma`].
    Digamma,
    /// Error function.
    Erf,
    /// `exp(a^2) erfc(a)`.
    Erfcx,
    /// `ln(exp(-|a|) I_0(a))`.
    LnBesselI0e,
    /// `I_1(a) / I_0(a)`.
    BesselRatio,
    /// `a` to the power `b`, for `a` not negative: `exp(b log a)`.
    Pow,
    /// Angle of the point `(b, a)`.
    Atan2,
}

impl Op {
    /// The number of arguments.
    pub const fn arity(self) -> usize {
        match self {
            Op::Constant | Op::Input => 0,
            Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Min | Op::Max | Op::Less | Op::Pow | Op::Atan2 => 2,
            Op::Select => 3,
            _ => 1,
        }
    }

    /// Whether a routine over many numbers computes the operation, not an instruction.
    pub const fn is_call(self) -> bool {
        self as u8 >= Op::Exp as u8
    }
}

/// The value of an operation, by the most accurate method available.
///
/// NaN for constants and inputs, which have no arguments.
pub fn apply(op: Op, a: f64, b: f64, c: f64) -> f64 {
    match op {
        Op::Constant | Op::Input => f64::NAN,
        Op::Add => a + b,
        Op::Sub => a - b,
        Op::Mul => a * b,
        Op::Div => a / b,
        Op::Neg => -a,
        Op::Sqrt => a.sqrt(),
        Op::Round => a.round_ties_even(),
        Op::Abs => a.abs(),
        Op::Min => min(a, b),
        Op::Max => max(a, b),
        Op::Less => f64::from(u8::from(a < b)),
        Op::Select => {
            if a != 0.0 {
                b
            } else {
                c
            }
        }
        Op::Exp => libm::exp(a),
        Op::Log => libm::log(a),
        Op::Log1p => log1p(a),
        Op::Expm1 => libm::expm1(a),
        Op::Sin => libm::sin(a),
        Op::Cos => libm::cos(a),
        Op::Tan => tan(a),
        Op::Asin => asin(a),
        Op::Acos => libm::acos(a),
        Op::Atan => atan(a),
        Op::Sinh => libm::sinh(a),
        Op::Cosh => libm::cosh(a),
        Op::Tanh => libm::tanh(a),
        Op::LnGamma => libm::lgamma(a),
        Op::Digamma => digamma(a),
        Op::Erf => libm::erf(a),
        Op::Erfcx => puruspe::erfcx(a),
        Op::LnBesselI0e => niwaki_math::special::ln_bessel_i0e(a),
        Op::BesselRatio => bessel_ratio(a),
        Op::Pow => libm::pow(a, b),
        Op::Atan2 => libm::atan2(a, b),
    }
}

/// The smaller of two, NaN if either is NaN. `f64::min` would drop a NaN, and with it the sign of a diverged trajectory.
#[inline(always)]
pub fn min(a: f64, b: f64) -> f64 {
    if b < a || b.is_nan() { b } else { a }
}

/// The larger of two, NaN if either is NaN.
#[inline(always)]
pub fn max(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// The derivative of `ln gamma`.
///
/// Raised to 10 by `psi(x) = psi(x + 1) - 1 / x`, then the asymptotic series (Abramowitz & Stegun 6.3.5, 6.3.18);
/// below zero by reflection (6.3.7).
pub fn digamma(x: f64) -> f64 {
    use std::f64::consts::PI;
    if x <= 0.0 {
        if x == x.floor() {
            return f64::NAN;
        }
        // The period of the cotangent is one, so the fraction keeps its digits.
        return digamma(1.0 - x) - PI / libm::tan(PI * (x - x.floor()));
    }
    let (mut x, mut shift) = (x, 0.0);
    while x < 10.0 {
        shift += 1.0 / x;
        x += 1.0;
    }
    let r = 1.0 / (x * x);
    let series = r
        * (1.0 / 12.0
            - r * (1.0 / 120.0
                - r * (1.0 / 252.0
                    - r * (1.0 / 240.0 - r * (1.0 / 132.0 - r * (691.0 / 32760.0 - r / 12.0))))));
    libm::log(x) - 0.5 / x - series - shift
}

/// `I_1(x) / I_0(x)`, odd in `x`, between -1 and 1: the mean cosine of a von Mises angle.
///
/// Power series of both functions below 20, and their asymptotic series from there on (Abramowitz & Stegun 9.6.10,
/// 9.7.1), as in [`niwaki_math::special::ln_bessel_i0e`].
pub fn bessel_ratio(x: f64) -> f64 {
    let z = x.abs();
    let ratio = if z < 20.0 {
        let quarter = 0.25 * z * z;
        let (mut t0, mut t1, mut i0, mut i1, mut k) = (1.0, 0.5 * z, 1.0, 0.5 * z, 1.0);
        while t0 > 1e-18 * i0 {
            t0 *= quarter / (k * k);
            t1 *= quarter / (k * (k + 1.0));
            i0 += t0;
            i1 += t1;
            k += 1.0;
        }
        i1 / i0
    } else {
        let series = |mu: f64| {
            let (mut term, mut sum) = (1.0_f64, 1.0_f64);
            for k in 1..40 {
                let odd = f64::from(2 * k - 1);
                term *= (odd * odd - mu) / (8.0 * z * f64::from(k));
                sum += term;
                if term.abs() < 1e-18 {
                    break;
                }
            }
            sum
        };
        series(4.0) / series(0.0)
    };
    if x < 0.0 { -ratio } else { ratio }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digamma_is_the_slope_of_ln_gamma() {
        // Known values: -gamma, -gamma - 2 ln 2.
        const EULER: f64 = 0.577_215_664_901_532_9;
        assert!((digamma(1.0) + EULER).abs() < 1e-15);
        assert!((digamma(0.5) + EULER + 2.0 * std::f64::consts::LN_2).abs() < 1e-14);
        for x in [-2.3, -0.4, 0.01, 0.7, 3.0, 9.99, 10.0, 400.0] {
            let h = 1e-5 * f64::max(1.0, f64::abs(x)).min(f64::abs(x));
            let slope = (libm::lgamma(x + h) - libm::lgamma(x - h)) / (2.0 * h);
            assert!((digamma(x) - slope).abs() < 1e-7 * slope.abs().max(1.0), "{x} {} {slope}", digamma(x));
        }
    }

    #[test]
    fn the_ratio_of_bessel_functions_is_the_slope_of_ln_i0() {
        for x in [-30.0, -3.0, 1e-3, 0.8, 6.0, 19.99, 20.0, 500.0] {
            let h = 1e-5;
            let f = |x: f64| niwaki_math::special::ln_bessel_i0e(x) + x.abs();
            let slope = (f(x + h) - f(x - h)) / (2.0 * h);
            assert!((bessel_ratio(x) - slope).abs() < 1e-8, "{x}");
        }
    }

    #[test]
    fn nan_is_never_dropped() {
        for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
            assert!(min(a, b).is_nan() && max(a, b).is_nan());
        }
        assert_eq!((min(1.0, 2.0), max(1.0, 2.0)), (1.0, 2.0));
    }
}
