//! A finished run, whatever found it: its choices as a log of addresses and values, its scores, its measures.

use crate::chain::snapshot::{Snapshot, copy_of};
use crate::forward::Sample;
use crate::log::Log;
use crate::particles::Outcome;
use crate::record::Record;
use niwaki_vm::value::Value;

/// A finished run. Scores are in nats.
#[derive(Debug, Default)]
pub struct Run {
    /// Its choices, in the order made; order choices of particles are among them.
    pub log: Log,
    /// What the program returned (`None` for a run that did not end).
    pub value: Value,
    /// Log densities of the choices.
    pub log_prior: f64,
    /// Factors, observations and sketches.
    pub log_score: f64,
    /// The weight in its population; 0 where all weigh the same.
    pub log_weight: f64,
    /// Primitives of the scene.
    pub primitives: usize,
    /// Share of cells that are equal in the scene and its target.
    pub similarity: Option<f64>,
    /// Whether it went to its end.
    pub has_ended: bool,
    /// What made it impossible.
    pub cause: Option<String>,
    /// Of a chain's state: the number of proposals before it.
    pub visit: u64,
}

impl Run {
    /// Of a record, whose sketches are not kept.
    pub fn of(record: Record, value: Value, log_weight: f64, has_ended: bool) -> Run {
        Run {
            value,
            log_prior: record.log_prior.value(),
            log_score: record.log_score(),
            log_weight,
            primitives: record.primitives,
            similarity: record.sketches.similarity(),
            has_ended,
            cause: record.cause,
            log: record.log,
            visit: 0,
        }
    }

    /// Of a forward run: one that is impossible stopped before its end, unless it was to be complete.
    pub fn of_sample(sample: Sample, complete: bool, log_weight: f64) -> Run {
        let has_ended = complete || sample.record.cause.is_none();
        Run::of(sample.record, sample.value, log_weight, has_ended)
    }
}

impl From<Outcome> for Run {
    fn from(outcome: Outcome) -> Run {
        Run::of(outcome.record, outcome.value, outcome.log_weight, outcome.has_ended)
    }
}

impl From<&Snapshot> for Run {
    /// Of a chain's state, which other samples may share: the log is copied.
    fn from(snapshot: &Snapshot) -> Run {
        let facts = &snapshot.facts;
        Run {
            log: copy_of(&snapshot.log),
            value: facts.value.clone(),
            log_prior: facts.log_prior,
            log_score: facts.log_score,
            primitives: facts.primitives,
            similarity: facts.similarity,
            has_ended: true,
            visit: facts.visit,
            ..Run::default()
        }
    }
}
