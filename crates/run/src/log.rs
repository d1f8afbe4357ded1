//! Logs: the choices of a run, append-only and shared between copies of a particle.
//!
//! A particle alone holds the entries since its last copy; a copy freezes and shares them. The cost of a fork grows with the
//! number of entries since the last fork, not with the length of the run.

use niwaki_math::Draw;
use niwaki_vm::value::{Census, Value};
use serde::ser::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::array;
use std::sync::Arc;
use std::vec::Drain;

/// The most recent entries before they are frozen: a list that grows without copies would be half empty.
const BLOCK: usize = 64;

/// The room of the first recent entries.
const ROOM: usize = 16;

/// An entry: a choice with its address and value.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The address, in two halves (a `u128` would align the entry to 16 bytes).
    halves: [u64; 2],
    /// The value. An order choice has a `Value::Future`, which no model can choose: the place of the future that ran.
    pub value: Value,
}

// A population holds an entry for each choice of each particle.
const _: () = assert!(std::mem::size_of::<Entry>() == 32);

impl Entry {
    /// Create an entry.
    #[inline]
    pub fn new(address: u128, value: Value) -> Self {
        Entry { halves: [address as u64, (address >> 64) as u64], value }
    }

    /// The address of the choice.
    pub fn address(&self) -> u128 {
        u128::from(self.halves[0]) | u128::from(self.halves[1]) << 64
    }

    /// Whether the entry is an order choice.
    pub fn is_order(&self) -> bool {
        self.which().is_some()
    }

    /// The place of the future that ran among the runnable futures; `None` unless the entry is an order choice.
    pub fn which(&self) -> Option<usize> {
        match self.value {
            Value::Future(place) => Some(place as usize),
            _ => None,
        }
    }
}

/// A block of frozen entries, and the blocks before it. It is one allocation: most barriers are a few choices apart.
#[derive(Debug)]
struct Frozen<E: ?Sized = [Entry]> {
    before: Option<Arc<Frozen>>,
    entries: E,
}

impl Frozen {
    /// A block of the next `N` entries.
    #[inline]
    fn of<const N: usize>(entries: &mut Drain<'_, Entry>, before: Option<Arc<Frozen>>) -> Arc<Frozen> {
        let entries: [Entry; N] = array::from_fn(|_| entries.next().expect("so many entries are left"));
        Arc::new(Frozen { before, entries })
    }
}

impl<E: ?Sized> Drop for Frozen<E> {
    fn drop(&mut self) {
        // A long chain must not be dropped by recursion. (If two threads drop its last two owners at once, one drops it from there.)
        let mut next = self.before.take();
        while let Some(mut block) = next {
            next = Arc::get_mut(&mut block).and_then(|block| block.before.take());
        }
    }
}

/// The choices of a run, in the order in which they were made.
#[derive(Debug, Default)]
pub struct Log {
    frozen: Option<Arc<Frozen>>,
    /// Entries since the last copy.
    recent: Vec<Entry>,
}

impl Log {
    /// Add a choice.
    #[inline]
    pub fn push(&mut self, address: u128, value: Value) {
        if self.recent.len() == self.recent.capacity() {
            self.make_room();
        }
        self.recent.push(Entry::new(address, value));
    }

    /// Make room for a recent entry: some, then for a block, which is frozen when it is full.
    #[cold]
    #[inline(never)]
    fn make_room(&mut self) {
        match self.recent.len() {
            BLOCK.. => self.freeze(),
            ROOM.. => self.recent.reserve_exact(BLOCK - self.recent.len()),
            few => self.recent.reserve_exact(ROOM - few),
        }
    }

    /// Add an order choice: the place of the future that ran among the runnable futures.
    pub fn push_order(&mut self, address: u128, place: usize) {
        self.push(address, Value::Future(place as u32));
    }

    /// Copy the log; both logs share the present entries.
    pub fn fork(&mut self) -> Log {
        self.freeze();
        Log { frozen: self.frozen.clone(), recent: Vec::new() }
    }

    fn freeze(&mut self) {
        // The list keeps its room, the blocks have no spare one.
        let mut entries = self.recent.drain(..);
        while entries.len() > 0 {
            let before = self.frozen.take();
            self.frozen = Some(match entries.len() {
                1 => Frozen::of::<1>(&mut entries, before),
                2 => Frozen::of::<2>(&mut entries, before),
                3 => Frozen::of::<3>(&mut entries, before),
                4..8 => Frozen::of::<4>(&mut entries, before),
                8..16 => Frozen::of::<8>(&mut entries, before),
                16..32 => Frozen::of::<16>(&mut entries, before),
                32..BLOCK => Frozen::of::<32>(&mut entries, before),
                _ => Frozen::of::<BLOCK>(&mut entries, before),
            });
        }
    }

    /// Become a copy of `other`; both logs share the present entries.
    pub fn become_copy(&mut self, other: &mut Log) {
        other.freeze();
        self.recent.clear();
        self.frozen.clone_from(&other.frozen);
    }

    /// Count the bytes of the log; shared blocks count once.
    pub fn count<'v>(&'v self, census: &mut Census<'v>) {
        let mut parts = vec![&self.recent[..]];
        let mut at = self.frozen.as_ref();
        while let Some(frozen) = at.filter(|frozen| census.is_first(frozen)) {
            census.add_bytes(size_of::<Frozen<[Entry; 0]>>() + 16);
            parts.push(&frozen.entries);
            at = frozen.before.as_ref();
        }
        for entry in parts.into_iter().flatten() {
            census.add_bytes(size_of::<Entry>());
            census.add(&entry.value);
        }
    }

    /// The number of entries.
    pub fn len(&self) -> usize {
        let (mut count, mut at) = (self.recent.len(), self.frozen.as_deref());
        while let Some(frozen) = at {
            count += frozen.entries.len();
            at = frozen.before.as_deref();
        }
        count
    }

    /// Whether the log has no entries.
    pub fn is_empty(&self) -> bool {
        self.recent.is_empty() && self.frozen.is_none()
    }

    /// All entries, oldest first.
    pub fn entries(&self) -> Vec<Entry> {
        let mut parts: Vec<&[Entry]> = vec![&self.recent];
        let mut at = self.frozen.as_deref();
        while let Some(frozen) = at {
            parts.push(&frozen.entries);
            at = frozen.before.as_deref();
        }
        parts.into_iter().rev().flatten().cloned().collect()
    }
}

/// Collect choices in order.
impl FromIterator<(u128, Value)> for Log {
    fn from_iter<T: IntoIterator<Item = (u128, Value)>>(choices: T) -> Log {
        let mut log = Log::default();
        choices.into_iter().for_each(|(address, value)| log.push(address, value));
        log
    }
}

/// The value of an entry as data; reals are stored as their bits.
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
            Value::Future(place) => Plain::Order(*place),
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

/// A row of whole numbers or of truth values as data; as a draw it would become a row of reals.
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
            Plain::Order(place) => Value::Future(place),
        };
        let entries: Vec<(u128, Plain)> = Vec::deserialize(from)?;
        Ok(entries.into_iter().map(|(address, plain)| (address, value(plain))).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_share_entries_before_the_copy_only() {
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
