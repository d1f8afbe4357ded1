//! Log densities with their gradients for Python.

use crate::faults;
use crate::shared::Shared;
use crate::values::Classes;
use niwaki_grad::{Continuous, Live, Refused, jax};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// A continuous choice of a sampler: its coordinates are `x[first : first + count]`.
#[pyclass(frozen, get_all, name = "Coordinates", module = "niwaki._engine")]
pub struct PyCoordinates {
    /// The readable address.
    name: String,
    /// The family of its distribution.
    family: &'static str,
    /// The transform from coordinates to its value: line, above, between, circle, simplex or vector.
    transform: &'static str,
    /// The first coordinate.
    first: usize,
    /// The number of coordinates.
    count: usize,
    /// The number of numbers in its value.
    width: usize,
    /// Whether its value is a list.
    is_vector: bool,
}

impl PyCoordinates {
    pub fn of(choice: &Continuous) -> PyCoordinates {
        PyCoordinates {
            name: choice.path.clone(),
            family: choice.family.name(),
            transform: choice.transform.name(),
            first: choice.first,
            count: choice.coordinates,
            width: choice.width(),
            is_vector: choice.transform.is_vector(),
        }
    }
}

/// The log density of a model around one run, over unconstrained coordinates.
#[pyclass(frozen, name = "Density", module = "niwaki._engine")]
pub struct PyDensity {
    live: Shared<Live>,
    task: Task,
    classes: Arc<Classes>,
}

impl PyDensity {
    pub fn new(live: Live, task: Task, classes: Arc<Classes>) -> PyDensity {
        PyDensity { live: Shared::new(live), task, classes }
    }

    fn with<T>(&self, py: Python<'_>, f: impl FnOnce(&mut Live) -> T) -> PyResult<T> {
        Ok(f(&mut *self.live.lock(py)?))
    }

    fn point<'a>(&self, py: Python<'_>, x: &'a PyReadonlyArray1<'_, f64>) -> PyResult<&'a [f64]> {
        let dim = self.dim(py)?;
        let wrong = |content: &str| {
            let fault =
                Fault::new("bad-setting", format!("`x` has {content}, but there are {dim} coordinates"))
                    .with_help(format!("give an array of shape ({dim},)"));
            faults::setting(py, &fault)
        };
        let point = x.as_slice().map_err(|_| wrong("gaps in memory"))?;
        if point.len() == dim { Ok(point) } else { Err(wrong(&format!("{} elements", point.len()))) }
    }
}

#[pymethods]
impl PyDensity {
    /// Number of coordinates.
    #[getter]
    fn dim(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |live| live.dim())
    }

    /// Coordinates of the recorded run, shape (dim,).
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, &self.with(py, |live| live.recorded().start.clone())?))
    }

    /// Continuous choices.
    #[getter]
    fn choices(&self, py: Python<'_>) -> PyResult<Vec<PyCoordinates>> {
        self.with(py, |live| live.recorded().choices.iter().map(PyCoordinates::of).collect())
    }

    /// Operations of (a value with its gradient, a gradient alone), and guards, of the path last used.
    #[getter]
    fn operations(&self, py: Python<'_>) -> PyResult<(usize, usize, usize)> {
        self.with(py, |live| {
            let density = &live.recorded().density;
            let (both, slope) = density.operations();
            (both, slope, density.guards().len())
        })
    }

    /// The number of recordings of the program.
    #[getter]
    fn recordings(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |live| live.recordings())
    }

    /// Primitives that the run emits; their scores are no part of the density.
    #[getter]
    fn emitted(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |live| live.recorded().emitted)
    }

    /// ``(log density, gradient)`` at ``x``; ``None`` if the run makes other choices there.
    fn value_and_gradient<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Option<(f64, Bound<'py, PyArray1<f64>>)>> {
        let point = self.point(py, &x)?;
        let mut g = vec![0.0; point.len()];
        match self.with(py, |live| live.value_and_gradient(point, &mut g))? {
            Ok(value) => Ok(Some((value, PyArray1::from_vec(py, g)))),
            Err(Refused::Structure | Refused::Rounding) => Ok(None),
            Err(Refused::Fault(fault)) => Err(faults::ended(py, &Failure::Run(fault), &self.task)),
        }
    }

    /// Values of the choices at ``x``, by path.
    fn values<'py>(&self, py: Python<'py>, x: PyReadonlyArray1<'py, f64>) -> PyResult<Bound<'py, PyDict>> {
        let point = self.point(py, &x)?;
        // The path of the point decides; a point without a path takes the path that was used last.
        let (recorded, values) = self.with(py, |live| {
            let values = live.values(point);
            let recorded = live.recorded().clone();
            let values = values.unwrap_or_else(|_| recorded.values(point));
            (recorded, values)
        })?;
        let values_by_path = PyDict::new(py);
        for choice in &recorded.choices {
            if let Some(value) = values.get(&choice.address) {
                values_by_path.set_item(&choice.path, self.classes.object(py, value)?)?;
            }
        }
        Ok(values_by_path)
    }

    /// Compiles machine code now instead of later; returns whether this machine supports it.
    fn compile(&self, py: Python<'_>) -> PyResult<bool> {
        let mut using = self.live.lock(py)?;
        let live: &mut Live = &mut using;
        Ok(py.detach(|| {
            live.compiled().finish();
            live.compiled().is_native()
        }))
    }

    /// The text of a JAX function ``log_density(x)``; NaN off the recorded path.
    fn jax(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |live| jax::source(&live.recorded().density))
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyCoordinates>()?;
    module.add_class::<PyDensity>()
}
