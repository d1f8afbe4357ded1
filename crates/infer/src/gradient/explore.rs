//! Chains of a task that follow its gradient, each from a possible run of its own.
//!
//! What is discrete keeps the value that it has in that run, and so does the structure: a point at which the run would
//! make other choices is refused, and its trajectory rejected.

use super::follow::reason;
use super::{live_of, model};
use crate::chain::snapshot::Snapshot;
use crate::chain::state::State;
use crate::chain::streams::Streams;
use crate::hamiltonian::chains::{GLANCE, run};
use crate::hamiltonian::{Cause, Chain, Draws, Settings};
use crate::replay::{Choice, Missing, Source, Trace, by_address, replay};
use crate::{Failure, Task};
use niwaki_grad::{Continuous, Live, Model, Recorded};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What one chain found.
pub struct Explored {
    /// Where it came through, in coordinates.
    pub draws: Draws,
    /// A recording of its structure.
    pub recorded: Arc<Recorded>,
    /// The choices that were held fixed, with names. Those of one value are not among them.
    pub fixed: Vec<Choice>,
    /// The values of the continuous choices by rows, `(draws, sum of widths)`.
    pub numbers: Vec<f64>,
    /// Log densities of the choices of each draw, nats, without Jacobians.
    pub log_prior: Vec<f64>,
    /// Factors and observations of each draw, nats.
    pub log_score: Vec<f64>,
    /// How often the program was recorded.
    pub recordings: usize,
    /// What the first trajectory met, after warm-up, that came to a point without a finite gradient.
    pub fault: Option<Box<RunFault>>,
}

impl Explored {
    /// The continuous choices.
    pub fn choices(&self) -> &[Continuous] {
        &self.recorded.choices
    }

    /// How many numbers the continuous choices of a draw have.
    pub fn width(&self) -> usize {
        self.choices().iter().map(Continuous::width).sum()
    }

    /// The run of a draw; `None` where there is no such draw.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn trace(&self, task: &Task, draw: usize) -> Option<Result<Trace, Failure>> {
        let width = self.width();
        let numbers = self.numbers.get(draw * width..(draw + 1) * width)?;
        let source = Source::Addresses(self.recorded.values_of(numbers));
        Some(replay(task, source, Missing::Refuse))
    }
}

/// What is asked for.
pub struct Plan<'a> {
    /// How each chain moves.
    pub settings: &'a Settings,
    /// Decides every random number.
    pub seed: u64,
    /// How many chains.
    pub chains: usize,
    /// Most forward runs for the start of each.
    pub tries: u64,
    /// Values of choices at the start, where they are known.
    pub known: Option<&'a HashMap<u128, Value>>,
}

/// Draws from a task's distribution. `watch` is told the transitions of all chains now and then; when it answers false,
/// they end with what they have.
///
/// # Errors
/// Sketches, a run without continuous choices, no possible start, an operation without a derivative on the way to the
/// score, a start without a finite gradient, a fault of the program.
pub fn explore(
    task: &Task,
    plan: &Plan<'_>,
    watch: &(dyn Fn(u64) -> bool + Sync),
) -> Result<Vec<Explored>, Failure> {
    let (model, done) = (model(task)?, AtomicU64::new(0));
    let chains: Vec<Result<Explored, Failure>> = (0..plan.chains as u64)
        .into_par_iter()
        .map(|number| {
            one(task, model.clone(), plan, number, &|| {
                watch(done.fetch_add(GLANCE, Ordering::Relaxed) + GLANCE)
            })
        })
        .collect();
    chains.into_iter().collect()
}

fn one(
    task: &Task,
    model: Model,
    plan: &Plan<'_>,
    number: u64,
    watch: &dyn Fn() -> bool,
) -> Result<Explored, Failure> {
    let (state, _) = State::start(task, Streams::new(plan.seed, number), plan.tries, plan.known)?;
    let choices = by_address(&Snapshot::of(&state, &task.program, 0).log.entries());
    drop(state);
    let mut target = live_of(model, &choices)?;
    let recorded = target.recorded().clone();
    let started = Chain::new(&mut target, &recorded.start, plan.settings, plan.seed, number);
    let Ok(chain) = started else { return Err(no_slope(&target, &recorded.start)) };
    let draws = run(chain, plan.settings, &|_| watch());
    let stopped = |cause| draws.divergences.iter().find(move |d| d.stop.is_some_and(|s| s.cause == cause));
    let fault = stopped(Cause::NotFinite).and_then(|divergence| reason(&target, &divergence.end));
    let mut found = Explored {
        fixed: fixed(task, &recorded)?,
        numbers: vec![],
        log_prior: vec![],
        log_score: vec![],
        recordings: 0,
        fault,
        draws,
        recorded,
    };
    let mut slope = vec![0.0; target.dim()];
    for (draw, x) in found.draws.rows().enumerate() {
        // Values follow from coordinates by the path that the point is on.
        let on_path = target.value_and_gradient(x, &mut slope).is_ok();
        debug_assert!(on_path, "draw {draw} is a point of the density");
        let numbers = target.recorded().numbers(x);
        let source = Source::Addresses(target.recorded().values_of(&numbers));
        let trace = replay(task, source, Missing::Refuse)?;
        found.numbers.extend(numbers);
        found.log_prior.push(trace.record.log_prior);
        found.log_score.push(trace.record.log_score());
    }
    found.recordings = target.recordings();
    Ok(found)
}

/// The fixed choices of a recorded run by name.
fn fixed(task: &Task, recorded: &Recorded) -> Result<Vec<Choice>, Failure> {
    if recorded.fixed.is_empty() {
        return Ok(vec![]);
    }
    let trace = replay(task, Source::Addresses(recorded.values(&recorded.start)), Missing::Refuse)?;
    let is_fixed = |choice: &Choice| recorded.fixed.iter().any(|(address, _)| *address == choice.address);
    Ok(trace.choices.into_iter().filter(is_fixed).collect())
}

/// Why a chain could not start where it was put.
fn no_slope(target: &Live, start: &[f64]) -> Failure {
    match reason(target, start) {
        Some(fault) => Failure::Run(fault),
        None => Failure::Setting(
            Fault::new(
                "non-finite-gradient",
                "the log density at the start of a chain has no finite gradient",
            )
            .with_help("start from other `choices`"),
        ),
    }
}
