//! Shapes, targets and sketches for Python.
//!
//! Every error is a `ValueError` with an attribute `code` (such as `bad-shape`); Python's table
//! of messages has the text for each code.

use crate::values::Classes;
use crate::views::{PyDrawing, PyPicture};
use niwaki_geom::sketch::{BALANCED_DEVIATIONS, SKETCHES, SketchForm};
use niwaki_geom::solids::WORDS;
use niwaki_geom::{
    Ellipse, GeomError, Inputs, Operation, Primitive, Shape, SketchSpec, Sketches, Solid, Stroke, Target,
    TriMesh, Vec3,
};
use niwaki_math::Parameter;
use niwaki_vm::builtins::{builtin, builtin_id, placed_mesh};
use niwaki_vm::fault::Fault;
use niwaki_vm::value::Value;
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3, PyReadonlyArray2};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::Arc;

type Triple = [f64; 3];
/// A `ValueError` that carries its code.
pub fn value_error(py: Python<'_>, error: &GeomError) -> PyErr {
    let raised = PyValueError::new_err(error.message.clone());
    match raised.value(py).setattr("code", error.code) {
        Ok(()) => raised,
        Err(other) => other,
    }
}

/// A mesh from arrays, every entry checked.
pub fn mesh_from(
    vertices: &PyReadonlyArray2<f64>,
    faces: &PyReadonlyArray2<i64>,
) -> Result<TriMesh, GeomError> {
    let (vertices, faces) = (vertices.as_array(), faces.as_array());
    if vertices.is_empty() || faces.is_empty() {
        let message = format!(
            "a mesh needs a triangle, found {} vertices and {} faces",
            vertices.nrows(),
            faces.nrows()
        );
        return Err(GeomError::new("bad-shape", message));
    }
    for (array, columns) in [("vertices", vertices.ncols()), ("faces", faces.ncols())] {
        if columns != 3 {
            return Err(GeomError::new("bad-shape", format!("{array} have {columns} columns, expected 3")));
        }
    }
    let points = vertices.rows().into_iter().map(|r| Vec3::from([r[0], r[1], r[2]])).collect();
    let index = |i: &i64| u32::try_from(*i).ok().filter(|i| (*i as usize) < vertices.nrows());
    let mut triangles = Vec::with_capacity(faces.nrows());
    for (i, row) in faces.rows().into_iter().enumerate() {
        let corners: Option<Vec<u32>> = row.iter().map(index).collect();
        let Some([a, b, c]) = corners.as_deref() else {
            let (row, count) = (row.to_vec(), vertices.nrows());
            return Err(GeomError::new(
                "bad-shape",
                format!("face {i} is {row:?}, but there are {count} vertices"),
            ));
        };
        triangles.push([*a, *b, *c]);
    }
    TriMesh::new(points, triangles)
}

fn vertices_of<'py>(py: Python<'py>, mesh: &TriMesh) -> Bound<'py, PyArray2<f64>> {
    let points = mesh.vertices();
    Array2::from_shape_fn((points.len(), 3), |(i, a)| points[i][a]).into_pyarray(py)
}

fn faces_of<'py>(py: Python<'py>, mesh: &TriMesh) -> Bound<'py, PyArray2<i64>> {
    let faces = mesh.triangles();
    Array2::from_shape_fn((faces.len(), 3), |(i, k)| i64::from(faces[i][k])).into_pyarray(py)
}

/// Makes the shape of a ``word`` with arguments by position and by name, read as in a model. A mesh is given by
/// arrays.
#[pyfunction]
#[pyo3(signature = (word, /, *args, **named))]
fn shape(word: &str, args: &Bound<'_, PyTuple>, named: Option<&Bound<'_, PyDict>>) -> PyResult<PyShape> {
    let py = args.py();
    let described = WORDS.iter().find(|other| other.name == word);
    let described = described.ok_or_else(|| PyTypeError::new_err(format!("there is no shape `{word}`")))?;
    let mut arguments: Vec<Option<Bound<'_, PyAny>>> = args.iter().map(Some).collect();
    arguments.resize(arguments.len().max(described.counts().1), None);
    for (name, value) in named.into_iter().flatten() {
        let unknown = || PyTypeError::new_err(format!("`{word}` has no parameter {name}"));
        let is_it = |parameter: &Parameter| name.eq(parameter.name).unwrap_or(false);
        let at = described.parameters().position(is_it).ok_or_else(unknown)?;
        arguments[at] = Some(value);
    }
    let mut mesh = None;
    if let ("mesh", [vertices, faces, ..]) = (word, &mut arguments[..]) {
        let (vertices, faces) = (vertices.take(), faces.take());
        let missing = || PyTypeError::new_err("`mesh` needs vertices and faces");
        let (vertices, faces) = vertices.zip(faces).ok_or_else(missing)?;
        let read = mesh_from(&vertices.extract()?, &faces.extract()?);
        mesh = Some(Arc::new(read.map_err(|e| value_error(py, &e))?));
    }
    let classes = Classes::default();
    let value = |argument: &Option<Bound<'_, PyAny>>| {
        argument.as_ref().map_or(Ok(Value::None), |argument| classes.value(argument))
    };
    let values: Vec<Value> = arguments.iter().map(value).collect::<PyResult<_>>()?;
    let answer = match &mesh {
        Some(mesh) => placed_mesh(mesh, &values),
        None => builtin(builtin_id(word).expect("each word is a built-in function")).call(&values),
    };
    match answer.map_err(|fault| raised(py, &fault))? {
        Value::Shape(shape) => Ok(PyShape(shape)),
        other => Err(PyTypeError::new_err(format!("`{word}` makes {}", other.described()))),
    }
}

/// A fault of a built-in function as an exception.
fn raised(py: Python<'_>, fault: &Fault) -> PyErr {
    match fault.code {
        "type-mismatch" | "argument-count" => PyTypeError::new_err(fault.message.clone()),
        code => value_error(py, &GeomError::new(code, fault.message.clone())),
    }
}

/// Calls a built-in function of models by its ``name``.
#[pyfunction]
#[pyo3(signature = (name, /, *args))]
fn operation<'py>(name: &str, args: &Bound<'py, PyTuple>) -> PyResult<Bound<'py, PyAny>> {
    let (py, classes) = (args.py(), Classes::default());
    let id =
        builtin_id(name).ok_or_else(|| PyTypeError::new_err(format!("there is no operation `{name}`")))?;
    let values: Vec<Value> = args.iter().map(|argument| classes.value(&argument)).collect::<PyResult<_>>()?;
    classes.object(py, &builtin(id).call(&values).map_err(|fault| raised(py, &fault))?)
}

/// Measures of a flat shape for drawings.
#[derive(IntoPyObject)]
enum Flat {
    Stroke((Triple, f64), (Triple, f64)),
    Ellipse(Triple, f64, f64, f64),
}

/// Immutable placed solid with its look.
#[pyclass(frozen, eq, name = "Shape", module = "niwaki._engine", from_py_object)]
#[derive(Clone, PartialEq)]
pub struct PyShape(pub Shape);

#[pymethods]
impl PyShape {
    /// Its serialised form, JSON.
    fn data(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Reads a shape from the result of ``data``.
    #[staticmethod]
    fn of_data(data: &str) -> PyResult<PyShape> {
        let read: Result<Shape, _> = serde_json::from_str(data);
        read.map(PyShape).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The kind of its solid: ``box``, ``tapered-box``, ``cylinder``, ...
    #[getter]
    fn kind(&self) -> &'static str {
        self.0.kind()
    }

    /// The paint of a shape without colour: ``plain``, ``round`` or ``bark``.
    #[getter]
    fn tone(&self) -> &'static str {
        self.0.tone().name()
    }

    /// Linear colour in [0, 1], or None.
    #[getter]
    fn color(&self) -> Option<[f32; 3]> {
        self.0.color()
    }

    /// From 0 to 1, or None.
    #[getter]
    fn metalness(&self) -> Option<f32> {
        self.0.metalness()
    }

    /// From 0 to 1, or None.
    #[getter]
    fn roughness(&self) -> Option<f32> {
        self.0.roughness()
    }

    /// The name of the material, or None.
    #[getter]
    fn material(&self) -> Option<&str> {
        self.0.material()
    }

    /// Smallest and largest corner of the box around the coarse mesh, scene units.
    fn aabb(&self) -> (Triple, Triple) {
        (self.0.aabb().low.to_array(), self.0.aabb().high.to_array())
    }

    /// Measures of flat shapes: for a ``stroke`` the middle and the radius of each end, for an ``ellipse`` the middle, the lengths and the
    /// angle of the first (radians); None for other kinds.
    fn flat(&self) -> Option<Flat> {
        match self.0.solid() {
            Solid::Stroke(Stroke { ends }) => {
                let [a, b] = [ends[0], ends[1]];
                let at = |p: Vec3| self.0.placement().apply(p).to_array();
                Some(Flat::Stroke((at(a.center), a.radius), (at(b.center), b.radius)))
            }
            Solid::Ellipse(Ellipse { size }) => {
                let placement = self.0.placement();
                let axis = placement.rotation.columns[0];
                Some(Flat::Ellipse(placement.translation.to_array(), size[0], size[1], axis.y.atan2(axis.x)))
            }
            _ => None,
        }
    }

    /// The solids of a cut, in the world; of any other shape, itself.
    fn leaves(&self) -> Vec<PyShape> {
        self.0.leaves().iter().cloned().map(PyShape).collect()
    }

    /// The tree of a cut in postfix order: ``solid`` for the next of its solids, or an operator; empty for any other shape.
    fn steps(&self) -> Vec<&'static str> {
        self.0.cut().map_or_else(Vec::new, |cut| cut.steps().iter().map(|step| step.sign()).collect())
    }

    /// Shapes of one look each, which together look like this one.
    fn coats(&self) -> Vec<PyShape> {
        self.0.coats().into_iter().map(PyShape).collect()
    }

    /// The places among its ``leaves`` of the solids whose faces pictures show: all, or those of a coat.
    fn shown(&self) -> Vec<usize> {
        self.0.shown()
    }

    /// This solid without another.
    fn __sub__(&self, py: Python<'_>, other: &PyShape) -> PyResult<PyShape> {
        self.combined(py, Operation::Difference, other)
    }

    /// The part that two solids have in common.
    fn __and__(&self, py: Python<'_>, other: &PyShape) -> PyResult<PyShape> {
        self.combined(py, Operation::Intersection, other)
    }

    /// Two solids as one.
    fn __or__(&self, py: Python<'_>, other: &PyShape) -> PyResult<PyShape> {
        self.combined(py, Operation::Union, other)
    }

    /// Vertices of the coarse mesh, world space, (n, 3) float64.
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        vertices_of(py, &self.0.world_mesh())
    }

    /// Triangles of the coarse mesh, (m, 3) int64, counter-clockwise from outside.
    fn faces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<i64>> {
        faces_of(py, &self.0.world_mesh())
    }

    fn __repr__(&self) -> String {
        let center = self.0.aabb().center();
        format!("<{} at ({:.4}, {:.4}, {:.4})>", self.0.kind(), center.x, center.y, center.z)
    }
}

impl PyShape {
    fn combined(&self, py: Python<'_>, operation: Operation, other: &PyShape) -> PyResult<PyShape> {
        Shape::combined(operation, &self.0, &other.0).map(PyShape).map_err(|error| value_error(py, &error))
    }
}

/// A mesh to match, voxelised once.
#[pyclass(frozen, name = "Target", module = "niwaki._engine")]
pub struct PyTarget(pub Arc<Target>);

#[pymethods]
impl PyTarget {
    /// From ``vertices`` (n, 3) float64 and ``faces`` (m, 3) int64; ``voxel`` in scene units.
    #[new]
    fn new(
        py: Python<'_>,
        vertices: PyReadonlyArray2<f64>,
        faces: PyReadonlyArray2<i64>,
        voxel: f64,
    ) -> PyResult<PyTarget> {
        mesh_from(&vertices, &faces)
            .and_then(|mesh| Target::new(mesh, voxel))
            .map(|target| PyTarget(Arc::new(target)))
            .map_err(|e| value_error(py, &e))
    }

    /// Cells along x, y and z.
    #[getter]
    fn dims(&self) -> (usize, usize, usize) {
        self.0.grid().dims().into()
    }

    /// Number of filled cells.
    #[getter]
    fn filled(&self) -> usize {
        self.0.filled()
    }

    /// Smallest and largest corner of the gridded box, scene units.
    #[getter]
    fn domain(&self) -> (Triple, Triple) {
        let domain = self.0.grid().domain();
        (domain.low.to_array(), domain.high.to_array())
    }

    /// Number of triangles.
    #[getter]
    fn triangles(&self) -> usize {
        self.0.mesh().triangles().len()
    }

    /// Number of edges not shared by exactly two triangles: zero for a closed mesh.
    #[getter]
    fn open_edges(&self) -> usize {
        self.0.mesh().open_edges()
    }

    /// Vertices as given, (n, 3) float64.
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        vertices_of(py, self.0.mesh())
    }

    /// Triangles as given, (m, 3) int64.
    fn faces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<i64>> {
        faces_of(py, self.0.mesh())
    }

    /// The filled cells, (x, y, z) bool.
    fn cells<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<bool>> {
        Array3::from_shape_fn(self.0.grid().dims(), |(x, y, z)| self.0.contains([x, y, z])).into_pyarray(py)
    }

    /// The cells that a scene of ``shapes`` fills, (x, y, z) bool.
    fn mask<'py>(&self, py: Python<'py>, shapes: Vec<PyShape>) -> Bound<'py, PyArray3<bool>> {
        let shapes: Vec<Shape> = shapes.into_iter().map(|s| s.0).collect();
        let mut mask = Array3::from_elem(self.0.grid().dims(), false);
        py.detach(|| self.0.visit_filled(&shapes, |cell| mask[cell] = true));
        mask.into_pyarray(py)
    }
}

/// Description of a score, which makes the sketch of the empty scene.
#[pyclass(frozen, name = "SketchSpec", module = "niwaki._engine", from_py_object)]
#[derive(Clone)]
pub struct PySketchSpec(pub Arc<dyn SketchSpec>);

#[pymethods]
impl PySketchSpec {
    /// From its form, JSON, and the ``target``, ``picture`` or ``drawing`` that it needs.
    #[new]
    #[pyo3(signature = (form, target=None, picture=None, drawing=None))]
    fn new(
        py: Python<'_>,
        form: &str,
        target: Option<&PyTarget>,
        picture: Option<&PyPicture>,
        drawing: Option<&PyDrawing>,
    ) -> PyResult<PySketchSpec> {
        let form: Result<SketchForm, _> = serde_json::from_str(form);
        form.map_err(|error| GeomError::new("bad-setting", format!("no sketch can be read: {error}")))
            .and_then(|form| {
                form.spec(Inputs {
                    target: target.map(|handle| handle.0.clone()),
                    picture: picture.map(|handle| handle.0.clone()),
                    drawing: drawing.map(|handle| handle.0.clone()),
                })
            })
            .map(PySketchSpec)
            .map_err(|e| value_error(py, &e))
    }

    /// The name that messages use.
    #[getter]
    fn name(&self) -> &'static str {
        self.0.name()
    }
}

/// The score of a scene, updated as primitives are added and removed.
#[pyclass(name = "Sketch", module = "niwaki._engine")]
pub struct PySketch(Sketches);

fn primitive(shapes: Vec<PyShape>) -> Primitive {
    Primitive::new(shapes.into_iter().map(|s| s.0).collect::<Vec<Shape>>())
}

#[pymethods]
impl PySketch {
    /// The empty scene as ``specs`` see it, in order.
    #[new]
    fn new(specs: Vec<PySketchSpec>) -> PySketch {
        let specs: Vec<Arc<dyn SketchSpec>> = specs.into_iter().map(|s| s.0).collect();
        PySketch(Sketches::start(&specs))
    }

    /// Adds a primitive; returns the name of the sketch that forbids the scene, or None.
    fn add(&mut self, shapes: Vec<PyShape>) -> Option<&'static str> {
        self.0.add(&primitive(shapes))
    }

    /// Removes a primitive; a ``ValueError`` if the scene has no such primitive.
    fn remove(&mut self, py: Python<'_>, shapes: Vec<PyShape>) -> PyResult<()> {
        if self.0.remove(&primitive(shapes)) {
            return Ok(());
        }
        Err(value_error(py, &GeomError::new("bad-setting", "the scene has no such primitive")))
    }

    /// Sum of the log scores, nats.
    fn log_score(&self) -> f64 {
        self.0.log_score()
    }

    /// Share of cells, or of weighted pixels, equal in scene and target, of the first sketch that has one.
    fn similarity(&self) -> Option<f64> {
        self.0.measures().into_iter().find(|(name, _)| *name == "similarity").map(|(_, value)| value)
    }

    /// Named terms of the score; those of a second sketch with the same names are numbered.
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let measures = PyDict::new(py);
        for (name, value) in self.0.measures() {
            // Two sketches of one kind, such as a front and a side view: the second is numbered.
            let mut key = name.to_string();
            for number in 2.. {
                if !measures.contains(&key)? {
                    break;
                }
                key = format!("{name}_{number}");
            }
            measures.set_item(key, value)?;
        }
        Ok(measures)
    }

    /// Copies the sketch; both copies share their unchanged parts.
    fn fork(&self) -> PySketch {
        PySketch(self.0.fork())
    }
}

/// A parameter of a word for shapes: name, type, default (none for what must be
/// given) and what the manual says of it.
type Row = (&'static str, &'static str, Option<&'static str>, &'static str);

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyShape>()?;
    module.add_function(wrap_pyfunction!(shape, module)?)?;
    module.add_function(wrap_pyfunction!(operation, module)?)?;
    let words = PyDict::new(module.py());
    for word in WORDS {
        let parameters: Vec<Row> = word.parameters().map(Parameter::row).collect();
        words.set_item(word.name, (word.doc, parameters))?;
    }
    module.add("SHAPES", words)?;
    let sketches = PyDict::new(module.py());
    for (name, forbids) in SKETCHES {
        sketches.set_item(name, forbids.map(|texts| (texts.part, texts.cure)))?;
    }
    module.add("SKETCHES", sketches)?;
    module.add("BALANCED_DEVIATIONS", BALANCED_DEVIATIONS)?;
    module.add_class::<PyTarget>()?;
    module.add_class::<PySketchSpec>()?;
    module.add_class::<PySketch>()
}
