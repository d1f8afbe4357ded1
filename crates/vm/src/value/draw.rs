//! Draws of distributions as values, and values as draws: the only conversions between the two types.
//!
//! There are two types because a distribution lies below the language: a [`Draw`] is a number or a row of numbers, all that
//! `niwaki-math` knows, and a [`Value`] may also be a shape, a function or a distribution. In the language a row is a tuple.

use super::numbers::Number;
use super::{Dist, Draw, Scalar, Value, iter_get, iter_len};
use crate::fault::Fault;
use std::sync::Arc;

impl<S: Scalar> From<Draw<S>> for Value<S> {
    #[inline(always)]
    fn from(draw: Draw<S>) -> Value<S> {
        match draw {
            Draw::Int(n) => Value::Int(n),
            Draw::Real(x) => Value::Real(x),
            Draw::Bool(b) => Value::Bool(b),
            other => of_row(other),
        }
    }
}

#[inline(never)]
fn of_row<S: Scalar>(draw: Draw<S>) -> Value<S> {
    Value::tuple(match draw {
        Draw::Bool(b) => return Value::Bool(b),
        Draw::Int(n) => return Value::Int(n),
        Draw::Real(x) => return Value::Real(x),
        Draw::Vector(xs) => xs.iter().copied().map(Value::Real).collect(),
        Draw::Counts(xs) => xs.iter().copied().map(Value::Int).collect(),
        Draw::Truths(xs) => xs.iter().copied().map(Value::Bool).collect(),
    })
}

impl<S: Scalar> Value<S> {
    /// The value as a draw; `None` for a value that no distribution draws. Any sequence of numbers is a row of reals.
    #[inline(always)]
    pub fn draw(&self) -> Option<Draw<S>> {
        match self {
            Value::Bool(b) => Some(Draw::Bool(*b)),
            Value::Int(n) => Some(Draw::Int(*n)),
            Value::Real(x) => Some(Draw::Real(*x)),
            other => row(other),
        }
    }
}

#[inline(never)]
fn row<S: Scalar>(value: &Value<S>) -> Option<Draw<S>> {
    reals(value).map(|xs| Draw::Vector(Arc::from(xs)))
}

/// The elements of a sequence.
pub(crate) fn elements<S: Scalar>(value: &Value<S>) -> Option<impl Iterator<Item = Value<S>>> {
    let count = iter_len(value).ok()?;
    Some((0..count).map(move |at| iter_get(value, at)))
}

/// The numbers of a sequence of numbers, as reals.
pub(crate) fn reals<S: Scalar>(value: &Value<S>) -> Option<Vec<S>> {
    match value {
        Value::Vector(v) => Some(v.components().to_vec()),
        Value::Tuple(tuple) => tuple.items().iter().map(|item| Number::of(item).map(Number::real)).collect(),
        Value::List(_) | Value::Record(_) => {
            elements(value)?.map(|item| Number::of(&item).map(Number::real)).collect()
        }
        _ => None,
    }
}

/// The log density of a value, nats.
///
/// # Errors
/// A value that no distribution draws.
#[inline(always)]
pub fn log_density<S: Scalar>(dist: &Dist<S>, value: &Value<S>) -> Result<S, Fault> {
    match value {
        Value::Real(x) => Ok(dist.log_density_of_real(*x)),
        Value::Int(k) => Ok(dist.log_density_of_int(*k)),
        other => log_density_of_draw(dist, other),
    }
}

#[inline(never)]
fn log_density_of_draw<S: Scalar>(dist: &Dist<S>, value: &Value<S>) -> Result<S, Fault> {
    value.draw().map(|draw| dist.log_density(&draw)).ok_or_else(|| not_drawn(value))
}

/// The fault of a value that no distribution draws.
#[cold]
pub fn not_drawn<S: Scalar>(value: &Value<S>) -> Fault {
    Fault::type_mismatch(format!("no distribution draws {}", value.described()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draw_comes_back_from_its_value() {
        for draw in [Draw::Bool(true), Draw::Int(-3), Draw::Real(0.5), Draw::Vector([0.25, 0.75].into())] {
            assert_eq!(Value::from(draw.clone()).draw(), Some(draw));
        }
        assert_eq!(Value::<f64>::str("a").draw(), None);
    }
}
