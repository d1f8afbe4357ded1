//! Dropping nested values without the host stack.
//!
//! A plain drop of a chain of a million tuples recurses a million times. Here a body moves the children that
//! would be dropped with it to a work list, and so do the children's bodies: all bodies are empty when they are
//! dropped. A body without such children (nearly every body) costs one scan over its tags.

use std::sync::Arc;

use super::{Scalar, Value};

/// Takes the children out of a body that is being dropped, and frees them one after another.
#[inline]
pub(super) fn release<S: Scalar>(items: &mut [Value<S>]) {
    if items.iter().any(has_one_owner) {
        let mut work = Vec::new();
        gather(items, &mut work);
        run(work);
    }
}

/// Moves the children that are not shared to the work list.
pub(super) fn gather<S: Scalar>(items: &mut [Value<S>], work: &mut Vec<Value<S>>) {
    for item in items {
        if has_one_owner(item) {
            work.push(std::mem::take(item));
        }
    }
}

/// True for an aggregate with one owner. Another thread may drop a shared aggregate at the same moment: this
/// costs one level of host stack, once. A shared aggregate is never mistaken for one with a single owner.
#[inline]
fn has_one_owner<S: Scalar>(value: &Value<S>) -> bool {
    match value {
        Value::Tuple(tuple) | Value::Returned(tuple) => Arc::strong_count(&tuple.0) == 1,
        Value::List(list) => list.has_one_owner(),
        Value::Dict(dict) => Arc::strong_count(dict) == 1,
        Value::Record(record) => Arc::strong_count(record) == 1,
        Value::Function(closure) => Arc::strong_count(closure) == 1,
        _ => false,
    }
}

#[cold]
fn run<S: Scalar>(mut work: Vec<Value<S>>) {
    while let Some(value) = work.pop() {
        match value {
            Value::Tuple(tuple) | Value::Returned(tuple) => {
                if let Some(mut body) = Arc::into_inner(tuple.0) {
                    gather(body.items_mut(), &mut work);
                }
            }
            Value::List(list) => list.gather(&mut work),
            Value::Dict(dict) => {
                if let Some(mut dict) = Arc::into_inner(dict) {
                    gather(&mut dict.keys, &mut work);
                    gather(&mut dict.values, &mut work);
                }
            }
            Value::Record(record) => {
                if let Some(mut record) = Arc::into_inner(record) {
                    gather(&mut record.fields, &mut work);
                }
            }
            Value::Function(closure) => {
                if let Some(mut closure) = Arc::into_inner(closure) {
                    gather(&mut closure.captures, &mut work);
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::{Closure, Dict};

    const DEEP: usize = 1_000_000;

    fn chain(link: impl Fn(Value) -> Value) -> Value {
        (0..DEEP).fold(Value::Int(1), |inner, _| link(inner))
    }

    #[test]
    fn chains_of_a_million_are_dropped_without_the_host_stack() {
        drop(chain(|inner| Value::tuple(vec![inner])));
        drop(chain(|inner| Value::tuple(vec![Value::Int(0), inner])));
        drop(chain(Value::returned));
        drop(chain(|inner| Value::list(vec![inner])));
        drop(chain(|inner| {
            Value::Function(Arc::new(Closure { function: 0, memo: None, captures: vec![inner] }))
        }));
        drop(chain(|inner| Value::Dict(Arc::new(Dict::new(vec![(Value::Int(1), inner)])))));
    }

    #[test]
    fn a_chain_through_inner_nodes_of_long_lists_is_dropped() {
        let deep = (0..30_000).fold(Value::<f64>::Int(1), |inner, _| {
            let mut items = vec![Value::Int(0); 40];
            items[3] = inner;
            Value::list(items)
        });
        drop(deep);
    }
}
