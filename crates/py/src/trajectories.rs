//! Chains that follow the gradient, for Python.

use crate::faults;
use crate::gradients::PyCoordinates;
use crate::runs::{PyChoice, PyRun};
use crate::search::{PyTask, detached};
use crate::threads::Pool;
use niwaki_continuous::hamiltonian::{BrokenOff, Cause};
use niwaki_run::Failure;
use niwaki_search::direct::explore::{Explored, Plan, explore};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

type Reals<'py> = Bound<'py, PyArray1<f64>>;

/// Draws of several chains with one seed.
#[pyclass(frozen, name = "Trajectories", module = "niwaki._engine")]
pub struct PyTrajectories {
    task: Py<PyTask>,
    chains: Vec<Explored>,
    /// Whether the chains were stopped before their end.
    #[pyo3(get)]
    interrupted: bool,
}

#[pymethods]
impl PyTrajectories {
    /// Runs the chains of a method, given as its text. ``start`` has values for the choices of their starts.
    #[new]
    #[pyo3(signature = (task, method, seed, *, start=None, threads=None, watch=None))]
    fn new(
        py: Python<'_>,
        task: Py<PyTask>,
        method: &str,
        seed: u64,
        start: Option<&PyRun>,
        threads: Option<usize>,
        watch: Option<Py<PyAny>>,
    ) -> PyResult<PyTrajectories> {
        let py_task = task.get();
        let (settings, chains, tries) = (py_task.read(py, method)?.trajectories())
            .map_err(|fault| faults::setting(py, &fault))?
            .ok_or_else(|| PyTypeError::new_err("this method does not follow the gradient"))?;
        let known = start.map(PyRun::by_address);
        let plan = Plan { settings: &settings, seed, chains, tries, known: known.as_ref() };
        let caller = watch.as_ref().map(|callable| (callable, &py_task.model.get().classes));
        let (chains, pressed) = detached(py, &py_task.task, threads, caller, |watch| {
            explore(&py_task.task, &plan, &|done| watch.look(done, 0, f64::NEG_INFINITY))
        })?;
        let interrupted = pressed || chains.iter().any(|chain| chain.draws.interrupted);
        Ok(PyTrajectories { task, chains, interrupted })
    }

    /// The number of chains.
    #[getter]
    fn chains(&self) -> usize {
        self.chains.len()
    }

    /// Continuous choices of a chain.
    fn choices(&self, chain: usize) -> PyResult<Vec<PyCoordinates>> {
        Ok(self.chain(chain)?.choices().iter().map(PyCoordinates::of).collect())
    }

    /// Choices that a chain held fixed.
    fn fixed(&self, py: Python<'_>, chain: usize) -> PyResult<Vec<Py<PyChoice>>> {
        let classes = &self.task.get().model.get().classes;
        self.chain(chain)?.fixed.iter().map(|choice| PyChoice::of(py, choice, classes)).collect()
    }

    /// Values of the continuous choices of a chain, (draws, numbers).
    fn values<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let chain = self.chain(chain)?;
        PyArray1::from_slice(py, &chain.numbers).reshape([chain.draws.len(), chain.width()])
    }

    /// Coordinates of the draws of a chain, (draws, dim).
    fn positions<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let draws = &self.chain(chain)?.draws;
        PyArray1::from_slice(py, &draws.x).reshape([draws.len(), draws.dim])
    }

    /// Statistics of each draw of a chain: ``log_density`` (over coordinates) and ``energy``, nats, ``acceptance_rate``, ``n_steps``,
    /// ``tree_depth``, and whether trajectories were ``diverging`` or ``refused_for_structure``.
    fn draws<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyDict>> {
        let (chain, facts) = (self.chain(chain)?, PyDict::new(py));
        let draws = &chain.draws;
        facts.set_item("log_density", PyArray1::from_slice(py, &draws.log_density))?;
        facts.set_item("energy", PyArray1::from_slice(py, &draws.energy))?;
        facts.set_item("acceptance_rate", PyArray1::from_slice(py, &draws.accept))?;
        facts.set_item("n_steps", PyArray1::from_slice(py, &draws.steps))?;
        facts.set_item("tree_depth", PyArray1::from_slice(py, &draws.depth))?;
        facts.set_item("diverging", PyArray1::from_slice(py, &draws.diverging))?;
        facts.set_item("refused_for_structure", PyArray1::from_slice(py, &draws.off_structure))?;
        Ok(facts)
    }

    /// Log densities of each draw of a chain, by a run of the model: of choices, and of factors and observations, nats.
    fn scores<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<(Reals<'py>, Reals<'py>)> {
        let (py_task, chain) = (self.task.get(), self.chain(chain)?);
        let scores = Pool::inside(py, || chain.scores(&py_task.task))?;
        let scores = scores.map_err(|failure| faults::ended(py, &failure, &py_task.task))?;
        let (prior, score): (Vec<f64>, Vec<f64>) = scores.into_iter().unzip();
        Ok((PyArray1::from_vec(py, prior), PyArray1::from_vec(py, score)))
    }

    /// Statistics of a chain: ``step_size``, ``gradients`` (with the warm-up) and ``divergences``: see [`broken_off`].
    fn counters<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyDict>> {
        let (draws, facts) = (&self.chain(chain)?.draws, PyDict::new(py));
        facts.set_item("step_size", draws.step_size)?;
        facts.set_item("gradients", draws.gradients + draws.warmup_gradients)?;
        facts.set_item("divergences", broken_off(py, &draws.broken)?)?;
        Ok(facts)
    }

    /// The fault of the first trajectory of a chain that reached a point without a finite gradient: an exception, or None.
    fn fault(&self, py: Python<'_>, chain: usize) -> PyResult<Option<PyErr>> {
        let program = &self.task.get().task.program;
        let fault = self.chain(chain)?.fault.clone();
        Ok(fault.map(|fault| faults::raise(py, &Failure::Run(fault), program)))
    }
}

impl PyTrajectories {
    fn chain(&self, chain: usize) -> PyResult<&Explored> {
        self.chains.get(chain).ok_or_else(|| PyIndexError::new_err("no such chain"))
    }
}

/// Counts of the trajectories that broke off after the warm-up, by the reason: a dict with ``energy``, ``structure``,
/// ``impossible`` and ``not_finite``.
pub fn broken_off<'py>(py: Python<'py>, broken: &BrokenOff) -> PyResult<Bound<'py, PyDict>> {
    let facts = PyDict::new(py);
    facts.set_item("energy", broken.drifted)?;
    facts.set_item("structure", broken.refused[Cause::Guard as usize])?;
    facts.set_item("impossible", broken.refused[Cause::Impossible as usize])?;
    facts.set_item("not_finite", broken.refused[Cause::NotFinite as usize])?;
    Ok(facts)
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyTrajectories>()
}
