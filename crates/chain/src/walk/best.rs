//! The best state that a chain reached.
//!
//! It is not copied each time, because a copy costs the length of the trace. It is stored as the present state with a list
//! of changes to undo, and copied only when that list is as long as the trace. The reported state is that of a run with
//! its choices.

use crate::walk::state::State;
use crate::walk::streams::Streams;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// A change of one choice, undone: its address, and its value before (`None`: there was no such choice).
type Undo = (u128, Option<Value>);

/// The best state so far.
pub struct Best {
    /// Its scores.
    scores: Run,
    /// Its choices, where they were copied.
    copied: Option<Vec<(u128, Value)>>,
    /// The changes that lead from the present state back to it, where they were not copied.
    since: Vec<Undo>,
}

impl Best {
    /// The first state.
    pub fn new(state: &State) -> Best {
        Best { scores: state.scores(0), copied: None, since: vec![] }
    }

    /// Whether changes are noted.
    #[inline(always)]
    pub fn is_noting(&self) -> bool {
        self.copied.is_none()
    }

    /// Its log score, nats.
    #[inline(always)]
    pub fn score(&self) -> f64 {
        self.scores.log_score
    }
    /// Notes how to go back, just before an open transaction is kept; `moved` are the choices that the proposal itself
    /// changed, with their values before.
    pub fn note(&mut self, state: &State, program: &Program, moved: impl IntoIterator<Item = (u128, Value)>) {
        let trace = &state.trace;
        let old = |(address, value): &(u128, Value)| (*address, Some(value.clone()));
        self.since.extend(moved.into_iter().map(|(address, value)| (address, Some(value))));
        self.since.extend(trace.drawn_anew().iter().map(old));
        self.since.extend(trace.deaths().iter().map(|dead| {
            let choice = *dead as usize;
            (trace.address(program, choice), Some(trace.choice(program, choice).0.clone()))
        }));
        self.since.extend(trace.births(program).map(|place| (place.address(), None)));
    }

    /// Compares the present state, just after it was reached, with the best.
    #[inline(always)]
    pub fn compare(&mut self, state: &State, program: &Program, visit: u64) {
        if state.log_score() > self.scores.log_score {
            self.record(state, visit);
        } else if self.copied.is_none() && self.since.len() > state.trace.len().max(64) {
            self.copy(state, program);
        }
    }

    #[inline(never)]
    fn record(&mut self, state: &State, visit: u64) {
        self.scores = state.scores(visit);
        self.copied = None;
        self.since.clear();
    }

    #[inline(never)]
    fn copy(&mut self, state: &State, program: &Program) {
        self.copied = Some(self.choices(state, program));
        self.since = vec![];
    }

    /// Its choices, from those of the present state.
    fn choices(&self, state: &State, program: &Program) -> Vec<(u128, Value)> {
        let mut choices: HashMap<u128, Value> = state.choices(program).collect();
        for (address, value) in self.since.iter().rev() {
            match value {
                Some(value) => choices.insert(*address, value.clone()),
                None => choices.remove(address),
            };
        }
        let mut choices: Vec<_> = choices.into_iter().collect();
        choices.sort_unstable_by_key(|choice| choice.0);
        choices
    }

    /// Its scores and choices.
    pub(crate) fn stored(&self, state: &State, program: &Program) -> Run {
        let choices = self.copied.clone().unwrap_or_else(|| self.choices(state, program));
        Run { log: choices.into_iter().collect(), ..self.bare_scores() }
    }

    fn bare_scores(&self) -> Run {
        let Run { log_prior, log_score, primitives, similarity, has_ended, visit, .. } = self.scores;
        Run { log_prior, log_score, primitives, similarity, has_ended, visit, ..Run::default() }
    }

    /// The best state of what [`Best::stored`] gave.
    pub(crate) fn restored(run: Run) -> Best {
        let copied = run.log.entries().into_iter().map(|entry| (entry.address(), entry.value)).collect();
        Best { scores: run, copied: Some(copied), since: vec![] }
    }

    /// A run from the start with its choices, so that its scores are those of its values.
    ///
    /// # Errors
    /// A fault of that run, or that it is impossible: a host function that does not answer as before.
    pub fn get(&self, state: &State, task: &Task) -> Result<Run, Failure> {
        let choices = self.copied.clone().unwrap_or_else(|| self.choices(state, &task.program));
        let known = choices.iter().cloned().collect();
        let (fresh, _) = State::start(task, Streams::new(0, 0), 1, Some(&known))?;
        let (log, value) = (choices.into_iter().collect(), fresh.trace.result());
        Ok(Run { log, value, ..fresh.scores(self.scores.visit) })
    }
}
