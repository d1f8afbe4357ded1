//! The built-in functions of the language, by number.

pub mod dist;

use crate::fault::Fault;
use crate::value::{Scalar, Value};

pub use dist::{draw_to_value, make_dist, value_to_draw};

/// A built-in function.
pub struct Builtin<S: Scalar = f64> {
    /// Its name in core form.
    pub name: &'static str,
    /// Fewest arguments.
    pub min_args: usize,
    /// Most arguments; `usize::MAX` for any number.
    pub max_args: usize,
    /// What it does; the number of arguments is already checked.
    pub run: fn(&[Value<S>]) -> Result<Value<S>, Fault>,
}

/// Number of a built-in function.
pub fn builtin_id(name: &str) -> Option<u16> {
    let _ = name;
    todo!()
}

/// The built-in function with a number from [`builtin_id`].
pub fn builtin<S: Scalar>(id: u16) -> &'static Builtin<S> {
    let _ = id;
    todo!()
}
