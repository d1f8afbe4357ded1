//! Replays: every choice is taken from a log, by its address. What is replayed is named: readable addresses,
//! parts of the scene, queries. It runs depth first, whatever order the log was made in.

use crate::Failure;
use crate::forward::factor_name;
use crate::log::Entry;
use crate::record::{Record, check_factor, log_density};
use crate::task::Task;
use niwaki_geom::Shape;
use niwaki_math::Dist;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// A choice with its readable address.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Path of sites from the root.
    pub path: String,
    /// Hash of that path.
    pub address: u128,
    /// Family that it was drawn from.
    pub family: &'static str,
    /// Its value.
    pub value: Value,
    /// Its log density, nats.
    pub log_density: f64,
}

/// A run with names.
#[derive(Default)]
pub struct Trace {
    /// Every choice, in depth-first order.
    pub choices: Vec<Choice>,
    /// The primitives of the scene: readable address and shapes.
    pub parts: Vec<(String, Vec<Shape>)>,
    /// The query table.
    pub queries: Vec<(Value, Value)>,
    /// What the program returned.
    pub value: Value,
    /// Scores.
    pub record: Record,
}

/// Where the values of a replay come from.
pub enum Source<'a> {
    /// By the hash of an address.
    Addresses(HashMap<u128, Value>),
    /// By the readable address.
    Paths(&'a HashMap<String, Value>),
}

struct Replay<'a> {
    task: &'a Task,
    source: Source<'a>,
    trace: &'a mut Trace,
    written: HashMap<String, u32>,
}

impl Answers<f64> for Replay<'_> {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let path = at.path();
        let found = match &self.source {
            Source::Addresses(map) => map.get(&at.address()),
            Source::Paths(map) => map.get(&path),
        };
        let Some(value) = found.cloned() else {
            return Err(Fault::new("missing-choice", format!("there is no value for the choice `{path}`"))
                .with_help("replay with the same model that made the choices"));
        };
        let log_density = log_density(dist, &value)?;
        self.trace.record.choose(at.address(), &value, log_density);
        let family = dist.family().name();
        self.trace.choices.push(Choice {
            path,
            address: at.address(),
            family,
            value: value.clone(),
            log_density,
        });
        Ok(Answer::Go(value))
    }

    fn score(&mut self, at: &At<'_, f64>, factor: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.trace.record.factor(check_factor(log)?, &factor_name(at, factor));
        Ok(Answer::Go(()))
    }

    fn emit(&mut self, at: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        self.trace.parts.push((at.path(), shapes.to_vec()));
        if self.trace.record.cause.is_none() {
            self.trace.record.emit(shapes);
        }
        Ok(Answer::Go(()))
    }

    fn query(&mut self, at: &At<'_, f64>, key: &Value, value: &Value) -> Result<(), Fault> {
        let text = niwaki_vm::value::repr(key)?;
        let line = at.site.span.line;
        if let Some(first) = self.written.insert(text.clone(), line) {
            return Err(Fault::new(
                "query-twice",
                format!("the query {text} is written at line {first} and again at line {line}"),
            )
            .with_help("give each query a key of its own, for example with the index in it"));
        }
        self.trace.queries.push((key.clone(), value.clone()));
        Ok(())
    }

    fn host(&mut self, constant: u16, args: &[Value]) -> Result<Value, Fault> {
        self.task.hosts.call(constant, args)
    }
}

/// The values of a log by address, order choices left out.
pub fn by_address(entries: &[Entry]) -> HashMap<u128, Value> {
    entries.iter().filter(|e| !e.is_order).map(|e| (e.address(), e.value.clone())).collect()
}

/// Runs the program once more with the choices of `source`.
///
/// # Errors
/// A choice that `source` lacks, or a fault of the program.
pub fn replay(task: &Task, source: Source<'_>) -> Result<Trace, Failure> {
    let mut machine = task.machine();
    let mut state = task.start(&machine, true)?;
    let mut trace = Trace { record: Record::start(&task.sketches), ..Trace::default() };
    let mut answers = Replay { task, source, trace: &mut trace, written: HashMap::new() };
    machine.finish(&mut state, &mut answers)?;
    trace.value = state.result();
    for (_, value) in &mut trace.queries {
        *value = state.resolve(value);
    }
    Ok(trace)
}
