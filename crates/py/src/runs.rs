//! Finished runs, and their replays with names.

use crate::geometry::PyShape;
use crate::values::{Classes, distribution};
use niwaki_math::Dist;
use niwaki_particles::distinct::Choices;
use niwaki_run::log::Entry;
use niwaki_run::replay;
use niwaki_run::replay::{Part, Trace, by_address};
use niwaki_run::run::Run;
use niwaki_vm::value::Value;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::sync::Arc;

/// Finished run: scores, and choices by hash.
#[pyclass(frozen, name = "Run", module = "niwaki._engine")]
pub struct PyRun {
    run: Arc<Run>,
    classes: Arc<Classes>,
}

impl PyRun {
    pub fn new(run: Arc<Run>, classes: Arc<Classes>) -> PyRun {
        PyRun { run, classes }
    }

    /// Reads a run from [`PyRun::data`], without the returned value, and with `shift` added to its log weight.
    pub fn of_data(data: &str, shift: f64, classes: Arc<Classes>) -> PyResult<PyRun> {
        let mut run: Run = serde_json::from_str(data).map_err(unreadable)?;
        run.log_weight += shift;
        Ok(PyRun::new(Arc::new(run), classes))
    }

    pub fn went_to_its_end(&self) -> bool {
        self.run.has_ended
    }

    /// Its log score, nats, and the share of cells that are equal in the scene and its target.
    pub fn scores(&self) -> (f64, Option<f64>) {
        (self.run.log_score, self.run.similarity)
    }

    /// Its choices, in their order.
    pub fn entries(&self) -> Vec<Entry> {
        self.run.log.entries()
    }

    pub fn by_address(&self) -> HashMap<u128, Value> {
        by_address(&self.entries())
    }
}

fn unreadable(error: serde_json::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pymethods]
impl PyRun {
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

    /// Whether the run ended.
    #[getter]
    fn has_ended(&self) -> bool {
        self.run.has_ended
    }

    /// The cause that made the run impossible.
    #[getter]
    fn cause(&self) -> Option<&str> {
        self.run.cause.as_deref()
    }

    /// Whether the run was read from data, so that only a replay has its value.
    #[getter]
    fn is_bare(&self) -> bool {
        self.run.is_bare
    }

    /// The number of proposals before a state of a chain.
    #[getter]
    fn visit(&self) -> u64 {
        self.run.visit
    }

    /// The value that the model returned; None for a run that did not end.
    #[getter]
    fn value<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.classes.object(py, &self.run.value)
    }

    /// Its data without the returned value, which a replay gives again: for `Task.run_of_data`.
    fn data(&self) -> PyResult<String> {
        serde_json::to_string(&*self.run).map_err(unreadable)
    }

    /// Order choices in the order made: (hash of the address of the future that ran, its place among the runnable).
    fn order(&self) -> Vec<(u128, usize)> {
        self.entries().iter().filter_map(|entry| Some((entry.address(), entry.which()?))).collect()
    }
}

/// Choice with its name.
#[pyclass(frozen, name = "Choice", module = "niwaki._engine")]
pub struct PyChoice {
    /// Its readable address.
    #[pyo3(get)]
    path: String,
    /// Hash of the address.
    #[pyo3(get)]
    address: u128,
    /// Its value: a word, where its options are words.
    #[pyo3(get)]
    value: Py<PyAny>,
    /// The words of its options, in the order of the numbers that the run holds; None for a choice without words.
    #[pyo3(get)]
    words: Option<Vec<String>>,
    /// Its log density, nats.
    #[pyo3(get)]
    log_density: f64,
    /// The number of primitives, factors and observations before it.
    #[pyo3(get)]
    barriers: usize,
    dist: Dist,
}

#[pymethods]
impl PyChoice {
    /// The family of its distribution.
    #[getter]
    fn family(&self) -> &'static str {
        self.dist.family().name()
    }

    /// Its distribution.
    #[getter]
    fn distribution<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        distribution(py, &self.dist)
    }
}

impl PyChoice {
    pub fn of(py: Python<'_>, choice: &replay::Choice, classes: &Classes) -> PyResult<Py<PyChoice>> {
        let value = classes.object(py, &choice.named_value())?.unbind();
        let (path, address, dist) = (choice.path.clone(), choice.address, choice.dist.clone());
        let words = choice.words.as_ref().map(|words| words.iter().map(|word| word.to_string()).collect());
        let (log_density, barriers) = (choice.log_density, choice.barriers);
        Py::new(py, PyChoice { path, address, value, words, log_density, barriers, dist })
    }
}

/// Run with names.
#[pyclass(frozen, get_all, name = "Trace", module = "niwaki._engine")]
pub struct PyTrace {
    /// The run.
    run: Py<PyRun>,
    /// Every choice in depth-first order.
    choices: Vec<Py<PyChoice>>,
    /// Primitives: (address, shapes).
    parts: Vec<(String, Vec<Py<PyShape>>)>,
    /// The query table.
    queries: Py<PyDict>,
    /// The number of primitives before which a host function was called, after the primitive before.
    hosted: usize,
}

impl PyTrace {
    pub fn new(py: Python<'_>, trace: Trace, classes: &Arc<Classes>) -> PyResult<PyTrace> {
        let queries = PyDict::new(py);
        for (key, value) in &trace.queries {
            queries.set_item(classes.object(py, key)?, classes.object(py, value)?)?;
        }
        let choices = trace.choices.iter().map(|choice| PyChoice::of(py, choice, classes));
        let mut parts = Vec::with_capacity(trace.parts.len());
        for Part { path, shapes, .. } in trace.parts {
            let shapes = shapes.into_iter().map(|s| Py::new(py, PyShape(s))).collect::<PyResult<_>>()?;
            parts.push((path, shapes));
        }
        Ok(PyTrace {
            choices: choices.collect::<PyResult<_>>()?,
            run: Py::new(py, PyRun::new(Arc::new(trace.run), classes.clone()))?,
            parts,
            queries: queries.unbind(),
            hosted: trace.hosted,
        })
    }
}

fn choices_of(py: Python<'_>, runs: &[Py<PyRun>]) -> Choices {
    py.detach(|| Choices::of(runs.iter().map(|run| &run.get().run.log)))
}

/// The number of runs of which no two share more than half of their choices.
#[pyfunction]
fn unique_models(py: Python<'_>, runs: Vec<Py<PyRun>>) -> usize {
    let choices = choices_of(py, &runs);
    py.detach(|| choices.unique())
}

/// The places of up to ``k`` runs that differ from each other, taken greedily from the first on.
#[pyfunction]
fn different(py: Python<'_>, runs: Vec<Py<PyRun>>, k: usize) -> Vec<usize> {
    let choices = choices_of(py, &runs);
    let ranked: Vec<usize> = (0..runs.len()).collect();
    py.detach(|| choices.choose(&ranked, k))
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(unique_models, module)?)?;
    module.add_function(wrap_pyfunction!(different, module)?)?;
    module.add_class::<PyChoice>()?;
    module.add_class::<PyRun>()?;
    module.add_class::<PyTrace>()
}
