//! Containment of a point in a closed surface, and of a solid in another whose surface it does not cross.

use crate::mesh::TriMesh;
use crate::solids::shape::Shape;
use crate::vector::Vec3;
use crate::winding::{solid_angle, winds_around};
use std::f64::consts::TAU;

/// The depth of a sample below a face, as a share of the solid's thickness.
const DEPTH: f64 = 1e-3;

/// True when `point` is inside the closed surface of `shape`.
pub fn contains(shape: &Shape, point: Vec3) -> bool {
    inside_mesh(&shape.world_mesh(), point)
}

/// True when a closed mesh contains `point`.
fn inside_mesh(mesh: &TriMesh, point: Vec3) -> bool {
    winds_around(mesh.corners(), point)
}

/// The part of each triangle: triangles that share the place of a vertex are of one part.
pub fn parts(mesh: &TriMesh) -> Vec<usize> {
    let merged = mesh.merged();
    let mut above: Vec<usize> = (0..merged.len()).collect();
    let first = |above: &mut Vec<usize>, mut v: usize| {
        while above[v] != v {
            above[v] = above[above[v]];
            v = above[v];
        }
        v
    };
    for t in mesh.triangles() {
        let [a, b, c] = t.map(|v| first(&mut above, merged[v as usize] as usize));
        let lowest = a.min(b).min(c);
        [a, b, c].into_iter().for_each(|v| above[v] = lowest);
    }
    mesh.triangles().iter().map(|t| first(&mut above, merged[t[0] as usize] as usize)).collect()
}

/// True when a mesh or one of its parts contains `point`: a part that faces inwards makes no hole in the part around it.
pub fn inside_part(mesh: &TriMesh, parts: &[usize], point: Vec3) -> bool {
    let mut angles = vec![0.0; mesh.vertices().len()];
    for (t, part) in mesh.corners().zip(parts) {
        angles[*part] += solid_angle(t.map(|p| p - point));
    }
    angles.iter().any(|angle: &f64| angle.abs() > TAU) || angles.iter().sum::<f64>().abs() > TAU
}

/// True when a point just below a face of one shape lies inside the other.
///
/// If surfaces do not cross, this is equivalent to a common inside. It also detects equal cross-sections, whose surfaces do
/// not cross either.
pub fn overlap(a: &Shape, b: &Shape) -> bool {
    holds_part_of(a, b) || holds_part_of(b, a)
}

fn holds_part_of(holder: &Shape, part: &Shape) -> bool {
    let depth = DEPTH * part.thickness();
    part.world_mesh().corners().any(|[a, b, c]| {
        let Some(normal) = (b - a).cross(c - a).unit() else { return false };
        let middle = (a + b + c) * (1.0 / 3.0);
        // The mesh may be inside out: use the inner side.
        [-depth, depth].into_iter().any(|step| {
            let sample = middle + normal * step;
            let boxed = holder.aabb().meets(&crate::bounds::Aabb { low: sample, high: sample });
            boxed && contains(part, sample) && contains(holder, sample)
        })
    })
}
