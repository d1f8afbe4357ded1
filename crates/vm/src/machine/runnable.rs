//! The futures that can run, in the order in which they became runnable.
//!
//! An algorithm picks a future by its place, and the order of the others stays. Few futures are a plain list.
//! Of many futures, each keeps a slot, and a tree of counts finds the slot of a place. Adding, removing and
//! finding take a time that grows with the logarithm of their number, so that a hundred thousand futures do not
//! take the square of that time.
//!
//! Source: Fenwick, A new data structure for cumulative frequency tables, 1994.

use super::buffers::copy;
use super::ids::FutureId;

/// The most futures in a plain list.
const FEW: usize = 64;

/// The content of a slot whose future cannot run any more.
const EMPTY: FutureId = FutureId(u32::MAX);

/// An ordered set of futures.
#[derive(Debug, Default)]
pub struct Runnable {
    slots: Vec<FutureId>,
    /// For many futures, the number of filled slots that each entry of the tree covers.
    counts: Vec<u32>,
    /// For many futures, the slot of each future, by its number.
    places: Vec<u32>,
    len: usize,
}

impl Runnable {
    /// The number of futures.
    #[inline]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no future.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The future at a place.
    #[inline]
    pub fn get(&self, place: usize) -> Option<FutureId> {
        if self.counts.is_empty() {
            return self.slots.get(place).copied();
        }
        (place < self.len).then(|| self.slots[self.slot_of(place)])
    }

    /// The first future.
    #[inline]
    pub fn first(&self) -> Option<FutureId> {
        self.get(0)
    }

    /// All futures, in order.
    pub fn iter(&self) -> impl Iterator<Item = FutureId> {
        self.slots.iter().copied().filter(|id| *id != EMPTY)
    }

    /// Adds a future at the end.
    pub(super) fn push(&mut self, id: FutureId) {
        self.slots.push(id);
        self.len += 1;
        if !self.counts.is_empty() {
            self.note_place(id, self.slots.len() - 1);
            self.count_last();
        } else if self.len > FEW {
            self.index();
        }
    }

    /// Removes a future, if it is in the set.
    #[inline]
    pub(super) fn remove(&mut self, id: FutureId) {
        if self.counts.is_empty() {
            if let Some(at) = self.slots.iter().position(|other| *other == id) {
                self.slots.remove(at);
                self.len -= 1;
            }
        } else {
            self.remove_indexed(id);
        }
    }

    /// Becomes a copy of another set, in place.
    #[inline]
    pub(super) fn clone_from(&mut self, source: &Runnable) {
        copy(&mut self.slots, &source.slots);
        self.len = source.len;
        if !(self.counts.is_empty() && source.counts.is_empty()) {
            copy(&mut self.counts, &source.counts);
            copy(&mut self.places, &source.places);
        }
    }

    #[inline(never)]
    fn remove_indexed(&mut self, id: FutureId) {
        let Some(at) = self.places.get(id.0 as usize).map(|at| *at as usize) else { return };
        if self.slots.get(at) != Some(&id) {
            return;
        }
        self.slots[at] = EMPTY;
        self.len -= 1;
        let mut entry = at + 1;
        while entry <= self.counts.len() {
            self.counts[entry - 1] -= 1;
            entry += low_bit(entry);
        }
        if 2 * self.len < self.slots.len() {
            self.slots.retain(|id| *id != EMPTY);
            self.counts.clear();
            if self.len > FEW / 2 {
                self.index();
            }
        }
    }

    /// Builds the tree anew; all slots are filled.
    fn index(&mut self) {
        self.counts.clear();
        for at in 0..self.slots.len() {
            self.note_place(self.slots[at], at);
            self.count_last();
        }
    }

    fn note_place(&mut self, id: FutureId, at: usize) {
        if self.places.len() <= id.0 as usize {
            self.places.resize(id.0 as usize + 1, 0);
        }
        self.places[id.0 as usize] = at as u32;
    }

    /// Adds the count of the next slot, which is filled.
    fn count_last(&mut self) {
        let entry = self.counts.len() + 1;
        let (mut count, mut below) = (1, entry - 1);
        while below > entry - low_bit(entry) {
            count += self.counts[below - 1];
            below -= low_bit(below);
        }
        self.counts.push(count);
    }

    /// The filled slot with `place` filled slots before it.
    fn slot_of(&self, place: usize) -> usize {
        let (mut before, mut left) = (0, place as u32);
        let mut width = self.counts.len().next_power_of_two();
        while width > 0 {
            let entry = before + width;
            if entry <= self.counts.len() && self.counts[entry - 1] <= left {
                left -= self.counts[entry - 1];
                before = entry;
            }
            width /= 2;
        }
        before
    }
}

fn low_bit(n: usize) -> usize {
    n & n.wrapping_neg()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pushes and removes at random, around the size at which the list becomes a tree.
    #[test]
    fn the_set_agrees_with_a_plain_list() {
        let mut dice: u64 = 5;
        let mut roll = |sides: usize| {
            dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (dice >> 33) as usize % sides
        };
        let (mut set, mut plain, mut next) = (Runnable::default(), Vec::new(), 0);
        for step in 0..20_000 {
            let grows = (step / 700) % 2 == 0;
            if plain.is_empty() || roll(10) < if grows { 7 } else { 3 } {
                set.push(FutureId(next));
                plain.push(FutureId(next));
                next += 1;
            } else {
                let id = plain.remove(roll(plain.len()));
                set.remove(id);
                set.remove(id);
            }
            assert_eq!((set.len(), set.first()), (plain.len(), plain.first().copied()));
            let place = roll(plain.len() + 1);
            assert_eq!(set.get(place), plain.get(place).copied(), "{step}: place {place}");
        }
        let mut copied = Runnable::default();
        copied.clone_from(&set);
        assert!(copied.iter().eq(plain.iter().copied()));
    }

    /// Work is counted, not time: one entry of the tree for each power of two.
    #[test]
    fn slots_are_dropped_once_half_of_them_are_empty() {
        let mut set = Runnable::default();
        (0..100_000).for_each(|id| set.push(FutureId(id)));
        for id in 0..99_990 {
            set.remove(FutureId(id));
            assert!(set.slots.len() <= 2 * set.len().max(FEW));
        }
        assert!(set.counts.is_empty() && set.iter().eq((99_990..100_000).map(FutureId)));
    }
}
