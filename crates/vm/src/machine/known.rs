//! Distributions that were made before from the same list or tuple: a categorical over the weights of a mixture is made
//! once, not for each point.
//!
//! A row holds on to what its distribution was made from, so that its place in memory tells whether it is the same.

use crate::builtins::make_dist;
use crate::fault::Fault;
use crate::value::Value;
use niwaki_math::{Dist, Family, Scalar};

/// Rows of the table; which one depends on the place in memory.
const ENTRIES: usize = 512;

/// A distribution: its family, what it was made of, and itself.
type Entry<S> = (Family, Value<S>, Dist<S>);

/// A small table of distributions.
pub(super) struct Known<S: Scalar> {
    entries: Vec<Option<Entry<S>>>,
}

impl<S: Scalar> Default for Known<S> {
    fn default() -> Self {
        Known { entries: vec![None; ENTRIES] }
    }
}

impl<S: Scalar> Known<S> {
    /// The row for a value that can be known by its place in memory.
    #[inline]
    pub fn index(&self, value: &Value<S>) -> Option<usize> {
        let address = match value {
            Value::Tuple(tuple) => tuple.address(),
            Value::List(list) => list.address(),
            _ => return None,
        };
        // Allocations are multiples of sixteen bytes, and larger ones lie further apart.
        Some((address >> 4 ^ address >> 10) % ENTRIES)
    }

    /// The distribution of that family made of the value.
    ///
    /// # Errors
    /// The value does not fit the family.
    #[inline]
    pub fn dist(&mut self, index: usize, family: Family, value: &Value<S>) -> Result<&Dist<S>, Fault> {
        let entry = &mut self.entries[index];
        let is_it = match entry {
            Some((of, known, _)) => {
                *of == family
                    && match (known, value) {
                        (Value::Tuple(a), Value::Tuple(b)) => a.ptr_eq(b),
                        (Value::List(a), Value::List(b)) => a.ptr_eq(b),
                        _ => false,
                    }
            }
            None => false,
        };
        if !is_it {
            *entry = None;
        }
        match entry {
            Some((.., dist)) => Ok(dist),
            None => {
                let dist = make_dist(family, std::slice::from_ref(value))?;
                Ok(&entry.insert((family, value.clone(), dist)).2)
            }
        }
    }
}
