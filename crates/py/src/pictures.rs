//! Pictures and meshes of shapes. The interpreter's lock is released while meshes are made and rays are traced.

use crate::geometry::PyShape;
use crate::threads::Pool;
use niwaki_geom::fine::FineMesh;
use niwaki_geom::{FAR, Placement, Vec3};
use niwaki_render::{self as render, Backdrop, Camera, Shot, Surface, View};
use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Vertices<'py> = PyReadonlyArray2<'py, f64>;
type Corner = (f32, f32, f32);
type Eye = (Corner, Corner, Corner, f32);

type Painted = (PyShape, [f32; 3], [f32; 4]);
type Table<'py, T> = Bound<'py, PyArray2<T>>;
type Arrays<'py> =
    (Table<'py, f64>, Table<'py, u32>, Table<'py, f64>, (Bound<'py, PyArray1<f64>>, Table<'py, f64>));

/// Registers the functions of this file.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(render_meshes, module)?)?;
    module.add_function(wrap_pyfunction!(frame_camera, module)?)?;
    module.add("FAR", FAR)?;
    module.add_function(wrap_pyfunction!(meshes, module)?)?;
    module.add_class::<PySurfaces>()
}

/// Draws surfaces, and a ghost around them, as `(height, width, 4)` bytes.
#[pyfunction(name = "render")]
#[pyo3(signature = (surfaces, ghost=None, *, camera=None, width=640, height=480, samples=16, backdrop=None, floor=None,
                    ghost_color=None))]
#[expect(clippy::too_many_arguments, reason = "keyword settings of one picture")]
fn render_meshes<'py>(
    py: Python<'py>,
    surfaces: &PySurfaces,
    ghost: Option<&PySurfaces>,
    camera: Option<Eye>,
    width: usize,
    height: usize,
    samples: usize,
    backdrop: Option<([f32; 3], [f32; 3])>,
    floor: Option<f32>,
    ghost_color: Option<[f32; 3]>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let ghost = ghost.and_then(|ghost| ghost.0.first());
    let shot = Shot {
        width,
        height,
        samples,
        camera: camera.map(|(eye, target, up, fov_y)| Camera {
            eye: eye.into(),
            target: target.into(),
            up: up.into(),
            fov_y,
        }),
        floor,
        backdrop: backdrop.map_or(Backdrop::Clear, |(top, bottom)| Backdrop::Roll { top, bottom }),
        ghost_color: ghost_color.unwrap_or(Shot::default().ghost_color),
    };
    let bytes = Pool::inside(py, || render::render(&surfaces.0, ghost, &shot))?
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    bytes.into_pyarray(py).reshape([height, width, 4])
}

/// Fits a camera `(eye, target, up, fov_y)` tightly around all surfaces and `points` `(n, 3)`, seen from a side.
#[pyfunction]
#[pyo3(signature = (surfaces, points=None, *, azimuth=None, elevation=None, fov_y=None, margin=None, aspect=4.0 / 3.0))]
fn frame_camera(
    surfaces: &PySurfaces,
    points: Option<Vertices<'_>>,
    azimuth: Option<f32>,
    elevation: Option<f32>,
    fov_y: Option<f32>,
    margin: Option<f32>,
    aspect: f32,
) -> PyResult<Eye> {
    let usual = View::default();
    let view = View {
        azimuth: azimuth.unwrap_or(usual.azimuth),
        elevation: elevation.unwrap_or(usual.elevation),
        fov_y: fov_y.unwrap_or(usual.fov_y),
        margin: margin.unwrap_or(usual.margin),
    };
    let mut all: Vec<[f32; 3]> =
        surfaces.0.iter().flat_map(|surface| surface.vertices.iter().copied()).collect();
    if let Some(points) = &points {
        for row in points.as_array().rows() {
            let row: Result<[f64; 3], _> = row.to_vec().try_into();
            all.push(single(row.map_err(|_| PyValueError::new_err("points must be (n, 3)"))?.into()));
        }
    }
    let camera = Camera::framing(&all, view, aspect);
    Ok((camera.eye.into(), camera.target.into(), camera.up.into(), camera.fov_y))
}

/// The meshes of pictures and files (``fine``), or those that scores see, in the world: of each group of shapes one mesh
/// `(vertices (n, 3), faces (m, 3), unit normals (n, 3), frame)`. A light mesh has no normals. ``sharp`` leaves edges as they
/// are where a shape has no bevel of its own, as in a cut. The frame is that of the
/// group's first shape: its origin (3,), and its axes as columns (3, 3).
#[pyfunction]
#[pyo3(signature = (groups, *, fine=true, sharp=false))]
fn meshes(py: Python<'_>, groups: Vec<Vec<PyShape>>, fine: bool, sharp: bool) -> PyResult<Vec<Arrays<'_>>> {
    let mesh = |shape: &PyShape| match (fine, sharp) {
        (true, false) => shape.0.fine_mesh(),
        (true, true) => shape.0.sharp_mesh(),
        (false, _) => FineMesh::from(&*shape.0.world_mesh()),
    };
    let joined: Vec<FineMesh> =
        py.detach(|| groups.iter().map(|group| group.iter().map(mesh).collect()).collect());
    let array = |group: &[PyShape], mesh: FineMesh| {
        let frame = group.first().map_or(Placement::IDENTITY, |shape| shape.0.frame());
        let rows = [0, 1, 2].map(|i| frame.rotation.columns.map(|column| column[i]));
        let points = |points: Vec<Vec3>| table(py, points.into_iter().map(Vec3::to_array).collect());
        let frame = (PyArray1::from_slice(py, &frame.translation.to_array()), table(py, rows.to_vec())?);
        Ok((points(mesh.vertices)?, table(py, mesh.faces)?, points(mesh.normals)?, frame))
    };
    groups.iter().zip(joined).map(|(group, mesh)| array(group, mesh)).collect()
}

/// Copies rows of three as they are in memory.
fn table<T: Element>(py: Python<'_>, rows: Vec<[T; 3]>) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = rows.len();
    PyArray1::from_vec(py, rows.into_flattened()).reshape([count, 3])
}

/// Shapes with their paint, as pictures show them.
#[pyclass(frozen, name = "Surfaces", module = "niwaki._engine")]
struct PySurfaces(Vec<Surface>);

#[pymethods]
impl PySurfaces {
    /// Surfaces of `(shape, sRGB colour, (gloss, metal, rough, pitch))`.
    #[new]
    fn new(py: Python<'_>, painted: Vec<Painted>) -> PySurfaces {
        let surface = |(shape, color, [gloss, metal, rough, pitch]): Painted| {
            let FineMesh { vertices, normals, faces } = shape.0.fine_mesh();
            let [vertices, normals] = [vertices, normals].map(|all| all.into_iter().map(single).collect());
            Surface { vertices, faces, normals, color, gloss, metal, rough, pitch }
        };
        PySurfaces(py.detach(|| painted.into_iter().map(surface).collect()))
    }

    /// Number of triangles.
    #[getter]
    fn triangles(&self) -> usize {
        self.0.iter().map(|surface| surface.faces.len()).sum()
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounded to the precision of a picture")]
fn single(p: Vec3) -> [f32; 3] {
    p.to_array().map(|c| c as f32)
}
