//! Numbers as Python computes them: true division of whole numbers, floor division and remainder, powers,
//! conversions and rounding.
//!
//! Sources: Python language reference 6.7 (binary arithmetic); the float algorithms follow the documented identities
//! `x == (x // y) * y + x % y` and `sign(x % y) == sign(y)`.

use std::any::TypeId;

use super::{Scalar, Value};
use crate::fault::Fault;

/// A number in a value: an int, a bool or a float.
#[derive(Clone, Copy, Debug)]
pub enum Number<S> {
    /// int or bool.
    Int(i64),
    /// float.
    Real(S),
}

impl<S: Scalar> Number<S> {
    /// The number in a value, if it is one.
    #[inline]
    pub fn of(value: &Value<S>) -> Option<Number<S>> {
        match value {
            Value::Int(n) => Some(Number::Int(*n)),
            Value::Real(x) => Some(Number::Real(*x)),
            Value::Bool(b) => Some(Number::Int(i64::from(*b))),
            _ => None,
        }
    }

    /// The number as a real, rounded to nearest as Python's `float()` does.
    #[inline]
    pub fn real(self) -> S {
        match self {
            Number::Int(n) => S::from_f64(n as f64),
            Number::Real(x) => x,
        }
    }
}

/// The exact `f64` result if the scalar is an `f64`; otherwise the result by smooth arithmetic, so that a
/// recording scalar records its dependence on the inputs.
#[inline]
pub fn exact_or<S: Scalar>(exact: f64, smooth: impl FnOnce() -> S) -> S {
    if TypeId::of::<S>() == TypeId::of::<f64>() { S::from_f64(exact) } else { smooth() }
}

#[cold]
fn by_zero(operation: &str) -> Fault {
    Fault::division_by_zero(format!("{operation} by zero"))
}

#[cold]
pub(super) fn overflow(sign: &str, a: i64, b: i64) -> Fault {
    Fault::integer_overflow(format!("{a} {sign} {b} does not fit in 64 bits"))
        .with_help("whole numbers have 64 bits here; use a real number such as `1.0` if it may grow")
}

/// `a / b` of whole numbers: the float nearest to the true quotient.
pub fn divide_ints(a: i64, b: i64) -> Result<f64, Fault> {
    const EXACT: u64 = 1 << 53;
    if b == 0 {
        return Err(by_zero("division"));
    }
    let (up, down) = (a.unsigned_abs(), b.unsigned_abs());
    if up <= EXACT && down <= EXACT {
        return Ok(a as f64 / b as f64);
    }
    // The first 63 bits or more of the quotient round as the true quotient does, if the last bit says whether
    // there is a remainder.
    let shift = u128::from(up).leading_zeros() - 1;
    let scaled = u128::from(up) << shift;
    let rest = u128::from(scaled % u128::from(down) != 0);
    let quotient = (scaled / u128::from(down)) | rest;
    let size = quotient as f64 * f64::powi(2.0, -(shift as i32));
    Ok(if (a < 0) == (b < 0) { size } else { -size })
}

/// `a // b` of whole numbers.
#[inline]
pub fn floor_divide_ints(a: i64, b: i64) -> Result<i64, Fault> {
    if b == 0 {
        return Err(by_zero("floor division"));
    }
    let Some(quotient) = a.checked_div(b) else { return Err(overflow("//", a, b)) };
    Ok(if a % b != 0 && (a < 0) != (b < 0) { quotient - 1 } else { quotient })
}

/// `a % b` of whole numbers: has the sign of `b`.
#[inline]
pub fn mod_ints(a: i64, b: i64) -> Result<i64, Fault> {
    if b == 0 {
        return Err(by_zero("remainder of a division"));
    }
    let rest = a.wrapping_rem(b);
    Ok(if rest != 0 && (rest < 0) != (b < 0) { rest + b } else { rest })
}

/// `a / b` of reals.
#[inline]
pub fn divide_reals<S: Scalar>(a: S, b: S) -> Result<S, Fault> {
    if b.value() == 0.0 {
        return Err(by_zero("division"));
    }
    Ok(a / b)
}

/// Quotient and remainder of reals; the quotient is rounded towards minus infinity.
fn floor_parts(a: f64, b: f64) -> (f64, f64) {
    let mut rest = a % b;
    let mut quotient = (a - rest) / b;
    if rest == 0.0 {
        rest = 0.0_f64.copysign(b);
    } else if (b < 0.0) != (rest < 0.0) {
        rest += b;
        quotient -= 1.0;
    }
    if quotient == 0.0 {
        return (0.0_f64.copysign(a / b), rest);
    }
    let floor = quotient.floor();
    (if quotient - floor > 0.5 { floor + 1.0 } else { floor }, rest)
}

/// Records that the run uses a value that is valid only while `lo <= x < hi`, such as a whole part. A recording
/// scalar records a guard; a plain number does nothing.
#[inline(always)]
pub fn pin<S: Scalar>(x: S, lo: f64, hi: f64) {
    if x.varies() {
        let _ = x >= S::from_f64(lo) && x < S::from_f64(hi);
    }
}

/// `a // b` of reals.
pub fn floor_divide_reals<S: Scalar>(a: S, b: S) -> Result<S, Fault> {
    if b.value() == 0.0 {
        return Err(by_zero("floor division"));
    }
    let quotient = floor_parts(a.value(), b.value()).0;
    pin(a / b, quotient, quotient + 1.0);
    Ok(S::from_f64(quotient))
}

/// `a % b` of reals: has the sign of `b`.
pub fn mod_reals<S: Scalar>(a: S, b: S) -> Result<S, Fault> {
    if b.value() == 0.0 {
        return Err(by_zero("remainder of a division"));
    }
    let (quotient, rest) = floor_parts(a.value(), b.value());
    pin(a / b, quotient, quotient + 1.0);
    Ok(exact_or(rest, || a - b * S::from_f64(quotient)))
}

/// `base ** exponent` of whole numbers: an int, or a float for a negative exponent.
pub fn pow_ints<S: Scalar>(base: i64, exponent: i64) -> Result<Value<S>, Fault> {
    if exponent < 0 {
        return pow_reals(S::from_f64(base as f64), S::from_f64(exponent as f64)).map(Value::Real);
    }
    let power = match (base, u32::try_from(exponent)) {
        (0 | 1, Err(_)) => Some(base),
        (-1, _) => Some(if exponent % 2 == 0 { 1 } else { -1 }),
        (_, Ok(exponent)) => base.checked_pow(exponent),
        (_, Err(_)) => None,
    };
    power.map(Value::Int).ok_or_else(|| overflow("**", base, exponent))
}

/// `base ** exponent` of reals.
pub fn pow_reals<S: Scalar>(base: S, exponent: S) -> Result<S, Fault> {
    let (b, e) = (base.value(), exponent.value());
    if b == 0.0 && e < 0.0 && e.is_finite() {
        return Err(Fault::division_by_zero("0.0 cannot be raised to a negative power"));
    }
    if b < 0.0 && b.is_finite() && e.is_finite() && e.fract() != 0.0 {
        let message = format!("a negative number ({b:?}) has no real power with the exponent {e:?}");
        return Err(Fault::math_domain(message).with_help("write `abs(x) ** y`, or keep the base positive"));
    }
    let power = base.powf(exponent);
    if power.value().is_infinite() && b.is_finite() && e.is_finite() {
        return Err(Fault::float_overflow(format!("{b:?} ** {e:?} is too large for a float")));
    }
    Ok(power)
}

/// Converts a whole real to an int, for `int(x)` and similar functions.
pub fn to_int(x: f64) -> Result<i64, Fault> {
    // Both bounds are exact floats; the upper bound is excluded because `i64::MAX` is not a float.
    if (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&x) {
        return Ok(x as i64);
    }
    let message = if x.is_nan() {
        "a NaN cannot be converted to an int".to_string()
    } else if x.is_infinite() {
        "an infinite float cannot be converted to an int".to_string()
    } else {
        format!("{x:?} does not fit in a 64-bit int")
    };
    Err(Fault::integer_overflow(message))
}

/// `round(x, digits)` of a real: rounds to the nearest decimal, and the exact binary value decides ties to
/// even. `inf` when the result is out of range.
pub fn round_real(x: f64, digits: i64) -> f64 {
    if !x.is_finite() || digits > 323 {
        return x;
    }
    if digits < -308 {
        return 0.0_f64.copysign(x);
    }
    if digits < 0 {
        // `left` significant digits remain; with none, a number above half of the unit rounds up to the unit.
        let power = format!("{x:.20e}").split_once('e').and_then(|(_, power)| power.parse::<i64>().ok());
        let left = power.unwrap_or(0) + 1 + digits;
        let rounded = match left {
            1.. => format!("{x:.*e}", left as usize - 1).parse().unwrap_or(x),
            0 if x.abs() > 5.0 * f64::powi(10.0, -digits as i32 - 1) => f64::powi(10.0, -digits as i32),
            _ => 0.0,
        };
        return rounded.copysign(x);
    }
    // Formatting rounds the exact binary value, ties to even, and reads back to the nearest float.
    format!("{x:.*}", digits as usize).parse().unwrap_or(x)
}

/// `round(n, digits)` of a whole number for negative digits: to tens, hundreds, ..., ties to even.
pub fn round_int(n: i64, digits: i64) -> Result<i64, Fault> {
    if digits >= 0 {
        return Ok(n);
    }
    if digits < -19 {
        return Ok(0);
    }
    let unit = 10_i128.pow(-digits as u32);
    let (down, rest) = (i128::from(n).div_euclid(unit), i128::from(n).rem_euclid(unit));
    let up = rest * 2 > unit || (rest * 2 == unit && down % 2 != 0);
    i64::try_from((down + i128::from(up)) * unit)
        .map_err(|_| Fault::integer_overflow(format!("round({n}, {digits}) does not fit in 64 bits")))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Expected quotients were computed with CPython 3.11, which rounds the exact quotient.
    #[test]
    fn true_division_of_whole_numbers_rounds_once() {
        let cases = [
            (1, 3, 1.0 / 3.0),
            (9_007_199_254_740_993, 2, 4_503_599_627_370_496.0),
            (i64::MAX, i64::MAX - 1, 1.0),
            (9_223_372_036_854_775_807, 3, 3.074_457_345_618_258_6e18),
            (-9_007_199_254_740_995, 3, -3_002_399_751_580_331.5),
            (1, i64::MAX, 1.084_202_172_485_504_4e-19),
            (i64::MIN, -1, 9_223_372_036_854_775_808.0),
            (0, i64::MIN, 0.0),
        ];
        for (a, b, expected) in cases {
            assert_eq!(divide_ints(a, b), Ok(expected), "{a} / {b}");
        }
        assert_eq!(divide_ints(1, 0).map_err(|fault| fault.code), Err("division-by-zero"));
    }

    #[test]
    fn floor_division_and_remainder_satisfy_their_identity() {
        for (a, b, quotient, rest) in
            [(7, 2, 3, 1), (-7, 2, -4, 1), (7, -2, -4, -1), (-7, -2, 3, -1), (6, -3, -2, 0), (0, 5, 0, 0)]
        {
            assert_eq!((floor_divide_ints(a, b), mod_ints(a, b)), (Ok(quotient), Ok(rest)), "{a} {b}");
            let (x, y) = (a as f64, b as f64);
            assert_eq!(floor_divide_reals(x, y), Ok(quotient as f64), "{a} {b}");
            assert_eq!(mod_reals(x, y), Ok(rest as f64), "{a} {b}");
        }
        assert_eq!(floor_divide_ints(i64::MIN, -1).map_err(|fault| fault.code), Err("integer-overflow"));
        assert_eq!(mod_ints(i64::MIN, -1), Ok(0));
        assert_eq!(mod_reals(-1e-20, 1.0), Ok(1.0), "as in Python: rounded up to the divisor");
        assert_eq!(floor_divide_reals(1.0, 0.1), Ok(9.0));
        assert_eq!(mod_reals(5.5, f64::INFINITY), Ok(5.5));
        assert_eq!(mod_reals(-5.5, f64::INFINITY), Ok(f64::INFINITY));
        assert_eq!(mod_reals(-4.0, 2.0).map(f64::to_bits), Ok(0.0_f64.to_bits()));
        assert_eq!(mod_reals(4.0, -2.0).map(f64::to_bits), Ok((-0.0_f64).to_bits()));
    }

    #[test]
    fn powers_stay_whole_until_the_exponent_is_negative() {
        let pow = |a, b| pow_ints::<f64>(a, b).map_err(|fault| fault.code);
        assert_eq!(pow(2, 62), Ok(Value::Int(1 << 62)));
        assert_eq!(pow(2, 63), Err("integer-overflow"));
        assert_eq!(pow(-2, 63), Ok(Value::Int(i64::MIN)));
        assert_eq!(pow(-1, i64::MAX), Ok(Value::Int(-1)));
        assert_eq!(pow(0, 1 << 40), Ok(Value::Int(0)));
        assert_eq!(pow(3, 1 << 40), Err("integer-overflow"));
        assert_eq!(pow(2, -2), Ok(Value::Real(0.25)));
        assert_eq!(pow(0, 0), Ok(Value::Int(1)));
        assert_eq!(pow(0, -1), Err("division-by-zero"));
        let real = |a: f64, b: f64| pow_reals(a, b).map_err(|fault| fault.code);
        assert_eq!(real(-8.0, 0.5), Err("math-domain"));
        assert_eq!(real(-8.0, 3.0), Ok(-512.0));
        assert_eq!(real(1e200, 2.0), Err("float-overflow"));
        assert_eq!(real(f64::NEG_INFINITY, 0.5), Ok(f64::INFINITY));
        assert_eq!(real(0.0, -1.0), Err("division-by-zero"));
    }

    #[test]
    fn reals_become_ints_when_they_fit() {
        assert_eq!(to_int(-9_223_372_036_854_775_808.0), Ok(i64::MIN));
        assert!(to_int(9_223_372_036_854_775_808.0).is_err());
        assert!(to_int(f64::NAN).is_err());
    }
}
