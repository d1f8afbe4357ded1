//! States of a chain that were kept: choices by address, and what is known beside them.

use super::state::State;
use crate::log::Log;
use niwaki_vm::code::Program;
use niwaki_vm::value::Value;

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
        Facts { value: state.trace.result(), ..Facts::of_scores(state, visit) }
    }

    /// All but what the program returned, which takes the length of a list that it returned.
    pub(super) fn of_scores(state: &State, visit: u64) -> Facts {
        Facts {
            value: Value::default(),
            log_prior: state.trace.totals().log_prior.value(),
            log_score: state.log_score(),
            primitives: state.primitives,
            similarity: state.sketches.similarity(),
            visit,
        }
    }
}

/// The choices of the present state.
pub(crate) fn present<'a>(
    state: &'a State,
    program: &'a Program,
) -> impl Iterator<Item = (u128, Value)> + 'a {
    let trace = &state.trace;
    trace.numbers().map(|n| (trace.address(program, n), trace.choice(program, n).0.clone()))
}

/// Choices as a log.
pub(crate) fn logged(choices: impl IntoIterator<Item = (u128, Value)>) -> Log {
    let mut log = Log::default();
    for (address, value) in choices {
        log.push(address, value);
    }
    log
}

/// A log of the same choices that shares nothing with it: those of a chain may be shared among its samples.
pub(crate) fn copy_of(log: &Log) -> Log {
    logged(log.entries().into_iter().map(|entry| (entry.address(), entry.value)))
}
