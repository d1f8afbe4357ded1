//! Networks of guides, for a comparison with other software: their bytes, their loss with its slope, and steps of the
//! optimiser, in `f64`.

use niwaki_guide::{Adam, Lesson, Net, NetForm, Rows, loss_and_slope, read, write};
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Deserialize;
use std::fmt::Display;

/// Choice as JSON.
#[derive(Deserialize)]
struct Row {
    site: usize,
    window: Vec<f32>,
    features: Vec<(u32, f32)>,
    lesson: Lesson,
}

/// Pair of lists of numbers.
type Pair<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

fn refused(reason: impl Display) -> PyErr {
    PyValueError::new_err(reason.to_string())
}

/// Makes a network before training, as bytes; `form` is JSON.
#[pyfunction]
fn guide_net<'py>(py: Python<'py>, form: &str, seed: u64) -> PyResult<Bound<'py, PyBytes>> {
    let form: NetForm = serde_json::from_str(form).map_err(refused)?;
    Ok(PyBytes::new(py, &write(&Net::start(form, seed), "")))
}

/// The mean loss of some choices (a JSON list), nats, and its derivative by each weight, in the order of the bytes.
#[pyfunction]
fn guide_slope<'py>(
    py: Python<'py>,
    net: &[u8],
    rows: &str,
    share: f64,
) -> PyResult<(f64, Bound<'py, PyArray1<f64>>)> {
    let (net, _) = read(net).map_err(refused)?;
    let examples: Vec<Row> = serde_json::from_str(rows).map_err(refused)?;
    let mut rows = Rows::new(net.form());
    for row in examples {
        rows.push(row.site, &row.window, &row.features, &row.lesson);
    }
    let (loss, slope) = loss_and_slope(&net.convert::<f64>(), &rows, share);
    Ok((loss, PyArray1::from_vec(py, slope)))
}

/// The weights after a step of the optimiser for each row of slopes, and the averaged weights.
#[pyfunction]
fn guide_steps<'py>(
    py: Python<'py>,
    weights: PyReadonlyArray1<'py, f64>,
    slopes: PyReadonlyArray2<'py, f64>,
    rate: f64,
    averaging: f64,
) -> PyResult<Pair<'py>> {
    let mut weights = weights.as_array().to_vec();
    let mut adam = Adam::new(weights.len());
    for slope in slopes.as_array().rows() {
        adam.advance(&mut weights, &slope.to_vec(), 1.0, rate, averaging);
    }
    let averaged = adam.averaged(averaging);
    Ok((PyArray1::from_vec(py, weights), PyArray1::from_vec(py, averaged)))
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(guide_net, module)?)?;
    module.add_function(wrap_pyfunction!(guide_slope, module)?)?;
    module.add_function(wrap_pyfunction!(guide_steps, module)?)?;
    Ok(())
}
