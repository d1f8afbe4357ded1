//! Searches for the parameters of models that somebody else wrote: ask and tell, for Python.

use niwaki_fit::{Axis, Emulator, Evaluation, Point, Posterior, Proposer, Space};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The row of a point in the unit cube, and which parameters it uses.
type Row = (Vec<f64>, Vec<bool>);

/// Search for the parameters of a model by an emulator of what its geometry does.
#[pyclass(name = "Proposer", module = "niwaki._engine")]
pub struct PyProposer {
    proposer: Proposer,
    /// The search with all evaluations, and its emulator, until the next one is told.
    informed: Option<(Proposer, Emulator)>,
}

fn row_of(point: Point) -> Row {
    (point.row, point.used)
}

#[pymethods]
impl PyProposer {
    /// From a ``space``, JSON, and a ``seed``.
    #[new]
    fn new(space: &str, seed: u64) -> PyResult<PyProposer> {
        let axes: Vec<Axis> =
            serde_json::from_str(space).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let space = Space::new(axes).map_err(PyValueError::new_err)?;
        Ok(PyProposer { proposer: Proposer::new(space, seed), informed: None })
    }

    /// Puts the point at a ``row`` before all that are not asked for yet.
    fn suggest(&mut self, row: Vec<f64>) -> PyResult<()> {
        self.check(row.len())?;
        self.proposer.suggest(&row);
        Ok(())
    }

    /// The next point, or None if it depends on a point that is not told yet.
    fn ask(&mut self, py: Python<'_>) -> Option<Row> {
        let proposer = &mut self.proposer;
        py.detach(|| proposer.ask()).map(row_of)
    }

    /// Stores the score and the features of the first point that is not told yet; no features for a failure. ``used`` says
    /// which parameters it used.
    #[pyo3(signature = (score, features, used=None))]
    fn tell(
        &mut self,
        score: f64,
        features: Option<PyReadonlyArray1<'_, f32>>,
        used: Option<Vec<bool>>,
    ) -> PyResult<()> {
        if let Some(used) = &used {
            self.check(used.len())?;
        }
        let features = features.map(|features| features.as_array().iter().map(|x| f64::from(*x)).collect());
        self.informed = None;
        self.proposer.tell(Evaluation { score, features }, used.as_deref()).map_err(PyValueError::new_err)
    }

    /// Whether every point of the space was asked for.
    #[getter]
    fn exhausted(&self) -> bool {
        self.proposer.is_exhausted()
    }

    /// The canonical form of the point at a ``row``.
    fn snap(&self, row: Vec<f64>) -> PyResult<Row> {
        self.check(row.len())?;
        Ok(row_of(self.proposer.space().snap(&row)))
    }

    /// Length scales of each parameter: along its range, and between different levels.
    fn scales(&mut self) -> PyResult<(Vec<f64>, Vec<f64>)> {
        let scales = self.informed()?.1.scales();
        Ok((scales.along.clone(), scales.apart.clone()))
    }

    /// The variance of features along each direction, far from all evaluations.
    fn variances(&mut self) -> PyResult<Vec<f64>> {
        Ok(self.informed()?.1.variances().to_vec())
    }

    /// Predicted features of rows (n, parameters) along the directions, (n, directions), and the share of the variance that is
    /// left, (n,).
    #[expect(clippy::type_complexity, reason = "two arrays")]
    fn predict<'py>(
        &mut self,
        py: Python<'py>,
        rows: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>)> {
        self.check(rows.as_array().ncols())?;
        let rows: Vec<Vec<f64>> = rows.as_array().rows().into_iter().map(|row| row.to_vec()).collect();
        let emulator = &self.informed()?.1;
        let (mut means, mut left) = (Vec::with_capacity(rows.len()), vec![]);
        for row in &rows {
            let kernel = emulator.kernel(row);
            means.push(emulator.mean(&kernel));
            left.push(emulator.left(kernel));
        }
        let shape = (means.len(), emulator.directions());
        let means = Array2::from_shape_fn(shape, |(i, c)| means[i][c]);
        Ok((means.into_pyarray(py), PyArray1::from_vec(py, left)))
    }

    /// Rows of points that the evaluations leave possible, (n, parameters), and which parameters they use: for the goal, or
    /// for the scene of the evaluation ``about``.
    #[pyo3(signature = (power, seed, chains=40, steps=250, about=None))]
    #[expect(clippy::type_complexity, reason = "two arrays")]
    fn posterior<'py>(
        &mut self,
        py: Python<'py>,
        power: f64,
        seed: u64,
        chains: usize,
        steps: usize,
        about: Option<usize>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<bool>>)> {
        let (proposer, emulator) = self.informed()?;
        let settings = Posterior { power, chains, steps, seed };
        let points = py
            .detach(|| proposer.posterior(emulator.scales(), about, settings))
            .ok_or_else(|| PyValueError::new_err("too few scenes are told"))?;
        let shape = (points.len(), proposer.space().len());
        let rows = Array2::from_shape_fn(shape, |(i, axis)| points[i].row[axis]);
        let used = Array2::from_shape_fn(shape, |(i, axis)| points[i].used[axis]);
        Ok((rows.into_pyarray(py), used.into_pyarray(py)))
    }
}

impl PyProposer {
    fn check(&self, count: usize) -> PyResult<()> {
        let expected = self.proposer.space().len();
        match count == expected {
            true => Ok(()),
            false => Err(PyValueError::new_err(format!("{count} numbers, expected {expected}"))),
        }
    }

    /// The search with all evaluations, and its emulator.
    fn informed(&mut self) -> PyResult<&(Proposer, Emulator)> {
        if self.informed.is_none() {
            let proposer = self.proposer.informed();
            self.informed = proposer.emulator().map(|emulator| (proposer, emulator));
        }
        self.informed.as_ref().ok_or_else(|| PyValueError::new_err("fewer than two scenes are told"))
    }
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyProposer>()
}
