//! Shapes as Python holds them: made by the words of a model, read by pictures and files.

use niwaki_geom::{GeomError, Look, Mat3, Shape, TriMesh, Vec3, fine, vec3};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyArrayLike2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// `(vertices (n, 3), faces (m, 3), normals (n, 3))`.
type Arrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i64>>, Bound<'py, PyArray2<f64>>);

/// A placed solid: a box, a cylinder, a limb or a mesh. Never changes; equal when all of its measures are.
#[pyclass(name = "Shape", module = "niwaki._engine", frozen, eq, from_py_object)]
#[derive(Clone, PartialEq)]
pub struct PyShape(pub Shape);

/// An axis by its name or as a direction.
#[derive(FromPyObject)]
enum Axis {
    Name(String),
    Direction([f64; 3]),
}

impl Axis {
    fn direction(&self) -> PyResult<Vec3> {
        match self {
            Axis::Name(name) => Ok(Vec3::AXES[axis_number(name)?]),
            Axis::Direction(d) => Ok(point(*d)),
        }
    }
}

fn axis_number(name: &str) -> PyResult<usize> {
    ["x", "y", "z"]
        .iter()
        .position(|n| *n == name)
        .ok_or_else(|| PyValueError::new_err(format!("the axis is {name:?}, expected \"x\", \"y\" or \"z\"")))
}

fn point([x, y, z]: [f64; 3]) -> Vec3 {
    vec3(x, y, z)
}

fn look(rotation: Option<[[f64; 3]; 3]>, bevel: Option<f64>, color: Option<[f32; 3]>) -> Look {
    Look { rotation: rotation.map(Mat3::from_rows), bevel, color }
}

fn made(shape: Result<Shape, GeomError>) -> PyResult<PyShape> {
    shape.map(PyShape).map_err(|error| PyValueError::new_err(error.to_string()))
}

#[pymethods]
impl PyShape {
    /// A box around `center`; see `niwaki.words.box`.
    #[staticmethod]
    #[pyo3(name = "box", signature = (center, size, rotation=None, taper=1.0, taper_axis="z", bevel=None, color=None))]
    fn cuboid(
        center: [f64; 3],
        size: [f64; 3],
        rotation: Option<[[f64; 3]; 3]>,
        taper: f64,
        taper_axis: &str,
        bevel: Option<f64>,
        color: Option<[f32; 3]>,
    ) -> PyResult<PyShape> {
        let axis = axis_number(taper_axis)?;
        made(Shape::tapered_box(point(center), point(size), taper, axis, &look(rotation, bevel, color)))
    }

    /// A cylinder around `center`; see `niwaki.words.cylinder`.
    #[staticmethod]
    #[pyo3(signature = (center, radius, length, axis=Axis::Name("y".into()), top_radius=None, rotation=None, bevel=None,
                        color=None))]
    #[expect(clippy::too_many_arguments, reason = "the word's signature")]
    fn cylinder(
        center: [f64; 3],
        radius: f64,
        length: f64,
        axis: Axis,
        top_radius: Option<f64>,
        rotation: Option<[[f64; 3]; 3]>,
        bevel: Option<f64>,
        color: Option<[f32; 3]>,
    ) -> PyResult<PyShape> {
        let look = look(rotation, bevel, color);
        made(Shape::cylinder(point(center), radius, length, axis.direction()?, top_radius, &look))
    }

    /// A tapering segment between two rings; see `niwaki.words.limb`.
    #[staticmethod]
    #[pyo3(signature = (start, end, start_radius, end_radius, start_normal=None, end_normal=None, color=None))]
    fn limb(
        start: [f64; 3],
        end: [f64; 3],
        start_radius: f64,
        end_radius: f64,
        start_normal: Option<[f64; 3]>,
        end_normal: Option<[f64; 3]>,
        color: Option<[f32; 3]>,
    ) -> PyResult<PyShape> {
        let normals = (start_normal.map(point), end_normal.map(point));
        made(Shape::limb(
            point(start),
            point(end),
            (start_radius, end_radius),
            normals,
            &look(None, None, color),
        ))
    }

    /// A closed mesh of triangles; see `niwaki.words.mesh`.
    #[staticmethod]
    #[pyo3(signature = (vertices, faces, center=[0.0; 3], rotation=None, scale=1.0, color=None))]
    fn mesh(
        vertices: PyArrayLike2<'_, f64>,
        faces: PyArrayLike2<'_, i64>,
        center: [f64; 3],
        rotation: Option<[[f64; 3]; 3]>,
        scale: f64,
        color: Option<[f32; 3]>,
    ) -> PyResult<PyShape> {
        let (vertices, faces) = (vertices.as_array(), faces.as_array());
        if vertices.ncols() != 3 || faces.ncols() != 3 {
            return Err(PyValueError::new_err("vertices and faces must have three columns each"));
        }
        let points = vertices.rows().into_iter().map(|r| vec3(r[0], r[1], r[2])).collect();
        let index = |i: i64| u32::try_from(i).unwrap_or(u32::MAX);
        let triangles = faces.rows().into_iter().map(|r| [index(r[0]), index(r[1]), index(r[2])]).collect();
        let mesh =
            TriMesh::new(points, triangles).map_err(|error| PyValueError::new_err(error.to_string()))?;
        made(Shape::mesh(&Arc::new(mesh), point(center), scale, &look(rotation, None, color)))
    }

    /// `box`, `tapered-box`, `cylinder`, `tapered-cylinder`, `limb` or `mesh`.
    #[getter]
    fn kind(&self) -> &'static str {
        self.0.kind()
    }

    /// `(r, g, b)` in [0, 1] as the model gave it, or None.
    #[getter]
    fn color(&self) -> Option<(f32, f32, f32)> {
        self.0.color().map(|[r, g, b]| (r, g, b))
    }

    /// Low and high corner of the smallest box around the light geometry.
    #[getter]
    fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        let b = self.0.aabb();
        (b.low.to_array(), b.high.to_array())
    }

    /// The mesh that scores see: `(vertices (n, 3), faces (m, 3))`.
    fn light_mesh<'py>(&self, py: Python<'py>) -> (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i64>>) {
        let mesh = self.0.world_mesh();
        (points(py, mesh.vertices()), indices(py, mesh.triangles()))
    }

    /// The mesh of pictures and exports: `(vertices (n, 3), faces (m, 3), unit normals (n, 3))`.
    fn fine_mesh<'py>(&self, py: Python<'py>) -> Arrays<'py> {
        let mesh = fine::fine_mesh(&self.0);
        (points(py, &mesh.vertices), indices(py, &mesh.faces), points(py, &mesh.normals))
    }

    fn __repr__(&self) -> String {
        let [x, y, z] = self.0.aabb().extent().to_array();
        format!("<{} {x:.2} x {y:.2} x {z:.2}>", self.0.kind())
    }
}

fn points<'py>(py: Python<'py>, points: &[Vec3]) -> Bound<'py, PyArray2<f64>> {
    Array2::from_shape_fn((points.len(), 3), |(i, k)| points[i][k]).into_pyarray(py)
}

fn indices<'py>(py: Python<'py>, faces: &[[u32; 3]]) -> Bound<'py, PyArray2<i64>> {
    Array2::from_shape_fn((faces.len(), 3), |(i, k)| i64::from(faces[i][k])).into_pyarray(py)
}

/// Registers this room.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyShape>()
}
