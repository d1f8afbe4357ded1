//! Normal approximations of a task's distribution, over the coordinates of its continuous choices, with draws from them.
//!
//! The task must have one structure: equal continuous choices in each run, and no discrete choices. A task whose structure
//! proves to change is refused.

use super::explore::{Member, start};
use super::rows;
use niwaki_chain::walk::streams::Streams;
use niwaki_continuous::hamiltonian::Potential;
use niwaki_continuous::hamiltonian::potential::evaluate;
pub use niwaki_continuous::variational::Start;
use niwaki_continuous::variational::ascent::{Broke, Settings, ascend, counts};
use niwaki_continuous::variational::family::Family;
use niwaki_continuous::variational::pathfinder::{NoPath, Path, pathfinder};
use niwaki_continuous::variational::{Batch, LANES, Normal, Purpose, Row, mixture};
use niwaki_grad::{Continuous, Live, Recorded, Transform, Wide};
use niwaki_math::Stream;
use niwaki_propose::gradient::follow::reason;
use niwaki_propose::gradient::model;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The settings of a search.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    /// The family of an ascent; none for the normals of paths.
    pub family: Option<Family>,
    /// The start of an ascent.
    pub start: Start,
    /// Draws of each result.
    pub draws: usize,
    /// Most steps of an ascent.
    pub steps: u32,
    /// Draws of each step.
    pub samples: usize,
    /// Least gain of a round, nats; with less, the ascent ends.
    pub tolerance: f64,
    /// The number of paths.
    pub paths: usize,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Most forward runs for the start of each path.
    pub tries: u64,
    /// Known values of choices at the start.
    pub known: Option<&'a HashMap<u128, Value>>,
}

/// A normal with its draws.
pub struct Approximated {
    /// The normal.
    pub normal: Normal,
    /// A recording of the structure.
    pub recorded: Arc<Recorded>,
    /// The draws of positive density by rows, in coordinates, `(n, dim)`.
    pub x: Vec<f64>,
    /// The values of the draws' choices by rows, `(n, sum of widths)`.
    pub numbers: Vec<f64>,
    /// The draws' log densities over coordinates, nats.
    pub log_density: Vec<f64>,
    /// The draws' log densities under the normal, nats; if a coordinate is an angle, on the circle.
    pub log_own: Vec<f64>,
    /// The draws' log densities under equal shares of all normals, nats, for the weights.
    pub log_proposal: Vec<f64>,
    /// The standard normal numbers of the draws by rows, `(n, dim)`.
    pub z: Vec<f64>,
    /// The slopes of the log weights, `log_density - log_own`, by the standard normal numbers, `(n, dim)`.
    pub slopes: Vec<f64>,
    /// The bound of the path's normal at the start of an ascent, by other draws, and its standard error, nats.
    pub path_bound: Option<(f64, f64)>,
    /// Draws of density zero, or without a finite density.
    pub impossible: usize,
    /// The estimates of the bound at each step, nats.
    pub bounds: Vec<f64>,
    /// The step of a path whose normal this is.
    pub best: Option<usize>,
    /// Whether an ascent ended by its tolerance; true for a path.
    pub converged: bool,
    /// The point where an ascent broke off.
    pub broke: Option<Broke>,
    /// The fault at this point.
    pub fault: Option<Box<RunFault>>,
    /// Whether the search was stopped before its end.
    pub interrupted: bool,
    /// The number of gradients.
    pub gradients: u64,
}

impl Approximated {
    /// The continuous choices.
    pub fn choices(&self) -> &[Continuous] {
        &self.recorded.choices
    }

    /// The number of numbers in the choices of a draw.
    pub fn width(&self) -> usize {
        rows::width(&self.recorded)
    }

    /// The log density of the choices of each draw without Jacobians, and its factors and observations, nats, by running
    /// the program.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn scores(&self, task: &Task) -> Result<Vec<(f64, f64)>, Failure> {
        rows::scores(task, &self.recorded, &self.numbers, self.log_density.len())
    }
}

/// A path, with the member that followed it.
struct MemberPath {
    member: Member,
    path: Path,
    gradients: u64,
}

/// Approximates a task's distribution by the normal of an ascent of the bound, or by a normal for each path. `watch`
/// is called regularly with the number of steps of all; when it returns false, they end with the best so far.
///
/// # Errors
/// Discrete choices, a structure that changes, sketches, no possible start, an operation without a derivative that the
/// score depends on, a start without a finite gradient, a fault of the program.
pub fn approximate(
    task: &Task,
    plan: &Plan<'_>,
    watch: &(dyn Fn(u64) -> bool + Sync),
) -> Result<Vec<Approximated>, Failure> {
    let (model, done) = (model(task)?, AtomicU64::new(0));
    let look = |_: u32| watch(done.fetch_add(1, Ordering::Relaxed) + 1);
    let run = |number: usize, first: Option<&Live>| {
        let streams = Streams::new(plan.seed, number as u64);
        let member = start(task, &model, streams, (plan.tries, plan.known), number, first)?;
        one_structure(&member.recorded, first.map(|first| &**first.recorded())).map(|()| member)
    };
    let first = run(0, None)?;
    let is_run = plan.family.is_some() && plan.start == Start::Run;
    let count = if is_run { 1 } else { plan.paths.max(1) };
    let members_after: Vec<Result<Member, Failure>> =
        (1..count).into_par_iter().map(|number| run(number, Some(&first.target))).collect();
    let mut members = vec![first];
    for other in members_after {
        members.push(other?);
    }
    if is_run {
        let member = members.swap_remove(0);
        let normal = Normal::diagonal(member.start.clone(), vec![NARROW; member.start.len()]);
        return Ok(vec![climbed(plan, member, &normal, 0, &look)?]);
    }
    let paths: Vec<Result<MemberPath, Failure>> =
        members.into_par_iter().map(|member| follow(plan, member, &look)).collect();
    let mut paths = paths.into_iter().collect::<Result<Vec<_>, _>>()?;
    if plan.family.is_none() {
        let ends = paths.into_par_iter().map(|member_path| {
            let MemberPath { member, path, gradients } = member_path;
            let (best, angles) = (Some(path.best), angles(&member.recorded));
            let normal = path.normal.in_order(&angles).unwrap_or(path.normal);
            let fit = Fit { normal, bounds: path.bounds, best, converged: true, broke: None };
            drawn(plan, member, fit, path.interrupted, gradients)
        });
        let mut all = ends.collect::<Vec<_>>().into_iter().collect::<Result<Vec<_>, _>>()?;
        weigh_together(&mut all);
        return Ok(all);
    }
    let height = |member_path: &MemberPath| member_path.path.bounds[member_path.path.best];
    let best =
        (0..paths.len()).fold(0, |best, k| if height(&paths[k]) > height(&paths[best]) { k } else { best });
    let gradients = paths.iter().map(|member_path| member_path.gradients).sum();
    let MemberPath { member, path, .. } = paths.swap_remove(best);
    Ok(vec![climbed(plan, member, &path.normal, gradients, &look)?])
}

/// The first coordinates of choices that are angles, by which the density repeats every turn.
fn angles(recorded: &Recorded) -> Vec<usize> {
    let angle = |choice: &&Continuous| choice.transform == Transform::Circle;
    recorded.choices.iter().filter(angle).map(|choice| choice.first).collect()
}

/// Computes the densities of the draws of several normals under all of these normals together.
fn weigh_together(all: &mut [Approximated]) {
    if all.len() < 2 {
        return;
    }
    let angles = angles(&all[0].recorded);
    let normals: Vec<&Normal> = all.iter().map(|approximated| &approximated.normal).collect();
    let dim = normals[0].dim();
    let together = |normal: &Approximated| -> Vec<f64> {
        let mut logs = Vec::with_capacity(normal.log_own.len());
        for some in normal.x.chunks(LANES * dim.max(1)) {
            let count = some.len() / dim.max(1);
            // Empty lanes repeat the first draw.
            let entry = |k: usize, l: usize| some[if l < count { l * dim } else { 0 } + k];
            let x: Vec<Row> = (0..dim).map(|k| std::array::from_fn(|l| entry(k, l))).collect();
            logs.extend_from_slice(&mixture::log_density(&normals, &angles, &x)[..count]);
        }
        logs
    };
    let logs: Vec<Vec<f64>> = all.par_iter().map(together).collect();
    all.iter_mut().zip(logs).for_each(|(approximated, logs)| approximated.log_proposal = logs);
}

/// Number of draws for comparing a fit with the normal of its path.
const COMPARED: usize = 256;

/// The bound of a normal, and its standard error, nats; `None` if a draw has no finite density.
fn bound<P: Potential, W: niwaki_continuous::hamiltonian::lanes::Wide<LANES>>(
    batch: &mut Batch<'_, P, W>,
    normal: &Normal,
    mut stream: Stream,
) -> Result<Option<(f64, f64)>, Failure> {
    let Some(normal) = normal.in_order(&batch.angles) else { return Ok(None) };
    let none: Vec<Row> = vec![[0.0; LANES]; normal.dim()];
    let (mut z, mut x, mut g, mut ratios) = (none.clone(), none.clone(), none, Vec::with_capacity(COMPARED));
    for count in counts(COMPARED) {
        normal.draw(&mut stream, &mut z, &mut x);
        let values = batch.evaluate(&x, &mut g, count).map_err(|_| elsewhere())?;
        let log_normal = normal.log_density_around(&z, &batch.angles);
        ratios.extend(values.iter().zip(log_normal).take(count).map(|(p, q)| p - q));
    }
    let count = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let variance = ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / (count - 1.0);
    Ok(mean.is_finite().then_some((mean, (variance / count).sqrt())))
}

/// The deviations of the first normal around a run, in coordinates.
const NARROW: f64 = 0.1;

/// Refuses discrete choices, and a structure other than the first.
fn one_structure(recorded: &Recorded, first: Option<&Recorded>) -> Result<(), Failure> {
    if !recorded.fixed.is_empty() {
        return Err(unsuited("makes discrete choices").into());
    }
    if first.is_some_and(|first| first.structure != recorded.structure) {
        return Err(elsewhere());
    }
    Ok(())
}

#[cold]
fn elsewhere() -> Failure {
    unsuited("does not make the same choices in every run").into()
}

fn unsuited(reason_text: &str) -> Fault {
    Fault::new("no-normal-fits", reason_text)
}

fn no_path(failure: &NoPath, live: &Live, start: &[f64]) -> Failure {
    match failure {
        NoPath::Elsewhere => elsewhere(),
        NoPath::Start(_) => super::explore::no_slope(live, start),
    }
}

/// Follows the path from a run.
fn follow(
    plan: &Plan<'_>,
    mut member: Member,
    look: &(dyn Fn(u32) -> bool + Sync),
) -> Result<MemberPath, Failure> {
    let mut wide = Wide::<LANES>::new(&member.recorded.density);
    let mut batch = Batch::new(&mut member.target, &mut wide).around(angles(&member.recorded));
    let path = pathfinder(&mut batch, &member.start, plan.seed, member.number as u64, &|step| look(step));
    let gradients = batch.gradients;
    match path {
        Ok(path) => Ok(MemberPath { member, path, gradients }),
        Err(failure) => Err(no_path(&failure, &member.target, &member.start)),
    }
}

/// Ascends the bound from a normal, and draws.
fn climbed(
    plan: &Plan<'_>,
    mut member: Member,
    from: &Normal,
    gradients: u64,
    look: &(dyn Fn(u32) -> bool + Sync),
) -> Result<Approximated, Failure> {
    let family = plan.family.unwrap_or(Family::MeanField);
    let settings = Settings { family, steps: plan.steps, samples: plan.samples, tolerance: plan.tolerance };
    let mut wide = Wide::<LANES>::new(&member.recorded.density);
    let mut batch = Batch::new(&mut member.target, &mut wide).around(angles(&member.recorded));
    let path_bound = match plan.start {
        Start::Pathfinder => {
            let stream = Stream::new(plan.seed, member.number as u64, Purpose::Compare as u128, 0);
            bound(&mut batch, from, stream)?
        }
        Start::Run => None,
    };
    let ascent = ascend(&mut batch, from, &settings, plan.seed, member.number as u64, &|step| look(step));
    let gradients = gradients + batch.gradients;
    let ascent = ascent.map_err(|_| elsewhere())?;
    let fit = Fit {
        normal: ascent.normal,
        bounds: ascent.bounds,
        best: None,
        converged: ascent.converged,
        broke: ascent.broke,
    };
    let approximated = drawn(plan, member, fit, ascent.interrupted, gradients)?;
    Ok(Approximated { path_bound, ..approximated })
}

/// A normal, and the report of its search.
struct Fit {
    normal: Normal,
    bounds: Vec<f64>,
    best: Option<usize>,
    converged: bool,
    broke: Option<Broke>,
}

/// Draws from a normal.
fn drawn(
    plan: &Plan<'_>,
    member: Member,
    fit: Fit,
    interrupted: bool,
    gradients: u64,
) -> Result<Approximated, Failure> {
    let Member { number, mut target, recorded, .. } = member;
    let Fit { normal, bounds, best, converged, broke } = fit;
    let dim = normal.dim();
    let mut stream = Stream::new(plan.seed, number as u64, Purpose::Draw as u128, 0);
    let none: Vec<Row> = vec![[0.0; LANES]; dim];
    let (mut z, mut x, mut at, mut slope) = (none.clone(), none.clone(), vec![0.0; dim], vec![0.0; dim]);
    let (mut g, mut w, angles) = (none.clone(), none, angles(&recorded));
    let turns = normal.turns(&angles);
    let at_broke = broke.as_ref().and_then(|broke| broke.x.as_ref());
    let fault = at_broke.and_then(|x| reason(&target, x));
    let mut result = Approximated {
        recorded,
        x: vec![],
        numbers: vec![],
        log_density: vec![],
        log_own: vec![],
        log_proposal: vec![],
        z: vec![],
        slopes: vec![],
        path_bound: None,
        impossible: 0,
        bounds,
        best,
        converged,
        broke,
        fault,
        interrupted,
        gradients: gradients + plan.draws as u64,
        normal,
    };
    for count in counts(plan.draws) {
        result.normal.draw(&mut stream, &mut z, &mut x);
        let log_normal = result.normal.log_density_around(&z, &angles);
        let mut is_sound = [false; LANES];
        for l in 0..count {
            at.iter_mut().zip(&x).for_each(|(at, row)| *at = row[l]);
            // One draw at a time, since the path of the point gives the values at its coordinates.
            match evaluate(&mut target, &at, &mut slope) {
                Ok(value) => {
                    is_sound[l] = true;
                    g.iter_mut().zip(&slope).for_each(|(row, slope)| row[l] = *slope);
                    result.log_density.push(value);
                    result.log_own.push(log_normal[l]);
                    result.numbers.extend(target.recorded().numbers(&at));
                    result.x.extend_from_slice(&at);
                }
                Err(stop) if stop.cause == niwaki_continuous::hamiltonian::Cause::Guard => {
                    return Err(elsewhere());
                }
                Err(_) => result.impossible += 1,
            }
        }
        // The slope by `z` is S^T g for log p; for log q it is minus the part of z that the turns leave.
        let mut slopes = z.clone();
        turns.slopes(&mut slopes);
        result.normal.pull(&g, &mut w);
        for l in (0..count).filter(|l| is_sound[*l]) {
            result.z.extend(z.iter().map(|row| row[l]));
            result.slopes.extend(w.iter().zip(&slopes).map(|(w, z)| w[l] + z[l]));
        }
    }
    result.log_proposal = result.log_own.clone();
    debug_assert_eq!(Potential::dim(&target), dim, "one number for each coordinate");
    Ok(result)
}
