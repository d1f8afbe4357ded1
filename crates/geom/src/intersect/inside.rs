//! Containment: is a point inside a closed surface, and is one solid inside another whose surface it does
//! not cross?
//!
//! The winding number of a closed mesh around a point is the sum of its triangles' solid angles over 4 pi (van Oosterom
//! & Strackee 1983): zero outside, and not zero inside, for either orientation of the mesh.

use crate::mesh::TriMesh;
use crate::shape::Shape;
use crate::vector::Vec3;

/// How far below a face a sample lies, as a share of the solid's thickness.
const DEPTH: f64 = 1e-3;

/// True when `point` is inside the closed surface of `shape`.
pub fn contains(shape: &Shape, point: Vec3) -> bool {
    inside_mesh(&shape.world_mesh(), point)
}

/// True when a closed mesh contains `point`.
pub fn inside_mesh(mesh: &TriMesh, point: Vec3) -> bool {
    let angle: f64 = mesh.corners().map(|t| solid_angle(t.map(|p| p - point))).sum();
    angle.abs() > std::f64::consts::TAU
}

/// Solid angle of a triangle seen from the origin, steradians, positive when its inner side faces the origin.
fn solid_angle([a, b, c]: [Vec3; 3]) -> f64 {
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * a.dot(b.cross(c)).atan2(below)
}

/// True when a point just below a face of one shape lies inside the other.
///
/// Where surfaces do not cross, that is the same as a common inside; equal cross-sections, which have no crossing
/// either, are seen as well.
pub fn overlap(a: &Shape, b: &Shape) -> bool {
    holds_part_of(a, b) || holds_part_of(b, a)
}

fn holds_part_of(holder: &Shape, part: &Shape) -> bool {
    let depth = DEPTH * part.thickness();
    part.world_mesh().corners().any(|[a, b, c]| {
        let Some(normal) = (b - a).cross(c - a).unit() else { return false };
        let middle = (a + b + c) * (1.0 / 3.0);
        // The mesh may be inside out: take the side that is inside.
        [-depth, depth].into_iter().any(|step| {
            let sample = middle + normal * step;
            let boxed = holder.aabb().meets(&crate::bounds::Aabb { low: sample, high: sample });
            boxed && contains(part, sample) && contains(holder, sample)
        })
    })
}
