//! The best state that a chain reached.
//!
//! A copy of the best state costs the length of the trace. Therefore the best state is stored as the present state with a list of
//! changes to undo, and copied only when that list is as long as the trace. The reported state is from a run with the choices of
//! the best state.

use crate::walk::state::State;
use crate::walk::streams::Streams;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// The reverse of a change: the address of the choice, and its previous value; `None` for a new choice.
type Undo = (u128, Option<Value>);

/// The best state so far.
pub struct Best {
    /// The scores of the best state.
    scores: Run,
    /// The choices of the best state, if they were copied.
    copied: Option<Vec<(u128, Value)>>,
    /// The changes that lead from the present state back to the best state, if it was not copied.
    since: Vec<Undo>,
}

impl Best {
    /// Start with the first state of a chain.
    pub fn new(state: &State) -> Best {
        Best { scores: state.scores(0), copied: None, since: vec![] }
    }

    /// Whether changes are recorded.
    #[inline(always)]
    pub fn is_noting(&self) -> bool {
        self.copied.is_none()
    }

    /// The log score of the best state, nats.
    #[inline(always)]
    pub fn score(&self) -> f64 {
        self.scores.log_score
    }
    /// Record how to undo an open transaction, just before the transaction is kept. `moved` are the choices that the proposal itself
    /// changed, with their previous values.
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

    /// Compare a new state with the best state.
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

    /// The choices of the best state, computed from the choices of the present state.
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

    /// The scores and choices of the best state, for a checkpoint.
    pub(crate) fn stored(&self, state: &State, program: &Program) -> Run {
        let choices = self.copied.clone().unwrap_or_else(|| self.choices(state, program));
        Run { log: choices.into_iter().collect(), ..self.bare_scores() }
    }

    fn bare_scores(&self) -> Run {
        let Run { log_prior, log_score, primitives, similarity, has_ended, visit, .. } = self.scores;
        Run { log_prior, log_score, primitives, similarity, has_ended, visit, ..Run::default() }
    }

    /// Restore the best state from the result of [`Best::stored`].
    pub(crate) fn restored(run: Run) -> Best {
        let copied = run.log.entries().into_iter().map(|entry| (entry.address(), entry.value)).collect();
        Best { scores: run, copied: Some(copied), since: vec![] }
    }

    /// Run the program with the choices of the best state, so that the scores match the values.
    ///
    /// # Errors
    /// A fault of the run; an impossible run, which happens if a host function does not repeat its answers.
    pub fn get(&self, state: &State, task: &Task) -> Result<Run, Failure> {
        let choices = self.copied.clone().unwrap_or_else(|| self.choices(state, &task.program));
        let known = choices.iter().cloned().collect();
        let (fresh, _) = State::start(task, Streams::new(0, 0), 1, Some(&known))?;
        let (log, value) = (choices.into_iter().collect(), fresh.trace.result());
        Ok(Run { log, value, ..fresh.scores(self.scores.visit) })
    }
}
