//! The parts of scenes that break a constraint, for reports of runs that became impossible.

use crate::Task;
use crate::failure::{Blame, Dead, Emitted, Failure};
use crate::replay::{Missing, Part, Source, by_address, replay};
use niwaki_geom::Primitive;
use niwaki_geom::sketch::SketchSpec;
use niwaki_geom::sketch::product::Sketches;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The most runs that are examined.
pub const RUNS: usize = 300;

/// The place in the source where a part is emitted.
fn emitted(part: &Part) -> Emitted {
    let (call, s) = (&part.place, part.place.span);
    let span = [s.line, s.column, s.end_line, s.end_column];
    Emitted { path: part.path.clone(), function: call.function.to_string(), file: call.file, span }
}

/// Add the parts that break a constraint to a failure. Call it only for failures that a user reads: a search that continues
/// after its population has died does not need them.
pub fn explained(mut failure: Failure, task: &Task) -> Failure {
    if let Failure::Impossible { dead, blame: parts, .. } = &mut failure {
        *parts = blame(task, &std::mem::take(dead));
    }
    failure
}

/// The parts of impossible runs that break a constraint, most frequent first, and the number of runs. Runs that are impossible
/// for another reason have no such part.
pub(crate) fn blame(task: &Task, runs: &[Dead]) -> (Vec<Blame>, usize) {
    let mut counts: BTreeMap<_, Blame> = BTreeMap::new();
    let all: Vec<Option<Blame>> = runs.par_iter().map(|run| blame_in(task, run)).collect();
    for blame in all.into_iter().flatten() {
        // The order of a pair does not matter.
        let mut places = [Some(blame.part.place()), blame.other.as_ref().map(Emitted::place)];
        places.sort();
        counts.entry((blame.constraint.clone(), places)).or_insert(blame).runs += 1;
    }
    let mut blames: Vec<Blame> = counts.into_values().collect();
    blames.sort_by_key(|blame| std::cmp::Reverse(blame.runs));
    (blames, runs.len())
}

/// The blame of a run, with a count of zero.
fn blame_in(task: &Task, Dead { cause, entries }: &Dead) -> Option<Blame> {
    // Only the sketch of the constraint is computed.
    let sketches: Vec<_> = task.sketches.iter().filter(|sketch| sketch.name() == cause).cloned().collect();
    if sketches.is_empty() {
        return None;
    }
    let constrained = Task { sketches, ..task.uncounted() };
    let trace = replay(&constrained, Source::Addresses(by_address(entries)), Missing::Stop).ok()?;
    let (part, other) = first_forbidden(&constrained.sketches, &trace.parts)?;
    let (part, other) = (emitted(part), other.map(emitted));
    Some(Blame { constraint: cause.clone(), part, other, runs: 0 })
}

/// The first part, in program order, that makes the scene forbidden. Where that part alone is allowed, also an earlier part
/// that is forbidden together with it.
fn first_forbidden<'a>(
    sketches: &[Arc<dyn SketchSpec>],
    parts: &'a [Part],
) -> Option<(&'a Part, Option<&'a Part>)> {
    let primitives: Vec<Primitive> = parts.iter().map(|part| Primitive::new(&part.shapes)).collect();
    let mut scene = Sketches::start(sketches);
    let last = primitives.iter().position(|primitive| scene.add(primitive).is_some())?;
    let is_forbidden = |parts: &[&Primitive]| {
        let mut scene = Sketches::start(sketches);
        parts.iter().any(|primitive| scene.add(primitive).is_some())
    };
    let culprit = &primitives[last];
    let before = if is_forbidden(&[culprit]) {
        None
    } else {
        primitives[..last].iter().position(|earlier| is_forbidden(&[earlier, culprit]))
    };
    Some((&parts[last], before.map(|at| &parts[at])))
}
