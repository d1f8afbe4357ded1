//! Futures inside of values. A model may pass a future on, but only `force` reads it: before that it may have
//! no value. Results of the model contain the value.

use super::{Closure, Dict, List, Record, Scalar, Value};
use crate::fault::Fault;
use std::sync::Arc;

/// The next step: visit a value, or build one from parts that are ready.
enum Work<S: Scalar> {
    Look(Value<S>),
    /// Build a value like this one from the last parts; the number of parts.
    Build(Value<S>, usize),
    /// The value visited last replaces a handle.
    Changed,
}

/// The most values that one search for a future may visit: a value that shares parts of itself could hold far
/// more.
const BUDGET: usize = 1 << 26;

impl<S: Scalar> Value<S> {
    /// A future that has returned this value.
    pub fn returned(value: Value<S>) -> Value<S> {
        Value::Returned(vec![value].into())
    }

    /// Whether the value is a future.
    #[inline(always)]
    pub fn is_future(&self) -> bool {
        matches!(self, Value::Future(_) | Value::Returned(_))
    }

    /// Whether the value is a future or holds one, at any depth.
    pub fn holds_future(&self) -> bool {
        let (mut work, mut visited) = (Vec::new(), 0);
        let mut next = Some(self);
        while let Some(value) = next {
            visited += 1;
            let holds = value.is_future()
                || any_part(value, &mut |part| {
                    if part.holds_values() {
                        work.push(part);
                    }
                    part.is_future()
                });
            if holds || visited > BUDGET {
                return holds;
            }
            next = work.pop();
        }
        false
    }

    /// Returns a fault if the value is a future or holds one.
    ///
    /// # Errors
    /// The future is not forced; `operation` names the operation that is not possible.
    #[inline]
    pub fn refuse_futures(&self, operation: &str) -> Result<(), Fault> {
        if (self.is_future() || self.holds_values()) && self.holds_future() {
            return Err(Fault::not_forced(format!("a future cannot be {operation}")));
        }
        Ok(())
    }

    /// Returns a fault if the value is or holds a memoised function: such a function belongs to one run and
    /// cannot leave it.
    ///
    /// # Errors
    /// The value is a memoised function, or holds one.
    pub fn refuse_memoised(&self) -> Result<(), Fault> {
        let mut work = if self.holds_values() { vec![self.clone()] } else { vec![] };
        while let Some(value) = work.pop() {
            if let Value::Function(closure) = &value
                && let Some(memo) = &closure.memo
            {
                let message = format!(
                    "the memoised function `{}` belongs to the enclosing run and cannot leave it",
                    memo.name
                );
                return Err(Fault::new("memo-outside", message));
            }
            work.extend(parts(&value));
        }
        Ok(())
    }

    /// Replaces each future that has returned, or for which `known` has a value, by its value, at any depth. A
    /// value without such a handle stays the same object in memory, so that tests of identity stay fast.
    pub fn replace_futures(&self, value_of: &dyn Fn(u32) -> Option<Value<S>>) -> Value<S> {
        if !self.holds_future() {
            return self.clone();
        }
        let mut work = vec![Work::Look(self.clone())];
        // The values that are ready, and whether each differs from its original.
        let mut done: Vec<(Value<S>, bool)> = Vec::new();
        while let Some(next) = work.pop() {
            match next {
                Work::Look(Value::Future(id)) => match value_of(id) {
                    // The value of a future may hold other futures, but never the future itself.
                    Some(value) => work.extend([Work::Changed, Work::Look(value)]),
                    None => done.push((Value::Future(id), false)),
                },
                Work::Look(Value::Returned(value)) => {
                    work.extend([Work::Changed, Work::Look(value.items()[0].clone())]);
                }
                Work::Look(value) => {
                    let parts = if may_hold_futures(&value) { parts(&value) } else { Vec::new() };
                    if parts.is_empty() {
                        done.push((value, false));
                        continue;
                    }
                    work.push(Work::Build(value, parts.len()));
                    work.extend(parts.into_iter().rev().map(Work::Look));
                }
                Work::Build(like, count) => {
                    let parts = done.split_off(done.len() - count);
                    if parts.iter().any(|(_, changed)| *changed) {
                        let parts = parts.into_iter().map(|(part, _)| part).collect();
                        done.push((rebuild(&like, parts), true));
                    } else {
                        done.push((like, false));
                    }
                }
                Work::Changed => {
                    if let Some((_, changed)) = done.last_mut() {
                        *changed = true;
                    }
                }
            }
        }
        done.pop().map(|(value, _)| value).unwrap_or_default()
    }
}

/// False when no direct part of a value is a handle or holds values: one scan avoids a copy of most lists.
fn may_hold_futures<S: Scalar>(value: &Value<S>) -> bool {
    any_part(value, &mut |part| part.holds_values() || part.is_future())
}

/// Whether one of the direct parts of a value passes the test; the parts before it are tested as well.
fn any_part<'v, S: Scalar>(value: &'v Value<S>, test: &mut dyn FnMut(&'v Value<S>) -> bool) -> bool {
    match value {
        Value::Tuple(tuple) => tuple.items().iter().any(test),
        Value::List(list) => list.iter().any(test),
        Value::Record(record) => record.fields.iter().any(test),
        Value::Dict(dict) => dict.values().iter().any(test),
        Value::Function(closure) => closure.captures.iter().any(test),
        _ => false,
    }
}

/// The direct parts of a value.
fn parts<S: Scalar>(value: &Value<S>) -> Vec<Value<S>> {
    match value {
        Value::Tuple(tuple) => tuple.items().to_vec(),
        Value::List(list) => list.iter().cloned().collect(),
        Value::Record(record) => record.fields.clone(),
        Value::Dict(dict) => dict.values().to_vec(),
        Value::Function(closure) => closure.captures.clone(),
        _ => Vec::new(),
    }
}

/// A value of the same kind as `like` with the given parts.
fn rebuild<S: Scalar>(like: &Value<S>, parts: Vec<Value<S>>) -> Value<S> {
    match like {
        Value::Tuple(_) => Value::tuple(parts),
        Value::List(_) => Value::List(List::from_vec(parts)),
        Value::Record(r) => Value::Record(Arc::new(Record { class: r.class.clone(), fields: parts })),
        Value::Dict(d) => Value::Dict(Arc::new(Dict::new(d.keys().iter().cloned().zip(parts).collect()))),
        Value::Function(f) => {
            Value::Function(Arc::new(Closure { function: f.function, memo: f.memo.clone(), captures: parts }))
        }
        other => other.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handles_are_replaced_at_any_depth_and_the_rest_is_shared() {
        let untouched = Value::<f64>::list((0..50).map(Value::Int).collect());
        let inner = Value::list(vec![Value::Future(1), Value::returned(untouched.clone())]);
        let value = Value::tuple(vec![inner, untouched.clone(), Value::Future(7)]);
        // Future 1 returned a pair that holds future 2.
        let value_of = |id| match id {
            1 => Some(Value::tuple(vec![Value::Future(2), Value::returned(Value::Int(5))])),
            2 => Some(Value::str("done")),
            _ => None,
        };
        let replaced = value.replace_futures(&value_of);
        let Value::Tuple(parts) = &replaced else { panic!("a tuple") };
        assert!(matches!((&parts.items()[1], &untouched), (Value::List(a), Value::List(b)) if a.ptr_eq(b)));
        assert!(value.holds_future() && !untouched.holds_future());
        let mut text = format!("{:?}", parts.items()[0]);
        text.truncate(23);
        assert_eq!(text, "[('done', 5), [0, 1, 2,");
        assert!(matches!(parts.items()[2], Value::Future(7)));
    }

    #[test]
    fn a_chain_of_a_million_around_a_handle_is_replaced() {
        let chain = (0..1_000_000).fold(Value::<f64>::Future(0), |inner, _| Value::tuple(vec![inner]));
        let expected = (0..1_000_000).fold(Value::Int(3), |inner, _| Value::tuple(vec![inner]));
        assert!(chain.replace_futures(&|_| Some(Value::Int(3))) == expected);
    }
}
