//! Handles of futures inside values: values, equality and queries see the result, never the handle.

use super::{Closure, Dict, List, Record, Scalar, Value, iter_get};
use std::sync::Arc;

/// What is left to do: look at a value, or put one together from those that are done.
enum Work<S: Scalar> {
    Look(Value<S>),
    Build(Value<S>, usize),
}

impl<S: Scalar> Value<S> {
    /// The value with the handle of each future that `known` has a value for replaced by that value, at any depth.
    pub fn replace_futures(&self, known: &dyn Fn(u32) -> Option<Value<S>>) -> Value<S> {
        let mut work = vec![Work::Look(self.clone())];
        let mut done: Vec<Value<S>> = Vec::new();
        while let Some(next) = work.pop() {
            match next {
                Work::Look(Value::Future(id)) => match known(id) {
                    // What a future returned may hold futures in turn, never itself.
                    Some(value) => work.push(Work::Look(value)),
                    None => done.push(Value::Future(id)),
                },
                Work::Look(value) => {
                    let parts = parts(&value);
                    if parts.is_empty() {
                        done.push(value);
                        continue;
                    }
                    work.push(Work::Build(value, parts.len()));
                    work.extend(parts.into_iter().rev().map(Work::Look));
                }
                Work::Build(like, count) => {
                    let parts = done.split_off(done.len() - count);
                    done.push(rebuild(&like, parts));
                }
            }
        }
        done.pop().unwrap_or_default()
    }
}

/// The values that a value holds.
fn parts<S: Scalar>(value: &Value<S>) -> Vec<Value<S>> {
    match value {
        Value::Tuple(t) => t.items().to_vec(),
        Value::List(list) => (0..list.len()).map(|i| iter_get(value, i)).collect(),
        Value::Record(r) => r.fields.clone(),
        Value::Dict(d) => d.values().to_vec(),
        Value::Function(f) => f.captures.clone(),
        _ => Vec::new(),
    }
}

/// A value like that one, of those parts.
fn rebuild<S: Scalar>(like: &Value<S>, parts: Vec<Value<S>>) -> Value<S> {
    match like {
        Value::Tuple(_) => Value::tuple(parts),
        Value::List(_) => Value::List(List::from_vec(parts)),
        Value::Record(r) => Value::Record(Arc::new(Record { class: r.class.clone(), fields: parts })),
        Value::Dict(d) => Value::Dict(Arc::new(Dict::new(d.keys().iter().cloned().zip(parts).collect()))),
        Value::Function(f) => Value::Function(Arc::new(Closure { function: f.function, captures: parts })),
        other => other.clone(),
    }
}
