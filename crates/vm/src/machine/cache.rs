//! A cache of distributions by the list or tuple of their parameters. A categorical distribution over the
//! weights of a mixture is built once, not for each point.
//!
//! The place of an entry follows from the numbers of the parameters, not from their address in memory: what is built
//! again, and with it the time of a run, is the same in each process. An entry owns its parameters, so that an equal
//! address means equal parameters.

use crate::builtins::make_dist;
use crate::fault::Fault;
use crate::value::Value;
use niwaki_math::{Dist, Family, Scalar};

/// Entries of the table, a power of two; the first and the last parameter select two neighbours.
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

    /// The index of the entry for a list or tuple: the entry of this value, else the entry to fill.
    #[inline]
    pub fn index(&self, value: &Value<S>) -> Option<usize> {
        let row = match value {
            Value::Tuple(tuple) => tuple.items(),
            Value::List(list) => list.chunk(0),
            _ => return None,
        };
        let bits = row.first().map_or(0, bits_of) ^ row.last().map_or(0, bits_of).rotate_left(32);
        // All bits of both numbers reach the highest ones of the product by the golden ratio.
        let first = (bits.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (u64::BITS - ENTRIES.ilog2())) as usize;
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

/// The bits of a number; of any other parameter, nothing.
#[inline]
fn bits_of<S: Scalar>(parameter: &Value<S>) -> u64 {
    match parameter {
        Value::Real(x) => x.value().to_bits(),
        Value::Int(n) => *n as u64,
        _ => 0,
    }
}

/// Whether two values have the same distributions: they are one object in memory, or rows of the same numbers.
#[inline]
fn is_same<S: Scalar>(a: &Value<S>, b: &Value<S>) -> bool {
    match (a, b) {
        (Value::Tuple(a), Value::Tuple(b)) => a.ptr_eq(b) || are_same(a.items(), b.items()),
        (Value::List(a), Value::List(b)) => {
            a.ptr_eq(b)
                || a.len() == b.len() && are_same(a.chunk(0), b.chunk(0)) && a.len() == a.chunk(0).len()
        }
        _ => false,
    }
}

/// Whether two rows have the same numbers. A number whose slope is recorded is the same only as the same object.
fn are_same<S: Scalar>(a: &[Value<S>], b: &[Value<S>]) -> bool {
    let is_equal = |(a, b): (&Value<S>, &Value<S>)| match (a, b) {
        (Value::Real(x), Value::Real(y)) => {
            x.value().to_bits() == y.value().to_bits() && !x.varies() && !y.varies()
        }
        (Value::Int(x), Value::Int(y)) => x == y,
        _ => false,
    };
    a.len() == b.len() && a.iter().zip(b).all(is_equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A list of its own in memory.
    fn list(numbers: &[f64]) -> Value {
        Value::list(numbers.iter().map(|x| Value::Real(*x)).collect())
    }

    fn place(cache: &DistCache<f64>, value: &Value) -> usize {
        cache.index(value).expect("a list or a tuple")
    }

    #[test]
    fn equal_rows_share_a_distribution_wherever_they_are() {
        let mut cache = DistCache::holding(1 << 20);
        let rows: Vec<Value> = (0..50).map(|_| list(&[0.5, 0.3, 0.2])).collect();
        let at = place(&cache, &rows[0]);
        cache.build(at, Family::Categorical, &rows[0]).expect("weights");
        for row in &rows {
            assert_eq!(place(&cache, row), at);
            assert!(cache.holds(at, Family::Categorical, row));
            assert!(!cache.holds(at, Family::Dirichlet, row));
        }
        for other in [[0.5, 0.2, 0.2], [0.5, 0.3, 0.3]] {
            let other = list(&other);
            assert!(!cache.holds(place(&cache, &other), Family::Categorical, &other));
        }
        let whole = Value::list(vec![Value::Int(1), Value::Int(2)]);
        assert!(!is_same(&whole, &list(&[1.0, 2.0])) && !is_same(&list(&[0.0]), &list(&[-0.0])));
    }

    #[test]
    fn rows_are_spread_over_the_entries() {
        let cache = DistCache::holding(1 << 20);
        // Rows of short numbers, whose bits differ at their upper ends only.
        let rows = (0..16).flat_map(|a| (0..16).map(move |b| list(&[f64::from(a), 1.0, f64::from(b) / 4.0])));
        let mut places: Vec<usize> = rows.map(|row| place(&cache, &row)).collect();
        assert!(places.iter().all(|at| *at < ENTRIES));
        places.sort_unstable();
        places.dedup();
        assert!(places.len() > 180, "{} places of 256 rows", places.len());
    }
}
