//! Observations that have the probability of a single value in some runs, and a density in others.
//!
//! A model may observe one thing by different distributions, by what it chose before:
//!
//! ```text
//! observe(Delta(10.0) if perfect else Uniform(0.0, 10.0), grade)
//! ```
//!
//! The factor of a run in which `grade` is the one value of `Delta` is a probability; that of another run is a density, a
//! number per unit of `grade`. No weight can compare the two: written in other units, the same model would have another
//! posterior, and in truth the density counts nothing beside the probability.
//!
//! Most programs cannot: [`niwaki_vm::code::observed`] tells without a run. Of the others a few runs from the prior show it: an
//! observation is named by its activation and the text of what is observed, so that it is the same in two arms of an `if`. It is
//! reported where one run has it only as a probability and another only as a density. Columns of data that are of different
//! kinds in the same manner in all runs are not.
//!
//! Source: Wu et al. 2018, "Discrete-Continuous Mixtures in Probabilistic Programming", whose grades these are. differs: they
//! weigh such runs by their numbers of densities; we say that it is so.

use crate::Task;
use crate::chooser::Prior;
use crate::forward::Forward;
use crate::record::Record;
use niwaki_geom::Shape;
use niwaki_math::{Dist, StreamKey};
use niwaki_vm::code::observed::{is_density, may_mix, subject};
use niwaki_vm::core::Span;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::address::join;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// Runs that are looked at, at most.
const RUNS: u64 = 64;

/// Steps that they may take together before no further one is begun.
const STEPS: u64 = 1_000_000;

/// A place in a source file: the number of the file, and the span.
pub type Place = (u32, Span);

/// An observation that is a probability in some runs and a density in others: a place of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mixed {
    /// Where it is the probability of a single value.
    pub probability: Place,
    /// Where it is a density.
    pub density: Place,
}

/// The kinds of one observation, and a place of each.
#[derive(Clone, Copy, Default)]
struct Kinds {
    probability: Option<Place>,
    density: Option<Place>,
}

/// The first such observation of a task, if a few runs from the prior meet one.
pub fn mixed(task: &Task, seed: u64) -> Option<Mixed> {
    let captures = task.model.iter().flat_map(|model| &model.captures);
    let given: Vec<&Value> = task.args.iter().chain(captures).collect();
    if !may_mix(&task.program, &given, task.held.is_some()) {
        return None;
    }
    let (mut all, mut steps) = (HashMap::new(), 0);
    for stream in 0..RUNS {
        if steps > STEPS {
            return None;
        }
        let (kinds, taken) = run(task, StreamKey::new(seed, stream, 0))?;
        steps += taken;
        let mut found: Vec<Mixed> = vec![];
        for (key, own) in kinds {
            // In one run both: not the same thing twice.
            let alone = own.probability.is_some() != own.density.is_some();
            let known: &mut Kinds = all.entry(key).or_default();
            if alone {
                known.probability = known.probability.or(own.probability);
                known.density = known.density.or(own.density);
            }
            if let (true, Some(probability), Some(density)) = (alone, known.probability, known.density) {
                found.push(Mixed { probability, density });
            }
        }
        let place = |mixed: &Mixed| (mixed.density.0, mixed.density.1.line, mixed.density.1.column);
        if let Some(first) = found.into_iter().min_by_key(place) {
            return Some(first);
        }
    }
    None
}

/// The observations of one run from the prior, and its steps; `None` where it met a fault.
fn run(task: &Task, key: StreamKey) -> Option<(HashMap<u128, Kinds>, u64)> {
    let mut machine = task.machine();
    let mut state = task.start(&machine, true).ok()?;
    let mut record = Record::start(&[]);
    let forward = Forward {
        record: &mut record,
        chooser: Prior(key),
        log_ratio: 0.0,
        hosts: &*task.hosts,
        barriers: false,
        complete: false,
    };
    let mut watch = Watch { forward, kinds: HashMap::new() };
    let possible = |watch: &mut Watch<'_>| watch.forward.record.cause.is_none();
    let driven = machine.drive(&mut state, &mut watch, |watch, _, _| possible(watch).then_some(0));
    let is_usable = driven.err().is_none_or(|met| met.is_invalid());
    is_usable.then(|| (watch.kinds, state.steps()))
}

/// A forward run that notes the kinds of its observations.
struct Watch<'a> {
    forward: Forward<'a, Prior>,
    kinds: HashMap<u128, Kinds>,
}

impl Answers<f64> for Watch<'_> {
    const LOGS: bool = true;
    const WATCHES: bool = true;

    fn observes(&mut self, at: &At<'_, f64>, dist: &Dist) {
        let kinds = self.kinds.entry(join(at.activation(), subject(at.site))).or_default();
        let place = if is_density(dist) { &mut kinds.density } else { &mut kinds.probability };
        *place = Some((at.function.file, at.site.span));
    }

    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        self.forward.choice(at, dist)
    }

    fn score(&mut self, at: &At<'_, f64>, factor: Factor, log: f64) -> Result<Answer<()>, Fault> {
        // What is impossible is noted, too: of `Delta(10.0)` most values are.
        if log == f64::NEG_INFINITY && matches!(factor, Factor::Observe | Factor::Held) {
            return Ok(Answer::Go(()));
        }
        self.forward.score(at, factor, log)
    }

    fn emit(&mut self, at: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        self.forward.emit(at, shapes)
    }

    fn unmet(&mut self, path: &str) {
        self.forward.unmet(path);
    }

    fn query(&mut self, at: &At<'_, f64>, key: &Value, value: &Value) -> Result<(), Fault> {
        self.forward.query(at, key, value)
    }

    fn host(&mut self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        self.forward.host(constant, args, steps)
    }
}
