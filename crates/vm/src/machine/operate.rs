//! The operations of two operands that have an instruction of their own.
//!
//! Two numbers of one kind are handled first, in the loop over instructions, where the result is written
//! directly to its register. Other kinds, and all operations that may fail, are handled by a call.

use crate::code::Binary;
use crate::fault::Fault;
use crate::value::{Value, equal, index, ops};
use niwaki_math::Scalar;

/// Combines two reals, if that cannot fail; `None` sends the caller to [`values`].
#[inline(always)]
pub(super) fn reals<S: Scalar>(op: Binary, a: S, b: S) -> Option<S> {
    match op {
        Binary::Add => Some(a + b),
        Binary::Sub => Some(a - b),
        Binary::Mul => Some(a * b),
        Binary::Div if b.value() != 0.0 => Some(a / b),
        _ => None,
    }
}

/// Combines two whole numbers, if the result is a whole number that fits; `None` sends the caller to
/// [`values`].
#[inline(always)]
pub(super) fn ints(op: Binary, a: i64, b: i64) -> Option<i64> {
    match op {
        Binary::Add => a.checked_add(b),
        Binary::Sub => a.checked_sub(b),
        Binary::Mul => a.checked_mul(b),
        // Python's remainder has the sign of the divisor.
        Binary::Mod if b > 0 => Some(a.rem_euclid(b)),
        _ => None,
    }
}

/// Combines a real and a whole number in the most frequent ways.
#[inline(always)]
pub(super) fn mixed<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Option<S> {
    match (a, b) {
        (Value::Real(x), Value::Int(n)) => reals(op, *x, S::from_f64(*n as f64)),
        (Value::Int(n), Value::Real(y)) => reals(op, S::from_f64(*n as f64), *y),
        _ => None,
    }
}

/// Combines any two values.
#[inline(never)]
pub(super) fn values<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Result<Value<S>, Fault> {
    match op {
        Binary::Add => ops::add(a, b),
        Binary::Sub => ops::sub(a, b),
        Binary::Mul => ops::mul(a, b),
        Binary::Div => ops::div(a, b),
        Binary::FloorDiv => ops::floordiv(a, b),
        Binary::Mod => ops::mod_(a, b),
        Binary::Pow => ops::pow(a, b),
        Binary::Index => index::index(a, b),
        Binary::In => index::contains(b, a).map(Value::Bool),
        _ => holds(op, a, b).map(Value::Bool),
    }
}

/// The truth of a comparison.
#[inline(always)]
pub(super) fn holds<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Result<bool, Fault> {
    match (a, b) {
        (Value::Int(a), Value::Int(b)) => Ok(ordered(op, a, b)),
        (Value::Real(a), Value::Real(b)) => Ok(ordered(op, a, b)),
        _ => holds_slow(op, a, b),
    }
}

#[inline(always)]
fn ordered<T: PartialOrd>(op: Binary, a: &T, b: &T) -> bool {
    match op {
        Binary::Eq => a == b,
        Binary::Ne => a != b,
        Binary::Lt => a < b,
        Binary::Le => a <= b,
        Binary::Gt => a > b,
        _ => a >= b,
    }
}

#[inline(never)]
fn holds_slow<S: Scalar>(op: Binary, a: &Value<S>, b: &Value<S>) -> Result<bool, Fault> {
    match op {
        Binary::Eq => equal(a, b),
        Binary::Ne => equal(a, b).map(|is_equal| !is_equal),
        Binary::Lt => ops::lt(a, b).and_then(|v| ops::truth(&v)),
        Binary::Le => ops::le(a, b).and_then(|v| ops::truth(&v)),
        Binary::Gt => ops::gt(a, b).and_then(|v| ops::truth(&v)),
        _ => ops::ge(a, b).and_then(|v| ops::truth(&v)),
    }
}

#[cfg(test)]
mod tests {
    //! The claim: the fast paths agree with the operators of values.
    use super::*;

    const ARITHMETIC: [Binary; 6] =
        [Binary::Add, Binary::Sub, Binary::Mul, Binary::Div, Binary::Mod, Binary::FloorDiv];
    const COMPARISONS: [Binary; 6] = [Binary::Eq, Binary::Ne, Binary::Lt, Binary::Le, Binary::Gt, Binary::Ge];

    #[test]
    fn fast_and_general_paths_agree() {
        let reals_ = [-2.5, -0.0, 0.0, 1.0, 3.0, f64::INFINITY, f64::NAN];
        let ints_ = [i64::MIN, -7, -1, 0, 1, 3, i64::MAX];
        let bits = |v: &Value| match v {
            Value::Real(x) => (1, x.to_bits()),
            Value::Int(n) => (2, *n as u64),
            other => panic!("{other:?}"),
        };
        for op in ARITHMETIC {
            for (a, b) in reals_.iter().flat_map(|a| reals_.iter().map(move |b| (*a, *b))) {
                if let Some(x) = reals(op, a, b) {
                    let general = values(op, &Value::Real(a), &Value::Real(b)).expect("no fault");
                    assert_eq!(bits(&general), bits(&Value::Real(x)), "{op:?} {a} {b}");
                }
            }
            for (a, b) in ints_.iter().flat_map(|a| ints_.iter().map(move |b| (*a, *b))) {
                if let Some(n) = ints(op, a, b) {
                    let general = values::<f64>(op, &Value::Int(a), &Value::Int(b)).expect("no fault");
                    assert_eq!(bits(&general), bits(&Value::Int(n)), "{op:?} {a} {b}");
                }
            }
        }
        for op in COMPARISONS {
            for (a, b) in reals_.iter().flat_map(|a| reals_.iter().map(move |b| (*a, *b))) {
                let (a, b) = (Value::Real(a), Value::Real(b));
                assert_eq!(holds(op, &a, &b), holds_slow(op, &a, &b), "{op:?} {a:?} {b:?}");
            }
            for (a, b) in ints_.iter().flat_map(|a| ints_.iter().map(move |b| (*a, *b))) {
                let (a, b) = (Value::<f64>::Int(a), Value::Int(b));
                assert_eq!(holds(op, &a, &b), holds_slow(op, &a, &b), "{op:?} {a:?} {b:?}");
            }
        }
    }
}
