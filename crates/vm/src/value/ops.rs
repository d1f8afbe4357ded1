//! The arithmetic and comparison of values: one function for each operator of the language.
//!
//! The cases real with real and int with int come first and are small enough to be inlined into the machine's
//! dispatch. All other cases (strings, sequences, vectors, faults) are in functions that are marked cold.

use std::cmp::Ordering;
use std::sync::Arc;

use super::numbers::{self, Number};
use super::{MAX_ELEMENTS, Scalar, Shape, Text, Value, Vector, compare};
use crate::fault::Fault;
use niwaki_geom::{GeomError, Operation};

/// The result of an operator.
pub type Answer<S> = Result<Value<S>, Fault>;

/// `a + b`.
#[inline]
pub fn add<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => Ok(Value::Real(*a + *b)),
        (Value::Int(x), Value::Int(y)) => match x.checked_add(*y) {
            Some(sum) => Ok(Value::Int(sum)),
            None => Err(numbers::overflow("+", *x, *y)),
        },
        (Value::Real(a), Value::Int(b)) => Ok(Value::Real(*a + S::from_f64(*b as f64))),
        (Value::Int(a), Value::Real(b)) => Ok(Value::Real(S::from_f64(*a as f64) + *b)),
        _ => add_slow(a, b),
    }
}

/// `a - b`.
#[inline]
pub fn sub<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => Ok(Value::Real(*a - *b)),
        (Value::Int(x), Value::Int(y)) => match x.checked_sub(*y) {
            Some(rest) => Ok(Value::Int(rest)),
            None => Err(numbers::overflow("-", *x, *y)),
        },
        (Value::Real(a), Value::Int(b)) => Ok(Value::Real(*a - S::from_f64(*b as f64))),
        (Value::Int(a), Value::Real(b)) => Ok(Value::Real(S::from_f64(*a as f64) - *b)),
        _ => sub_slow(a, b),
    }
}

/// `a * b`.
#[inline]
pub fn mul<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => Ok(Value::Real(*a * *b)),
        (Value::Int(x), Value::Int(y)) => match x.checked_mul(*y) {
            Some(product) => Ok(Value::Int(product)),
            None => Err(numbers::overflow("*", *x, *y)),
        },
        (Value::Real(a), Value::Int(b)) => Ok(Value::Real(*a * S::from_f64(*b as f64))),
        (Value::Int(a), Value::Real(b)) => Ok(Value::Real(S::from_f64(*a as f64) * *b)),
        _ => mul_slow(a, b),
    }
}

/// `a / b`.
#[inline]
pub fn div<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => numbers::divide_reals(*a, *b).map(Value::Real),
        _ => div_slow(a, b),
    }
}

/// `a // b`.
#[inline]
pub fn floordiv<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (Number::of(a), Number::of(b)) {
        (Some(Number::Int(a)), Some(Number::Int(b))) => numbers::floor_divide_ints(a, b).map(Value::Int),
        (Some(a), Some(b)) => numbers::floor_divide_reals(a.real(), b.real()).map(Value::Real),
        _ => Err(mismatch("floor-divide", a, "by", b)),
    }
}

/// `a % b`.
#[inline]
pub fn mod_<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (Number::of(a), Number::of(b)) {
        (Some(Number::Int(a)), Some(Number::Int(b))) => numbers::mod_ints(a, b).map(Value::Int),
        (Some(a), Some(b)) => numbers::mod_reals(a.real(), b.real()).map(Value::Real),
        _ if matches!(a, Value::Str(_)) => {
            Err(mismatch("take the remainder of", a, "by", b).with_help("write an f-string: `f\"{x:.2f}\"`"))
        }
        _ => Err(mismatch("take the remainder of", a, "by", b)),
    }
}

/// `a ** b`.
pub fn pow<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (Number::of(a), Number::of(b)) {
        (Some(Number::Int(a)), Some(Number::Int(b))) => numbers::pow_ints(a, b),
        (Some(a), Some(b)) => numbers::pow_reals(a.real(), b.real()).map(Value::Real),
        _ => Err(mismatch("raise", a, "to the power of", b)),
    }
}

/// `-a`.
#[inline]
pub fn neg<S: Scalar>(a: &Value<S>) -> Answer<S> {
    match a {
        Value::Real(a) => Ok(Value::Real(-*a)),
        Value::Int(n) => match n.checked_neg() {
            Some(n) => Ok(Value::Int(n)),
            None => Err(numbers::overflow("-", 0, *n)),
        },
        Value::Bool(b) => Ok(Value::Int(-i64::from(*b))),
        Value::Vector(v) => Ok(Value::Vector(Arc::new(v.map(|x| -x)))),
        other => Err(no_sign("negate", other)),
    }
}

/// `+a`.
#[inline]
pub fn pos<S: Scalar>(a: &Value<S>) -> Answer<S> {
    match a {
        Value::Real(_) | Value::Int(_) | Value::Vector(_) => Ok(a.clone()),
        Value::Bool(b) => Ok(Value::Int(i64::from(*b))),
        other => Err(no_sign("put a plus sign before", other)),
    }
}

/// Python's truth of a value: zero and empty values are false.
///
/// # Errors
/// The value is a future that is not forced.
#[inline]
pub fn truth<S: Scalar>(a: &Value<S>) -> Result<bool, Fault> {
    Ok(match a {
        Value::Bool(b) => *b,
        Value::Int(n) => *n != 0,
        Value::Real(x) => *x != S::from_f64(0.0),
        Value::None => false,
        Value::Str(text) => !text.is_empty(),
        Value::Tuple(tuple) => !tuple.items().is_empty(),
        Value::List(list) => !list.is_empty(),
        Value::Dict(dict) => !dict.is_empty(),
        Value::Range(range) => range.len > 0,
        Value::Future(_) | Value::Returned(_) => {
            return Err(Fault::not_forced("a future is neither true nor false"));
        }
        _ => true,
    })
}

/// `not a`.
#[inline]
pub fn not_<S: Scalar>(a: &Value<S>) -> Answer<S> {
    truth(a).map(|truth| Value::Bool(!truth))
}

macro_rules! comparisons {
    ($($(#[$doc:meta])* $name:ident $sign:tt => $pattern:pat,)*) => { $(
        $(#[$doc])*
        #[inline]
        pub fn $name<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
            Ok(Value::Bool(match (a, b) {
                (Value::Real(a), Value::Real(b)) => a $sign b,
                (Value::Int(a), Value::Int(b)) => a $sign b,
                _ => matches!(compare::order(a, b, stringify!($sign))?, Some($pattern)),
            }))
        }
    )* };
}

comparisons! {
    /// `a < b`.
    lt < => Ordering::Less,
    /// `a <= b`.
    le <= => Ordering::Less | Ordering::Equal,
    /// `a > b`.
    gt > => Ordering::Greater,
    /// `a >= b`.
    ge >= => Ordering::Greater | Ordering::Equal,
}

/// `a == b`.
#[inline]
pub fn eq<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    compare::equal(a, b).map(Value::Bool)
}

/// `a != b`.
#[inline]
pub fn ne<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    compare::equal(a, b).map(|equal| Value::Bool(!equal))
}

/// The solid that an operation makes of two; a fault if nothing is left of it.
#[cold]
fn cut<S: Scalar>(operation: Operation, a: &Value<S>, b: &Value<S>, shapes: [&Shape; 2]) -> Answer<S> {
    let solid = Shape::combined(operation, shapes[0], shapes[1]);
    let fault =
        |error: GeomError| Fault::bad_shape(error.message).of_call(operation.sign(), &[a.clone(), b.clone()]);
    solid.map(Value::Shape).map_err(fault)
}

macro_rules! bit_operators {
    ($($(#[$doc:meta])* $name:ident $sign:tt $solids:expr;)*) => { $(
        $(#[$doc])*
        pub fn $name<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
            match (a, b) {
                (Value::Bool(a), Value::Bool(b)) => Ok(Value::Bool(a $sign b)),
                (Value::Shape(p), Value::Shape(q)) if let Some(operation) = $solids => cut(operation, a, b, [p, q]),
                _ => match (Number::of(a), Number::of(b)) {
                    (Some(Number::Int(a)), Some(Number::Int(b))) => Ok(Value::Int(a $sign b)),
                    _ => Err(mismatch(concat!("apply `", stringify!($sign), "` to"), a, "and", b)),
                },
            }
        }
    )* };
}

bit_operators! {
    /// `a & b`.
    band & Some(Operation::Intersection);
    /// `a | b`.
    bor | Some(Operation::Union);
    /// `a ^ b`.
    bxor ^ None;
}

/// `~a`.
pub fn invert<S: Scalar>(a: &Value<S>) -> Answer<S> {
    match Number::of(a) {
        Some(Number::Int(n)) => Ok(Value::Int(!n)),
        _ => Err(no_sign("invert the bits of", a)),
    }
}

/// `a << b`.
pub fn shl<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    let (n, by) = shift_operands(a, b, "<<")?;
    let wide = if by < 64 { Some(i128::from(n) << by) } else { (n == 0).then_some(0) };
    let fits = wide.and_then(|wide| i64::try_from(wide).ok());
    fits.map(Value::Int).ok_or_else(|| numbers::overflow("<<", n, by))
}

/// `a >> b`.
pub fn shr<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    let (n, by) = shift_operands(a, b, ">>")?;
    Ok(Value::Int(n >> by.min(63)))
}

fn shift_operands<S: Scalar>(a: &Value<S>, b: &Value<S>, sign: &str) -> Result<(i64, i64), Fault> {
    match (Number::of(a), Number::of(b)) {
        (Some(Number::Int(n)), Some(Number::Int(by))) if by >= 0 => Ok((n, by)),
        (Some(Number::Int(_)), Some(Number::Int(by))) => {
            Err(Fault::bad_argument(format!("a shift by {by} bits: the count cannot be negative")))
        }
        _ => Err(mismatch(&format!("apply `{sign}` to"), a, "and", b)),
    }
}

#[cold]
fn mismatch<S: Scalar>(verb: &str, a: &Value<S>, between: &str, b: &Value<S>) -> Fault {
    Fault::type_mismatch(format!("cannot {verb} {} {between} {}", a.described(), b.described()))
}

#[cold]
fn no_sign<S: Scalar>(verb: &str, a: &Value<S>) -> Fault {
    Fault::type_mismatch(format!("cannot {verb} {}", a.described()))
}

fn fits(count: usize) -> Result<(), Fault> {
    if count <= MAX_ELEMENTS {
        return Ok(());
    }
    Err(Fault::memory_budget(format!("{count} elements are more than one value may hold ({MAX_ELEMENTS})")))
}

#[cold]
fn add_slow<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Vector(v), Value::Vector(w)) => componentwise("add", v, w, |x, y| x + y),
        (Value::List(xs), Value::List(ys)) => {
            fits(xs.len() + ys.len())?;
            let mut both = xs.clone();
            both.extend(ys);
            Ok(Value::List(both))
        }
        (Value::Tuple(xs), Value::Tuple(ys)) => {
            fits(xs.items().len() + ys.items().len())?;
            Ok(Value::tuple([xs.items(), ys.items()].concat()))
        }
        (Value::Str(s), Value::Str(t)) => {
            fits(s.len() + t.len())?;
            Ok(Value::Str(Text::from([&**s, &**t].concat())))
        }
        _ => match (Number::of(a), Number::of(b)) {
            (Some(Number::Int(a)), Some(Number::Int(b))) => add(&Value::Int(a), &Value::Int(b)),
            (Some(a), Some(b)) => Ok(Value::Real(a.real() + b.real())),
            _ => {
                let fault = mismatch("add", a, "and", b);
                Err(match (a, b) {
                    (Value::List(_), Value::Int(_) | Value::Real(_)) => {
                        fault.with_help("write `xs + [x]` to make a list with one more element")
                    }
                    (Value::Vector(_), Value::Tuple(_) | Value::List(_)) => {
                        fault.with_help("write `vec(x, y, z)` for the second operand too")
                    }
                    (Value::Str(_), _) => {
                        fault.with_help("write `str(x)` or an f-string to convert it to text")
                    }
                    _ => fault,
                })
            }
        },
    }
}

#[cold]
fn sub_slow<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Vector(v), Value::Vector(w)) => componentwise("subtract", v, w, |x, y| x - y),
        (Value::Shape(p), Value::Shape(q)) => cut(Operation::Difference, a, b, [p, q]),
        _ => match (Number::of(a), Number::of(b)) {
            (Some(Number::Int(a)), Some(Number::Int(b))) => sub(&Value::Int(a), &Value::Int(b)),
            (Some(a), Some(b)) => Ok(Value::Real(a.real() - b.real())),
            _ => {
                Err(Fault::type_mismatch(format!("cannot subtract {} from {}", b.described(), a.described())))
            }
        },
    }
}

#[cold]
fn mul_slow<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (a, b) {
        (Value::Rotation(r), Value::Vector(v)) => rotate(r, v),
        (Value::Rotation(r), Value::Rotation(s)) => Ok(Value::Rotation(Arc::new(matrix_product(r, s)))),
        _ => match (Number::of(a), Number::of(b)) {
            (Some(Number::Int(a)), Some(Number::Int(b))) => mul(&Value::Int(a), &Value::Int(b)),
            (Some(a), Some(b)) => Ok(Value::Real(a.real() * b.real())),
            (Some(x), None) => times(b, x).unwrap_or_else(|| Err(mismatch("multiply", a, "by", b))),
            (None, Some(x)) => times(a, x).unwrap_or_else(|| Err(mismatch("multiply", a, "by", b))),
            (None, None) => Err(mismatch("multiply", a, "by", b)),
        },
    }
}

/// A vector times a number, or a repeated sequence; `None` when the two do not fit.
fn times<S: Scalar>(value: &Value<S>, by: Number<S>) -> Option<Answer<S>> {
    if let Value::Vector(v) = value {
        let by = by.real();
        return Some(Ok(Value::Vector(Arc::new(v.map(|x| x * by)))));
    }
    let Number::Int(count) = by else { return None };
    let count = usize::try_from(count).unwrap_or(0);
    match value {
        Value::List(list) => {
            Some(fits(list.len().saturating_mul(count)).map(|()| Value::List(list.repeated(count))))
        }
        Value::Tuple(tuple) => Some(fits(tuple.items().len().saturating_mul(count)).map(|()| {
            // An empty tuple is repeated at once, however large the count is.
            let count = if tuple.items().is_empty() { 0 } else { count };
            let mut items = Vec::with_capacity(tuple.items().len() * count);
            (0..count).for_each(|_| items.extend_from_slice(tuple.items()));
            Value::tuple(items)
        })),
        Value::Str(text) => {
            Some(fits(text.len().saturating_mul(count)).map(|()| Value::Str(Text::from(text.repeat(count)))))
        }
        _ => None,
    }
}

#[cold]
fn div_slow<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Answer<S> {
    match (Number::of(a), Number::of(b), a) {
        (Some(Number::Int(a)), Some(Number::Int(b)), _) => numbers::divide_ints(a, b).map(Value::real),
        (Some(a), Some(b), _) => numbers::divide_reals(a.real(), b.real()).map(Value::Real),
        (None, Some(b), Value::Vector(v)) => {
            let by = b.real();
            if by.value() == 0.0 {
                return Err(Fault::division_by_zero("division of a vector by zero"));
            }
            Ok(Value::Vector(Arc::new(v.map(|x| x / by))))
        }
        _ => Err(mismatch("divide", a, "by", b)),
    }
}

/// Combines two vectors of equal length, component by component.
fn componentwise<S: Scalar>(verb: &str, v: &Vector<S>, w: &Vector<S>, f: impl Fn(S, S) -> S) -> Answer<S> {
    v.with(w, f).map(|sum| Value::Vector(Arc::new(sum))).ok_or_else(|| {
        let (v, w) = (v.components().len(), w.components().len());
        Fault::type_mismatch(format!("cannot {verb} vectors of {v} and {w} components"))
    })
}

/// A rotation applied to a vector of three components.
fn rotate<S: Scalar>(r: &[S; 9], v: &Vector<S>) -> Answer<S> {
    let &[x, y, z] = v.components() else {
        let count = v.components().len();
        let message = format!("a rotation turns vectors of 3 components, not of {count}");
        return Err(Fault::type_mismatch(message));
    };
    let row = |i: usize| r[i] * x + r[i + 1] * y + r[i + 2] * z;
    Ok(Value::vector(&[row(0), row(3), row(6)]))
}

/// The rotation `r` after `s`.
fn matrix_product<S: Scalar>(r: &[S; 9], s: &[S; 9]) -> [S; 9] {
    std::array::from_fn(|at| {
        let (row, column) = (at / 3 * 3, at % 3);
        r[row] * s[column] + r[row + 1] * s[column + 3] + r[row + 2] * s[column + 6]
    })
}

/// `xs + [x]` without a second list.
pub fn append<S: Scalar>(xs: Value<S>, item: Value<S>) -> Answer<S> {
    match xs {
        Value::List(mut list) => {
            fits(list.len() + 1)?;
            list.append(item);
            Ok(Value::List(list))
        }
        other => Err(Fault::type_mismatch(format!("cannot append to {}", other.described()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type V = Value<f64>;

    fn ints(items: &[i64]) -> V {
        V::list(items.iter().copied().map(V::Int).collect())
    }

    fn message(answer: Answer<f64>) -> String {
        answer.map_or_else(|fault| fault.message.clone(), |value| panic!("an answer: {value:?}"))
    }

    fn code(answer: Answer<f64>) -> &'static str {
        answer.map_or_else(|fault| fault.code, |value| panic!("an answer: {value:?}"))
    }

    /// The result of an operator with its kind: `==` alone does not distinguish 1 from 1.0.
    fn shown(answer: Answer<f64>) -> String {
        answer.map_or_else(|fault| fault.code.to_string(), |value| format!("{value:?}"))
    }

    #[test]
    fn every_pair_of_kinds_of_number_gives_pythons_kind() {
        let (t, i, x) = (V::Bool(true), V::Int(3), V::real(0.5));
        assert_eq!(shown(add(&t, &t)), "2");
        assert_eq!(shown(add(&t, &i)), "4");
        assert_eq!(shown(add(&i, &x)), "3.5");
        assert_eq!(shown(sub(&t, &x)), "0.5");
        assert_eq!(shown(mul(&t, &i)), "3");
        assert_eq!(shown(div(&i, &t)), "3.0");
        assert_eq!(shown(div(&V::Int(6), &V::Int(3))), "2.0");
        assert_eq!(shown(floordiv(&V::real(7.5), &i)), "2.0");
        assert_eq!(shown(floordiv(&V::Int(-7), &V::Int(2))), "-4");
        assert_eq!(shown(mod_(&V::real(-7.5), &i)), "1.5");
        assert_eq!(shown(pow(&i, &V::Int(2))), "9");
        assert_eq!(shown(pow(&i, &V::Int(-1))), "0.3333333333333333");
        assert_eq!(shown(neg(&t)), "-1");
        assert_eq!(shown(pos(&t)), "1");
        assert_eq!(shown(invert(&i)), "-4");
        assert_eq!(shown(band(&t, &V::Bool(false))), "False");
        assert_eq!(shown(bor(&t, &i)), "3");
        assert_eq!(shown(shr(&V::Int(-5), &V::Int(1))), "-3");
        assert_eq!(shown(shl(&V::Int(1), &V::Int(62))), "4611686018427387904");
        assert_eq!(shown(shl(&V::Int(1), &V::Int(63))), "integer-overflow");
        assert_eq!(shown(shl(&V::Int(-1), &V::Int(63))), "-9223372036854775808");
        assert_eq!(shown(shl(&V::Int(0), &V::Int(1000))), "0");
    }

    #[test]
    fn empty_sequences_are_repeated_at_once() {
        for empty in [V::list(vec![]), V::tuple(vec![])] {
            let product = mul(&empty, &V::Int(i64::MAX)).unwrap();
            assert!(matches!(product, V::List(_) | V::Tuple(_)));
        }
    }

    #[test]
    fn whole_numbers_overflow_with_a_fault() {
        let (most, least, unit) = (V::Int(i64::MAX), V::Int(i64::MIN), V::Int(1));
        assert_eq!(message(add(&most, &unit)), "9223372036854775807 + 1 does not fit in 64 bits");
        assert_eq!(code(sub(&least, &unit)), "integer-overflow");
        assert_eq!(code(mul(&most, &V::Int(2))), "integer-overflow");
        assert_eq!(code(neg(&least)), "integer-overflow");
        assert_eq!(code(div(&unit, &V::Int(0))), "division-by-zero");
        assert_eq!(code(mod_(&V::real(1.0), &V::Int(0))), "division-by-zero");
    }

    #[test]
    fn sequences_add_and_repeat() {
        assert_eq!(add(&ints(&[1]), &ints(&[2, 3])), Ok(ints(&[1, 2, 3])));
        assert_eq!(mul(&ints(&[1, 2]), &V::Int(2)), Ok(ints(&[1, 2, 1, 2])));
        assert_eq!(mul(&V::Int(-1), &ints(&[1])), Ok(ints(&[])));
        assert_eq!(mul(&V::str("ab"), &V::Bool(true)), Ok(V::str("ab")));
        assert_eq!(add(&V::tuple(vec![V::Int(1)]), &V::tuple(vec![])), Ok(V::tuple(vec![V::Int(1)])));
        assert_eq!(code(mul(&ints(&[1, 2]), &V::Int(1 << 40))), "memory-budget");
        assert_eq!(message(add(&ints(&[1]), &V::Int(2))), "cannot add a list and an int");
        assert_eq!(message(mul(&ints(&[1]), &V::real(2.0))), "cannot multiply a list by a float");
        assert_eq!(message(sub(&V::str("a"), &V::None)), "cannot subtract None from a str");
    }

    #[test]
    fn vectors_scale_and_add_but_do_not_broadcast() {
        let v = V::vector(&[1.0, 2.0, 3.0]);
        assert_eq!(add(&v, &v), Ok(V::vector(&[2.0, 4.0, 6.0])));
        assert_eq!(mul(&V::Int(2), &v), mul(&v, &V::real(2.0)));
        assert_eq!(div(&v, &V::Int(2)), Ok(V::vector(&[0.5, 1.0, 1.5])));
        assert_eq!(neg(&v), Ok(V::vector(&[-1.0, -2.0, -3.0])));
        assert_eq!(code(add(&v, &V::real(1.0))), "type-mismatch");
        assert_eq!(code(mul(&v, &v)), "type-mismatch");
        assert_eq!(code(add(&v, &V::vector(&[1.0, 2.0]))), "type-mismatch");
        assert_eq!(code(div(&v, &V::Int(0))), "division-by-zero");
        assert_eq!(code(div(&V::Int(1), &v)), "type-mismatch");
    }

    #[test]
    fn comparisons_name_their_sign() {
        let nan = V::real(f64::NAN);
        for compare in [lt, le, gt, ge, eq] {
            assert_eq!(compare(&nan, &nan), Ok(V::Bool(false)));
        }
        assert_eq!(ne(&nan, &nan), Ok(V::Bool(true)));
        assert_eq!(le(&V::Int(1), &V::real(1.0)), Ok(V::Bool(true)));
        assert_eq!(ge(&ints(&[1, 2]), &ints(&[1])), Ok(V::Bool(true)));
        assert_eq!(message(le(&V::None, &V::Int(1))), "`<=` has no meaning between None and an int");
        assert_eq!(eq(&V::None, &V::Int(1)), Ok(V::Bool(false)));
    }

    #[test]
    fn zero_and_empty_are_false() {
        let falses =
            [V::None, V::Int(0), V::real(-0.0), V::str(""), ints(&[]), V::tuple(vec![]), V::Bool(false)];
        assert!(falses.iter().all(|value| truth(value) == Ok(false)));
        let trues = [V::real(f64::NAN), V::str(" "), ints(&[0]), V::vector(&[0.0, 0.0])];
        assert!(trues.iter().all(|value| truth(value) == Ok(true)));
        let future = truth(&Value::<f64>::returned(Value::Bool(true)));
        assert_eq!(future.unwrap_err().code, "future-not-forced");
    }
}
