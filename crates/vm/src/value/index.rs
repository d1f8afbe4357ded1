//! Elements of values: `x[i]`, `x[a:b:c]`, `x in xs`, `len`, and iteration.
//!
//! A named tuple is indexed like a tuple. A dictionary is indexed by key, and a loop visits its keys.

use std::sync::Arc;

use super::numbers::Number;
use super::{ClassKind, List, Range, Scalar, Text, Value, equal, print};
use crate::fault::Fault;

/// The fields of a record that is also a tuple.
fn as_tuple<S: Scalar>(value: &Value<S>) -> Option<&[Value<S>]> {
    match value {
        Value::Tuple(tuple) => Some(tuple.items()),
        Value::Record(record) if record.class.kind == ClassKind::NamedTuple => Some(&record.fields),
        _ => None,
    }
}

/// The number of elements that a loop over this value visits; a fault when it cannot be looped over.
#[inline]
pub fn iter_len<S: Scalar>(value: &Value<S>) -> Result<usize, Fault> {
    length(value).ok_or_else(|| {
        let fault =
            Fault::type_mismatch(format!("cannot loop over {}: it has no elements", value.described()));
        match value {
            Value::Int(_) => fault.with_help("write `range(n)` to count"),
            _ => fault,
        }
    })
}

/// Element `at` of a loop over a value; `None` (the value) beyond [`iter_len`].
#[inline]
pub fn iter_get<S: Scalar>(value: &Value<S>, at: usize) -> Value<S> {
    match value {
        Value::List(list) => list.get(at).cloned().unwrap_or_default(),
        Value::Range(range) if at < range.len => Value::Int(range.at(at)),
        Value::Str(text) if at < text.chars_len() => Value::str(text.char_at(at)),
        Value::Dict(dict) => dict.keys().get(at).cloned().unwrap_or_default(),
        Value::Vector(v) => v.components().get(at).copied().map(Value::Real).unwrap_or_default(),
        Value::Rotation(r) => match r.chunks(3).nth(at) {
            Some(row) => Value::tuple(row.iter().copied().map(Value::Real).collect()),
            None => Value::None,
        },
        _ => as_tuple(value).and_then(|items| items.get(at)).cloned().unwrap_or_default(),
    }
}

/// `value[at]` without a copy, for a list or tuple and an integer position within it.
#[inline(always)]
pub fn index_ref<'a, S: Scalar>(value: &'a Value<S>, at: &Value<S>) -> Option<&'a Value<S>> {
    let Value::Int(at) = *at else { return None };
    let at = usize::try_from(at).ok()?;
    match value {
        Value::List(list) => list.get(at),
        Value::Tuple(tuple) => tuple.items().get(at),
        _ => None,
    }
}

/// Every element of a loop over a value, in order.
pub fn iter_all<S: Scalar>(value: &Value<S>) -> Result<Vec<Value<S>>, Fault> {
    let count = iter_len(value)?;
    if count > super::MAX_ELEMENTS {
        return Err(Fault::memory_budget(format!("{count} elements are more than one value may hold")));
    }
    Ok(match value {
        Value::List(list) => list.iter().cloned().collect(),
        Value::Str(text) => text.chars().map(|c| Value::str(c.encode_utf8(&mut [0; 4]))).collect(),
        Value::Dict(dict) => dict.keys().to_vec(),
        _ => match as_tuple(value) {
            Some(items) => items.to_vec(),
            None => (0..count).map(|at| iter_get(value, at)).collect(),
        },
    })
}

#[inline]
fn length<S: Scalar>(value: &Value<S>) -> Option<usize> {
    match value {
        Value::List(list) => Some(list.len()),
        Value::Range(range) => Some(range.len),
        Value::Str(text) => Some(text.chars_len()),
        Value::Dict(dict) => Some(dict.len()),
        Value::Vector(v) => Some(v.components().len()),
        Value::Rotation(_) => Some(3),
        _ => as_tuple(value).map(<[Value<S>]>::len),
    }
}

/// `len(x)`.
#[inline]
pub fn len<S: Scalar>(value: &Value<S>) -> Result<usize, Fault> {
    length(value).ok_or_else(|| Fault::type_mismatch(format!("{} has no length", value.described())))
}

/// `x[i]`.
#[inline]
pub fn index<S: Scalar>(value: &Value<S>, at: &Value<S>) -> Result<Value<S>, Fault> {
    let item = match (value, at) {
        (Value::List(list), Value::Int(n)) => place(*n, list.len()).and_then(|at| list.get(at)),
        (Value::Tuple(tuple), Value::Int(n)) => {
            place(*n, tuple.items().len()).and_then(|at| tuple.items().get(at))
        }
        _ => None,
    };
    match item {
        Some(item) => Ok(item.clone()),
        None => index_slow(value, at),
    }
}

/// Converts a position that may count from the back to a position from the front; `None` outside.
#[inline]
fn place(n: i64, len: usize) -> Option<usize> {
    let at = if n < 0 { n.checked_add(i64::try_from(len).ok()?)? } else { n };
    usize::try_from(at).ok().filter(|at| *at < len)
}

fn index_slow<S: Scalar>(value: &Value<S>, at: &Value<S>) -> Result<Value<S>, Fault> {
    if let Value::Dict(dict) = value {
        return dict.get(at).cloned().ok_or_else(|| missing_key(at));
    }
    let Some(len) = length(value) else {
        return Err(Fault::type_mismatch(format!("cannot take an element of {}", value.described())));
    };
    let n = match Number::of(at) {
        Some(Number::Int(n)) => n,
        Some(Number::Real(x)) => {
            let message = format!("a position must be an int, found the float {}", print::float(x.value()));
            return Err(
                Fault::type_mismatch(message).with_help("write `int(x)` or `x // n` with whole numbers")
            );
        }
        None => {
            let message = format!("cannot take the element of {} at {}", value.described(), at.described());
            return Err(Fault::type_mismatch(message));
        }
    };
    let Some(at) = place(n, len) else {
        let (kind, s) = (value.kind(), if len == 1 { "" } else { "s" });
        let message = format!("{kind} index {n} is out of range: the {kind} has {len} element{s}");
        return Err(Fault::list_index(message));
    };
    Ok(iter_get(value, at))
}

/// The fault for a key that a dictionary does not have.
#[cold]
pub fn missing_key<S: Scalar>(key: &Value<S>) -> Fault {
    let shown = print::repr(key).unwrap_or_else(|_| key.described());
    Fault::missing_key(format!("the dict has no key {shown}"))
        .with_help("`d.get(key, default)` returns the default for a missing key")
}

/// The number of elements of `x[lo:hi:step]`, if the slice builds a new value of them.
pub fn slice_len<S: Scalar>(
    value: &Value<S>,
    lo: &Value<S>,
    hi: &Value<S>,
    step: &Value<S>,
) -> Option<usize> {
    let len = length(value)?;
    let range = bounds(len, lo, hi, step).ok()?;
    match value {
        Value::List(_) if range.len == len && range.step == 1 => None,
        Value::Range(_) => None,
        _ => Some(range.len),
    }
}

/// `x[lo:hi:step]`; absent bounds are `None`.
pub fn slice<S: Scalar>(
    value: &Value<S>,
    lo: &Value<S>,
    hi: &Value<S>,
    step: &Value<S>,
) -> Result<Value<S>, Fault> {
    let len = match value {
        Value::Dict(_) => None,
        _ => length(value),
    };
    let Some(len) = len else {
        return Err(Fault::type_mismatch(format!("cannot take a slice of {}", value.described())));
    };
    let range = bounds(len, lo, hi, step)?;
    let places = || (0..range.len).map(|at| range.at(at) as usize);
    Ok(match value {
        Value::List(list) if range.len == len && range.step == 1 => Value::List(list.clone()),
        Value::List(list) => {
            Value::List(List::from_vec(places().filter_map(|at| list.get(at).cloned()).collect()))
        }
        Value::Str(text) if range.step == 1 => {
            let from = range.start.max(0) as usize;
            Value::str(text.span(from, from + range.len))
        }
        Value::Str(text) => {
            let chars: Vec<char> = text.chars().collect();
            Value::Str(Text::from(places().map(|at| chars[at]).collect::<String>()))
        }
        Value::Range(outer) => {
            let at = |n: i64| outer.start.wrapping_add(outer.step.wrapping_mul(n));
            let stop = range.start.saturating_add(range.step.saturating_mul(range.len as i64));
            let part = Range {
                start: at(range.start),
                stop: at(stop),
                step: outer.step.saturating_mul(range.step),
                len: range.len,
            };
            Value::Range(Arc::new(part))
        }
        other => Value::tuple(places().map(|at| iter_get(other, at)).collect()),
    })
}

/// The positions that a slice selects, as a range inside `0..len`.
fn bounds<S: Scalar>(len: usize, lo: &Value<S>, hi: &Value<S>, step: &Value<S>) -> Result<Range, Fault> {
    let bound = |value: &Value<S>| match (value, Number::of(value)) {
        (Value::None, _) => Ok(None),
        (_, Some(Number::Int(n))) => Ok(Some(n)),
        _ => Err(Fault::type_mismatch(format!(
            "a bound of a slice must be an int, found {}",
            value.described()
        ))),
    };
    let step = bound(step)?.unwrap_or(1);
    if step == 0 {
        return Err(Fault::bad_argument("the step of a slice cannot be zero"));
    }
    let len = len as i64;
    // Backwards, the first position is the last element, and the end is before the first.
    let (low, high) = if step > 0 { (0, len) } else { (-1, len - 1) };
    let clamp = |n: i64| (if n < 0 { n.saturating_add(len) } else { n }).clamp(low, high);
    let (start, stop) = if step > 0 { (low, high) } else { (high, low) };
    let start = bound(lo)?.map_or(start, clamp);
    let stop = bound(hi)?.map_or(stop, clamp);
    Range::new(start, stop, step).ok_or_else(|| Fault::bad_argument("the slice is out of range"))
}

/// `item in value`.
pub fn contains<S: Scalar>(value: &Value<S>, item: &Value<S>) -> Result<bool, Fault> {
    item.refuse_futures("looked for")?;
    match (value, item) {
        (Value::List(list), _) => {
            value.refuse_futures("compared")?;
            for element in list.iter() {
                if equal(element, item)? {
                    return Ok(true);
                }
            }
            Ok(false)
        }
        (Value::Dict(dict), _) => Ok(dict.get(item).is_some()),
        (Value::Str(text), Value::Str(part)) => Ok(text.contains(&**part)),
        (Value::Str(_), other) => {
            Err(Fault::type_mismatch(format!("cannot look for {} in a str", other.described())))
        }
        (Value::Range(range), _) => {
            let whole = match Number::of(item) {
                Some(Number::Int(n)) => Some(n),
                Some(Number::Real(x)) if x.value().fract() == 0.0 => super::numbers::to_int(x.value()).ok(),
                _ => None,
            };
            Ok(whole.is_some_and(|n| {
                let (ahead, step) = (i128::from(n) - i128::from(range.start), i128::from(range.step));
                ahead % step == 0 && ahead / step >= 0 && ahead / step < range.len as i128
            }))
        }
        _ => {
            value.refuse_futures("compared")?;
            for at in 0..iter_len(value)? {
                if equal(&iter_get(value, at), item)? {
                    return Ok(true);
                }
            }
            Ok(false)
        }
    }
}

/// `value.name`: a record's field or a vector's component.
pub fn field<S: Scalar>(value: &Value<S>, name: &str) -> Result<Value<S>, Fault> {
    let part = match value {
        Value::Record(record) => record.field(name).cloned(),
        Value::Vector(v) => v.field(name).map(Value::Real),
        _ => None,
    };
    part.ok_or_else(|| no_field(value, name))
}

#[cold]
fn no_field<S: Scalar>(value: &Value<S>, name: &str) -> Fault {
    let fault = Fault::missing_field(format!("{} has no field `{name}`", value.described()));
    let has = match value {
        Value::Record(record) => record.class.fields.join(", "),
        Value::Vector(v) => ["x", "y", "z", "w"][..v.components().len()].join(", "),
        _ => String::new(),
    };
    if has.is_empty() { fault } else { fault.with_help(format!("its fields are: {has}")) }
}

#[cold]
fn wrong_count(count: usize, expected: &str) -> Fault {
    let s = if count == 1 { "" } else { "s" };
    Fault::unpack_length(format!("cannot unpack {count} element{s} into {expected}"))
}

/// The elements of `a, b, c = value`, exactly `count` of them.
pub fn unpack<S: Scalar>(value: &Value<S>, count: usize) -> Result<Vec<Value<S>>, Fault> {
    let len = iter_len(value)?;
    if len != count {
        let s = if count == 1 { "" } else { "s" };
        return Err(wrong_count(len, &format!("{count} name{s}")));
    }
    iter_all(value)
}

/// The elements of `a, *rest, c = value`: the first `before` elements, the rest as a list, and the last `after`
/// elements.
pub fn unpack_star<S: Scalar>(value: &Value<S>, before: usize, after: usize) -> Result<Vec<Value<S>>, Fault> {
    let mut items = iter_all(value)?;
    if items.len() < before + after {
        return Err(wrong_count(items.len(), &format!("{} names and a starred name", before + after)));
    }
    let last = items.split_off(items.len() - after);
    let rest = items.split_off(before);
    items.push(Value::list(rest));
    items.extend(last);
    Ok(items)
}

#[cfg(test)]
mod tests {
    use super::*;

    type V = Value<f64>;
    fn ints(items: impl IntoIterator<Item = i64>) -> Vec<V> {
        items.into_iter().map(Value::Int).collect()
    }

    #[test]
    fn every_slice_of_ten_agrees_with_the_definition() {
        let list = V::list(ints(0..10));
        let all = || (-12..13).map(Some).chain([None]);
        let value = |n: Option<i64>| n.map_or(V::None, V::Int);
        for step in [-4, -3, -1, 1, 2, 3, 11] {
            for lo in all() {
                for hi in all() {
                    // By definition: start at lo, add the step while on this side of hi, keep what exists.
                    let back = step < 0;
                    let fix = |n: i64| if n < 0 { n + 10 } else { n };
                    let first =
                        lo.map_or(
                            if back { 9 } else { 0 },
                            |n| {
                                if back { fix(n).min(9) } else { fix(n).max(0) }
                            },
                        );
                    let end =
                        hi.map_or(if back { -1 } else { 10 }, |n| if back { fix(n).max(-1) } else { fix(n) });
                    let mut expected = Vec::new();
                    let mut at = first;
                    while if back { at > end } else { at < end } {
                        if (0..10).contains(&at) {
                            expected.push(at);
                        }
                        at += step;
                    }
                    let sliced = slice(&list, &value(lo), &value(hi), &V::Int(step));
                    assert_eq!(sliced, Ok(V::list(ints(expected.iter().copied()))), "[{lo:?}:{hi:?}:{step}]");
                    let range = V::Range(Arc::new(Range::new(0, 10, 1).expect("a step of one")));
                    let sliced =
                        slice(&range, &value(lo), &value(hi), &V::Int(step)).and_then(|r| iter_all(&r));
                    assert_eq!(sliced, Ok(ints(expected)), "range[{lo:?}:{hi:?}:{step}]");
                }
            }
        }
    }

    #[test]
    fn positions_count_from_both_ends() {
        let list = V::list(ints([10, 20, 30]));
        assert_eq!(index(&list, &V::Int(-1)), Ok(V::Int(30)));
        assert_eq!(index(&V::str("a\u{e9}b"), &V::Int(1)), Ok(V::str("\u{e9}")));
        let fault = index(&list, &V::Int(5)).unwrap_err();
        assert_eq!(
            (fault.code, fault.message.as_str()),
            ("list-index", "list index 5 is out of range: the list has 3 elements")
        );
        let fault = index(&V::tuple(ints([1])), &V::Int(-2)).unwrap_err();
        assert_eq!(fault.message, "tuple index -2 is out of range: the tuple has 1 element");
        assert_eq!(index(&list, &V::real(1.0)).unwrap_err().code, "type-mismatch");
        assert_eq!(index(&V::Int(3), &V::Int(0)).unwrap_err().message, "cannot take an element of an int");
    }

    #[test]
    fn membership_compares_by_equality() {
        let list = V::list(ints([1, 2]));
        assert_eq!(contains(&list, &V::real(2.0)), Ok(true));
        assert_eq!(contains(&V::str("house"), &V::str("us")), Ok(true));
        let range = V::Range(Arc::new(Range::new(10, 0, -3).expect("a step")));
        let members: Vec<i64> = (-5..15).filter(|n| contains(&range, &V::Int(*n)) == Ok(true)).collect();
        assert_eq!(members, [1, 4, 7, 10]);
        assert_eq!(contains(&V::Int(1), &V::Int(1)).unwrap_err().code, "type-mismatch");
    }

    #[test]
    fn unpacking_checks_the_count() {
        assert_eq!(unpack(&V::tuple(ints([1, 2])), 2), Ok(ints([1, 2])));
        let fault = unpack(&V::tuple(ints([1, 2])), 3).unwrap_err();
        assert_eq!(fault.message, "cannot unpack 2 elements into 3 names");
        let parts = unpack_star(&V::list(ints(0..5)), 1, 2);
        assert_eq!(parts, Ok(vec![V::Int(0), V::list(ints([1, 2])), V::Int(3), V::Int(4)]));
        assert_eq!(unpack_star(&V::list(ints(0..2)), 1, 2).unwrap_err().code, "unpack-length");
    }
}
