//! Training: Adam (Kingma & Ba 2015, alg. 1), averaged weights, and the best weights by rows held out.
//!
//! A step draws choices from all traces and moves the weights against the slope of their mean loss ([`Adam`]). The
//! choices are cut into chunks of fixed size whose slopes are added up in order, so equal seeds give equal
//! bits on any number of threads.

use super::adam::Adam;
use super::rows::Rows;
use super::scaling;
use super::slope::Work;
use super::stored::{Moving, Stored, Unfit, Way};
use crate::net::{Net, Real};
use niwaki_math::Stream;
use niwaki_math::streams::RngCore;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Choices of a step that one thread handles in a chunk.
const CHUNK: usize = 64;
/// Most rows in a look at the rows held out; they are evenly spread.
const MOST_HELD_OUT: usize = 8192;
/// Settings of training.
#[derive(Clone, Debug, PartialEq)]
pub struct Training {
    /// Adam's rate.
    pub rate: f64,
    /// Choices in a step.
    pub batch: usize,
    /// The share of the averaged weights that stays in a step.
    pub averaging: f64,
    /// Steps in all.
    pub steps: u64,
    /// Steps between looks at the rows held out.
    pub every: u64,
    /// The prior's share in the guide, above 0 and below 1.
    pub share: f64,
    /// Seed of the choices that steps draw.
    pub seed: u64,
}

impl Training {
    /// The usual settings for this number of rows: three passes over the rows, but at least 1,500 steps and at most 12,000, with
    /// twenty looks.
    pub fn new(seed: u64, rows: usize) -> Training {
        let batch = 256;
        let steps = (3 * rows as u64 / batch as u64).clamp(1_500, 12_000);
        Training { rate: 2e-3, batch, averaging: 0.998, steps, every: steps.div_ceil(20), share: 0.02, seed }
    }
}

/// The progress of training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// The number of steps so far.
    pub step: u64,
    /// Steps in all.
    pub steps: u64,
    /// Mean loss of the choices drawn since the last look, nats; at the start, the loss on the rows held out.
    #[serde(with = "bits")]
    pub loss: f64,
    /// Mean loss of the averaged weights on the rows held out, nats; equal to `loss` if there are none.
    #[serde(with = "bits")]
    pub held_out: f64,
    /// The smallest loss on rows held out so far, and its step.
    #[serde(with = "best_bits")]
    pub best: (f64, u64),
}

/// Reals as the numbers of their bits, since JSON has no infinity.
mod bits {
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(x: &f64, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_u64(x.to_bits())
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        u64::deserialize(from).map(f64::from_bits)
    }
}

/// A loss and its step, the loss as the number of its bits.
mod best_bits {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(x: &(f64, u64), to: S) -> Result<S::Ok, S::Error> {
        (x.0.to_bits(), x.1).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<(f64, u64), D::Error> {
        <(u64, u64)>::deserialize(from).map(|(bits, step)| (f64::from_bits(bits), step))
    }
}

/// Training that can resume: weights, and the state of the optimiser.
#[derive(Clone, Debug, PartialEq)]
pub struct State<T: Real = f32> {
    /// The network, with weights for standardised windows.
    pub(super) net: Net<T>,
    /// Mean and one over deviation of each number of a window.
    scaling: Vec<(T, T)>,
    /// The optimiser.
    pub(super) adam: Adam<T>,
    /// The smallest loss on the rows held out, its step and its weights.
    pub(super) best: (f64, u64, Vec<T>),
}

/// A trained network.
#[derive(Clone, Debug, PartialEq)]
pub struct Trained<T: Real = f32> {
    /// The best network.
    pub net: Net<T>,
    /// The loss of the best network on the rows held out, nats, and its step.
    pub best: (f64, u64),
    /// The progress at every look.
    pub history: Vec<Progress>,
    /// The state after the last step, from which training can resume.
    pub state: State<T>,
}

/// The failure of training at a loss or a slope that is not a finite number.
#[derive(Clone, Debug, PartialEq)]
pub struct Diverged<T: Real = f32> {
    /// The step.
    pub step: u64,
    /// The site of the first such choice; `None` if only the sum of many is not finite.
    pub site: Option<usize>,
    /// The loss of the choice.
    pub loss: f64,
    /// The best network before.
    pub net: Box<Net<T>>,
}

impl<T: Real> fmt::Display for Diverged<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let quantity = if self.loss.is_finite() { "a slope" } else { "the loss" };
        write!(f, "in step {} {quantity} is not a finite number", self.step)?;
        match self.site {
            Some(site) => write!(f, ", at a choice of site {site} (loss {})", self.loss),
            None => Ok(()),
        }
    }
}

impl<T: Real> std::error::Error for Diverged<T> {}

/// A chunk of a step.
pub(super) struct Chunk<T: Real> {
    work: Work<T>,
    pub(super) slope: Vec<T>,
    loss: f64,
}

impl<T: Real> Chunk<T> {
    fn new(weights: usize) -> Chunk<T> {
        Chunk { work: Work::default(), slope: vec![T::ZERO; weights], loss: 0.0 }
    }
}

impl<T: Real> State<T> {
    /// The state before the first step. The rows standardise the inputs.
    pub(super) fn new(mut net: Net<T>, rows: &Rows) -> State<T> {
        let scaling = scaling::of_windows(rows, net.form.windows);
        if !net.fresh {
            scaling::unfold(&mut net, &scaling);
        }
        net.fresh = false;
        scaling::set_features(&mut net, rows);
        let best = (f64::INFINITY, 0, net.weights.clone());
        State { scaling, adam: Adam::new(net.weights.len()), best, net }
    }

    /// The number of steps so far.
    pub fn step(&self) -> u64 {
        self.adam.step()
    }

    /// The network with these weights, for raw windows.
    pub(super) fn folded(&self, weights: Vec<T>) -> Net<T> {
        let mut net = Net { weights, ..self.net.clone() };
        scaling::fold(&mut net, &self.scaling);
        net
    }

    /// The averaged weights; before the first step, the start.
    pub(super) fn averaged(&self, averaging: f64) -> Vec<T> {
        if self.step() == 0 { self.net.weights.clone() } else { self.adam.averaged(averaging) }
    }

    /// The mean loss of the averaged weights on rows held out.
    fn look(&self, rows: &Rows, with: &Training) -> f64 {
        let net = Net { weights: self.averaged(with.averaging), ..self.net.clone() };
        let count = rows.len().min(MOST_HELD_OUT);
        let sums: Vec<f64> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map_init(Work::default, |work, chunk| {
                let some = chunk * CHUNK..((chunk + 1) * CHUNK).min(count);
                let row = |k: usize| (k as u128 * rows.len() as u128 / count as u128) as usize;
                some.map(|k| work.loss(&net, Some(&self.scaling), rows, row(k), with.share, None)).sum()
            })
            .collect();
        sums.iter().sum::<f64>() / count as f64
    }

    /// The rows of the next step.
    fn batch(&self, rows: &Rows, with: &Training) -> Vec<usize> {
        let mut stream = Stream::new(with.seed, 1, u128::from(self.step()), 0);
        #[expect(clippy::cast_possible_truncation, reason = "less than the number of rows")]
        let row = |bits: u64| ((u128::from(bits) * rows.len() as u128) >> 64) as usize;
        (0..with.batch).map(|_| row(stream.next_u64())).collect()
    }

    /// Makes a step. Returns its mean loss, or the site and loss at which it is not finite.
    fn advance(
        &mut self,
        rows: &Rows,
        with: &Training,
        chunks: &mut [Chunk<T>],
    ) -> Result<f64, (Option<usize>, f64)> {
        let batch = self.batch(rows, with);
        let loss = self.slope(rows, &batch, &|_| 1.0, with.share, chunks)? / with.batch as f64;
        let (net, scale) = (&mut self.net, 1.0 / with.batch as f64);
        self.adam.advance(&mut net.weights, &chunks[0].slope, scale, with.rate, with.averaging);
        Ok(loss)
    }

    /// The sum of the losses of some rows. The sum of their slopes, each times a factor, goes into the first of the `chunks`, which
    /// must be enough for the rows, and at least one. Or the site and loss at which a sum is not finite.
    pub(super) fn slope(
        &self,
        rows: &Rows,
        picks: &[usize],
        times: &(dyn Fn(usize) -> f64 + Sync),
        share: f64,
        chunks: &mut [Chunk<T>],
    ) -> Result<f64, (Option<usize>, f64)> {
        let (net, scaling) = (&self.net, &self.scaling);
        let chunks = &mut chunks[..picks.len().div_ceil(CHUNK).max(1)];
        chunks.par_iter_mut().zip(picks.par_chunks(CHUNK)).for_each(|(chunk, some)| {
            let Chunk { work, slope, loss } = chunk;
            slope.fill(T::ZERO);
            let add = |sum: f64, row: &usize| {
                let slope = Some((&mut slope[..], times(*row)));
                sum + work.loss(net, Some(scaling), rows, *row, share, slope)
            };
            *loss = some.iter().fold(0.0, add);
        });
        let loss = chunks.iter().map(|c| c.loss).sum::<f64>();
        let (sum, rest) = chunks.split_at_mut(1);
        let sum = &mut sum[0].slope;
        for chunk in rest {
            sum.iter_mut().zip(&chunk.slope).for_each(|(sum, x)| *sum += *x);
        }
        // Infinity and NaN times zero are NaN, which stays in a sum.
        let sound = sum.iter().fold(T::ZERO, |flag, x| flag + *x * T::ZERO) == T::ZERO;
        if loss.is_finite() && sound { Ok(loss) } else { Err(self.cause(rows, share, picks)) }
    }

    /// Adds chunks for the slopes of this number of rows.
    pub(super) fn room(&self, rows: usize, chunks: &mut Vec<Chunk<T>>) {
        let weights = self.net.weights.len();
        let needed = rows.div_ceil(CHUNK).max(1);
        chunks.resize_with(needed.max(chunks.len()), || Chunk::new(weights));
    }

    /// The site and loss of the first choice of a step whose loss or slope is not finite.
    fn cause(&self, rows: &Rows, share: f64, batch: &[usize]) -> (Option<usize>, f64) {
        let mut work = Work::default();
        for row in batch {
            let mut slope = vec![T::ZERO; self.net.weights.len()];
            let loss = work.loss(&self.net, Some(&self.scaling), rows, *row, share, Some((&mut slope, 1.0)));
            if !loss.is_finite() || slope.iter().any(|x| !x.to_f64().is_finite()) {
                return (Some(rows.site(*row)), loss);
            }
        }
        (None, 0.0)
    }
}

/// Trains a network. `watch` sees the progress at the start and at every look, and ends the training when it returns `false`; the
/// result is the best network so far. A network that was trained before starts from its weights, standardised anew by
/// these rows.
///
/// # Panics
///
/// If the share of the prior is not between 0 and 1, or the rows have another form than the network.
pub fn train<T: Real>(
    start: Net<T>,
    rows: &Rows,
    held_out: &Rows,
    with: &Training,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> Result<Trained<T>, Box<Diverged<T>>> {
    resume(State::new(start, rows), rows, held_out, with, watch)
}

/// As [`train`], from stored data of a training with the same start, with a call at each border between steps.
///
/// # Errors
/// The data belongs to another training.
///
/// # Panics
///
/// See [`train`].
pub fn train_along<T: Real>(
    start: Net<T>,
    rows: &Rows,
    held_out: &Rows,
    with: &Training,
    watch: &mut dyn FnMut(Progress) -> bool,
    way: Way<'_>,
) -> Result<Result<Trained<T>, Box<Diverged<T>>>, Unfit> {
    let (mut state, mut history, mut sums) = (State::new(start, rows), Vec::new(), (0.0, 0.0));
    if let Some(left) = &way.left {
        let State { net, adam, best, .. } = &mut state;
        let weights = &mut net.weights;
        if !left.put(Moving { weights, adam, best, sums: &mut sums, history: &mut history }) {
            return Err(Unfit);
        }
    }
    Ok(steps(state, rows, held_out, with, watch, (history, sums), way.border))
}

/// Resumes training until `with.steps` steps in total.
///
/// # Panics
///
/// See [`train`].
pub fn resume<T: Real>(
    state: State<T>,
    rows: &Rows,
    held_out: &Rows,
    with: &Training,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> Result<Trained<T>, Box<Diverged<T>>> {
    steps(state, rows, held_out, with, watch, (Vec::new(), (0.0, 0.0)), &mut |_| {})
}

/// The progress at the looks, and the sum and the number of the losses since the last look.
type Seen = (Vec<Progress>, (f64, f64));

fn steps<T: Real>(
    mut state: State<T>,
    rows: &Rows,
    held_out: &Rows,
    with: &Training,
    watch: &mut dyn FnMut(Progress) -> bool,
    (mut history, (mut sum, mut count)): Seen,
    border: &mut dyn FnMut(&dyn Fn() -> Stored),
) -> Result<Trained<T>, Box<Diverged<T>>> {
    assert!(with.share > 0.0 && with.share < 1.0, "the prior's share is {}", with.share);
    let mut chunks = Vec::new();
    state.room(with.batch, &mut chunks);
    let last = if rows.is_empty() { state.step() } else { with.steps };
    loop {
        // Training that resumes has looked at its first step.
        let has_looked = history.last().is_some_and(|progress| progress.step == state.step());
        if !has_looked && (state.step().is_multiple_of(with.every.max(1)) || state.step() >= last) {
            let loss_held_out = if held_out.is_empty() { None } else { Some(state.look(held_out, with)) };
            let held_out = loss_held_out.unwrap_or(sum / f64::max(count, 1.0));
            if held_out < state.best.0 || loss_held_out.is_none() {
                state.best = (held_out, state.step(), state.averaged(with.averaging));
            }
            let loss = if count > 0.0 { sum / count } else { held_out };
            let best = (state.best.0, state.best.1);
            let progress = Progress { step: state.step(), steps: with.steps, loss, held_out, best };
            history.push(progress);
            (sum, count) = (0.0, 0.0);
            if !watch(progress) || state.step() >= last {
                break;
            }
        }
        border(&|| Stored::of(&state.net.weights, &state.adam, &state.best, (sum, count), &history));
        match state.advance(rows, with, &mut chunks) {
            Ok(loss) => {
                sum += loss;
                count += 1.0;
            }
            Err((site, loss)) => {
                let net = Box::new(state.folded(state.best.2.clone()));
                return Err(Box::new(Diverged { step: state.step() + 1, site, loss, net }));
            }
        }
    }
    let net = state.folded(state.best.2.clone());
    Ok(Trained { net, best: (state.best.0, state.best.1), history, state })
}
