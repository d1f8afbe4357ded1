//! The same shapes with many sides: meshes for pictures and exports.
//!
//! Scores use `Shape::world_mesh`; here the solid is built again with rounded edges, round cylinders and smooth
//! normals (the high resolution of chapter 5's figures). The mesh of a box, cylinder or limb is closed; where a flat
//! face meets a round rim they share vertices, because their normals agree there.
//!
//! - `mesh.rs`    triangles with normals
//! - `boxes.rs`   rounded boxes, tapered or not
//! - `revolve.rs` cylinders and cones with rounded rims
//! - `limb.rs`    smooth tubes with a domed end
//! - `segment.rs` the same, with a collar on the parent's bark
//! - `crease.rs`  normals of any mesh, sharp at large angles

mod boxes;
mod crease;
mod limb;
mod mesh;
mod revolve;
mod segment;

pub use mesh::{ARC, FineMesh, ROUND};

use crate::plate;
use crate::shape::Shape;
use crate::solid::Solid;

/// Rounding of boxes whose shape gives none, as a share of the smallest half length.
pub const BOX_BEVEL: f64 = 0.16;
/// Rounding of cylinders' rims, as a share of the smaller of the radius and the half length.
pub const RIM_BEVEL: f64 = 0.12;

/// The fine mesh of a shape, in the world.
pub fn fine_mesh(shape: &Shape) -> FineMesh {
    let bevel = |usual: f64| shape.bevel().unwrap_or(usual).clamp(0.0, 1.0);
    let mut mesh = match shape.solid() {
        Solid::Box { size } => boxes::rounded(*size, 1.0, bevel(BOX_BEVEL)),
        Solid::TaperedBox { size, taper } => boxes::rounded(*size, *taper, bevel(BOX_BEVEL)),
        Solid::Cylinder { radius, length, .. } => {
            revolve::rounded(*radius, *radius, *length, bevel(RIM_BEVEL))
        }
        Solid::TaperedCylinder { radius, top_radius, length, .. } => {
            revolve::rounded(*radius, *top_radius, *length, bevel(RIM_BEVEL))
        }
        Solid::Limb { rings, .. } => limb::domed(&rings[0], &rings[1]),
        Solid::Segment(tube) => segment::grown(&tube.frames(), tube.onto().as_ref()),
        Solid::Mesh(mesh) => crease::creased(mesh, crease::SHARP),
        flat @ (Solid::Stroke { .. } | Solid::Ellipse { .. }) => plate::plate(flat, plate::FINE)
            .map_or_else(|_| FineMesh::default(), |mesh| crease::creased(&mesh, crease::SHARP)),
    };
    mesh = mesh.without_unused();
    let placement = shape.placement();
    for p in &mut mesh.vertices {
        *p = placement.apply(*p);
    }
    for n in &mut mesh.normals {
        *n = placement.rotation.apply(*n);
    }
    mesh
}

#[cfg(test)]
mod tests {
    //! Claim: every fine mesh is closed, has unit normals that agree with its faces and no vertex without one, lies
    //! within the solid's box (a limb's dome excepted) and fills nearly the solid's volume.
    use super::*;
    use crate::look::Look;
    use crate::mesh::TriMesh;
    use crate::vector::{Vec3, vec3};

    fn check(shape: &Shape, volume: f64, tolerance: f64) {
        let fine = fine_mesh(shape);
        let mesh = TriMesh::new(fine.vertices.clone(), fine.faces.clone()).unwrap();
        assert_eq!(mesh.open_edges(), 0, "{}", shape.kind());
        let six: f64 = mesh.corners().map(|[a, b, c]| a.dot(b.cross(c))).sum();
        assert!((six / 6.0 / volume - 1.0).abs() < tolerance, "{}: {} for {volume}", shape.kind(), six / 6.0);
        let used: std::collections::HashSet<u32> = fine.faces.iter().flatten().copied().collect();
        assert_eq!(used.len(), fine.vertices.len(), "{}", shape.kind());
        for face in &fine.faces {
            let [a, b, c] = face.map(|i| fine.vertices[i as usize]);
            let across = (b - a).cross(c - a);
            for &i in face {
                assert!((fine.normals[i as usize].norm() - 1.0).abs() < 1e-9);
                assert!(fine.normals[i as usize].dot(across) > -1e-9, "{}", shape.kind());
            }
        }
    }

    #[test]
    fn all_kinds() {
        let plain = Look::default();
        let sharp = Look { bevel: Some(0.0), ..plain };
        let (o, size) = (vec3(1.0, 2.0, 3.0), vec3(2.0, 1.0, 4.0));
        check(&Shape::cuboid(o, size, &plain).unwrap(), 8.0, 0.02);
        check(&Shape::cuboid(o, size, &sharp).unwrap(), 8.0, 1e-9);
        check(
            &Shape::cuboid(o, vec3(1.0, 1.0, 1.0), &Look { bevel: Some(1.0), ..plain }).unwrap(),
            std::f64::consts::FRAC_PI_6,
            0.03,
        );
        check(&Shape::tapered_box(o, size, 0.5, 2, &sharp).unwrap(), 8.0 * 7.0 / 12.0, 1e-9);
        check(&Shape::tapered_box(o, size, 0.5, 0, &plain).unwrap(), 8.0 * 7.0 / 12.0, 0.03);
        check(&Shape::tapered_box(o, size, 0.0, 1, &plain).unwrap(), 8.0 / 3.0, 0.05);
        let (pi, z) = (std::f64::consts::PI, vec3(0.0, 0.0, 1.0));
        check(&Shape::cylinder(o, 1.0, 3.0, z, None, &plain).unwrap(), 3.0 * pi, 0.02);
        check(&Shape::cylinder(o, 1.0, 3.0, z, Some(0.2), &plain).unwrap(), 1.24 * pi, 0.02);
        check(&Shape::cylinder(o, 1.0, 3.0, z, Some(0.0), &sharp).unwrap(), pi, 0.02);
        let limb = Shape::limb(o, o + vec3(0.1, 2.0, 0.0), (0.5, 0.4), (None, None), &plain).unwrap();
        check(&limb, 0.61 / 3.0 * pi * 2.0 + 2.0 / 3.0 * pi * 0.4 * 0.4 * 0.4 * limb::DOME, 0.02);
    }

    #[test]
    fn a_bent_limb_is_closed_and_meets_its_neighbour() {
        let (a, b, c) = (vec3(0.0, 0.0, 0.0), vec3(0.1, 2.0, 0.0), vec3(0.9, 3.8, 0.5));
        let n = vec3(0.2, 1.0, 0.1);
        let low = Shape::limb(a, b, (0.5, 0.4), (None, Some(n)), &Look::default()).unwrap();
        let high = Shape::limb(b, c, (0.4, 0.3), (Some(n), None), &Look::default()).unwrap();
        let [low, high] = [low, high].map(|limb| fine_mesh(&limb));
        for fine in [&low, &high] {
            let mesh = TriMesh::new(fine.vertices.clone(), fine.faces.clone()).unwrap();
            assert_eq!(mesh.open_edges(), 0);
        }
        // The ring that both name: same places, same normals.
        let shared = |p: &Vec3, n: &Vec3| {
            low.vertices.iter().zip(&low.normals).any(|(q, m)| p == q && (*n - *m).norm() < 1e-12)
        };
        assert!(high.vertices.iter().zip(&high.normals).take(ROUND).all(|(p, n)| shared(p, n)));
    }

    #[test]
    fn rounded_boxes_stay_inside_the_box() {
        let shape = Shape::tapered_box(Vec3::ZERO, vec3(2.0, 1.0, 4.0), 0.4, 2, &Look::default()).unwrap();
        let b = shape.aabb();
        for v in fine_mesh(&shape).vertices {
            assert_eq!((v.min(b.high), v.max(b.low)), (v, v));
        }
    }
}
