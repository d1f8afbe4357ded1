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
use crate::hamiltonian::{Cause, Chain, Draws, Settings, lanes};
use crate::replay::{Choice, Missing, Source, Trace, by_address, replay};
use crate::{Failure, Task};
use niwaki_grad::{Continuous, Live, Model, Recorded, Wide};
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

    /// Of each draw, by running it: the log density of its choices without Jacobians, and its factors and observations,
    /// nats.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn scores(&self, task: &Task) -> Result<Vec<(f64, f64)>, Failure> {
        let score = |draw| {
            let trace = self.trace(task, draw).unwrap_or_else(|| unreachable!("a draw of this chain"))?;
            Ok((trace.record.log_prior, trace.record.log_score()))
        };
        (0..self.draws.len()).into_par_iter().map(score).collect()
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

/// Lanes of chains that move together, where each thread has so many of them, and where it has fewer.
const MANY: usize = 64;
const FEW: usize = 16;
/// Fewer chains go alone, each with machine code: empty lanes cost as much as full ones.
const LEAST: usize = 12;

/// Draws from a task's distribution. `watch` is told the transitions of all chains now and then; when it answers false,
/// they end with what they have.
///
/// Where each thread has a dozen chains or more of one structure, with trajectories of a fixed length and a metric of
/// scales, they go in [`lanes`]. They draw the same there, to the bit, as alone.
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
    let targets: Vec<Result<Live, Failure>> = (0..plan.chains as u64)
        .into_par_iter()
        .map(|number| start(task, model.clone(), plan, number))
        .collect();
    let mut targets: Vec<Option<Live>> =
        targets.into_iter().map(|t| t.map(Some)).collect::<Result<_, _>>()?;
    let groups: Vec<Vec<(usize, Live)>> = grouped(plan.settings, &targets)
        .into_iter()
        .map(|group| group.into_iter().filter_map(|k| Some((k, targets[k].take()?))).collect())
        .collect();
    let look = || watch(done.fetch_add(GLANCE, Ordering::Relaxed) + GLANCE);
    let found: Vec<Result<Vec<(usize, Explored)>, Failure>> =
        groups.into_par_iter().map(|group| together(task, plan, group, &look)).collect();
    let mut found: Vec<(usize, Explored)> =
        found.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    found.sort_by_key(|(number, _)| *number);
    Ok(found.into_iter().map(|(_, explored)| explored).collect())
}

/// Chains that move together: those of one structure, in lanes; the others each alone.
fn grouped(settings: &Settings, targets: &[Option<Live>]) -> Vec<Vec<usize>> {
    let mut alike: Vec<(u128, Vec<usize>)> = Vec::new();
    for (k, target) in targets.iter().enumerate() {
        let structure = target.as_ref().map_or(0, |target| target.recorded().structure);
        match alike.iter_mut().find(|(key, _)| *key == structure) {
            Some((_, group)) => group.push(k),
            None => alike.push((structure, vec![k])),
        }
    }
    let mut groups = Vec::new();
    for (_, chains) in alike {
        let each = chains.len().div_ceil(rayon::current_num_threads());
        let lanes = match each {
            _ if !lanes::suits(settings) => 1,
            MANY.. => MANY,
            LEAST.. => FEW,
            _ => 1,
        };
        groups.extend(chains.chunks(lanes).map(<[usize]>::to_vec));
    }
    groups
}

/// The density around a chain's first run.
fn start(task: &Task, model: Model, plan: &Plan<'_>, number: u64) -> Result<Live, Failure> {
    let (state, _) = State::start(task, Streams::new(plan.seed, number), plan.tries, plan.known)?;
    let choices = by_address(&Snapshot::of(&state, &task.program, 0).log.entries());
    drop(state);
    live_of(model, &choices)
}

/// Runs the chains of a group, by their numbers.
fn together(
    task: &Task,
    plan: &Plan<'_>,
    mut group: Vec<(usize, Live)>,
    look: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<(usize, Explored)>, Failure> {
    let starts: Vec<Arc<Recorded>> = group.iter().map(|(_, target)| target.recorded().clone()).collect();
    let mut chains = Vec::with_capacity(group.len());
    let mut refused = None;
    for (at, ((number, target), recorded)) in group.iter_mut().zip(&starts).enumerate() {
        match Chain::new(target, &recorded.start, plan.settings, plan.seed, *number as u64) {
            Ok(chain) => chains.push(chain),
            Err(_) => refused = refused.or(Some(at)),
        }
    }
    if let Some(at) = refused {
        drop(chains);
        return Err(no_slope(&group[at].1, &starts[at].start));
    }
    let draws = if chains.len() < LEAST {
        chains.into_iter().map(|chain| run(chain, plan.settings, &|_| look())).collect()
    } else if chains.len() <= FEW {
        let mut wide = Wide::<FEW>::new(&starts[0].density);
        lanes::run_in_lanes(chains, &mut wide, plan.settings, &|_, _| look())
    } else {
        let mut wide = Wide::<MANY>::new(&starts[0].density);
        lanes::run_in_lanes(chains, &mut wide, plan.settings, &|_, _| look())
    };
    let ends = group.into_iter().zip(starts).zip(draws);
    ends.map(|(((number, target), recorded), draws)| Ok((number, explored(task, target, recorded, draws)?)))
        .collect()
}

/// What a chain found, with values for its coordinates.
fn explored(
    task: &Task,
    mut target: Live,
    recorded: Arc<Recorded>,
    draws: Draws,
) -> Result<Explored, Failure> {
    let stopped = |cause| draws.divergences.iter().find(move |d| d.stop.is_some_and(|s| s.cause == cause));
    let fault = stopped(Cause::NotFinite).and_then(|divergence| reason(&target, &divergence.end));
    let mut numbers = Vec::new();
    let mut slope = vec![0.0; target.dim()];
    for (draw, x) in draws.rows().enumerate() {
        // Values follow from coordinates by the path that the point is on.
        let on_path = target.gradient(x, &mut slope).is_ok();
        debug_assert!(on_path, "draw {draw} is a point of the density");
        numbers.extend(target.recorded().numbers(x));
    }
    let fixed = fixed(task, &recorded)?;
    Ok(Explored { fixed, numbers, recordings: target.recordings(), fault, draws, recorded })
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
