//! Distributions for Python: densities, draws and supports, as plain functions of plain values.
//!
//! Parameters are numbers, truth values, lists, tuples or arrays of them, and for mixtures lists of
//! `(family, parameters)`. A parameter that a family cannot use raises `BadParameter`, which is a `ValueError`.

use niwaki_math::{self as math, Dist, Draw, Family, Interval, Param, Stream, Support};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString, PyTuple};

pyo3::create_exception!(
    _engine,
    BadParameter,
    PyValueError,
    "A parameter that a family cannot use.\n\n\
     Attributes: `family`, `parameter`, `found` (as a person would write it), `expected`."
);

/// The exception with the engine's fault.
pub fn bad_parameter(py: Python<'_>, bad: &math::BadParameter) -> PyErr {
    let error = BadParameter::new_err(bad.to_string());
    let attributes = [
        ("family", bad.family.name()),
        ("parameter", bad.parameter),
        ("found", bad.value.as_str()),
        ("expected", bad.expected),
    ];
    for (name, text) in attributes {
        if let Err(other) = error.value(py).setattr(name, text) {
            return other;
        }
    }
    error
}

/// Finds a family by its name.
fn named(family: &str) -> PyResult<Family> {
    Family::from_name(family)
        .ok_or_else(|| PyValueError::new_err(format!("there is no distribution `{family}`")))
}

/// Makes a distribution of a family with parameters.
pub fn dist(family: &str, params: &Bound<'_, PyAny>) -> PyResult<Dist> {
    let family = named(family)?;
    let read: Vec<Param> = params.try_iter()?.map(|p| param(&p?)).collect::<PyResult<_>>()?;
    Dist::new(family, &read).map_err(|bad| bad_parameter(params.py(), &bad))
}

/// Reads a truth value or a number, or the scalar of an array; `None` for anything else.
fn single(value: &Bound<'_, PyAny>) -> PyResult<Option<Draw>> {
    Ok(if value.is_instance_of::<PyBool>() {
        Some(Draw::Bool(value.extract()?))
    } else if value.is_instance_of::<PyInt>() {
        // Beyond 64 bits only the size matters.
        Some(value.extract().map(Draw::Int).or_else(|_| value.extract().map(Draw::Real))?)
    } else if value.is_instance_of::<PyFloat>() {
        Some(Draw::Real(value.extract()?))
    } else {
        None
    })
}

/// Converts an array or its scalar to lists and numbers; returns any other value unchanged.
fn plain<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if value.hasattr("tolist")? { value.call_method0("tolist") } else { Ok(value.clone()) }
}

fn not_understood(value: &Bound<'_, PyAny>) -> PyErr {
    let kind = value.get_type().name().map_or_else(|_| "value".into(), |name| name.to_string());
    PyTypeError::new_err(format!("a distribution cannot use a value of type {kind}"))
}

/// Reads a Python value as a parameter.
pub fn param(value: &Bound<'_, PyAny>) -> PyResult<Param> {
    let value = plain(value)?;
    if let Some(number) = single(&value)? {
        return Ok(match number {
            Draw::Bool(b) => Param::Bool(b),
            Draw::Int(i) => Param::Int(i),
            Draw::Real(x) => Param::Real(x),
            vector => Param::Draw(vector),
        });
    }
    let entries: Vec<Bound<'_, PyAny>> =
        value.try_iter().map_err(|_| not_understood(&value))?.collect::<PyResult<_>>()?;
    match entries.first() {
        Some(first) if is_dist(first) => {
            let component = |entry: &Bound<'_, PyAny>| -> PyResult<Dist> {
                let (family, params): (String, Bound<'_, PyAny>) = entry.extract()?;
                dist(&family, &params)
            };
            Ok(Param::Dists(entries.iter().map(component).collect::<PyResult<_>>()?))
        }
        Some(first) if single(&plain(first)?)?.is_none() => {
            Ok(Param::Matrix(entries.iter().map(row).collect::<PyResult<_>>()?))
        }
        _ => Ok(Param::Vector(row(&value)?)),
    }
}

/// Whether a value is `(family, parameters)`.
fn is_dist(value: &Bound<'_, PyAny>) -> bool {
    let name =
        |pair: &Bound<'_, PyTuple>| pair.get_item(0).is_ok_and(|first| first.is_instance_of::<PyString>());
    value.cast::<PyTuple>().is_ok_and(|pair| pair.len() == 2 && name(pair))
}

/// Reads a list of numbers.
fn row(value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let number = |entry: PyResult<Bound<'_, PyAny>>| {
        let entry = plain(&entry?)?;
        single(&entry)?.and_then(|d| d.as_real()).ok_or_else(|| not_understood(&entry))
    };
    if value.is_instance_of::<PyString>() {
        return Err(not_understood(value));
    }
    value.try_iter().map_err(|_| not_understood(value))?.map(number).collect()
}

/// Reads a Python value as a value of a distribution.
pub fn drawn(value: &Bound<'_, PyAny>) -> PyResult<Draw> {
    let value = plain(value)?;
    match single(&value)? {
        Some(draw) => Ok(draw),
        None => Ok(Draw::Vector(row(&value)?.into())),
    }
}

/// Converts a drawn value to a bool, int, float or a list of these.
pub fn to_python(py: Python<'_>, draw: &Draw) -> PyResult<Py<PyAny>> {
    Ok(match draw {
        Draw::Bool(b) => b.into_pyobject(py)?.to_owned().into_any().unbind(),
        Draw::Int(i) => i.into_pyobject(py)?.into_any().unbind(),
        Draw::Real(x) => x.into_pyobject(py)?.into_any().unbind(),
        Draw::Vector(v) => v.to_vec().into_pyobject(py)?.into_any().unbind(),
        Draw::Counts(v) => v.to_vec().into_pyobject(py)?.into_any().unbind(),
        Draw::Truths(v) => v.to_vec().into_pyobject(py)?.into_any().unbind(),
    })
}

/// Log density of `x`, nats; minus infinity outside the support.
#[pyfunction]
fn log_density(family: &str, params: &Bound<'_, PyAny>, x: &Bound<'_, PyAny>) -> PyResult<f64> {
    Ok(dist(family, params)?.log_density(&drawn(x)?))
}

/// `n` independent draws; draw k is the first one of stream k.
#[pyfunction]
fn draw(
    py: Python<'_>,
    family: &str,
    params: &Bound<'_, PyAny>,
    seed: u64,
    n: u64,
) -> PyResult<Vec<Py<PyAny>>> {
    let d = dist(family, params)?;
    (0..n).map(|k| to_python(py, &d.sample(&mut Stream::new(seed, k, 0, 0)))).collect()
}

/// The draw of one choice: a function of seed, stream, 128-bit address and visit.
#[pyfunction]
fn draw_at(
    py: Python<'_>,
    family: &str,
    params: &Bound<'_, PyAny>,
    seed: u64,
    stream: u64,
    address: u128,
    visit: u64,
) -> PyResult<Py<PyAny>> {
    to_python(py, &dist(family, params)?.sample(&mut Stream::new(seed, stream, address, visit)))
}

/// `(kind, lo, hi)`: kind is "bool", "int", "real", "simplex", "vector", "counts" or "truths".
///
/// Numbers have their ends (`None` for whole numbers without end); vectors their length twice.
#[pyfunction]
fn support(py: Python<'_>, family: &str, params: &Bound<'_, PyAny>) -> PyResult<Py<PyTuple>> {
    let inf = f64::INFINITY;
    let tuple = match dist(family, params)?.support().in_bounds() {
        Support::Booleans => ("bool", false, true).into_pyobject(py)?,
        Support::Integers { lo, hi } => ("int", lo, hi).into_pyobject(py)?,
        Support::Points { lo, hi } => ("real", lo, hi).into_pyobject(py)?,
        Support::Reals(Interval { lo, hi }) => {
            ("real", lo.unwrap_or(-inf), hi.unwrap_or(inf)).into_pyobject(py)?
        }
        Support::Simplex(n) => ("simplex", n, n).into_pyobject(py)?,
        Support::Vectors(n) | Support::VectorPoints(n) => ("vector", n, n).into_pyobject(py)?,
        Support::Counts(n) => ("counts", n, n).into_pyobject(py)?,
        Support::Truths(n) => ("truths", n, n).into_pyobject(py)?,
        Support::Categories(_) | Support::Circle => unreachable!("not in bounds"),
    };
    Ok(tuple.unbind())
}

/// The values of positive probability, or `None` for infinitely many.
#[pyfunction]
fn enumerate_support(
    py: Python<'_>,
    family: &str,
    params: &Bound<'_, PyAny>,
) -> PyResult<Option<Vec<Py<PyAny>>>> {
    match dist(family, params)?.enumerate() {
        Some(values) => values.iter().map(|v| to_python(py, v)).collect::<PyResult<_>>().map(Some),
        None => Ok(None),
    }
}

/// Documentation of a family for Python's classes and the manual: class, description, parameters (name, type, default or
/// none, description), space of values, description of a draw, and ranges of the parameters.
type Said = (&'static str, &'static str, Vec<Row>, String, &'static str, &'static str);

/// A parameter of a family.
type Row = (&'static str, &'static str, Option<&'static str>, &'static str);

/// Documentation of each family, by name.
fn manuals(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let all = PyDict::new(py);
    for &family in Family::ALL {
        let said = family.manual();
        let parameters = said.parameters.iter().map(math::Parameter::row);
        let space = format!("{:?}", family.space());
        let said: Said = (said.class, said.doc, parameters.collect(), space, said.gives, said.limits);
        all.set_item(family.name(), said)?;
    }
    Ok(all)
}

/// Registers the functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("FAMILIES", manuals(module.py())?)?;
    module.add("BadParameter", module.py().get_type::<BadParameter>())?;
    module.add_function(wrap_pyfunction!(log_density, module)?)?;
    module.add_function(wrap_pyfunction!(draw, module)?)?;
    module.add_function(wrap_pyfunction!(draw_at, module)?)?;
    module.add_function(wrap_pyfunction!(support, module)?)?;
    module.add_function(wrap_pyfunction!(enumerate_support, module)?)
}
