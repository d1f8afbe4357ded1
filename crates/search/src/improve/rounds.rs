//! The rounds of a search. Each makes steps of one arm from the best run, and the arms share the rounds by their gains.

use super::arms::{self, Arm, Form, POPULATION, Step};
use super::edits::Tries;
use super::{Improve, population_seed};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::Proposer;
use niwaki_chain::plan::Plan;
use niwaki_chain::stored::StoredState;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_chain::{Chain, Settings as ChainSettings};
use niwaki_math::Stream;
use niwaki_math::bits;
use niwaki_particles::rejuvenation::spreads;
use niwaki_particles::{Result, Settings, smc};
use niwaki_run::log::Entry;
use niwaki_run::replay::by_address;
use niwaki_run::run::Run;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::index;
use niwaki_run::{Failure, Task};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::time::Duration;

/// Number of rounds that together cost as much as the first population.
pub(super) const PER_POPULATION: u64 = 5;
/// The share of an arm's gain that is forgotten with each of its rounds.
const FORGOTTEN: f64 = 0.5;
/// The share of the rounds for the arm with the least work so far.
const EVEN: f64 = 0.25;

/// The report of a round.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Round {
    /// The kind of step.
    pub step: Step,
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
    learnt: Learnt,
    tries: Tries,
}

/// The experience of a search with its arms, for a search that goes on elsewhere: the step of each arm, the bits of its latest gain, and
/// its work.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Learnt(Vec<(Step, Option<u64>, u64)>);

/// An arm, and what its rounds have shown.
struct Tally {
    arm: &'static Arm,
    /// The latest gain, nats for the work of a round; `None` before its first round.
    gain: Option<f64>,
    /// The work so far.
    spent: u64,
}

/// The tallies of the arms of a task, before their first rounds.
fn tallies(improve: &Improve, task: &Task) -> Vec<Tally> {
    let tally = |arm| Tally { arm, gain: None, spent: 0 };
    arms::suitable(&improve.sizes(), task).into_iter().map(tally).collect()
}

/// Notes a population that another has made: so much work, and no gain.
fn note_population(tallies: &mut [Tally], spent: u64) {
    let population = tallies.iter_mut().find(|tally| tally.arm.step == POPULATION.step);
    population.into_iter().for_each(|tally| (tally.gain, tally.spent) = (Some(0.0), spent));
}

impl Learnt {
    /// Gives it to the arms of a search.
    fn give(&self, tallies: &mut [Tally]) {
        for (step, gain, spent) in &self.0 {
            let tally = tallies.iter_mut().find(|tally| tally.arm.step == *step);
            tally
                .into_iter()
                .for_each(|tally| (tally.gain, tally.spent) = (gain.map(f64::from_bits), *spent));
        }
    }
}

/// The search while it runs.
pub(super) struct Search<'a> {
    pub(super) task: &'a Task,
    pub(super) improve: &'a Improve,
    pub(super) seed: u64,
    /// The work of a round.
    pub slice: u64,
    /// The spreads of choices, for small steps; empty before the first round of moves.
    pub(super) spreads: HashMap<u128, f64>,
    pub best: Run,
    /// The state from which chains continue; absent only while a chain runs, and if the search was stopped at once.
    pub(super) state: Option<State>,
    /// Number of populations so far.
    populations: u64,
    /// The arms that suit the task.
    tallies: Vec<Tally>,
    /// The edits so far.
    pub(super) tries: Tries,
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
        let mut tallies = tallies(improve, task);
        // The first population has shown the gain of populations.
        note_population(&mut tallies, unit);
        Ok(Search {
            task,
            improve,
            seed,
            slice,
            spreads,
            best,
            state,
            populations,
            tallies,
            tries: Tries::default(),
        })
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
        let mut tallies = tallies(improve, task);
        // Whoever starts such a search makes populations elsewhere.
        note_population(&mut tallies, slice * PER_POPULATION);
        learnt.inspect(|learnt| learnt.give(&mut tallies));
        Search {
            task,
            improve,
            seed,
            slice,
            spreads,
            best,
            state: Some(state),
            populations: 1,
            tallies,
            tries: Tries::default(),
        }
    }

    /// The gains that the search has learnt.
    pub fn learnt(&self) -> Learnt {
        let of = |tally: &Tally| (tally.arm.step, tally.gain.map(f64::to_bits), tally.spent);
        Learnt(self.tallies.iter().map(of).collect())
    }

    /// The search as data, between two rounds; `None` if it was stopped before its first round.
    pub fn stored(&self) -> Option<Stored<&Run>> {
        Some(Stored {
            best: &self.best,
            state: StoredState::of(self.state.as_ref()?, &self.task.program),
            slice: self.slice,
            populations: self.populations,
            learnt: self.learnt(),
            tries: self.tries,
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
        let Stored { best, state, slice, populations, learnt, tries } = stored;
        let state = Some(state.state(task)?);
        let (best, spreads) = (with_value(task, best)?, HashMap::new());
        let mut tallies = tallies(improve, task);
        learnt.give(&mut tallies);
        Ok(Search { task, improve, seed, slice, spreads, best, state, populations, tallies, tries })
    }

    /// Makes a round; all rounds have about equal work. Returns its kind of step, its work, and how many parts were grown again and kept.
    /// `may_continue` is called with the best log score, and ends the round when it returns false.
    pub fn round(
        &mut self,
        number: u64,
        may_continue: &mut dyn FnMut(f64) -> bool,
    ) -> std::result::Result<(Step, u64, u64), Failure> {
        let index = self.pick(&mut Reserved::Improve.stream(self.seed, u128::from(number), 0));
        let (arm, before) = (self.tallies[index].arm, self.best.log_score);
        let (work, parts) = match arm.form {
            Form::Population(settings) => {
                (self.population(settings(&self.improve.sizes()), may_continue)?, 0)
            }
            Form::Edits(kernel) => self.levels(&kernel(&self.improve.sizes())?, number, may_continue)?,
            Form::Chain(kernel, steps) => {
                self.step(&kernel(&self.improve.sizes())?, steps, number, may_continue)?
            }
        };
        let rate = (self.best.log_score - before).max(0.0) * self.slice as f64 / work.max(1) as f64;
        let mixed = |old: f64| FORGOTTEN * old + (1.0 - FORGOTTEN) * rate;
        let tally = &mut self.tallies[index];
        tally.gain = Some(tally.gain.map_or(rate, mixed));
        tally.spent += work;
        Ok((arm.step, work, parts))
    }

    /// The index of the next arm among those for such a run: first each once, then by their latest gains.
    fn pick(&self, rng: &mut Stream) -> usize {
        let reals = self.state.as_ref().map_or(0, |state| state.reals(&self.task.program));
        let mut able: Vec<usize> = (0..self.tallies.len()).collect();
        able.retain(|at| self.tallies[*at].arm.most_reals >= reals);
        if let Some(new) = able.iter().find(|at| self.tallies[**at].gain.is_none()) {
            return *new;
        }
        let gains: Vec<f64> = able.iter().filter_map(|at| self.tallies[*at].gain).collect();
        let u = rng.uniform();
        if gains.iter().all(|gain| *gain <= 0.0) || u < EVEN {
            return able.into_iter().min_by_key(|at| self.tallies[*at].spent).unwrap_or(0);
        }
        able[index(&gains, (u - EVEN) / (1.0 - EVEN))]
    }

    /// Makes another population, with a seed of its own. Returns its work.
    fn population(
        &mut self,
        settings: Settings,
        may_continue: &mut dyn FnMut(f64) -> bool,
    ) -> std::result::Result<u64, Failure> {
        let (so_far, number) = (self.best.log_score, self.populations);
        self.populations += 1;
        let settings = Settings { seed: population_seed(self.seed, number), ..settings };
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

    /// Makes what a kernel needs before its first round.
    pub(super) fn prepare(&mut self, kernel: &Kernel) -> std::result::Result<(), Failure> {
        let drifts = kernel.any(&|kernel| matches!(kernel, Kernel::Leaf(Proposer::Drift(_))));
        if drifts && self.spreads.is_empty() {
            self.spreads = spreads(self.task, self.seed)?;
        }
        Ok(())
    }

    /// Makes steps of a chain from the present run, `steps` between two looks at its work. Returns their work and how many parts were
    /// grown again and kept.
    fn step(
        &mut self,
        kernel: &Kernel,
        steps: u64,
        number: u64,
        may_continue: &mut dyn FnMut(f64) -> bool,
    ) -> std::result::Result<(u64, u64), Failure> {
        let settings = ChainSettings { seed: self.seed, thin: 0, ..ChainSettings::default() };
        let plan = Plan::new(kernel)?;
        self.prepare(kernel)?;
        let Some(state) = self.state.take() else { return Ok((self.slice, 0)) };
        let mut chain: Chain = Chain::at(self.task, &settings, number, plan, state, &self.spreads)?;
        chain.restrict(self.improve.power, None);
        let so_far = self.best.log_score;
        if !chain.state.trace.is_empty() {
            while chain.work() < self.slice && may_continue(so_far.max(chain.best.score())) {
                chain.advance(self.task, steps, &mut |_, _| true)?;
            }
        }
        if chain.best.score() > so_far {
            self.best = chain.best.get(&chain.state, self.task)?;
        }
        let grows = kernel.any(&|kernel| matches!(kernel, Kernel::Leaf(Proposer::Regrow(_))));
        let (work, parts) = (chain.work(), if grows { chain.counts.many.accepted } else { 0 });
        self.state = Some(chain.into_state());
        Ok((work, parts))
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
    at_choices(task, &best.log.entries())
}

/// The run with these choices, and a chain's state at it.
///
/// # Errors
/// The run is impossible, or a fault of the program.
pub(super) fn at_choices(task: &Task, choices: &[Entry]) -> std::result::Result<(Run, State), Failure> {
    let (state, _) = State::start(task, Streams::new(0, 0), 1, Some(&by_address(choices)))?;
    Ok((state.run(&task.program, 0), state))
}

/// The run with the best score among the possible particles that pass.
fn most(result: Result, passes: impl Fn(&Run) -> bool) -> Option<Run> {
    let possible = result.particles.into_iter().filter(|run| run.cause.is_none() && passes(run));
    possible.max_by(|a, b| a.log_score.total_cmp(&b.log_score))
}
