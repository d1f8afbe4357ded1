//! The choices of a run: an append-only log that copies of a particle share.
//!
//! Entries since the last copy belong to the particle alone; at a copy they are frozen and shared. Forking costs
//! the entries since the last fork, not the length of the run.

use niwaki_math::Draw;
use niwaki_vm::value::{Census, Value};
use serde::ser::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use smallvec::SmallVec;
use std::sync::Arc;

/// Entries stored without an allocation: most barriers are a few choices apart.
type Few = SmallVec<[Entry; 4]>;

/// Own entries beyond this many are frozen: a list that grows without copies would be half empty.
const BLOCK: usize = 64;

/// One choice.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its address, in two halves (a `u128` would align the entry to 16 bytes).
    halves: [u64; 2],
    /// Its value. That of an order choice, which future ran, is a `Value::Future`, which no model can choose.
    pub value: Value,
}

// A population holds one for each choice of each particle.
const _: () = assert!(std::mem::size_of::<Entry>() == 32);

impl Entry {
    /// A choice.
    #[inline]
    pub fn new(address: u128, value: Value) -> Self {
        Entry { halves: [address as u64, (address >> 64) as u64], value }
    }

    /// Its address.
    pub fn address(&self) -> u128 {
        u128::from(self.halves[0]) | u128::from(self.halves[1]) << 64
    }

    /// Whether it is an order choice.
    pub fn is_order(&self) -> bool {
        self.which().is_some()
    }

    /// Of an order choice, the place of the future that ran among those that could.
    pub fn which(&self) -> Option<usize> {
        match self.value {
            Value::Future(which) => Some(which as usize),
            _ => None,
        }
    }
}

/// Entries that do not change any more, and those before them.
#[derive(Debug)]
struct Frozen {
    entries: Box<[Entry]>,
    before: Option<Arc<Frozen>>,
}

impl Drop for Frozen {
    fn drop(&mut self) {
        // A long chain must not be dropped by recursion.
        let mut next = self.before.take();
        while let Some(mut one) = next.and_then(Arc::into_inner) {
            next = one.before.take();
        }
    }
}

/// The choices of a run, in the order in which they were made.
#[derive(Debug, Default)]
pub struct Log {
    frozen: Option<Arc<Frozen>>,
    own: Few,
}

impl Log {
    /// Adds a choice.
    #[inline]
    pub fn push(&mut self, address: u128, value: Value) {
        if self.own.len() == BLOCK {
            self.freeze();
        }
        self.own.push(Entry::new(address, value));
    }

    /// Adds an order choice: the place of the future that ran among those that could.
    pub fn push_order(&mut self, address: u128, which: usize) {
        self.push(address, Value::Future(which as u32));
    }

    /// A copy; both share what is there now.
    pub fn fork(&mut self) -> Log {
        self.freeze();
        Log { frozen: self.frozen.clone(), own: Few::new() }
    }

    fn freeze(&mut self) {
        if !self.own.is_empty() {
            // With no spare capacity.
            let mut entries = Vec::with_capacity(self.own.len());
            entries.extend(self.own.drain(..));
            let entries = entries.into_boxed_slice();
            self.frozen = Some(Arc::new(Frozen { entries, before: self.frozen.take() }));
        }
    }

    /// Becomes a copy of `other`; both share what is there now.
    pub fn become_copy(&mut self, other: &mut Log) {
        other.freeze();
        self.own.clear();
        self.frozen.clone_from(&other.frozen);
    }

    /// Counts its bytes; what copies share counts once.
    pub fn count<'v>(&'v self, census: &mut Census<'v>) {
        let mut parts = vec![&self.own[..]];
        let mut at = self.frozen.as_ref();
        while let Some(frozen) = at.filter(|frozen| census.is_first(frozen)) {
            census.add_bytes(size_of::<Frozen>() + 16);
            parts.push(&frozen.entries);
            at = frozen.before.as_ref();
        }
        for entry in parts.into_iter().flatten() {
            census.add_bytes(size_of::<Entry>());
            census.add(&entry.value);
        }
    }

    /// How many entries.
    pub fn len(&self) -> usize {
        let (mut count, mut at) = (self.own.len(), self.frozen.as_deref());
        while let Some(frozen) = at {
            count += frozen.entries.len();
            at = frozen.before.as_deref();
        }
        count
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.own.is_empty() && self.frozen.is_none()
    }

    /// Every entry, oldest first.
    pub fn entries(&self) -> Vec<Entry> {
        let mut parts: Vec<&[Entry]> = vec![&self.own];
        let mut at = self.frozen.as_deref();
        while let Some(frozen) = at {
            parts.push(&frozen.entries);
            at = frozen.before.as_deref();
        }
        parts.into_iter().rev().flatten().cloned().collect()
    }
}

/// Choices in the order made.
impl FromIterator<(u128, Value)> for Log {
    fn from_iter<T: IntoIterator<Item = (u128, Value)>>(choices: T) -> Log {
        let mut log = Log::default();
        choices.into_iter().for_each(|(address, value)| log.push(address, value));
        log
    }
}

/// The value of an entry as data; reals as the numbers of their bits.
#[derive(Serialize, Deserialize)]
enum Plain {
    Bool(bool),
    Int(i64),
    Real(u64),
    Vector(Vec<u64>),
    Counts(Vec<i64>),
    Truths(Vec<bool>),
    Order(u32),
}

impl Plain {
    fn of(value: &Value) -> Option<Plain> {
        Some(match value {
            Value::Future(which) => Plain::Order(*which),
            Value::Bool(b) => Plain::Bool(*b),
            Value::Int(i) => Plain::Int(*i),
            Value::Real(x) => Plain::Real(x.to_bits()),
            row => match of_one_kind(row) {
                Some(plain) => plain,
                None => Plain::Vector(row.draw()?.as_vector()?.iter().map(|x| x.to_bits()).collect()),
            },
        })
    }
}

/// A list of whole numbers, or of truth values, which as a draw would be real numbers.
fn of_one_kind(value: &Value) -> Option<Plain> {
    let Value::Tuple(all) = value else { return None };
    let counts = all.items().iter().map(|x| if let Value::Int(k) = x { Some(*k) } else { None });
    let truths = all.items().iter().map(|x| if let Value::Bool(b) = x { Some(*b) } else { None });
    let counts = counts.collect::<Option<_>>().map(Plain::Counts);
    counts.or_else(|| truths.collect::<Option<_>>().map(Plain::Truths))
}

impl Serialize for Log {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let plain = |entry: &Entry| {
            let unfit = || S::Error::custom(format!("a choice of {}", entry.value.described()));
            Ok((entry.address(), Plain::of(&entry.value).ok_or_else(unfit)?))
        };
        to.collect_seq(self.entries().iter().map(plain).collect::<Result<Vec<_>, _>>()?)
    }
}

impl<'de> Deserialize<'de> for Log {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Log, D::Error> {
        let value = |plain| match plain {
            Plain::Bool(b) => Value::Bool(b),
            Plain::Int(i) => Value::Int(i),
            Plain::Real(bits) => Value::Real(f64::from_bits(bits)),
            Plain::Vector(xs) => Draw::Vector(xs.into_iter().map(f64::from_bits).collect()).into(),
            Plain::Counts(all) => Draw::Counts(all.into()).into(),
            Plain::Truths(all) => Draw::Truths(all.into()).into(),
            Plain::Order(which) => Value::Future(which),
        };
        let entries: Vec<(u128, Plain)> = Vec::deserialize(from)?;
        Ok(entries.into_iter().map(|(address, plain)| (address, value(plain))).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_share_the_past_and_not_the_future() {
        let mut a = Log::default();
        a.push(1, Value::Int(1));
        let mut b = a.fork();
        a.push(2, Value::Int(2));
        b.push(3, Value::Int(3));
        let c = a.fork();
        let addresses = |l: &Log| l.entries().iter().map(Entry::address).collect::<Vec<_>>();
        assert_eq!(addresses(&a), [1, 2]);
        assert_eq!(addresses(&b), [1, 3]);
        assert_eq!(addresses(&c), [1, 2]);
    }

    #[test]
    fn long_logs_keep_their_order() {
        let mut log = Log::default();
        for i in 0..1000 {
            if i % 7 == 0 { log.push_order(i, 3) } else { log.push(i, Value::Int(3)) }
        }
        let entries = log.fork().entries();
        assert_eq!((log.len(), entries.len()), (1000, 1000));
        for (i, entry) in entries.iter().enumerate() {
            assert_eq!((entry.address(), entry.is_order()), (i as u128, i % 7 == 0));
            assert_eq!(entry.which(), (i % 7 == 0).then_some(3));
        }
    }

    #[test]
    fn a_long_chain_is_dropped_without_recursion() {
        let mut log = Log::default();
        for i in 0..1_000_000 {
            log.push(i, Value::None);
            drop(log.fork());
        }
        drop(log);
    }
}
