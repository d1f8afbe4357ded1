//! Images to match, for Python.
//!
//! Every error is a `ValueError` with an attribute `code`, as in `geometry`.

use crate::geometry::{PyShape, mesh_from, value_error};
use niwaki_geom::view::{Camera, Lens, Light, shadow_rays};
use niwaki_geom::{Drawing, GeomError, Page, Picture, Primitive, Shape, TargetPicture, Vec3};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use std::sync::Arc;

type Triple = [f64; 3];
type Mesh<'py> = (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, i64>);

/// Position, look_at, up, perspective or not, field of view in radians or height, near.
type Eye = (Triple, Triple, Triple, bool, f64, f64);

fn camera((position, look_at, up, perspective, number, near): Eye) -> Result<Camera, GeomError> {
    let lens = match perspective {
        true => Lens::Perspective { fov: number, near },
        false => Lens::Orthographic { height: number },
    };
    Camera::new(position.into(), look_at.into(), up.into(), lens)
}

/// Image to match, with the rays that decide which pixels of a scene are on.
#[pyclass(frozen, name = "Picture", module = "niwaki._engine")]
pub struct PyPicture(pub Arc<Picture>);

#[pymethods]
impl PyPicture {
    /// ``on`` (rows, columns) bool and ``greys`` (rows, columns) uint8, seen by ``camera``: silhouettes, or with a
    /// ``receiver`` (vertices, faces) and the direction of a ``light`` the shadows on it.
    #[new]
    #[pyo3(signature = (camera, on, greys=None, multiplier=10.0, receiver=None, light=None))]
    fn new(
        py: Python<'_>,
        camera: Eye,
        on: PyReadonlyArray2<'_, bool>,
        greys: Option<PyReadonlyArray2<'_, u8>>,
        multiplier: f64,
        receiver: Option<Mesh<'_>>,
        light: Option<Triple>,
    ) -> PyResult<PyPicture> {
        let on = on.as_array();
        let target = TargetPicture {
            size: [on.ncols(), on.nrows()],
            on: on.iter().copied().collect(),
            greys: greys.map(|greys| greys.as_array().iter().copied().collect()),
            multiplier,
        };
        let receiver = receiver.map(|(vertices, faces)| mesh_from(&vertices, &faces)).transpose();
        py.detach(|| {
            let camera = self::camera(camera)?;
            niwaki_geom::view::camera::check_size(target.size)?;
            let rays = match receiver? {
                Some(mesh) => {
                    let light = Light::new(Vec3::from(light.unwrap_or([0.0, -1.0, 0.0])))?;
                    shadow_rays(&mesh, &camera, &light, target.size)?
                }
                None => camera.rays(target.size),
            };
            Picture::new(&target, rays)
        })
        .map(|picture| PyPicture(Arc::new(picture)))
        .map_err(|e| value_error(py, &e))
    }

    /// Columns and rows.
    #[getter]
    fn size(&self) -> (usize, usize) {
        self.0.size().into()
    }

    /// Share of the weight that should be on.
    #[getter]
    fn on_fraction(&self) -> f64 {
        self.0.on_fraction()
    }

    /// The pixels that are on in a scene of ``shapes``, (rows, columns) bool.
    fn mask<'py>(&self, py: Python<'py>, shapes: Vec<PyShape>) -> Bound<'py, PyArray2<bool>> {
        let shapes: Vec<Shape> = shapes.into_iter().map(|s| s.0).collect();
        let mask = py.detach(|| self.0.mask(&[Primitive::new(shapes)]));
        self.array(py, &mask)
    }

    /// The pixels that can be on, (rows, columns) bool: for shadows, those that see the receiver.
    fn seen<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<bool>> {
        let mut seen = vec![false; self.0.size()[0] * self.0.size()[1]];
        self.0.rays().pixels().iter().for_each(|pixel| seen[*pixel as usize] = true);
        self.array(py, &seen)
    }
}

impl PyPicture {
    fn array<'py>(&self, py: Python<'py>, pixels: &[bool]) -> Bound<'py, PyArray2<bool>> {
        array(py, self.0.size(), pixels)
    }
}

fn array<'py>(py: Python<'py>, [columns, rows]: [usize; 2], pixels: &[bool]) -> Bound<'py, PyArray2<bool>> {
    Array2::from_shape_fn((rows, columns), |(row, column)| pixels[row * columns + column]).into_pyarray(py)
}

/// A picture to draw, and the window of the plane that it shows.
#[pyclass(frozen, name = "Drawing", module = "niwaki._engine")]
pub struct PyDrawing(pub Arc<Drawing>);

#[pymethods]
impl PyDrawing {
    /// ``greys`` (rows, columns) uint8, filled where they are not 255, and the corners ``low`` and ``high`` of the
    /// window.
    #[new]
    fn new(
        py: Python<'_>,
        greys: PyReadonlyArray2<'_, u8>,
        low: [f64; 2],
        high: [f64; 2],
    ) -> PyResult<PyDrawing> {
        let greys = greys.as_array();
        let values: Vec<u8> = greys.iter().copied().collect();
        Page::new(low, high, [greys.ncols(), greys.nrows()])
            .and_then(|page| Drawing::new(page, &values))
            .map(|drawing| PyDrawing(Arc::new(drawing)))
            .map_err(|e| value_error(py, &e))
    }

    /// Columns and rows.
    #[getter]
    fn size(&self) -> (usize, usize) {
        self.0.page().size().into()
    }

    /// The pixels that a scene of ``shapes`` touches, (rows, columns) bool.
    fn mask<'py>(&self, py: Python<'py>, shapes: Vec<PyShape>) -> Bound<'py, PyArray2<bool>> {
        let shapes: Vec<Shape> = shapes.into_iter().map(|s| s.0).collect();
        let mask = py.detach(|| self.0.mask(&[Primitive::new(shapes)]));
        array(py, self.0.page().size(), &mask)
    }
}

/// Registers the classes and functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPicture>()?;
    module.add_class::<PyDrawing>()
}
