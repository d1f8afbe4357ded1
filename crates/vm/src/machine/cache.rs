//! A cache of distributions by the list or tuple of their parameters: a categorical over the weights of a mixture is
//! built once, not for each point.
//!
//! An entry owns the parameters of its distribution, so that an equal address in memory means equal parameters.

use crate::builtins::make_dist;
use crate::fault::Fault;
use crate::value::Value;
use niwaki_math::{Dist, Family, Scalar};

/// Entries of the table; the address in memory selects one.
const ENTRIES: usize = 512;

/// A family, its parameters, and the distribution.
type Entry<S> = (Family, Value<S>, Dist<S>);

/// A small table of distributions.
pub(super) struct DistCache<S: Scalar> {
    /// Empty until the first one is looked up: many machines run for one barrier or one proposal only.
    entries: Vec<Option<Entry<S>>>,
}

impl<S: Scalar> Default for DistCache<S> {
    fn default() -> Self {
        DistCache { entries: Vec::new() }
    }
}

impl<S: Scalar> DistCache<S> {
    /// The entry for a value that has an address in memory.
    #[inline]
    pub fn index(&self, value: &Value<S>) -> Option<usize> {
        let address = match value {
            Value::Tuple(tuple) => tuple.address(),
            Value::List(list) => list.address(),
            _ => return None,
        };
        // Allocations are multiples of sixteen bytes, and larger ones are further apart.
        Some((address >> 4 ^ address >> 10) % ENTRIES)
    }

    /// The distribution of that family with the value as its parameter.
    ///
    /// # Errors
    /// The value does not fit the family.
    #[inline]
    pub fn dist(&mut self, index: usize, family: Family, value: &Value<S>) -> Result<&Dist<S>, Fault> {
        if self.entries.is_empty() {
            self.entries.resize(ENTRIES, None);
        }
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
