//! Variational inference, for Python.

use crate::faults;
use crate::gradients::PyCoordinates;
use crate::runs::PyRun;
use crate::search::{PyTask, detached};
use crate::threads::Pool;
use niwaki_continuous::variational::Scale;
use niwaki_run::Failure;
use niwaki_search::direct::normals::{Approximated, approximate};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

type Reals<'py> = Bound<'py, PyArray1<f64>>;
type Table<'py> = Bound<'py, PyArray2<f64>>;

/// Normals near a task's distribution, each with draws from it.
#[pyclass(frozen, name = "Normals", module = "niwaki._engine")]
pub struct PyNormals {
    task: Py<PyTask>,
    normals: Vec<Approximated>,
    /// Whether the search was stopped before its end.
    #[pyo3(get)]
    interrupted: bool,
}

#[pymethods]
impl PyNormals {
    /// Finds the normals of a method, given as its text. ``start`` has values for the choices of their starts.
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
    ) -> PyResult<PyNormals> {
        let py_task = task.get();
        let known = start.map(PyRun::by_address);
        let method = py_task.read(py, method)?;
        let plan = (method.normals(seed, known.as_ref()))
            .ok_or_else(|| PyTypeError::new_err("this method finds no normals"))?;
        let caller = watch.as_ref().map(|callable| (callable, &py_task.model.get().classes));
        let (normals, pressed) = detached(py, &py_task.task, threads, caller, |watch| {
            approximate(&py_task.task, &plan, &|done| watch.look(done, 0, f64::NEG_INFINITY))
        })?;
        let interrupted = pressed || normals.iter().any(|normal| normal.interrupted);
        Ok(PyNormals { task, normals, interrupted })
    }

    /// The number of normals.
    #[getter]
    fn chains(&self) -> usize {
        self.normals.len()
    }

    /// Continuous choices of a normal.
    fn choices(&self, chain: usize) -> PyResult<Vec<PyCoordinates>> {
        Ok(self.normal(chain)?.choices().iter().map(PyCoordinates::of).collect())
    }

    /// Values of the choices of a normal's draws, (draws, numbers).
    fn values<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let normal = self.normal(chain)?;
        PyArray1::from_slice(py, &normal.numbers).reshape([normal.log_density.len(), normal.width()])
    }

    /// Coordinates of a normal's draws, (draws, dim).
    fn positions<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let normal = self.normal(chain)?;
        PyArray1::from_slice(py, &normal.x).reshape([normal.log_density.len(), normal.normal.dim()])
    }

    /// Log densities of each draw of a normal, over coordinates: under the model, under the normal, and under equal
    /// shares of all normals, nats.
    fn densities<'py>(
        &self,
        py: Python<'py>,
        chain: usize,
    ) -> PyResult<(Reals<'py>, Reals<'py>, Reals<'py>)> {
        let normal = self.normal(chain)?;
        let of = |logs: &[f64]| PyArray1::from_slice(py, logs);
        Ok((of(&normal.log_density), of(&normal.log_own), of(&normal.log_proposal)))
    }

    /// The standard normal numbers of a normal's draws, and the slopes of their log weights by these, both (draws, dim).
    fn slopes<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<(Table<'py>, Table<'py>)> {
        let normal = self.normal(chain)?;
        let shape = [normal.log_density.len(), normal.normal.dim()];
        let of = |numbers: &[f64]| PyArray1::from_slice(py, numbers).reshape(shape);
        Ok((of(&normal.z)?, of(&normal.slopes)?))
    }

    /// Log densities of each draw of a normal, by a run of the model: of choices, and of factors and observations, nats.
    fn scores<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<(Reals<'py>, Reals<'py>)> {
        let (py_task, normal) = (self.task.get(), self.normal(chain)?);
        let scores = Pool::inside(py, || normal.scores(&py_task.task))?;
        let scores = scores.map_err(|failure| faults::ended(py, &failure, &py_task.task))?;
        let (prior, score): (Vec<f64>, Vec<f64>) = scores.into_iter().unzip();
        Ok((PyArray1::from_vec(py, prior), PyArray1::from_vec(py, score)))
    }

    /// The mean of a normal, (dim,), and its variances, (dim,), or its covariance, (dim, dim).
    fn moments<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<(Reals<'py>, Bound<'py, PyAny>)> {
        let normal = &self.normal(chain)?.normal;
        let (mean, covariance) = (PyArray1::from_slice(py, &normal.mean), normal.covariance());
        let covariance = PyArray1::from_vec(py, covariance);
        let shaped = match normal.scale {
            Scale::Diagonal(_) => covariance.into_any(),
            _ => covariance.reshape([normal.dim(), normal.dim()])?.into_any(),
        };
        Ok((mean, shaped))
    }

    /// The estimates of the bound at each step of a normal, nats.
    fn bounds<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Reals<'py>> {
        Ok(PyArray1::from_slice(py, &self.normal(chain)?.bounds))
    }

    /// Statistics of a normal: ``impossible`` draws, whether it ``converged``, and the number of ``gradients``. The rest may be None: the
    /// ``best`` step of a path, the step at which an ascent ``broke`` off, and the ``path_bound`` of the normal from which
    /// an ascent started, with its standard error.
    fn counters<'py>(&self, py: Python<'py>, chain: usize) -> PyResult<Bound<'py, PyDict>> {
        let (normal, facts) = (self.normal(chain)?, PyDict::new(py));
        facts.set_item("impossible", normal.impossible)?;
        facts.set_item("converged", normal.converged)?;
        facts.set_item("gradients", normal.gradients)?;
        facts.set_item("best", normal.best)?;
        facts.set_item("broke", normal.broke.as_ref().map(|broke| broke.step))?;
        facts.set_item("path_bound", normal.path_bound)?;
        Ok(facts)
    }

    /// The fault at which an ascent broke off: an exception, or None.
    fn fault(&self, py: Python<'_>, chain: usize) -> PyResult<Option<PyErr>> {
        let program = &self.task.get().task.program;
        let fault = self.normal(chain)?.fault.clone();
        Ok(fault.map(|fault| faults::raise(py, &Failure::Run(fault), program)))
    }
}

impl PyNormals {
    fn normal(&self, chain: usize) -> PyResult<&Approximated> {
        self.normals.get(chain).ok_or_else(|| PyIndexError::new_err("no such normal"))
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyNormals>()
}
