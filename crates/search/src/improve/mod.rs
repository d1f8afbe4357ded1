//! A search for the best run that spends a given effort where it gains: a search, not a sampler, with no evidence and no
//! weights.
//!
//! 1. *Begin* (`start`): populations of particles, until one has a possible run. What it costs is the unit of effort.
//! 2. *Rounds* (`rounds`) of a fifth of that unit. Each makes one kind of step from the best run, and the kinds share the
//!    rounds by what they gained lately: parts grown again by few or by many particles, single choices that move, a
//!    new population.
//! 3. *End* after the given number of rounds, when the time is over, or when nothing has been gained for long.
//!
//! Work is counted, not timed: particle-steps of populations and of parts, proposals, and shapes that proposals place or remove.
//! So a search with a number of rounds has the same bits on any machine; one with a time reports how many it made.
//!
//! A search is stored between two rounds (`stored`): its first population is begun again after a kill.
//!
//! Several results that differ are the ends of several smaller searches, side by side.

mod rounds;
mod start;
mod stored;

pub use rounds::{Kind, Round};

use niwaki_chain::form::Form;
use niwaki_math::RngCore;
use niwaki_particles::distinct::Choices;
use niwaki_particles::{Progress, Watch, side_by_side};
use niwaki_propose::proposal::Proposal;
use niwaki_run::checkpoint::Checkpoint;
use niwaki_run::failure::Attempt;
use niwaki_run::losses::Lost;
use niwaki_run::run::{Run, Shown};
use niwaki_run::setting::{COUNT, POSITIVE, Range, Ranges, whole};
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use rounds::Search;
use serde::Deserialize;
use std::sync::Arc;
use std::time::{Duration, Instant};
use stored::Stored;

/// Rounds where neither their number nor a time is given.
const USUAL_ROUNDS: u64 = 15;
/// A gain below this, nats, counts as none.
const LEAST_GAIN: f64 = 0.01;
/// Without a gain in so many rounds, or in half of all, a search ends.
const PATIENCE: u64 = 20;
/// The share of the particles that each of several searches for different results has.
const SHARE: f64 = 0.6;
/// How often further searches are made for results that are missing because others are like them.
const BATCHES: usize = 3;

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
    rounds: Option<u64>,
    /// Most seconds.
    seconds: Option<f64>,
    /// How many results that differ.
    diverse: Option<usize>,
    /// What draws choices in place of the prior, as data.
    pub(crate) proposal: Option<Form>,
    /// The same, for the search.
    #[serde(skip)]
    drawn_by: Option<Arc<Proposal>>,
}

/// Where others see what the search has.
#[derive(Clone, Copy, Default)]
pub struct Seen<'a> {
    /// Its best run so far.
    pub shown: Option<&'a Shown>,
    /// What it needs to go on after it was killed.
    pub checkpoint: Option<&'a Checkpoint>,
}

/// How a search for the best went; of several, the one with the best run.
#[derive(Default)]
pub struct Improved {
    /// The populations that were tried until one lived.
    pub attempts: Vec<Attempt>,
    /// That population, and each round.
    pub rounds: Vec<Round>,
    /// Searches.
    pub searches: usize,
    /// Whether it was stopped.
    pub interrupted: bool,
    /// Particles of the first population that lived which became impossible.
    pub lost: Lost,
}

impl Improve {
    /// Ranges of its settings.
    pub(crate) const RANGES: Ranges = &[
        ("particles", COUNT),
        ("regrow", whole(2)),
        ("power", POSITIVE),
        ("rounds", Range::Optional(&COUNT)),
        ("seconds", Range::Optional(&POSITIVE)),
        ("diverse", Range::Optional(&COUNT)),
    ];

    /// A setting and the rule that it breaks.
    pub(crate) fn broken_rule(&self) -> Option<(&'static str, &'static str)> {
        (self.diverse.is_some() && self.seconds.is_some()).then_some(("seconds", "seconds-diverse"))
    }

    /// Searches for the best run, or for several that differ, best first. Populations, and parts that are grown again,
    /// draw their choices from the `proposal`, where there is one. `watch` is called with the number of rounds and the best log score, after the best run
    /// is `shown`; when it returns false, the search ends with its best so far. Each search is a part of the `checkpoint`.
    ///
    /// # Errors
    /// A fault of the program, or first populations that all died.
    pub fn search(
        &self,
        task: &Task,
        seed: u64,
        proposal: Option<Arc<Proposal>>,
        seen: Seen<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<(Vec<Run>, Improved), Failure> {
        let own = Improve { drawn_by: proposal, ..self.clone() };
        match own.diverse {
            None => own.one(task, seed, 0, seen, watch).map(|(best, info)| (vec![best], info)),
            Some(wanted) => own.several(task, seed, wanted, seen, watch),
        }
    }

    /// Results that differ, of searches with a share of the particles.
    fn several(
        &self,
        task: &Task,
        seed: u64,
        wanted: usize,
        seen: Seen<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<(Vec<Run>, Improved), Failure> {
        let particles = (SHARE * self.particles as f64).ceil() as usize;
        let own = Improve { particles, diverse: None, ..self.clone() };
        let task = &task.shared_by(wanted);
        let (mut found, mut failed, mut searches, mut chosen) = (vec![], None, 0, vec![]);
        for _ in 0..BATCHES {
            let missing = wanted - chosen.len();
            let seeds = searches..searches + missing;
            let (results, is_stopped) = side_by_side(missing, watch, |number, watch| {
                let part = (seeds.start + number) as u64;
                own.one(task, part_seed(seed, part, 2), part, seen, watch)
            });
            searches = seeds.end;
            for result in results {
                match result {
                    Ok(one) => found.push(one),
                    Err(failure) if failure.is_impossible() => failed = failed.or(Some(failure)),
                    Err(failure) => return Err(failure),
                }
            }
            found.sort_by(|a, b| b.0.log_score.total_cmp(&a.0.log_score));
            let ranked: Vec<usize> = (0..found.len()).collect();
            chosen = Choices::of(found.iter().map(|(run, _)| &run.log)).choose(&ranked, wanted);
            if chosen.len() >= wanted || is_stopped {
                break;
            }
        }
        let mut runs = vec![];
        let mut info = None;
        for (number, (run, own)) in found.into_iter().enumerate() {
            let info = info.get_or_insert(own);
            info.searches = searches;
            if chosen.contains(&number) {
                runs.push(run);
            }
        }
        match info {
            Some(info) => Ok((runs, info)),
            None => Err(failed.unwrap_or_else(Failure::no_start)),
        }
    }

    /// One search, which is a part of the checkpoint.
    fn one(
        &self,
        task: &Task,
        seed: u64,
        part: u64,
        seen: Seen<'_>,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<(Run, Improved), Failure> {
        // Counted apart, so that a part is stored with its own count.
        let own = task.uncounted();
        let result = self.counted(&own, seed, part, seen, watch);
        task.invalid.add(own.invalid.counts());
        result
    }

    fn counted(
        &self,
        task: &Task,
        seed: u64,
        part: u64,
        seen: Seen<'_>,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<(Run, Improved), Failure> {
        let began = Instant::now();
        let left: Option<Stored<Run>> = seen.checkpoint.map_or(Ok(None), |own| own.left(part))?;
        let before = left.as_ref().map_or(Duration::ZERO, |left| left.time);
        let time = self.seconds.map(|seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::ZERO));
        let elapsed = || before + began.elapsed();
        let is_late = || time.is_some_and(|time| elapsed() >= time);
        let most = self.rounds.unwrap_or(if time.is_some() { u64::MAX } else { USUAL_ROUNDS });
        let round = |kind, work, parts, best| Round { kind, work, parts, best, time: elapsed() };
        let (mut search, mut info, mut number, mut idle) = match left {
            Some(left) => left.search(self, task, seed)?,
            None => {
                let mut info = Improved { searches: 1, ..Improved::default() };
                let mut first = self.start(task, seed, &mut info.attempts, watch, &|| !is_late())?;
                info.lost = std::mem::take(&mut first.losses).explained(task);
                let (work, is_stopped) = (first.steps, first.interrupted);
                let tried = info.attempts.last().map_or(self.particles, |attempt| attempt.particles);
                let unit = (work * self.particles as u64 / tried as u64).max(1);
                let search = Search::begin(self, task, seed, unit, info.attempts.len() as u64, first)?;
                info.rounds.push(round(Kind::Population, work, 0, search.best.log_score));
                info.interrupted = is_stopped;
                (search, info, 0, 0)
            }
        };
        let invalid = || task.invalid.counts();
        while number < most && idle < PATIENCE.max(number / 2) && !info.interrupted && !is_late() {
            if let Some(checkpoint) = seen.checkpoint {
                checkpoint
                    .at_border(part, || Stored::of(&search, &info, (number, idle), elapsed(), invalid()));
            }
            let before = search.best.log_score;
            seen.shown.inspect(|shown| search.best.show(shown));
            let mut go_on = |best: f64| {
                info.interrupted |= !watch(Progress { barriers: number as usize, ended: 1, best });
                !info.interrupted
            };
            let (kind, work, parts) = search.round(number, &mut go_on)?;
            number += 1;
            let gain = search.best.log_score - before;
            idle = if gain < LEAST_GAIN { idle + 1 } else { 0 };
            info.rounds.push(round(kind, work, parts, search.best.log_score));
        }
        // A round that was stopped is done again.
        if let Some(checkpoint) = seen.checkpoint.filter(|_| !info.interrupted) {
            checkpoint.store(part, || Stored::of(&search, &info, (number, idle), elapsed(), invalid()));
        }
        Ok((search.best, info))
    }
}

/// The seed of a population, by its number; of the first, the seed itself.
fn population_seed(seed: u64, number: u64) -> u64 {
    if number == 0 { seed } else { part_seed(seed, number, 1) }
}

/// A seed for a part of the search.
fn part_seed(seed: u64, number: u64, visit: u64) -> u64 {
    Reserved::Improve.stream(seed, u128::from(number), visit).next_u64()
}
