//! Replays: runs that take every choice from a log, by address. A replay gives readable addresses, the parts of the scene and
//! the queries. Replays run depth first, whatever the order of the original run was. Only the log of a stopped run is replayed
//! future by future, each as far as its choices reach.

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
use niwaki_vm::machine::words::named;
use niwaki_vm::value::text::Text;
use niwaki_vm::value::{Value, equal, hash, identical, repr};
use std::collections::HashMap;

/// A choice with its readable address.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The readable address: the path of sites from the root.
    pub path: String,
    /// The address: the hash of the path.
    pub address: u128,
    /// The prior.
    pub dist: Dist,
    /// The value.
    pub value: Value,
    /// The words of its numbers ([`At::words`]).
    pub words: Option<Vec<Text>>,
    /// The log density under the prior, nats.
    pub log_density: f64,
    /// The number of barriers before it: primitives, factors and observations.
    pub barriers: usize,
}

impl Choice {
    /// The value for a person: the word of a number that has one.
    pub fn named_value(&self) -> Value {
        named(&self.value, self.words.as_deref())
    }
}

/// A replayed run with readable names.
#[derive(Default)]
pub struct Trace {
    /// The run.
    pub run: Run,
    /// The exact sums behind the scores: of the choices, and of factors, observations and sketches.
    pub sums: (Total, Total),
    /// All choices, in depth-first order, including held choices, which count in the score.
    pub choices: Vec<Choice>,
    /// The primitives of the scene.
    pub parts: Vec<Part>,
    /// The query table.
    pub queries: Vec<(Value, Value)>,
    /// The number of primitives before which a host function was called, after the primitive before.
    pub hosted: usize,
}

/// A primitive of the scene with readable names.
pub struct Part {
    /// The readable address.
    pub path: String,
    /// The shapes of the primitive.
    pub shapes: Vec<Shape>,
    /// The place in the source where it is emitted.
    pub place: Call,
}

/// The source of the values of a replay.
pub enum Source<'a> {
    /// Values by address.
    Addresses(HashMap<u128, Value>),
    /// Values by readable address.
    Paths(&'a HashMap<String, Value>),
}

/// The treatment of choices that the source lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// Fail with a fault.
    Refuse,
    /// Draw the choice from its prior, by this seed and stream.
    Draw {
        /// The seed.
        seed: u64,
        /// The stream.
        stream: u64,
    },
    /// Stop the future at the choice: the log is of a stopped run. A cause that made the run impossible stops the replay as well,
    /// because a run without choices has no other place to stop.
    Stop,
}

/// Chooser that takes values from a source.
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
            (Some(value), _) => Chosen::given(at.own_value(value)?.into_owned(), dist).map(Some),
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

/// Bytes of a choice, of one of its words and of a part as Python objects, without their addresses.
const CHOICE: usize = 512;
const WORD: usize = 96;
const PART: usize = 1024;

struct Replay<'a> {
    task: &'a Task,
    chooser: Sourced<'a>,
    trace: Trace,
    record: Record,
    written: HashMap<u64, Vec<(Value, u32)>>,
    /// Bytes of the names and parts so far; the budget of the run itself does not count them.
    named: usize,
    /// Primitives, factors and observations so far, and whether a host function was called since the last primitive.
    barriers: usize,
    is_hosted: bool,
}

impl Replay<'_> {
    /// Adds a choice with its readable address and its words to the trace.
    fn note(&mut self, at: &At<'_, f64>, dist: &Dist, value: &Value, log_density: f64) -> Result<(), Fault> {
        let words = at.words();
        let path =
            self.path(at, CHOICE + dist.bytes() + words.as_ref().map_or(0, |words| words.len() * WORD))?;
        let (address, dist, value, barriers) = (at.address(), dist.clone(), value.clone(), self.barriers);
        self.trace.choices.push(Choice { path, address, dist, value, words, log_density, barriers });
        Ok(())
    }

    /// The readable address of a choice or a part. `bytes` is the size of the choice or part without the address.
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

    /// Continue with an answer, or pause where the original run stopped.
    fn resume<A>(&self, answer: A) -> Answer<A> {
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
        self.note(at, dist, &value, log_density)?;
        Ok(Answer::Go(value))
    }

    fn score(&mut self, at: &At<'_, f64>, factor: Factor, log: f64) -> Result<Answer<()>, Fault> {
        // A held choice is one factor, wherever it stands.
        self.barriers += usize::from(!matches!(factor, Factor::Held));
        self.record.factor(check_factor(log)?, || factor_name(at, factor));
        Ok(self.resume(()))
    }

    fn held(&mut self, at: &At<'_, f64>, dist: &Dist, value: &Value, log: f64) -> Result<Answer<()>, Fault> {
        self.note(at, dist, value, log)?;
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
        self.barriers += 1;
        self.trace.hosted += usize::from(std::mem::take(&mut self.is_hosted));
        Ok(self.resume(()))
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
        self.is_hosted = true;
        self.task.hosts.call(constant, args, steps)
    }
}

/// The values of a log by address, without order choices.
pub fn by_address(entries: &[Entry]) -> HashMap<u128, Value> {
    entries.iter().filter(|e| !e.is_order()).map(|e| (e.address(), e.value.clone())).collect()
}

/// The order choices of a log, one for each call where several futures can run: the place of the next future of the log among the
/// runnable futures. `None` if that future is not runnable, or after the last order choice.
pub fn picks(entries: &[Entry]) -> impl FnMut(&State) -> Option<usize> {
    let mut paths = entries.iter().filter(|e| e.is_order()).map(Entry::address);
    // A single future is no choice, and stands in no log.
    move |state| {
        if state.runnable().len() == 1 { Some(0) } else { paths.next().and_then(|path| place(state, path)) }
    }
}

/// The place of the future with this path among the runnable futures.
pub fn place(state: &State, path: u128) -> Option<usize> {
    state.runnable().iter().position(|future| state.path_of(future) == path)
}

/// Replay a run: run the program with the choices of `source`.
///
/// # Errors
/// A missing choice with [`Missing::Refuse`], or a fault of the program.
pub fn replay(task: &Task, source: Source<'_>, missing: Missing) -> Result<Trace, Failure> {
    let mut machine = task.machine();
    let mut state = task.start(&machine, missing != Missing::Stop)?;
    state.remember_origins();
    let (trace, record) = (Trace::default(), Record::start(&task.sketches));
    let chooser = Sourced { source, missing };
    let written = HashMap::new();
    let mut answers =
        Replay { task, chooser, trace, record, written, named: 0, barriers: 0, is_hosted: false };
    let mut stopped = Vec::new();
    machine.drive(&mut state, &mut answers, |answers, state, last| {
        if missing != Missing::Stop {
            return Some(0);
        }
        stopped.extend(last.filter(|(_, stop)| *stop == Stop::Paused).map(|(future, _)| future));
        let is_possible = answers.record.cause.is_none();
        state.runnable().iter().position(|future| is_possible && !stopped.contains(&future))
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
