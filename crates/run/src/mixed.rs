//! Mixed observations: the probability of a single value in some runs, a density in other runs.
//!
//! A model may observe a value by different distributions, depending on earlier choices:
//!
//! ```text
//! observe(Delta(10.0) if perfect else Uniform(0.0, 10.0), grade)
//! ```
//!
//! The factor is a probability in a run where `Delta` observes `grade`, and a density per unit of `grade` in any other run.
//! Weights cannot compare the two: a change of units would change the posterior. In theory, the density is negligible beside
//! the probability.
//!
//! For most programs [`niwaki_vm::code::observed`] excludes mixed observations without a run. For other programs a few runs from
//! the prior are examined. An observation is identified by its activation and the text of the observed expression, so that it is
//! the same in both arms of an `if`. An observation is reported where a run has it only as a probability and another run only
//! as a density. Columns of data whose kinds are the same in all runs are not reported.
//!
//! Source: Wu et al. 2018, "Discrete-Continuous Mixtures in Probabilistic Programming", whose
//! example these grades are. That paper weighs such runs by their number of densities; this module only reports them.

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

/// The most runs that are examined.
const RUNS: u64 = 64;

/// The number of steps of all runs after which no further run starts.
const STEPS: u64 = 1_000_000;

/// A place in a source file: the number of the file, and the span.
pub type Place = (u32, Span);

/// A mixed observation, with a place for each of its kinds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mixed {
    /// The place where it is the probability of a single value.
    pub probability: Place,
    /// The place where it is a density.
    pub density: Place,
}

/// The kinds of an observation, with a place for each.
#[derive(Clone, Copy, Default)]
struct Kinds {
    probability: Option<Place>,
    density: Option<Place>,
}

/// Find the first mixed observation of a task by a few runs from the prior.
pub fn mixed(task: &Task, seed: u64) -> Option<Mixed> {
    let captures = task.model.iter().flat_map(|model| &model.captures);
    let inputs: Vec<&Value> = task.args.iter().chain(captures).collect();
    if !may_mix(&task.program, &inputs, task.held.is_some()) {
        return None;
    }
    let (mut all, mut steps) = (HashMap::new(), 0);
    for stream in 0..RUNS {
        if steps > STEPS {
            return None;
        }
        let (kinds, run_steps) = run(task, StreamKey::new(seed, stream, 0))?;
        steps += run_steps;
        let mut candidates: Vec<Mixed> = vec![];
        for (key, kinds) in kinds {
            // Both kinds in the same run: not the same observation.
            let alone = kinds.probability.is_some() != kinds.density.is_some();
            let known: &mut Kinds = all.entry(key).or_default();
            if alone {
                known.probability = known.probability.or(kinds.probability);
                known.density = known.density.or(kinds.density);
            }
            if let (true, Some(probability), Some(density)) = (alone, known.probability, known.density) {
                candidates.push(Mixed { probability, density });
            }
        }
        let place = |mixed: &Mixed| (mixed.density.0, mixed.density.1.line, mixed.density.1.column);
        if let Some(first) = candidates.into_iter().min_by_key(place) {
            return Some(first);
        }
    }
    None
}

/// The observations of a run from the prior, and its steps; `None` after a fault.
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
        // Impossible observations count, too: most values are impossible for `Delta(10.0)`.
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
