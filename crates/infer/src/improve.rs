//! A search for the best run that spends a given effort where it gains: a search, not a sampler, with no evidence and no
//! weights.
//!
//! 1. *Begin*: populations of particles, until one has a possible run. What the first costs is the unit of effort.
//! 2. *Rounds* of a fifth of that unit. Each makes one kind of step from the present run, and the kinds share the rounds by what
//!    they gained lately: parts grown again by few or by many particles, single choices that move, a new
//!    population.
//! 3. *End* after the given number of rounds, when the time is over, or when nothing has been gained for long.
//!
//! Work is counted, not timed: particle-steps of populations and of parts, proposals, and shapes that proposals place or remove.
//! So a search with a number of rounds has the same bits on any machine; one with a time reports how many it made.

use crate::chain::kernel::Kernel;
use crate::chain::plan::Plan;
use crate::chain::state::State;
use crate::chain::streams::below;
use crate::chain::{Chain, Settings as ChainSettings};
use crate::particles::rejuvenation::spreads;
use crate::particles::{self, Outcome, Progress, smc};
use crate::replay::by_address;
use crate::run::Run;
use crate::streams::Reserved;
use crate::weights::index;
use crate::{Failure, Task};
use niwaki_math::{RngCore, Stream};
use niwaki_vm::fault::Fault;
use serde::Deserialize;
use serde_json::json;
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// Rounds that together cost as much as the first population.
const ROUNDS_PER_POPULATION: u64 = 5;
/// A gain below this, nats, counts as none.
const LEAST_GAIN: f64 = 0.01;
/// Without a gain in so many rounds, or in half of all, a search ends.
const PATIENCE: u64 = 20;
/// Populations that may die before the search gives up; after every two of them the next ones are twice as large.
const DEATHS: usize = 6;
/// How much of what a kind of step gained is forgotten with each of its rounds.
const FORGOTTEN: f64 = 0.5;
/// The share of the rounds that is divided evenly.
const EVEN: f64 = 0.25;

/// The settings.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Improve {
    /// Particles of a population.
    particles: usize,
    /// Particles that grow a part again.
    regrow: usize,
    /// The power of the score.
    power: f64,
    /// Most rounds.
    rounds: u64,
    /// Most seconds.
    seconds: Option<f64>,
}

/// A kind of step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A population from the start.
    Population,
    /// Parts grown again by few particles.
    Regrow,
    /// Parts grown again by five times as many.
    RegrowMore,
    /// Single choices, and calls drawn anew.
    Move,
}

impl Kind {
    const ALL: [Kind; 4] = [Kind::Regrow, Kind::Move, Kind::RegrowMore, Kind::Population];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Population => "population",
            Kind::Regrow => "regrow",
            Kind::RegrowMore => "regrow more",
            Kind::Move => "move",
        }
    }
}

/// What one round did.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// Its kind of step.
    pub kind: Kind,
    /// Its work.
    pub work: u64,
    /// Best log score after it, nats.
    pub best: f64,
}

/// How a search for the best went.
pub struct Improved {
    /// The first population that lived, and each round.
    pub rounds: Vec<Round>,
    /// Populations in which every particle became impossible.
    pub died: usize,
    /// Whether it was stopped.
    pub interrupted: bool,
}

/// The search while it runs.
struct Search<'a> {
    task: &'a Task,
    own: &'a Improve,
    seed: u64,
    spreads: HashMap<u128, f64>,
    best: Run,
    /// Where chains go on; absent only while one runs.
    state: Option<State>,
    populations: u64,
}

impl Improve {
    fn check(&self) -> Result<(), Fault> {
        let wrong = |what: String, help: &str| Err(Fault::new("bad-setting", what).with_help(help));
        if self.particles == 0 || self.regrow < 2 {
            return wrong("`improve` needs particles, and two to grow a part again".into(), "use more");
        }
        if !(self.power > 0.0 && self.power.is_finite()) {
            return wrong(format!("the power is {}", self.power), "use a positive number");
        }
        Ok(())
    }

    /// Searches for the best run. `watch` is called with the number of rounds and the best log score; when it returns false, the search ends
    /// with its best so far.
    ///
    /// # Errors
    /// Settings that make no sense, a fault of the program, or first populations that all died.
    pub fn search(
        &self,
        task: &Task,
        seed: u64,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<(Run, Improved), Failure> {
        self.check()?;
        let end = self.seconds.map(|seconds| {
            let time = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::ZERO);
            (Instant::now(), time)
        });
        let is_late = || end.is_some_and(|(start, time)| start.elapsed() >= time);
        let (mut died, mut size) = (0, self.particles);
        let (first, steps) = loop {
            let settings = self.population(seed, died as u64, size);
            match smc(task, &settings, watch) {
                Ok(result) => break (result, settings.particles),
                Err(failure) if failure.is_impossible() && died + 1 < DEATHS && !is_late() => {
                    died += 1;
                    size <<= usize::from(died % 2 == 0);
                }
                Err(failure) => return Err(failure),
            }
        };
        let slice = (first.steps * self.particles as u64 / steps as u64 / ROUNDS_PER_POPULATION).max(1);
        let mut rounds = vec![];
        let mut interrupted = first.interrupted;
        let work = first.steps;
        if interrupted {
            let best = most(first, |_| true).map(Run::from).ok_or_else(Failure::no_start)?;
            rounds.push(Round { kind: Kind::Population, work, best: best.log_score });
            return Ok((best, Improved { rounds, died, interrupted }));
        }
        let (best, state) = best_of(task, first)?;
        rounds.push(Round { kind: Kind::Population, work, best: best.log_score });
        let spreads = spreads(task, seed)?;
        let mut search =
            Search { task, own: self, seed, spreads, best, state: Some(state), populations: died as u64 + 1 };
        let mut gains = [None; Kind::ALL.len()];
        let (mut number, mut idle) = (0, 0);
        while number < self.rounds && idle < PATIENCE.max(number / 2) && !interrupted && !is_late() {
            let which = pick(&gains, &mut Reserved::Improve.stream(seed, u128::from(number), 0));
            let before = search.best.log_score;
            let mut go_on = |best: f64| {
                interrupted |= !watch(Progress { barriers: number as usize, ended: 1, best });
                !interrupted
            };
            let work = search.round(Kind::ALL[which], number, slice, &mut go_on)?;
            number += 1;
            let gain = (search.best.log_score - before).max(0.0);
            idle = if gain < LEAST_GAIN { idle + 1 } else { 0 };
            let rate = gain * slice as f64 / work.max(1) as f64;
            gains[which] = Some(gains[which].map_or(rate, |old| FORGOTTEN * old + (1.0 - FORGOTTEN) * rate));
            rounds.push(Round { kind: Kind::ALL[which], work, best: search.best.log_score });
        }
        Ok((search.best, Improved { rounds, died, interrupted }))
    }

    /// The settings of a population, by its number.
    fn population(&self, seed: u64, number: u64, particles: usize) -> particles::Settings {
        let own = Reserved::Improve.stream(seed, u128::from(number), 1).next_u64();
        let seed = if number == 0 { seed } else { own };
        particles::Settings { particles, seed, power: self.power, ..particles::Settings::default() }
    }

    /// The kernel of a kind of step.
    fn kernel(&self, kind: Kind) -> Result<Kernel, Fault> {
        let leaf = |name, settings| {
            Kernel::leaf(name, settings).map_err(|error| Fault::new("bad-kernel", error.to_string()))
        };
        let regrow = |particles| leaf("regrow", json!({"particles": particles, "turn": 0.5, "pick": "size"}));
        let drift = |step| leaf("drift", json!({"step": step, "target": 0.44}));
        match kind {
            Kind::Regrow => regrow(self.regrow),
            Kind::RegrowMore => regrow(5 * self.regrow),
            _ => Ok(Kernel::Mixture(vec![
                (4.0, Kernel::PRIOR),
                (4.0, drift(0.3)?),
                (2.0, drift(0.05)?),
                (1.0, leaf("regenerate", json!({"levels": 0}))?),
            ])),
        }
    }
}

impl Search<'_> {
    /// One round of about so much work; returns what it cost. `go_on` is called with the best log score, and ends the round where
    /// it returns false.
    fn round(
        &mut self,
        kind: Kind,
        number: u64,
        slice: u64,
        go_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<u64, Failure> {
        let so_far = self.best.log_score;
        if kind == Kind::Population {
            let settings = self.own.population(self.seed, self.populations, self.own.particles);
            self.populations += 1;
            return match smc(self.task, &settings, &mut |_| go_on(so_far)) {
                Ok(result) if result.interrupted => Ok(result.steps),
                Ok(result) => {
                    let work = result.steps;
                    let (best, state) = best_of(self.task, result)?;
                    if best.log_score > self.best.log_score {
                        (self.best, self.state) = (best, Some(state));
                    }
                    Ok(work)
                }
                Err(failure) if failure.is_impossible() => Ok(slice),
                Err(failure) => Err(failure),
            };
        }
        let settings = ChainSettings { seed: self.seed, thin: 0, ..ChainSettings::default() };
        let plan = Plan::new(&self.own.kernel(kind)?)?;
        let Some(state) = self.state.take() else { return Ok(slice) };
        let mut chain: Chain = Chain::at(self.task, &settings, number, plan, state, &self.spreads)?;
        chain.restrict(self.own.power, None);
        let before = chain.work();
        if !chain.state.trace.is_empty() {
            let steps = if kind == Kind::Move { 32 } else { 1 };
            while chain.work() < before + slice && go_on(so_far.max(chain.best.score())) {
                chain.advance(self.task, steps, &mut |_, _| true)?;
            }
        }
        if chain.best.score() > self.best.log_score {
            self.best = chain.best.get(&chain.state, self.task)?;
        }
        let work = chain.work() - before;
        self.state = Some(chain.state);
        Ok(work)
    }
}

/// Which kind of step is next: each once, and then by what they gained lately.
fn pick(gains: &[Option<f64>], rng: &mut Stream) -> usize {
    if let Some(new) = gains.iter().position(Option::is_none) {
        return new;
    }
    let gains: Vec<f64> = gains.iter().copied().flatten().collect();
    let u = rng.uniform();
    if gains.iter().all(|gain| *gain <= 0.0) || u < EVEN {
        return below(rng, gains.len() as u64) as usize;
    }
    index(&gains, (u - EVEN) / (1.0 - EVEN))
}

/// The best run of a population, and a chain's state there.
fn best_of(task: &Task, result: particles::Result) -> Result<(Run, State), Failure> {
    let mut best = most(result, |one| one.has_ended).ok_or_else(Failure::no_start)?;
    let sketches = std::mem::take(&mut best.record.sketches);
    let state =
        State::of_run(task, &by_address(&best.record.log.entries()), sketches, best.record.primitives)?;
    let run = state.run(&task.program, 0);
    Ok((run, state))
}

/// The particle with the best score among those that are possible and pass.
fn most(result: particles::Result, passes: impl Fn(&Outcome) -> bool) -> Option<Outcome> {
    let possible = result.particles.into_iter().filter(|one| one.record.cause.is_none() && passes(one));
    possible.max_by(|a, b| a.record.log_score().total_cmp(&b.record.log_score()))
}
