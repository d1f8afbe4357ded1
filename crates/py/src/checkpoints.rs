//! Checkpoints for Python: the parts of a search as texts, by number.

use niwaki_run::checkpoint::Checkpoint;
use pyo3::prelude::*;
use std::collections::HashMap;

/// What a search needs to go on after it was killed.
#[pyclass(frozen, name = "Checkpoint", module = "niwaki._engine")]
pub struct PyCheckpoint {
    pub(crate) checkpoint: Checkpoint,
}

#[pymethods]
impl PyCheckpoint {
    /// Of the parts that an earlier search left; of none, for one that begins.
    #[new]
    fn new(left: HashMap<u64, String>) -> PyCheckpoint {
        PyCheckpoint { checkpoint: Checkpoint::of(left) }
    }

    /// From now on each part is stored at its next border.
    fn ask(&self) {
        self.checkpoint.ask();
    }

    /// The parts that were stored since the last call, and the seconds that this took.
    fn collect(&self) -> (HashMap<u64, String>, f64) {
        let (parts, cost) = self.checkpoint.collect();
        (parts, cost.as_secs_f64())
    }
}

/// Puts this part into the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyCheckpoint>()
}
