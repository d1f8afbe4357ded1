//! The choices of a run: an append-only log that copies of a particle share.
//!
//! Entries made since the last copy are the particle's own; at a copy they are frozen and shared. Forking costs
//! the entries since the last fork, not the length of the run.

use niwaki_vm::value::Value;
use smallvec::SmallVec;
use std::sync::Arc;

/// Most barriers are a few choices apart: that many need no allocation of their own.
type Few = SmallVec<[Entry; 4]>;

/// One choice.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its address, in two halves (a `u128` would align the entry to 16 bytes, and make it larger by a fifth).
    halves: [u64; 2],
    /// Its value.
    pub value: Value,
    /// Whether it is an order choice: which future ran.
    pub is_order: bool,
}

impl Entry {
    #[inline]
    fn new(address: u128, value: Value, is_order: bool) -> Self {
        Entry { halves: [address as u64, (address >> 64) as u64], value, is_order }
    }

    /// Its address.
    pub fn address(&self) -> u128 {
        u128::from(self.halves[0]) | u128::from(self.halves[1]) << 64
    }
}

/// Entries that no one changes any more, and those before them.
#[derive(Debug)]
struct Frozen {
    entries: Few,
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
        self.own.push(Entry::new(address, value, false));
    }

    /// Adds an order choice.
    pub fn push_order(&mut self, address: u128, which: usize) {
        self.own.push(Entry::new(address, Value::Int(which as i64), true));
    }

    /// A copy; both share what is there now.
    pub fn fork(&mut self) -> Log {
        self.freeze();
        Log { frozen: self.frozen.clone(), own: Few::new() }
    }

    fn freeze(&mut self) {
        if !self.own.is_empty() {
            let entries = std::mem::take(&mut self.own);
            self.frozen = Some(Arc::new(Frozen { entries, before: self.frozen.take() }));
        }
    }

    /// Becomes a copy of `other`; both share what is there now.
    pub fn become_copy(&mut self, other: &mut Log) {
        other.freeze();
        self.own.clear();
        self.frozen.clone_from(&other.frozen);
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
    fn a_long_chain_is_dropped_without_recursion() {
        let mut log = Log::default();
        for i in 0..1_000_000 {
            log.push(i, Value::None);
            drop(log.fork());
        }
        drop(log);
    }
}
