//! What a built-in function answers: a value, or why there is none.

use crate::fault::Fault;
use crate::value::{Scalar, Value, compare};

/// The result of a built-in function.
pub type Answer<S> = Result<Value<S>, Fault>;

/// `a < b` as a plain truth value, for ordering.
pub(crate) fn less<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Result<bool, Fault> {
    Ok(compare::order(a, b, "<")? == Some(std::cmp::Ordering::Less))
}

/// The fault of an argument of a kind that a function does not take.
#[cold]
pub(crate) fn unfit<S: Scalar>(name: &str, expected: &str, found: &Value<S>) -> Fault {
    Fault::type_mismatch(format!("`{name}` takes {expected}, found {}", found.described()))
}
