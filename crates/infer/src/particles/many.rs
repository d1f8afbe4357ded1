//! Several independent populations as one search, side by side or until a time is spent.
//!
//! Population `m` of `N_m` particles estimates the normalising constant by `Z_m` without bias, so the searches
//! together estimate it by `Z = sum N_m Z_m / sum N_m`, and a particle of weight `w` in its population weighs
//! `N_m Z_m w / sum w` in the whole (each population is one draw of importance sampling on the space of whole
//! populations; Whiteley, Lee & Heine 2016, section 3). One that died counts with `Z_m = 0`. Absolute weights have no
//! such constant; there a particle weighs what it weighs in its population.
//!
//! The sizes are the plan: with the seed it gives the same result again, however many threads there are and however
//! long it takes. Where a time was given, measured costs decide the sizes; scores have no say in them.

use super::rejuvenation::Moved;
use super::settings::Settings;
use super::smc::{Outcome, Progress, Result, run};
use crate::{Failure, Task};
use niwaki_math::Stream;
use niwaki_math::streams::RngCore;
use niwaki_vm::fault::Fault;
use rayon::prelude::*;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The stream from which the seeds of further populations come: no lineage has this number.
const POPULATIONS: u64 = u64::MAX - 1;

/// Particles of the first population of a search by time: enough to tell what one costs.
const PILOT: usize = 32;
/// How much larger the next population may be than the last: what a particle costs is known for sizes like that.
const GROWTH: usize = 8;
/// Share of the time left that the next population is planned to take.
const SHARE: f64 = 0.9;
/// Fewer particles than this are not worth a population.
const LEAST: usize = 16;
/// How much of the time may be spent before a population that is not needed is given up.
const PATIENCE: f64 = 1.1;

/// The seed of the `number`-th population; of the first, the seed itself.
fn population_seed(seed: u64, number: usize) -> u64 {
    if number == 0 { seed } else { Stream::new(seed, POPULATIONS, number as u128, 0).next_u64() }
}

/// Whoever watches several populations at once.
pub type Watch<'a> = dyn FnMut(Progress) -> bool + Send + 'a;

/// Populations of these sizes, side by side. `watch` is told now and then how far one of them is; when it answers
/// false, they stop and give what they have.
///
/// # Errors
/// As for [`smc`](super::smc()); populations may die as long as one lives.
pub fn populations(
    task: &Task,
    settings: &Settings,
    plan: &[usize],
    watch: &mut Watch<'_>,
) -> std::result::Result<Result, Failure> {
    // One by one, each in parallel inside, where there are too few to keep every thread busy.
    let threads = rayon::current_num_threads();
    let alone = plan.len() < threads || threads == 1;
    let (watch, stopped) = (Mutex::new(watch), AtomicBool::new(false));
    let one = |(number, &particles): (usize, &usize)| {
        let own = Settings { particles, seed: population_seed(settings.seed, number), ..settings.clone() };
        run(task, &own, !alone, &mut |progress| {
            // A thread that finds another one telling goes on.
            if let Ok(mut watch) = watch.try_lock()
                && !watch(progress)
            {
                stopped.store(true, Ordering::Relaxed);
            }
            !stopped.load(Ordering::Relaxed)
        })
    };
    let found: Vec<_> = if alone {
        plan.iter().enumerate().map(one).collect()
    } else {
        plan.par_iter().enumerate().map(one).collect()
    };
    let stopped = stopped.load(Ordering::Relaxed);
    combine(plan, found, stopped)
}

/// Populations one after the other until `time` is spent; the result's plan says how large they were.
///
/// # Errors
/// As for [`populations`]; no time.
pub fn within(
    task: &Task,
    settings: &Settings,
    time: Duration,
    watch: &mut Watch<'_>,
) -> std::result::Result<Result, Failure> {
    if time.is_zero() {
        return Err(Fault::new("no-time", "no time was given to the search")
            .with_help("give it a number of seconds above 0")
            .into());
    }
    let began = Instant::now();
    let (mut plan, mut found) = (Vec::new(), Vec::new());
    let (mut size, mut stopped) = (PILOT, false);
    loop {
        let own = Settings {
            particles: size,
            seed: population_seed(settings.seed, plan.len()),
            ..settings.clone()
        };
        let (start, mut late) = (Instant::now(), false);
        let one = run(task, &own, false, &mut |progress| {
            stopped |= !watch(progress);
            late = !plan.is_empty() && began.elapsed() > time.mul_f64(PATIENCE);
            !stopped && !late
        });
        if late && !stopped {
            break;
        }
        let cost = start.elapsed().as_secs_f64() / size as f64;
        plan.push(size);
        found.push(one);
        let left = time.saturating_sub(began.elapsed()).as_secs_f64();
        let affordable = (SHARE * left / cost) as usize;
        if stopped || affordable < LEAST {
            break;
        }
        size = affordable.min(GROWTH * size);
    }
    combine(&plan, found, stopped)
}

/// The populations as one.
fn combine(
    plan: &[usize],
    found: Vec<std::result::Result<Result, Failure>>,
    interrupted: bool,
) -> std::result::Result<Result, Failure> {
    let mut lived: Vec<(f64, Result)> = Vec::new();
    let mut died = None;
    let mut deaths = 0;
    for (one, size) in found.into_iter().zip(plan) {
        match one {
            Ok(result) => lived.push((*size as f64, result)),
            // The first death is told when all died.
            Err(failure) if failure.is_impossible() => {
                deaths += 1;
                died.get_or_insert(failure);
            }
            Err(other) => return Err(other),
        }
    }
    let total: f64 = plan.iter().map(|n| *n as f64).sum();
    if plan.len() == 1 || lived.is_empty() {
        let no_plan =
            || Fault::new("no-particles", "zero populations were asked for").with_help("use at least one");
        return lived.pop().map(|one| one.1).ok_or_else(|| died.unwrap_or_else(|| no_plan().into()));
    }
    let log_normaliser = lived
        .iter()
        .map(|(n, one)| one.log_normaliser.map(|z| z + (n / total).ln()))
        .collect::<Option<Vec<f64>>>()
        .map(|logs| log_sum_exp(&logs));
    let mut whole = Result {
        particles: Vec::new(),
        log_normaliser,
        log_evidence: log_normaliser.filter(|_| lived.iter().all(|(_, one)| one.log_evidence.is_some())),
        barriers: 0,
        steps: 0,
        resampled: 0,
        ancestors: 0,
        interrupted,
        plan: plan.to_vec(),
        died: deaths,
        moved: Moved::default(),
        temperatures: std::mem::take(&mut lived[0].1.temperatures),
    };
    for (n, mut one) in lived {
        if let (Some(own), Some(all)) = (one.log_normaliser, log_normaliser) {
            let sum = log_sum_exp(&one.particles.iter().map(|p| p.log_weight).collect::<Vec<_>>());
            let scale = own - all + n.ln() - sum;
            one.particles.iter_mut().for_each(|p: &mut Outcome| p.log_weight += scale);
        }
        whole.particles.append(&mut one.particles);
        whole.barriers = whole.barriers.max(one.barriers);
        whole.steps += one.steps;
        whole.resampled += one.resampled;
        whole.ancestors += one.ancestors;
        whole.moved += one.moved;
    }
    Ok(whole)
}

fn log_sum_exp(logs: &[f64]) -> f64 {
    crate::importance::log_mean_exp(logs.iter().copied()) + (logs.len() as f64).ln()
}
