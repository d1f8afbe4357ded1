//! Graphs by structure. A structure is the set of a trace's choices, with the values of those that no trajectory moves.
//!
//! A structure's key is a sum over its choices, so it does not depend on their order in the trace's table. What it leaves
//! open are the values of continuous choices. Depending on them one structure may have several paths, each with its
//! guards; [`Live`] keeps the paths. Graphs are dropped when they together hold too many operations, the longest unused
//! first. Machine code gives the same bits as a structure's tape, so that nothing depends on when it is ready.

use super::scales::LabelId;
use crate::walk::state::choices;
use niwaki_continuous::hamiltonian::potential::evaluate;
use niwaki_continuous::hamiltonian::{Phase, Potential, Stop};
use niwaki_grad::{Continuous, Live, Model, Rolling, Scope};
use niwaki_math::{Family, Stream};
use niwaki_run::Failure;
use niwaki_vm::code::Program;
use niwaki_vm::machine::kept::Trace;
use niwaki_vm::value::Value;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Operations that the graphs of one leaf hold together at most: some 100 MB with their tapes.
const MOST_OPERATIONS: usize = 1 << 20;

/// Gradients of a graph before machine code is compiled. Compiling costs about as much as this many gradients by tape, and a
/// chain that changes its structure leaves most of its graphs sooner.
const WARM: u32 = 10_000;

/// Graphs by structure.
#[derive(Default)]
pub(crate) struct Structures {
    all: HashMap<u128, Structure>,
    now: u128,
    clock: u64,
    /// Structures recorded, and recordings of graphs that were dropped.
    met: u64,
    dropped: u64,
}

struct Structure {
    target: Target,
    labels: Vec<LabelId>,
    /// Numbers of the continuous choices in the trace, when it was last here.
    numbers: Vec<usize>,
    /// The addresses of its choices, without those of one value.
    known: HashSet<u128>,
    last: u64,
}

/// A structure's density over the coordinates that move.
pub(crate) struct Target {
    live: Live,
    /// All coordinates at the last point, and the slopes there.
    full: Vec<f64>,
    slopes: Vec<f64>,
    moving: Vec<usize>,
}

/// A trace in its structure.
pub(crate) struct Moving<'a> {
    pub target: &'a mut Target,
    pub labels: &'a [LabelId],
    /// Numbers of the continuous choices in the trace.
    pub numbers: &'a [usize],
}

/// The part of a choice that belongs to the structure, hashed.
fn part(address: u128, family: Option<Family>, value: &Value, moves: bool) -> u128 {
    const ODD: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835;
    let held = match value {
        _ if family == Some(Family::Delta) => 1,
        Value::Bool(b) => 4 + u128::from(*b),
        Value::Int(i) => (*i as u64 as u128) << 3 | 6,
        _ => 2 + u128::from(moves),
    };
    let mixed = (address ^ held.wrapping_mul(ODD)).wrapping_add(family.map_or(0, |f| f as u128 + 1));
    let mixed = (mixed ^ mixed >> 59).wrapping_mul(ODD);
    mixed ^ mixed >> 61
}

fn is_continuous(value: &Value) -> bool {
    !matches!(value, Value::Bool(_) | Value::Int(_))
}

impl Structures {
    /// Makes the structure of a trace the present one: it is recorded where it is new. `moves` returns for a choice's number
    /// whether it may move.
    ///
    /// # Errors
    /// An operation without a derivative on which the score depends, or another fault of the recorded run.
    pub fn find(
        &mut self,
        model: &Model,
        trace: &Trace,
        program: &Program,
        beta: f64,
        moves: &dyn Fn(usize) -> bool,
        label: &mut dyn FnMut(usize, &Continuous, usize) -> LabelId,
    ) -> Result<(), Failure> {
        let mut key = u128::from(beta != 1.0);
        for choice in trace.numbers() {
            let address = trace.address(program, choice);
            let value = trace.choice(program, choice).0;
            key = key.wrapping_add(part(address, trace.family(choice), value, moves(choice)));
        }
        self.clock += 1;
        self.now = key;
        if !self.all.contains_key(&key) {
            let structure = Structure::record(model, trace, program, beta, moves, label)?;
            self.met += 1;
            self.all.insert(key, structure);
            self.shrink();
        }
        if let Some(structure) = self.all.get_mut(&key) {
            structure.last = self.clock;
            structure.follow(trace, program);
        }
        Ok(())
    }

    /// Drops the graphs that were not used for longest, while there are too many operations.
    fn shrink(&mut self) {
        let mut size: usize = self.all.values().map(|structure| structure.target.live.size()).sum();
        while size > MOST_OPERATIONS && self.all.len() > 1 {
            let older = self.all.iter().filter(|(key, _)| **key != self.now);
            let Some(oldest) = older.min_by_key(|(_, structure)| structure.last).map(|(key, _)| *key) else {
                return;
            };
            if let Some(removed) = self.all.remove(&oldest) {
                size -= removed.target.live.size();
                self.dropped += removed.target.live.recordings() as u64;
            }
        }
    }

    /// The present structure; `None` before the first.
    pub fn present(&mut self) -> Option<Moving<'_>> {
        let Structure { target, labels, numbers, .. } = self.all.get_mut(&self.now)?;
        Some(Moving { target, labels, numbers })
    }

    /// Whether a choice of that address is part of the present structure, but for those of one value.
    pub fn contains(&self, address: u128) -> bool {
        self.all.get(&self.now).is_some_and(|structure| structure.known.contains(&address))
    }

    /// Counts on from what was recorded before.
    pub fn count_from(&mut self, recorded: (u64, u64)) {
        (self.met, self.dropped) = recorded;
    }

    /// How many structures were recorded (a dropped one counts again), and how often the program was recorded.
    pub fn recorded(&self) -> (u64, u64) {
        let recordings: usize = self.all.values().map(|structure| structure.target.live.recordings()).sum();
        (self.met, self.dropped + recordings as u64)
    }
}

impl Structure {
    fn record(
        model: &Model,
        trace: &Trace,
        program: &Program,
        beta: f64,
        moves: &dyn Fn(usize) -> bool,
        label: &mut dyn FnMut(usize, &Continuous, usize) -> LabelId,
    ) -> Result<Structure, Failure> {
        let (mut held, mut numbers) = (HashSet::new(), HashMap::new());
        for choice in trace.numbers() {
            let address = trace.address(program, choice);
            numbers.insert(address, choice);
            if is_continuous(trace.choice(program, choice).0) && !moves(choice) {
                held.insert(address);
            }
        }
        let scope =
            Scope { held: (!held.is_empty()).then(|| Arc::new(held)), power: (beta != 1.0).then_some(beta) };
        let model = Model { scope, ..model.clone() };
        let recorded = model.record(&choices(trace, program).collect())?;
        let known = recorded.choices.iter().map(|choice| choice.address);
        let known = known.chain(recorded.fixed.iter().map(|(address, _)| *address)).collect();
        let numbers: Vec<usize> = recorded
            .choices
            .iter()
            .map(|choice| numbers.get(&choice.address).copied().unwrap_or(0))
            .collect();
        let mut labels = Vec::with_capacity(recorded.dim());
        for (choice, number) in recorded.choices.iter().zip(&numbers).filter(|(choice, _)| !choice.is_held) {
            labels.extend((0..choice.coordinates).map(|k| label(*number, choice, k)));
        }
        let dim = recorded.dim();
        let target = Target {
            moving: recorded.moving.clone(),
            full: recorded.start.clone(),
            slopes: vec![0.0; dim],
            live: Live::after(model, recorded, WARM),
        };
        Ok(Structure { target, labels, numbers, known, last: 0 })
    }

    /// Updates the numbers of the choices, which births and deaths elsewhere may have changed.
    fn follow(&mut self, trace: &Trace, program: &Program) {
        let recorded = self.target.live.recorded();
        let is_right = |(choice, number): (&Continuous, &usize)| {
            *number < trace.len() && trace.address(program, *number) == choice.address
        };
        if recorded.choices.iter().zip(&self.numbers).all(is_right) {
            return;
        }
        let all: HashMap<u128, usize> =
            trace.numbers().map(|choice| (trace.address(program, choice), choice)).collect();
        for (number, choice) in self.numbers.iter_mut().zip(&recorded.choices) {
            *number = all.get(&choice.address).copied().unwrap_or(*number);
        }
    }
}

impl Target {
    /// Whether nothing moves.
    pub fn is_still(&self) -> bool {
        self.moving.is_empty()
    }

    /// The density that it restricts.
    pub fn live(&self) -> &Live {
        &self.live
    }

    /// The phase at the trace's coordinates, at rest; `numbers` are its choices in the order of the structure.
    ///
    /// # Errors
    /// The density has no finite value or gradient there.
    pub fn start_phase(
        &mut self,
        trace: &Trace,
        program: &Program,
        numbers: &[usize],
        beta: f64,
        rng: &mut Stream,
    ) -> Result<Phase, Stop> {
        let tempered = beta != 1.0;
        let mut coordinates = |recorded: &niwaki_grad::Recorded| {
            let mut places = numbers.iter();
            let mut x =
                recorded.coordinates(|_| places.next().map(|choice| trace.choice(program, *choice).0))?;
            if tempered {
                x[0] = beta;
            }
            Some(x)
        };
        if let Some(x) = self.live.locate(&mut coordinates, &mut || choices(trace, program).collect()) {
            self.full = x;
            self.reach_beyond(rng);
        }
        let x: Vec<f64> = self.moving.iter().map(|k| self.full[*k]).collect();
        Phase::at(self, &x)
    }

    /// Draws the coordinates of values that are the last numbers inside their intervals: of those for which such a number
    /// stands, by their density. Nothing else of the run depends on them, so the density falls there as the choice's own, by
    /// a constant slope (of a log-normal nearly).
    fn reach_beyond(&mut self, rng: &mut Stream) {
        let recorded = self.live.recorded().clone();
        let ends: Vec<(usize, f64)> = recorded
            .choices
            .iter()
            .filter(|choice| !choice.is_held)
            .filter_map(|choice| choice.beyond(self.full[choice.first]).map(|sign| (choice.first, sign)))
            .collect();
        if ends.is_empty() {
            return;
        }
        let mut there = self.full.clone();
        ends.iter().for_each(|(k, sign)| there[*k] += sign);
        let mut slopes = vec![0.0; there.len()];
        if self.live.value_and_gradient(&there, &mut slopes).is_err() {
            return;
        }
        for (k, sign) in ends {
            let rate = -sign * slopes[k];
            if rate > 0.0 && rate.is_finite() {
                self.full[k] -= sign * rng.uniform().ln() / rate;
            }
        }
    }

    /// All coordinates, where these are those that move.
    pub fn all(&self, x: &[f64]) -> Vec<f64> {
        let mut full = self.full.clone();
        self.moving.iter().zip(x).for_each(|(k, x)| full[*k] = *x);
        full
    }

    /// The log density over *values* at these coordinates, which are on the path that was used last, and those of the
    /// choices that move, each with its place among the structure's choices.
    pub fn values(&self, x: &[f64], log_density: f64) -> (f64, Vec<(usize, Value)>) {
        let recorded = self.live.recorded();
        let (numbers, slope) = recorded.numbers_and_slope(&self.all(x));
        let (mut at, mut values) = (0, Vec::with_capacity(recorded.choices.len()));
        for (place, choice) in recorded.choices.iter().enumerate() {
            let part = &numbers[at..at + choice.width()];
            at += choice.width();
            if !choice.is_held {
                values.push((place, choice.transform.value(part)));
            }
        }
        (log_density - slope, values)
    }

    /// Follows the path of a point, and returns its log density.
    ///
    /// # Errors
    /// The target's refusal.
    pub fn log_density(&mut self, x: &[f64]) -> Result<f64, Stop> {
        let mut slopes = vec![0.0; x.len()];
        evaluate(self, x, &mut slopes)
    }
}

impl Potential for Target {
    fn dim(&self) -> usize {
        self.moving.len()
    }

    fn value_and_gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<f64, Stop> {
        if self.moving.len() == self.full.len() {
            return Potential::value_and_gradient(&mut self.live, x, gradient);
        }
        self.moving.iter().zip(x).for_each(|(k, x)| self.full[*k] = *x);
        let value = Potential::value_and_gradient(&mut self.live, &self.full, &mut self.slopes)?;
        gradient.iter_mut().zip(&self.moving).for_each(|(slope, k)| *slope = self.slopes[*k]);
        Ok(value)
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Stop> {
        if self.moving.len() == self.full.len() {
            return Potential::gradient(&mut self.live, x, gradient);
        }
        self.moving.iter().zip(x).for_each(|(k, x)| self.full[*k] = *x);
        Potential::gradient(&mut self.live, &self.full, &mut self.slopes)?;
        gradient.iter_mut().zip(&self.moving).for_each(|(slope, k)| *slope = self.slopes[*k]);
        Ok(())
    }

    fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        let all_move = self.moving.len() == self.full.len();
        if all_move { Potential::roll(&mut self.live, at, kick, step, steps) } else { 0 }
    }
}
