//! Forward runs: a chooser gives every choice its value, usually from the prior with the random stream at the address.

use crate::Failure;
use crate::chooser::{Chooser, Context, Prior};
use crate::record::{Record, check_factor};
use crate::run::Run;
use crate::task::{Hosts, Task};
use niwaki_geom::Shape;
use niwaki_math::{Dist, LastLogs, StreamKey, grid};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::state::State;
use niwaki_vm::machine::{Machine, Stop};
use niwaki_vm::value::Value;

/// Answers of a forward run: a chooser gives the values, and a record collects choices and scores.
pub struct Forward<'a, C> {
    /// The record of the run so far.
    pub record: &'a mut Record,
    /// The chooser of all values.
    pub chooser: C,
    /// Log of prior over proposal, `log p - log q`, of the choices so far, nats; zero if all choices are from the prior.
    pub log_ratio: f64,
    /// Host functions.
    pub hosts: &'a dyn Hosts,
    /// Whether emits, factors and observations pause the run.
    pub barriers: bool,
    /// Whether the run continues after a score of minus infinity.
    pub complete: bool,
}

impl<C: Chooser> Forward<'_, C> {
    /// Run depth first until the run ends or pauses. A run pauses when it is impossible, at a barrier, and where the chooser
    /// pauses it.
    ///
    /// # Errors
    /// A fault of the program, or of the chooser.
    pub fn run(&mut self, task: &Task, machine: &mut Machine<'_>, state: &mut State) -> Result<(), Failure> {
        let driven = machine.drive(state, self, |answers, _, last| {
            let has_paused = matches!(last, Some((_, Stop::Paused)));
            (!has_paused && (answers.complete || answers.record.cause.is_none())).then_some(0)
        });
        match driven {
            Err(met) if !self.complete => self.record.forgive(task, met),
            driven => Ok(driven?),
        }
    }

    #[inline(always)]
    fn barrier(&self) -> Answer<()> {
        if self.barriers || (self.record.cause.is_some() && !self.complete) {
            Answer::Pause
        } else {
            Answer::Go(())
        }
    }
}

/// The readable name of a factor.
pub(crate) fn factor_name(at: &At<'_, f64>, factor: Factor) -> String {
    match factor {
        Factor::Held => held_name(&at.path(), at.site.span.line),
        _ => named(factor, at.site.span.line),
    }
}

/// The readable name of a held choice with a value outside of its support.
#[cold]
pub fn held_name(path: &str, line: u32) -> String {
    format!("the held choice `{path}` at line {line}: its value is outside of its support")
}

/// The readable name of a held choice that a run did not make.
#[cold]
pub fn unmet_name(path: &str) -> String {
    format!("the held choice `{path}`: the run did not make it")
}

/// The readable name of a value outside of the support of its choice.
#[cold]
fn outside(at: &At<'_, f64>) -> String {
    format!("the choice `{}` at line {}: a proposal outside of its support", at.path(), at.site.span.line)
}

/// The readable name of a factor by kind and line.
pub fn named(factor: Factor, line: u32) -> String {
    let word = match factor {
        Factor::Observe => "observe",
        Factor::Factor => "factor",
        Factor::Condition => "condition",
        Factor::Held => "a held choice",
    };
    format!("`{word}` at line {line}")
}

impl<C: Chooser> Answers<f64> for Forward<'_, C> {
    const LOGS: bool = true;
    const DRAWS: bool = C::IS_PRIOR;

    #[inline(always)]
    fn drawn(&mut self, address: u128, dist: &Dist, logs: &mut LastLogs<f64>) -> Option<Value> {
        let mut random = self.chooser.key()?.at(address);
        let (draw, log) = dist.sample_and_score_with(&mut random, logs);
        let value = draw.into();
        self.record.choose(address, &value, log);
        Some(value)
    }

    #[inline(always)]
    fn scored(&mut self, log: f64) -> Answer<()> {
        self.record.factor(grid(log), String::new);
        self.barrier()
    }

    #[inline(always)]
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let sketches = Some(&self.record.sketches).filter(|sketches| !sketches.is_empty());
        let (address, primitives) = (at.address(), self.record.primitives);
        let Some(chosen) =
            self.chooser.choose(at, dist, Context { address, sketches, primitives, part: None })?
        else {
            return Ok(Answer::Pause);
        };
        if !C::IS_PRIOR {
            if chosen.log_prior == f64::NEG_INFINITY {
                self.record.factor(f64::NEG_INFINITY, || outside(at));
                return Ok(Answer::Pause);
            }
            self.log_ratio += chosen.log_prior - chosen.log_drawn;
        }
        self.record.choose(address, &chosen.value, chosen.log_prior);
        Ok(Answer::Go(chosen.value))
    }

    #[inline(always)]
    fn score(&mut self, at: &At<'_, f64>, factor: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.record.factor(check_factor(log)?, || factor_name(at, factor));
        Ok(self.barrier())
    }

    fn emit(&mut self, _: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        self.record.emit(shapes);
        Ok(self.barrier())
    }

    fn unmet(&mut self, path: &str) {
        self.record.factor(f64::NEG_INFINITY, || unmet_name(path));
    }

    fn host(&mut self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        self.hosts.call(constant, args, steps)
    }
}

/// Run the program forward from the prior, depth first. Unless `complete` is true, the run stops when its score becomes minus
/// infinity or when it is invalid.
///
/// # Errors
/// A fault of the program.
pub fn forward(task: &Task, seed: u64, stream: u64, complete: bool) -> Result<Run, Failure> {
    Ok(Run { log_weight: 0.0, ..forward_by(task, Prior(StreamKey::new(seed, stream, 0)), complete)? })
}

/// Run the program forward with the values of a chooser, like [`forward`]. The weight of the run is its score times prior over
/// proposal of its choices.
///
/// # Errors
/// A fault of the program, or of the chooser.
pub fn forward_by(task: &Task, chooser: impl Chooser, complete: bool) -> Result<Run, Failure> {
    let mut machine = task.machine();
    let mut state = task.start(&machine, true)?;
    let mut record = Record::start(&task.sketches);
    if chooser.looks() {
        state.note_parts();
        record.sketches.expect_windows();
    }
    let hosts = &*task.hosts;
    let mut answers =
        Forward { record: &mut record, chooser, log_ratio: 0.0, hosts, barriers: false, complete };
    answers.run(task, &mut machine, &mut state)?;
    let log_ratio = answers.log_ratio;
    let value = if state.has_ended() { state.result() } else { Value::None };
    let log_weight = record.log_score() + log_ratio;
    let has_ended = complete || record.cause.is_none();
    Ok(Run::of(record, value, log_weight, has_ended))
}
