//! Cameras: position, the point that they look at, upward direction, and lens.
//!
//! Right-handed. A picture's rows run from its top, columns from its left; the ray of a pixel goes through the
//! pixel's middle. Widths follow from the picture's own proportions.

use super::rays::{Projection, Ray, Rays};
use crate::error::GeomError;
use crate::vector::Vec3;

/// The most pixels of a picture to match.
pub const MOST_PIXELS: usize = 1 << 24;

/// The lens of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Rays from one point.
    Perspective {
        /// Vertical field of view, radians, between 0 and pi.
        fov: f64,
        /// Distance along the view from which the camera sees, scene units.
        near: f64,
    },
    /// Parallel rays from the plane across the view through the camera's position.
    Orthographic {
        /// Height of the picture, scene units.
        height: f64,
    },
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    projection: Projection,
    lens: Lens,
}

impl Camera {
    /// A camera at `position` with `look_at` in the middle of its picture and `up` upwards.
    ///
    /// # Errors
    /// `bad-camera` when a number is not finite, `look_at` is the camera's position, `up` is the direction of view,
    /// or the lens sees nothing.
    pub fn new(position: Vec3, look_at: Vec3, up: Vec3, lens: Lens) -> Result<Camera, GeomError> {
        let bad = |message: String| GeomError::new("bad-camera", message);
        for (name, v) in [("position", position), ("look_at", look_at), ("up", up)] {
            if !v.is_finite() {
                return Err(bad(format!("{name} is {:?}, expected finite numbers", v.to_array())));
            }
        }
        let Some(forward) = (look_at - position).unit() else {
            return Err(bad(format!("its position is the point it looks at: {:?}", position.to_array())));
        };
        let across = up.unit().map(|up| forward.cross(up)).filter(|right| right.norm() > 1e-9);
        let Some(right) = across.and_then(Vec3::unit) else {
            let up = up.to_array();
            return Err(bad(format!("up is {up:?}, which is along the direction of view or has none")));
        };
        match lens {
            Lens::Perspective { fov, near } => {
                if !(fov > 0.0 && fov < std::f64::consts::PI) {
                    let degrees = fov.to_degrees();
                    return Err(bad(format!("its field of view is {degrees} degrees, expected 0 to 180")));
                }
                if !(near > 0.0 && near.is_finite()) {
                    return Err(bad(format!("near is {near}, expected a positive number")));
                }
            }
            Lens::Orthographic { height } => {
                if !(height > 0.0 && height.is_finite()) {
                    return Err(bad(format!("its height is {height}, expected a positive number")));
                }
            }
        }
        let perspective = matches!(lens, Lens::Perspective { .. });
        let up = right.cross(forward);
        let projection = Projection { origin: position, right, up, forward, perspective };
        Ok(Camera { projection, lens })
    }

    /// The projection of points of space to the picture's plane.
    pub fn projection(&self) -> &Projection {
        &self.projection
    }

    /// Depth at which rays begin, scene units.
    pub fn near(&self) -> f64 {
        match self.lens {
            Lens::Perspective { near, .. } => near,
            Lens::Orthographic { .. } => 0.0,
        }
    }

    /// The ray of each pixel of a picture of `size` (columns, rows), row by row.
    pub fn pixel_rays(&self, size: [usize; 2]) -> impl Iterator<Item = Ray> + '_ {
        let [columns, rows] = size.map(|n| n as f64);
        let half = match self.lens {
            Lens::Perspective { fov, .. } => (0.5 * fov).tan(),
            Lens::Orthographic { height } => 0.5 * height,
        };
        let near = self.near();
        (0..size[0] * size[1]).map(move |pixel| {
            let (column, row) = ((pixel % size[0]) as f64, (pixel / size[0]) as f64);
            let u = ((column + 0.5) / columns * 2.0 - 1.0) * half * (columns / rows);
            let v = (1.0 - (row + 0.5) / rows * 2.0) * half;
            Ray { at: [u, v], start: self.projection.point([u, v], near), pixel: pixel as u32 }
        })
    }

    /// The rays of a picture of `size` (columns, rows).
    pub fn rays(&self, size: [usize; 2]) -> Rays {
        Rays::new(self.projection, Some(self.near()), self.pixel_rays(size).collect())
    }
}

/// Refuses pictures without pixels or with too many.
///
/// # Errors
/// `bad-image`.
pub fn check_size(size: [usize; 2]) -> Result<(), GeomError> {
    let [columns, rows] = size;
    if columns == 0 || rows == 0 || columns.saturating_mul(rows) > MOST_PIXELS {
        let message = format!("a picture of {columns} x {rows} pixels, expected 1 to {MOST_PIXELS} of them");
        return Err(GeomError::new("bad-image", message));
    }
    Ok(())
}
