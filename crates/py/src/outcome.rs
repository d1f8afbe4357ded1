//! What a search finds: light outcomes, and the traces that they become when they are run once more.

use crate::geometry::PyShape;
use crate::values::{Classes, Opaque};
use niwaki_infer::chain::snapshot::Snapshot;
use niwaki_infer::log::{Entry, Log};
use niwaki_infer::particles::distinct::Choices;
use niwaki_infer::record::Record;
use niwaki_infer::replay::{Trace, by_address};
use niwaki_vm::value::Value;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::sync::Arc;

/// One finished run: scores and choices by hash.
#[pyclass(frozen, name = "Outcome", module = "niwaki._engine")]
pub struct PyOutcome {
    log: Log,
    value: Value,
    classes: Arc<Classes>,
    /// Factors, observations and sketches, nats.
    #[pyo3(get)]
    log_score: f64,
    /// Log density of the choices, nats.
    #[pyo3(get)]
    log_prior: f64,
    /// Log weight in its population, nats.
    #[pyo3(get)]
    log_weight: f64,
    /// Primitives of the scene.
    #[pyo3(get)]
    primitives: usize,
    /// Share of cells equal in scene and target; None without a target.
    #[pyo3(get)]
    similarity: Option<f64>,
    /// Whether the run went to its end.
    #[pyo3(get)]
    has_ended: bool,
    /// What made it impossible.
    #[pyo3(get)]
    cause: Option<String>,
}

impl PyOutcome {
    pub fn new(
        record: Record,
        value: Value,
        log_weight: f64,
        has_ended: bool,
        classes: Arc<Classes>,
    ) -> PyOutcome {
        PyOutcome {
            value,
            classes,
            log_score: record.log_score(),
            log_prior: record.log_prior.value(),
            log_weight,
            primitives: record.primitives,
            similarity: similarity(&record),
            has_ended,
            cause: record.cause,
            log: record.log,
        }
    }

    /// A state of a chain.
    pub fn of_snapshot(snapshot: &Snapshot, classes: Arc<Classes>) -> PyOutcome {
        let (facts, mut log) = (&snapshot.facts, Log::default());
        for entry in snapshot.log.entries() {
            log.push(entry.address(), entry.value);
        }
        PyOutcome {
            log,
            value: facts.value.clone(),
            classes,
            log_score: facts.log_score,
            log_prior: facts.log_prior,
            log_weight: 0.0,
            primitives: facts.primitives,
            similarity: facts.similarity,
            has_ended: true,
            cause: None,
        }
    }

    pub fn ended(&self) -> bool {
        self.has_ended
    }

    pub fn entries(&self) -> Vec<Entry> {
        self.log.entries()
    }

    pub fn by_address(&self) -> HashMap<u128, Value> {
        by_address(&self.log.entries())
    }
}

fn similarity(record: &Record) -> Option<f64> {
    let measures = record.sketches.measures();
    measures.into_iter().find(|(name, _)| *name == "similarity").map(|(_, value)| value)
}

#[pymethods]
impl PyOutcome {
    /// What the model returned; None for a run that did not end.
    #[getter]
    fn value<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.classes.object(py, &self.value)
    }

    /// Choices in the order made: (hash of the address, value).
    fn choices<'py>(&self, py: Python<'py>) -> PyResult<Vec<(u128, Bound<'py, PyAny>)>> {
        let entries = self.log.entries();
        let chosen = entries.iter().filter(|e| !e.is_order());
        chosen.map(|e| Ok((e.address(), self.classes.object(py, &e.value)?))).collect()
    }

    /// Order choices in the order made: (hash of the address of the future that ran, its place among the runnable).
    fn order(&self) -> Vec<(u128, i64)> {
        self.log.entries().iter().filter_map(|e| Some((e.address(), e.which()? as i64))).collect()
    }
}

/// A run with names.
#[pyclass(frozen, get_all, name = "Trace", module = "niwaki._engine")]
pub struct PyTrace {
    /// Every choice in depth-first order: (address, hash, family, value, log density).
    choices: Vec<(String, u128, &'static str, Py<PyAny>, f64)>,
    /// Primitives: (address, shapes).
    parts: Vec<(String, Vec<Py<PyShape>>)>,
    /// The query table.
    queries: Py<PyDict>,
    /// What the model returned.
    value: Py<PyAny>,
    /// Log density of the choices, nats.
    log_prior: f64,
    /// Factors, observations and sketches, nats.
    log_score: f64,
    /// Primitives of the scene.
    primitives: usize,
    /// Share of cells equal in scene and target; None without a target.
    similarity: Option<f64>,
    /// What made it impossible.
    cause: Option<String>,
}

impl PyTrace {
    pub fn new(py: Python<'_>, trace: Trace, classes: &Classes) -> PyResult<PyTrace> {
        let queries = PyDict::new(py);
        for (key, value) in &trace.queries {
            queries.set_item(classes.object(py, key)?, classes.object(py, value)?)?;
        }
        let mut choices = Vec::with_capacity(trace.choices.len());
        for c in trace.choices {
            choices.push((
                c.path,
                c.address,
                c.family,
                classes.object(py, &c.value)?.unbind(),
                c.log_density,
            ));
        }
        let mut parts = Vec::with_capacity(trace.parts.len());
        for (path, shapes) in trace.parts {
            let shapes = shapes.into_iter().map(|s| Py::new(py, PyShape(s))).collect::<PyResult<_>>()?;
            parts.push((path, shapes));
        }
        // A value too deep to pass must not take choices and scene with it.
        let value = match classes.object(py, &trace.value) {
            Ok(value) => value.unbind(),
            Err(_) => Py::new(py, Opaque("value too deep to pass"))?.into_any(),
        };
        let record = &trace.record;
        Ok(PyTrace {
            choices,
            parts,
            queries: queries.unbind(),
            value,
            log_prior: record.log_prior.value(),
            log_score: record.log_score(),
            primitives: record.primitives,
            similarity: similarity(record),
            cause: record.cause.clone(),
        })
    }
}

fn choices_of(py: Python<'_>, outcomes: &[Py<PyOutcome>]) -> Choices {
    py.detach(|| Choices::of(outcomes.iter().map(|outcome| &outcome.get().log)))
}

/// Of how many no other has more than half of the choices.
#[pyfunction]
fn unique_models(py: Python<'_>, outcomes: Vec<Py<PyOutcome>>) -> usize {
    let choices = choices_of(py, &outcomes);
    py.detach(|| choices.unique())
}

/// The places of up to ``k`` outcomes that differ from each other, taken greedily from the first on.
#[pyfunction]
fn different(py: Python<'_>, outcomes: Vec<Py<PyOutcome>>, k: usize) -> Vec<usize> {
    let choices = choices_of(py, &outcomes);
    let ranked: Vec<usize> = (0..outcomes.len()).collect();
    py.detach(|| choices.choose(&ranked, k))
}

/// Puts this room into the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(unique_models, module)?)?;
    module.add_function(wrap_pyfunction!(different, module)?)?;
    module.add_class::<PyOutcome>()?;
    module.add_class::<PyTrace>()
}
