//! What a search finds: light outcomes, and the traces that they become when they are run once more.

use crate::geometry::PyShape;
use crate::values::{Classes, Opaque};
use niwaki_infer::log::{Entry, Log};
use niwaki_infer::particles::distinct::Choices;
use niwaki_infer::replay::{Trace, by_address};
use niwaki_infer::run::Run;
use niwaki_vm::value::Value;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::sync::Arc;

/// One finished run: scores and choices by hash.
#[pyclass(frozen, name = "Outcome", module = "niwaki._engine")]
pub struct PyOutcome {
    run: Run,
    classes: Arc<Classes>,
}

impl PyOutcome {
    pub fn new(run: Run, classes: Arc<Classes>) -> PyOutcome {
        PyOutcome { run, classes }
    }

    pub fn ended(&self) -> bool {
        self.run.has_ended
    }

    pub fn entries(&self) -> Vec<Entry> {
        self.run.log.entries()
    }

    pub fn by_address(&self) -> HashMap<u128, Value> {
        by_address(&self.entries())
    }
}

#[pymethods]
impl PyOutcome {
    /// Factors, observations and sketches, nats.
    #[getter]
    fn log_score(&self) -> f64 {
        self.run.log_score
    }

    /// Log density of the choices, nats.
    #[getter]
    fn log_prior(&self) -> f64 {
        self.run.log_prior
    }

    /// Log weight in its population, nats.
    #[getter]
    fn log_weight(&self) -> f64 {
        self.run.log_weight
    }

    /// Primitives of the scene.
    #[getter]
    fn primitives(&self) -> usize {
        self.run.primitives
    }

    /// Share of cells equal in scene and target; None without a target.
    #[getter]
    fn similarity(&self) -> Option<f64> {
        self.run.similarity
    }

    /// Whether the run went to its end.
    #[getter]
    fn has_ended(&self) -> bool {
        self.run.has_ended
    }

    /// What made it impossible.
    #[getter]
    fn cause(&self) -> Option<&str> {
        self.run.cause.as_deref()
    }

    /// Of a chain's state: the number of proposals before it.
    #[getter]
    fn visit(&self) -> u64 {
        self.run.visit
    }

    /// What the model returned; None for a run that did not end.
    #[getter]
    fn value<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.classes.object(py, &self.run.value)
    }

    /// All that it holds but what the model returned, which a replay gives again: for `Task.outcome`.
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (run, data) = (&self.run, PyDict::new(py));
        data.set_item("choices", self.choices(py)?)?;
        data.set_item("order", self.order())?;
        data.set_item("log_prior", run.log_prior)?;
        data.set_item("log_score", run.log_score)?;
        data.set_item("log_weight", run.log_weight)?;
        data.set_item("primitives", run.primitives)?;
        data.set_item("similarity", run.similarity)?;
        data.set_item("has_ended", run.has_ended)?;
        data.set_item("cause", run.cause.as_deref())?;
        data.set_item("visit", run.visit)?;
        Ok(data)
    }

    /// Choices in the order made: (hash of the address, value).
    fn choices<'py>(&self, py: Python<'py>) -> PyResult<Vec<(u128, Bound<'py, PyAny>)>> {
        let entries = self.entries();
        let chosen = entries.iter().filter(|e| !e.is_order());
        chosen.map(|e| Ok((e.address(), self.classes.object(py, &e.value)?))).collect()
    }

    /// Order choices in the order made: (hash of the address of the future that ran, its place among the runnable).
    fn order(&self) -> Vec<(u128, i64)> {
        self.entries().iter().filter_map(|e| Some((e.address(), e.which()? as i64))).collect()
    }
}

/// What `PyOutcome::data` gives.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct OutcomeData<'py> {
    choices: Vec<(u128, Bound<'py, PyAny>)>,
    order: Vec<(u128, usize)>,
    log_prior: f64,
    log_score: f64,
    log_weight: f64,
    primitives: usize,
    similarity: Option<f64>,
    has_ended: bool,
    cause: Option<String>,
    visit: u64,
}

impl OutcomeData<'_> {
    /// The outcome, without what the model returned.
    pub fn outcome(self, classes: Arc<Classes>) -> PyResult<PyOutcome> {
        let mut log = Log::default();
        for (address, value) in self.choices {
            log.push(address, classes.value(&value)?);
        }
        for (address, which) in self.order {
            log.push_order(address, which);
        }
        let run = Run {
            log,
            value: Value::None,
            log_prior: self.log_prior,
            log_score: self.log_score,
            log_weight: self.log_weight,
            primitives: self.primitives,
            similarity: self.similarity,
            has_ended: self.has_ended,
            cause: self.cause,
            visit: self.visit,
        };
        Ok(PyOutcome { run, classes })
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
            similarity: record.sketches.similarity(),
            cause: record.cause.clone(),
        })
    }
}

fn choices_of(py: Python<'_>, outcomes: &[Py<PyOutcome>]) -> Choices {
    py.detach(|| Choices::of(outcomes.iter().map(|outcome| &outcome.get().run.log)))
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
