//! `repr` and `str` as Python writes them.

use super::{Scalar, Value};
use crate::fault::Fault;

/// Python's `repr(value)`.
pub fn repr<S: Scalar>(value: &Value<S>) -> Result<String, Fault> {
    let _ = value;
    todo!()
}

/// Python's `str(value)`.
pub fn str_of<S: Scalar>(value: &Value<S>) -> Result<String, Fault> {
    let _ = value;
    todo!()
}
