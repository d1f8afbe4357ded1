//! A finished run of any method: its choices as a log of addresses and values, its scores, its measures.

use crate::log::Log;
use crate::record::Record;
use niwaki_vm::machine::stack::RunFault;
use niwaki_vm::value::Value;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, Mutex, PoisonError};

/// A finished run. Scores are in nats. Its serialised form lacks the value, which a replay gives again, and the fault.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Run {
    /// Its choices in order, with the order choices of particles.
    pub log: Log,
    /// What the program returned (`None` for a run that did not end).
    #[serde(skip)]
    pub value: Value,
    /// Log densities of the choices.
    #[serde(with = "niwaki_math::bits")]
    pub log_prior: f64,
    /// Factors, observations and sketches.
    #[serde(with = "niwaki_math::bits")]
    pub log_score: f64,
    /// The weight in its population; 0 where all weigh the same.
    #[serde(with = "niwaki_math::bits")]
    pub log_weight: f64,
    /// Primitives of the scene.
    pub primitives: usize,
    /// Share of cells that are equal in the scene and its target.
    pub similarity: Option<f64>,
    /// Whether it ended.
    pub has_ended: bool,
    /// What made it impossible.
    pub cause: Option<String>,
    /// The fault, where that makes the run invalid.
    #[serde(skip)]
    pub invalid: Option<Arc<RunFault>>,
    /// Of a chain's state: the number of proposals before it.
    pub visit: u64,
    /// Whether it comes from its serialised form, so that its value is to be taken from a replay.
    #[serde(skip_serializing, default = "is_read")]
    pub is_bare: bool,
}

/// A run that is read has no value.
fn is_read() -> bool {
    true
}

/// The best run so far of a search that goes on, for those who watch it.
pub type Shown = Mutex<Option<Arc<Run>>>;

impl Run {
    /// A copy; both share the choices.
    pub fn copy(&mut self) -> Run {
        Run {
            log: self.log.fork(),
            value: self.value.clone(),
            cause: self.cause.clone(),
            invalid: self.invalid.clone(),
            ..*self
        }
    }

    /// Shows it, if it is better than what is shown.
    pub fn show(&mut self, shown: &Shown) {
        let mut now = shown.lock().unwrap_or_else(PoisonError::into_inner);
        if now.as_ref().is_none_or(|before| before.log_score < self.log_score) {
            *now = Some(Arc::new(self.copy()));
        }
    }

    /// The run of a record; the sketches are dropped.
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
    //! A run is restored from its data to the bit.
    use super::*;

    #[test]
    fn a_run_comes_back_from_its_data() {
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
