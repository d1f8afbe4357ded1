//! Forward runs: every choice is drawn from its prior, from the random stream at its address.

use crate::Failure;
use crate::record::{Record, check_factor};
use crate::task::{Hosts, Task};
use niwaki_geom::Shape;
use niwaki_math::{Dist, StreamKey};
use niwaki_vm::builtins::draw_to_value;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::value::Value;

/// Draws choices from their priors and keeps the record.
pub struct Forward<'a> {
    /// The record so far.
    pub record: &'a mut Record,
    /// Random stream of the run: of a particle's lineage, of a sample's number.
    pub stream: StreamKey,
    /// Host functions.
    pub hosts: &'a dyn Hosts,
    /// Whether emits, factors and observations pause the run.
    pub barriers: bool,
    /// Whether the run goes on although its score is minus infinity.
    pub complete: bool,
}

impl Forward<'_> {
    #[inline(always)]
    fn barrier(&self) -> Answer<()> {
        if self.barriers || (self.record.cause.is_some() && !self.complete) {
            Answer::Pause
        } else {
            Answer::Go(())
        }
    }
}

/// What a person calls a factor.
pub(crate) fn factor_name(at: &At<'_, f64>, factor: Factor) -> String {
    named(factor, at.site.span.line)
}

/// What a person calls a factor of that kind at that line.
pub(crate) fn named(factor: Factor, line: u32) -> String {
    let what = match factor {
        Factor::Observe => "observe",
        Factor::Factor => "factor",
        Factor::Condition => "condition",
    };
    format!("`{what}` at line {line}")
}

impl Answers<f64> for Forward<'_> {
    #[inline(always)]
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let address = at.address();
        let (draw, log_density) = dist.sample_and_score(&mut self.stream.at(address));
        let value = draw_to_value(draw);
        self.record.choose(address, &value, log_density);
        Ok(Answer::Go(value))
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

    fn query(&mut self, _: &At<'_, f64>, _: &Value, _: &Value) -> Result<(), Fault> {
        Ok(())
    }

    fn host(&mut self, constant: u16, args: &[Value]) -> Result<Value, Fault> {
        self.hosts.call(constant, args)
    }
}

/// A finished run.
pub struct Sample {
    /// Its choices and score. A run that became impossible stopped there.
    pub record: Record,
    /// What the program returned (`None` when impossible).
    pub value: Value,
}

/// One forward run, depth first; unless it is to be `complete`, it stops when its score becomes minus infinity, or where a
/// distribution is invalid.
///
/// # Errors
/// A fault of the program.
pub fn forward(task: &Task, seed: u64, stream: u64, complete: bool) -> Result<Sample, Failure> {
    let mut machine = task.machine();
    let mut state = task.start(&machine, true)?;
    let mut record = Record::start(&task.sketches);
    let stream = StreamKey::new(seed, stream, 0);
    let hosts = &*task.hosts;
    while !state.has_ended() && (complete || record.cause.is_none()) {
        let Some(next) = state.runnable().first().copied() else {
            return Err(Box::new(machine.waiting_cycle(&state)).into());
        };
        let mut answers = Forward { record: &mut record, stream, hosts, barriers: false, complete };
        match machine.resume(&mut state, next, &mut answers) {
            Ok(_) => {}
            Err(met) if complete => return Err(met.into()),
            Err(met) => record.forgive(task, met)?,
        }
    }
    let value = if state.has_ended() { state.result() } else { Value::None };
    Ok(Sample { record, value })
}
