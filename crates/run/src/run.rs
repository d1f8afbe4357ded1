//! Finished runs of any method: choices as a log of addresses and values, scores, measures.

use crate::log::Log;
use crate::record::Record;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, Mutex, PoisonError};

/// A finished run. Scores are in nats. The serialised form has no value, which a replay computes again, and no fault.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Run {
    /// The choices in order, including the order choices of particles.
    pub log: Log,
    /// The value of the program; `None` for a run that did not end.
    #[serde(skip)]
    pub value: Value,
    /// The sum of the log densities of the choices.
    #[serde(with = "niwaki_math::bits")]
    pub log_prior: f64,
    /// The sum of factors, observations and sketches.
    #[serde(with = "niwaki_math::bits")]
    pub log_score: f64,
    /// The log weight in its population; 0 where all weights are equal.
    #[serde(with = "niwaki_math::bits")]
    pub log_weight: f64,
    /// The number of primitives of the scene.
    pub primitives: usize,
    /// The share of cells that are equal in the scene and its target.
    pub similarity: Option<f64>,
    /// Whether the run ended.
    pub has_ended: bool,
    /// The name of the factor or sketch that made the run impossible.
    pub cause: Option<String>,
    /// The fault of an invalid run.
    #[serde(skip)]
    pub invalid: Option<Arc<RunFault>>,
    /// The number of proposals before a state of a chain; 0 for other runs.
    pub visit: u64,
    /// Whether the run was deserialised, so that a replay must compute its value.
    #[serde(skip_serializing, default = "is_read")]
    pub is_bare: bool,
}

/// The default of `is_bare` for deserialised runs.
fn is_read() -> bool {
    true
}

/// The best run so far of a running search, for watchers.
pub type Shown = Mutex<Option<Arc<Run>>>;

impl Run {
    /// Copy the run; both copies share the choices.
    pub fn copy(&mut self) -> Run {
        Run {
            log: self.log.fork(),
            value: self.value.clone(),
            cause: self.cause.clone(),
            invalid: self.invalid.clone(),
            ..*self
        }
    }

    /// Publish the run to watchers, if it is better than the published run.
    pub fn show(&mut self, shown: &Shown) {
        let mut now = shown.lock().unwrap_or_else(PoisonError::into_inner);
        if now.as_ref().is_none_or(|before| before.log_score < self.log_score) {
            *now = Some(Arc::new(self.copy()));
        }
    }

    /// Finish a record: the sketches are dropped.
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
            invalid: record.invalid,
            log: record.log,
            visit: 0,
            is_bare: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_restored_from_its_data_to_the_bit() {
        let mut log = Log::default();
        let vector = Value::tuple(vec![Value::Real(0.1), Value::Real(f64::INFINITY)]);
        let values = [Value::Bool(true), Value::Int(-3), Value::Real(-0.0), Value::Real(f64::NAN), vector];
        for (i, value) in values.into_iter().enumerate() {
            log.push(u128::MAX - i as u128, value);
        }
        log.push_order(7, 2);
        let (score, similarity) = (f64::NEG_INFINITY, Some(0.1 + 0.2));
        let run =
            Run { log, log_prior: 0.1, log_score: score, similarity, visit: u64::MAX, ..Run::default() };
        let text = serde_json::to_string(&run).expect("data");
        let back: Run = serde_json::from_str(&text).expect("a run");
        assert!(back.is_bare && !run.is_bare);
        let back = Run { is_bare: false, ..back };
        assert_eq!(format!("{run:?}"), format!("{back:?}"));
        assert_eq!((back.log_prior, back.log_score, back.similarity), (0.1, score, similarity));
        let values: Vec<_> = back.log.entries().into_iter().map(|entry| entry.value).collect();
        assert!(matches!(values[2], Value::Real(x) if x.to_bits() == (-0.0f64).to_bits()));
    }
}
