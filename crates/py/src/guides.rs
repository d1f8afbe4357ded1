//! Guides for Python: files, and training on the traces of searches.

use crate::checkpoints::PyCheckpoint;
use crate::faults;
use crate::runs::PyRun;
use crate::search::{PyTask, detached};
use crate::shared::Shared;
use niwaki_guide::Progress;
use niwaki_propose::guide::Guide;
use niwaki_propose::guide::bound::BoundGuide;
use niwaki_run::log::Entry;
use niwaki_search::learn::climb::{Case, climb};
use niwaki_search::learn::lessons::{Example, Making, losses, train};
use niwaki_search::learn::rehearse::{Rehearsal, rehearse as rehearsed};
use niwaki_vm::fault::Fault;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde::de::DeserializeOwned;
use std::sync::Arc;

/// Trained guide.
#[pyclass(frozen, name = "Guide", module = "niwaki._engine")]
pub struct PyGuide {
    pub(crate) guide: Arc<Guide>,
}

#[pymethods]
impl PyGuide {
    /// Reads a guide from the bytes of its file.
    #[new]
    fn new(py: Python<'_>, data: &[u8]) -> PyResult<PyGuide> {
        let guide = Guide::of_bytes(data).map_err(|fault| faults::setting(py, &fault))?;
        Ok(PyGuide { guide: Arc::new(guide) })
    }

    /// The bytes of the guide's file.
    fn data<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.guide.bytes())
    }

    /// Its inputs and the choices that it draws, as JSON.
    fn form(&self) -> PyResult<String> {
        serde_json::to_string(&self.guide.form)
            .map_err(|error| pyo3::exceptions::PyValueError::new_err(error.to_string()))
    }

    /// Names of the inputs beside the windows.
    fn inputs(&self) -> Vec<String> {
        self.guide.form.names()
    }

    /// The number of weights of its network.
    fn weights(&self) -> usize {
        self.guide.net.size()
    }

    /// Copies the guide with another report, a JSON object.
    fn with_report(&self, py: Python<'_>, report: &str) -> PyResult<PyGuide> {
        let report = serde_json::from_str(report)
            .map_err(|error| faults::setting(py, &Fault::new("bad-guide", error.to_string())))?;
        let mut form = self.guide.form.clone();
        form.report = report;
        Ok(PyGuide { guide: Arc::new(Guide { form, net: self.guide.net.clone() }) })
    }

    /// Differences between the guide and the model of a task, as sentences; an error if no choice matches.
    fn lost(&self, py: Python<'_>, task: &PyTask) -> PyResult<Vec<String>> {
        let task = task.keeping_all(py)?;
        let bound =
            BoundGuide::new(self.guide.clone(), &task).map_err(|fault| faults::setting(py, &fault))?;
        Ok(bound.lost)
    }
}

/// Traces for training.
#[pyclass(frozen, name = "Lessons", module = "niwaki._engine")]
pub struct PyLessons {
    examples: Shared<Vec<Example>>,
}

#[pymethods]
impl PyLessons {
    #[new]
    fn new() -> PyLessons {
        PyLessons { examples: Shared::new(Vec::new()) }
    }

    /// Adds a run of a task; ``held_out`` runs are for tests only.
    fn add(&self, py: Python<'_>, task: &PyTask, run: &PyRun, held_out: bool) -> PyResult<()> {
        let entries: Vec<Entry> = run.entries();
        let example = Example { task: task.keeping_all(py)?, entries, held_out };
        self.examples.lock(py)?.push(example);
        Ok(())
    }

    /// For each trace the number of choices that a guide draws, and the sum of their ``ln(p / q)``, nats: by how much the trace
    /// is less likely under the guide than under the prior.
    fn losses(&self, py: Python<'_>, task: &PyTask, guide: &PyGuide) -> PyResult<Vec<(usize, f64)>> {
        let using = self.examples.lock(py)?;
        let examples: &[Example] = &using;
        let (drawn_losses, _) = detached(py, &task.task, None, None, |_| losses(examples, &guide.guide))?;
        Ok(drawn_losses)
    }

    /// Trains a guide, or continues its training: the guide, and a dict of statistics. ``settings`` is JSON.
    #[pyo3(signature = (task, settings, start=None, threads=None, watch=None, checkpoint=None))]
    #[expect(clippy::too_many_arguments, reason = "the settings of a training")]
    fn train<'py>(
        &self,
        py: Python<'py>,
        task: &PyTask,
        settings: &str,
        start: Option<&PyGuide>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
        checkpoint: Option<&PyCheckpoint>,
    ) -> PyResult<(PyGuide, Bound<'py, PyDict>)> {
        let making: Making = read(py, settings)?;
        let classes = &task.model.get().classes;
        let caller = watch.as_ref().map(|call| (call, classes));
        let start = start.map(|guide| guide.guide.clone());
        let using = self.examples.lock(py)?;
        let examples: &[Example] = &using;
        let checkpoint = checkpoint.map(|stored| &stored.checkpoint);
        let (result, pressed) = detached(py, &task.task, threads, caller, |watch| {
            let mut seen = |now: Progress| {
                watch.look(now.step, usize::try_from(now.steps).unwrap_or(usize::MAX), -now.held_out)
            };
            train(examples, &making, start.as_deref(), &mut seen, checkpoint)
        })?;
        let statistics = PyDict::new(py);
        let losses = result.history.iter().map(|now| (now.step, now.loss, now.held_out));
        statistics.set_item("rows", result.rows)?;
        statistics.set_item("bytes", result.bytes)?;
        statistics.set_item("losses", losses.collect::<Vec<_>>())?;
        statistics.set_item("diverged", result.diverged)?;
        statistics.set_item("interrupted", pressed)?;
        Ok((PyGuide { guide: Arc::new(result.guide) }, statistics))
    }
}

/// Raises the evidence bound of a guide on tasks, from a guide or from the prior: the guide, and a dict of
/// statistics. Tasks of `held_out` are for tests only. ``settings`` is JSON.
#[pyfunction]
#[pyo3(signature = (tasks, held_out, settings, start=None, threads=None, watch=None, checkpoint=None))]
#[expect(clippy::too_many_arguments, reason = "the settings of a training")]
fn raise_bound<'py>(
    py: Python<'py>,
    tasks: Vec<Py<PyTask>>,
    held_out: Vec<Py<PyTask>>,
    settings: &str,
    start: Option<&PyGuide>,
    threads: Option<usize>,
    watch: Option<Py<PyAny>>,
    checkpoint: Option<&PyCheckpoint>,
) -> PyResult<(PyGuide, Bound<'py, PyDict>)> {
    let making: Making = read(py, settings)?;
    let Some(first) = tasks.first() else { return Err(PyValueError::new_err("there are no tasks")) };
    let cases = cases(py, &tasks, &held_out)?;
    let (start, checkpoint) =
        (start.map(|stored| stored.guide.clone()), checkpoint.map(|stored| &stored.checkpoint));
    let task = first.get();
    let classes = &task.model.get().classes;
    let caller = watch.as_ref().map(|call| (call, classes));
    let (result, pressed) = detached(py, &task.task, threads, caller, |watch| {
        let mut seen = |now: Progress| {
            watch.look(now.step, usize::try_from(now.steps).unwrap_or(usize::MAX), -now.held_out)
        };
        climb(&cases, &making, start.as_deref(), &mut seen, checkpoint)
    })?;
    let statistics = PyDict::new(py);
    let looks = result.history.iter().zip(&result.lost);
    let bounds = looks.map(|(now, lost)| (now.step, -now.loss, -now.held_out, lost[0], lost[1]));
    statistics.set_item("bounds", bounds.collect::<Vec<_>>())?;
    statistics.set_item("diverged", result.diverged)?;
    statistics.set_item("interrupted", pressed)?;
    Ok((PyGuide { guide: Arc::new(result.guide) }, statistics))
}

/// Trains the look-ahead of a guide: the guide, and a dict of statistics. Tasks of `held_out` are for tests only. ``settings`` is JSON.
#[pyfunction]
#[pyo3(signature = (tasks, held_out, guide, settings, threads=None, watch=None))]
fn rehearse<'py>(
    py: Python<'py>,
    tasks: Vec<Py<PyTask>>,
    held_out: Vec<Py<PyTask>>,
    guide: &PyGuide,
    settings: &str,
    threads: Option<usize>,
    watch: Option<Py<PyAny>>,
) -> PyResult<(PyGuide, Bound<'py, PyDict>)> {
    let plan: Rehearsal = read(py, settings)?;
    let cases = cases(py, &tasks, &held_out)?;
    let Some(first) = tasks.first() else { return Err(PyValueError::new_err("there are no tasks")) };
    let task = first.get();
    let classes = &task.model.get().classes;
    let caller = watch.as_ref().map(|call| (call, classes));
    let bound_guide = guide.guide.clone();
    let (result, pressed) = detached(py, &task.task, threads, caller, |watch| {
        rehearsed(&cases, &bound_guide, &plan, &mut |done, total| watch.look(done as u64, total, 0.0))
    })?;
    let statistics = PyDict::new(py);
    statistics.set_item("rises", result.rises)?;
    statistics.set_item("died", result.died)?;
    statistics.set_item("failed", result.failed)?;
    statistics.set_item("error", result.error)?;
    statistics.set_item("deviation", result.deviation)?;
    statistics.set_item("strength", result.strength)?;
    statistics.set_item("interrupted", pressed)?;
    Ok((PyGuide { guide: Arc::new(result.guide) }, statistics))
}

/// The settings of a training, from JSON.
fn read<T: DeserializeOwned>(py: Python<'_>, settings: &str) -> PyResult<T> {
    serde_json::from_str(settings)
        .map_err(|error| faults::setting(py, &Fault::new("bad-setting", error.to_string())))
}

/// Targets for training, and targets for tests.
fn cases(py: Python<'_>, tasks: &[Py<PyTask>], held_out: &[Py<PyTask>]) -> PyResult<Vec<Case>> {
    let case = |task: &Py<PyTask>, held_out| Ok(Case { task: task.get().keeping_all(py)?, held_out });
    let learned = tasks.iter().map(|task| case(task, false));
    let judged = held_out.iter().map(|task| case(task, true));
    learned.chain(judged).collect()
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyGuide>()?;
    module.add_class::<PyLessons>()?;
    module.add_function(wrap_pyfunction!(rehearse, module)?)?;
    module.add_function(wrap_pyfunction!(raise_bound, module)?)
}
