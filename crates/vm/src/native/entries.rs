//! The places of a function where machine code may begin, and the request to write code for a place.

use super::background::run_in_background;
use super::flow::{entries, registers};
use super::routine::routine;
use super::write::Contents;
use crate::code::entries::{Entries, Entry, is_full};
use crate::code::register::Reg;
use crate::code::{Function, FunctionId, Program};
use crate::value::Value;
use niwaki_math::Scalar;
use std::collections::HashMap;
use std::sync::LazyLock;

/// The number of visits before code is made: the interpreter has then spent about as much time there as
/// compilation takes.
const VISITS: u32 = 20_000;

/// The number of visits before code is made, if the environment sets it: `NIWAKI_JIT=1` for at once, 0 for
/// never.
static VISITS_OVERRIDE: LazyLock<Option<u32>> =
    LazyLock::new(|| std::env::var("NIWAKI_JIT").ok().and_then(|word| word.parse().ok()));

/// The places of a function where code is made after the usual number of visits, while the run continues.
pub(crate) fn entries_of<S: Scalar>(f: &Function<S>) -> Entries {
    match *VISITS_OVERRIDE {
        Some(visits) => entries_after(f, visits, false),
        None => entries_after(f, VISITS, true),
    }
}

/// The places of a function where code is made after `visits` visits; none for zero. Unless it is made in the
/// background, the run waits.
fn entries_after<S: Scalar>(f: &Function<S>, visits: u32, in_background: bool) -> Entries {
    // The code stores a truth value as a whole word, and the machine reads its first byte.
    let is_off = visits == 0 || cfg!(target_endian = "big");
    let places = if is_off { vec![] } else { entries(f) };
    Entries::at_places(places, f.code.len(), visits, in_background)
}

impl<S: Scalar> Program<S> {
    /// The program with machine code after `visits` visits of a place, and none for zero. Tests and
    /// measurements need the code at once or not at all.
    #[must_use]
    pub fn with_machine_code_after(mut self, visits: u32) -> Self {
        self.functions.iter_mut().for_each(|f| f.native = entries_after(f, visits, false));
        self
    }
}

/// Requests code at a place for the kinds that the registers hold now. If none can be written, the place is
/// closed.
pub(crate) fn write<'v>(
    entry: &Entry,
    program: &'v Program,
    function: FunctionId,
    contents: Contents<'_, 'v>,
) {
    if !entry.claim() {
        return;
    }
    if !entry.in_background() {
        return write_now(entry, program, function, contents);
    }
    program.function(function).native.postpone_behind(entry.pc());
    let numbers = registers(program.function(function)).into_iter();
    let values: HashMap<Reg, Value> = numbers.filter_map(|reg| Some((reg, contents(reg)?.clone()))).collect();
    let (program, pc) = (program.clone(), entry.pc());
    let write = move || {
        if let Some(entry) = program.function(function).native.at(pc) {
            write_now(entry, &program, function, &|reg| values.get(&reg));
        }
    };
    if !run_in_background(Box::new(write)) {
        entry.give_back();
    }
}

fn write_now<'v>(entry: &Entry, program: &'v Program, function: FunctionId, contents: Contents<'_, 'v>) {
    let machine_code = (!is_full()).then(|| routine(program, function, entry.pc(), contents));
    entry.put(machine_code.and_then(Result::ok));
}
