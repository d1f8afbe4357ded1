//! Closed surfaces around a point.
//!
//! The winding number of a closed mesh around a point is the sum of its triangles' solid angles over 4 pi (van Oosterom
//! & Strackee 1983): zero outside, and not zero inside, for either orientation of the mesh.

use crate::vector::Vec3;
use std::f64::consts::TAU;

/// True when closed triangles wind around `point`.
pub(crate) fn winds_around(triangles: impl Iterator<Item = [Vec3; 3]>, point: Vec3) -> bool {
    let angle: f64 = triangles.map(|t| solid_angle(t.map(|p| p - point))).sum();
    angle.abs() > TAU
}

/// Solid angle of a triangle seen from the origin, steradians, positive when its inner side faces the origin.
pub(crate) fn solid_angle([a, b, c]: [Vec3; 3]) -> f64 {
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * a.dot(b.cross(c)).atan2(below)
}
