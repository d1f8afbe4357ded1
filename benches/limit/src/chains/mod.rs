//! Single-site Metropolis-Hastings written by hand for the models of the dissertation's appendix A.
//!
//! Each proposal scores just the terms that the changed choice can change: its Markov blanket. Members of a component or
//! of a topic are kept in lists, so that a new mean visits its own points only; no sum over members is kept, so
//! this is a limit for updates of the blanket, not for shortcuts by conjugacy. Discrete choices, probability vectors and
//! deviations are proposed from the prior; means, intercepts and slopes drift by Gaussian steps.
//!
//! `check` holds each local log ratio against the difference of two full log densities.
mod gmm;
mod hlr;
mod hmm;
mod lda;

use crate::cpu_seconds;
use crate::population::{Random, SeedableRng, uniform};
use rand::RngExt;
use rand_distr::{Distribution, Exp1, StandardNormal};
use serde_json::{Value, json};

/// What one proposal did.
#[derive(Default, Clone, Copy)]
struct Step {
    accepted: bool,
    /// Log of the acceptance ratio; worked out only where it is checked, unless it decides.
    log_ratio: f64,
    /// Change of the choice's own log prior, where the proposal is the prior and it cancels; only where checked.
    own_prior: f64,
}

/// The old value was drawn again.
const SAME: Step = Step { accepted: true, log_ratio: 0.0, own_prior: 0.0 };

/// A model with its present state. Choices are numbered, those that many others read first.
trait Model {
    fn choices(&self) -> usize;

    /// Numbers of the global choices that have a row of their own: topics, means of components, means of populations.
    fn globals(&self) -> std::ops::Range<usize>;

    /// How many terms of the density read a global choice.
    fn readers(&self, choice: usize) -> usize;

    /// Proposes a new value for one choice; `forced` accepts it whatever the ratio.
    fn propose<const CHECKED: bool>(&mut self, choice: usize, random: &mut Random, forced: bool) -> Step;

    /// Log of the full density up to a constant, from nothing.
    fn log_joint(&self) -> f64;

    /// What the chains of two systems are compared by; none for most.
    fn moments(&self) -> Vec<f64> {
        vec![]
    }
}

fn decide(random: &mut Random, log_ratio: f64, forced: bool) -> bool {
    forced || log_ratio >= 0.0 || uniform(random) < log_ratio.exp()
}

/// A whole number below `n`, by multiplication.
#[inline]
fn below(random: &mut Random, n: usize) -> usize {
    ((u64::from(random.random::<u32>()) * n as u64) >> 32) as usize
}

#[inline]
fn normal(random: &mut Random) -> f64 {
    StandardNormal.sample(random)
}

/// An index from probabilities that add up to one.
#[inline]
fn draw(random: &mut Random, probabilities: &[f64]) -> usize {
    let u = uniform(random);
    let (mut index, mut sum) = (0, 0.0);
    for &p in &probabilities[..probabilities.len() - 1] {
        sum += p;
        index += usize::from(u >= sum);
    }
    index
}

/// Probabilities drawn uniformly from all there are.
#[inline]
fn simplex(random: &mut Random, out: &mut [f64]) {
    let mut sum = 0.0;
    for x in out.iter_mut() {
        *x = Exp1.sample(random);
        sum += *x;
    }
    for x in out.iter_mut() {
        *x /= sum;
    }
}

fn log_normal(x: f64, mean: f64, sd: f64) -> f64 {
    let z = (x - mean) / sd;
    -0.5 * z * z - sd.ln()
}

/// Who belongs to which group: lists of members, and where each stands in its list.
struct Groups {
    members: Vec<Vec<u32>>,
    place: Vec<u32>,
}

impl Groups {
    fn new(groups: usize) -> Self {
        Self { members: vec![vec![]; groups], place: vec![] }
    }

    /// The next one, in a group.
    fn push(&mut self, group: usize) {
        self.members[group].push(self.place.len() as u32);
        self.place.push(self.members[group].len() as u32 - 1);
    }

    fn relocate(&mut self, one: usize, from: usize, to: usize) {
        let place = self.place[one];
        let last = self.members[from].pop().expect("it is a member");
        if last as usize != one {
            self.members[from][place as usize] = last;
            self.place[last as usize] = place;
        }
        self.place[one] = self.members[to].len() as u32;
        self.members[to].push(one as u32);
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn indices(value: &Value) -> Vec<u32> {
    numbers(value).into_iter().map(|x| x as u32).collect()
}

/// Proposals before the clock starts.
const WARMUP: usize = 200_000;
/// Proposals between two looks at the clock.
const BLOCK: usize = 20_000;

/// Proposals per CPU second: of any choice, or of the global ones in turn.
fn rate(mut model: impl Model, random: &mut Random, seconds: f64, only_globals: bool) -> Value {
    for _ in 0..WARMUP {
        let choice = below(random, model.choices());
        model.propose::<false>(choice, random, false);
    }
    let globals = model.globals();
    let (start, mut proposals, mut accepted, mut readers) = (cpu_seconds(), 0, 0, 0);
    while cpu_seconds() - start < seconds {
        for i in 0..BLOCK {
            let choice = if only_globals {
                let choice = globals.start + i % globals.len();
                readers += model.readers(choice);
                choice
            } else {
                below(random, model.choices())
            };
            accepted += usize::from(model.propose::<false>(choice, random, false).accepted);
        }
        proposals += BLOCK;
    }
    let taken = cpu_seconds() - start;
    json!({
        "proposals": proposals, "cpu_seconds": taken, "choices": model.choices(),
        "accepted": accepted as f64 / proposals as f64, "readers": readers as f64 / proposals as f64,
    })
}

/// The worst relative error of a local log ratio, and means of the model's moments over a chain.
fn check(mut model: impl Model, random: &mut Random, moves: usize) -> Value {
    let step = |model: &mut _, random: &mut Random, forced| {
        let choice = below(random, Model::choices(model));
        Model::propose::<true>(model, choice, random, forced)
    };
    let (mut worst, mut moved) = (0.0f64, 0);
    for i in 0..40_000 {
        let before = model.log_joint();
        let done = step(&mut model, random, i > 20_000 && i % 3 == 0);
        if done.accepted && done.log_ratio.is_finite() {
            let full = model.log_joint() - before - done.own_prior;
            worst = worst.max((full - done.log_ratio).abs() / (1.0 + full.abs()));
            moved += 1;
        }
    }
    for _ in 0..moves / 5 {
        step(&mut model, random, false);
    }
    let mut sums = vec![0.0; model.moments().len()];
    for _ in 0..moves {
        step(&mut model, random, false);
        for (sum, x) in sums.iter_mut().zip(model.moments()) {
            *sum += x;
        }
    }
    let means: Vec<f64> = sums.iter().map(|sum| sum / moves as f64).collect();
    json!({"worst": worst, "moved": moved, "moments": means})
}

/// `what` is `rate`, `globals` or `check`.
pub fn run(what: &str, program: &str, data: &str, seconds: f64, seed: u64) -> Value {
    let text = std::fs::read_to_string(data).unwrap_or_else(|error| panic!("{data}: {error}"));
    let data: Value = serde_json::from_str(&text).expect("JSON");
    let random = &mut Random::seed_from_u64(seed);
    macro_rules! with {
        ($model:expr) => {{
            let model = $model;
            match what {
                "check" => check(model, random, 2_000_000),
                _ => rate(model, random, seconds, what == "globals"),
            }
        }};
    }
    match program {
        "hmm" => with!(hmm::Hmm::new(&data, random)),
        "lda" => with!(lda::Lda::new(&data, random)),
        "gmm" => with!(gmm::Gmm::new(&data, random)),
        "hlr" => with!(hlr::Hlr::new(&data, random)),
        _ => panic!("no program {program}"),
    }
}
