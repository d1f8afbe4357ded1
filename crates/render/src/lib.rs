//! Pictures: triangle meshes to RGBA bytes, by casting rays.
//!
//! A picture has four steps:
//!
//! 1. **trace** (`trace.rs`): each pixel keeps sums over its samples (`pixel.rs`), and pixels where the picture changes take
//!    more samples (`plate.rs`);
//! 2. **smooth** (`smooth.rs`): a filter removes the noise of sampled light;
//! 3. **develop** (`develop.rs`): light goes through a filmic curve, over the backdrop with its shadow, below the ghost;
//! 4. **bytes** (`tone.rs`).
//!
//! A pixel depends on its coordinates only, so the bits do not depend on the number of threads. Deliberately absent: images
//! on surfaces, transparency of parts, more than one bounce.
//!
//! - `shot.rs`    surfaces and settings of a picture
//! - `camera.rs`  cameras, and the view that frames a box
//! - `bvh.rs`     the nearest triangle
//! - `light.rs`   sun, sky, directions to sample
//! - `bump.rs`    roughness
//! - `tone.rs`    filmic curve, sRGB
//! - `v3.rs`      three `f32`

mod bump;
mod bvh;
mod camera;
mod develop;
mod light;
mod pixel;
mod plate;
mod shot;
mod smooth;
mod tone;
mod trace;
mod v3;

pub use camera::{Camera, View};
pub use shot::{Backdrop, Shot, Surface};

/// An error of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RenderError {
    /// Width, height or samples is zero, or more than `LARGEST`.
    Size {
        /// The name of the setting.
        name: &'static str,
        /// Its value.
        value: usize,
    },
    /// A vertex or normal is not finite, or a face has a vertex that does not exist.
    BadMesh {
        /// The number of the surface; `None` is the ghost.
        surface: Option<usize>,
        /// The reason.
        reason: String,
    },
    /// The camera is at its target, or a number in it is not finite.
    BadCamera,
}

impl std::fmt::Display for RenderError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RenderError::Size { name, value } => {
                write!(f, "{name} is {value}; it must be from 1 to {LARGEST}")
            }
            RenderError::BadMesh { surface: Some(k), reason } => write!(f, "mesh {k}: {reason}"),
            RenderError::BadMesh { surface: None, reason } => write!(f, "the ghost: {reason}"),
            RenderError::BadCamera => {
                write!(f, "the camera needs finite numbers and a target away from its eye")
            }
        }
    }
}

impl std::error::Error for RenderError {}

/// Largest width, height and number of samples.
pub const LARGEST: usize = 16_384;

/// Draws `surfaces` and, as a shell of tinted glass, `ghost`; returns `4 * width * height` bytes, rows from the top,
/// straight (not premultiplied) alpha.
///
/// ```
/// use niwaki_render::{render, Shot, Surface};
/// let triangle = Surface {
///     vertices: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]],
///     faces: vec![[0, 1, 2]],
///     color: [0.8, 0.3, 0.2],
///     ..Surface::default()
/// };
/// let shot = Shot { width: 32, height: 24, samples: 4, ..Shot::default() };
/// assert_eq!(render(&[triangle], None, &shot).unwrap().len(), 32 * 24 * 4);
/// ```
pub fn render(surfaces: &[Surface], ghost: Option<&Surface>, shot: &Shot) -> Result<Vec<u8>, RenderError> {
    for (name, value) in [("width", shot.width), ("height", shot.height), ("samples", shot.samples)] {
        if value == 0 || value > LARGEST {
            return Err(RenderError::Size { name, value });
        }
    }
    for (k, surface) in surfaces.iter().enumerate() {
        check(surface).map_err(|reason| RenderError::BadMesh { surface: Some(k), reason })?;
    }
    if let Some(ghost) = ghost {
        check(ghost).map_err(|reason| RenderError::BadMesh { surface: None, reason })?;
    }
    let stage = trace::Stage::new(surfaces, ghost, shot).ok_or(RenderError::BadCamera)?;
    let plate = plate::Plate::trace(&stage, shot.height);
    Ok(develop::develop(&stage, &plate, shot))
}

fn check(surface: &Surface) -> Result<(), String> {
    let finite = |v: &[f32; 3]| v.iter().all(|c| c.is_finite());
    let (vertices, faces, normals) = (surface.vertices.len(), surface.faces.len(), surface.normals.len());
    if let Some(k) = surface.vertices.iter().position(|v| !finite(v)) {
        return Err(format!("vertex {k} is not finite"));
    }
    if let Some(k) = surface.faces.iter().position(|f| f.iter().any(|&i| i as usize >= vertices)) {
        return Err(format!("face {k} names a vertex beyond the last of {vertices}"));
    }
    if ![0, vertices, faces].contains(&normals) {
        return Err(format!("{normals} normals for {vertices} vertices and {faces} faces"));
    }
    if let Some(k) = surface.normals.iter().position(|v| !finite(v)) {
        return Err(format!("normal {k} is not finite"));
    }
    if !finite(&surface.color) || !(surface.gloss + surface.metal + surface.rough + surface.pitch).is_finite()
    {
        return Err("its colour, gloss, roughness or pitch is not finite".into());
    }
    Ok(())
}
