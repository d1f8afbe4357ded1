//! Positions of shapes, with their derivatives, for Python.

use crate::faults;
use crate::model::PyProgram;
use niwaki_grad::Positions;
use niwaki_propose::gradient::positions::{Lifted, Placer};
use niwaki_run::Task;
use niwaki_vm::value::Value;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Task whose shapes are placed, around one run.
#[pyclass(frozen, name = "Placer", module = "niwaki._engine")]
pub struct PyPlacer {
    placer: Placer,
    choices: HashMap<u128, Value>,
    task: Task,
    model: Py<PyProgram>,
}

impl PyPlacer {
    pub fn new(placer: Placer, choices: HashMap<u128, Value>, task: Task, model: Py<PyProgram>) -> PyPlacer {
        PyPlacer { placer, choices, task, model }
    }
}

#[pymethods]
impl PyPlacer {
    /// Positions of shapes for ``values`` of choices by address; other choices have the values of the run. Real choices
    /// among ``free`` may move, and the numbers of ``arguments`` and ``constants``, by their places, which come first.
    #[pyo3(signature = (values, free, arguments=BTreeMap::new(), constants=BTreeMap::new()))]
    fn positions(
        &self,
        py: Python<'_>,
        values: HashMap<u128, f64>,
        free: HashSet<u128>,
        arguments: BTreeMap<usize, f64>,
        constants: BTreeMap<usize, f64>,
    ) -> PyResult<PyPositions> {
        let mut choices = self.choices.clone();
        choices.extend(values.into_iter().map(|(address, x)| (address, Value::Real(x))));
        let model = self.model.get();
        let compile = |places: &[(usize, niwaki_grad::Var)]| model.recorded(places);
        let lifted = Lifted {
            compile: if constants.is_empty() { None } else { Some(&compile) },
            arguments: arguments.into_iter().collect(),
            constants: constants.into_iter().collect(),
        };
        // A host function takes the interpreter's lock.
        let positions = py.detach(|| self.placer.positions(&choices, &free, &lifted));
        let positions = positions.map_err(|failure| faults::ended(py, &failure, &self.task))?;
        Ok(PyPositions { positions })
    }
}

/// Places of the shapes of a run, as functions of the movable numbers.
#[pyclass(frozen, name = "Positions", module = "niwaki._engine")]
pub struct PyPositions {
    positions: Positions,
}

impl PyPositions {
    fn check(&self, part: usize, shape: usize) -> PyResult<()> {
        let there = self.positions.parts.get(part).is_some_and(|(_, shapes)| shape < shapes.len());
        if there {
            Ok(())
        } else {
            Err(PyIndexError::new_err(format!("there is no shape {shape} of part {part}")))
        }
    }
}

#[pymethods]
impl PyPositions {
    /// The movable numbers: (address, readable address, is an angle); for an argument or a constant its place, and no address.
    #[getter]
    fn movables(&self) -> Vec<(u128, String, bool)> {
        self.positions
            .movables
            .iter()
            .map(|movable| (movable.address, movable.path.clone(), movable.is_angle))
            .collect()
    }

    /// Value, lower and upper bound, and usual variation of each movable number; shape (n, 4).
    fn ranges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let all = &self.positions.movables;
        let numbers: Vec<f64> = all
            .iter()
            .flat_map(|movable| [movable.value, movable.low, movable.high, movable.spread])
            .collect();
        PyArray1::from_vec(py, numbers).reshape([all.len(), 4])
    }

    /// The values, by address, of choices that keep their places in distributions that arguments or constants change, where
    /// the movable numbers have the values ``x``.
    fn followed(&self, py: Python<'_>, x: Vec<f64>) -> PyResult<HashMap<u128, f64>> {
        if x.len() != self.positions.movables.len() {
            return Err(PyIndexError::new_err(format!(
                "{} numbers for {}",
                x.len(),
                self.positions.movables.len()
            )));
        }
        Ok(py.detach(|| self.positions.followed(&x)))
    }

    /// The parts of the scene: their readable addresses, and the number of their shapes.
    #[getter]
    fn parts(&self) -> Vec<(String, usize)> {
        self.positions.parts.iter().map(|(path, shapes)| (path.clone(), shapes.len())).collect()
    }

    /// The middle of a shape and its three directions, scene units, shape (4, 3); None if nothing moves the shape.
    fn frame<'py>(
        &self,
        py: Python<'py>,
        part: usize,
        shape: usize,
    ) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        self.check(part, shape)?;
        let frame = self.positions.frame(part, shape);
        frame.map(|numbers| PyArray1::from_vec(py, numbers).reshape([4, 3])).transpose()
    }

    /// The derivatives of ``middle + shares @ directions`` by the movable numbers, shape (3, n); None as for ``frame``.
    fn slopes<'py>(
        &self,
        py: Python<'py>,
        part: usize,
        shape: usize,
        shares: [f64; 3],
    ) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        self.check(part, shape)?;
        let slopes = py.detach(|| self.positions.slopes(part, shape, shares));
        let n = self.positions.movables.len();
        slopes.map(|numbers| PyArray1::from_vec(py, numbers).reshape([3, n])).transpose()
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPlacer>()?;
    module.add_class::<PyPositions>()
}
