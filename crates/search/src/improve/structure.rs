//! The structure of runs: which finite choices and calls tell one kind from another, and the kind of a run.
//!
//! A finite choice tells kinds apart if another value of it changes at least a tenth of the scene's cells; a call, if its parts
//! fill at least a tenth of them. Both are measured on a few runs, for *places*: addresses without the numbers of
//! iterations and without the arguments of memoised calls. What repeats counts by number.

use super::look::{Cells, cells, cells_of};
use niwaki_geom::Grid;
use niwaki_math::Stream;
use niwaki_run::replay::{Choice, Missing, Part, Source, Trace, replay};
use niwaki_run::{Failure, Task};
use niwaki_vm::value::{Value, repr};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The share of the cells that a choice or a call must carry.
const CARRIED: f64 = 0.1;
/// Most runs on which the shares are measured, most places that are measured, and most tries to turn a choice.
const MEASURED: usize = 6;
const PLACES: usize = 400;
const TRIES: u64 = 4;
/// Numbers up to this one are told apart; larger ones if they differ by more than one in it.
const COUNTED: usize = 10;

/// A kind: what it has at each place, as text; places are in the order of their names.
pub(super) type Kind = BTreeMap<String, String>;

/// The places that tell kinds apart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Structure {
    /// Places of finite choices.
    choices: BTreeSet<String>,
    /// Places of calls and iterations.
    calls: BTreeSet<String>,
}

/// Whether a choice has one of finitely or countably many values.
pub(super) fn is_finite(choice: &Choice) -> bool {
    matches!(choice.value, Value::Bool(_) | Value::Int(_))
}

/// The place of an address.
pub(super) fn place(path: &str) -> String {
    let (mut out, mut depth, mut index) = (String::with_capacity(path.len()), 0_usize, false);
    for letter in path.chars() {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        match letter {
            '(' if depth == 1 => out.push('('),
            _ if depth > 0 => {}
            '[' => {
                index = true;
                out.push(letter);
            }
            ']' => {
                index = false;
                out.push(letter);
            }
            _ if index => {}
            _ => out.push(letter),
        }
    }
    out
}

/// A place in which a function that calls itself is named once, so that all levels of a recursion are counted together.
fn folded(place: &str) -> String {
    let components: Vec<&str> = place.split('/').collect();
    let last = components.len() - 1;
    let is_first = |at: usize| !components[..at].contains(&components[at]);
    let is_kept = |at: usize| at == last || is_first(at) && components[at] != components[last];
    let kept = (0..components.len()).filter(|at| is_kept(*at)).map(|at| components[at]);
    kept.collect::<Vec<_>>().join("/")
}

/// A replay without scores, of known choices; missing ones are drawn.
///
/// # Errors
/// A fault of the program.
pub(super) fn traced(bare: &Task, known: HashMap<u128, Value>, seed: u64) -> Result<Trace, Failure> {
    replay(bare, Source::Addresses(known), Missing::Draw { seed, stream: 0 })
}

/// The choices of a trace by address.
pub(super) fn known(trace: &Trace) -> HashMap<u128, Value> {
    trace.choices.iter().map(|choice| (choice.address, choice.value.clone())).collect()
}

/// The value of a choice, as text; a word where its number has one.
pub(super) fn text(choice: &Choice) -> String {
    let named = choice.named_value();
    match &named {
        Value::Str(word) => word.to_string(),
        other => repr(other).unwrap_or_default(),
    }
}

/// A number as text, coarsely.
fn number(count: usize) -> String {
    if count <= COUNTED {
        return count.to_string();
    }
    let mut low = COUNTED + 1;
    loop {
        let high = low + low / COUNTED - 1;
        if count <= high {
            return if low == high { low.to_string() } else { format!("{low} to {high}") };
        }
        low = high + 1;
    }
}

/// The calls and iterations around an address, from the outermost.
fn calls_around(path: &str) -> impl Iterator<Item = &str> {
    path.match_indices('/').map(|(at, _)| &path[..at])
}

impl Structure {
    /// The places of all finite choices, for programs without scenes.
    pub fn of_choices<'a>(traces: impl Iterator<Item = &'a Trace>) -> Structure {
        let finite = traces.flat_map(|trace| trace.choices.iter().filter(|choice| is_finite(choice)));
        Structure { choices: finite.map(|choice| place(&choice.path)).collect(), calls: BTreeSet::new() }
    }

    /// Measures places on a few of these runs, best first. Also returns the work.
    ///
    /// # Errors
    /// A fault of the program that makes no run invalid.
    pub fn measured(
        bare: &Task,
        traces: &[&Trace],
        grid: &Grid,
        rng: &mut Stream,
    ) -> Result<(Structure, u64), Failure> {
        let step = traces.len().div_ceil(MEASURED).max(1);
        let (mut shares, mut by_call): (BTreeMap<String, Mean>, BTreeMap<String, Mean>) = Default::default();
        let mut work = 0;
        for trace in traces.iter().step_by(step) {
            let whole = cells_of(&trace.parts, grid);
            for (place, share) in call_shares(&trace.parts, &whole, grid) {
                by_call.entry(place).or_default().add(share);
            }
            let mut at_place: BTreeMap<String, Vec<&Choice>> = BTreeMap::new();
            for choice in trace.choices.iter().filter(|choice| is_finite(choice)) {
                at_place.entry(place(&choice.path)).or_default().push(choice);
            }
            for (place, choices) in at_place.into_iter().take(PLACES) {
                let choice = choices[below(rng, choices.len())];
                let (turned, replays) = turned(bare, &known(trace), choice, rng)?;
                work += replays * steps(trace);
                let Some(turned) = turned else { continue };
                let other = cells_of(&turned.parts, grid);
                shares.entry(place).or_default().add(1.0 - whole.in_common(&other));
            }
        }
        let carrying = |shares: BTreeMap<String, Mean>| {
            shares.into_iter().filter(|(_, mean)| mean.value() >= CARRIED).map(|(place, _)| place).collect()
        };
        Ok((Structure { choices: carrying(shares), calls: carrying(by_call) }, work))
    }

    /// Whether a choice tells kinds apart.
    pub fn has(&self, choice: &Choice) -> bool {
        is_finite(choice) && self.choices.contains(&place(&choice.path))
    }

    /// The kind of a run.
    pub fn kind(&self, trace: &Trace) -> Kind {
        let mut kind = Kind::new();
        let mut values: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for choice in trace.choices.iter().filter(|choice| self.has(choice)) {
            values.entry(folded(&place(&choice.path))).or_default().push(text(choice));
        }
        for (place, mut all) in values {
            all.sort();
            let texts: Vec<String> = all
                .chunk_by(|a, b| a == b)
                .map(|group| match group.len() {
                    1 => group[0].clone(),
                    count => format!("{} x {}", number(count), group[0]),
                })
                .collect();
            kind.insert(place, texts.join(", "));
        }
        if !self.calls.is_empty() {
            let paths = trace.choices.iter().map(|c| &c.path).chain(trace.parts.iter().map(|p| &p.path));
            let calls: HashSet<&str> = paths.flat_map(|path| calls_around(path)).collect();
            let mut counts: BTreeMap<String, usize> = BTreeMap::new();
            for call in calls {
                let place = place(call);
                if self.calls.contains(&place) {
                    *counts.entry(folded(&place)).or_default() += 1;
                }
            }
            // The brackets keep calls apart from choices of the same name.
            kind.extend(counts.into_iter().map(|(place, count)| (format!("{place}/"), number(count))));
        }
        kind
    }
}

/// A mean of numbers.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: u32,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    fn value(self) -> f64 {
        self.sum / f64::from(self.count.max(1))
    }
}

/// The work of a replay, in steps of particles.
pub(super) fn steps(trace: &Trace) -> u64 {
    trace.parts.len() as u64 + 1
}

/// A whole number from 0 on below `count`.
pub(super) fn below(rng: &mut Stream, count: usize) -> usize {
    ((rng.uniform() * count as f64) as usize).min(count.saturating_sub(1))
}

/// The run with these values in which a choice has another value, and what it brings is drawn from the prior. `None` if no draw gave another value,
/// or where the run is invalid. Also returns the number of replays.
///
/// # Errors
/// A fault of the program that makes no run invalid.
pub(super) fn turned(
    bare: &Task,
    known: &HashMap<u128, Value>,
    choice: &Choice,
    rng: &mut Stream,
) -> Result<(Option<Trace>, u64), Failure> {
    let mut rest = known.clone();
    rest.remove(&choice.address);
    let old = text(choice);
    for number in 1..=TRIES {
        let seed = niwaki_math::RngCore::next_u64(rng);
        match traced(bare, rest.clone(), seed) {
            Ok(other) => {
                let new = other.choices.iter().find(|other| other.address == choice.address);
                if new.is_some_and(|new| text(new) != old) {
                    return Ok((Some(other), number));
                }
            }
            Err(failure) if failure.is_impossible() => {}
            Err(failure) => return Err(failure),
        }
    }
    Ok((None, TRIES))
}

/// The mean share of the scene's cells below a call or an iteration, by place.
fn call_shares(parts: &[Part], whole: &Cells, grid: &Grid) -> BTreeMap<String, f64> {
    let mut filled: BTreeMap<&str, Cells> = BTreeMap::new();
    for part in parts {
        let cells_here = cells(&part.shapes, grid);
        for call in calls_around(&part.path) {
            filled.entry(call).or_default().add(&cells_here);
        }
    }
    let mut shares: BTreeMap<String, Mean> = BTreeMap::new();
    for (call, below) in filled {
        let share = f64::from(below.count()) / f64::from(whole.count().max(1));
        shares.entry(place(call)).or_default().add(share);
    }
    shares.into_iter().map(|(place, mean)| (place, mean.value())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_no_numbers_and_no_arguments() {
        assert_eq!(place("i[12]/storey/kind#2"), "i[]/storey/kind#2");
        assert_eq!(place("legs(3, (1, 2))/kind"), "legs()/kind");
        assert_eq!(place("while[0]#1/x"), "while[]#1/x");
        assert_eq!(calls_around("a/b[1]/c").collect::<Vec<_>>(), ["a", "a/b[1]"]);
    }

    #[test]
    fn levels_of_a_recursion_are_one_place() {
        assert_eq!(folded("branch/branch/side/branch/kind"), "branch/side/kind");
        assert_eq!(folded("branch/branch/branch"), "branch");
        assert_eq!(folded("house/roof/kind"), "house/roof/kind");
    }

    #[test]
    fn small_numbers_are_exact_and_large_ones_are_not() {
        let texts: Vec<String> = [1, 9, 10, 19, 20, 21, 22, 100].into_iter().map(number).collect();
        assert_eq!(texts[..4], ["1", "9", "10", "19"]);
        assert_eq!(texts[4], "20 to 21");
        assert_eq!(texts[4], texts[5]);
        assert_ne!(texts[5], texts[6]);
        // Every number lies within its own range.
        for count in 11..500 {
            let text = number(count);
            let ends: Vec<usize> = text.split(" to ").filter_map(|end| end.parse().ok()).collect();
            assert!(ends[0] <= count && count <= ends[ends.len() - 1], "{count}: {text}");
        }
    }
}
