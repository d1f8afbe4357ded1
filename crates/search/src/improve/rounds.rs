//! The rounds of a search. Each makes steps of one kind from the best run, and the kinds share the rounds by their gains.

use super::{Improve, population_seed};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::plan::Plan;
use niwaki_chain::stored::StoredState;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_chain::{Chain, Settings as ChainSettings};
use niwaki_math::Stream;
use niwaki_math::bits;
use niwaki_particles::rejuvenation::spreads;
use niwaki_particles::{Result, Settings, smc};
use niwaki_run::replay::by_address;
use niwaki_run::run::Run;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::index;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::HashMap;
use std::time::Duration;

/// Number of rounds that together cost as much as the first population.
pub(super) const PER_POPULATION: u64 = 5;
/// The share of a kind's gain that is forgotten with each of its rounds.
const FORGOTTEN: f64 = 0.5;
/// The share of the rounds for the kind with the least work so far.
const EVEN: f64 = 0.25;
/// The probability that a discrete choice of a part turns when the part is grown again.
const TURN: f64 = 0.7;
/// Factor of the number of particles that grow a part again in rounds of "regrow more".
const MORE: usize = 5;

/// A kind of step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    /// A population from the start.
    Population,
    /// A population from the start, from whose best run the next rounds go on.
    Restart,
    /// Parts grown again by few particles.
    Regrow,
    /// Parts grown again by five times as many particles.
    RegrowMore,
    /// Moves of single choices, and calls drawn anew.
    Move,
}

impl Kind {
    /// The kinds that share the rounds. A restart is no step from the best run.
    const ALL: [Kind; 4] = [Kind::Regrow, Kind::Move, Kind::RegrowMore, Kind::Population];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Population => "population",
            Kind::Restart => "restart",
            Kind::Regrow => "regrow",
            Kind::RegrowMore => "regrow more",
            Kind::Move => "move",
        }
    }
}

/// The report of a round.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Round {
    /// The kind of step.
    pub kind: Kind,
    /// The work of the round.
    pub work: u64,
    /// The number of parts that were grown again and kept.
    pub parts: u64,
    /// Best log score after the round, nats.
    #[serde(with = "bits")]
    pub best: f64,
    /// Time since the search began.
    pub time: Duration,
}

/// A search as data; the spreads for small steps are computed again.
#[derive(Serialize, Deserialize)]
pub(super) struct Stored<R> {
    best: R,
    state: StoredState,
    slice: u64,
    populations: u64,
    gains: [Option<u64>; Kind::ALL.len()],
    spent: [u64; Kind::ALL.len()],
}

/// The gains that a search has learnt, for a search that goes on elsewhere.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Learnt {
    gains: [Option<u64>; Kind::ALL.len()],
    spent: [u64; Kind::ALL.len()],
}

/// The search while it runs.
pub(super) struct Search<'a> {
    task: &'a Task,
    improve: &'a Improve,
    seed: u64,
    /// The work of a round.
    pub slice: u64,
    /// The spreads of choices, for small steps; empty before the first round of moves.
    spreads: HashMap<u128, f64>,
    pub best: Run,
    /// The state from which chains continue; absent only while a chain runs, and if the search was stopped at once.
    state: Option<State>,
    /// Number of populations so far.
    populations: u64,
    /// Latest gain of each kind, nats for the work of a round.
    gains: [Option<f64>; Kind::ALL.len()],
    /// Work of each kind so far.
    spent: [u64; Kind::ALL.len()],
}

impl<'a> Search<'a> {
    /// A search from the best run of a first population, the `populations`-th, whose cost for the declared size is `unit`.
    pub fn begin(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        unit: u64,
        populations: u64,
        first: Result,
    ) -> std::result::Result<Search<'a>, Failure> {
        let (best, state) = if first.interrupted {
            let best = most(first, |_| true).ok_or_else(Failure::no_start)?;
            (best, None)
        } else {
            let (best, state) = best_of(task, first)?;
            (best, Some(state))
        };
        let slice = (unit / PER_POPULATION).max(1);
        let spreads = HashMap::new();
        let (mut gains, mut spent) = ([None; Kind::ALL.len()], [0; Kind::ALL.len()]);
        // The first population has shown the gain of populations.
        let population = Kind::ALL.len() - 1;
        (gains[population], spent[population]) = (Some(0.0), unit);
        Ok(Search { task, improve, seed, slice, spreads, best, state, populations, gains, spent })
    }

    /// A search from a run and a chain's state at it, with rounds of this work, and with what another search has learnt.
    pub fn at(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        slice: u64,
        (best, state): (Run, State),
        learnt: Option<Learnt>,
        spreads: HashMap<u128, f64>,
    ) -> Search<'a> {
        let (mut gains, mut spent) = ([None; Kind::ALL.len()], [0; Kind::ALL.len()]);
        // Whoever starts such a search makes populations elsewhere.
        let population = Kind::ALL.len() - 1;
        (gains[population], spent[population]) = (Some(0.0), slice * PER_POPULATION);
        if let Some(learnt) = learnt {
            (gains, spent) = (learnt.gains.map(|gain| gain.map(f64::from_bits)), learnt.spent);
        }
        Search { task, improve, seed, slice, spreads, best, state: Some(state), populations: 1, gains, spent }
    }

    /// The gains that the search has learnt.
    pub fn learnt(&self) -> Learnt {
        Learnt { gains: self.gains.map(|gain| gain.map(f64::to_bits)), spent: self.spent }
    }

    /// The search as data, between two rounds; `None` if it was stopped before its first round.
    pub fn stored(&self) -> Option<Stored<&Run>> {
        Some(Stored {
            best: &self.best,
            state: StoredState::of(self.state.as_ref()?, &self.task.program),
            slice: self.slice,
            populations: self.populations,
            gains: self.gains.map(|gain| gain.map(f64::to_bits)),
            spent: self.spent,
        })
    }

    /// The search from its data.
    ///
    /// # Errors
    /// See [`StoredState::state`].
    pub fn restored(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        stored: Stored<Run>,
    ) -> std::result::Result<Search<'a>, Failure> {
        let Stored { best, state, slice, populations, gains, spent } = stored;
        let state = Some(state.state(task)?);
        let best = with_value(task, best)?;
        let gains = gains.map(|gain| gain.map(f64::from_bits));
        Ok(Search {
            task,
            improve,
            seed,
            slice,
            spreads: HashMap::new(),
            best,
            state,
            populations,
            gains,
            spent,
        })
    }

    /// Makes a round; all rounds have about equal work. Returns its kind, its work, and how many parts were grown again and kept.
    /// `may_continue` is called with the best log score, and ends the round when it returns false.
    pub fn round(
        &mut self,
        number: u64,
        may_continue: &mut dyn FnMut(f64) -> bool,
    ) -> std::result::Result<(Kind, u64, u64), Failure> {
        let index = self.pick(&mut Reserved::Improve.stream(self.seed, u128::from(number), 0));
        let (kind, before) = (Kind::ALL[index], self.best.log_score);
        let (work, parts) = match kind {
            Kind::Population => (self.population(may_continue)?, 0),
            _ => self.step(kind, number, may_continue)?,
        };
        let rate = (self.best.log_score - before).max(0.0) * self.slice as f64 / work.max(1) as f64;
        let mixed = |old: f64| FORGOTTEN * old + (1.0 - FORGOTTEN) * rate;
        self.gains[index] = Some(self.gains[index].map_or(rate, mixed));
        self.spent[index] += work;
        Ok((kind, work, parts))
    }

    /// The index of the next kind of step: first each kind once, then by their latest gains.
    fn pick(&self, rng: &mut Stream) -> usize {
        if let Some(new) = self.gains.iter().position(Option::is_none) {
            return new;
        }
        let gains: Vec<f64> = self.gains.iter().copied().flatten().collect();
        let u = rng.uniform();
        if gains.iter().all(|gain| *gain <= 0.0) || u < EVEN {
            let least = (0..gains.len()).min_by_key(|index| self.spent[*index]);
            return least.unwrap_or(0);
        }
        index(&gains, (u - EVEN) / (1.0 - EVEN))
    }

    /// Makes another population. Returns its work.
    fn population(&mut self, may_continue: &mut dyn FnMut(f64) -> bool) -> std::result::Result<u64, Failure> {
        let (so_far, number) = (self.best.log_score, self.populations);
        self.populations += 1;
        let seed = population_seed(self.seed, number);
        let (particles, power) = (self.improve.particles, self.improve.power);
        let proposal = self.improve.drawn_by.clone();
        let settings = Settings { particles, seed, power, proposal, ..Settings::default() };
        match smc(self.task, &settings, &mut |_| may_continue(so_far)) {
            Ok(result) => {
                let work = result.steps;
                if !result.interrupted {
                    let (best, state) = best_of(self.task, result)?;
                    if best.log_score > so_far {
                        (self.best, self.state) = (best, Some(state));
                    }
                }
                Ok(work)
            }
            Err(failure) if failure.is_impossible() => Ok(self.slice),
            Err(failure) => Err(failure),
        }
    }

    /// Makes steps of a chain from the present run. Returns their work and how many parts were grown again and kept.
    fn step(
        &mut self,
        kind: Kind,
        number: u64,
        may_continue: &mut dyn FnMut(f64) -> bool,
    ) -> std::result::Result<(u64, u64), Failure> {
        let settings = ChainSettings { seed: self.seed, thin: 0, ..ChainSettings::default() };
        let plan = Plan::new(&self.kernel(kind)?)?;
        if kind == Kind::Move && self.spreads.is_empty() {
            self.spreads = spreads(self.task, self.seed)?;
        }
        let Some(state) = self.state.take() else { return Ok((self.slice, 0)) };
        let mut chain: Chain = Chain::at(self.task, &settings, number, plan, state, &self.spreads)?;
        chain.restrict(self.improve.power, None);
        let (so_far, before) = (self.best.log_score, chain.work());
        if !chain.state.trace.is_empty() {
            let steps = if kind == Kind::Move { 32 } else { 1 };
            while chain.work() < before + self.slice && may_continue(so_far.max(chain.best.score())) {
                chain.advance(self.task, steps, &mut |_, _| true)?;
            }
        }
        if chain.best.score() > so_far {
            self.best = chain.best.get(&chain.state, self.task)?;
        }
        let (work, parts) = (chain.work() - before, chain.counts.many.accepted);
        self.state = Some(chain.into_state());
        Ok((work, parts))
    }

    /// The kernel of a kind of step.
    fn kernel(&self, kind: Kind) -> std::result::Result<Kernel, Fault> {
        let leaf = |name, settings| {
            Kernel::leaf(name, settings).map_err(|error| Fault::new("bad-kernel", error.to_string()))
        };
        let regrow = |particles| {
            let settings = json!({"particles": particles, "turn": TURN, "pick": "size", "best": true});
            let plain = leaf("regrow", settings)?;
            Ok(match &self.improve.drawn_by {
                None => plain,
                Some(proposal) => plain.drawn_by(proposal.clone()),
            })
        };
        let drift = |step| leaf("drift", json!({"step": step, "target": 0.44}));
        // The parts of a run share calls of memoised functions, so no part can be grown again.
        let shared = self.task.program.memoises();
        match kind {
            Kind::Regrow if !shared => regrow(self.improve.regrow),
            Kind::RegrowMore if !shared => regrow(MORE * self.improve.regrow),
            _ => Ok(Kernel::Mixture(vec![
                (4.0, Kernel::PRIOR),
                (4.0, drift(0.3)?),
                (2.0, drift(0.05)?),
                (1.0, leaf("regenerate", json!({"levels": 0}))?),
            ])),
        }
    }
}

/// A run from stored data, with the value that the program returns.
pub(super) fn with_value(task: &Task, run: Run) -> std::result::Result<Run, Failure> {
    let known = by_address(&run.log.entries());
    let (state, _) = State::start(task, Streams::new(0, 0), 1, Some(&known))?;
    Ok(Run { value: state.trace.result(), is_bare: false, ..run })
}

/// The best run of a population, and a chain's state at this run.
///
/// # Errors
/// No run has ended, or a fault of the program.
pub(super) fn best_of(task: &Task, result: Result) -> std::result::Result<(Run, State), Failure> {
    let best = most(result, |run| run.has_ended).ok_or_else(Failure::no_start)?;
    let known = by_address(&best.log.entries());
    let (state, _) = State::start(task, Streams::new(0, 0), 1, Some(&known))?;
    Ok((state.run(&task.program, 0), state))
}

/// The run with the best score among the possible particles that pass.
fn most(result: Result, passes: impl Fn(&Run) -> bool) -> Option<Run> {
    let possible = result.particles.into_iter().filter(|run| run.cause.is_none() && passes(run));
    possible.max_by(|a, b| a.log_score.total_cmp(&b.log_score))
}
