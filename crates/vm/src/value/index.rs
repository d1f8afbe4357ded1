//! Reaching into values: `x[i]`, `x[a:b:c]`, `x in xs`, `len`, and going through them one by one.

use super::{Scalar, Value};
use crate::fault::Fault;

/// Number of elements that a loop over this value visits; a fault when it cannot be looped over.
pub fn iter_len<S: Scalar>(value: &Value<S>) -> Result<usize, Fault> {
    let _ = value;
    todo!()
}

/// Element `at` of a loop over a value, for `at` below [`iter_len`]; `None` beyond.
pub fn iter_get<S: Scalar>(value: &Value<S>, at: usize) -> Value<S> {
    let _ = (value, at);
    todo!()
}

/// `len(x)`.
pub fn len<S: Scalar>(value: &Value<S>) -> Result<usize, Fault> {
    let _ = value;
    todo!()
}

/// `x[i]`.
pub fn index<S: Scalar>(value: &Value<S>, at: &Value<S>) -> Result<Value<S>, Fault> {
    let _ = (value, at);
    todo!()
}

/// `x[lo:hi:step]`; absent bounds are `None`.
pub fn slice<S: Scalar>(
    value: &Value<S>,
    lo: &Value<S>,
    hi: &Value<S>,
    step: &Value<S>,
) -> Result<Value<S>, Fault> {
    let _ = (value, lo, hi, step);
    todo!()
}

/// `item in value`.
pub fn contains<S: Scalar>(value: &Value<S>, item: &Value<S>) -> Result<bool, Fault> {
    let _ = (value, item);
    todo!()
}

/// `value.name`: a record's field or a vector's component.
pub fn field<S: Scalar>(value: &Value<S>, name: &str) -> Result<Value<S>, Fault> {
    let _ = (value, name);
    todo!()
}

/// The elements of `a, b, c = value`, exactly `count` of them.
pub fn unpack<S: Scalar>(value: &Value<S>, count: usize) -> Result<Vec<Value<S>>, Fault> {
    let _ = (value, count);
    todo!()
}

/// The elements of `a, *rest, c = value`: the first `before`, the rest as a list, the last `after`.
pub fn unpack_star<S: Scalar>(value: &Value<S>, before: usize, after: usize) -> Result<Vec<Value<S>>, Fault> {
    let _ = (value, before, after);
    todo!()
}
