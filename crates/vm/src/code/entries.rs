//! Where machine code may begin in a function, and what was made for it so far. Who makes it is unknown here.

use super::routine::Routine;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// Most combinations of kinds that have code of their own.
const ROUTINES: usize = 3;

/// Uses after which it is known whether the code is worth its calls, and the fewest instructions that a use must carry
/// out on average: a call costs about as much as these. A vector that was made counts as eight.
const TRIAL: u32 = 256;
const WORTH: u64 = 8;

/// Most bytes of machine code that all programs of a process have at a time.
const MOST_BYTES: usize = 64 << 20;

/// Bytes of machine code at present.
static BYTES: AtomicUsize = AtomicUsize::new(0);

/// The places of one function where machine code may begin. Copies of a program share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entries {
    /// For each instruction, the number of its entry from one on; zero for none.
    numbers: Arc<[u16]>,
    all: Arc<[Entry]>,
}

impl Entries {
    /// At those instructions of a function of so many, ascending; what is made after so many visits, and where that is said by a
    /// thread of its own.
    pub fn at_places(places: Vec<u32>, instructions: usize, visits: u32, is_apart: bool) -> Entries {
        let mut numbers = vec![0; if places.is_empty() { 0 } else { instructions }];
        for (k, pc) in places.iter().enumerate() {
            numbers[*pc as usize] = k as u16 + 1;
        }
        let all = places.into_iter().map(|pc| Entry::new(pc, visits, is_apart));
        Entries { numbers: numbers.into(), all: all.collect() }
    }

    /// Bytes of their code.
    pub fn bytes(&self) -> usize {
        self.all.iter().map(Entry::bytes).sum()
    }

    /// The one at an instruction.
    #[inline]
    pub fn at(&self, pc: usize) -> Option<&Entry> {
        match self.numbers.get(pc) {
            None | Some(0) => None,
            Some(number) => self.all.get(usize::from(*number) - 1),
        }
    }
}

/// One such place.
#[derive(Debug)]
pub(crate) struct Entry {
    pc: u32,
    /// How many visits there are before code is made.
    after: u32,
    /// Whether a thread of its own makes it, while the run goes on.
    is_apart: bool,
    /// Whether it is not worth while to look here.
    is_closed: AtomicBool,
    visits: AtomicU32,
    uses: AtomicU32,
    done: AtomicU64,
    routines: [OnceLock<Routine>; ROUTINES],
    is_written: AtomicBool,
}

impl Entry {
    fn new(pc: u32, after: u32, is_apart: bool) -> Entry {
        Entry {
            pc,
            after,
            is_apart,
            is_closed: AtomicBool::new(false),
            visits: AtomicU32::new(0),
            uses: AtomicU32::new(0),
            done: AtomicU64::new(0),
            routines: Default::default(),
            is_written: AtomicBool::new(false),
        }
    }

    /// Whether there is code here, or may be some day.
    #[inline]
    pub fn is_open(&self) -> bool {
        !self.is_closed.load(Ordering::Relaxed)
    }

    fn close(&self) {
        self.is_closed.store(true, Ordering::Relaxed);
    }

    /// The code that there is, one piece for each combination of kinds.
    #[inline]
    pub fn routines(&self) -> impl Iterator<Item = &Routine> {
        self.routines.iter().map_while(OnceLock::get)
    }

    fn bytes(&self) -> usize {
        self.routines().map(Routine::bytes).sum()
    }

    /// Counts a visit that found no code for its kinds; whether to write it now.
    #[inline]
    pub fn is_due(&self) -> bool {
        let visits = self.visits.fetch_add(1, Ordering::Relaxed) + 1;
        visits.is_multiple_of(self.after)
    }

    /// The instruction.
    pub fn pc(&self) -> usize {
        self.pc as usize
    }

    /// Whether a thread of its own makes the code, while the run goes on.
    pub fn is_apart(&self) -> bool {
        self.is_apart
    }

    /// Claims the place for one more piece of code; false where somebody else writes one, who writes the same, and where there
    /// are as many as there may be.
    pub fn claim(&self) -> bool {
        if !self.routines.iter().any(|routine| routine.get().is_none()) {
            // As many kinds come here as nobody expects of a loop.
            if self.uses.load(Ordering::Relaxed) < TRIAL {
                self.close();
            }
            return false;
        }
        !self.is_written.swap(true, Ordering::Acquire)
    }

    /// Gives the claim back.
    pub fn give_back(&self) {
        self.is_written.store(false, Ordering::Release);
    }

    /// Puts a piece of code here, and gives the claim back. Where there is none to be had, nobody looks here again.
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

    /// Notes how many instructions a use carried out, while that is of interest.
    #[inline]
    pub fn note(&self, done: u64) {
        if self.uses.load(Ordering::Relaxed) >= TRIAL {
            return;
        }
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

/// Whether the programs of the process have as much machine code as they may have.
pub(crate) fn is_full() -> bool {
    BYTES.load(Ordering::Relaxed) > MOST_BYTES
}
