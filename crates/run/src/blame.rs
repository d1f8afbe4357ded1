//! Which parts of scenes break a constraint: for what is told of runs that became impossible.

use crate::Task;
use crate::failure::{Blame, Dead, Emitted, Failure};
use crate::replay::{Missing, Part, Source, by_address, replay};
use niwaki_geom::Primitive;
use niwaki_geom::sketch::SketchSpec;
use niwaki_geom::sketch::product::Sketches;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Most runs that are looked at.
pub const RUNS: usize = 300;

/// Where a part is emitted.
fn emitted(part: &Part) -> Emitted {
    let (call, s) = (&part.place, part.place.span);
    let span = [s.line, s.column, s.end_line, s.end_column];
    Emitted { path: part.path.clone(), function: call.function.to_string(), file: call.file, span }
}

/// A failure with the parts that break a constraint. They are looked for only in what a person reads: searches that go on after
/// a population has died do not need them.
pub fn explained(mut failure: Failure, task: &Task) -> Failure {
    if let Failure::Impossible { dead, blame: found, .. } = &mut failure {
        *found = blame(task, &std::mem::take(dead));
    }
    failure
}

/// The parts of impossible runs that break a constraint, most frequent first, and how many runs were looked at. Runs that something
/// else made impossible have none.
pub(crate) fn blame(task: &Task, runs: &[Dead]) -> (Vec<Blame>, usize) {
    let mut counts: BTreeMap<_, Blame> = BTreeMap::new();
    let all: Vec<Option<Blame>> = runs.par_iter().map(|run| blame_in(task, run)).collect();
    for blame in all.into_iter().flatten() {
        // A pair is the same pair in either order.
        let mut places = [Some(blame.part.place()), blame.other.as_ref().map(Emitted::place)];
        places.sort();
        counts.entry((blame.constraint.clone(), places)).or_insert(blame).runs += 1;
    }
    let mut found: Vec<Blame> = counts.into_values().collect();
    found.sort_by_key(|one| std::cmp::Reverse(one.runs));
    (found, runs.len())
}

/// That of one run, not counted yet.
fn blame_in(task: &Task, Dead { cause, entries }: &Dead) -> Option<Blame> {
    // Of the scores only the constraint is computed.
    let sketches: Vec<_> = task.sketches.iter().filter(|own| own.name() == cause).cloned().collect();
    if sketches.is_empty() {
        return None;
    }
    let own = Task { sketches, ..task.uncounted() };
    let trace = replay(&own, Source::Addresses(by_address(entries)), Missing::Stop).ok()?;
    let (part, other) = first_forbidden(&own.sketches, &trace.parts)?;
    let (part, other) = (emitted(part), other.map(emitted));
    Some(Blame { constraint: cause.clone(), part, other, runs: 0 })
}

/// The first part, in the order of the program, with which the scene is forbidden; and where that part alone is not, a part
/// before it with which it is.
fn first_forbidden<'a>(
    sketches: &[Arc<dyn SketchSpec>],
    parts: &'a [Part],
) -> Option<(&'a Part, Option<&'a Part>)> {
    let primitives: Vec<Primitive> = parts.iter().map(|part| Primitive::new(&part.shapes)).collect();
    let mut scene = Sketches::start(sketches);
    let last = primitives.iter().position(|one| scene.add(one).is_some())?;
    let is_forbidden = |others: &[&Primitive]| {
        let mut scene = Sketches::start(sketches);
        others.iter().any(|one| scene.add(one).is_some())
    };
    let last_one = &primitives[last];
    let before = if is_forbidden(&[last_one]) {
        None
    } else {
        primitives[..last].iter().position(|one| is_forbidden(&[one, last_one]))
    };
    Some((&parts[last], before.map(|at| &parts[at])))
}
