//! Windows: the view of a sketch around a place, as a short list of numbers.
//!
//! A guide looks at a scene through windows: points around the place where the model works. Near points are close together
//! and small, far points apart and large. Points are in the frame of the place, so that a turn of a scene with its target
//! changes no number. Every point shows two numbers of the *cell* around it, a square (a cube in space)
//! along the axes of the target:
//!
//! ```text
//! uncovered target   share of the cell that the target has and the scene does not have yet       0 to 1
//! uncovered empty    share of the cell that neither has,  plus 2 times the share outside of the domain      0 to 2
//! ```
//!
//! The outside counts as empty twice, to distinguish it from empty cells inside. Covered cells add to neither number. A
//! sketch without a target documents its numbers.
//!
//! - `flat`: cells of a page, from words of bits
//! - `bits`: one bit for each cell of a page, which copies share
//! - `plate`: a page over the rays of a picture
//! - `solid`: cells of a grid, from counts of 1, 2, 4, 8 and 16 cells
//!
//! Lengths are fixed shares of the target's larger side. On a page of 50 x 50 pixels the radii are 2, 4, 8 and 15 pixels,
//! and cells have the spread of bilinear samples of boxes of 1, 1, 2 and 8 pixels.

pub(crate) mod bits;
pub(crate) mod flat;
pub(crate) mod plate;
pub(crate) mod solid;

use crate::vector::Vec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Radii of the rings and shells, and the sides of their cells, as shares of the target's larger side.
const FLAT: [Ring; 5] = [
    Ring { points: 1, radius: 0.0, cell: 0.035 },
    Ring { points: 6, radius: 0.04, cell: 0.035 },
    Ring { points: 8, radius: 0.08, cell: 0.035 },
    Ring { points: 8, radius: 0.16, cell: 0.07 },
    Ring { points: 8, radius: 0.30, cell: 0.28 },
];
const SOLID: [Ring; 5] = [
    Ring { points: 1, radius: 0.0, cell: 0.02 },
    Ring { points: 14, radius: 0.04, cell: 0.02 },
    Ring { points: 14, radius: 0.08, cell: 0.04 },
    Ring { points: 14, radius: 0.16, cell: 0.08 },
    Ring { points: 14, radius: 0.30, cell: 0.16 },
];

struct Ring {
    points: usize,
    radius: f64,
    cell: f64,
}

/// The place from which a guide looks: a position and two unit directions at right angles, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The middle of the window.
    pub position: Vec3,
    /// Unit direction of the first point of every ring.
    pub forward: Vec3,
    /// Unit direction at a right angle to `forward`.
    pub up: Vec3,
    /// The factor on all lengths of a window, radii and cells; above 0.
    pub scale: f64,
}

impl Place {
    /// A place of scale 1. `forward` has any length. `up` has any direction, and its part across `forward` counts. Without
    /// `up`, or without such a part, +y replaces it, or else any direction across. `None` for a `forward` that is no
    /// direction, and for numbers that are not finite.
    pub fn new(position: Vec3, forward: Vec3, up: Option<Vec3>) -> Option<Place> {
        let forward = Some(forward).filter(|f| f.is_finite()).and_then(Vec3::unit)?;
        if !position.is_finite() {
            return None;
        }
        let across = |v: Vec3| {
            let v = v.unit()?;
            let rest = v - forward * forward.dot(v);
            if rest.norm() > 1e-9 { rest.unit() } else { None }
        };
        let up = up.filter(|up| up.is_finite()).and_then(across);
        let up = up.or_else(|| across(Vec3::AXES[1])).unwrap_or_else(|| forward.any_perpendicular());
        Some(Place { position, forward, up, scale: 1.0 })
    }

    /// The third unit direction, which makes `forward`, `left` and `up` right-handed.
    pub fn left(&self) -> Vec3 {
        self.up.cross(self.forward)
    }
}

/// The kind of space that a window looks at.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WindowKind {
    /// A page or a picture.
    Flat,
    /// A volume.
    Solid,
}

/// A point of a window.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct WindowPoint {
    /// Offset along the place's `forward`, `left` and `up`, world units. A flat window has nothing along `up`.
    pub at: [f64; 3],
    /// Side of the cell, world units.
    pub cell: f64,
}

/// The points of a window: plain data in world units. A guide's file has them, so that the lengths stay the same for targets
/// of another size or resolution.
///
/// In a perspective picture lengths are those at depth 1, so that the size of a window in the picture does not depend on its
/// place.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct WindowForm {
    /// The kind of space.
    pub kind: WindowKind,
    /// The points, from the middle outwards.
    pub points: Vec<WindowPoint>,
}

impl WindowForm {
    /// The window of a page whose larger side is `side`: the middle and rings of 6, 8, 8 and 8 points, the first of each
    /// straight ahead and the others in order to its left.
    pub fn flat(side: f64) -> WindowForm {
        let ring = |ring: &Ring| {
            let (count, radius, cell) = (ring.points, ring.radius * side, ring.cell * side);
            let at = move |k: usize| {
                let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
                WindowPoint { at: [radius * cos, radius * sin, 0.0], cell }
            };
            (0..count).map(at)
        };
        WindowForm { kind: WindowKind::Flat, points: FLAT.iter().flat_map(ring).collect() }
    }

    /// The window of a volume whose larger side is `side`: the middle and four shells of 14 points, the six directions
    /// along the axes of the place (ahead, back, left, right, up, down) and the eight between them.
    pub fn solid(side: f64) -> WindowForm {
        let shell = |ring: &Ring| {
            let (count, radius, cell) = (ring.points, ring.radius * side, ring.cell * side);
            let at = move |k: usize| {
                let at = if k < 6 {
                    let sign = [radius, -radius][k % 2];
                    std::array::from_fn(|a| if a == k / 2 { sign } else { 0.0 })
                } else {
                    let part = radius / 3.0_f64.sqrt();
                    std::array::from_fn(|a| if (k - 6) >> a & 1 == 0 { part } else { -part })
                };
                WindowPoint { at, cell }
            };
            (0..count).map(at)
        };
        WindowForm { kind: WindowKind::Solid, points: SOLID.iter().flat_map(shell).collect() }
    }

    /// The number of its values.
    pub fn values(&self) -> usize {
        2 * self.points.len()
    }

    /// Appends the values of a window that is wholly outside.
    pub(crate) fn outside(&self, out: &mut Vec<f32>) {
        self.points.iter().for_each(|_| out.extend([0.0, 2.0]));
    }
}
