//! Training on whole traces, as in the dissertation's code: a step follows the slope of the summed loss of a trace drawn
//! at random.

use super::pass::Filtered;
use super::slope::{Trace, Work};
use crate::learn::{Adam, Moving, Progress, Stored, Unfit, Way};
use crate::net::Real;
use niwaki_math::Stream;
use niwaki_math::streams::RngCore;
use rayon::prelude::*;

/// Settings of training on traces.
#[derive(Clone, Debug, PartialEq)]
pub struct FilteredTraining {
    /// Adam's rate.
    pub rate: f64,
    /// Adam's decays of mean and square.
    pub decays: [f64; 2],
    /// Traces in a step.
    pub batch: usize,
    /// The share of the averaged weights that stays in a step; 0 for the last weights.
    pub averaging: f64,
    /// Steps in all.
    pub steps: u64,
    /// Steps between looks at the traces held out.
    pub every: u64,
    /// The prior's share in the guide, above 0 and below 1.
    pub share: f64,
    /// Seed of the traces that steps draw.
    pub seed: u64,
}

/// A trained network.
#[derive(Clone, Debug)]
pub struct TrainedFiltered<T: Real = f32> {
    /// The averaged weights, or the last weights.
    pub net: Filtered<T>,
    /// The progress at every look.
    pub history: Vec<Progress>,
    /// The step and the site of a loss or slope that is not a finite number; then `net` is the network before that step.
    pub diverged: Option<(u64, Option<usize>)>,
}

/// A trace of a step.
struct Part<T: Real> {
    work: Work<T>,
    slope: Vec<T>,
    loss: f64,
    fault: Option<usize>,
}

/// Sets the ranges of features of a network that was never trained.
fn set_ranges<T: Real>(net: &mut Filtered<T>, traces: &[Trace]) {
    let mut ranges = vec![(f32::INFINITY, f32::NEG_INFINITY); net.features.len()];
    for (k, x) in traces.iter().flat_map(|trace| &trace.choices).flat_map(|choice| &choice.features) {
        let range = &mut ranges[*k as usize];
        *range = (range.0.min(*x), range.1.max(*x));
    }
    for (feature, (low, high)) in net.features.iter_mut().zip(ranges) {
        let half = 0.5 * (f64::from(high) - f64::from(low));
        if half > 0.0 && half.is_finite() {
            *feature = (T::from_f64(f64::from(low) + half), T::from_f64(1.0 / half));
        }
    }
}

/// Mean loss of the choices of traces, nats.
fn judge<T: Real>(net: &Filtered<T>, traces: &[Trace], share: f64) -> f64 {
    let losses: Vec<f64> = traces
        .par_iter()
        .map_init(Work::default, |work, trace| work.loss(net, trace, share, None).0)
        .collect();
    let choices: usize = traces.iter().map(|trace| trace.choices.len()).sum();
    losses.iter().sum::<f64>() / choices.max(1) as f64
}

/// Trains a network on traces. `watch` sees the progress, and ends the training when it returns `false`.
///
/// # Panics
///
/// If the share of the prior is not between 0 and 1, or the traces have another form than the network.
pub fn train_filtered<T: Real>(
    net: Filtered<T>,
    traces: &[Trace],
    held_out: &[Trace],
    with: &FilteredTraining,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> TrainedFiltered<T> {
    let anew = Way { left: None, border: &mut |_| {} };
    match train_filtered_along(net, traces, held_out, with, watch, anew) {
        Ok(trained) => trained,
        Err(Unfit) => unreachable!("nothing was left"),
    }
}

/// As [`train_filtered`], from stored data of a training with the same start, with a call at each border between steps.
///
/// # Errors
/// The data belongs to another training.
///
/// # Panics
///
/// See [`train_filtered`].
pub fn train_filtered_along<T: Real>(
    mut net: Filtered<T>,
    traces: &[Trace],
    held_out: &[Trace],
    with: &FilteredTraining,
    watch: &mut dyn FnMut(Progress) -> bool,
    way: Way<'_>,
) -> Result<TrainedFiltered<T>, Unfit> {
    assert!(with.share > 0.0 && with.share < 1.0, "the prior's share is {}", with.share);
    if net.fresh {
        set_ranges(&mut net, traces);
        net.fresh = false;
    }
    let mut adam = Adam::with_decays(net.weights.len(), with.decays);
    let part =
        || Part { work: Work::default(), slope: vec![T::ZERO; net.weights.len()], loss: 0.0, fault: None };
    let mut parts: Vec<Part<T>> = (0..with.batch.max(1)).map(|_| part()).collect();
    let (mut history, mut diverged) = (Vec::new(), None);
    // The weights of `best` are not stored: the last weights are the result.
    let (mut sums, mut best) = ((0.0, 0.0), (f64::INFINITY, 0, Vec::new()));
    if let Some(left) = &way.left {
        let (weights, adam) = (&mut net.weights, &mut adam);
        let moving = Moving { weights, adam, best: &mut best, sums: &mut sums, history: &mut history };
        if !left.put(moving) {
            return Err(Unfit);
        }
    }
    let (mut sum, mut count): (f64, f64) = sums;
    let averaged = |net: &Filtered<T>, adam: &Adam<T>| match adam.step() {
        0 => net.clone(),
        _ if with.averaging == 0.0 => net.clone(),
        _ => Filtered { weights: adam.averaged(with.averaging), ..net.clone() },
    };
    let last = if traces.is_empty() { 0 } else { with.steps };
    loop {
        let step = adam.step();
        let has_looked = history.last().is_some_and(|progress: &Progress| progress.step == step);
        if !has_looked && (step.is_multiple_of(with.every.max(1)) || step >= last) {
            let judged_loss = judge(
                &averaged(&net, &adam),
                if held_out.is_empty() { traces } else { held_out },
                with.share,
            );
            if judged_loss < best.0 {
                (best.0, best.1) = (judged_loss, step);
            }
            let loss = if count > 0.0 { sum / count } else { judged_loss };
            let progress =
                Progress { step, steps: with.steps, loss, held_out: judged_loss, best: (best.0, best.1) };
            history.push(progress);
            (sum, count) = (0.0, 0.0);
            if !watch(progress) || step >= last {
                break;
            }
        }
        (way.border)(&|| Stored::of(&net.weights, &adam, &best, (sum, count), &history));
        let mut stream = Stream::new(with.seed, 1, u128::from(step), 0);
        #[expect(clippy::cast_possible_truncation, reason = "less than the number of traces")]
        let mut pick = || ((u128::from(stream.next_u64()) * traces.len() as u128) >> 64) as usize;
        let picks: Vec<usize> = parts.iter().map(|_| pick()).collect();
        let compute = |(part, pick): (&mut Part<T>, &usize)| {
            part.slope.fill(T::ZERO);
            (part.loss, part.fault) = part.work.loss(&net, &traces[*pick], with.share, Some(&mut part.slope));
        };
        match parts.len() {
            1 => parts.iter_mut().zip(&picks).for_each(compute),
            _ => parts.par_iter_mut().zip(&picks).for_each(compute),
        }
        let loss: f64 = parts.iter().map(|part| part.loss).sum();
        let fault = parts.iter().find_map(|part| part.fault);
        let (first, rest) = parts.split_at_mut(1);
        let slope = &mut first[0].slope;
        for part in rest {
            add(slope, &part.slope);
        }
        let sound = slope.iter().fold(T::ZERO, |flag, x| flag + *x * T::ZERO) == T::ZERO;
        if !(loss.is_finite() && sound) {
            diverged = Some((step + 1, fault));
            break;
        }
        sum += loss;
        count += picks.iter().map(|pick| traces[*pick].choices.len()).sum::<usize>() as f64;
        adam.advance(&mut net.weights, slope, 1.0, with.rate, with.averaging);
    }
    Ok(TrainedFiltered { net: averaged(&net, &adam), history, diverged })
}

fn add<T: Real>(sum: &mut [T], more: &[T]) {
    sum.iter_mut().zip(more).for_each(|(sum, x)| *sum += *x);
}
