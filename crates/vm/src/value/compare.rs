//! Python's `==`, `<` and hashing of keys.
//!
//! Both values are visited in lockstep, on a stack of our own, up to the first place where they differ. `==`
//! tests whether there is such a place; `<` compares the two elements there (lexicographic order at every
//! level, as Python defines it for sequences). Numbers compare exactly across int, bool and float.
//!
//! differs: Python's containers treat an object as equal to itself before they call `==`. So in Python a list
//! with a NaN object equals another list with the same object. Here a NaN in two different lists is unequal,
//! and in one list it is equal.

use std::cmp::Ordering;
use std::sync::Arc;

use super::{ClassKind, Dict, List, Scalar, Value};
use crate::fault::Fault;

/// The most pairs of elements that one comparison may visit: two unshared copies of a value that shares parts
/// of itself would otherwise take exponential time.
const BUDGET: usize = 1 << 26;

/// The operation that the fault of a future names.
const COMPARED: &str = "compared";

/// Python's `a == b`.
#[inline]
pub fn equal<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Result<bool, Fault> {
    if let Some(order) = leaves_ordered(a, b) {
        return Ok(order == Some(Ordering::Equal));
    }
    a.refuse_futures(COMPARED)?;
    b.refuse_futures(COMPARED)?;
    match leaves_equal(a, b) {
        Some(answer) => Ok(answer),
        None => Ok(first_difference(a, b)?.is_none()),
    }
}

/// Python's order of two values. `None` when one of them is a NaN at the first difference; a fault for values
/// without an order. `sign` is the operator that the message names (`<`, `>=`, ...).
pub fn order<S: Scalar>(a: &Value<S>, b: &Value<S>, sign: &str) -> Result<Option<Ordering>, Fault> {
    if let Some(order) = leaves_ordered(a, b) {
        return Ok(order);
    }
    a.refuse_futures(COMPARED)?;
    b.refuse_futures(COMPARED)?;
    let (mut left, mut right) = (a, b);
    if Items::both_sequences(a, b) {
        match first_difference(a, b)? {
            None => return Ok(Some(Ordering::Equal)),
            Some(Difference::Lengths(a, b)) => return Ok(Some(a.cmp(&b))),
            Some(Difference::Values(a, b)) => (left, right) = (a, b),
        }
    }
    leaves_ordered(left, right).ok_or_else(|| no_order(left, right, sign))
}

#[cold]
fn no_order<S: Scalar>(a: &Value<S>, b: &Value<S>, sign: &str) -> Fault {
    Fault::type_mismatch(format!("`{sign}` has no meaning between {} and {}", a.described(), b.described()))
}

/// The exact order of a whole number and a real number.
pub fn int_to_real(a: i64, b: f64) -> Option<Ordering> {
    const LIMIT: f64 = 9_223_372_036_854_775_808.0; // 2^63
    if b.is_nan() {
        None
    } else if b >= LIMIT {
        Some(Ordering::Less)
    } else if b < -LIMIT {
        Some(Ordering::Greater)
    } else {
        // In range, the whole part converts exactly, and the fraction breaks ties.
        Some(a.cmp(&(b.trunc() as i64)).then(0.0_f64.partial_cmp(&b.fract())?))
    }
}

/// The order of two values without parts. The outer `None` means that they have no order.
#[inline]
fn leaves_ordered<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Option<Option<Ordering>> {
    Some(match (a, b) {
        (Value::Real(a), Value::Real(b)) => a.partial_cmp(b),
        (Value::Int(a), Value::Int(b)) => Some(a.cmp(b)),
        (Value::Int(a), Value::Real(b)) if b.varies() => S::from_f64(*a as f64).partial_cmp(b),
        (Value::Int(a), Value::Real(b)) => int_to_real(*a, b.value()),
        (Value::Real(a), Value::Int(b)) if a.varies() => a.partial_cmp(&S::from_f64(*b as f64)),
        (Value::Real(a), Value::Int(b)) => int_to_real(*b, a.value()).map(Ordering::reverse),
        (Value::Bool(a), b) => return leaves_ordered(&Value::Int(i64::from(*a)), b),
        (a, Value::Bool(b)) => return leaves_ordered(a, &Value::Int(i64::from(*b))),
        (Value::Str(a), Value::Str(b)) => Some(str::cmp(a, b)),
        _ => return None,
    })
}

/// The equality of two values, if no visit to their parts is needed.
#[inline]
fn leaves_equal<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Option<bool> {
    let scalars_equal = |a: &[S], b: &[S]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b);
    if let Some(order) = leaves_ordered(a, b) {
        return Some(order == Some(Ordering::Equal));
    }
    Some(match (a, b) {
        (Value::None, Value::None) => true,
        (Value::Range(a), Value::Range(b)) => a.equals(b),
        (Value::Vector(a), Value::Vector(b)) => scalars_equal(a.components(), b.components()),
        (Value::Rotation(a), Value::Rotation(b)) => scalars_equal(&a[..], &b[..]),
        (Value::Shape(a), Value::Shape(b)) => a == b,
        (Value::Dist(a), Value::Dist(b)) => Arc::ptr_eq(a, b) || a == b,
        (Value::Tuple(a), Value::Tuple(b)) if a.ptr_eq(b) => true,
        (Value::List(a), Value::List(b)) if a.ptr_eq(b) => true,
        (Value::Record(a), Value::Record(b)) if Arc::ptr_eq(a, b) => true,
        (Value::Dict(a), Value::Dict(b)) if Arc::ptr_eq(a, b) => true,
        (Value::Function(a), Value::Function(b)) if Arc::ptr_eq(a, b) => true,
        (Value::Dict(_), Value::Dict(_)) | (Value::Function(_), Value::Function(_)) => return None,
        _ if Items::comparable(a, b) => return None,
        _ => false,
    })
}

/// A sequence, accessed element by element.
#[derive(Clone, Copy)]
enum Items<'a, S: Scalar> {
    Flat(&'a [Value<S>]),
    List(&'a List<S>),
}

impl<'a, S: Scalar> Items<'a, S> {
    fn of(value: &'a Value<S>) -> Option<Items<'a, S>> {
        match value {
            Value::Tuple(tuple) => Some(Items::Flat(tuple.items())),
            Value::List(list) => Some(Items::List(list)),
            Value::Record(record) => Some(Items::Flat(&record.fields)),
            Value::Function(closure) => Some(Items::Flat(&closure.captures)),
            Value::Dict(dict) => Some(Items::Flat(dict.values())),
            _ => None,
        }
    }

    fn len(self) -> usize {
        match self {
            Items::Flat(items) => items.len(),
            Items::List(list) => list.len(),
        }
    }

    fn get(self, at: usize) -> Option<&'a Value<S>> {
        match self {
            Items::Flat(items) => items.get(at),
            Items::List(list) => list.get(at),
        }
    }

    /// True when Python compares the two values element by element: values of one kind, and named tuples with
    /// tuples.
    fn comparable(a: &Value<S>, b: &Value<S>) -> bool {
        let tuple_like = |value: &Value<S>| match value {
            Value::Tuple(_) => true,
            Value::Record(record) => record.class.kind == ClassKind::NamedTuple,
            _ => false,
        };
        match (a, b) {
            (Value::List(_), Value::List(_)) => true,
            (Value::Record(a), Value::Record(b)) if a.class.id == b.class.id => true,
            _ => tuple_like(a) && tuple_like(b),
        }
    }

    /// True when Python orders the two values element by element (dataclasses have no order).
    fn both_sequences(a: &Value<S>, b: &Value<S>) -> bool {
        let dataclass = |value: &Value<S>| matches!(value, Value::Record(record) if record.class.kind == ClassKind::Dataclass);
        Items::comparable(a, b) && !dataclass(a)
    }
}

/// The first difference of two values, in order of reading.
enum Difference<'a, S: Scalar> {
    /// Two values at the same place: at least one has no parts, or they are of different kinds.
    Values(&'a Value<S>, &'a Value<S>),
    /// One sequence is the beginning of the other.
    Lengths(usize, usize),
}

/// Two values visited in lockstep, and the next place to visit.
struct Lockstep<'a, S: Scalar> {
    sides: Sides<'a, S>,
    next: usize,
}

#[derive(Clone, Copy)]
enum Sides<'a, S: Scalar> {
    InOrder(Items<'a, S>, Items<'a, S>),
    /// Values of equal keys: the order of keys is not part of a dictionary's value.
    ByKey(&'a Dict<S>, &'a Dict<S>),
}

impl<'a, S: Scalar> Sides<'a, S> {
    /// The way to visit two values whose parts are compared; `None` when they differ already.
    fn of(a: &'a Value<S>, b: &'a Value<S>) -> Option<Sides<'a, S>> {
        match (a, b) {
            (Value::Dict(a), Value::Dict(b)) => (a.len() == b.len()).then_some(Sides::ByKey(a, b)),
            (Value::Function(f), Value::Function(g)) if f.function != g.function || f.memo != g.memo => None,
            _ => Some(Sides::InOrder(Items::of(a)?, Items::of(b)?)),
        }
    }
}

fn first_difference<'a, S: Scalar>(
    a: &'a Value<S>,
    b: &'a Value<S>,
) -> Result<Option<Difference<'a, S>>, Fault> {
    let mut stack: Vec<Lockstep<'a, S>> = Vec::new();
    let mut pair = Some((a, b));
    for _ in 0..BUDGET {
        if let Some((a, b)) = pair.take() {
            match leaves_equal(a, b) {
                Some(true) => {}
                Some(false) => return Ok(Some(Difference::Values(a, b))),
                None => match Sides::of(a, b) {
                    Some(sides) => stack.push(Lockstep { sides, next: 0 }),
                    None => return Ok(Some(Difference::Values(a, b))),
                },
            }
        }
        let Some(lockstep) = stack.last_mut() else { return Ok(None) };
        let (left, right, lengths) = match lockstep.sides {
            Sides::InOrder(a, b) => (a.get(lockstep.next), b.get(lockstep.next), (a.len(), b.len())),
            Sides::ByKey(a, b) => {
                let left = a.values().get(lockstep.next);
                let right = a.keys().get(lockstep.next).and_then(|key| b.get(key));
                (left, right, (a.len(), b.len()))
            }
        };
        lockstep.next += 1;
        match (left, right) {
            (Some(a), Some(b)) => pair = Some((a, b)),
            (None, None) => drop(stack.pop()),
            _ => return Ok(Some(Difference::Lengths(lengths.0, lengths.1))),
        }
    }
    Err(Fault::step_budget("this comparison visits more than 67108864 elements"))
}

/// A hash that is the same for equal keys: `1`, `1.0` and `True` are one key, as in Python.
pub fn hash<S: Scalar>(value: &Value<S>) -> u64 {
    const PRIME: u64 = 0x9E37_79B9_7F4A_7C15;
    let mut state: u64 = 0;
    let mut mix = |part: u64| state = (state.rotate_left(5) ^ part).wrapping_mul(PRIME);
    let mut work = vec![value];
    while let Some(value) = work.pop() {
        match value {
            Value::None => mix(1),
            Value::Bool(b) => mix(u64::from(*b)),
            Value::Int(n) => mix(*n as u64),
            Value::Real(x) => {
                let x = x.value();
                let whole = x as i64;
                mix(if int_to_real(whole, x) == Some(Ordering::Equal) { whole as u64 } else { x.to_bits() });
            }
            Value::Str(text) => text.bytes().for_each(|byte| mix(u64::from(byte))),
            Value::Tuple(tuple) => {
                mix(tuple.items().len() as u64);
                work.extend(tuple.items());
            }
            Value::Record(record) => {
                mix(record.fields.len() as u64);
                work.extend(&record.fields);
            }
            other => mix(other.kind().len() as u64),
        }
    }
    state
}

impl<S: Scalar> Value<S> {
    /// Returns a fault if the value cannot be the key of a query.
    ///
    /// # Errors
    /// The value is a list, a dict, a shape, a function or a distribution, or a tuple or record that holds one.
    pub fn refuse_as_key(&self) -> Result<(), Fault> {
        let mut work = vec![self];
        while let Some(value) = work.pop() {
            match value {
                Value::Tuple(tuple) => work.extend(tuple.items()),
                Value::Record(record) => work.extend(&record.fields),
                Value::List(_) | Value::Dict(_) | Value::Shape(_) | Value::Function(_) | Value::Dist(_) => {
                    return Err(Fault::type_mismatch(format!("{} cannot be a key", value.described())));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Python's `==`, for tests and tables. Values count as different beyond the budget of a comparison.
impl<S: Scalar> PartialEq for Value<S> {
    fn eq(&self, other: &Value<S>) -> bool {
        equal(self, other).unwrap_or(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type V = Value<f64>;
    fn ints(items: &[i64]) -> Vec<V> {
        items.iter().copied().map(Value::Int).collect()
    }

    #[test]
    fn numbers_compare_exactly_across_kinds() {
        let big = 9_007_199_254_740_993_i64; // 2^53 + 1, not a float
        assert_eq!(int_to_real(big, 9_007_199_254_740_992.0), Some(Ordering::Greater));
        assert_eq!(int_to_real(i64::MAX, 9_223_372_036_854_775_808.0), Some(Ordering::Less));
        assert_eq!(int_to_real(-3, -3.5), Some(Ordering::Greater));
        assert_eq!(int_to_real(3, 3.5), Some(Ordering::Less));
        assert_eq!(int_to_real(0, f64::NAN), None);
        assert_eq!(V::Int(1), V::real(1.0));
        assert_eq!(V::Bool(true), V::real(1.0));
        assert_ne!(V::real(f64::NAN), V::real(f64::NAN));
        assert_eq!(V::real(-0.0), V::Int(0));
        assert_ne!(V::str("1"), V::Int(1));
    }

    #[test]
    fn sequences_are_ordered_by_the_first_difference() {
        let less = |a: V, b: V| order(&a, &b, "<").map(|o| o == Some(Ordering::Less));
        assert_eq!(less(V::list(ints(&[1, 2])), V::list(ints(&[1, 3]))), Ok(true));
        assert_eq!(less(V::list(ints(&[1, 2])), V::list(ints(&[1, 2, 0]))), Ok(true));
        assert_eq!(less(V::tuple(ints(&[2])), V::tuple(ints(&[1, 5]))), Ok(false));
        let nested = |n: i64, m: i64| V::list(vec![V::tuple(ints(&[1, n])), V::Int(m)]);
        assert_eq!(less(nested(1, 9), nested(2, 0)), Ok(true));
        let fault = less(V::list(ints(&[1])), V::tuple(ints(&[1]))).unwrap_err();
        assert_eq!(fault.message, "`<` has no meaning between a list and a tuple");
        let fault = less(V::list(vec![V::str("a")]), V::list(ints(&[1]))).unwrap_err();
        assert_eq!(fault.message, "`<` has no meaning between a str and an int");
    }

    #[test]
    fn dictionaries_are_equal_in_any_order_of_keys() {
        let dict = |pairs: &[(&str, i64)]| {
            let pairs = pairs.iter().map(|(k, v)| (V::str(k), V::Int(*v))).collect();
            V::Dict(Arc::new(Dict::new(pairs)))
        };
        assert_eq!(dict(&[("a", 1), ("b", 2)]), dict(&[("b", 2), ("a", 1)]));
        assert_ne!(dict(&[("a", 1), ("b", 2)]), dict(&[("a", 1), ("b", 3)]));
        assert_ne!(dict(&[("a", 1)]), dict(&[("b", 1)]));
        let many = |n: i64| {
            V::Dict(Arc::new(Dict::new((0..n).map(|k| (V::Int(k), V::real(k as f64 + 0.5))).collect())))
        };
        assert_eq!(many(100), many(100));
        let Value::Dict(dict) = many(100) else { unreachable!() };
        assert_eq!(dict.get(&V::real(7.0)), Some(&V::real(7.5)));
        assert_eq!(dict.get(&V::real(7.5)), None);
    }

    #[test]
    fn a_later_equal_key_replaces_the_value_and_keeps_the_place() {
        let pairs = vec![(V::Int(1), V::str("a")), (V::Int(2), V::str("b")), (V::real(1.0), V::str("c"))];
        let dict = Dict::new(pairs);
        assert_eq!(dict.keys(), &ints(&[1, 2])[..]);
        assert_eq!(dict.values(), &[V::str("c"), V::str("b")]);
    }

    #[test]
    fn chains_of_a_million_are_compared_without_the_host_stack() {
        let chain = |end: i64| (0..1_000_000).fold(V::Int(end), |inner, _| V::list(vec![inner]));
        assert_eq!(equal(&chain(1), &chain(1)), Ok(true));
        assert_eq!(equal(&chain(1), &chain(2)), Ok(false));
        assert_eq!(order(&chain(1), &chain(2), "<"), Ok(Some(Ordering::Less)));
        let tuples = (0..1_000_000).fold(V::Int(0), |inner, _| V::tuple(vec![inner]));
        assert_eq!(hash(&tuples), hash(&tuples.clone()));
    }
}
