//! A search for the best run, which spends its effort on the steps that gain most. It is not a sampler: its result has no
//! evidence and no weights.
//!
//! 1. *Begin* (`start`): populations of particles, until one has a possible run. Its cost is the unit of effort. A search that is given
//!    a run begins there, and its unit is the cost of that many such runs.
//! 2. *Rounds* (`rounds`) of a fifth of that unit. Each makes steps of one arm from the best run, and the arms (`arms`) share the
//!    rounds by their latest gains: parts grown again by few or by many particles, moves of single choices, moves with which most
//!    parts stay (linkages), edits of levels (`levels`, `edits`), and a new population.
//! 3. *Restarts* (`course`): a search has a few starts of equal work, and goes on from the best of them. Later, where no round has gained for
//!    long, the next begins from a fresh population. The best of all is kept.
//! 4. *End* after the given number of rounds; or when the time is over; or, without both, when the search has spent a floor of work
//!    and no round has gained for long. A search also ends where nothing can be better.
//!
//! Work is counted, not timed: particle-steps of populations and of parts, proposals, and shapes that proposals place or remove, each
//! at a price in instructions (`price`). So a search has equal bits on any machine; a search with a time limit reports the number of
//! its rounds, which repeats it.
//!
//! A search is stored between two rounds (`stored`); if it is killed earlier, its first population starts again.
//!
//! Several different results are the best of several kinds, from an archive (`archive`).

mod archive;
mod arms;
mod choose;
mod course;
mod edits;
mod levels;
mod look;
mod niche;
mod price;
mod rounds;
mod start;
mod stored;
mod structure;

pub use arms::Step;
pub use rounds::Round;

use course::Course;
use niche::By;
use niwaki_chain::form::Form;
use niwaki_math::RngCore;
use niwaki_particles::{Progress, Watch};
use niwaki_propose::proposal::Proposal;
use niwaki_run::checkpoint::Checkpoint;
use niwaki_run::failure::Attempt;
use niwaki_run::log::Entry;
use niwaki_run::losses::Lost;
use niwaki_run::run::{Run, Shown};
use niwaki_run::setting::{COUNT, FROM_ZERO, POSITIVE, Range, Ranges, whole};
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};
use stored::Stored;

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
    /// The number of rounds.
    rounds: Option<u64>,
    /// Most seconds.
    seconds: Option<f64>,
    /// A factor of the floor of work of a search without a limit of rounds or time.
    effort: f64,
    /// The number of different results.
    diverse: Option<usize>,
    /// The number of generations of short searches for other kinds.
    #[serde(default)]
    generations: Option<u64>,
    /// The rule by which they differ.
    #[serde(default)]
    by: By,
    /// Most nats below the best for a result of another kind to come before a second one of a kind.
    #[serde(default)]
    margin: Option<f64>,
    /// The number of bins of a real value.
    #[serde(default = "usual_bins")]
    bins: usize,
    /// The proposal that draws choices in place of the prior, as data.
    pub(crate) proposal: Option<Form>,
    /// The proposal that draws choices in place of the prior.
    #[serde(skip)]
    drawn_by: Option<Arc<Proposal>>,
    /// The choices of a run from which the search begins, in place of populations.
    #[serde(skip)]
    first_run: Option<Arc<[Entry]>>,
    /// Whether the best runs of all restarts are kept, and not only the best of all.
    #[serde(skip)]
    keeps_all: bool,
}

/// The outputs of a search while it runs.
#[derive(Clone, Copy, Default)]
pub struct Outputs<'a> {
    /// The display of the best run so far.
    pub shown: Option<&'a Shown>,
    /// The store of the state from which a killed search resumes.
    pub checkpoint: Option<&'a Checkpoint>,
}

/// The report of a search for the best; of several searches, that of the best.
#[derive(Default)]
pub struct Improved {
    /// The populations up to the first that survived.
    pub attempts: Vec<Attempt>,
    /// The first surviving population, and each round.
    pub rounds: Vec<Round>,
    /// The number of searches.
    pub searches: usize,
    /// The kinds of several results, or what else tells them apart: names with values.
    pub kinds: Vec<BTreeMap<String, String>>,
    /// The number of kinds in the archive of a search for several results.
    pub niches: usize,
    /// The work of the searches for other kinds.
    pub other_work: u64,
    /// The number of generations of these searches.
    pub generations: u64,
    /// The price of a unit of work, in instructions of a processor.
    pub price: u64,
    /// Whether the search was stopped.
    pub interrupted: bool,
    /// Particles of the first surviving population that became impossible.
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
        ("effort", FROM_ZERO),
        ("diverse", Range::Optional(&COUNT)),
        ("generations", Range::Optional(&COUNT)),
        ("margin", Range::Optional(&FROM_ZERO)),
        ("bins", COUNT),
    ];

    /// A setting and the rule that it breaks.
    pub(crate) fn broken_rule(&self) -> Option<(&'static str, &'static str)> {
        (self.generations.is_some() && self.diverse.is_none())
            .then_some(("generations", "generations-diverse"))
    }

    /// Searches for the best run, or for several different runs, best first. If there is a `proposal`, populations and parts that are
    /// grown again draw their choices from it, and no weight corrects its draws. A search for a single result begins from the run `start`,
    /// if there is one. `watch` is called with the number of rounds and the best log score, after the best run
    /// is `shown`; when it returns false, the search ends with its best so far. Each search is a part of the `checkpoint`.
    ///
    /// # Errors
    /// A fault of the program, first populations that all died, or a first run that is impossible.
    pub fn search(
        &self,
        task: &Task,
        seed: u64,
        proposal: Option<Arc<Proposal>>,
        start: Option<&[Entry]>,
        outputs: Outputs<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<(Vec<Run>, Improved), Failure> {
        // A weight of prior over proposal would draw particles back to the prior, and the result is no sample anyway.
        let proposal = proposal.map(|proposal| Arc::new(proposal.unweighed()));
        let first_run = start.filter(|_| self.diverse.is_none()).map(Arc::from);
        let improve = Improve { drawn_by: proposal, first_run, ..self.clone() };
        match improve.diverse {
            None => improve.single(task, seed, 0, outputs, watch).map(|(mut runs, info)| {
                runs.truncate(1);
                (runs, info)
            }),
            Some(count) => archive::search(&improve, task, seed, count, outputs, watch),
        }
    }

    /// The time of the search.
    fn time(&self) -> Option<Duration> {
        self.seconds.map(|seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::ZERO))
    }

    /// The settings that arms use.
    fn sizes(&self) -> arms::Sizes {
        let (particles, regrow, power) = (self.particles, self.regrow, self.power);
        arms::Sizes { particles, regrow, power, drawn_by: self.drawn_by.clone() }
    }

    /// Makes a single search, which is a part of the checkpoint. Returns the best runs of its restarts, best first.
    fn single(
        &self,
        task: &Task,
        seed: u64,
        part: u64,
        outputs: Outputs<'_>,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<(Vec<Run>, Improved), Failure> {
        // The count of invalid runs is separate, so that a part is stored with its own count.
        let uncounted = task.uncounted();
        let result = self.rounds_of(&uncounted, seed, part, outputs, watch);
        task.invalid.add(uncounted.invalid.counts());
        result
    }

    fn rounds_of(
        &self,
        task: &Task,
        seed: u64,
        part: u64,
        outputs: Outputs<'_>,
        watch: &mut dyn FnMut(Progress) -> bool,
    ) -> Result<(Vec<Run>, Improved), Failure> {
        let began = Instant::now();
        let stored: Option<Stored<Run>> =
            outputs.checkpoint.map_or(Ok(None), |checkpoint| checkpoint.left(part))?;
        let before = stored.as_ref().map_or(Duration::ZERO, |stored| stored.time);
        let time = self.time();
        let elapsed = || before + began.elapsed();
        let is_late = |next: Duration| time.is_some_and(|time| elapsed() + next >= time);
        let (mut course, mut info) = match stored {
            Some(stored) => stored.course(self, task, seed)?,
            None => {
                let mut info = Improved { searches: 1, ..Improved::default() };
                let (course, step) = if let Some(run) = &self.first_run {
                    (Course::at(self, task, seed, run)?, Step::START)
                } else {
                    let may_try = || !is_late(Duration::ZERO);
                    let mut first = self.start(task, seed, 0, &mut info.attempts, watch, &may_try)?;
                    info.lost = std::mem::take(&mut first.losses).explained(task);
                    info.interrupted = first.interrupted;
                    (Course::begin(self, task, seed, &info, first)?, arms::POPULATION.step)
                };
                info.price = course.price;
                let (work, best, time) = (course.work(), course.best(), elapsed());
                info.rounds.push(Round { step, work, parts: 0, best, time });
                (course, info)
            }
        };
        let invalid = || task.invalid.counts();
        while !info.interrupted && !course.is_perfect() {
            let is_over = match (self.rounds, time) {
                (None, None) => course.is_done(),
                (rounds, _) => {
                    rounds.is_some_and(|rounds| course.number >= rounds) || is_late(next(&course, &info))
                }
            };
            if is_over {
                break;
            }
            if let Some(checkpoint) = outputs.checkpoint {
                checkpoint.at_border(part, || Stored::of(&course, &info, elapsed(), invalid()));
            }
            outputs.shown.inspect(|shown| course.show(shown));
            let number = course.number as usize;
            let mut may_continue = |best: f64| {
                info.interrupted |= !watch(Progress { barriers: number, ended: 1, best });
                !info.interrupted
            };
            let round = course.round(&mut may_continue)?;
            info.rounds.push(Round { time: elapsed(), ..round });
        }
        // A round that was stopped is made again after a resume.
        if let Some(checkpoint) = outputs.checkpoint.filter(|_| !info.interrupted) {
            checkpoint.store(part, || Stored::of(&course, &info, elapsed(), invalid()));
        }
        Ok((course.into_best(), info))
    }
}

/// The time that the next round will take, as the last round or the first population took.
fn next(course: &Course<'_>, info: &Improved) -> Duration {
    let ends: Vec<Duration> = info.rounds.iter().map(|round| round.time).collect();
    match *ends.as_slice() {
        [first, ..] if course.is_still() => first,
        [.., before, last] => last.saturating_sub(before),
        _ => Duration::ZERO,
    }
}

/// The number of bins of a real value where none is given.
fn usual_bins() -> usize {
    10
}

/// The seed of a population by its number; the first has the seed of the search.
fn population_seed(seed: u64, number: u64) -> u64 {
    if number == 0 { seed } else { part_seed(seed, number, 1) }
}

/// A seed for a part of the search.
fn part_seed(seed: u64, number: u64, visit: u64) -> u64 {
    Reserved::Improve.stream(seed, u128::from(number), visit).next_u64()
}
