//! A search as data, between two rounds.

use super::rounds;
use super::rounds::{Round, Search};
use super::start::name_of;
use super::{Improve, Improved};
use niwaki_run::failure::Attempt;
use niwaki_run::losses::Lost;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::invalid::Counts;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// The search, its report so far, and the numbers of its rounds: all, and those since it last gained.
#[derive(Serialize, Deserialize)]
pub(super) struct Stored<R> {
    search: rounds::Stored<R>,
    attempts: Vec<(String, usize, Option<usize>)>,
    rounds: Vec<Round>,
    number: u64,
    idle: u64,
    /// Since the search began, without pauses between processes.
    pub time: Duration,
    invalid: Counts,
    lost: Lost,
}

impl<'r> Stored<&'r Run> {
    /// Of a search; `None` where it was stopped before its first round.
    pub fn of(
        search: &'r Search<'_>,
        info: &Improved,
        (number, idle): (u64, u64),
        time: Duration,
        invalid: Counts,
    ) -> Option<Stored<&'r Run>> {
        let attempts = info.attempts.iter().map(|one| (one.form.to_string(), one.particles, one.died_at));
        let (attempts, rounds) = (attempts.collect(), info.rounds.clone());
        let lost = info.lost.clone();
        Some(Stored { search: search.stored()?, attempts, rounds, number, idle, time, invalid, lost })
    }
}

impl Stored<Run> {
    /// The search, its report, and the numbers of its rounds.
    ///
    /// # Errors
    /// As for [`Search::restored`].
    pub fn search<'a>(
        self,
        own: &'a Improve,
        task: &'a Task,
        seed: u64,
    ) -> Result<(Search<'a>, Improved, u64, u64), Failure> {
        let attempts = self.attempts.iter().map(|(form, particles, died_at)| Attempt {
            form: name_of(form),
            particles: *particles,
            died_at: *died_at,
        });
        let attempts = attempts.collect();
        let info =
            Improved { attempts, rounds: self.rounds, searches: 1, interrupted: false, lost: self.lost };
        let search = Search::restored(own, task, seed, self.search)?;
        task.invalid.add(self.invalid);
        Ok((search, info, self.number, self.idle))
    }
}
