//! A cache of distributions by the list or tuple of their parameters. A categorical distribution over the
//! weights of a mixture is built once, not for each point.
//!
//! An entry owns the parameters of its distribution, so that an equal address in memory means equal parameters.

use crate::builtins::make_dist;
use crate::fault::Fault;
use crate::value::Value;
use niwaki_math::{Dist, Family, Scalar};

/// Entries of the table; the address in memory selects two neighbours. With one entry for each address, the
/// parameters that evict each other would depend on their places in memory, and with them the time of a run.
const ENTRIES: usize = 512;

/// The fewest bytes that the cache may hold.
const MIN_BYTES: usize = 1 << 20;

/// A family, its parameters, and the distribution.
type Entry<S> = (Family, Value<S>, Dist<S>);

/// A small table of distributions.
pub(super) struct DistCache<S: Scalar> {
    /// The entries; empty until the first lookup, because many machines run for one barrier or one proposal
    /// only.
    entries: Vec<Option<Entry<S>>>,
    /// The bytes of the entries since the cache was last emptied, and their maximum.
    bytes: usize,
    most: usize,
}

impl<S: Scalar> DistCache<S> {
    /// A cache of at most `bytes` bytes. For a small run it may hold more than the run itself.
    pub fn holding(bytes: usize) -> Self {
        DistCache { entries: Vec::new(), bytes: 0, most: bytes.max(MIN_BYTES) }
    }

    /// The bytes of an entry, or more: the distribution, and the parameter, which the entry keeps alive.
    fn bytes_of(value: &Value<S>) -> usize {
        3 * value.own_bytes()
    }

    /// Whether the distribution of a parameter may be in the cache.
    #[inline]
    pub fn is_room_for(&self, value: &Value<S>) -> bool {
        Self::bytes_of(value) <= self.most
    }

    /// The index of the entry for a value with an address in memory: the entry of this value, else the entry to
    /// fill.
    #[inline]
    pub fn index(&self, value: &Value<S>) -> Option<usize> {
        let address = match value {
            Value::Tuple(tuple) => tuple.address(),
            Value::List(list) => list.address(),
            _ => return None,
        };
        // Allocations are multiples of sixteen bytes, and larger ones are further apart.
        let first = (address >> 4 ^ address >> 10) % ENTRIES;
        match self.entries.get(first) {
            Some(Some((_, known, _))) if !is_same(known, value) => Some(self.beside(first, value)),
            _ => Some(first),
        }
    }

    /// The neighbour of an entry of another value, if the neighbour has this value or none.
    #[inline]
    fn beside(&self, first: usize, value: &Value<S>) -> usize {
        match &self.entries[first ^ 1] {
            Some((_, known, _)) if !is_same(known, value) => first,
            _ => first ^ 1,
        }
    }

    /// Whether the entry at `index` has the distribution of a family with the value as its parameter.
    #[inline]
    pub fn holds(&self, index: usize, family: Family, value: &Value<S>) -> bool {
        match self.entries.get(index) {
            Some(Some((of, known, _))) => *of == family && is_same(known, value),
            _ => false,
        }
    }

    /// The distribution at `index`, which must exist.
    #[inline]
    pub fn at(&self, index: usize) -> &Dist<S> {
        let (.., dist) = self.entries[index].as_ref().expect("the entry is filled");
        dist
    }

    /// Builds the distribution of a family with the value as its parameter, in place of the entry at `index`.
    ///
    /// # Errors
    /// The value does not fit the family.
    #[inline(never)]
    pub fn build(&mut self, index: usize, family: Family, value: &Value<S>) -> Result<&Dist<S>, Fault> {
        let dist = make_dist(family, std::slice::from_ref(value))?;
        if self.entries.is_empty() {
            self.entries.resize(ENTRIES, None);
        }
        let added = Self::bytes_of(value);
        if self.bytes + added > self.most {
            self.entries.fill(None);
            self.bytes = 0;
        }
        self.bytes += added;
        // The oldest of both entries makes room, not the last one.
        if let Some(before) = self.entries[index].take().filter(|(_, known, _)| !is_same(known, value)) {
            self.entries[index ^ 1] = Some(before);
        }
        let (.., dist) = self.entries[index].insert((family, value.clone(), dist));
        Ok(dist)
    }
}

/// Whether two values are one object in memory.
#[inline]
fn is_same<S: Scalar>(a: &Value<S>, b: &Value<S>) -> bool {
    match (a, b) {
        (Value::Tuple(a), Value::Tuple(b)) => a.ptr_eq(b),
        (Value::List(a), Value::List(b)) => a.ptr_eq(b),
        _ => false,
    }
}
