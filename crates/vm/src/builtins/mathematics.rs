//! Python's `math`: the same functions with the same domains.
//!
//! For an ordinary argument, `math` never returns NaN or an infinity. Outside of the domain it raises
//! `ValueError` (here `math-domain`), and beyond the largest float `OverflowError` (`float-overflow`). Source:
//! Python library reference, `math`, "CPython implementation detail".

use super::answer::{Answer, unfit};
use super::arithmetic::{real, whole, with_sign};
use crate::fault::Fault;
use crate::value::numbers::{self, Number, exact_or, pin};
use crate::value::{Scalar, Value, print};

/// Applies Python's rule to a result.
#[inline]
fn checked<S: Scalar>(name: &str, x: S, result: S, may_overflow: bool) -> Answer<S> {
    if result.is_finite() {
        return Ok(Value::Real(result));
    }
    let (x, y) = (x.value(), result.value());
    let surprising = if y.is_nan() { !x.is_nan() } else { x.is_finite() };
    match (surprising, y.is_infinite() && may_overflow) {
        (false, _) => Ok(Value::Real(result)),
        (true, true) => {
            Err(Fault::float_overflow(format!("{name}({}) is too large for a float", print::float(x))))
        }
        (true, false) => Err(outside(name, x)),
    }
}

#[cold]
fn outside(name: &str, x: f64) -> Fault {
    Fault::math_domain(format!("{name}({}) is not defined", print::float(x)))
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident $method:ident $may_overflow:literal;)*) => { $(
        $(#[$doc])*
        pub fn $name<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
            let x = real(stringify!($name), &args[0])?;
            checked(stringify!($name), x, x.$method(), $may_overflow)
        }
    )* };
}

functions! {
    /// The square root.
    sqrt sqrt false;
    /// e to the power x.
    exp exp true;
    /// `log(1 + x)`.
    log1p ln_1p false;
    /// `exp(x) - 1`.
    expm1 exp_m1 true;
    /// The sine of an angle in radians.
    sin sin false;
    /// The cosine of an angle in radians.
    cos cos false;
    /// The tangent of an angle in radians.
    tan tan false;
    /// The arcsine in radians, in [-pi/2, pi/2].
    asin asin false;
    /// The arccosine in radians, in [0, pi].
    acos acos false;
    /// The arctangent in radians, in [-pi/2, pi/2].
    atan atan false;
    /// Hyperbolic sine.
    sinh sinh true;
    /// Hyperbolic cosine.
    cosh cosh true;
    /// Hyperbolic tangent.
    tanh tanh false;
    /// The absolute value of a number, as a float.
    fabs abs false;
    /// The error function.
    erf erf false;
}

/// `log(x)` or `log(x, base)`.
pub fn log<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let natural = |value: &Value<S>| {
        let x = real("log", value)?;
        checked("log", x, x.ln(), false)
    };
    match args.get(1) {
        None | Some(Value::None) => natural(&args[0]),
        Some(base) => crate::value::ops::div(&natural(&args[0])?, &natural(base)?),
    }
}

/// Logarithm to base 2, exact for powers of two.
pub fn log2<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let x = real("log2", &args[0])?;
    let log = exact_or(x.value().log2(), || x.ln() / S::from_f64(std::f64::consts::LN_2));
    checked("log2", x, log, false)
}

/// Logarithm to base 10, exact for powers of ten.
pub fn log10<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let x = real("log10", &args[0])?;
    let log = exact_or(x.value().log10(), || x.ln() / S::from_f64(std::f64::consts::LN_10));
    checked("log10", x, log, false)
}

/// `atan2(y, x)`: the angle of the point (x, y) in radians, in [-pi, pi].
pub fn atan2<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Real(real("atan2", &args[0])?.atan2(real("atan2", &args[1])?)))
}

/// Length of a vector given by its coordinates.
pub fn hypot<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let parts: Vec<S> = args.iter().map(|arg| real("hypot", arg)).collect::<Result<_, _>>()?;
    let exact = parts.iter().fold(0.0_f64, |length, part| length.hypot(part.value()));
    Ok(Value::Real(exact_or(exact, || {
        parts.iter().fold(S::from_f64(0.0), |sum, part| sum + *part * *part).sqrt()
    })))
}

/// Rounds a number to a whole number with a function that changes at `lo` below and `hi` above the result.
pub(super) fn stepped<S: Scalar>(x: S, round: fn(f64) -> f64, lo: f64, hi: f64) -> Result<i64, Fault> {
    let whole = round(x.value());
    pin(x, whole + lo, whole + hi);
    numbers::to_int(whole)
}

/// The whole part of a number.
pub(super) fn truncated<S: Scalar>(x: S) -> Result<i64, Fault> {
    let whole = x.value().trunc();
    let reaches = |side: bool| f64::from(u8::from(side));
    stepped(x, f64::trunc, -reaches(whole <= 0.0), reaches(whole >= 0.0))
}

fn to_whole<S: Scalar>(name: &str, value: &Value<S>, round: fn(S) -> Result<i64, Fault>) -> Answer<S> {
    match Number::of(value) {
        Some(Number::Int(n)) => Ok(Value::Int(n)),
        Some(Number::Real(x)) => round(x).map(Value::Int),
        None => Err(unfit(name, "a number", value)),
    }
}

/// The largest int not above x.
pub fn floor<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    to_whole("floor", &args[0], |x| stepped(x, f64::floor, 0.0, 1.0))
}

/// The smallest int not below x.
pub fn ceil<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    to_whole("ceil", &args[0], |x| stepped(x, f64::ceil, -1.0, 0.0))
}

/// The whole part of x.
pub fn trunc<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    to_whole("trunc", &args[0], truncated)
}

/// Converts radians to degrees.
pub fn degrees<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Real(real("degrees", &args[0])? * S::from_f64(180.0 / std::f64::consts::PI)))
}

/// Converts degrees to radians.
pub fn radians<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Real(real("radians", &args[0])? * S::from_f64(std::f64::consts::PI / 180.0)))
}

/// The size of x with the sign of y.
pub fn copysign<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Real(with_sign(real("copysign", &args[0])?, real("copysign", &args[1])?)))
}

/// The remainder with the sign of x (`%` has the sign of y).
pub fn fmod<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (x, y) = (real("fmod", &args[0])?, real("fmod", &args[1])?);
    let (a, b) = (x.value(), y.value());
    if (b == 0.0 || a.is_infinite()) && !a.is_nan() && !b.is_nan() {
        return Err(Fault::math_domain(format!(
            "fmod({}, {}) is not defined",
            print::float(a),
            print::float(b)
        )));
    }
    pin(
        x / y,
        (a / b).trunc() - f64::from(u8::from(a / b < 0.0)),
        (a / b).trunc() + f64::from(u8::from(a / b >= 0.0)),
    );
    Ok(Value::Real(exact_or(
        a % b,
        || if b.is_infinite() { x } else { x - y * S::from_f64((a / b).trunc()) },
    )))
}

/// `math.pow(x, y)`: always a float, while `**` of ints is an int.
pub fn math_pow<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (x, y) = (real("pow", &args[0])?, real("pow", &args[1])?);
    let (base, exponent) = (x.value(), y.value());
    if base == 0.0 && exponent < 0.0 && exponent.is_finite() {
        let (base, exponent) = (print::float(base), print::float(exponent));
        return Err(Fault::math_domain(format!("pow({base}, {exponent}) is not defined")));
    }
    numbers::pow_reals(x, y).map(Value::Real)
}

macro_rules! predicates {
    ($($(#[$doc:meta])* $name:ident;)*) => { $(
        $(#[$doc])*
        pub fn $name<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
            let x = real(concat!("is", stringify!($name)), &args[0])?;
            Ok(Value::Bool(x.value().$name()))
        }
    )* };
}

mod predicates {
    //! Tests of a float, named after those of `f64`.
    use crate::builtins::answer::Answer;
    use crate::builtins::arithmetic::real;
    use crate::value::{Scalar, Value};

    predicates! {
        /// Whether a float is neither infinite nor NaN.
        is_finite;
        /// Whether a float is NaN.
        is_nan;
        /// Whether a float is infinite.
        is_infinite;
    }
}
pub use predicates::{is_finite as isfinite, is_infinite as isinf, is_nan as isnan};

/// Greatest common divisor of any number of ints.
pub fn gcd<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let mut divisor = 0_u64;
    for arg in args {
        let mut other = whole("gcd", arg)?.unsigned_abs();
        while other != 0 {
            (divisor, other) = (other, divisor % other);
        }
    }
    fitting("gcd", i64::try_from(divisor).ok())
}

fn fitting<S: Scalar>(name: &str, n: Option<i64>) -> Answer<S> {
    n.map(Value::Int).ok_or_else(|| Fault::integer_overflow(format!("the `{name}` does not fit in 64 bits")))
}

/// `1 * 2 * ... * n`.
pub fn factorial<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let n = whole("factorial", &args[0])?;
    if n < 0 {
        return Err(Fault::math_domain(format!("factorial({n}) is not defined")));
    }
    // 21! does not fit in 64 bits.
    fitting("factorial", (n < 21).then(|| (2..=n).product()))
}

/// The number of subsets with k elements of a set with n elements.
pub fn comb<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (n, k) = (whole("comb", &args[0])?, whole("comb", &args[1])?);
    if n < 0 || k < 0 {
        return Err(Fault::math_domain(format!("comb({n}, {k}) is not defined")));
    }
    if k > n {
        return Ok(Value::Int(0));
    }
    let mut subsets: i128 = 1;
    for i in 0..k.min(n - k) {
        subsets = subsets * i128::from(n - i) / i128::from(i + 1);
        if subsets > i128::from(i64::MAX) {
            return fitting("comb", None);
        }
    }
    fitting("comb", i64::try_from(subsets).ok())
}

/// Logarithm of the gamma function's absolute value.
pub fn lgamma<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let x = real("lgamma", &args[0])?;
    let value = x.value();
    if value <= 0.0 && value.fract() == 0.0 && value.is_finite() {
        return Err(outside("lgamma", value));
    }
    if value == f64::NEG_INFINITY {
        return Ok(Value::real(f64::INFINITY));
    }
    checked("lgamma", x, x.ln_gamma(), true)
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code};

    #[test]
    fn arguments_outside_of_the_domain_are_faults() {
        let domain =
            [("sqrt", -1.0), ("log", 0.0), ("log", -1.0), ("log1p", -1.0), ("log2", 0.0), ("asin", 1.1)];
        for (name, x) in domain {
            assert_eq!(code(name, &[V::real(x)]), "math-domain", "{name}({x})");
        }
        assert_eq!(code("sin", &[V::real(f64::INFINITY)]), "math-domain");
        assert_eq!(code("lgamma", &[V::Int(-2)]), "math-domain");
        assert_eq!(code("fmod", &[V::real(1.0), V::Int(0)]), "math-domain");
        for name in ["exp", "sinh", "cosh", "expm1"] {
            assert_eq!(code(name, &[V::real(1000.0)]), "float-overflow", "{name}");
        }
        assert_eq!(code("log", &[V::Int(2), V::Int(1)]), "division-by-zero");
        assert_eq!(code("floor", &[V::real(f64::NAN)]), "integer-overflow");
        assert_eq!(code("sqrt", &[V::str("4")]), "type-mismatch");
        assert_eq!(call("exp", &[V::real(f64::INFINITY)]), Ok(V::real(f64::INFINITY)));
        assert_eq!(call("exp", &[V::real(-1000.0)]), Ok(V::real(0.0)));
    }

    #[test]
    fn functions_have_their_known_values() {
        let cases: &[(&str, &[f64], f64)] = &[
            ("sqrt", &[2.25], 1.5),
            ("log", &[8.0, 2.0], 3.0),
            ("log2", &[8.0], 3.0),
            ("log10", &[1000.0], 3.0),
            ("hypot", &[3.0, 4.0], 5.0),
            ("hypot", &[2.0, 3.0, 6.0], 7.0),
            ("atan2", &[1.0, -1.0], 3.0 * std::f64::consts::FRAC_PI_4),
            ("degrees", &[std::f64::consts::PI], 180.0),
            ("radians", &[180.0], std::f64::consts::PI),
            ("copysign", &[2.0, -0.0], -2.0),
            ("fmod", &[-7.0, 3.0], -1.0),
            ("math_pow", &[2.0, 3.0], 8.0),
            ("fabs", &[-2.0], 2.0),
        ];
        for (name, args, expected) in cases {
            let args: Vec<V> = args.iter().map(|x| V::real(*x)).collect();
            let Ok(V::Real(result)) = call(name, &args) else { panic!("{name}") };
            assert!((result - expected).abs() <= 1e-15 * expected.abs(), "{name} {result}");
        }
        assert_eq!(call("floor", &[V::real(-1.5)]), Ok(V::Int(-2)));
        assert_eq!(call("ceil", &[V::real(-1.5)]), Ok(V::Int(-1)));
        assert_eq!(call("trunc", &[V::real(-1.5)]), Ok(V::Int(-1)));
        assert_eq!(call("gcd", &[V::Int(-12), V::Int(18), V::Int(8)]), Ok(V::Int(2)));
        assert_eq!(call("factorial", &[V::Int(20)]), Ok(V::Int(2_432_902_008_176_640_000)));
        assert_eq!(code("factorial", &[V::Int(21)]), "integer-overflow");
        assert_eq!(call("comb", &[V::Int(66), V::Int(33)]), Ok(V::Int(7_219_428_434_016_265_740)));
        assert_eq!(code("comb", &[V::Int(68), V::Int(34)]), "integer-overflow");
        assert_eq!(code("comb", &[V::Int(i64::MAX), V::Int(1 << 40)]), "integer-overflow");
        assert_eq!(call("isnan", &[V::real(f64::NAN)]), Ok(V::Bool(true)));
        assert_eq!(call("isfinite", &[V::Int(1)]), Ok(V::Bool(true)));
        assert_eq!(call("isinf", &[V::real(f64::NEG_INFINITY)]), Ok(V::Bool(true)));
    }
}
