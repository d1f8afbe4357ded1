//! Edits of a run: a discrete choice has another value, a loop has an iteration more or less, a recursion a level more or less. All
//! else keeps its values, by address or moved with the level that it belongs to; what is new is drawn.

use super::structure::below;
use niwaki_chain::leaf::linkage::CHOICES;
use niwaki_chain::walk::state::State;
use niwaki_math::{RngCore, Stream, StreamKey};
use niwaki_run::fresh::Fresh;
use niwaki_run::weights::index;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::kept::levels::{Iterations, Moved, Recursion, Within};
use niwaki_vm::machine::kept::part::{Part, Piece};
use niwaki_vm::machine::kept::{Change, Trace};
use niwaki_vm::value::{Value, identical};
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, HashSet};

/// The probability that new iterations of a loop are drawn.
const DRAWN: f64 = 0.4;
/// The probability that iterations that are drawn are at the end of the loop, and not at any place.
const AT_END: f64 = 0.6;
/// The probability that a new level of a recursion also has the values of the other calls of the level beside it.
const COPIED: f64 = 0.5;
/// The probability that a whole number moves by one, and is not drawn from its prior.
const BY_ONE: f64 = 0.75;

/// The values of a run by address.
pub(super) type Values = HashMap<u128, Value>;

/// The form of an edit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// A whole number is turned.
    Count,
    /// A whole number is turned, and a real that belongs to no iteration of the loops that are longer or shorter now is drawn.
    Stretch,
    /// A truth value is turned.
    Turn,
    /// A truth value is turned, and a real of the level that it belongs to slides. So what the truth value brings begins at another place,
    /// and what comes after stays.
    Slide,
    /// The iterations of a loop move by one.
    Shift,
    /// A recursion has a level more or less.
    Level,
}

impl Form {
    const ALL: [Form; 6] = [Form::Count, Form::Stretch, Form::Turn, Form::Slide, Form::Shift, Form::Level];
}

/// How many edits of each form were made, and how many of these were kept.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Tries([(u64, u64); Form::ALL.len()]);

impl Tries {
    /// Notes an edit.
    pub fn note(&mut self, form: Form, is_kept: bool) {
        let (all, kept) = &mut self.0[form as usize];
        *all += 1;
        *kept += u64::from(is_kept);
    }

    /// The share of a form's edits that is expected to be kept.
    fn share(&self, form: Form) -> f64 {
        let (all, kept) = self.0[form as usize];
        (kept + 1) as f64 / (all + 2) as f64
    }
}

/// The values of iterations that a loop has more.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fill {
    /// They are drawn.
    Drawn,
    /// They are those of the iteration beside them.
    Copied,
    /// They share the reals of the iteration beside them with it: what it had they have together. Likewise an iteration that is removed
    /// gives its reals to the one beside it. So what comes after stays where a model adds up its iterations.
    Shared,
}

/// An edit of a run.
pub(super) struct Edit {
    /// The values of the edited run, as far as they are known, in one or more ways, which differ in the places of iterations.
    pub ways: Vec<Values>,
    pub form: Form,
    /// The number of runs that were made to find the values.
    pub runs: u64,
    /// A choice that slides: it moves, and others with it so that most parts stay.
    pub slide: Option<usize>,
}

/// Draws an edit of a run, of a form whose edits were kept, in at most so many `ways`. `None` if the run has nothing to edit.
///
/// # Errors
/// A fault of the program that makes no run invalid.
pub(super) fn draw(
    task: &Task,
    state: &State,
    tries: &Tries,
    ways: usize,
    rng: &mut Stream,
) -> Result<Option<Edit>, Failure> {
    let (trace, program) = (&state.trace, &*task.program);
    let of = |is: fn(&Value) -> bool| -> Vec<usize> {
        trace.numbers().filter(|n| is(trace.choice(program, *n).0)).collect()
    };
    let counts = of(|value| matches!(value, Value::Int(_)));
    let truths = of(|value| matches!(value, Value::Bool(_)));
    let loops = trace.loops(program);
    let has_choices = |levels: &&Iterations| {
        levels.parts.len() > 1 && !trace.moved(program, levels.parts[0], 0, &Within::All).choices.is_empty()
    };
    let shiftable: Vec<&Iterations> = loops.iter().filter(has_choices).collect();
    let recursions = trace.recursions(program);
    let is_there = |form: &Form| match form {
        Form::Count | Form::Stretch => !counts.is_empty(),
        Form::Turn => !truths.is_empty(),
        Form::Slide => {
            let is_level = !recursions.is_empty() || !loops.is_empty();
            !truths.is_empty() && is_level && state.reals(program) <= CHOICES
        }
        Form::Shift => !shiftable.is_empty(),
        Form::Level => !recursions.is_empty(),
    };
    let forms: Vec<Form> = Form::ALL.into_iter().filter(is_there).collect();
    if forms.is_empty() {
        return Ok(None);
    }
    let shares: Vec<f64> = forms.iter().map(|form| tries.share(*form)).collect();
    let form = forms[index(&shares, rng.uniform())];
    let edit = |ways, runs| Ok(Some(Edit { ways, form, runs, slide: None }));
    let mut values: Values = state.choices(program).collect();
    match form {
        Form::Slide => {
            let choice = truths[below(rng, truths.len())];
            turn(&mut values, trace.address(program, choice), rng);
            let level = level_of(task, trace, &loops, &recursions, choice);
            let slide = level.and_then(|level| real_of(task, trace, level, rng));
            Ok(Some(Edit { ways: vec![values], form, runs: 0, slide }))
        }
        Form::Count | Form::Stretch | Form::Turn => {
            let discrete = if form == Form::Turn { truths } else { counts };
            let choice = discrete[below(rng, discrete.len())];
            let address = trace.address(program, choice);
            turn(&mut values, address, rng);
            // Loops that are longer or shorter in the turned run, where a value that is drawn stays.
            let Some(turned) = bare_run(task, &values, rng)? else { return edit(vec![values], 1) };
            let place = turned.numbers().find(|n| turned.address(program, *n) == address);
            values.extend(place.map(|n| (address, turned.choice(program, n).0.clone())));
            let lengths: HashMap<u128, usize> =
                turned.loops(program).iter().map(|levels| (levels.path(), levels.parts.len())).collect();
            let changed: Vec<(&Iterations, usize)> = loops
                .iter()
                .filter_map(|levels| {
                    let now = *lengths.get(&levels.path())?;
                    (now != levels.parts.len()).then_some((levels, now))
                })
                .collect();
            if form == Form::Stretch {
                let outside = reals_outside(task, trace, changed.iter().map(|(levels, _)| *levels));
                if !outside.is_empty() {
                    values.remove(&outside[below(rng, outside.len())]);
                }
                return edit(vec![values], 1);
            }
            let by = |(levels, now): &(&Iterations, usize)| *now as isize - levels.parts.len() as isize;
            let shifts: Vec<Shift> =
                changed.iter().map(|pair| Shift { levels: pair.0, by: by(pair) }).collect();
            edit(shifted(&values, task, trace, &shifts, ways, rng), 1)
        }
        Form::Shift => {
            let levels = shiftable[below(rng, shiftable.len())];
            let shift = Shift { levels, by: if rng.uniform() < 0.5 { 1 } else { -1 } };
            edit(shifted(&values, task, trace, &[shift], ways, rng), 0)
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
                let Some(place) = twice.below else { return edit(vec![values], 0) };
                let mut down = moved(below, place, &Within::All);
                take(&mut values, task, trace, &moved(below, from, &Within::All));
                put(&mut values, task, trace, &mut twice);
                put(&mut values, task, trace, &mut down);
            }
            edit(vec![values], 0)
        }
    }
}

/// The innermost level that a choice belongs to: an iteration of a loop, or a level of a recursion without those below it.
fn level_of(
    task: &Task,
    trace: &Trace,
    loops: &[Iterations],
    recursions: &[Recursion],
    choice: usize,
) -> Option<Part> {
    let iterations = loops.iter().flat_map(|levels| &levels.parts).map(|part| (*part, Within::All));
    let calls = recursions.iter().map(|pair| (pair.above, Within::Without(pair.below)));
    let size = |(part, within): &(Part, Within)| {
        let choices = trace.moved(&task.program, *part, 0, within).choices;
        choices.iter().any(|(_, n)| *n == choice).then_some(choices.len())
    };
    let sizes = iterations.chain(calls).filter_map(|level| Some((size(&level)?, level.0)));
    sizes.min_by_key(|(size, _)| *size).map(|(_, part)| part)
}

/// A real choice of the first activation of a part, drawn evenly.
fn real_of(task: &Task, trace: &Trace, part: Part, rng: &mut Stream) -> Option<usize> {
    let mut reals = vec![];
    trace.pieces(&task.program, part, |piece| {
        if let Piece::Choice(n) = piece
            && matches!(trace.choice(&task.program, n).0, Value::Real(_))
        {
            reals.push(n);
        }
    });
    (!reals.is_empty()).then(|| reals[below(rng, reals.len())])
}

/// The addresses of the real choices that are in no iteration of these loops.
fn reals_outside<'a>(task: &Task, trace: &Trace, loops: impl Iterator<Item = &'a Iterations>) -> Vec<u128> {
    let program = &*task.program;
    let parts =
        loops.flat_map(|levels| (0..).zip(&levels.parts).map(move |(number, part)| (levels, number, part)));
    let inside: HashSet<usize> = parts
        .flat_map(|(levels, number, part)| {
            trace.moved(program, *part, levels.path_of(number), &Within::All).choices
        })
        .map(|(_, n)| n)
        .collect();
    let is_real = |n: &usize| matches!(trace.choice(program, *n).0, Value::Real(_));
    let outside = trace.numbers().filter(|n| is_real(n) && !inside.contains(n));
    outside.map(|n| trace.address(program, n)).collect()
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

/// Iterations that a loop has more, or less.
struct Shift<'a> {
    levels: &'a Iterations,
    by: isize,
}

/// The values of a run whose loops have iterations more or less, in at most so many `ways` that differ: each at a place of its own, the
/// same in all loops.
fn shifted(
    values: &Values,
    task: &Task,
    trace: &Trace,
    shifts: &[Shift<'_>],
    ways: usize,
    rng: &mut Stream,
) -> Vec<Values> {
    let is_drawn = rng.uniform() < DRAWN;
    let mut all: Vec<Values> = vec![];
    for _ in 0..ways.max(1) {
        let (fill, u) = match rng.uniform() {
            below if is_drawn && below < AT_END => (Fill::Drawn, 1.0),
            _ if is_drawn => (Fill::Drawn, rng.uniform()),
            below if below < 0.5 => (Fill::Copied, rng.uniform()),
            _ => (Fill::Shared, rng.uniform()),
        };
        let mut way = values.clone();
        for shift in shifts {
            let shares = shares(shift.by.max(0) as usize + 1, rng);
            shift.apply(&mut way, task, trace, u, fill, &shares);
        }
        if !all.iter().any(|other| is_same(other, &way)) {
            all.push(way);
        }
    }
    all
}

/// Whether two runs have the same values.
fn is_same(a: &Values, b: &Values) -> bool {
    let has = |(address, value)| b.get(address).is_some_and(|other| identical(value, other));
    a.len() == b.len() && a.iter().all(has)
}

/// Positive numbers that sum to 1, drawn evenly.
fn shares(count: usize, rng: &mut Stream) -> Vec<f64> {
    let mut ends: Vec<f64> = (1..count).map(|_| rng.uniform()).chain([1.0]).collect();
    ends.sort_by(f64::total_cmp);
    let begins = [0.0].into_iter().chain(ends.iter().copied());
    ends.iter().zip(begins).map(|(end, begin)| end - begin).collect()
}

impl Shift<'_> {
    /// Adds iterations to the loop at the place `u`, a share of its length, and moves those after it; or removes as many.
    /// New ones have, or share, the values of the one before them, or of the one after them at the begin.
    fn apply(&self, values: &mut Values, task: &Task, trace: &Trace, u: f64, fill: Fill, shares: &[f64]) {
        let (levels, by, program) = (self.levels, self.by, &*task.program);
        let (count, size) = (levels.parts.len(), by.unsigned_abs());
        let moved = |from: usize, to: usize| {
            trace.moved(program, levels.parts[from], levels.path_of(to), &Within::All)
        };
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
        // The iteration before the place, or else the one after it.
        let model = first.saturating_sub(1).min(count.saturating_sub(1));
        if by > 0 && count > 0 && fill != Fill::Drawn {
            (first..first + size).for_each(|number| after.push(moved(model, number)));
        }
        after.iter_mut().for_each(|moved| put(values, task, trace, moved));
        if fill != Fill::Shared || count == 0 {
            return;
        }
        let real = |n: usize| match trace.choice(program, n).0 {
            Value::Real(x) => Some(*x),
            _ => None,
        };
        if by > 0 {
            // At the begin, the iteration beside the new ones has moved behind them.
            let beside = if first == 0 { size } else { model };
            for (number, share) in [beside].into_iter().chain(first..first + size).zip(shares) {
                for (address, n) in moved(model, number).choices {
                    real(n).map(|x| values.insert(address, Value::Real(share * x)));
                }
            }
        } else {
            let heir = if first > 0 { Some(model) } else { (first + size < count).then_some(0) };
            for (heir, removed) in heir.into_iter().flat_map(|to| (first..first + size).map(move |n| (to, n)))
            {
                for (address, n) in moved(removed, heir).choices {
                    if let (Some(x), Some(Value::Real(had))) = (real(n), values.get_mut(&address)) {
                        *had += x;
                    }
                }
            }
        }
    }
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
fn bare_run(task: &Task, values: &Values, rng: &mut Stream) -> Result<Option<Trace>, Failure> {
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

/// The paths of the parts of an edited run that are new and have a scene of their own, by which particles can be told apart.
pub(super) fn new_parts(task: &Task, state: &State, values: &Values) -> Vec<u128> {
    let (trace, program) = (&state.trace, &*task.program);
    let known: HashSet<u128> = values.keys().copied().collect();
    let parts = trace.parts_without(program, &|address| known.contains(&address));
    let emits = |part: &Part| !trace.emits_of(program, *part).is_empty();
    parts.into_iter().filter(emits).map(|part| trace.part_path(part)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use niwaki_chain::walk::streams::Streams;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use std::sync::Arc;

    /// A loop whose number is drawn, twice.
    const COUNTED: &str = r#"(module (fn "m" (params)
        (set $n (sample (dist discrete_uniform 1 6)))
        (set $xs (list)) (for $i (range $n) (body (set $xs (append $xs (sample (dist uniform 0.0 1.0))))))
        (set $ys (list)) (for $i (range $n) (body (set $ys (append $ys (sample (dist uniform 0.0 1.0))))))
        (return (tuple $xs $ys))) (entry "m"))"#;
    /// A loop that a choice in an iteration ends, where iterations differ in their choices.
    const STOPPED: &str = r#"(module (fn "m" (params)
        (set $xs (list))
        (for $i (range 9) (body
            (if (sample (dist bernoulli 0.5))
                (then (set $x (sample (dist uniform 0.0 1.0)))) (else (set $x (sample (dist gaussian 5.0 1.0)))))
            (set $xs (add $xs (list $x)))
            (if (sample (dist bernoulli 0.25)) (then (break)) (else))))
        (return (tuple $xs (list)))) (entry "m"))"#;
    /// A recursion, with a future beside each level.
    const RECURSIVE: &str = r#"(module
        (fn "m" (params) (return (tuple (call "link" 0) (list))))
        (fn "link" (params $i)
            (set $x (sample (dist uniform 0.0 1.0)))
            (do (future "side" $x))
            (if (and (lt $i 9) (sample (dist bernoulli 0.7)))
                (then (return (add (list $x) (call "link" (add $i 1))))) (else))
            (return (list $x)))
        (fn "side" (params $x)
            (if (sample (dist bernoulli 0.5)) (then (do (sample (dist uniform 0.0 1.0)))) (else)))
        (entry "m"))"#;

    fn task(text: &str) -> Task {
        Task::new(Arc::new(compile(&parse(text).expect("core form"), vec![]).expect("a program")))
    }

    /// The two lists that a run returns.
    type Lists = [Vec<Value>; 2];

    fn lists(state: &State) -> Lists {
        let Value::Tuple(pair) = state.trace.result() else { panic!("a pair") };
        [0, 1].map(|at| match &pair.items()[at] {
            Value::List(list) => list.iter().cloned().collect(),
            _ => panic!("a list"),
        })
    }

    /// How a list became another: the number of elements at the begin that are the same, and at the end.
    fn ends(old: &[Value], new: &[Value]) -> (usize, usize) {
        let is_same = |(a, b): &(&Value, &Value)| niwaki_vm::value::identical(a, b);
        let first = old.iter().zip(new).take_while(is_same).count();
        let last = old.iter().rev().zip(new.iter().rev()).take_while(is_same).count();
        (first, last)
    }

    /// Edits of many runs that are possible: the lists before and after.
    fn edited(text: &str, count: u64) -> Vec<(Lists, Lists)> {
        let task = task(text);
        let mut all = vec![];
        for seed in 0..count {
            let (state, _) = State::start(&task, Streams::new(seed, 0), 1, None).expect("a run");
            let mut rng = Stream::new(seed, 1, 2, 3);
            let edit =
                draw(&task, &state, &Tries::default(), 3, &mut rng).expect("no fault").expect("an edit");
            match State::start(&task, Streams::new(seed, 1), 1, Some(&edit.ways[0])) {
                Ok((after, _)) => all.push((lists(&state), lists(&after))),
                Err(Failure::NoStart { .. }) => {}
                Err(_) => panic!("a fault"),
            }
        }
        all
    }

    #[test]
    fn a_turned_count_holds_what_stands_and_moves_what_is_behind() {
        let (mut inside, mut at_end) = (0, 0);
        for (old, new) in edited(COUNTED, 600) {
            if old[0].len() == new[0].len() || is_shared(&old, &new) {
                continue;
            }
            assert_eq!(new[0].len(), new[1].len());
            let [x, y] = [0, 1].map(|at| ends(&old[at], &new[at]));
            let kept = old[0].len().min(new[0].len());
            // Both loops have changed at one place.
            assert!((0..=kept).any(|at| at <= x.0.min(y.0) && kept - at <= x.1.min(y.1)), "{old:?} {new:?}");
            if x.0 == kept { at_end += 1 } else { inside += 1 }
        }
        assert!(inside > 40 && at_end > 40, "{inside} {at_end}");
    }

    /// Whether the sums of both lists stay.
    fn is_shared(old: &Lists, new: &Lists) -> bool {
        let sum = |list: &[Value]| {
            let reals = list.iter().map(|value| if let Value::Real(x) = value { *x } else { 0.0 });
            reals.sum::<f64>()
        };
        old.iter().zip(new).all(|(old, new)| (sum(old) - sum(new)).abs() < 1e-9)
    }

    #[test]
    fn iterations_share_what_one_had() {
        let (mut longer, mut shorter) = (0, 0);
        for (old, new) in edited(COUNTED, 1500).into_iter().filter(|(old, new)| is_shared(old, new)) {
            let (before, after) = (old[0].len(), new[0].len());
            let kept = |at: usize| ends(&old[at], &new[at]).0 + ends(&old[at], &new[at]).1;
            // All stay but the one that shares, before or after.
            assert!(before == after || kept(0).min(kept(1)) + 1 >= before.min(after), "{old:?} {new:?}");
            longer += usize::from(after > before);
            shorter += usize::from(after < before);
        }
        assert!(longer > 40 && shorter > 3, "{longer} {shorter}");
    }

    #[test]
    fn iterations_move_with_all_their_choices() {
        let (mut longer, mut shorter) = (0, 0);
        for (old, new) in edited(STOPPED, 600) {
            let (first, last) = ends(&old[0], &new[0]);
            let (before, after) = (old[0].len(), new[0].len());
            longer += usize::from(after == before + 1 && first + last >= before && first < before);
            shorter += usize::from(after + 1 == before && first + last >= after && first < after);
        }
        assert!(longer > 20 && shorter > 20, "{longer} {shorter}");
    }

    #[test]
    fn a_recursion_has_a_level_more_or_less() {
        let (mut longer, mut shorter) = (0, 0);
        for (old, new) in edited(RECURSIVE, 600) {
            let (first, last) = ends(&old[0], &new[0]);
            let (before, after) = (old[0].len(), new[0].len());
            longer += usize::from(after == before + 1 && first + last >= before && last > 0);
            shorter += usize::from(after + 1 == before && first + last >= after && last > 0);
        }
        assert!(longer > 40 && shorter > 40, "{longer} {shorter}");
    }

    #[test]
    fn a_slide_is_of_the_level_whose_truth_value_turns() {
        let task = task(RECURSIVE);
        let (mut slides, mut above) = (0, 0);
        for seed in 0..600 {
            let (state, _) = State::start(&task, Streams::new(seed, 0), 1, None).expect("a run");
            let mut rng = Stream::new(seed, 1, 2, 3);
            let tries = Tries::default();
            let edit = draw(&task, &state, &tries, 3, &mut rng).expect("no fault").expect("an edit");
            let (trace, program) = (&state.trace, &*task.program);
            let Some(slide) = edit.slide else { continue };
            let differs = |n: &usize| {
                let value = edit.ways[0].get(&trace.address(program, *n));
                value.is_some_and(|value| !identical(value, trace.choice(program, *n).0))
            };
            let turned: Vec<String> =
                trace.numbers().filter(differs).map(|n| trace.path(program, n)).collect();
            let [turned] = &turned[..] else { panic!("{turned:?}") };
            let levels = |path: &str| path.split('/').filter(|word| *word == "link").count();
            let real = trace.path(program, slide);
            assert!(real.ends_with("/x") && !real.contains("side"), "{real}");
            assert_eq!(levels(&real), levels(turned), "{real} {turned}");
            slides += 1;
            above += usize::from(turned.contains("side"));
        }
        assert!(slides > 30 && above > 10, "{slides} {above}");
    }

    #[test]
    fn parts_are_new_where_no_choice_is_known() {
        let task = task(COUNTED);
        let (state, _) = State::start(&task, Streams::new(3, 0), 1, None).expect("a run");
        let all: Values = state.choices(&task.program).collect();
        let new = |known: &Values| -> Vec<u128> {
            let parts = state.trace.parts_without(&task.program, &|address| known.contains_key(&address));
            parts.into_iter().map(|part| state.trace.part_path(part)).collect()
        };
        assert!(new(&all).is_empty());
        let loops = state.trace.loops(&task.program);
        let last = loops[0].parts[loops[0].parts.len() - 1];
        let mut fewer = all;
        let dropped = state.trace.moved(&task.program, last, state.trace.part_path(last), &Within::All);
        take(&mut fewer, &task, &state.trace, &dropped);
        assert_eq!(new(&fewer), [state.trace.part_path(last)]);
        // It emits nothing, so particles could not be told apart.
        assert!(new_parts(&task, &state, &fewer).is_empty());
    }
}
