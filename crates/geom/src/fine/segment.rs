//! A segment of a tree: the smooth tube of a limb, which widens where it leaves its parent's bark.
//!
//! The collar makes a fork look natural. Its foot is a ring wider than the branch, dropped
//! onto the parent's cone; over the first part of the branch the rows narrow to the branch and rise from the bark.
//! At the foot the normals are those of the parent, so that the shading has no seam.

use super::limb::{between, close, dome, domed, join, row};
use super::mesh::{FineMesh, unit_or};
use crate::ring::Ring;
use crate::tube::{Bark, Frame};
use crate::vector::Vec3;

/// The foot of the collar, in radii of the branch.
const FOOT: f64 = 1.6;
/// The widest foot, as a share of the parent's radius: a wider foot would reach past its sides.
const WIDEST: f64 = 0.96;
/// The height of the collar, in radii of the branch.
const RISE: f64 = 1.5;
/// Rows of the collar.
const COLLAR: usize = 8;
/// Rows from the collar to the end.
const STEPS: usize = 6;
/// The distance of the foot from the parent's axis, as a share of its radius: a sunken foot shows no crack.
const SUNK: f64 = 0.985;

/// The segment over `[start, split, end]`. The split ring is for the coarse mesh: a smooth bend needs none.
pub fn grown(frames: &[Frame; 3], onto: Option<&Bark>) -> FineMesh {
    let ring = |f: &Frame| Ring { center: f.center, normal: f.forward, radius: f.radius };
    let (start, end) = (ring(&frames[0]), ring(&frames[2]));
    match onto.and_then(|bark| Some((bark, bark.down(start.center)?))) {
        None => domed(&start, &end, false),
        Some((bark, down)) => collared(&start, &end, bark, down),
    }
}

fn collared(start: &Ring, end: &Ring, bark: &Bark, down: Vec3) -> FineMesh {
    let mut mesh = FineMesh::default();
    let wide = 0.5 * (bark.low_radius + bark.high_radius);
    let foot = FOOT.min(WIDEST * wide / start.radius).max(1.0);
    let rise = (RISE * start.radius / (end.center - start.center).norm().max(1e-12)).min(0.8);
    let mut below: Vec<u32> = Vec::new();
    for step in 0..=COLLAR + STEPS {
        // The share of the collar above this row: 1 at the foot, 0 beyond the collar.
        let left = 1.0 - step.min(COLLAR) as f64 / COLLAR as f64;
        let t = match step.checked_sub(COLLAR) {
            None => rise * (1.0 - left) * (1.0 - left),
            Some(more) => rise + (1.0 - rise) * more as f64 / STEPS as f64,
        };
        let ring = between(start, end, t);
        let spread = ring.radius * (1.0 + (foot - 1.0) * left * left);
        let lowered = |out: Vec3| {
            let place = ring.center + out * spread;
            (place, place + down * (bark.drop(place, down, SUNK) * left * left))
        };
        let next = row(&mut mesh, &ring, |out| {
            let (place, lowered) = lowered(out);
            let (axis, _) = bark.below(place, 1.0);
            let skin = unit_or(lowered - axis, out);
            (lowered, skin * left + out * (1.0 - left))
        });
        if step == 0 {
            // The lid of the foot faces into the parent, unlike the skin around it.
            let base = row(&mut mesh, &ring, |out| (lowered(out).1, down));
            close(&mut mesh, &base, start.center + down * (start.radius * 0.5), down);
        } else {
            join(&mut mesh, &below, &next);
        }
        below = next;
    }
    dome(&mut mesh, end, below);
    mesh
}

#[cfg(test)]
mod tests {
    //! Claim: a collared segment is closed, its foot lies on the parent, its normals agree with its faces, and its end
    //! is the ring of the next one.
    use super::*;
    use crate::mesh::TriMesh;
    use crate::vector::vec3;

    #[test]
    fn a_collar_is_closed_and_lies_on_the_bark() {
        let up = vec3(0.0, 1.0, 0.0);
        let frame = |x: f64, radius: f64| Frame {
            center: vec3(x, 0.2 * (x - 1.05), 0.0),
            forward: vec3(1.0, 0.0, 0.0),
            up,
            radius,
        };
        let bark =
            Bark { low: vec3(0.0, -1.0, 0.0), low_radius: 1.1, high: vec3(0.0, 1.0, 0.0), high_radius: 0.9 };
        for radius in [0.1, 0.4, 0.9] {
            let frames = [frame(1.05, radius), frame(1.1, radius), frame(4.0, 0.8 * radius)];
            let fine = grown(&frames, Some(&bark));
            let mesh = TriMesh::new(fine.vertices.clone(), fine.faces.clone()).unwrap();
            assert_eq!(mesh.open_edges(), 0);
            for p in &fine.vertices[..super::super::ROUND] {
                let out = (p.x * p.x + p.z * p.z).sqrt();
                let here = 1.0 - 0.1 * p.y;
                assert!((out / here / SUNK - 1.0).abs() < 0.02, "{out} {here}");
            }
            let six: f64 = mesh.corners().map(|[a, b, c]| a.dot(b.cross(c))).sum();
            assert!(six > 0.0);
            for face in &fine.faces {
                let [a, b, c] = face.map(|i| fine.vertices[i as usize]);
                let across = unit_or((b - a).cross(c - a), Vec3::ZERO);
                for &i in face {
                    assert!(fine.normals[i as usize].dot(across) > -1e-9, "radius {radius}");
                }
            }
        }
    }
}
