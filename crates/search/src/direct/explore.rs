//! Chains of a task that follow its gradient, each from a possible run.
//!
//! Discrete choices and the structure stay as in that run: a point at which the run would make other choices is
//! refused, and its trajectory rejected.

use super::rows;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_continuous::hamiltonian::chains::{GLANCE, run};
use niwaki_continuous::hamiltonian::climb::climb_in_lanes;
use niwaki_continuous::hamiltonian::potential::evaluate;
use niwaki_continuous::hamiltonian::{Cause, Chain, Draws, Metric, Settings, lanes};
use niwaki_grad::{Continuous, Live, Model, Recorded, Wide};
use niwaki_propose::gradient::follow::reason;
use niwaki_propose::gradient::{live_of, model};
use niwaki_run::replay::{Choice, Missing, Source, replay};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The draws of a chain.
pub struct Explored {
    /// The draws, in coordinates.
    pub draws: Draws,
    /// A recording of the chain's structure.
    pub recorded: Arc<Recorded>,
    /// The fixed choices, with names, without choices that have a single possible value.
    pub fixed: Vec<Choice>,
    /// The values of the continuous choices by rows, `(draws, sum of widths)`.
    pub numbers: Vec<f64>,
    /// The fault of the first trajectory after warm-up that reached a point without a finite gradient.
    pub fault: Option<Box<RunFault>>,
}

impl Explored {
    /// The continuous choices.
    pub fn choices(&self) -> &[Continuous] {
        &self.recorded.choices
    }

    /// The number of numbers in the continuous choices of a draw.
    pub fn width(&self) -> usize {
        rows::width(&self.recorded)
    }

    /// The log density of the choices of each draw without Jacobians, and its factors and observations, nats, by running
    /// the program.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn scores(&self, task: &Task) -> Result<Vec<(f64, f64)>, Failure> {
        rows::scores(task, &self.recorded, &self.numbers, self.draws.len())
    }
}

/// The settings of a search.
pub struct Plan<'a> {
    /// The settings of each chain's moves.
    pub settings: &'a Settings,
    /// The seed of all random numbers.
    pub seed: u64,
    /// The number of chains.
    pub chains: usize,
    /// Most forward runs for the start of each chain.
    pub tries: u64,
    /// Known values of choices at the start.
    pub known: Option<&'a HashMap<u128, Value>>,
}

/// The number of lanes if each thread has at least as many chains, and the number if it has fewer.
const MANY: usize = 64;
const FEW: usize = 16;
/// Least number of chains in lanes; fewer run alone, with machine code, since empty lanes cost as much as full lanes.
const LEAST: usize = 12;

/// A chain before it runs.
pub(super) struct Member {
    pub(super) number: usize,
    pub(super) target: Live,
    /// The path of the first run, which the target may leave.
    pub(super) recorded: Arc<Recorded>,
    /// The coordinates of that run.
    pub(super) start: Vec<f64>,
}

/// Draws from a task's distribution. `watch` is called regularly with the number of transitions of all chains; when it
/// returns false, the chains end with their draws so far.
///
/// Chains run in [`lanes`] if each thread has at least a dozen of one structure, with trajectories of a fixed length and a metric
/// of scales. Their draws equal those of single chains to the bit.
///
/// # Errors
/// Sketches, a run without continuous choices, no possible start, an operation without a derivative that the score
/// depends on, a start without a finite gradient, a fault of the program.
pub fn explore(
    task: &Task,
    plan: &Plan<'_>,
    watch: &(dyn Fn(u64) -> bool + Sync),
) -> Result<Vec<Explored>, Failure> {
    let (model, done) = (model(task)?, AtomicU64::new(0));
    if plan.chains == 0 {
        return Ok(vec![]);
    }
    let from = |number: usize, first: Option<&Live>| {
        let streams = Streams::new(plan.seed, number as u64);
        start(task, &model, streams, (plan.tries, plan.known), number, first)
    };
    let first = from(0, None)?;
    if let Some(metric) = &plan.settings.metric {
        fits(metric, first.start.len())?;
    }
    let members_after: Vec<Result<Member, Failure>> =
        (1..plan.chains).into_par_iter().map(|number| from(number, Some(&first.target))).collect();
    let mut members = vec![Some(first)];
    for other in members_after {
        members.push(Some(other?));
    }
    let groups: Vec<Vec<Member>> = grouped(plan.settings, &members)
        .into_iter()
        .map(|group| group.into_iter().filter_map(|k| members[k].take()).collect())
        .collect();
    let look = || watch(done.fetch_add(GLANCE, Ordering::Relaxed) + GLANCE);
    let explored: Vec<Result<Vec<(usize, Explored)>, Failure>> =
        groups.into_par_iter().map(|group| together(task, plan, group, &look)).collect();
    let mut explored: Vec<(usize, Explored)> =
        explored.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    explored.sort_by_key(|(number, _)| *number);
    Ok(explored.into_iter().map(|(_, chain)| chain).collect())
}

/// Refuses a metric with another number of coordinates.
fn fits(metric: &Metric, dim: usize) -> Result<(), Failure> {
    if metric.dim() == dim {
        return Ok(());
    }
    let message = format!("the `metric` is of {} coordinates, but there are {dim}", metric.dim());
    Err(Fault::new("bad-setting", message)
        .with_help("give the `metric` of a result of `vi` of this model")
        .into())
}

/// Groups of chains that move together: chains of one structure, in lanes; every other chain alone.
fn grouped(settings: &Settings, members: &[Option<Member>]) -> Vec<Vec<usize>> {
    let mut by_structure: Vec<(u128, Vec<usize>)> = Vec::new();
    for (k, member) in members.iter().enumerate() {
        let structure = member.as_ref().map_or(0, |member| member.recorded.structure);
        match by_structure.iter_mut().find(|(key, _)| *key == structure) {
            Some((_, group)) => group.push(k),
            None => by_structure.push((structure, vec![k])),
        }
    }
    let mut groups = Vec::new();
    for (_, chains) in by_structure {
        let each = chains.len().div_ceil(rayon::current_num_threads());
        let alone = !lanes::suits(settings) || each < LEAST;
        // All chains of a thread in lanes: when an ascent has ended, the next one takes its lane.
        groups.extend(chains.chunks(if alone { 1 } else { each }).map(<[usize]>::to_vec));
    }
    groups
}

/// Most possible runs without a finite gradient; the last becomes the start, and its fault is reported.
const STARTS: u64 = 100;

/// The density around a chain's first run: the first possible run of at most `tries` that has the known values and a finite
/// gradient. If the run is on the path of the first chain, the density is that of the first chain.
pub(super) fn start(
    task: &Task,
    model: &Model,
    streams: Streams,
    (tries, known): (u64, Option<&HashMap<u128, Value>>),
    number: usize,
    first: Option<&Live>,
) -> Result<Member, Failure> {
    let (mut forward_runs, mut attempt) = (0, 0);
    let mut last: Option<(Member, HashMap<u128, Value>)> = None;
    loop {
        attempt += 1;
        let (state, runs) = match State::tried_after(task, streams, forward_runs, tries.max(1), known) {
            Ok((state, _, runs)) => (state, runs),
            // No further run is possible.
            Err(failure) => return last.map(|(member, _)| member).ok_or(failure),
        };
        forward_runs = runs;
        let choices = state.choices(&task.program).collect();
        drop(state);
        // The run is that of the last attempt, so no choice is drawn anew.
        if let Some((member, _)) = last.take_if(|(_, before)| *before == choices) {
            return Ok(member);
        }
        let (mut target, start) = match first.and_then(|first| first.beside(&choices)) {
            Some(pair) => pair,
            None => {
                let live = live_of(model.clone(), &choices)?;
                let start = live.recorded().start.clone();
                (live, start)
            }
        };
        let recorded = target.recorded().clone();
        let is_sound = match evaluate(&mut target, &start, &mut vec![0.0; start.len()]) {
            Err(stop) => stop.cause != Cause::NotFinite,
            Ok(_) => true,
        };
        let member = Member { number, target, recorded, start };
        if is_sound || forward_runs >= tries || attempt == STARTS {
            return Ok(member);
        }
        last = Some((member, choices));
    }
}

/// Runs the chains of a group.
fn together(
    task: &Task,
    plan: &Plan<'_>,
    group: Vec<Member>,
    look: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<(usize, Explored)>, Failure> {
    match group.len() {
        ..LEAST => alone(task, plan, group, look),
        LEAST..MANY => in_lanes::<FEW>(task, plan, group, look),
        _ => in_lanes::<MANY>(task, plan, group, look),
    }
}

/// Runs chains one after another.
fn alone(
    task: &Task,
    plan: &Plan<'_>,
    group: Vec<Member>,
    look: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<(usize, Explored)>, Failure> {
    let go = |Member { number, mut target, recorded, start }| {
        let chain = Chain::new(&mut target, &start, plan.settings, plan.seed, number as u64);
        let draws = chain.map(|chain| run(chain, plan.settings, &|_| look()));
        let Ok(draws) = draws else { return Err(no_slope(&target, &start)) };
        Ok((number, explored(task, target, recorded, &start, draws)?))
    };
    group.into_iter().map(go).collect()
}

/// Runs chains in lanes.
fn in_lanes<const L: usize>(
    task: &Task,
    plan: &Plan<'_>,
    mut group: Vec<Member>,
    look: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<(usize, Explored)>, Failure> {
    let mut wide = Wide::<L>::new(&group[0].recorded.density);
    let mut tops: Vec<Vec<f64>> = group.iter().map(|member| member.start.clone()).collect();
    let climbed = {
        let mut targets: Vec<&mut Live> = group.iter_mut().map(|member| &mut member.target).collect();
        let mut tops: Vec<&mut Vec<f64>> = tops.iter_mut().collect();
        climb_in_lanes(&mut targets, &mut tops, &mut wide, plan.settings.climb)
    };
    let mut chains = Vec::with_capacity(group.len());
    let mut first_failure = None;
    for (at, (Member { number, target, .. }, top)) in group.iter_mut().zip(&tops).enumerate() {
        match Chain::on_top(target, top, climbed[at], plan.settings, plan.seed, *number as u64) {
            Ok(chain) => chains.push(chain),
            Err(_) => first_failure = first_failure.or(Some(at)),
        }
    }
    if let Some(at) = first_failure {
        drop(chains);
        return Err(no_slope(&group[at].target, &group[at].start));
    }
    // Groups of equal size, so that no small group remains.
    let even = chains.len().div_ceil(chains.len().div_ceil(L));
    let mut chains = chains.into_iter().peekable();
    let mut draws = Vec::with_capacity(chains.len());
    while chains.peek().is_some() {
        let some = chains.by_ref().take(even).collect();
        draws.extend(lanes::run_in_lanes(some, &mut wide, plan.settings, &|_, _| look()));
    }
    let ends = group.into_iter().zip(draws);
    ends.map(|(Member { number, target, recorded, start }, draws)| {
        Ok((number, explored(task, target, recorded, &start, draws)?))
    })
    .collect()
}

/// The draws of a chain, with the values of its choices.
fn explored(
    task: &Task,
    mut target: Live,
    recorded: Arc<Recorded>,
    start: &[f64],
    draws: Draws,
) -> Result<Explored, Failure> {
    let stopped = |cause| draws.divergences.iter().find(move |d| d.stop.is_some_and(|s| s.cause == cause));
    let fault = stopped(Cause::NotFinite).and_then(|divergence| reason(&target, &divergence.end));
    let mut numbers = Vec::new();
    let mut slope = vec![0.0; target.dim()];
    for (draw, x) in draws.rows().enumerate() {
        // The path of the point gives the values at its coordinates.
        let on_path = target.gradient(x, &mut slope).is_ok();
        debug_assert!(on_path, "draw {draw} is a point of the density");
        numbers.extend(target.recorded().numbers(x));
    }
    let fixed = fixed(task, &recorded, start)?;
    Ok(Explored { fixed, numbers, fault, draws, recorded })
}

/// The fixed choices of a recorded run, with names.
fn fixed(task: &Task, recorded: &Recorded, start: &[f64]) -> Result<Vec<Choice>, Failure> {
    if recorded.fixed.is_empty() {
        return Ok(vec![]);
    }
    let trace = replay(task, Source::Addresses(recorded.values(start)), Missing::Refuse)?;
    let is_fixed = |choice: &Choice| recorded.fixed.iter().any(|(address, _)| *address == choice.address);
    Ok(trace.choices.into_iter().filter(is_fixed).collect())
}

/// The reason why a chain could not start.
pub(super) fn no_slope(target: &Live, start: &[f64]) -> Failure {
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
