//! Surfaces with many sides: the parts of meshes for pictures and files.
//!
//! - `mesh.rs`    triangles with normals
//! - `boxes.rs`   rounded boxes, tapered or not
//! - `corners.rs` polygons with rounded corners
//! - `extrude.rs` rounded prisms over polygons, twisted and tapered
//! - `revolve.rs` cylinders and cones with rounded rims
//! - `limb.rs`    smooth tubes with a domed end
//! - `segment.rs` smooth tubes with a collar on the parent's bark
//! - `crease.rs`  normals of any mesh, sharp at large angles

pub(crate) mod boxes;
pub(crate) mod corners;
pub(crate) mod crease;
pub(crate) mod extrude;
pub(crate) mod limb;
mod mesh;
pub(crate) mod revolve;
pub(crate) mod segment;

pub use mesh::{ARC, FineMesh, ROUND};

#[cfg(test)]
mod tests {
    //! Claim: every fine mesh is closed, has unit normals that agree with its faces and no vertex without one, lies
    //! within the solid's box (a limb's dome excepted) and fills nearly the solid's volume.
    use super::*;
    use crate::look::Look;
    use crate::mesh::TriMesh;
    use crate::solids::shape::Shape;
    use crate::solids::testing::sound;
    use crate::vector::{Vec3, vec3};

    #[test]
    fn all_kinds() {
        let plain = Look::default();
        let sharp = Look { bevel: Some(0.0), ..plain.clone() };
        let (o, size) = (vec3(1.0, 2.0, 3.0), vec3(2.0, 1.0, 4.0));
        sound(&Shape::cuboid(o, size, &plain).unwrap(), 8.0, 0.02);
        sound(&Shape::cuboid(o, size, &sharp).unwrap(), 8.0, 1e-9);
        sound(
            &Shape::cuboid(o, vec3(1.0, 1.0, 1.0), &Look { bevel: Some(1.0), ..plain.clone() }).unwrap(),
            std::f64::consts::FRAC_PI_6,
            0.03,
        );
        sound(&Shape::tapered_box(o, size, 0.5, 2, &sharp).unwrap(), 8.0 * 7.0 / 12.0, 1e-9);
        sound(&Shape::tapered_box(o, size, 0.5, 0, &plain).unwrap(), 8.0 * 7.0 / 12.0, 0.03);
        sound(&Shape::tapered_box(o, size, 0.0, 1, &plain).unwrap(), 8.0 / 3.0, 0.05);
        let (pi, z) = (std::f64::consts::PI, vec3(0.0, 0.0, 1.0));
        sound(&Shape::cylinder(o, 1.0, 3.0, z, None, &plain).unwrap(), 3.0 * pi, 0.02);
        sound(&Shape::cylinder(o, 1.0, 3.0, z, Some(0.2), &plain).unwrap(), 1.24 * pi, 0.02);
        sound(&Shape::cylinder(o, 1.0, 3.0, z, Some(0.0), &sharp).unwrap(), pi, 0.02);
        let limb = Shape::limb(o, o + vec3(0.1, 2.0, 0.0), (0.5, 0.4), (None, None), &plain).unwrap();
        sound(&limb, 0.61 / 3.0 * pi * 2.0 + 2.0 / 3.0 * pi * 0.4 * 0.4 * 0.4 * limb::DOME, 0.02);
    }

    #[test]
    fn a_bent_limb_is_closed_and_meets_its_neighbour() {
        let (a, b, c) = (vec3(0.0, 0.0, 0.0), vec3(0.1, 2.0, 0.0), vec3(0.9, 3.8, 0.5));
        let n = vec3(0.2, 1.0, 0.1);
        let low = Shape::limb(a, b, (0.5, 0.4), (None, Some(n)), &Look::default()).unwrap();
        let high = Shape::limb(b, c, (0.4, 0.3), (Some(n), None), &Look::default()).unwrap();
        let [low, high] = [low, high].map(|limb| limb.fine_mesh());
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
        for v in shape.fine_mesh().vertices {
            assert_eq!((v.min(b.high), v.max(b.low)), (v, v));
        }
    }
}
