//! A search between two rounds, as data.

use super::course::{self, Course};
use super::rounds::Round;
use super::start::name_of;
use super::{Improve, Improved};
use niwaki_run::failure::Attempt;
use niwaki_run::losses::Lost;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::invalid::Counts;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// A search and its report so far.
#[derive(Serialize, Deserialize)]
pub(super) struct Stored<R> {
    course: course::Stored<R>,
    attempts: Vec<(String, usize, Option<usize>)>,
    rounds: Vec<Round>,
    /// Time since the search began, without pauses between processes.
    pub time: Duration,
    invalid: Counts,
    lost: Lost,
}

impl<'r> Stored<&'r Run> {
    /// A search as data; `None` if it was stopped before its first round.
    pub fn of(
        course: &'r Course<'_>,
        info: &Improved,
        time: Duration,
        invalid: Counts,
    ) -> Option<Stored<&'r Run>> {
        let attempts = info
            .attempts
            .iter()
            .map(|attempt| (attempt.form.to_string(), attempt.particles, attempt.died_at));
        let (attempts, rounds) = (attempts.collect(), info.rounds.clone());
        let lost = info.lost.clone();
        Some(Stored { course: course.stored()?, attempts, rounds, time, invalid, lost })
    }
}

impl Stored<Run> {
    /// The search and its report.
    ///
    /// # Errors
    /// See [`Course::restored`].
    pub fn course<'a>(
        self,
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
    ) -> Result<(Course<'a>, Improved), Failure> {
        let attempts = self.attempts.iter().map(|(form, particles, died_at)| Attempt {
            form: name_of(form),
            particles: *particles,
            died_at: *died_at,
        });
        let attempts = attempts.collect();
        let course = Course::restored(improve, task, seed, self.course)?;
        let (price, rounds, lost) = (course.price, self.rounds, self.lost);
        task.invalid.add(self.invalid);
        let info = Improved { attempts, rounds, searches: 1, price, lost, ..Improved::default() };
        Ok((course, info))
    }
}
