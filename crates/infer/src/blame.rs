//! Which parts of scenes break a constraint: for messages about searches in which every run is impossible.

use crate::Task;
use crate::log::Entry;
use crate::replay::{Missing, Part, Source, by_address, replay};
use niwaki_geom::Primitive;
use niwaki_geom::sketch::product::Sketches;
use niwaki_vm::machine::stack::Call;
use std::collections::BTreeMap;

/// Most runs that are looked at.
pub(crate) const RUNS: usize = 50;

/// Where parts that break a constraint are emitted, and in how many runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Blame {
    /// The name of the constraint.
    pub constraint: &'static str,
    /// Where the part is emitted that breaks it.
    pub part: Call,
    /// The part that it breaks it with, where one alone does not.
    pub other: Option<Call>,
    /// In how many of the runs.
    pub runs: usize,
}

/// The parts of impossible runs that break a constraint, most frequent first, and how many runs were looked at. Runs that something
/// else made impossible have none.
pub(crate) fn blame(task: &Task, runs: Vec<Vec<Entry>>) -> (Vec<Blame>, usize) {
    let mut counts: BTreeMap<_, Blame> = BTreeMap::new();
    let seen = runs.len();
    for entries in runs {
        let Ok(trace) = replay(task, Source::Addresses(by_address(&entries)), Missing::Stop) else {
            continue;
        };
        let Some((constraint, part, other)) = first_forbidden(task, &trace.parts) else { continue };
        let place = |call: &Call| (call.file, call.span.line, call.span.column);
        let mut calls = [Some(part), other];
        // A pair is the same pair in either order.
        if other.is_some() {
            calls.sort_by_key(|call| call.map(place));
        }
        let key = (constraint, calls.map(|call| call.map(place)));
        let [part, other] = calls.map(|call| call.cloned());
        let Some(part) = part else { continue };
        counts.entry(key).or_insert(Blame { constraint, part, other, runs: 0 }).runs += 1;
    }
    let mut found: Vec<Blame> = counts.into_values().collect();
    found.sort_by_key(|one| std::cmp::Reverse(one.runs));
    (found, seen)
}

/// The first part, in the order of the program, with which the scene is forbidden; and where that part alone is not, a part
/// before it with which it is.
fn first_forbidden<'a>(task: &Task, parts: &'a [Part]) -> Option<(&'static str, &'a Call, Option<&'a Call>)> {
    let primitives: Vec<Primitive> = parts.iter().map(|part| Primitive::new(&part.shapes)).collect();
    let mut scene = Sketches::start(&task.sketches);
    let (last, constraint) =
        primitives.iter().enumerate().find_map(|(at, one)| scene.add(one).map(|name| (at, name)))?;
    let is_forbidden = |others: &[&Primitive]| {
        let mut scene = Sketches::start(&task.sketches);
        others.iter().any(|one| scene.add(one).is_some())
    };
    let last_one = &primitives[last];
    let before = if is_forbidden(&[last_one]) {
        None
    } else {
        primitives[..last].iter().position(|one| is_forbidden(&[one, last_one]))
    };
    Some((constraint, &parts[last].place, before.map(|at| &parts[at].place)))
}
