//! The population: the loop of advancing, weighing and resampling.

use super::advance::Particle;
use super::settings::{Order, Settings, Weights, When};
use super::weights::Normalised;
use crate::record::Record;
use crate::{Failure, Task};
use niwaki_math::{Stream, StreamKey};
use niwaki_vm::machine::Limits;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The stream of the resampling draws: no lineage has this number.
const RESAMPLING: u64 = u64::MAX;

/// Particles that one task of the thread pool advances.
const BATCH: usize = 16;

/// A particle of the final set.
pub struct Outcome {
    /// Its choices and score.
    pub record: Record,
    /// What the program returned (`None` for one that was interrupted or is impossible).
    pub value: Value,
    /// Its log weight, nats; equal weights after a last resampling.
    pub log_weight: f64,
    /// Whether it has ended.
    pub has_ended: bool,
    /// Its lineage: equal for particles that are copies of each other since the last barrier at most once.
    pub lineage: u64,
}

/// What SMC found.
pub struct Result {
    /// The final set.
    pub particles: Vec<Outcome>,
    /// Estimate of the log evidence, nats; `None` for absolute weights and sharpened scores, which have none.
    pub log_evidence: Option<f64>,
    /// How many barriers there were.
    pub barriers: usize,
    /// Particle-steps: how often a particle ran to a barrier.
    pub steps: u64,
    /// Barriers at which the population was resampled.
    pub resampled: usize,
    /// Ancestors at the first barrier that the final set descends from.
    pub ancestors: usize,
    /// Whether it was stopped before all particles had ended.
    pub interrupted: bool,
}

/// How far a run is, for whoever watches it.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Barriers so far.
    pub barriers: usize,
    /// Particles that have ended.
    pub ended: usize,
    /// Best log score among the particles that are possible.
    pub best: f64,
}

/// Runs a population of particles. `watch` is told after each barrier; when it answers false, the run stops and
/// gives what it has.
///
/// # Errors
/// Settings that make no sense, a fault of the program, or a population in which every particle is impossible.
pub fn smc(
    task: &Task,
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> std::result::Result<Result, Failure> {
    settings.check()?;
    let n = settings.particles;
    let task = &share_memory(task, n);
    let machine = task.machine();
    let first = task.start(&machine, settings.order == Order::DepthFirst)?;
    let mut empty = Record::start(&task.sketches);
    let empty_score = empty.log_score();
    let mut particles: Vec<Particle> = (0..n as u64)
        .map(|lineage| Particle {
            state: first.clone(),
            record: empty.fork(),
            lineage,
            stream: StreamKey::new(settings.seed, lineage, 0),
            picks: 0,
            weighed: empty_score,
            log_weight: 0.0,
        })
        .collect();
    let mut lineages = n as u64;
    let mut ancestor: Vec<usize> = (0..n).collect();
    let mut log_evidence = settings.temper * empty_score;
    let (mut barriers, mut resampled, mut steps) = (0, 0, 0);
    let mut interrupted = false;

    // Kept from barrier to barrier, so that none allocates: log weights by row, and what comes of them.
    let (mut logs, mut weights) = (Vec::with_capacity(n), Normalised::default());

    loop {
        // In one pass: a population is too large for the processor's nearest memory.
        let (running, had_ended) = particles.iter().fold((0, 0), |(running, ended), p| {
            (running + usize::from(p.is_running()), ended + usize::from(p.state.has_ended()))
        });
        if running == 0 {
            break;
        }
        advance(&mut particles, task, settings)?;
        barriers += 1;
        let (best, ended) = weigh(&mut particles, settings, &mut logs);
        // Those that ended now met no barrier.
        steps += (running + had_ended - ended) as u64;
        if !weights.read(logs.iter().copied()) {
            return Err(impossible(&particles, barriers));
        }
        if !watch(Progress { barriers, ended, best }) {
            interrupted = true;
            break;
        }
        let low = match settings.when {
            _ if settings.weights == Weights::Absolute => true,
            When::Always => true,
            When::EffectiveBelow(share) => weights.effective < share * n as f64,
        };
        if low {
            log_evidence += weights.log_mean;
            resampled += 1;
            let mut random = Stream::new(settings.seed, RESAMPLING, barriers as u128, 0);
            let copies = settings.resampling.copies(&weights.relative, &mut random);
            resample(&mut particles, &copies, &mut ancestor, &mut lineages, settings);
        }
    }
    if weights.read(particles.iter().map(|p| p.log_weight)) {
        log_evidence += weights.log_mean;
    }
    ancestor.sort_unstable();
    ancestor.dedup();
    Ok(Result {
        log_evidence: (settings.weights == Weights::Ratio && settings.temper == 1.0 && !interrupted)
            .then_some(log_evidence),
        barriers,
        steps,
        resampled,
        ancestors: ancestor.len(),
        interrupted,
        particles: particles.into_iter().map(outcome).collect(),
    })
}

/// The memory budget of a task is that of its whole population.
fn share_memory(task: &Task, n: usize) -> Task {
    let bytes = (task.limits.bytes / n).max(1 << 20);
    Task { limits: Limits { bytes, ..task.limits }, ..task.clone() }
}

fn advance(particles: &mut [Particle], task: &Task, settings: &Settings) -> std::result::Result<(), Failure> {
    let batch = |particles: &mut [Particle]| {
        let mut machine = task.machine();
        particles.iter_mut().try_for_each(|p| p.advance(&mut machine, task, settings))
    };
    if rayon::current_num_threads() == 1 {
        return batch(particles);
    }
    // Of several faults, the one of the first particle is reported, whatever thread met its own first. Batches behind
    // one that failed need not run: an endless model would use up its budget once for each.
    let failed = AtomicUsize::new(usize::MAX);
    let faults: Vec<Failure> = particles
        .par_chunks_mut(BATCH)
        .enumerate()
        .filter(|(number, _)| *number < failed.load(Ordering::Relaxed))
        .filter_map(|(number, particles)| {
            let fault = batch(particles).err()?;
            failed.fetch_min(number, Ordering::Relaxed);
            Some(fault)
        })
        .collect();
    faults.into_iter().next().map_or(Ok(()), Err)
}

/// Weighs, in one pass over the particles. The best log score and how many have ended.
fn weigh(particles: &mut [Particle], settings: &Settings, logs: &mut Vec<f64>) -> (f64, usize) {
    let (mut best, mut ended) = (f64::NEG_INFINITY, 0);
    logs.clear();
    for p in particles {
        let score = p.record.log_score();
        match settings.weights {
            Weights::Ratio if score == f64::NEG_INFINITY => p.log_weight = f64::NEG_INFINITY,
            Weights::Ratio => p.log_weight += settings.temper * (score - p.weighed),
            Weights::Absolute => p.log_weight = settings.temper * score,
        }
        p.weighed = score;
        #[cfg(test)]
        if settings.is(super::tests::Mutant::ForgetsOldScore) {
            p.weighed = 0.0;
        }
        logs.push(p.log_weight);
        best = best.max(score);
        ended += usize::from(p.state.has_ended());
    }
    (best, ended)
}

/// Survivors stay where they are; their further copies take the places of those that get none. `ancestor` becomes
/// that of the new rows.
fn resample(
    particles: &mut [Particle],
    copies: &[usize],
    ancestor: &mut [usize],
    lineages: &mut u64,
    settings: &Settings,
) {
    let mut free = copies.iter().enumerate().filter(|(_, c)| **c == 0).map(|(row, _)| row);
    for (row, &count) in copies.iter().enumerate() {
        for _ in 1..count {
            let Some(to) = free.next() else { break };
            let [parent, child] = pair(particles, row, to);
            child.copy_from(parent, *lineages, settings.seed);
            *lineages += 1;
            ancestor[to] = ancestor[row];
        }
    }
    for (row, p) in particles.iter_mut().enumerate() {
        p.log_weight = 0.0;
        #[cfg(test)]
        super::tests::corrupt(p, row, settings, copies);
        #[cfg(not(test))]
        let _ = (row, settings);
    }
}

fn pair(particles: &mut [Particle], a: usize, b: usize) -> [&mut Particle; 2] {
    if a < b {
        let (left, right) = particles.split_at_mut(b);
        [&mut left[a], &mut right[0]]
    } else {
        let (left, right) = particles.split_at_mut(a);
        [&mut right[0], &mut left[b]]
    }
}

fn impossible(particles: &[Particle], barrier: usize) -> Failure {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for p in particles {
        *counts.entry(p.record.cause.as_deref().unwrap_or("weights")).or_insert(0) += 1;
    }
    let mut causes: Vec<(String, usize)> = counts.into_iter().map(|(c, n)| (c.to_string(), n)).collect();
    causes.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    Failure::Impossible { barrier, causes }
}

fn outcome(p: Particle) -> Outcome {
    let has_ended = p.state.has_ended();
    Outcome {
        value: if has_ended { p.state.result() } else { Value::None },
        log_weight: p.log_weight,
        has_ended,
        lineage: p.lineage,
        record: p.record,
    }
}
