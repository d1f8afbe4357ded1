//! Windows: what a sketch shows around a place, as a short list of numbers.
//!
//! A guide looks at a scene through windows: points around the place where the model works, near ones close together
//! and small, far ones apart and large. They are given in the frame of the place, so that a scene and its target turned
//! about together show the same. Every point shows two numbers of the *cell* around it, a square (a cube in space)
//! along the axes of the target:
//!
//! ```text
//! uncovered target   share of the cell that the target wants and the scene does not have yet       0 to 1
//! uncovered empty    share of the cell that neither has,  plus 2 times the share outside of the domain      0 to 2
//! ```
//!
//! What is outside counts as empty twice, so that it is told from what is inside and empty. What the scene covers adds
//! to neither. A sketch without a target shows what its own documentation says.
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

/// Where a guide looks from: a position and two unit directions at right angles, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The middle of the window.
    pub position: Vec3,
    /// Unit: the direction of the first point of every ring.
    pub forward: Vec3,
    /// Unit, at a right angle to `forward`.
    pub up: Vec3,
    /// Multiplies all lengths of a window: radii and cells. Above 0.
    pub scale: f64,
}

impl Place {
    /// A place of scale 1. `forward` has any length, and `up` any direction: its part across `forward` counts. Without
    /// one, or where it has no such part, it is that of +y, or else any direction across. `None` for a `forward` that is
    /// no direction, and for numbers that are not finite.
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
        let given = up.filter(|up| up.is_finite()).and_then(across);
        let up = given.or_else(|| across(Vec3::AXES[1])).unwrap_or_else(|| forward.any_perpendicular());
        Some(Place { position, forward, up, scale: 1.0 })
    }

    /// Unit: the third direction, which makes `forward`, `left` and `up` right-handed.
    pub fn left(&self) -> Vec3 {
        self.up.cross(self.forward)
    }
}

/// What a window looks at.
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
    /// Along the place's `forward`, `left` and `up`, world units. A flat window has nothing along `up`.
    pub at: [f64; 3],
    /// Side of its cell, world units.
    pub cell: f64,
}

/// The points of a window: plain data in world units, kept in a guide's file, so that a target of another size or
/// resolution is looked at with the same lengths.
///
/// In a picture that is seen in perspective lengths are those at depth 1, so that a window is equally large in the
/// picture wherever its place is.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct WindowForm {
    /// What it looks at.
    pub kind: WindowKind,
    /// Its points, from the middle outwards.
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

    /// How many numbers it shows.
    pub fn values(&self) -> usize {
        2 * self.points.len()
    }

    /// What it shows where everything is outside.
    pub(crate) fn outside(&self, out: &mut Vec<f32>) {
        self.points.iter().for_each(|_| out.extend([0.0, 2.0]));
    }
}
