//! Soft constraints as log scores, and smooth versions of functions with corners. Each has a width above 0.
//!
//! All except `softeq` (dissertation eq. 4.1) are built from `sqrt(d^2 + width^2)`. This root has derivatives
//! of every order and no branch, so a recorded graph holds for all arguments. The package's `words/soft.py` has
//! the same formulas.

use super::answer::Answer;
use super::arithmetic::real;
use crate::fault::Fault;
use crate::value::{Scalar, Value, print};

/// `ln(2 pi) / 2`.
const HALF_LOG_TAU: f64 = 0.918_938_533_204_672_8;

/// Reads the last argument, which must be above 0 and finite.
fn width<S: Scalar>(name: &str, value: &Value<S>) -> Result<S, Fault> {
    let width = real(name, value)?;
    if width.value() > 0.0 && width.is_finite() {
        return Ok(width);
    }
    let shown = print::float(width.value());
    Err(Fault::bad_argument(format!("the width of `{name}` is {shown}: it must be above 0")))
}

/// Reads two numbers and a width.
fn two_and_width<S: Scalar>(name: &str, args: &[Value<S>]) -> Result<[S; 3], Fault> {
    Ok([real(name, &args[0])?, real(name, &args[1])?, width(name, &args[2])?])
}

/// `-e^2 / 2` with `e = (d + sqrt(d^2 + 1)) / 2`.
fn shortfall<S: Scalar>(d: S) -> S {
    let c = S::from_f64;
    let e = c(0.5) * (d + (d * d + c(1.0)).sqrt());
    c(-0.5) * e * e
}

/// `softeq(a, b, width)`: the log of a normal density of `a - b`.
pub fn softeq<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [a, b, width] = two_and_width("softeq", args)?;
    let z = (a - b) / width;
    Ok(Value::Real(S::from_f64(-0.5) * z * z - width.ln() - S::from_f64(HALF_LOG_TAU)))
}

/// `soft_at_least(a, b, width)`.
pub fn soft_at_least<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [a, b, width] = two_and_width("soft_at_least", args)?;
    Ok(Value::Real(shortfall((b - a) / width)))
}

/// `soft_at_most(a, b, width)`.
pub fn soft_at_most<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [a, b, width] = two_and_width("soft_at_most", args)?;
    Ok(Value::Real(shortfall((a - b) / width)))
}

/// `smooth_max(a, b, width)`.
pub fn smooth_max<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [a, b, width] = two_and_width("smooth_max", args)?;
    Ok(Value::Real(S::from_f64(0.5) * (a + b + ((a - b) * (a - b) + width * width).sqrt())))
}

/// `smooth_min(a, b, width)`.
pub fn smooth_min<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let [a, b, width] = two_and_width("smooth_min", args)?;
    Ok(Value::Real(S::from_f64(0.5) * (a + b - ((a - b) * (a - b) + width * width).sqrt())))
}

/// `smooth_abs(x, width)`.
pub fn smooth_abs<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (x, width) = (real("smooth_abs", &args[0])?, width("smooth_abs", &args[1])?);
    Ok(Value::Real((x * x + width * width).sqrt()))
}

#[cfg(test)]
mod tests {
    //! The claim: each function has the right values far from its bend and at its bend.
    use crate::builtins::tests::{V, call, code};

    fn of(name: &str, args: &[f64]) -> f64 {
        match call(name, &args.iter().map(|x| V::real(*x)).collect::<Vec<_>>()) {
            Ok(V::Real(x)) => x,
            other => panic!("{name} answers {other:?}"),
        }
    }

    #[test]
    fn equality_is_a_normal_density() {
        let density = |z: f64, s: f64| (-0.5 * (z / s).powi(2)).exp() / (s * std::f64::consts::TAU.sqrt());
        for (a, b, s) in [(0.0, 0.0, 1.0), (1.5, -0.5, 0.7), (3.0, 3.1, 0.005)] {
            assert!((of("softeq", &[a, b, s]) - density(a - b, s).ln()).abs() < 1e-12);
        }
    }

    #[test]
    fn one_side_is_free_and_the_other_costs() {
        assert!(of("soft_at_least", &[9.0, 1.0, 0.1]).abs() < 1e-5);
        assert_eq!(of("soft_at_least", &[1.0, 1.0, 0.1]), -0.125);
        assert!((of("soft_at_least", &[0.0, 1.0, 0.01]) / -5000.0 - 1.0).abs() < 1e-3);
        assert_eq!(of("soft_at_most", &[2.0, 5.0, 0.5]), of("soft_at_least", &[5.0, 2.0, 0.5]));
    }

    #[test]
    fn bends_are_within_their_width() {
        assert_eq!(of("smooth_max", &[2.0, 2.0, 0.5]), 2.25);
        assert_eq!(of("smooth_min", &[2.0, 2.0, 0.5]), 1.75);
        assert_eq!(of("smooth_abs", &[0.0, 0.5]), 0.5);
        assert!((of("smooth_max", &[-3.0, 40.0, 0.1]) - 40.0).abs() < 1e-4);
        assert!((of("smooth_min", &[-3.0, 40.0, 0.1]) + 3.0).abs() < 1e-4);
        assert!((of("smooth_abs", &[-30.0, 0.1]) - 30.0).abs() < 2e-4);
    }

    #[test]
    fn a_width_is_above_zero() {
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(code("softeq", &[V::real(0.0), V::real(0.0), V::real(width)]), "bad-argument");
            assert_eq!(code("smooth_abs", &[V::real(0.0), V::real(width)]), "bad-argument");
        }
    }
}
