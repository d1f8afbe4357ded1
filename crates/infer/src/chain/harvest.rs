//! What a chain keeps of the states that it comes through: the best, and samples.
//!
//! The best is not copied at each record, which would cost the length of the trace at each step uphill: it is the
//! present state with a list of changes undone. Only when that list has become as long as the trace is a copy made.

use super::state::State;
use crate::log::Log;
use niwaki_vm::code::Program;
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// A state that was kept.
#[derive(Debug)]
pub struct Snapshot {
    /// Its choices, by address.
    pub log: Log,
    /// Everything else.
    pub facts: Facts,
}

impl Snapshot {
    /// Of the present state.
    pub fn of(state: &State, program: &Program, visit: u64) -> Snapshot {
        Snapshot { log: logged(present(state, program)), facts: Facts::of(state, visit) }
    }
}

/// What is known of a state beside its choices.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// What the program returned.
    pub value: Value,
    /// Log densities of the choices, nats.
    pub log_prior: f64,
    /// Factors, observations and sketches, nats.
    pub log_score: f64,
    /// Primitives of the scene.
    pub primitives: usize,
    /// Share of cells equal in scene and target.
    pub similarity: Option<f64>,
    /// The number of proposals before it.
    pub visit: u64,
}

impl Facts {
    /// Of the present state.
    pub fn of(state: &State, visit: u64) -> Facts {
        let similarity = if state.sketches.is_empty() {
            None
        } else {
            state.sketches.measures().into_iter().find(|(name, _)| *name == "similarity").map(|(_, x)| x)
        };
        Facts {
            value: state.trace.result().clone(),
            log_prior: state.trace.totals().log_prior,
            log_score: state.log_score(),
            primitives: state.primitives,
            similarity,
            visit,
        }
    }
}

/// A change of one choice, undone: its address, and its value before (`None`: there was no such choice).
type Undo = (u128, Option<Value>);

/// What a chain keeps.
pub struct Harvest {
    /// Samples, oldest first.
    pub samples: Vec<Snapshot>,
    /// Proposals between two samples; doubled when they take too much room. Zero: no samples.
    pub thin: u64,
    /// Most choices that all samples together may hold.
    room: usize,
    held: usize,
    best: Facts,
    /// The best, where it was copied.
    copied: Option<Log>,
    /// What leads from the present state back to the best, where it was not copied.
    since: Vec<Undo>,
}

impl Harvest {
    /// With the first state as the best so far; samples every `thin` proposals, `room` choices in all.
    pub fn new(state: &State, thin: u64, room: usize) -> Harvest {
        let best = Facts::of(state, 0);
        Harvest { samples: vec![], thin, room: room.max(1), held: 0, best, copied: None, since: vec![] }
    }

    /// Whether the way back to the best is being noted.
    #[inline(always)]
    pub fn is_noting(&self) -> bool {
        self.copied.is_none()
    }

    /// The best log score so far, nats.
    #[inline(always)]
    pub fn best_score(&self) -> f64 {
        self.best.log_score
    }

    /// Notes the way back, just before an open transaction is kept; `moved` are the choices that the proposal itself
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
        if state.log_score() > self.best.log_score {
            self.record(state, visit);
        } else if self.copied.is_none() && self.since.len() > state.trace.len().max(64) {
            self.copy(state, program);
        }
    }

    #[inline(never)]
    fn record(&mut self, state: &State, visit: u64) {
        self.best = Facts::of(state, visit);
        self.copied = None;
        self.since.clear();
    }

    #[inline(never)]
    fn copy(&mut self, state: &State, program: &Program) {
        self.copied = Some(self.way_back(state, program));
        self.since = vec![];
    }

    fn way_back(&self, state: &State, program: &Program) -> Log {
        let mut choices: HashMap<u128, Value> = present(state, program).collect();
        for (address, value) in self.since.iter().rev() {
            match value {
                Some(value) => choices.insert(*address, value.clone()),
                None => choices.remove(address),
            };
        }
        let mut choices: Vec<_> = choices.into_iter().collect();
        choices.sort_unstable_by_key(|choice| choice.0);
        logged(choices)
    }

    /// The best state so far.
    pub fn best(&self, state: &State, program: &Program) -> Snapshot {
        let log = match &self.copied {
            Some(log) => logged(log.entries().into_iter().map(|e| (e.address(), e.value))),
            None => self.way_back(state, program),
        };
        Snapshot { log, facts: self.best.clone() }
    }

    /// Keeps the present state as a sample.
    pub fn sample(&mut self, state: &State, program: &Program, visit: u64) {
        self.held += state.trace.len() + 1;
        self.samples.push(Snapshot::of(state, program, visit));
        if self.held > self.room && self.samples.len() > 1 {
            // Every other one goes, so that those left are the ones that twice the thinning would have kept.
            self.thin *= 2;
            let thin = self.thin;
            let first = self.samples[0].facts.visit;
            let offset = first % (thin / 2);
            self.samples.retain(|sample| (sample.facts.visit - offset).is_multiple_of(thin));
            self.held = self.samples.iter().map(|sample| sample.log.len() + 1).sum();
        }
    }
}

fn present<'a>(state: &'a State, program: &'a Program) -> impl Iterator<Item = (u128, Value)> + 'a {
    let trace = &state.trace;
    trace.numbers().map(|n| (trace.address(program, n), trace.choice(program, n).0.clone()))
}

fn logged(choices: impl IntoIterator<Item = (u128, Value)>) -> Log {
    let mut log = Log::default();
    for (address, value) in choices {
        log.push(address, value);
    }
    log
}
