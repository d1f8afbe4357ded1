//! Normals near a task's distribution, over the coordinates of its continuous choices, with draws from them.
//!
//! The task must have one structure: the same continuous choices in each run, and no discrete ones. What is found to have
//! another is refused.

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
    /// Where an ascent starts.
    pub start: Start,
    /// Draws of each result.
    pub draws: usize,
    /// Steps of an ascent at most.
    pub steps: u32,
    /// Draws of each of its steps.
    pub samples: usize,
    /// A round that gains less ends it, nats.
    pub tolerance: f64,
    /// How many paths.
    pub paths: usize,
    /// Decides every random number.
    pub seed: u64,
    /// Most forward runs for the start of each path.
    pub tries: u64,
    /// Values of choices at the start, where they are known.
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
    /// The values of their choices by rows, `(n, sum of widths)`.
    pub numbers: Vec<f64>,
    /// Their log densities over coordinates, nats.
    pub log_density: Vec<f64>,
    /// Their log densities under the normal, nats: on the circle, where a coordinate is an angle.
    pub log_own: Vec<f64>,
    /// Their log densities under equal shares of all normals, nats: what their weights are taken with.
    pub log_proposal: Vec<f64>,
    /// Their standard normal numbers by rows, `(n, dim)`.
    pub z: Vec<f64>,
    /// The slopes of their log weights, `log_density - log_own`, by those numbers, `(n, dim)`.
    pub slopes: Vec<f64>,
    /// The bound of the path's normal from which an ascent started, by other draws, and its standard error, nats.
    pub path_bound: Option<(f64, f64)>,
    /// Draws of density zero, or without a finite density.
    pub impossible: usize,
    /// The estimates of the bound at each step, nats.
    pub bounds: Vec<f64>,
    /// The step whose normal this is, of a path.
    pub best: Option<usize>,
    /// Whether an ascent ended by its tolerance; true of a path.
    pub converged: bool,
    /// Where an ascent broke off.
    pub broke: Option<Broke>,
    /// The fault there.
    pub fault: Option<Box<RunFault>>,
    /// Whether it was stopped before its end.
    pub interrupted: bool,
    /// Gradients taken.
    pub gradients: u64,
}

impl Approximated {
    /// The continuous choices.
    pub fn choices(&self) -> &[Continuous] {
        &self.recorded.choices
    }

    /// How many numbers the choices of a draw have.
    pub fn width(&self) -> usize {
        rows::width(&self.recorded)
    }

    /// Of each draw, by running it: the log density of its choices without Jacobians, and its factors and observations,
    /// nats.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn scores(&self, task: &Task) -> Result<Vec<(f64, f64)>, Failure> {
        rows::scores(task, &self.recorded, &self.numbers, self.log_density.len())
    }
}

/// A path, with what it was followed in.
struct Followed {
    member: Member,
    path: Path,
    gradients: u64,
}

/// Approximates a task's distribution: by one normal that an ascent of the bound found, or by that of each path. `watch`
/// is called regularly with the steps of all; when it returns false, they end with the best so far.
///
/// # Errors
/// Discrete choices, a structure that changes, sketches, no possible start, an operation without a derivative on which the
/// score depends, a start without a finite gradient, a fault of the program.
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
    let others: Vec<Result<Member, Failure>> =
        (1..count).into_par_iter().map(|number| run(number, Some(&first.target))).collect();
    let mut members = vec![first];
    for other in others {
        members.push(other?);
    }
    if is_run {
        let member = members.swap_remove(0);
        let normal = Normal::diagonal(member.start.clone(), vec![NARROW; member.start.len()]);
        return Ok(vec![climbed(plan, member, &normal, 0, &look)?]);
    }
    let followed: Vec<Result<Followed, Failure>> =
        members.into_par_iter().map(|member| follow(plan, member, &look)).collect();
    let mut followed = followed.into_iter().collect::<Result<Vec<_>, _>>()?;
    if plan.family.is_none() {
        let ends = followed.into_par_iter().map(|one| {
            let Followed { member, path, gradients } = one;
            let (best, angles) = (Some(path.best), angles(&member.recorded));
            let normal = path.normal.in_order(&angles).unwrap_or(path.normal);
            let found = Found { normal, bounds: path.bounds, best, converged: true, broke: None };
            drawn(plan, member, found, path.interrupted, gradients)
        });
        let mut all = ends.collect::<Vec<_>>().into_iter().collect::<Result<Vec<_>, _>>()?;
        weigh_together(&mut all);
        return Ok(all);
    }
    let height = |one: &Followed| one.path.bounds[one.path.best];
    let best = (0..followed.len())
        .fold(0, |best, k| if height(&followed[k]) > height(&followed[best]) { k } else { best });
    let gradients = followed.iter().map(|one| one.gradients).sum();
    let Followed { member, path, .. } = followed.swap_remove(best);
    Ok(vec![climbed(plan, member, &path.normal, gradients, &look)?])
}

/// The coordinates that are angles: with them the density repeats every turn.
fn angles(recorded: &Recorded) -> Vec<usize> {
    let angle = |choice: &&Continuous| choice.transform == Transform::Circle;
    recorded.choices.iter().filter(angle).map(|choice| choice.first).collect()
}

/// Gives the draws of several normals their densities under all of them together.
fn weigh_together(all: &mut [Approximated]) {
    if all.len() < 2 {
        return;
    }
    let angles = angles(&all[0].recorded);
    let normals: Vec<&Normal> = all.iter().map(|one| &one.normal).collect();
    let dim = normals[0].dim();
    let together = |one: &Approximated| -> Vec<f64> {
        let mut logs = Vec::with_capacity(one.log_own.len());
        for some in one.x.chunks(LANES * dim.max(1)) {
            let count = some.len() / dim.max(1);
            // Empty lanes repeat the first draw.
            let entry = |k: usize, l: usize| some[if l < count { l * dim } else { 0 } + k];
            let x: Vec<Row> = (0..dim).map(|k| std::array::from_fn(|l| entry(k, l))).collect();
            logs.extend_from_slice(&mixture::log_density(&normals, &angles, &x)[..count]);
        }
        logs
    };
    let logs: Vec<Vec<f64>> = all.par_iter().map(together).collect();
    all.iter_mut().zip(logs).for_each(|(one, logs)| one.log_proposal = logs);
}

/// Draws by which a fit is compared with the normal of its path.
const COMPARED: usize = 256;

/// The bound of a normal, and its standard error, nats; `None` where a draw has no finite density.
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
        let own = normal.log_density_around(&z, &batch.angles);
        ratios.extend(values.iter().zip(own).take(count).map(|(p, q)| p - q));
    }
    let count = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let variance = ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / (count - 1.0);
    Ok(mean.is_finite().then_some((mean, (variance / count).sqrt())))
}

/// The deviations of the normal around a run, in coordinates.
const NARROW: f64 = 0.1;

/// Refuses discrete choices, and a structure that is not the first one.
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

fn unsuited(why: &str) -> Fault {
    Fault::new("no-normal-fits", why)
}

fn no_path(why: &NoPath, live: &Live, start: &[f64]) -> Failure {
    match why {
        NoPath::Elsewhere => elsewhere(),
        NoPath::Start(_) => super::explore::no_slope(live, start),
    }
}

/// Follows the path from a run.
fn follow(
    plan: &Plan<'_>,
    mut member: Member,
    look: &(dyn Fn(u32) -> bool + Sync),
) -> Result<Followed, Failure> {
    let mut wide = Wide::<LANES>::new(&member.recorded.density);
    let mut batch = Batch::new(&mut member.target, &mut wide).around(angles(&member.recorded));
    let found = pathfinder(&mut batch, &member.start, plan.seed, member.number as u64, &|step| look(step));
    let gradients = batch.gradients;
    match found {
        Ok(path) => Ok(Followed { member, path, gradients }),
        Err(why) => Err(no_path(&why, &member.target, &member.start)),
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
    let fit = ascend(&mut batch, from, &settings, plan.seed, member.number as u64, &|step| look(step));
    let gradients = gradients + batch.gradients;
    let fit = fit.map_err(|_| elsewhere())?;
    let found = Found {
        normal: fit.normal,
        bounds: fit.bounds,
        best: None,
        converged: fit.converged,
        broke: fit.broke,
    };
    let fitted = drawn(plan, member, found, fit.interrupted, gradients)?;
    Ok(Approximated { path_bound, ..fitted })
}

/// A normal, and how it was found.
struct Found {
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
    found: Found,
    interrupted: bool,
    gradients: u64,
) -> Result<Approximated, Failure> {
    let Member { number, mut target, recorded, .. } = member;
    let Found { normal, bounds, best, converged, broke } = found;
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
        let own = result.normal.log_density_around(&z, &angles);
        let mut is_sound = [false; LANES];
        for l in 0..count {
            at.iter_mut().zip(&x).for_each(|(at, row)| *at = row[l]);
            // One by one: the path of the point gives the values for its coordinates.
            match evaluate(&mut target, &at, &mut slope) {
                Ok(value) => {
                    is_sound[l] = true;
                    g.iter_mut().zip(&slope).for_each(|(row, slope)| row[l] = *slope);
                    result.log_density.push(value);
                    result.log_own.push(own[l]);
                    result.numbers.extend(target.recorded().numbers(&at));
                    result.x.extend_from_slice(&at);
                }
                Err(stop) if stop.cause == niwaki_continuous::hamiltonian::Cause::Guard => {
                    return Err(elsewhere());
                }
                Err(_) => result.impossible += 1,
            }
        }
        // By `z`, log p has the slope S^T g, and log q minus that which the turns leave of z.
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
