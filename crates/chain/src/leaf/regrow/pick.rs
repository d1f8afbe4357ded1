//! The pick of a part for regrowth, and its probability in another run.
//!
//! By size: a part that matters may be a single choice among hundreds, and most of the others may be small and far down.
//! So the size is drawn first, evenly over its logarithm. Then the pick descends from the whole run to parts below, by the
//! square roots of their sizes, until a part is at most as large as the drawn size. A part that could not have been reached, because it is
//! empty or always larger, has probability zero.
//!
//! ```text
//! q(part) = P(size of the part <= T < size of the part above) * product over the levels of sqrt(size) / sum of sqrt(sizes)
//! ```
//!
//! All factors depend only on the size of the part and on parts outside of it, so the probability in a particle's run follows from
//! its number of choices.

use super::sweep::Seen;
use niwaki_math::Stream;
use niwaki_run::glob::{matches, nearest};
use niwaki_run::weights::index;
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::kept::Trace;
use niwaki_vm::machine::kept::part::{Part, Piece};
use serde::Deserialize;

/// Larger parts, as a share of all choices, are rare: they cost most, and rarely grow better as a whole.
const LARGE: f64 = 0.4;
/// The probability that a part may be larger.
const RARE: f64 = 0.05;
/// The probability of the whole run.
const WHOLE: f64 = 0.01;

/// A rule that picks a part.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub enum Pick {
    /// By size: uniform over the logarithm of the size.
    #[default]
    Size,
    /// By choice: the activation of a uniformly drawn choice.
    Choice,
    /// By name: uniform among the outermost activations whose addresses match one of these patterns.
    Parts(Vec<String>),
    /// By path: uniform among the activations whose paths have these hashes.
    #[serde(skip)]
    Paths(Vec<u128>),
}

/// A part and its choices that may change.
struct Sized {
    part: Part,
    size: u64,
    /// The parts directly below it.
    below: std::ops::Range<usize>,
}

/// A level of the descent to a part: the part there, and those beside it.
struct Level {
    size: u64,
    /// The sum of the square roots of the sizes of the neighbouring parts.
    beside: f64,
}

/// A picked part.
pub(super) struct Picked {
    pub part: Part,
    /// The choices of the part that may change.
    size: u64,
    how: How,
}

enum How {
    /// A probability that is the same in any run.
    Even,
    /// By choice, out of this number of choices.
    Choice(u64),
    /// By descent: the whole run, and then each level.
    Size(Vec<Level>),
}

/// Probability that the size drawn for a run with so many choices is below `size`.
fn below(size: u64, all: u64) -> f64 {
    let (size, all) = ((size as f64).ln(), (all as f64).ln());
    let up_to = |largest: f64| if largest > 0.0 { (size / largest).min(1.0) } else { 1.0 };
    (1.0 - RARE) * up_to(all + LARGE.ln()) + (RARE - WHOLE) * up_to(all)
}

impl Pick {
    /// Pick a part; `None` if no part can be picked.
    pub(super) fn draw(
        &self,
        trace: &Trace,
        program: &Program,
        is_selected: &dyn Fn(usize) -> bool,
        rng: &mut Stream,
    ) -> Option<Picked> {
        let even = |n: usize, rng: &mut Stream| ((rng.uniform() * n as f64) as usize).min(n - 1);
        let parts = sizes(trace, program, is_selected);
        let all = parts[0].size;
        if all == 0 {
            return None;
        }
        match self {
            Pick::Choice => {
                let mut choices = Vec::new();
                trace.numbers().filter(|n| is_selected(*n)).for_each(|n| choices.push(n));
                let part = trace.part_of(choices[even(choices.len(), rng)]);
                let size = parts.iter().find(|sized| sized.part == part).map_or(0, |sized| sized.size);
                Some(Picked { part, size, how: How::Choice(all) })
            }
            Pick::Parts(patterns) => {
                let matching = named(&parts, trace, program, patterns);
                if matching.is_empty() {
                    return None;
                }
                let sized = &parts[matching[even(matching.len(), rng)]];
                Some(Picked { part: sized.part, size: sized.size, how: How::Even })
            }
            Pick::Paths(paths) => {
                let is_there = |sized: &&Sized| {
                    sized.size > 0 && !sized.part.is_onward() && paths.contains(&trace.part_path(sized.part))
                };
                let there: Vec<&Sized> = parts.iter().filter(is_there).collect();
                if there.is_empty() {
                    return None;
                }
                let sized = there[even(there.len(), rng)];
                Some(Picked { part: sized.part, size: sized.size, how: How::Even })
            }
            Pick::Size => {
                let u = rng.uniform();
                let (mut at, mut levels) = (0, vec![Level { size: all, beside: 0.0 }]);
                loop {
                    let Sized { part, size, below: inner } = &parts[at];
                    let roots: Vec<f64> =
                        parts[inner.clone()].iter().map(|part| (part.size as f64).sqrt()).collect();
                    let sum: f64 = roots.iter().sum();
                    if u >= below(*size, all) || sum == 0.0 {
                        return Some(Picked { part: *part, size: *size, how: How::Size(levels) });
                    }
                    let number = index(&roots, rng.uniform());
                    at = inner.start + number;
                    levels.push(Level { size: parts[at].size, beside: sum - roots[number] });
                }
            }
        }
    }
}

impl Picked {
    /// The log probability of the same pick in a run with a different part.
    pub(super) fn log_probability(&self, seen: &Seen) -> f64 {
        if seen.selected == 0 {
            return f64::NEG_INFINITY;
        }
        match &self.how {
            How::Even => 0.0,
            How::Choice(all) => (seen.direct as f64 / (all - self.size + seen.selected) as f64).ln(),
            How::Size(levels) => {
                let now = |size: u64| size - self.size + seen.selected;
                let all = now(levels[0].size);
                let is_leaf = !self.part.is_onward() && seen.selected == seen.direct;
                let above = levels.len().checked_sub(2).map_or(1.0, |at| below(now(levels[at].size), all));
                let mut log = (above - if is_leaf { 0.0 } else { below(seen.selected, all) }).ln();
                for level in &levels[1..] {
                    let root = (now(level.size) as f64).sqrt();
                    log += (root / (level.beside + root)).ln();
                }
                log
            }
        }
    }
}

/// The outermost parts with a choice whose names match one of the patterns.
fn named(parts: &[Sized], trace: &Trace, program: &Program, patterns: &[String]) -> Vec<usize> {
    let mut matching = Vec::new();
    let mut work = vec![0];
    while let Some(at) = work.pop() {
        let sized = &parts[at];
        let name = trace.part_name(program, sized.part);
        // The iterations from one on have the name of the first, which is below them.
        let is_named = !sized.part.is_onward() && patterns.iter().any(|p| matches(p, &name));
        if is_named && sized.size > 0 { matching.push(at) } else { work.extend(sized.below.clone()) }
    }
    matching
}

/// The only part whose name matches a pattern. A whole name is no pattern: other parts may end like it.
///
/// # Errors
/// No part, with the nearest names; or several parts, with their names.
pub(super) fn only(pattern: &str, trace: &Trace, program: &Program) -> Result<Picked, Fault> {
    let parts = sizes(trace, program, &|_| true);
    let name = |at: usize| trace.part_name(program, parts[at].part);
    let quoted = |names: &[String]| names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
    let mut matching = named(&parts, trace, program, &[pattern.into()]);
    if let Some(whole) = matching.iter().copied().find(|at| name(*at) == pattern) {
        matching = vec![whole];
    }
    match matching[..] {
        [at] => Ok(Picked { part: parts[at].part, size: parts[at].size, how: How::Even }),
        [] => {
            let with_choices = |at: &usize| parts[*at].size > 0 && !parts[*at].part.is_onward();
            let mut all: Vec<String> = (1..parts.len()).filter(with_choices).map(name).collect();
            all.sort();
            all.dedup();
            let near = quoted(&nearest(pattern, &all));
            let near = if near.is_empty() { "this run has no part with choices".into() } else { near };
            Err(Fault::new("no-part", format!("`{pattern}` matches no part")).about(pattern).with_help(near))
        }
        ref several => {
            let mut names: Vec<String> = several.iter().map(|at| name(*at)).collect();
            names.sort();
            Err(Fault::new("many-parts", format!("`{pattern}` matches {} parts", names.len()))
                .about(pattern)
                .with_help(quoted(&names)))
        }
    }
}

/// The parts of a trace with their sizes, each before those below it; those directly below one are neighbours.
fn sizes(trace: &Trace, program: &Program, is_selected: &dyn Fn(usize) -> bool) -> Vec<Sized> {
    let mut parts = vec![Sized { part: Part::WHOLE, size: 0, below: 0..0 }];
    let mut at = 0;
    while at < parts.len() {
        let (mut choices, first) = (0, parts.len());
        trace.pieces(program, parts[at].part, |piece| match piece {
            Piece::Choice(n) => choices += u64::from(is_selected(n)),
            Piece::Part(part) => parts.push(Sized { part, size: 0, below: 0..0 }),
            Piece::Emit(_) | Piece::Held(_) => {}
        });
        parts[at].size = choices;
        parts[at].below = first..parts.len();
        at += 1;
    }
    for at in (0..parts.len()).rev() {
        let inner: u64 = parts[parts[at].below.clone()].iter().map(|sized| sized.size).sum();
        parts[at].size += inner;
    }
    parts
}
