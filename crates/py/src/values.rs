//! Conversion of Python's objects to the machine's values, and back.
//!
//! | Python | machine |
//! | --- | --- |
//! | `None bool int float str` | the same; a whole number must fit 64 bits |
//! | `tuple list dict range` | the same; the keys of a dictionary are constants |
//! | a NumPy array, a NumPy scalar | nested tuples, a number: data to index |
//! | a frozen dataclass, a `NamedTuple` | a record of a class of the table |
//! | `niwaki.words`: `vec`, rotations, distributions | vectors, rotations, distributions |
//! | `Shape` | shapes |
//!
//! Both directions are guarded against nesting deeper than [`DEPTH`].

use crate::geometry::PyShape;
use niwaki_math::{Dist, Param};
use niwaki_vm::value::{Class, ClassKind, Dict, Range, Record, Value};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyRange, PyString, PyTuple, PyType};
use std::sync::{Arc, Mutex, PoisonError};

/// The deepest nesting of values that are converted.
const DEPTH: usize = 400;

/// Record classes that both sides know, by number.
#[derive(Default)]
pub struct Classes(Mutex<Vec<(Py<PyType>, Arc<Class>)>>);

impl Classes {
    /// The classes of a program, for Python and for the machine.
    pub fn new(types: Vec<Py<PyType>>, classes: &[Arc<Class>]) -> Classes {
        Classes(Mutex::new(types.into_iter().zip(classes.iter().cloned()).collect()))
    }

    fn known(&self, kind: &Bound<'_, PyType>) -> Option<Arc<Class>> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.iter().find(|(python_class, _)| python_class.is(kind)).map(|(_, class)| class.clone())
    }

    /// The machine's class for a type of records; a type that the program does not know is added.
    fn of(&self, kind: &Bound<'_, PyType>) -> PyResult<Option<Arc<Class>>> {
        if let Some(known) = self.known(kind) {
            return Ok(Some(known));
        }
        // Without the lock, as Python may switch to another thread in here.
        let (fields, record) = if kind.is_subclass_of::<PyTuple>()? && kind.hasattr("_fields")? {
            (kind.getattr("_fields")?.extract::<Vec<String>>()?, ClassKind::NamedTuple)
        } else if kind.hasattr("__dataclass_fields__")? {
            let fields = kind.getattr("__dataclass_fields__")?.cast_into::<PyDict>()?;
            (fields.keys().extract()?, ClassKind::Dataclass)
        } else {
            return Ok(None);
        };
        let name = kind.name()?.to_string();
        if let Some(known) = self.known(kind) {
            return Ok(Some(known));
        }
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let id = u32::try_from(known.len()).expect("fewer than 2^32 classes");
        let class = Arc::new(Class { id, name, fields, kind: record });
        known.push((kind.clone().unbind(), class.clone()));
        Ok(Some(class))
    }

    fn python<'py>(&self, py: Python<'py>, class: &Class) -> Option<Bound<'py, PyType>> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known
            .iter()
            .find(|(_, known_class)| known_class.id == class.id)
            .map(|(kind, _)| kind.bind(py).clone())
    }

    /// Converts a Python object to a value.
    pub fn value(&self, object: &Bound<'_, PyAny>) -> PyResult<Value> {
        self.value_at(object, 0)
    }

    fn value_at(&self, object: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
        if depth > DEPTH {
            return Err(PyTypeError::new_err(format!("a value nested deeper than {DEPTH}")));
        }
        let each = |items: Vec<Bound<'_, PyAny>>| {
            items.iter().map(|item| self.value_at(item, depth + 1)).collect::<PyResult<Vec<_>>>()
        };
        if object.is_none() {
            return Ok(Value::None);
        }
        if let Ok(b) = object.cast::<PyBool>() {
            return Ok(Value::Bool(b.is_true()));
        }
        if object.is_instance_of::<PyInt>() {
            let too_large = |_| PyOverflowError::new_err("a whole number that needs more than 64 bits");
            return object.extract().map(Value::Int).map_err(too_large);
        }
        if let Ok(x) = object.cast::<PyFloat>() {
            return Ok(Value::Real(x.value()));
        }
        if let Ok(text) = object.cast::<PyString>() {
            return Ok(Value::str(&text.to_cow()?));
        }
        if let Some(special) = word(object, &each)? {
            return Ok(special);
        }
        if let Some(class) = self.of(&object.get_type())? {
            let fields: Vec<_> =
                class.fields.iter().map(|f| object.getattr(f.as_str())).collect::<PyResult<_>>()?;
            return Ok(Value::Record(Arc::new(Record { class, fields: each(fields)? })));
        }
        if let Ok(tuple) = object.cast::<PyTuple>() {
            return Ok(Value::tuple(each(tuple.iter().collect())?));
        }
        if let Ok(list) = object.cast::<PyList>() {
            return Ok(Value::list(each(list.iter().collect())?));
        }
        if let Ok(dict) = object.cast::<PyDict>() {
            let (keys, values) = (each(dict.keys().iter().collect())?, each(dict.values().iter().collect())?);
            return Ok(Value::Dict(Arc::new(Dict::new(keys.into_iter().zip(values).collect()))));
        }
        if let Ok(range) = object.cast::<PyRange>() {
            let end = |name| range.getattr(name)?.extract::<i64>();
            let range = Range::new(end("start")?, end("stop")?, end("step")?);
            return range
                .map(|r| Value::Range(Arc::new(r)))
                .ok_or_else(|| PyTypeError::new_err("a range too long"));
        }
        if let Ok(shape) = object.cast::<PyShape>() {
            return Ok(Value::Shape(shape.get().0.clone()));
        }
        if object.hasattr("dtype")? && object.hasattr("tolist")? {
            return array(&object.call_method0("tolist")?);
        }
        let kind = object.get_type().name()?;
        Err(PyTypeError::new_err(format!("a value of type {kind}")))
    }

    /// Converts a value to a Python object.
    pub fn object<'py>(&self, py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
        self.object_at(py, value, 0)
    }

    fn object_at<'py>(&self, py: Python<'py>, value: &Value, depth: usize) -> PyResult<Bound<'py, PyAny>> {
        if depth > DEPTH {
            return Err(PyTypeError::new_err(format!("a value nested deeper than {DEPTH}")));
        }
        let inner = |value: &Value| self.object_at(py, value, depth + 1);
        Ok(match value {
            Value::None | Value::Unset | Value::Cell(_) => py.None().into_bound(py),
            Value::Bool(b) => PyBool::new(py, *b).to_owned().into_any(),
            Value::Int(n) => n.into_pyobject(py)?.into_any(),
            Value::Real(x) => PyFloat::new(py, *x).into_any(),
            Value::Str(text) => PyString::new(py, text).into_any(),
            Value::Tuple(tuple) => {
                let items: Vec<_> = tuple.items().iter().map(inner).collect::<PyResult<_>>()?;
                PyTuple::new(py, items)?.into_any()
            }
            Value::List(list) => {
                let items: Vec<_> = list.iter().map(inner).collect::<PyResult<_>>()?;
                PyList::new(py, items)?.into_any()
            }
            Value::Dict(dict) => {
                let object = PyDict::new(py);
                for (key, value) in dict.keys().iter().zip(dict.values()) {
                    object.set_item(inner(key)?, inner(value)?)?;
                }
                object.into_any()
            }
            Value::Record(record) => {
                let fields: Vec<_> = record.fields.iter().map(inner).collect::<PyResult<_>>()?;
                match self.python(py, &record.class) {
                    Some(kind) => kind.call1(PyTuple::new(py, fields)?)?,
                    None => PyTuple::new(py, fields)?.into_any(),
                }
            }
            Value::Range(r) => py.get_type::<PyRange>().call1((r.start, r.stop, r.step))?,
            Value::Vector(v) => {
                let parts = PyTuple::new(py, v.components())?;
                py.import("niwaki.words.vectors")?.getattr("Vec")?.call1((parts,))?
            }
            Value::Rotation(r) => {
                let rows = ((r[0], r[1], r[2]), (r[3], r[4], r[5]), (r[6], r[7], r[8]));
                py.import("niwaki.words.vectors")?.getattr("Rotation")?.call1((rows,))?
            }
            Value::Shape(shape) => Bound::new(py, PyShape(shape.clone()))?.into_any(),
            Value::Dist(dist) => distribution(py, dist)?,
            Value::Function(_) | Value::Future(_) | Value::Returned(_) => {
                Bound::new(py, Opaque(value.kind()))?.into_any()
            }
        })
    }
}

/// Value that Python only passes back: a function of a model.
#[pyclass(frozen, name = "Opaque", module = "niwaki._engine")]
pub struct Opaque(pub &'static str);

#[pymethods]
impl Opaque {
    fn __repr__(&self) -> String {
        format!("<{} of a model>", self.0)
    }
}

type Each<'a> = dyn Fn(Vec<Bound<'_, PyAny>>) -> PyResult<Vec<Value>> + 'a;

/// The words that are dataclasses in Python and have their own kind of value in the machine.
fn word(object: &Bound<'_, PyAny>, each: &Each<'_>) -> PyResult<Option<Value>> {
    let module = object.get_type().getattr("__module__")?;
    let module = module.extract::<String>().unwrap_or_default();
    if module == "niwaki.words.vectors" {
        if object.is_instance_of::<PyTuple>() {
            let rows: [[f64; 3]; 3] = object.extract()?;
            return Ok(Some(Value::Rotation(Arc::new(std::array::from_fn(|at| rows[at / 3][at % 3])))));
        }
        return Ok(Some(Value::vector(&object.getattr("parts")?.extract::<Vec<f64>>()?)));
    }
    if module == "niwaki.words.distributions" {
        let family = object.getattr("family")?.extract::<String>()?;
        let parameters: Vec<_> = object.getattr("parameters")?.try_iter()?.collect::<PyResult<_>>()?;
        let family = niwaki_math::Family::from_name(&family)
            .ok_or_else(|| PyTypeError::new_err(format!("a distribution called {family}")))?;
        let dist = niwaki_vm::builtins::make_dist(family, &each(parameters)?)
            .map_err(|fault| PyTypeError::new_err(fault.message.clone()))?;
        return Ok(Some(Value::Dist(Arc::new(dist))));
    }
    Ok(None)
}

/// An array's `tolist`: lists become tuples, because arrays are data.
fn array(object: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(list) = object.cast::<PyList>() {
        return Ok(Value::tuple(list.iter().map(|item| array(&item)).collect::<PyResult<_>>()?));
    }
    Classes::default().value(object)
}

/// Converts a distribution to a class of `niwaki.words`.
pub fn distribution<'py>(py: Python<'py>, dist: &Dist) -> PyResult<Bound<'py, PyAny>> {
    let row = |xs: &[f64]| PyTuple::new(py, xs).map(Bound::into_any);
    let part = |param: &Param| match param {
        Param::Bool(b) => Ok(b.into_pyobject(py)?.to_owned().into_any()),
        Param::Int(i) => Ok(i.into_pyobject(py)?.into_any()),
        Param::Real(x) => Ok(x.into_pyobject(py)?.into_any()),
        Param::Vector(xs) => row(xs),
        Param::Matrix(rows) => {
            let rows = rows.iter().map(|xs| row(xs)).collect::<PyResult<Vec<_>>>()?;
            Ok(PyTuple::new(py, rows)?.into_any())
        }
        Param::Dists(dists) => {
            let inner = dists.iter().map(|d| distribution(py, d)).collect::<PyResult<Vec<_>>>()?;
            Ok(PyTuple::new(py, inner)?.into_any())
        }
        Param::Draw(draw) => Classes::default().object(py, &draw.clone().into()),
    };
    let parts = dist.params().iter().map(part).collect::<PyResult<Vec<_>>>()?;
    let camel: String = dist.family().name().split('_').map(capital).collect();
    py.import("niwaki.words.distributions")?.getattr(camel.as_str())?.call1(PyTuple::new(py, parts)?)
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_ascii_uppercase().to_string() + letters.as_str()).unwrap_or_default()
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Opaque>()
}
