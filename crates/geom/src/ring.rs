//! Regular polygons: the round parts of coarse meshes.

use crate::vector::{Mat3, Vec3, vec3};
use serde::{Deserialize, Serialize};

/// Sine and cosine of `2 pi k / sides`. Exact on the axes, where flush attachment needs it.
pub(crate) fn ring(sides: usize) -> impl Iterator<Item = (f64, f64)> {
    const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
    const OCTAGON: [(f64, f64); 8] =
        [(0.0, 1.0), (H, H), (1.0, 0.0), (H, -H), (0.0, -1.0), (-H, -H), (-1.0, 0.0), (-H, H)];
    (0..sides).map(move |k| match 8 * k % sides {
        0 => OCTAGON[8 * k / sides],
        _ => (std::f64::consts::TAU * k as f64 / sides as f64).sin_cos(),
    })
}

/// A round end of a limb: a regular polygon in the plane through `center` with unit `normal`.
///
/// The first vertex lies where the smallest turn from +y to the normal takes +z. So a ring is a function of its
/// centre, normal and radius, and two limbs that name the same ring share its vertices to the bit.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Ring {
    /// Middle, scene units.
    pub center: Vec3,
    /// Unit direction across the ring, from the start of the limb to its end.
    pub normal: Vec3,
    /// Distance of the vertices from the middle.
    pub radius: f64,
}

impl Ring {
    /// The `sides` vertices, counter-clockwise seen against the normal.
    pub fn vertices(&self, sides: usize) -> impl Iterator<Item = Vec3> + '_ {
        let turn = Mat3::between(Vec3::AXES[1], self.normal);
        ring(sides).map(move |(sin, cos)| self.center + turn.apply(vec3(sin, 0.0, cos) * self.radius))
    }
}
