//! A search between two rounds, as data.

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

/// A search, its report so far, the number of its rounds, and the number of rounds since its last gain.
#[derive(Serialize, Deserialize)]
pub(super) struct Stored<R> {
    search: rounds::Stored<R>,
    attempts: Vec<(String, usize, Option<usize>)>,
    rounds: Vec<Round>,
    number: u64,
    idle: u64,
    /// Time since the search began, without pauses between processes.
    pub time: Duration,
    invalid: Counts,
    lost: Lost,
}

impl<'r> Stored<&'r Run> {
    /// A search as data; `None` if it was stopped before its first round.
    pub fn of(
        search: &'r Search<'_>,
        info: &Improved,
        (number, idle): (u64, u64),
        time: Duration,
        invalid: Counts,
    ) -> Option<Stored<&'r Run>> {
        let attempts = info
            .attempts
            .iter()
            .map(|attempt| (attempt.form.to_string(), attempt.particles, attempt.died_at));
        let (attempts, rounds) = (attempts.collect(), info.rounds.clone());
        let lost = info.lost.clone();
        Some(Stored { search: search.stored()?, attempts, rounds, number, idle, time, invalid, lost })
    }
}

impl Stored<Run> {
    /// The search, its report, and the two numbers of rounds.
    ///
    /// # Errors
    /// See [`Search::restored`].
    pub fn search<'a>(
        self,
        improve: &'a Improve,
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
            Improved { attempts, rounds: self.rounds, searches: 1, lost: self.lost, ..Improved::default() };
        let search = Search::restored(improve, task, seed, self.search)?;
        task.invalid.add(self.invalid);
        Ok((search, info, self.number, self.idle))
    }
}
