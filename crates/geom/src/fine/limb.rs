//! A limb: a smooth tube between two rings, and a dome over its end.
//!
//! The axis is the cubic that leaves the first ring along its normal and meets the second ring along its normal (Hermite
//! form), so that limbs that share a ring bend into one another. Normals on the side point straight away from the
//! axis *in the ring's plane*: neighbours agree there, and a branch of many limbs looks like one surface. The dome is
//! hidden by the next limb, and rounds off the last.

use super::mesh::{FineMesh, ROUND, unit_or};
use crate::ring::Ring;
use crate::vector::Vec3;

/// Height of the dome over the end, in radii of the end.
pub const DOME: f64 = 0.4;
/// Pieces of the tube along its axis.
const STEPS: usize = 6;
/// Rings of the dome.
const LATITUDES: usize = 5;
/// The largest slope (radius for each unit of length) of a side that is shaded as a tube; steeper sides are cones.
const STEEP: f64 = 0.5;

/// The limb between two rings. It begins with half a ball, if it is `round` there.
pub fn domed(start: &Ring, end: &Ring, round: bool) -> FineMesh {
    let mut mesh = FineMesh::default();
    let slope = (start.radius - end.radius) / (end.center - start.center).norm().max(1e-12);
    let lift = if slope.abs() > STEEP { slope } else { 0.0 };
    let mut high = Vec::new();
    for step in 0..=STEPS {
        let ring = between(start, end, step as f64 / STEPS as f64);
        let next = row(&mut mesh, &ring, |out| (ring.center + out * ring.radius, out + ring.normal * lift));
        if step > 0 {
            join(&mut mesh, &high, &next);
        }
        high = next;
    }

    if round {
        ball(&mut mesh, start);
        dome(&mut mesh, end, high);
        return mesh;
    }
    // The base is flat.
    let base = row(&mut mesh, start, |out| (start.center + out * start.radius, start.normal * -1.0));
    close(&mut mesh, &base, start.center, start.normal * -1.0);
    dome(&mut mesh, end, high);
    mesh
}

/// Half a ball below the ring `start`, over a row of its own: at the rim the normals of ball and tube differ.
fn ball(mesh: &mut FineMesh, start: &Ring) {
    let mut above = row(mesh, start, |out| (start.center + out * start.radius, out));
    for latitude in 1..LATITUDES {
        let (sin, cos) = (std::f64::consts::FRAC_PI_2 * latitude as f64 / LATITUDES as f64).sin_cos();
        let below = row(mesh, start, |out| {
            let away = out * cos + start.normal * -sin;
            (start.center + away * start.radius, away)
        });
        join(mesh, &below, &above);
        above = below;
    }
    close(mesh, &above, start.center + start.normal * -start.radius, start.normal * -1.0);
}

/// Closes the base with a fan about `middle`.
pub(super) fn close(mesh: &mut FineMesh, base: &[u32], middle: Vec3, normal: Vec3) {
    let middle = mesh.point(middle, normal);
    for k in 0..ROUND {
        mesh.face([middle, base[(k + 1) % ROUND], base[k]]);
    }
}

/// Half of a flattened sphere over the row `below`, which lies on `end`; its normals are those of its gradient.
pub(super) fn dome(mesh: &mut FineMesh, end: &Ring, mut below: Vec<u32>) {
    for latitude in 1..LATITUDES {
        let (sin, cos) = (std::f64::consts::FRAC_PI_2 * latitude as f64 / LATITUDES as f64).sin_cos();
        let above = row(mesh, end, |out| {
            let place = out * cos + end.normal * (sin * DOME);
            (end.center + place * end.radius, out * cos + end.normal * (sin / DOME))
        });
        join(mesh, &below, &above);
        below = above;
    }
    let top = mesh.point(end.center + end.normal * (DOME * end.radius), end.normal);
    for k in 0..ROUND {
        mesh.face([top, below[k], below[(k + 1) % ROUND]]);
    }
}

/// The ring at the fraction `t` of the axis; at 0 and 1 the ends, to the bit.
pub(super) fn between(start: &Ring, end: &Ring, t: f64) -> Ring {
    if t == 0.0 || t == 1.0 {
        return if t == 0.0 { *start } else { *end };
    }
    let length = (end.center - start.center).norm();
    let (t2, t3) = (t * t, t * t * t);
    let center = start.center * (2.0 * t3 - 3.0 * t2 + 1.0)
        + end.center * (3.0 * t2 - 2.0 * t3)
        + (start.normal * (t3 - 2.0 * t2 + t) + end.normal * (t3 - t2)) * length;
    let along = (end.center - start.center) * (6.0 * t - 6.0 * t2)
        + (start.normal * (3.0 * t2 - 4.0 * t + 1.0) + end.normal * (3.0 * t2 - 2.0 * t)) * length;
    let radius = start.radius + (end.radius - start.radius) * t;
    Ring { center, normal: unit_or(along, start.normal), radius }
}

/// A row of vertices made from the ring's outward directions.
pub(super) fn row(mesh: &mut FineMesh, ring: &Ring, make: impl Fn(Vec3) -> (Vec3, Vec3)) -> Vec<u32> {
    let unit = Ring { center: Vec3::ZERO, normal: ring.normal, radius: 1.0 };
    unit.vertices(ROUND)
        .map(|out| {
            let (place, normal) = make(out);
            mesh.point(place, unit_or(normal, out))
        })
        .collect()
}

pub(super) fn join(mesh: &mut FineMesh, below: &[u32], above: &[u32]) {
    for k in 0..ROUND {
        let next = (k + 1) % ROUND;
        mesh.quad([below[k], below[next], above[next], above[k]]);
    }
}
