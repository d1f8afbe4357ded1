//! The result of a built-in function: a value, or a fault.

use crate::fault::Fault;
use crate::value::{Scalar, Value, compare};

/// The result of a built-in function.
pub type Answer<S> = Result<Value<S>, Fault>;

/// `a < b` as a truth value, for orderings.
pub(crate) fn less<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Result<bool, Fault> {
    Ok(compare::order(a, b, "<")? == Some(std::cmp::Ordering::Less))
}

/// The fault for an argument of a kind that a function does not accept.
#[cold]
pub(crate) fn unfit<S: Scalar>(name: &str, expected: &str, value: &Value<S>) -> Fault {
    Fault::type_mismatch(format!("`{name}` takes {expected}, found {}", value.described()))
}
