//! Format specifications of f-strings.

use super::{Scalar, Value};
use crate::fault::Fault;

/// `f"{value:spec}"`.
pub fn format<S: Scalar>(value: &Value<S>, spec: &str) -> Result<String, Fault> {
    let _ = (value, spec);
    todo!()
}
