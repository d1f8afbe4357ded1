//! Checkpoints for Python: the parts of a search as texts, by number.

use niwaki_run::checkpoint::Checkpoint;
use pyo3::prelude::*;
use std::collections::HashMap;

/// Parts from which a search resumes after its process was killed.
#[pyclass(frozen, name = "Checkpoint", module = "niwaki._engine")]
pub struct PyCheckpoint {
    pub(crate) checkpoint: Checkpoint,
}

#[pymethods]
impl PyCheckpoint {
    /// A checkpoint with the parts of an earlier search; without parts for a new search.
    #[new]
    fn new(left: HashMap<u64, String>) -> PyCheckpoint {
        PyCheckpoint { checkpoint: Checkpoint::of(left) }
    }

    /// Requests that each part is stored at its next border.
    fn ask(&self) {
        self.checkpoint.ask();
    }

    /// The parts that were stored since the last call, and the seconds that storing took.
    fn collect(&self) -> (HashMap<u64, String>, f64) {
        let (parts, cost) = self.checkpoint.collect();
        (parts, cost.as_secs_f64())
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyCheckpoint>()
}
