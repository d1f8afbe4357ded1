//! Gradients of a task: its log density over the continuous choices of one run.
//!
//! * [`follow`]: why that density refused a point;
//! * `hosted`: the host functions of a recorded run; `nested`: an inference inside of it, by enumeration;
//! * [`positions`]: where its shapes are, with their derivatives.

pub mod follow;
mod hosted;
mod nested;
pub mod positions;

use hosted::Hosted;
use niwaki_grad::{Live, Model, Recorded, Scope, Var};
use niwaki_math::Scalar;
use niwaki_run::Failure;
use niwaki_run::task::Task;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::sync::Arc;

/// A task in the form that can be recorded. Create it once for each task: it copies the program.
///
/// # Errors
/// A scene that sketches score: they count cells and pixels, which have no slope.
pub fn model(task: &Task) -> Result<Model, Failure> {
    if let Some(sketch) = task.sketches.first() {
        let name = sketch.name();
        return Err(Failure::Setting(
            Fault::new("sketch-without-slope", format!("the sketch `{name}` scores the scene by counting, which has no gradient"))
                .with_help("use `mh()` or particles for it, or say in the model with `factor` what the shapes should be like"),
        ));
    }
    recordable(task)
}

/// A task in the form that can be recorded, without its sketches.
fn recordable(task: &Task) -> Result<Model, Failure> {
    if task.model.is_some() {
        return Err(Fault::new("bad-kernel", "no gradient is followed within an `infer` of a model")
            .with_help("use `mh()` without `hmc_step()` and `nuts_step()` there")
            .into());
    }
    let program = Arc::new(task.program.over());
    let hosted = Hosted::new(program.clone(), task.hosts.clone(), task.limits);
    Ok(Model {
        program,
        args: task.args.iter().map(|arg| arg.convert(&Var::from_f64)).collect(),
        held: task.held.as_ref().map(|held| Arc::new(held.convert(&Var::from_f64))),
        limits: task.limits,
        host: Arc::new(move |constant, args: &[Value<Var>], steps: &mut u64| {
            hosted.call(constant, args, steps)
        }),
        scope: Scope::default(),
        invalid: task.invalid.clone(),
    })
}

/// The log density of a task around the run with these choices.
///
/// # Errors
/// A missing choice, an impossible run, an operation without a derivative on which the score depends, sketches.
pub fn record(task: &Task, choices: &HashMap<u128, Value>) -> Result<Recorded, Failure> {
    Ok(model(task)?.record(choices)?)
}

/// The log density of a task, recorded again wherever a trajectory leaves the path.
///
/// # Errors
/// As [`record`]; also a run without continuous choices.
pub fn live(task: &Task, choices: &HashMap<u128, Value>) -> Result<Live, Failure> {
    live_of(model(task)?, choices)
}

/// The log density of a model, recorded again wherever a trajectory leaves the path.
pub fn live_of(model: Model, choices: &HashMap<u128, Value>) -> Result<Live, Failure> {
    let recorded = model.record(choices)?;
    if recorded.dim() == 0 {
        return Err(nothing_continuous().into());
    }
    Ok(Live::new(model, recorded))
}

/// The fault of a run without continuous choices.
#[cold]
pub fn nothing_continuous() -> Fault {
    Fault::new("no-continuous-choices", "this run makes no continuous choices")
        .with_help("use `mh()`, which moves discrete choices")
}
