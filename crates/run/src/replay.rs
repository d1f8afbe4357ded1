//! Replays: every choice is taken from a log, by its address. A replay gives readable addresses, the parts of the scene
//! and the queries. It runs depth first, in whatever order the first run chose; only the log of a run that was stopped is
//! followed future by future, each as far as its choices go.

use crate::Failure;
use crate::chooser::{Chooser, Chosen, Context, Prior, Refuse};
use crate::forward::{factor_name, unmet_name};
use crate::log::Entry;
use crate::record::{Record, check_factor};
use crate::run::Run;
use crate::task::Task;
use niwaki_geom::Shape;
use niwaki_math::{Dist, StreamKey, Total};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Stop;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::stack::Call;
use niwaki_vm::machine::state::State;
use niwaki_vm::value::{Value, equal, hash, identical, repr};
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
    /// The run.
    pub run: Run,
    /// The sums behind its scores, exact: of its choices, and of factors, observations and sketches.
    pub sums: (Total, Total),
    /// Every choice, in depth-first order; those that are held, too, which belong to the score.
    pub choices: Vec<Choice>,
    /// The primitives of the scene.
    pub parts: Vec<Part>,
    /// The query table.
    pub queries: Vec<(Value, Value)>,
}

/// A primitive of the scene, with names.
pub struct Part {
    /// Its readable address.
    pub path: String,
    /// Its shapes.
    pub shapes: Vec<Shape>,
    /// Where it is emitted.
    pub place: Call,
}

/// The source of the values of a replay.
pub enum Source<'a> {
    /// By the hash of an address.
    Addresses(HashMap<u128, Value>),
    /// By the readable address.
    Paths(&'a HashMap<String, Value>),
}

/// What to do at a choice that the source lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// It is a fault.
    Refuse,
    /// It is drawn from its prior, from this seed and stream.
    Draw {
        /// The seed.
        seed: u64,
        /// The stream.
        stream: u64,
    },
    /// The future stops there: the log is of a run that was stopped. What made that run impossible stops the replay,
    /// too, as a run without choices has nothing else to stop at.
    Stop,
}

/// Gives choices the values of a source.
struct Sourced<'a> {
    source: Source<'a>,
    missing: Missing,
}

impl Chooser for Sourced<'_> {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let known = match &self.source {
            Source::Addresses(map) => map.get(&seen.address),
            Source::Paths(map) => map.get(&at.path()),
        };
        match (known, self.missing) {
            (Some(value), _) => Chosen::given(value.clone(), dist).map(Some),
            (None, Missing::Draw { seed, stream }) => {
                Prior(StreamKey::new(seed, stream, 0)).choose(at, dist, seen)
            }
            // A choice with one value is not part of a density.
            (None, _) if matches!(dist, Dist::Delta(_)) => {
                Prior(StreamKey::new(0, 0, 0)).choose(at, dist, seen)
            }
            (None, Missing::Stop) => Ok(None),
            (None, Missing::Refuse) => {
                Refuse("replay with the model that the choices are from").choose(at, dist, seen)
            }
        }
    }
}

/// What a choice and a part take beside their addresses, as objects of Python, which a person reads them by: bytes.
const CHOICE: usize = 512;
const PART: usize = 1024;

struct Replay<'a> {
    task: &'a Task,
    chooser: Sourced<'a>,
    trace: Trace,
    record: Record,
    written: HashMap<u64, Vec<(Value, u32)>>,
    /// Bytes of the names and parts so far, which the run itself does not have.
    named: usize,
}

impl Replay<'_> {
    /// The readable address of a choice or a part that takes so many bytes.
    fn path(&mut self, at: &At<'_, f64>, bytes: usize) -> Result<String, Fault> {
        let (path, budget) = (at.path(), self.task.limits.bytes);
        self.named = self.named.saturating_add(path.len() + bytes);
        if self.named <= budget {
            return Ok(path);
        }
        let needs = format!(
            "the model's choices and parts, with their addresses, need more than {} MB",
            budget >> 20
        );
        Err(Fault::new("memory-budget", needs)
            .with_help("check that every loop and recursion ends, or raise `max_memory`"))
    }

    /// Goes on, or stops where the run that is followed did.
    fn on<A>(&self, answer: A) -> Answer<A> {
        match self.chooser.missing {
            Missing::Stop if self.record.cause.is_some() => Answer::Pause,
            _ => Answer::Go(answer),
        }
    }
}

impl Answers<f64> for Replay<'_> {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let seen = Context::of(at);
        let Some(chosen) = self.chooser.choose(at, dist, seen)? else {
            return Ok(Answer::Pause);
        };
        let Chosen { value, log_prior: log_density, .. } = chosen;
        self.record.choose(seen.address, &value, log_density);
        let (path, family) = (self.path(at, CHOICE)?, dist.family().name());
        self.trace.choices.push(Choice {
            path,
            address: seen.address,
            family,
            value: value.clone(),
            log_density,
        });
        Ok(Answer::Go(value))
    }

    fn score(&mut self, at: &At<'_, f64>, factor: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.record.factor(check_factor(log)?, || factor_name(at, factor));
        Ok(self.on(()))
    }

    fn held(&mut self, at: &At<'_, f64>, dist: &Dist, value: &Value, log: f64) -> Result<Answer<()>, Fault> {
        let path = self.path(at, CHOICE)?;
        self.trace.choices.push(Choice {
            path,
            address: at.address(),
            family: dist.family().name(),
            value: value.clone(),
            log_density: log,
        });
        self.score(at, Factor::Held, log)
    }

    fn unmet(&mut self, path: &str) {
        self.record.factor(f64::NEG_INFINITY, || unmet_name(path));
    }

    fn emit(&mut self, at: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        let place = Call { function: at.function.name.clone(), file: at.function.file, span: at.site.span };
        let path = self.path(at, PART + size_of_val(shapes))?;
        self.trace.parts.push(Part { path, shapes: shapes.to_vec(), place });
        self.record.emit(shapes);
        Ok(self.on(()))
    }

    fn query(&mut self, at: &At<'_, f64>, key: &Value, value: &Value) -> Result<(), Fault> {
        let line = at.site.span.line;
        let alike = self.written.entry(hash(key)).or_default();
        let is_it = |other: &Value| identical(other, key) || equal(other, key).unwrap_or(false);
        let first = alike.iter().find(|(other, _)| is_it(other)).map(|(_, line)| *line);
        alike.push((key.clone(), line));
        if let Some(first) = first {
            let text = repr(key)?;
            return Err(Fault::new(
                "query-twice",
                format!("the query {text} is written at line {first} and again at line {line}"),
            )
            .with_help("give each query a key of its own, for example with the index in it"));
        }
        self.trace.queries.push((key.clone(), value.clone()));
        Ok(())
    }

    fn host(&mut self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        self.task.hosts.call(constant, args, steps)
    }
}

/// The values of a log by address, order choices left out.
pub fn by_address(entries: &[Entry]) -> HashMap<u128, Value> {
    entries.iter().filter(|e| !e.is_order()).map(|e| (e.address(), e.value.clone())).collect()
}

/// The futures that ran at the order choices of a log, one after the other: the place of the next one among those that can run
/// now; `None` where it cannot, or where the log has no more.
pub fn picks(entries: &[Entry]) -> impl FnMut(&State) -> Option<usize> {
    let mut paths = entries.iter().filter(|e| e.is_order()).map(Entry::address);
    move |state| paths.next().and_then(|path| place(state, path))
}

/// The place of the future with that path among those that can run.
pub fn place(state: &State, path: u128) -> Option<usize> {
    state.runnable().iter().position(|future| state.path_of(future) == path)
}

/// Runs the program once more with the choices of `source`.
///
/// # Errors
/// A choice that `source` lacks and that may not be missing, or a fault of the program.
pub fn replay(task: &Task, source: Source<'_>, missing: Missing) -> Result<Trace, Failure> {
    let mut machine = task.machine();
    let mut state = task.start(&machine, missing != Missing::Stop)?;
    state.remember_origins();
    let (trace, record) = (Trace::default(), Record::start(&task.sketches));
    let chooser = Sourced { source, missing };
    let mut answers = Replay { task, chooser, trace, record, written: HashMap::new(), named: 0 };
    let mut stuck = Vec::new();
    machine.drive(&mut state, &mut answers, |answers, state, last| {
        if missing != Missing::Stop {
            return Some(0);
        }
        stuck.extend(last.filter(|(_, stop)| *stop == Stop::Paused).map(|(future, _)| future));
        let is_possible = answers.record.cause.is_none();
        state.runnable().iter().position(|future| is_possible && !stuck.contains(&future))
    })?;
    let Replay { mut trace, record, .. } = answers;
    let value = if state.has_ended() { state.result() } else { Value::None };
    trace.sums = (record.log_prior.clone(), record.score());
    trace.run = Run::of(record, value, 0.0, state.has_ended());
    for (_, value) in &mut trace.queries {
        *value = state.resolve(value);
    }
    Ok(trace)
}
