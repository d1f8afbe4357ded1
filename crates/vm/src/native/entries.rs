//! Gives a function the places where machine code may begin, and has the code written that a place wants.

use super::apart::later;
use super::flow::{entries, registers};
use super::routine::routine;
use super::write::Found;
use crate::code::entries::{Entries, Entry, is_full};
use crate::code::kinds::Reg;
use crate::code::{Function, FunctionId, Program};
use crate::value::Value;
use niwaki_math::Scalar;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Visits before code is made: the interpreter has then spent about as much time there as the code takes to be made.
const VISITS: u32 = 20_000;

/// After how many visits code is made, where the environment says it: `NIWAKI_JIT=1` for at once, 0 for never.
static SAID: LazyLock<Option<u32>> =
    LazyLock::new(|| std::env::var("NIWAKI_JIT").ok().and_then(|word| word.parse().ok()));

/// The places of a function, whose code is made after the usual number of visits, while the run goes on.
pub(crate) fn entries_of<S: Scalar>(f: &Function<S>) -> Entries {
    match *SAID {
        Some(visits) => entries_after(f, visits, false),
        None => entries_after(f, VISITS, true),
    }
}

/// The places of a function, whose code is made after so many visits; none for zero. Where it is not made apart, the run waits.
fn entries_after<S: Scalar>(f: &Function<S>, visits: u32, is_apart: bool) -> Entries {
    // The code writes a truth value as a whole word, whose first byte the machine reads.
    let is_off = visits == 0 || cfg!(target_endian = "big");
    let places = if is_off { vec![] } else { entries(f) };
    Entries::at_places(places, f.code.len(), visits, is_apart)
}

impl<S: Scalar> Program<S> {
    /// The program with machine code after so many visits of a place, and none for zero: for tests and measurements, which
    /// want it at once or not at all.
    #[must_use]
    pub fn with_machine_code_after(mut self, visits: u32) -> Self {
        self.functions.iter_mut().for_each(|f| f.native = entries_after(f, visits, false));
        self
    }
}

/// Has code written at a place for the kinds that registers hold now. Where there is none to be had, nobody looks there again.
pub(crate) fn write<'v>(entry: &Entry, program: &'v Program, function: FunctionId, found: Found<'_, 'v>) {
    if !entry.claim() {
        return;
    }
    if !entry.is_apart() {
        return write_now(entry, program, function, found);
    }
    let own = registers(program.function(function)).into_iter();
    let values: HashMap<Reg, Value> = own.filter_map(|reg| Some((reg, found(reg)?.clone()))).collect();
    let (program, pc) = (program.clone(), entry.pc());
    let write = move || {
        if let Some(entry) = program.function(function).native.at(pc) {
            write_now(entry, &program, function, &|reg| values.get(&reg));
        }
    };
    if !later(Box::new(write)) {
        entry.give_back();
    }
}

fn write_now<'v>(entry: &Entry, program: &'v Program, function: FunctionId, found: Found<'_, 'v>) {
    let made = (!is_full()).then(|| routine(program, function, entry.pc(), found));
    entry.put(made.and_then(Result::ok));
}
