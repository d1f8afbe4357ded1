//! The course of a search: rounds, and restarts from fresh populations where the best stands still.
//!
//! A search begins with a few starts of equal work, and goes on from the best of them: later steps seldom change what a first population
//! decides, such as the length of a trunk.
//!
//! Rounds begin from the best run since the last restart; the best runs of all restarts are kept. Whether the search restarts is
//! decided by counts of work alone, and not by how it will end. So a search that ended by time, or by itself, is repeated by its
//! number of rounds.

use super::arms::Step;
use super::price::{self, FLOOR};
use super::rounds::{self, Round, Search};
use super::start::number_of;
use super::{Improve, Improved, part_seed, population_seed};
use niwaki_particles::{Progress, Result as Population};
use niwaki_run::log::Entry;
use niwaki_run::run::{Run, Shown};
use niwaki_run::{Failure, Task};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Least gain that counts, nats.
pub(super) const LEAST_GAIN: f64 = 0.01;
/// The least number of rounds of a search without a limit of rounds or time, with an effort of 1 or more.
const LEAST_ROUNDS: f64 = 15.0;
/// Work without a gain after which a search may end: this many times the cost of the first population, ...
const POPULATIONS: u64 = 2;
/// ... or the floor divided by this, if that is more.
const OF_FLOOR: u64 = 4;
/// Before a restart, it is also at least the work since the last one divided by this: what still climbs is left alone.
const OF_WORK: u64 = 2;
/// A search begins with starts: populations, each with rounds that have together the floor divided by this, or its own work. The search
/// goes on from the best of them.
const OF_START: u64 = 24;
/// The starts have together at most the floor divided by this.
const OF_STARTS: u64 = 3;
/// Most runs of earlier restarts that are kept, for results that differ.
const KEPT: usize = 32;

/// The work that is counted, in particle steps, proposals and moved shapes.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct Work {
    /// All of it.
    total: u64,
    /// Since the last restart.
    since: u64,
    /// Since the last gain.
    idle: u64,
}

/// A course as data.
#[derive(Serialize, Deserialize)]
pub(super) struct Stored<R> {
    search: rounds::Stored<R>,
    earlier: Vec<R>,
    number: u64,
    restarts: u64,
    work: Work,
    form: usize,
    price: u64,
}

/// A search with its restarts.
pub(super) struct Course<'a> {
    improve: &'a Improve,
    task: &'a Task,
    seed: u64,
    /// The rounds since the last restart.
    search: Search<'a>,
    /// The best runs of earlier restarts, best first.
    earlier: Vec<Run>,
    /// The number of rounds.
    pub number: u64,
    /// The number of restarts.
    pub restarts: u64,
    work: Work,
    /// The number of the form of population that lived.
    form: usize,
    /// The price of a unit of work, in instructions.
    pub price: u64,
    /// The highest log score that a run can have.
    most: f64,
}

impl<'a> Course<'a> {
    /// A course from its first population, whose attempts and work are in `info`.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn begin(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        info: &Improved,
        first: Population,
    ) -> Result<Course<'a>, Failure> {
        let (work, is_stopped) = (first.steps, first.interrupted);
        let last = info.attempts.last();
        let tried = last.map_or(improve.particles, |attempt| attempt.particles);
        let unit = (work * improve.particles as u64 / tried as u64).max(1);
        let search = Search::begin(improve, task, seed, unit, info.attempts.len() as u64, first)?;
        let price = if is_stopped { 1 } else { price::of(task, &search.best, improve.drawn_by.is_some())? };
        let form = last.map_or(0, |attempt| number_of(attempt.form));
        Ok(Course::of(search, seed, work, form, price))
    }

    /// A course from the run with these choices. The cost of a population is estimated from that of the run.
    ///
    /// # Errors
    /// The run is impossible, or a fault of the program.
    pub fn at(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        choices: &[Entry],
    ) -> Result<Course<'a>, Failure> {
        let (run, state) = rounds::at_choices(task, choices)?;
        let work = run.primitives as u64 + 1;
        let price = price::of(task, &run, improve.drawn_by.is_some())?;
        let slice = (work * improve.particles as u64 / rounds::PER_POPULATION).max(1);
        let rounds_seed = restart_seed(seed, 0);
        let search = Search::at(improve, task, rounds_seed, slice, (run, state), None, HashMap::new());
        Ok(Course::of(search, seed, work, 0, price))
    }

    /// A course before its first round, with the work and the form of its first population.
    fn of(search: Search<'a>, seed: u64, work: u64, form: usize, price: u64) -> Course<'a> {
        let (improve, task) = (search.improve, search.task);
        Course {
            improve,
            task,
            seed,
            search,
            earlier: vec![],
            number: 0,
            restarts: 0,
            work: Work { total: work, since: work, idle: 0 },
            form,
            price,
            most: price::most(task),
        }
    }

    /// The work so far.
    pub fn work(&self) -> u64 {
        self.work.total
    }

    /// The course as data, between two rounds; `None` if it was stopped before its first round.
    pub fn stored(&self) -> Option<Stored<&Run>> {
        Some(Stored {
            search: self.search.stored()?,
            earlier: self.earlier.iter().collect(),
            number: self.number,
            restarts: self.restarts,
            work: self.work,
            form: self.form,
            price: self.price,
        })
    }

    /// The course from its data.
    ///
    /// # Errors
    /// See [`Search::restored`].
    pub fn restored(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        stored: Stored<Run>,
    ) -> Result<Course<'a>, Failure> {
        let Stored { search, earlier, number, restarts, work, form, price } = stored;
        let search = Search::restored(improve, task, restart_seed(seed, restarts), search)?;
        let earlier = earlier.into_iter().map(|run| rounds::with_value(task, run));
        let (earlier, most) = (earlier.collect::<Result<_, _>>()?, price::most(task));
        Ok(Course { improve, task, seed, search, earlier, number, restarts, work, form, price, most })
    }

    /// The best log score so far, nats.
    pub fn best(&self) -> f64 {
        let earlier = self.earlier.first().map_or(f64::NEG_INFINITY, |run| run.log_score);
        self.search.best.log_score.max(earlier)
    }

    /// Publishes the best run so far.
    pub fn show(&mut self, shown: &Shown) {
        self.search.best.show(shown);
    }

    /// The best runs of all restarts, best first.
    pub fn into_best(mut self) -> Vec<Run> {
        keep(&mut self.earlier, self.search.best);
        self.earlier
    }

    /// Whether no run can be better than the best by what counts.
    pub fn is_perfect(&self) -> bool {
        self.best() >= self.most - LEAST_GAIN
    }

    /// Whether a search without a limit of rounds and time has done its work: it has spent the floor, and the best stands still.
    pub fn is_done(&self) -> bool {
        let (effort, price) = (self.improve.effort, self.price as f64);
        let floor = self.work.total as f64 * price >= FLOOR as f64 * effort;
        let share = effort.min(1.0);
        self.number as f64 >= LEAST_ROUNDS * share
            && floor
            && self.work.idle as f64 >= self.patience() as f64 * share
    }

    /// Whether the best stands still, so that the next round is a restart.
    pub fn is_still(&self) -> bool {
        self.is_start_over() || self.work.idle >= self.patience().max(self.work.since / OF_WORK)
    }

    /// The work of a population.
    fn population(&self) -> u64 {
        rounds::PER_POPULATION * self.search.slice
    }

    /// The work of a start, and the number of starts.
    fn starts(&self) -> (u64, u64) {
        let work = self.population().max(FLOOR / OF_START / self.price).max(1);
        (work, FLOOR / OF_STARTS / self.price / work)
    }

    /// Whether a start has had its work.
    fn is_start_over(&self) -> bool {
        let (work, count) = self.starts();
        self.improve.first_run.is_none() && self.restarts < count && count > 1 && self.work.since >= work
    }

    /// Whether the last start has had its work, so that the next round goes back to the best of them.
    fn has_started(&self) -> bool {
        self.is_start_over() && self.restarts + 1 == self.starts().1
    }

    /// The work without a gain after which a search may end.
    fn patience(&self) -> u64 {
        (POPULATIONS * self.population()).max(FLOOR / OF_FLOOR / self.price)
    }

    /// Makes the next round, a restart where the best stands still. `may_continue` is called with the best log score, and ends the
    /// round when it returns false.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn round(&mut self, may_continue: &mut dyn FnMut(f64) -> bool) -> Result<Round, Failure> {
        let earlier = self.earlier.first().map_or(f64::NEG_INFINITY, |run| run.log_score);
        let before = self.search.best.log_score;
        let (step, work, parts) = if self.has_started() {
            let work = self.go_back()?;
            self.work = Work { since: 0, idle: 0, ..self.work };
            (Step::RESTART, work, 0)
        } else if self.is_still() {
            let (work, has_lived) = self.restart(may_continue)?;
            self.work = Work { since: if has_lived { 0 } else { self.work.since }, idle: 0, ..self.work };
            (Step::RESTART, work, 0)
        } else {
            let round = self.search.round(self.number, &mut |best| may_continue(best.max(earlier)))?;
            let has_gained = self.search.best.log_score - before >= LEAST_GAIN;
            self.work.idle = if has_gained { 0 } else { self.work.idle + round.1 };
            round
        };
        self.number += 1;
        self.work.total += work;
        self.work.since += work;
        Ok(Round { step, work, parts, best: self.best(), time: std::time::Duration::ZERO })
    }

    /// Goes on from the best run of all starts. Returns the work.
    fn go_back(&mut self) -> Result<u64, Failure> {
        self.restarts += 1;
        let seed = restart_seed(self.seed, self.restarts);
        let last = &self.search.best;
        let best = self.earlier.first().filter(|run| run.log_score > last.log_score).unwrap_or(last);
        let (run, state) = rounds::at_choices(self.task, &best.log.entries())?;
        let work = run.primitives as u64 + 1;
        let (slice, spreads) = (self.search.slice, std::mem::take(&mut self.search.spreads));
        let next = Search::at(self.improve, self.task, seed, slice, (run, state), None, spreads);
        self.turn_to(next);
        Ok(work)
    }

    /// Goes on with another search, and keeps the best run of the search before it.
    fn turn_to(&mut self, next: Search<'a>) {
        let last = std::mem::replace(&mut self.search, next);
        keep(&mut self.earlier, last.best);
        self.earlier.truncate(if self.improve.keeps_all { KEPT } else { 1 });
    }

    /// Goes on from a fresh population. Returns its work, and false if no particle lived or it was stopped.
    fn restart(&mut self, may_continue: &mut dyn FnMut(f64) -> bool) -> Result<(u64, bool), Failure> {
        self.restarts += 1;
        let (best, seed, slice) = (self.best(), restart_seed(self.seed, self.restarts), self.search.slice);
        let mut attempts = vec![];
        let mut watch = |_: Progress| may_continue(best);
        match self.improve.start(self.task, seed, self.form, &mut attempts, &mut watch, &|| true) {
            Ok(first) => {
                let work = first.steps;
                if first.interrupted {
                    return Ok((work, false));
                }
                let populations = (self.form + attempts.len()) as u64;
                let unit = self.population();
                let next = Search::begin(self.improve, self.task, seed, unit, populations, first)?;
                self.turn_to(next);
                Ok((work, true))
            }
            Err(failure) if failure.is_impossible() => Ok((slice, false)),
            Err(failure) => Err(failure),
        }
    }
}

/// Adds a run to runs that are sorted, best first.
fn keep(runs: &mut Vec<Run>, run: Run) {
    let at = runs.partition_point(|other| other.log_score >= run.log_score);
    runs.insert(at, run);
}

/// The seed of a restart by its number; before the first, that of the search.
fn restart_seed(seed: u64, number: u64) -> u64 {
    if number == 0 { population_seed(seed, 0) } else { part_seed(seed, number, 3) }
}
