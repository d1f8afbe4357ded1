//! Independent populations as a single search, in parallel or until a time limit.
//!
//! Population `m` of `N_m` particles estimates the normalising constant by `Z_m` without bias. The searches
//! together estimate it by `Z = sum N_m Z_m / sum N_m`. A particle of weight `w` in its population weighs
//! `N_m Z_m w / sum w` in the whole. (Each population is one draw of importance sampling on the space of whole
//! populations; Whiteley, Lee & Heine 2016, section 3.) A population that died counts with `Z_m = 0`. Absolute weights have no
//! such constant; there a particle weighs what it weighs in its population.
//!
//! The sizes are the plan: with the seed it gives the same result again, however many threads there are and however
//! long it takes.
//!
//! # A search by time
//!
//! A population that costs much often has a high `Z_m`, because its particles survive. So a rule by which cost decides
//! which populations count, or how much, makes `Z` biased, unless it treats all those that count in the same manner. The
//! rule of [`within`]:
//!
//! 1. Pilot populations measure what a particle costs. They decide the size and are thrown away.
//! 2. Populations of that one size run one after the other, from the end of the pilots to the deadline.
//! 3. Those that are complete at the deadline count, the dead ones as zero; the one that runs is dropped.
//! 4. Where none is complete, the first is finished and counts alone.
//!
//! Given the pilots, let the pairs `(C_m, Z_m)` of cost and estimate be independent and of one law, `E Z_m = Z`, and let
//! `t` be the time left. The number that is complete, `N = max { n: C_1 + ... + C_n <= t }`, is decided for each `n` by
//! `C_1 + ... + C_n <= t < C_1 + ... + C_n + C_(n+1)`, in which the first `n` pairs may be exchanged. So each of
//! them has the same mean on the event `N = n`, and
//!
//! ```text
//! E[(Z_1 + ... + Z_n) / n; N = n] = E[Z_1; N = n]    for n >= 1
//! E[estimate] = E[Z_1; N = 0] + sum over n >= 1 of E[Z_1; N = n] = E[Z_1] = Z
//! ```
//!
//! exactly, however short the time is (Glynn & Heidelberger 1990, "Bias properties of budget constrained simulations"). The
//! same holds for the weighted sum of any function of the particles. Not allowed are: to finish the population that
//! runs at the deadline and count it with others; to leave `N = 0` out or count it as zero; to choose the size of a
//! population by the measured cost of an earlier one; to run several at once and count the complete ones. The rule
//! assumes that no population is slower because of its place in the sequence.
//!
//! A search that is stopped from outside keeps its particles, also those of an incomplete population. So it has no
//! evidence.

use crate::settings::Settings;
use crate::smc::{Progress, Result, run};
use niwaki_math::log_sums::log_sum_exp;
use niwaki_math::streams::RngCore;
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use rayon::prelude::*;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The number of particles of the first pilot.
const PILOT: usize = 32;
/// How much larger a pilot may be than the one before it: the measured cost of a particle holds for similar sizes.
const GROWTH: f64 = 8.0;
/// The planned share of the time of the last pilot.
const PILOT_SHARE: f64 = 0.1;
/// Share of the time after which a pilot is stopped: its cost is then at least this.
const PILOT_LIMIT: f64 = 0.25;
/// Share of the time left that one population is planned to take: three are then complete even if they cost a tenth more.
const SHARE: f64 = 0.3;
/// The smallest number of particles of a population.
const LEAST: usize = 16;

/// The seed of the `number`-th population; of the first, the seed itself.
pub fn population_seed(seed: u64, number: usize) -> u64 {
    if number == 0 { seed } else { Reserved::Population.stream(seed, number as u128, 0).next_u64() }
}

/// The callback that watches several populations at once.
pub type Watch<'a> = dyn FnMut(Progress) -> bool + Send + 'a;

/// Populations of these sizes, in parallel. `watch` is called regularly with the progress of one of them; when it returns
/// false, they stop and return the results so far.
///
/// # Errors
/// As for [`smc`](crate::smc()); populations may die as long as one survives.
pub fn populations(
    task: &Task,
    settings: &Settings,
    plan: &[usize],
    watch: &mut Watch<'_>,
) -> std::result::Result<Result, Failure> {
    let task = &task.shared_by(plan.len().min(AT_ONCE));
    let (results, stopped) = side_by_side(plan.len(), watch, |number, watch| {
        let (particles, seed) = (plan[number], population_seed(settings.seed, number));
        let population_settings = Settings { particles, seed, ..settings.clone() };
        run(task, &population_settings, is_shared(plan.len()), watch)
    });
    combine(plan, results, stopped)
}

/// The largest number of populations that are in memory at once.
pub const AT_ONCE: usize = 64;

/// Whether so many searches share the threads: where there are fewer, they run one by one, each on all threads.
fn is_shared(count: usize) -> bool {
    let threads = rayon::current_num_threads();
    count >= threads && threads > 1
}

/// Independent searches, by number. `watch` is called regularly with the progress of one of them; when it returns false,
/// they are told to stop. Also returns whether they were.
pub fn side_by_side<T: Send>(
    count: usize,
    watch: &mut Watch<'_>,
    search: impl Fn(usize, &mut dyn FnMut(Progress) -> bool) -> T + Sync,
) -> (Vec<T>, bool) {
    let (watch, stopped) = (Mutex::new(watch), AtomicBool::new(false));
    let watched_search = |number| {
        search(number, &mut |progress| {
            // A thread does not wait here while another one calls `watch`.
            if let Ok(mut watch) = watch.try_lock()
                && !watch(progress)
            {
                stopped.store(true, Ordering::Relaxed);
            }
            !stopped.load(Ordering::Relaxed)
        })
    };
    let results = if is_shared(count) {
        (0..count).into_par_iter().map(watched_search).collect()
    } else {
        (0..count).map(watched_search).collect()
    };
    (results, stopped.into_inner())
}

/// Populations of one size, one after the other until `time` is over, by the rule in the module's documentation. The
/// result's plan says how many there were and how large they are.
///
/// # Errors
/// As for [`populations`]; no time.
pub fn within(
    task: &Task,
    settings: &Settings,
    time: Duration,
    watch: &mut Watch<'_>,
) -> std::result::Result<Result, Failure> {
    let began = Instant::now();
    by_clock(task, settings, time, &|| began.elapsed(), watch)
}

/// [`within`] with any clock; it returns the time since the search began.
pub(super) fn by_clock(
    task: &Task,
    settings: &Settings,
    time: Duration,
    clock: &dyn Fn() -> Duration,
    watch: &mut Watch<'_>,
) -> std::result::Result<Result, Failure> {
    let mut stopped = false;
    // Runs a population that stops at the first barrier after `end`; also whether the whole search was stopped.
    let mut run_population = |particles: usize, seed: u64, end: Duration| {
        let population_settings = Settings { particles, seed, ..settings.clone() };
        let result = run(task, &population_settings, false, &mut |progress| {
            stopped |= !watch(progress);
            !stopped && clock() <= end
        });
        (result, stopped)
    };

    let (mut size, limit) = (PILOT, time.mul_f64(PILOT_LIMIT));
    let mut number = 0;
    let cost = loop {
        let start = clock();
        let seed = Reserved::Pilot.stream(settings.seed, number, 0).next_u64();
        match run_population(size, seed, limit) {
            (Ok(_) | Err(Failure::Impossible { .. }), false) => {}
            (result, _) => return result.map(without_evidence),
        }
        let now = clock();
        let cost = now.saturating_sub(start).as_secs_f64() / size as f64;
        let next = (PILOT_SHARE * time.as_secs_f64() / cost).min(GROWTH * size as f64) as usize;
        // A pilot that is hardly larger measures nothing new.
        if now > limit || next < 2 * size {
            break cost;
        }
        (size, number) = (next, number + 1);
    };
    let began = clock();
    let affordable = SHARE * time.saturating_sub(began).as_secs_f64() / cost;
    let size = (affordable.min(GROWTH * size as f64) as usize).max(LEAST);

    let (mut plan, mut results) = (Vec::new(), Vec::new());
    loop {
        let is_first = plan.is_empty();
        let end = if is_first { Duration::MAX } else { time };
        let (population, stopped) = run_population(size, population_seed(settings.seed, plan.len()), end);
        let is_late = clock() > time;
        if is_late && !is_first && !stopped {
            break;
        }
        plan.push(size);
        results.push(population);
        if stopped {
            return combine(&plan, results, true).map(without_evidence);
        }
        if is_late {
            break;
        }
    }
    combine(&plan, results, false)
}

/// The result of a search that was stopped. It has no evidence, because no deadline decided which populations are complete.
fn without_evidence(result: Result) -> Result {
    Result { log_normaliser: None, log_evidence: None, ..result }
}

/// A surviving population.
#[derive(Clone, Copy, Debug)]
pub struct Share {
    /// The number of particles.
    pub size: usize,
    /// The estimate of this population, like [`Result::log_normaliser`], nats.
    pub log_normaliser: Option<f64>,
    /// Log of the sum of its particles' weights.
    pub log_sum: f64,
}

impl Share {
    fn of(size: usize, result: &Result) -> Share {
        let log_sum = log_sum_exp(result.particles.iter().map(|p| p.log_weight));
        Share { size, log_normaliser: result.log_normaliser, log_sum }
    }
}

/// The populations that lived as one, of `total` particles with those that died: the log of their common estimate, and what
/// is added to the log weights of each population.
pub fn united(lived: &[Share], total: usize) -> (Option<f64>, Vec<f64>) {
    let part = |share: &Share| share.log_normaliser.map(|log| log + (share.size as f64 / total as f64).ln());
    let all = lived.iter().map(part).collect::<Option<Vec<f64>>>().map(|logs| log_sum_exp(logs.into_iter()));
    let shift = |share: &Share| match (share.log_normaliser, all) {
        (Some(log_normaliser), Some(all)) => log_normaliser - all + (share.size as f64).ln() - share.log_sum,
        _ => 0.0,
    };
    (all, lived.iter().map(shift).collect())
}

/// Merge the populations.
fn combine(
    plan: &[usize],
    results: Vec<std::result::Result<Result, Failure>>,
    interrupted: bool,
) -> std::result::Result<Result, Failure> {
    let mut lived: Vec<(usize, Result)> = Vec::new();
    let mut died = None;
    let mut deaths = 0;
    for (outcome, size) in results.into_iter().zip(plan) {
        match outcome {
            Ok(result) => lived.push((*size, result)),
            // The first death is reported where all died.
            Err(failure) if failure.is_impossible() => {
                deaths += 1;
                died.get_or_insert(failure);
            }
            Err(other) => return Err(other),
        }
    }
    let total = plan.iter().sum();
    if plan.len() == 1 || lived.is_empty() {
        return lived.pop().map(|(_, result)| result).ok_or_else(|| died.unwrap_or_else(Failure::no_start));
    }
    let shares: Vec<Share> = lived.iter().map(|(size, result)| Share::of(*size, result)).collect();
    let (log_normaliser, shifts) = united(&shares, total);
    let mut whole = Result {
        log_normaliser,
        log_evidence: log_normaliser
            .filter(|_| lived.iter().all(|(_, result)| result.log_evidence.is_some())),
        interrupted,
        plan: plan.to_vec(),
        died: deaths,
        powers: std::mem::take(&mut lived[0].1.powers),
        ..Result::default()
    };
    for ((_, mut population), shift) in lived.into_iter().zip(shifts) {
        population.particles.iter_mut().for_each(|p| p.log_weight += shift);
        whole.particles.append(&mut population.particles);
        whole.barriers = whole.barriers.max(population.barriers);
        whole.steps += population.steps;
        whole.resampled += population.resampled;
        whole.ancestors += population.ancestors;
        whole.moved += population.moved;
        whole.losses.add(population.losses);
    }
    Ok(whole)
}
