//! Draws as rows: the numbers of a recording's continuous choices, in order.

use niwaki_grad::{Continuous, Recorded};
use niwaki_run::replay::{Missing, Source, replay};
use niwaki_run::{Failure, Task};
use rayon::prelude::*;

/// The number of numbers in the continuous choices of a draw.
pub(super) fn width(recorded: &Recorded) -> usize {
    recorded.choices.iter().map(Continuous::width).sum()
}

/// The log density of the choices of each row without Jacobians, and its factors and observations, nats, by running the program.
///
/// # Errors
/// A fault of the program.
pub(super) fn scores(
    task: &Task,
    recorded: &Recorded,
    numbers: &[f64],
    rows: usize,
) -> Result<Vec<(f64, f64)>, Failure> {
    let width = width(recorded);
    let score = |row: usize| {
        let values = recorded.values_of(&numbers[row * width..(row + 1) * width]);
        let run = replay(task, Source::Addresses(values), Missing::Refuse)?.run;
        Ok((run.log_prior, run.log_score))
    };
    (0..rows).into_par_iter().map(score).collect()
}
