//! Normals for any mesh: smooth at small angles, sharp at large ones.
//!
//! The normal at a corner of a face is the mean of the normals of the faces around that vertex, weighted by their angle at
//! the vertex (Thurmer & Wuthrich 1998). Faces that turn away by more than the crease angle do not count.
//! A triangle whose three corners lie on a line stays, because its neighbours need it to be closed: nobody sees its normals.

use super::mesh::{FineMesh, unit_or};
use crate::mesh::TriMesh;
use crate::vector::{Vec3, vec3};
use std::collections::HashMap;

/// Cosine of the angle (40 degrees) beyond which an edge stays sharp.
pub const SHARP: f64 = 0.766;

/// Bits of a position or normal; adding zero makes the two zeros equal.
fn key(v: Vec3) -> [u64; 3] {
    v.to_array().map(|c| (c + 0.0).to_bits())
}

/// The mesh with vertices split where normals differ.
pub fn creased(mesh: &TriMesh, sharp: f64) -> FineMesh {
    let corners: Vec<[Vec3; 3]> = mesh.corners().collect();
    let across: Vec<Vec3> =
        corners.iter().map(|[a, b, c]| unit_or((*b - *a).cross(*c - *a), vec3(0.0, 0.0, 0.0))).collect();
    let mut around: HashMap<[u64; 3], Vec<(usize, f64)>> = HashMap::new();
    for (face, points) in corners.iter().enumerate() {
        for k in 0..3 {
            around.entry(key(points[k])).or_default().push((face, angle(points, k)));
        }
    }
    let mut fine = FineMesh::default();
    let mut vertices: HashMap<([u64; 3], [u64; 3]), u32> = HashMap::new();
    for (face, points) in corners.iter().enumerate() {
        let is_flat = across[face] == Vec3::ZERO;
        // Its other two sides are one.
        if is_flat && (0..3).any(|k| key(points[k]) == key(points[(k + 1) % 3])) {
            continue;
        }
        let numbers = points.map(|p| {
            let place = key(p);
            let sum = around[&place]
                .iter()
                .filter(|(other, _)| is_flat || across[*other].dot(across[face]) >= sharp)
                .fold(Vec3::ZERO, |sum, (other, weight)| sum + across[*other] * *weight);
            let normal = unit_or(sum, if is_flat { vec3(0.0, 1.0, 0.0) } else { across[face] });
            *vertices.entry((place, key(normal))).or_insert_with(|| fine.point(p, normal))
        });
        fine.faces.push(numbers);
    }
    fine
}

/// The triangle's angle at its corner `k`.
fn angle(points: &[Vec3; 3], k: usize) -> f64 {
    let to = |j: usize| unit_or(points[(k + j) % 3] - points[k], Vec3::ZERO);
    to(1).dot(to(2)).clamp(-1.0, 1.0).acos()
}

#[cfg(test)]
mod tests {
    //! Claim: a cube keeps its 24 corners' normals; a strip that bends by 10 degrees shares them; a closed mesh stays closed.
    use super::*;

    #[test]
    fn a_cube_stays_sharp_and_a_gentle_bend_is_smooth() {
        let corner = |i: u32| vec3((i & 1).into(), (i >> 1 & 1).into(), (i >> 2).into());
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let cube = TriMesh::new((0..8).map(corner).collect(), faces).unwrap();
        assert_eq!(creased(&cube, SHARP).vertices.len(), 24);
        let (sin, cos) = 10f64.to_radians().sin_cos();
        let strip = vec![
            vec3(-1., 0., 0.),
            vec3(0., 0., 0.),
            vec3(cos, sin, 0.),
            vec3(-1., 0., -1.),
            vec3(0., 0., -1.),
            vec3(cos, sin, -1.),
        ];
        let faces = vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]];
        assert_eq!(creased(&TriMesh::new(strip, faces).unwrap(), SHARP).vertices.len(), 6);
    }

    #[test]
    fn a_triangle_on_a_line_keeps_its_mesh_closed() {
        // A tetrahedron; the middle of the side from 0 to 1 belongs to the faces on one side of it only.
        let points = [[0., 0., 0.], [2., 0., 0.], [0., 2., 0.], [0., 0., 2.], [1., 0., 0.]];
        let faces = vec![[0, 2, 1], [1, 2, 3], [2, 0, 3], [0, 4, 3], [4, 1, 3], [0, 1, 4]];
        let mesh = TriMesh::new(points.map(|[x, y, z]| vec3(x, y, z)).to_vec(), faces).unwrap();
        assert_eq!(mesh.open_edges(), 0);
        let fine = creased(&mesh, SHARP);
        assert!(fine.normals.iter().all(|n| (n.norm() - 1.0).abs() < 1e-12));
        assert_eq!(TriMesh::new(fine.vertices, fine.faces).unwrap().open_edges(), 0);
    }
}
