//! Edits of a run: a discrete choice has another value, a loop has an iteration more or less, a recursion a level more or less. All
//! else keeps its values, by address or moved with the level that it belongs to; what is new is drawn.

use super::structure::below;
use niwaki_chain::walk::state::State;
use niwaki_math::{RngCore, Stream, StreamKey};
use niwaki_run::fresh::Fresh;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::kept::levels::{Iterations, Moved, Within};
use niwaki_vm::machine::kept::{Change, Trace};
use niwaki_vm::value::Value;
use std::collections::{HashMap, HashSet};

/// The probability that levels are added or removed at the end of a loop, and not at any place.
const AT_END: f64 = 0.5;
/// The probability that a new level has the values of the level beside it.
const COPIED: f64 = 0.5;
/// The probability that a whole number moves by one, and is not drawn from its prior.
const BY_ONE: f64 = 0.75;

/// The values of a run by address.
pub(super) type Values = HashMap<u128, Value>;

/// The form of an edit.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// A discrete choice is turned.
    Turn,
    /// The iterations of a loop move by one.
    Shift,
    /// A recursion has a level more or less.
    Level,
}

/// Draws an edit of a run. Returns the values of the edited run, as far as they are known, and the number of runs that were made to
/// find them. `None` if the run has nothing to edit.
///
/// # Errors
/// A fault of the program that makes no run invalid.
pub(super) fn draw(task: &Task, state: &State, rng: &mut Stream) -> Result<Option<(Values, u64)>, Failure> {
    let (trace, program) = (&state.trace, &*task.program);
    let is_discrete = |n: &usize| matches!(trace.choice(program, *n).0, Value::Bool(_) | Value::Int(_));
    let discrete: Vec<usize> = trace.numbers().filter(is_discrete).collect();
    let loops = trace.loops(program);
    let has_choices = |levels: &&Iterations| {
        levels.parts.len() > 1 && !trace.moved(program, levels.parts[0], 0, &Within::All).choices.is_empty()
    };
    let shiftable: Vec<&Iterations> = loops.iter().filter(has_choices).collect();
    let recursions = trace.recursions(program);
    let mut forms = vec![];
    forms.extend((!discrete.is_empty()).then_some(Form::Turn));
    forms.extend((!shiftable.is_empty()).then_some(Form::Shift));
    forms.extend((!recursions.is_empty()).then_some(Form::Level));
    if forms.is_empty() {
        return Ok(None);
    }
    let mut values: Values = state.choices(program).collect();
    match forms[below(rng, forms.len())] {
        Form::Turn => {
            let choice = discrete[below(rng, discrete.len())];
            turn(&mut values, trace.address(program, choice), rng);
            // Loops that are longer or shorter in the turned run.
            let Some(turned) = begun(task, &values, rng)? else { return Ok(Some((values, 1))) };
            let lengths: HashMap<u128, usize> =
                turned.loops(program).iter().map(|levels| (levels.path(), levels.parts.len())).collect();
            let changed: Vec<(&Iterations, usize)> = loops
                .iter()
                .filter_map(|levels| {
                    let now = *lengths.get(&levels.path())?;
                    (now != levels.parts.len()).then_some((levels, now))
                })
                .collect();
            if rng.uniform() >= AT_END {
                let (u, copied) = (rng.uniform(), rng.uniform() < COPIED);
                for (levels, now) in changed {
                    let by = now as isize - levels.parts.len() as isize;
                    shift(&mut values, task, trace, levels, u, by, copied);
                }
            }
            Ok(Some((values, 1)))
        }
        Form::Shift => {
            let levels = shiftable[below(rng, shiftable.len())];
            let by = if rng.uniform() < 0.5 { 1 } else { -1 };
            let (u, copied) = (rng.uniform(), rng.uniform() < COPIED);
            shift(&mut values, task, trace, levels, u, by, copied);
            Ok(Some((values, 0)))
        }
        Form::Level => {
            let pair = &recursions[below(rng, recursions.len())];
            let (above, below) = (pair.above, pair.below);
            let (from, to) = (trace.part_path(below), trace.part_path(above));
            let moved = |part, to, within: &Within| trace.moved(program, part, to, within);
            if rng.uniform() < 0.5 {
                // The level below takes the place of the one above it.
                let mut up = moved(below, to, &Within::All);
                take(&mut values, task, trace, &moved(above, to, &Within::All));
                put(&mut values, task, trace, &mut up);
            } else {
                // The level is there twice, with or without what else it calls.
                let within =
                    if rng.uniform() < COPIED { Within::Without(below) } else { Within::Between(below) };
                let mut twice = moved(above, from, &within);
                let Some(place) = twice.below else { return Ok(Some((values, 0))) };
                let mut down = moved(below, place, &Within::All);
                take(&mut values, task, trace, &moved(below, from, &Within::All));
                put(&mut values, task, trace, &mut twice);
                put(&mut values, task, trace, &mut down);
            }
            Ok(Some((values, 0)))
        }
    }
}

/// Gives a discrete choice another value, or leaves it to the prior.
fn turn(values: &mut Values, address: u128, rng: &mut Stream) {
    let by = if rng.uniform() < 0.5 { 1 } else { -1 };
    let is_near = rng.uniform() < BY_ONE;
    match values.get(&address) {
        Some(Value::Bool(truth)) => values.insert(address, Value::Bool(!truth)),
        Some(Value::Int(number)) if is_near => {
            let turned = Value::Int(number.saturating_add(by));
            values.insert(address, turned)
        }
        _ => values.remove(&address),
    };
}

/// Adds `by` iterations to a loop at the place `u`, a share of its length, and moves those after it; or removes as many. With
/// `copied` a new one has the values of the one before it, or of the one after it at the begin; else they are drawn.
fn shift(
    values: &mut Values,
    task: &Task,
    trace: &Trace,
    levels: &Iterations,
    u: f64,
    by: isize,
    copied: bool,
) {
    let program = &*task.program;
    let (count, size) = (levels.parts.len(), by.unsigned_abs());
    let moved =
        |from: usize, to: usize| trace.moved(program, levels.parts[from], levels.path_of(to), &Within::All);
    let place = |places: usize| ((u * places as f64) as usize).min(places.saturating_sub(1));
    let mut after = vec![];
    let first = if by > 0 { place(count + 1) } else { place((count + 1).saturating_sub(size)) };
    for number in first..count {
        take(values, task, trace, &moved(number, number));
        let to = number as isize + by;
        if to >= first as isize {
            after.push(moved(number, to as usize));
        }
    }
    if by > 0 && copied && count > 0 {
        let model = first.saturating_sub(1).min(count - 1);
        (first..first + size).for_each(|number| after.push(moved(model, number)));
    }
    after.iter_mut().for_each(|moved| put(values, task, trace, moved));
}

/// Removes the choices of a part that is at its place.
fn take(values: &mut Values, task: &Task, trace: &Trace, here: &Moved) {
    here.choices.iter().for_each(|(_, n)| {
        values.remove(&trace.address(&task.program, *n));
    });
}

/// Adds the choices of a part that is at another place.
fn put(values: &mut Values, task: &Task, trace: &Trace, there: &mut Moved) {
    let value = |n: usize| trace.choice(&task.program, n).0.clone();
    values.extend(there.choices.drain(..).map(|(address, n)| (address, value(n))));
}

/// A run of the program with these values, without its scene. `None` if it is impossible or invalid.
fn begun(task: &Task, values: &Values, rng: &mut Stream) -> Result<Option<Trace>, Failure> {
    let key = StreamKey::new(rng.next_u64(), 0, 0);
    let mut answers = Fresh::of(key, Some(values), &*task.hosts);
    match task.begin(&mut task.machine(), &mut answers) {
        Ok((_, Change::Impossible)) => Ok(None),
        Ok((mut trace, _)) => {
            trace.commit(&task.program);
            Ok(Some(trace))
        }
        Err(met) if met.is_invalid() => Ok(None),
        Err(met) => Err(met.into()),
    }
}

/// The paths of the parts of an edited run that are new.
pub(super) fn new_parts(task: &Task, state: &State, values: &Values) -> Vec<u128> {
    let (trace, program) = (&state.trace, &*task.program);
    let known: HashSet<u128> = values.keys().copied().collect();
    let parts = trace.parts_without(program, &|address| known.contains(&address));
    let paths = parts.into_iter().filter(|part| !part.is_onward()).map(|part| trace.part_path(part));
    paths.collect()
}
