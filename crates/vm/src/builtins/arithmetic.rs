//! Conversions, rounding, and small functions of numbers that every model uses.

use super::answer::{Answer, less, unfit};
use crate::fault::Fault;
use crate::value::numbers::{self, Number, exact_or};
use crate::value::{Scalar, Value, print};

/// The real number in an argument.
#[inline]
pub(super) fn real<S: Scalar>(name: &str, value: &Value<S>) -> Result<S, Fault> {
    match Number::of(value) {
        Some(number) => Ok(number.real()),
        None => Err(unfit(name, "a number", value)),
    }
}

/// The whole number in an argument.
pub(super) fn whole<S: Scalar>(name: &str, value: &Value<S>) -> Result<i64, Fault> {
    match Number::of(value) {
        Some(Number::Int(n)) => Ok(n),
        _ => Err(unfit(name, "an int", value)),
    }
}

/// The digits of a number as Python reads them: spaces around the number and underscores between digits are
/// allowed.
fn digits(text: &str) -> Option<String> {
    let text = text.trim();
    let between = |at: usize| {
        let digit =
            |at: Option<usize>| at.and_then(|at| text.as_bytes().get(at)).is_some_and(u8::is_ascii_digit);
        digit(at.checked_sub(1)) && digit(Some(at + 1))
    };
    let misplaced = text.bytes().enumerate().any(|(at, byte)| byte == b'_' && !between(at));
    (!misplaced).then(|| text.replace('_', ""))
}

/// `int(x)`: the whole part of a real, or the number that a text spells.
pub fn int<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match args.first() {
        None => Ok(Value::Int(0)),
        Some(Value::Str(text)) => {
            let number = digits(text).and_then(|text| text.parse().ok());
            number
                .map(Value::Int)
                .ok_or_else(|| Fault::bad_text(format!("{} is not an int in text", print::quoted(text))))
        }
        Some(value) => match Number::of(value) {
            Some(Number::Int(n)) => Ok(Value::Int(n)),
            Some(Number::Real(x)) => super::mathematics::truncated(x).map(Value::Int),
            None => Err(unfit("int", "a number or text", value)),
        },
    }
}

/// `float(x)`: for text, the number that it spells.
pub fn float<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match args.first() {
        None => Ok(Value::real(0.0)),
        Some(Value::Str(text)) => {
            let number = digits(text).and_then(|text| text.parse().ok());
            number
                .map(Value::real)
                .ok_or_else(|| Fault::bad_text(format!("{} is not a float in text", print::quoted(text))))
        }
        Some(value) => real("float", value).map(Value::Real),
    }
}

/// `abs(x)`.
pub fn abs<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    match Number::of(&args[0]) {
        Some(Number::Real(x)) => Ok(Value::Real(x.abs())),
        Some(Number::Int(n)) => n
            .checked_abs()
            .map(Value::Int)
            .ok_or_else(|| Fault::integer_overflow(format!("abs({n}) does not fit in 64 bits"))),
        None => Err(unfit("abs", "a number", &args[0])),
    }
}

/// `round(x)` returns an int and `round(x, digits)` a float; ties go to the even neighbour.
pub fn round<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let digits = match args.get(1) {
        None | Some(Value::None) => None,
        Some(digits) => Some(whole("round", digits)?),
    };
    match (Number::of(&args[0]), digits) {
        (Some(Number::Int(n)), None) => Ok(Value::Int(n)),
        (Some(Number::Int(n)), Some(digits)) => numbers::round_int(n, digits).map(Value::Int),
        (Some(Number::Real(x)), None) => {
            super::mathematics::stepped(x, f64::round_ties_even, -0.5, 0.5).map(Value::Int)
        }
        (Some(Number::Real(x)), Some(digits)) => {
            if x.varies() {
                return Err(Fault::no_derivative("`round` to decimals"));
            }
            let rounded = numbers::round_real(x.value(), digits);
            if rounded.is_infinite() && x.value().is_finite() {
                return Err(Fault::float_overflow("the rounded number is too large for a float"));
            }
            Ok(Value::real(rounded))
        }
        (None, _) => Err(unfit("round", "a number", &args[0])),
    }
}

/// `clip(x, lo, hi)`: `x` if it is within the bounds, else the nearer bound.
pub fn clip<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [x, lo, hi] = args else { return Err(Fault::argument_count("`clip` takes 3 arguments")) };
    if let (Some(a), Some(b), Some(c)) = (Number::of(x), Number::of(lo), Number::of(hi)) {
        let (a, b, c) = (a.real(), b.real(), c.real());
        if (a.varies() || b.varies() || c.varies()) && b <= c {
            return Ok(Value::Real(a.max(b).min(c)));
        }
    }
    Ok(if less(x, lo)? {
        lo.clone()
    } else if less(hi, x)? {
        hi.clone()
    } else {
        x.clone()
    })
}

/// `sign(x)`: 1, 0 or -1 (0 for a NaN).
pub fn sign<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (x, zero) = (real("sign", &args[0])?, S::from_f64(0.0));
    Ok(Value::Int(i64::from(x > zero) - i64::from(x < zero)))
}

/// `smoothstep(x, lo, hi)`: from 0 at `lo` to 1 at `hi`, level at both (Hermite's cubic).
pub fn smoothstep<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [x, lo, hi] = args else { return Err(Fault::argument_count("`smoothstep` takes 3 arguments")) };
    let [x, lo, hi] = [real("smoothstep", x)?, real("smoothstep", lo)?, real("smoothstep", hi)?];
    let (zero, one, width) = (S::from_f64(0.0), S::from_f64(1.0), hi - lo);
    if width.value() == 0.0 {
        return Err(Fault::division_by_zero("`smoothstep`: `lo` and `hi` are equal"));
    }
    let t = (x - lo) / width;
    let t = if t < zero {
        zero
    } else if t > one {
        one
    } else {
        t
    };
    Ok(Value::Real(t * t * (S::from_f64(3.0) - S::from_f64(2.0) * t)))
}

/// A real number with the sign of another.
pub(super) fn with_sign<S: Scalar>(x: S, sign: S) -> S {
    let (value, other) = (x.value(), sign.value());
    exact_or(value.copysign(other), || {
        let _ = (x < S::from_f64(0.0), sign < S::from_f64(0.0));
        if value.is_sign_negative() == other.is_sign_negative() { x } else { -x }
    })
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code};

    #[test]
    fn conversions_agree_with_python() {
        assert_eq!(call("int", &[V::real(-2.9)]), Ok(V::Int(-2)));
        assert_eq!(call("int", &[V::str(" 1_000 ")]), Ok(V::Int(1000)));
        assert_eq!(call("float", &[V::str("-1e-3")]), Ok(V::real(-0.001)));
        assert_eq!(call("float", &[V::str("inf")]), Ok(V::real(f64::INFINITY)));
        assert_eq!(code("int", &[V::str("1.5")]), "bad-text");
        assert_eq!(code("int", &[V::str("1__0")]), "bad-text");
        assert_eq!(code("float", &[V::str("_1")]), "bad-text");
        assert_eq!(code("int", &[V::real(1e19)]), "integer-overflow");
        assert_eq!(code("int", &[V::list(vec![])]), "type-mismatch");
        assert_eq!(call("bool", &[V::str("")]), Ok(V::Bool(false)));
    }

    #[test]
    fn rounding_goes_to_even() {
        for (x, expected) in [(0.5, 0), (1.5, 2), (2.5, 2), (-0.5, 0), (-1.5, -2), (2.500_000_1, 3)] {
            assert_eq!(call("round", &[V::real(x)]), Ok(V::Int(expected)), "{x}");
        }
        for (x, digits, expected) in
            [(2.675, 2, 2.67), (0.125, 2, 0.12), (1.005, 2, 1.0), (1234.5, -2, 1200.0), (150.0, -2, 200.0)]
        {
            assert_eq!(call("round", &[V::real(x), V::Int(digits)]), Ok(V::real(expected)), "{x} {digits}");
        }
        assert_eq!(call("round", &[V::Int(25), V::Int(-1)]), Ok(V::Int(20)));
        assert_eq!(call("round", &[V::Int(-35), V::Int(-1)]), Ok(V::Int(-40)));
        assert_eq!(call("round", &[V::real(7.0), V::None]), Ok(V::Int(7)));
    }

    #[test]
    fn small_functions_agree_with_their_definitions() {
        assert_eq!(call("clip", &[V::real(3.5), V::Int(0), V::Int(2)]), Ok(V::Int(2)));
        assert_eq!(call("clip", &[V::real(-0.5), V::Int(0), V::Int(2)]), Ok(V::Int(0)));
        assert_eq!(call("lerp", &[V::real(1.0), V::real(3.0), V::real(0.25)]), Ok(V::real(1.5)));
        assert_eq!(call("sign", &[V::real(-0.1)]), Ok(V::Int(-1)));
        assert_eq!(call("divmod", &[V::Int(-7), V::Int(2)]), Ok(V::tuple(vec![V::Int(-4), V::Int(1)])));
        assert_eq!(call("abs", &[V::Bool(true)]), Ok(V::Int(1)));
        assert_eq!(code("abs", &[V::Int(i64::MIN)]), "integer-overflow");
    }
}
