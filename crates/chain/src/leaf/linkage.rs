//! Linkage: a real choice moves, and the other real choices move with it so that all parts of the scene but a few stay where they are.
//!
//! In a chain of parts, such as walls or limbs, a move of a choice carries everything that comes after it away, so that hardly any move of
//! a good scene is kept. A linkage turns a few parts and leaves those after them in place, as the bars of a machine do.
//!
//! Points of each part have slopes by the choices. They are found by small changes of one choice at a time, so any program has them.
//! For a move `d` of choice `i` that only a few parts may follow, the moves `y` of the others, in spreads, are the least of
//!
//! ```text
//! sum over the points of all other parts |A y + a_i d|^2  +  r^2 |y|^2
//! ```
//!
//! Sources: Dodd, Boone and Theodorou, "A concerted rotation algorithm for atomistic Monte Carlo simulation of polymer melts and glasses"
//! (Molecular Physics 1993); Nakamura, Hanafusa and Yoshikawa, "Task-priority based redundancy control of robot manipulators" (1987).
//!
//! The slopes of a run are not those of the run after a move, and no factor corrects this. So the step is for searches for the best, and no
//! kernel of users. In a run with more than [`CHOICES`] real choices, or without a choice that moves two parts, a single choice is drawn from
//! its prior.

use crate::leaf::drift::normal;
use crate::walk::proposal::FromPrior;
use crate::walk::state::State;
use crate::walk::streams::below;
use crate::walk::{ChainMove, Proposing, Walk};
use niwaki_continuous::hamiltonian::metric::{cholesky, solve};
use niwaki_geom::{Primitive, Vec3};
use niwaki_math::Stream;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::{Change, Changed, Proposed};
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// The most real choices of a run with linkages: their cost grows with the cube of this number.
pub const CHOICES: usize = 64;
/// The number of moves by the same slopes.
const MOVES: usize = 16;
/// The points of a part, and their coordinates.
const POINTS: usize = 4;
const ROWS: usize = 3 * POINTS;
/// The small change of a choice by which slopes are found, spreads.
const SMALL: f64 = 1e-4;
/// The probability that one more part may follow.
const MORE: f64 = 0.5;
/// The cost of a move of a spread, as a share of the mean of what it moves.
const COST: f64 = 1e-3;
/// The smallest size of a move, as a power of e of the spread; the largest is the spread itself.
const SMALLEST: f64 = -4.0;
/// The farthest slide, spreads.
const FARTHEST: f64 = 2.0;
/// A move below this many spreads is none.
const LEAST: f64 = 1e-9;

/// A linkage.
#[derive(Clone, Copy, Debug)]
pub struct Linkage;

/// The slopes of parts by choices.
struct Slopes {
    /// The number and the spread of each choice.
    choices: Vec<(usize, f64)>,
    /// For each choice the parts that it moves, in the order of the run.
    moved: Vec<Vec<usize>>,
    /// For each part its rows: the slopes of its coordinates by the choices, scene units for a spread.
    parts: Vec<Vec<f64>>,
    /// The products of the columns, over the rows of all parts.
    products: Vec<f64>,
}

impl ChainMove for Linkage {
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure> {
        let Proposing { chain, task, machine, table, beta } = proposing;
        let slopes = Slopes::of(chain, task, machine)?;
        let linked: Vec<usize> = (0..slopes.choices.len()).filter(|i| slopes.moved[*i].len() > 1).collect();
        if linked.is_empty() {
            return chain.single(task, machine, &mut FromPrior, table, beta);
        }
        for _ in 0..MOVES {
            let visit = chain.visit;
            chain.visit += 1;
            let mut rng = chain.streams.decisions(visit);
            let first = linked[below(&mut rng, linked.len() as u64) as usize];
            let amount = (SMALLEST * rng.uniform()).exp() * normal(&mut rng);
            let Some(moves) = slopes.moves(first, amount, &mut rng) else { continue };
            let program = &*task.program;
            let (mut changes, mut before) = (vec![], vec![]);
            for (choice, x, value) in slopes.moved_by(&moves, &chain.state, program) {
                before.push((chain.state.trace.address(program, choice), Value::Real(x)));
                changes.push(Changed { choice, proposed: Proposed { value, forward: 0.0, backward: 0.0 } });
            }
            let change = chain.change(task, machine, visit, changes)?;
            let selection = |chain: &Walk| chain.with_same_choices(program);
            let decision = chain.decide(task, change, beta, &mut rng, selection, before)?;
            chain.count_many(decision);
        }
        Ok(())
    }
}

impl Walk {
    /// Up to `count` sets of new values by address, each for another move of a real choice, with which most parts stay. None if no part
    /// follows the choice, or if it is no real.
    ///
    /// # Errors
    /// A fault that makes no run invalid.
    pub fn slides(
        &mut self,
        task: &Task,
        choice: usize,
        count: usize,
        rng: &mut Stream,
    ) -> Result<Vec<Vec<(u128, Value)>>, Failure> {
        let slopes = Slopes::of(self, task, &mut task.machine())?;
        let first = slopes.choices.iter().position(|(number, _)| *number == choice);
        let Some(first) = first.filter(|first| slopes.moved[*first].len() > 1) else { return Ok(vec![]) };
        let (trace, program) = (&self.state.trace, &*task.program);
        let mut slides = vec![];
        for _ in 0..count {
            let amount = FARTHEST * (2.0 * rng.uniform() - 1.0);
            let Some(moves) = slopes.moves(first, amount, rng) else { continue };
            let moved = slopes.moved_by(&moves, &self.state, program);
            slides.push(moved.map(|(choice, _, value)| (trace.address(program, choice), value)).collect());
        }
        Ok(slides)
    }
}

impl Slopes {
    /// The slopes of the present run by its real choices; none for a run with too many.
    ///
    /// # Errors
    /// A fault that makes no run invalid.
    fn of(chain: &mut Walk, task: &Task, machine: &mut Machine<'_>) -> Result<Slopes, Failure> {
        let program = &*task.program;
        let trace = &chain.state.trace;
        let spread = |choice: usize| chain.spreads[chain.counts.number(trace.site_of(choice))];
        let is_real = |choice: &usize| chain.state.real(program, *choice).is_some();
        let reals = trace.numbers().filter(is_real).map(|choice| (choice, spread(choice)));
        let mut choices: Vec<(usize, f64)> =
            reals.filter(|(_, spread)| *spread > 0.0 && spread.is_finite()).collect();
        if choices.len() > CHOICES {
            choices.clear();
        }
        let count = choices.len();
        let (mut moved, mut parts, mut numbers) = (vec![], vec![], HashMap::new());
        for (column, (choice, spread)) in choices.iter().enumerate() {
            let visit = chain.visit;
            chain.visit += 1;
            let x = chain.state.real(program, *choice).unwrap_or(f64::NAN);
            let value = Value::Real(x + SMALL * spread);
            let proposed = Proposed { value, forward: 0.0, backward: 0.0 };
            let change = chain.change(task, machine, visit, vec![Changed { choice: *choice, proposed }])?;
            let mut list = vec![];
            if change == Change::Done && chain.with_same_choices(program) == 0.0 {
                let trace = &chain.state.trace;
                let (old, new) = trace.exchanged();
                for (old, new) in old.iter().zip(new).filter(|_| old.len() == new.len()) {
                    let pair = trace.primitive(*old).zip(trace.primitive(*new));
                    let Some(by) = pair.and_then(|(old, new)| slope(old, new, SMALL)) else { continue };
                    let part = *numbers.entry(*old).or_insert_with(|| {
                        parts.push(vec![0.0; ROWS * count]);
                        parts.len() - 1
                    });
                    by.into_iter().enumerate().for_each(|(row, by)| parts[part][row * count + column] = by);
                    list.push(part);
                }
            }
            chain.state.trace.rollback(program);
            moved.push(list);
        }
        let mut products = vec![0.0; count * count];
        parts.iter().for_each(|part| add_products(&mut products, part, 1.0));
        Ok(Slopes { choices, moved, parts, products })
    }

    /// The numbers, the values and the new values of the choices that these moves change. A choice may have been drawn anew since the slopes
    /// were found.
    fn moved_by(
        &self,
        moves: &[f64],
        state: &State,
        program: &Program,
    ) -> impl Iterator<Item = (usize, f64, Value)> {
        let all = self.choices.iter().zip(moves).filter(|(_, by)| by.abs() > LEAST);
        all.filter_map(|((choice, spread), by)| {
            let x = state.real(program, *choice)?;
            Some((*choice, x, Value::Real(x + spread * by)))
        })
    }

    /// The moves of all choices, spreads, for a move of the choice `first` by `amount` that some of the parts that it moves may follow.
    /// `None` if nothing holds the others.
    fn moves(&self, first: usize, amount: f64, rng: &mut Stream) -> Option<Vec<f64>> {
        let list = &self.moved[first];
        let from = if rng.uniform() < 0.5 { 0 } else { below(rng, list.len() as u64) as usize };
        let mut free = 1;
        while rng.uniform() < MORE {
            free += 1;
        }
        let count = self.choices.len();
        let mut matrix = self.products.clone();
        for part in list.iter().skip(from).take(free) {
            add_products(&mut matrix, &self.parts[*part], -1.0);
        }
        let mean = (0..count).map(|i| matrix[i * count + i]).sum::<f64>() / count as f64;
        if !(mean > 0.0 && mean.is_finite()) {
            return None;
        }
        let mut right: Vec<f64> = (0..count).map(|i| -amount * matrix[i * count + first]).collect();
        right[first] = 0.0;
        for i in 0..count {
            (matrix[i * count + first], matrix[first * count + i]) = (0.0, 0.0);
            matrix[i * count + i] += COST * mean;
        }
        matrix[first * count + first] = 1.0;
        let mut moves = solve(&cholesky(&matrix)?, &right);
        moves[first] = amount;
        Some(moves)
    }
}

/// Adds `sign` times the products of the columns of a part's rows.
fn add_products(products: &mut [f64], rows: &[f64], sign: f64) {
    let count = rows.len() / ROWS;
    for row in rows.chunks_exact(count) {
        for (i, a) in row.iter().enumerate().filter(|(_, a)| **a != 0.0) {
            let line = &mut products[i * count..(i + 1) * count];
            line.iter_mut().zip(row).for_each(|(sum, b)| *sum += sign * a * b);
        }
    }
}

/// The slopes of a part's points, scene units for a spread, from two places of it. `None` if points of the two do not belong to each
/// other.
fn slope(old: &Primitive, new: &Primitive, small: f64) -> Option<[f64; ROWS]> {
    let (old, reach) = (points(old)?, old.aabb().extent().norm());
    let mut rows = [0.0; ROWS];
    for (k, (a, b)) in old.into_iter().zip(points(new)?).enumerate() {
        let by = b - a;
        if by.norm() > 0.1 * reach {
            return None;
        }
        rows[3 * k..3 * k + 3].copy_from_slice(&(by * (1.0 / small)).to_array());
    }
    Some(rows)
}

/// Points that are fixed to a part.
fn points(part: &Primitive) -> Option<[Vec3; POINTS]> {
    let (first, last) = (part.shapes().first()?, part.shapes().last()?);
    let ends = |shape: &niwaki_geom::Shape| {
        let at = |corners: &[Vec3]| {
            let n = corners.len();
            [
                corners.first().copied(),
                corners.get(n / 3).copied(),
                corners.get(2 * n / 3).copied(),
                corners.last().copied(),
            ]
        };
        match shape.convex() {
            Some(convex) => at(convex.corners()),
            None => {
                let around = shape.aabb();
                at(&[around.low, around.center(), around.center(), around.high])
            }
        }
    };
    let ([a, b, ..], [.., c, d]) = (ends(first), ends(last));
    Some([a?, b?, c?, d?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::plan::Plan;
    use crate::walk::streams::Streams;
    use crate::{Chain, Settings};
    use niwaki_run::replay::by_address;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::machine::kept::inspect::Item;
    use niwaki_vm::passes::compile;
    use std::sync::Arc;

    /// A chain of eight blocks in a plane, each with a turn and a length; a length above 2.9 has a truth value, too.
    const CHAIN: &str = r#"(module (fn "m" (params)
        (set $x 0.0) (set $y 0.0) (set $h 0.0)
        (for $i (range 8) (body
            (set $h (add $h (sample (dist gaussian 0.0 0.4))))
            (set $l (sample (dist uniform 1.0 3.0)))
            (if (gt $l 2.9) (then (do (sample (dist bernoulli 0.5)))) (else))
            (set $x (add $x (mul $l (cos $h))))
            (set $y (add $y (mul $l (sin $h))))
            (do (emit (box (vec $x $y 0.0) (vec 0.2 0.2 0.2))))))
        (return $x)) (entry "m"))"#;

    fn task(text: &str) -> Task {
        Task::new(Arc::new(compile(&parse(text).expect("core form"), vec![]).expect("a program")))
    }

    fn chain_at(task: &Task, seed: u64, known: Option<&HashMap<u128, Value>>) -> Chain {
        let (state, _) = State::start(task, Streams::new(seed, 0), 1, known).expect("a run");
        let settings = Settings { seed, thin: 0, ..Settings::default() };
        let plan = Plan::new(&Kernel::LINKAGE).expect("a plan");
        Chain::at(task, &settings, 1, plan, state, &HashMap::new()).expect("a chain")
    }

    /// The middles of all blocks.
    fn places(chain: &Chain, task: &Task) -> Vec<Vec3> {
        let mut places = vec![];
        chain.state.trace.visit(&task.program, |_, item| {
            if let Item::Emit(block) = item {
                places.push(block.aabb().center());
            }
        });
        places
    }

    /// How far the blocks of two runs are from each other.
    fn distances(a: &[Vec3], b: &[Vec3]) -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| (*a - *b).norm()).collect()
    }

    #[test]
    fn slopes_are_those_of_the_places() {
        let task = task(CHAIN);
        let mut chain = chain_at(&task, 3, None);
        let slopes = Slopes::of(&mut chain, &task, &mut task.machine()).expect("no fault");
        let before = places(&chain, &task);
        let count = slopes.choices.len();
        assert_eq!((count, slopes.parts.len()), (16, 8));
        for (column, (choice, _)) in slopes.choices.iter().enumerate() {
            let mut values: HashMap<u128, Value> = chain.state.choices(&task.program).collect();
            let address = chain.state.trace.address(&task.program, *choice);
            let x = chain.state.real(&task.program, *choice).expect("a real");
            values.insert(address, Value::Real(x + 1e-6));
            let after = places(&chain_at(&task, 3, Some(&values)), &task);
            for part in &slopes.moved[column] {
                let row = |axis: usize| slopes.parts[*part][axis * count + column];
                let by = Vec3 { x: row(0), y: row(1), z: row(2) };
                let near = |(a, b): (&Vec3, &Vec3)| ((*b - *a) * 1e6 - by).norm() < 1e-3 * (1.0 + by.norm());
                assert!(before.iter().zip(&after).any(near), "{by:?}");
            }
        }
        // What comes before a choice does not move: each block follows the choices of its own iteration, and of those before it.
        let mut numbers: Vec<usize> = slopes.moved.iter().map(Vec::len).collect();
        numbers.sort_unstable();
        assert_eq!(numbers, [1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8]);
    }

    #[test]
    fn a_slide_leaves_what_is_far_behind_in_place() {
        let task = task(CHAIN);
        let (mut tried, mut held) = (0, 0);
        for seed in 0..20 {
            let mut chain = chain_at(&task, seed, None);
            let before = places(&chain, &task);
            let slopes = Slopes::of(&mut chain, &task, &mut task.machine()).expect("no fault");
            let third = slopes.moved.iter().position(|moved| moved.len() == 6).expect("the third iteration");
            let choice = slopes.choices[third].0;
            let slides = chain.slides(&task, choice, 5, &mut Stream::new(seed, 1, 2, 3)).expect("no fault");
            assert_eq!(places(&chain, &task), before);
            let address = chain.state.trace.address(&task.program, choice);
            for slide in slides {
                let old: HashMap<u128, Value> = chain.state.choices(&task.program).collect();
                let mut alone = old.clone();
                let moved = slide.iter().find(|(at, _)| *at == address).expect("the choice itself").1.clone();
                alone.insert(address, moved);
                let run = |values: HashMap<u128, Value>| {
                    State::start(&task, Streams::new(seed, 9), 1, Some(&values)).ok()?;
                    Some(distances(&before, &places(&chain_at(&task, seed, Some(&values)), &task)))
                };
                let (Some(alone), Some(slid)) = (run(alone), run(old.into_iter().chain(slide).collect()))
                else {
                    continue;
                };
                tried += 1;
                held += usize::from(slid[7] < 0.2 * alone[7]);
            }
        }
        assert!(tried > 40 && 4 * held > 3 * tried, "{held} of {tried}");
    }

    #[test]
    fn others_follow_a_choice_and_no_choice_comes_or_goes() {
        let task = task(CHAIN);
        let mut moved = 0;
        for seed in 0..100 {
            let mut chain = chain_at(&task, seed, None);
            let before: Vec<(u128, Value)> = chain.state.choices(&task.program).collect();
            chain.advance(&task, 1, &mut |_, _| true).expect("no fault");
            let after: HashMap<u128, Value> = chain.state.choices(&task.program).collect();
            assert_eq!(before.len(), after.len());
            let changed = before.iter().filter(|(address, value)| after[address] != *value).count();
            assert!(changed == 0 || changed > 3, "{changed}");
            moved += usize::from(changed > 0);
        }
        assert!(moved > 50, "{moved}");
    }

    /// A chain whose lengths are below the length before: a move may leave the support of a later choice, which is then drawn anew.
    const SHORTER: &str = r#"(module (fn "m" (params)
        (set $x 0.0) (set $l 3.0)
        (for $i (range 6) (body
            (set $l (sample (dist uniform 0.0 (mul $l 1.1))))
            (set $x (add $x $l))
            (do (factor (mul -1.0 (abs (sub $x (mul 1.2 $i))))))
            (do (emit (box (vec $x 0.0 0.0) (vec 0.2 0.2 0.2))))))
        (return $x)) (entry "m"))"#;

    #[test]
    fn the_best_run_has_the_choices_of_its_score() {
        let task = task(SHORTER);
        let mut improved = 0;
        for seed in 0..40 {
            let mut chain = chain_at(&task, seed, None);
            let first = chain.state.log_score();
            chain.advance(&task, 600, &mut |_, _| true).expect("no fault");
            let score = chain.best.score();
            improved += usize::from(score > first);
            let walk = &mut *chain;
            let best = walk.best.get(&walk.state, &task).expect("a run");
            let values = by_address(&best.log.entries());
            let (again, _) = State::start(&task, Streams::new(seed, 1), 1, Some(&values)).expect("a run");
            assert_eq!(again.log_score().to_bits(), score.to_bits());
        }
        assert!(improved > 30, "{improved}");
    }
}
