//! Pictures: meshes in, pixels out.
//!
//! Arrays are copied, and the interpreter's lock is released while rays are traced.

use crate::geometry::PyShape;
use crate::threads::Pool;
use niwaki_geom::Vec3;
use niwaki_render::{self as render, Backdrop, Camera, Shot, Surface, View};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Vertices<'py> = PyReadonlyArray2<'py, f64>;
type Faces<'py> = PyReadonlyArray2<'py, i64>;
type Mesh<'py> = (Vertices<'py>, Faces<'py>, Option<Vertices<'py>>, [f32; 3], [f32; 4]);
type Corner = (f32, f32, f32);
type Eye = (Corner, Corner, Corner, f32);

/// `(vertices (n, 3), faces (m, 3), normals (n, 3))`.
type Arrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i64>>, Bound<'py, PyArray2<f64>>);

/// Registers this part.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(render_meshes, module)?)?;
    module.add_function(wrap_pyfunction!(frame_camera, module)?)?;
    module.add_function(wrap_pyfunction!(fine_mesh, module)?)?;
    Ok(())
}

/// Draws meshes `(vertices (n, 3), faces (m, 3), normals or None, sRGB colour, (gloss, metal, rough, pitch))` as `(height, width, 4)` bytes.
#[pyfunction(name = "render")]
#[pyo3(signature = (meshes, ghost=None, *, camera=None, width=640, height=480, samples=16, backdrop=None, floor=None,
                    ghost_color=None))]
#[expect(clippy::too_many_arguments, reason = "keyword settings of one picture")]
fn render_meshes<'py>(
    py: Python<'py>,
    meshes: Vec<Mesh<'py>>,
    ghost: Option<Mesh<'py>>,
    camera: Option<Eye>,
    width: usize,
    height: usize,
    samples: usize,
    backdrop: Option<([f32; 3], [f32; 3])>,
    floor: Option<f32>,
    ghost_color: Option<[f32; 3]>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let surfaces = meshes.iter().map(surface).collect::<PyResult<Vec<_>>>()?;
    let ghost = ghost.as_ref().map(surface).transpose()?;
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
    let bytes = Pool::inside(py, || render::render(&surfaces, ghost.as_ref(), &shot))?
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    bytes.into_pyarray(py).reshape([height, width, 4])
}

/// The camera `(eye, target, up, fov_y)` that shows all `points` `(n, 3)` from a side, tightly.
#[pyfunction]
#[pyo3(signature = (points, *, azimuth=None, elevation=None, fov_y=None, margin=None, aspect=4.0 / 3.0))]
fn frame_camera(
    points: Vertices<'_>,
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
    let camera = Camera::framing(&triples(&points, "points")?, view, aspect);
    Ok((camera.eye.into(), camera.target.into(), camera.up.into(), camera.fov_y))
}

/// The mesh of pictures and exports: `(vertices (n, 3), faces (m, 3), unit normals (n, 3))`, world space.
#[pyfunction]
fn fine_mesh<'py>(py: Python<'py>, shape: &PyShape) -> Arrays<'py> {
    let mesh = py.detach(|| shape.0.fine_mesh());
    let points = |p: &[Vec3]| Array2::from_shape_fn((p.len(), 3), |(i, k)| p[i][k]).into_pyarray(py);
    let faces = Array2::from_shape_fn((mesh.faces.len(), 3), |(i, k)| i64::from(mesh.faces[i][k]));
    (points(&mesh.vertices), faces.into_pyarray(py), points(&mesh.normals))
}

fn surface((vertices, faces, normals, color, [gloss, metal, rough, pitch]): &Mesh<'_>) -> PyResult<Surface> {
    let count = faces.as_array().nrows();
    let mut corners = Vec::with_capacity(count);
    for face in faces.as_array().rows() {
        let index = |k: usize| face.get(k).and_then(|&i| u32::try_from(i).ok());
        match (face.len(), index(0), index(1), index(2)) {
            (3, Some(a), Some(b), Some(c)) => corners.push([a, b, c]),
            _ => return Err(PyValueError::new_err("faces must be (m, 3) and hold no negative number")),
        }
    }
    Ok(Surface {
        vertices: triples(vertices, "vertices")?,
        faces: corners,
        normals: normals.as_ref().map_or(Ok(Vec::new()), |n| triples(n, "normals"))?,
        color: *color,
        gloss: *gloss,
        metal: *metal,
        rough: *rough,
        pitch: *pitch,
    })
}

#[expect(clippy::cast_possible_truncation, reason = "rounded to the precision of a mesh")]
fn triples(array: &Vertices<'_>, name: &str) -> PyResult<Vec<[f32; 3]>> {
    let array = array.as_array();
    if array.ncols() != 3 {
        return Err(PyValueError::new_err(format!("{name} must be (n, 3), not (n, {})", array.ncols())));
    }
    Ok(array.rows().into_iter().map(|row| [row[0] as f32, row[1] as f32, row[2] as f32]).collect())
}
