//! The places of a function where machine code may begin, and the code that was made so far. This module does
//! not know who makes the code.

use super::routine::Routine;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// The most combinations of kinds that have code of their own at a place.
const ROUTINES: usize = 3;

/// The number of uses after which the code is judged, and the fewest instructions that a use must run on
/// average to be worth its call. A vector that the code makes counts as
/// eight instructions.
const TRIAL: u32 = 256;
const WORTH: u64 = 4;

/// Most bytes of machine code that all programs of a process have at a time.
const MOST_BYTES: usize = 64 << 20;

/// Bytes of machine code at present.
static BYTES: AtomicUsize = AtomicUsize::new(0);

/// A place where machine code may begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    /// The instruction.
    pub pc: u32,
    /// Whether the code is worth its call only if it makes choices.
    pub for_choices: bool,
}

/// The places of one function where machine code may begin. Copies of a program share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entries {
    /// The number of the entry of each instruction, from one on; zero for none.
    numbers: Arc<[u16]>,
    all: Arc<[Entry]>,
}

impl Entries {
    /// Entries at the given instructions, ascending, of a function with `instructions` instructions. Code is
    /// made after `visits` visits, by a thread of its own if `in_background`.
    pub fn at_places(places: Vec<Place>, instructions: usize, visits: u32, in_background: bool) -> Entries {
        let mut numbers = vec![0; if places.is_empty() { 0 } else { instructions }];
        for (k, place) in places.iter().enumerate() {
            numbers[place.pc as usize] = k as u16 + 1;
        }
        let all = places.into_iter().map(|place| Entry::new(place, visits, in_background));
        Entries { numbers: numbers.into(), all: all.collect() }
    }

    /// Bytes of the code of all entries.
    pub fn bytes(&self) -> usize {
        self.all.iter().map(Entry::bytes).sum()
    }

    /// Forgets the visits of all places behind an instruction: code from there on may run through them.
    pub fn postpone_behind(&self, pc: usize) {
        let behind = self.all.iter().filter(|entry| entry.pc() > pc);
        behind.for_each(|entry| entry.visits.store(0, Ordering::Relaxed));
    }

    /// The entry at an instruction.
    #[inline]
    pub fn at(&self, pc: usize) -> Option<&Entry> {
        match self.numbers.get(pc) {
            None | Some(0) => None,
            Some(number) => self.all.get(usize::from(*number) - 1),
        }
    }
}

/// A place of a function where machine code may begin.
#[derive(Debug)]
pub(crate) struct Entry {
    place: Place,
    /// The number of visits before code is made.
    after: u32,
    /// Whether a thread of its own makes the code, while the run continues.
    in_background: bool,
    /// Whether the machine no longer looks here for code.
    is_closed: AtomicBool,
    visits: AtomicU32,
    uses: AtomicU32,
    done: AtomicU64,
    routines: [OnceLock<Routine>; ROUTINES],
    is_written: AtomicBool,
}

impl Entry {
    fn new(place: Place, after: u32, in_background: bool) -> Entry {
        Entry {
            place,
            after,
            in_background,
            is_closed: AtomicBool::new(false),
            visits: AtomicU32::new(0),
            uses: AtomicU32::new(0),
            done: AtomicU64::new(0),
            routines: Default::default(),
            is_written: AtomicBool::new(false),
        }
    }

    /// Whether there is code here, or may be later, for a run whose choices machine code makes or not.
    #[inline]
    pub fn is_open(&self, chooses: bool) -> bool {
        !self.is_closed.load(Ordering::Relaxed) && (chooses || !self.place.for_choices)
    }

    fn close(&self) {
        self.is_closed.store(true, Ordering::Relaxed);
    }

    /// The pieces of code that exist, one for each combination of kinds.
    #[inline]
    pub fn routines(&self) -> impl Iterator<Item = &Routine> {
        self.routines.iter().map_while(OnceLock::get)
    }

    fn bytes(&self) -> usize {
        self.routines().map(Routine::bytes).sum()
    }

    /// Counts a visit that found no code for its kinds, and returns whether to write it now.
    #[inline]
    pub fn is_due(&self) -> bool {
        let visits = self.visits.fetch_add(1, Ordering::Relaxed) + 1;
        visits.is_multiple_of(self.after)
    }

    /// The instruction.
    pub fn pc(&self) -> usize {
        self.place.pc as usize
    }

    /// Whether a thread of its own makes the code, while the run continues.
    pub fn in_background(&self) -> bool {
        self.in_background
    }

    /// Claims the place for one more piece of code. Returns `false` if another thread writes one, which will be
    /// the same, or if the place is full.
    pub fn claim(&self) -> bool {
        if !self.routines.iter().any(|routine| routine.get().is_none()) {
            // More kinds come here than a loop should have: the place is not worth its code.
            if self.uses.load(Ordering::Relaxed) < TRIAL {
                self.close();
            }
            return false;
        }
        !self.is_written.swap(true, Ordering::Acquire)
    }

    /// Releases the claim.
    pub fn give_back(&self) {
        self.is_written.store(false, Ordering::Release);
    }

    /// Stores a piece of code here, and releases the claim. `None` closes the place: there can be no code.
    pub fn put(&self, routine: Option<Routine>) {
        let free = self.routines.iter().find(|routine| routine.get().is_none());
        if let (Some(routine), Some(free)) = (routine, free) {
            BYTES.fetch_add(routine.bytes(), Ordering::Relaxed);
            let _ = free.set(routine);
        } else {
            self.close();
        }
        self.give_back();
    }

    /// Records how many instructions a use ran, until the code is judged.
    #[inline]
    pub fn note(&self, done: impl FnOnce() -> u64) {
        if self.uses.load(Ordering::Relaxed) < TRIAL {
            self.judge(done());
        }
    }

    #[cold]
    fn judge(&self, done: u64) {
        let all = self.done.fetch_add(done, Ordering::Relaxed) + done;
        if self.uses.fetch_add(1, Ordering::Relaxed) + 1 == TRIAL && all < WORTH * u64::from(TRIAL) {
            self.close();
        }
    }
}

impl Drop for Entry {
    fn drop(&mut self) {
        BYTES.fetch_sub(self.bytes(), Ordering::Relaxed);
    }
}

/// Whether the programs of the process have reached the limit on machine code.
pub(crate) fn is_full() -> bool {
    BYTES.load(Ordering::Relaxed) > MOST_BYTES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_behind_new_code_count_their_visits_anew() {
        let places = [0, 4, 9].map(|pc| Place { pc, for_choices: false });
        let entries = Entries::at_places(places.into(), 12, 3, true);
        let is_due = |pc: usize| entries.at(pc).expect("an entry").is_due();
        for pc in [0, 4, 9, 0, 4, 9] {
            assert!(!is_due(pc));
        }
        assert!(is_due(4));
        entries.postpone_behind(4);
        assert_eq!([is_due(9), is_due(9), is_due(9)], [false, false, true]);
        assert!(is_due(0));
    }
}
