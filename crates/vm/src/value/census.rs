//! The memory that values take, with each shared part counted once.
//!
//! Sizes are those that an allocator needs. They depend on the value alone and never on who else holds it. So
//! two runs that hold the same values count the same bytes, whatever other threads do.

use std::collections::HashSet;
use std::sync::Arc;

use super::blocks::{block, shared};
use super::{Scalar, Shape, Value};

/// The depth of nested values that a census counts by recursion; deeper values wait in a list.
const DEPTH: usize = 16;

/// Counts the bytes of values.
#[derive(Default)]
pub struct Census<'v, S: Scalar = f64> {
    /// The addresses of counted objects. An object with one owner is met once, and is not recorded.
    seen: HashSet<usize>,
    work: Vec<&'v Value<S>>,
    depth: usize,
    bytes: usize,
}

impl<'v, S: Scalar> Census<'v, S> {
    /// Creates a census that has counted nothing so far.
    pub fn new() -> Self {
        Census { seen: HashSet::new(), work: Vec::new(), depth: 0, bytes: 0 }
    }

    /// The bytes counted so far.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Excludes a value, which belongs to someone else, from the count. The cost is constant: parts of the
    /// value that are also held elsewhere still count there.
    pub fn leave_out(&mut self, value: &Value<S>) {
        match value {
            Value::Str(text) => self.note(text.address()),
            Value::Returned(tuple) | Value::Tuple(tuple) => self.note(tuple.address()),
            Value::List(list) => list.leave_out(self),
            Value::Dict(dict) => self.note(Arc::as_ptr(dict) as usize),
            Value::Record(record) => self.note(Arc::as_ptr(record) as usize),
            Value::Function(closure) => self.note(Arc::as_ptr(closure) as usize),
            Value::Shape(shape) => self.note(shape.address()),
            Value::Dist(dist) => self.note(Arc::as_ptr(dist) as usize),
            _ => {}
        }
    }

    pub(super) fn note(&mut self, address: usize) {
        self.seen.insert(address);
    }

    /// Counts bytes that do not belong to a value.
    #[inline]
    pub fn add_bytes(&mut self, bytes: usize) {
        self.bytes += bytes;
    }

    /// Whether the census meets a shared object for the first time.
    #[inline]
    pub fn is_first<T: ?Sized>(&mut self, object: &Arc<T>) -> bool {
        Arc::strong_count(object) == 1 || self.seen.insert(Arc::as_ptr(object).cast::<()>() as usize)
    }

    /// Counts a shared object of fixed size, and returns whether the census meets it for the first time.
    #[inline]
    pub(super) fn add_shared<T>(&mut self, object: &Arc<T>) -> bool {
        let first = self.is_first(object);
        if first {
            self.bytes += shared::<T>();
        }
        first
    }

    /// Counts a value and all that it holds, without the value's own 16 bytes.
    pub fn add(&mut self, value: &'v Value<S>) {
        if value.is_plain() {
            return;
        }
        self.add_own(value);
        while let Some(next) = self.work.pop() {
            self.add_own(next);
        }
    }

    /// Counts elements in place, their 16 bytes each included.
    pub(super) fn add_items(&mut self, items: &'v [Value<S>], capacity: usize) {
        self.bytes += block(capacity * size_of::<Value<S>>());
        self.add_in_place(items);
    }

    /// Counts a shape.
    pub fn add_shape(&mut self, shape: &Shape) {
        if !shape.is_shared() || self.seen.insert(shape.address()) {
            self.bytes += shape.bytes();
        }
    }

    /// Counts the data behind elements that are part of an object counted before.
    pub(super) fn add_in_place(&mut self, items: &'v [Value<S>]) {
        let values = items.iter().filter(|item| !item.is_plain());
        if self.depth == DEPTH {
            return self.work.extend(values);
        }
        self.depth += 1;
        values.for_each(|value| self.add_own(value));
        self.depth -= 1;
    }

    #[expect(clippy::collapsible_match, reason = "a guard that counts would be easy to miss")]
    fn add_own(&mut self, value: &'v Value<S>) {
        match value {
            Value::Str(text) => {
                if !text.is_shared() || self.seen.insert(text.address()) {
                    self.bytes += text.own_bytes();
                }
            }
            Value::Returned(tuple) | Value::Tuple(tuple) => tuple.count(self),
            Value::List(list) => list.count(self),
            Value::Dict(dict) => {
                if self.add_shared(dict) {
                    dict.count(self);
                }
            }
            Value::Record(record) => {
                if self.add_shared(record) {
                    self.add_items(&record.fields, record.fields.len());
                }
            }
            Value::Function(closure) => {
                if self.add_shared(closure) {
                    self.add_items(&closure.captures, closure.captures.len());
                }
            }
            Value::Range(range) => drop(self.add_shared(range)),
            Value::Vector(vector) => drop(self.add_shared(vector)),
            Value::Rotation(rotation) => drop(self.add_shared(rotation)),
            Value::Shape(shape) => self.add_shape(shape),
            Value::Dist(dist) => {
                if self.add_shared(dist) {
                    self.bytes += dist.bytes();
                }
            }
            _ => {}
        }
    }
}

impl<S: Scalar> Value<S> {
    /// Bytes of the allocation behind a vector.
    pub const VECTOR_BYTES: usize = shared::<super::Vector<S>>();

    /// Bytes of the allocation behind the value, or a little more, without the values that it holds. The cost
    /// is constant, except for mixtures.
    pub fn own_bytes(&self) -> usize {
        let items = |count: usize| block(count * size_of::<Value<S>>());
        match self {
            Value::Str(text) => text.own_bytes(),
            Value::Returned(tuple) | Value::Tuple(tuple) => tuple.own_bytes(),
            Value::List(list) => super::list::bytes_of::<S>(list.len()),
            Value::Dict(dict) => shared::<super::Dict<S>>() + dict.len() * 48,
            Value::Record(record) => shared::<super::Record<S>>() + items(record.fields.len()),
            Value::Function(closure) => {
                shared::<super::Closure<S>>() + items(closure.captures.len()) + closure.memo_bytes()
            }
            Value::Range(_) => shared::<super::Range>(),
            Value::Vector(_) => Self::VECTOR_BYTES,
            Value::Rotation(_) => shared::<[S; 9]>(),
            Value::Shape(shape) => shape.bytes(),
            Value::Dist(dist) => shared::<super::Dist<S>>() + dist.bytes(),
            _ => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::List;

    fn count(values: &[Value]) -> usize {
        let mut census = Census::new();
        values.iter().for_each(|value| census.add(value));
        census.bytes()
    }

    #[test]
    fn shared_parts_count_once_and_versions_of_a_list_count_their_differences() {
        let long = Value::<f64>::list((0..10_000).map(Value::Int).collect());
        let once = count(std::slice::from_ref(&long));
        assert!((160_000..200_000).contains(&once), "{once}");
        assert_eq!(count(&[long.clone(), long.clone()]), once);
        let Value::List(list) = &long else { panic!("a list") };
        let mut other = list.clone();
        other.set(5000, Value::Int(-1));
        let both = count(&[long.clone(), Value::List(other)]);
        assert!(both > once && both < once + 4000, "{both} for {once}");
    }

    #[test]
    fn the_count_does_not_depend_on_other_owners() {
        let make = || {
            let row = Value::<f64>::list((0..40).map(|n| Value::real(f64::from(n))).collect());
            Value::tuple(vec![row.clone(), Value::str("abc"), row, Value::vector(&[1.0, 2.0, 3.0])])
        };
        let (alone, held) = (make(), make());
        let _owners: Vec<Value> = (0..3).map(|_| held.clone()).collect();
        let Value::Tuple(parts) = &held else { panic!("a tuple") };
        let _inner = parts.items().to_vec();
        assert_eq!(count(&[alone]), count(&[held]));
    }

    #[test]
    fn own_bytes_are_at_least_the_bytes_of_a_census() {
        let values: Vec<Value> = vec![
            Value::str(&"x".repeat(1000)),
            Value::tuple((0..100).map(Value::Int).collect()),
            Value::List(List::from_vec((0..1000).map(Value::Int).collect())),
            Value::list(vec![]),
            Value::vector(&[1.0, 2.0]),
        ];
        for value in values {
            let (bytes, counted) = (value.own_bytes(), count(std::slice::from_ref(&value)));
            assert!(
                bytes >= counted && bytes <= counted + counted / 4 + 600,
                "{value:?}: {bytes} for {counted}"
            );
        }
    }

    #[test]
    fn a_chain_of_a_million_is_counted_without_the_host_stack() {
        let chain = (0..1_000_000).fold(Value::<f64>::Int(1), |inner, _| Value::tuple(vec![inner]));
        assert!(count(&[chain]) > 32_000_000);
    }
}
