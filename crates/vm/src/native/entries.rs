//! Where machine code may begin, and the code that was made for it.

use super::apart::later;
use super::flow::{entries, registers};
use super::kinds::Reg;
use super::routine::Routine;
use crate::code::{Function, FunctionId, Program};
use crate::value::Value;
use niwaki_math::Scalar;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, OnceLock};

/// Visits before code is made: the interpreter has then spent about as much time there as the code takes to be made.
const VISITS: u32 = 20_000;

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

/// After how many visits code is made, where the environment says it: `NIWAKI_JIT=1` for at once, 0 for never.
static SAID: LazyLock<Option<u32>> =
    LazyLock::new(|| std::env::var("NIWAKI_JIT").ok().and_then(|word| word.parse().ok()));

/// The places of one function where machine code may begin. Copies of a program share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entries {
    /// For each instruction, the number of its entry from one on; zero for none.
    numbers: Arc<[u16]>,
    all: Arc<[Entry]>,
}

impl Entries {
    /// Those of a function, whose code is made after the usual number of visits, while the run goes on.
    pub fn of<S: Scalar>(f: &Function<S>) -> Entries {
        match *SAID {
            Some(visits) => Entries::after(f, visits),
            None => Entries::new(f, VISITS, true),
        }
    }

    /// Those of a function, whose code is made after so many visits, and then the run waits for it; none for zero.
    pub fn after<S: Scalar>(f: &Function<S>, visits: u32) -> Entries {
        Entries::new(f, visits, false)
    }

    fn new<S: Scalar>(f: &Function<S>, visits: u32, is_apart: bool) -> Entries {
        // The code writes a truth value as a whole word, whose first byte the machine reads.
        let is_off = visits == 0 || cfg!(target_endian = "big");
        let places = if is_off { vec![] } else { entries(f) };
        let mut numbers = vec![0; if places.is_empty() { 0 } else { f.code.len() }];
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

    /// Has code written for the kinds that registers hold now. Where there is none to be had, nobody looks here again.
    pub fn write<'v>(&self, program: &'v Program, function: FunctionId, found: Found<'_, 'v>) {
        if !self.routines.iter().any(|routine| routine.get().is_none()) {
            // As many kinds come here as nobody expects of a loop.
            if self.uses.load(Ordering::Relaxed) < TRIAL {
                self.close();
            }
            return;
        }
        // Somebody else who writes here writes the same.
        if self.is_written.swap(true, Ordering::Acquire) {
            return;
        }
        if !self.is_apart {
            return self.write_now(program, function, found);
        }
        let own = registers(program.function(function)).into_iter();
        let values: HashMap<Reg, Value> = own.filter_map(|reg| Some((reg, found(reg)?.clone()))).collect();
        let (program, pc) = (program.clone(), self.pc as usize);
        let write = move || {
            if let Some(entry) = program.function(function).native.at(pc) {
                entry.write_now(&program, function, &|reg| values.get(&reg));
            }
        };
        if !later(Box::new(write)) {
            self.is_written.store(false, Ordering::Release);
        }
    }

    fn write_now<'v>(&self, program: &'v Program, function: FunctionId, found: Found<'_, 'v>) {
        let is_full = BYTES.load(Ordering::Relaxed) > MOST_BYTES;
        let routine = (!is_full).then(|| Routine::write(program, function, self.pc as usize, found));
        let free = self.routines.iter().find(|routine| routine.get().is_none());
        if let (Some(Ok(routine)), Some(free)) = (routine, free) {
            BYTES.fetch_add(routine.bytes(), Ordering::Relaxed);
            let _ = free.set(routine);
        } else {
            self.close();
        }
        self.is_written.store(false, Ordering::Release);
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

/// What the registers of a function hold where code begins.
pub(super) type Found<'a, 'v> = &'a dyn Fn(Reg) -> Option<&'v Value>;
