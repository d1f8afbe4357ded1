//! Distributions from values, and draws to and from values.

use std::sync::Arc;

use crate::fault::Fault;
use crate::value::{Dist, Draw, Family, Scalar, Value};

/// A distribution of a family from its parameters in order.
pub fn make_dist<S: Scalar>(family: Family, args: &[Value<S>]) -> Result<Dist<S>, Fault> {
    let _ = (family, args);
    todo!()
}

/// A draw as a value; a vector becomes a tuple.
pub fn draw_to_value<S: Scalar>(draw: Draw<S>) -> Value<S> {
    match draw {
        Draw::Bool(b) => Value::Bool(b),
        Draw::Int(n) => Value::Int(n),
        Draw::Real(x) => Value::Real(x),
        Draw::Vector(xs) => Value::tuple(xs.iter().copied().map(Value::Real).collect()),
    }
}

/// A value as a draw; `None` for a value that no distribution yields.
pub fn value_to_draw<S: Scalar>(value: &Value<S>) -> Option<Draw<S>> {
    let numbers = |items: &mut dyn Iterator<Item = &Value<S>>| -> Option<Arc<[S]>> {
        items.map(|item| crate::value::numbers::Number::of(item).map(|n| n.real())).collect()
    };
    match value {
        Value::Bool(b) => Some(Draw::Bool(*b)),
        Value::Int(n) => Some(Draw::Int(*n)),
        Value::Real(x) => Some(Draw::Real(*x)),
        Value::Vector(v) => Some(Draw::Vector(v.components().into())),
        Value::Tuple(tuple) => numbers(&mut tuple.items().iter()).map(Draw::Vector),
        Value::List(list) => numbers(&mut list.iter()).map(Draw::Vector),
        _ => None,
    }
}
