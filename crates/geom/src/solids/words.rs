//! Shapes made in Rust, by the functions that the words of the language use: `Shape::cuboid`, `Shape::limb`, ...

use super::shape::Shape;
use super::stroke::Stroke;
use super::{Cuboid, Solid, cuboid, cylinder, ellipse, limb, mesh};
use crate::error::GeomError;
use crate::look::Look;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::tube::{Bark, Frame, Tube};
use crate::vector::{Mat3, Vec3};
use std::sync::Arc;

impl Shape {
    /// A solid around `center`, turned by `laid` to its axis before the look turns it.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`].
    pub fn placed(solid: Solid, center: Vec3, laid: Mat3, look: &Look) -> Result<Shape, GeomError> {
        let rotation = look.rotation.map_or(laid, |r| r.after(&laid));
        Shape::new(solid, Placement { rotation, translation: center }, look)
    }

    /// A box around `center` with full side lengths `size`.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`].
    pub fn cuboid(center: Vec3, size: Vec3, look: &Look) -> Result<Shape, GeomError> {
        Shape::placed(Cuboid { size }.into(), center, Mat3::IDENTITY, look)
    }

    /// A box whose face at the + end of coordinate `axis` (0, 1 or 2) is scaled by `taper` in the other two.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`], and for an axis above 2.
    pub fn tapered_box(
        center: Vec3,
        size: Vec3,
        taper: f64,
        axis: usize,
        look: &Look,
    ) -> Result<Shape, GeomError> {
        let (solid, laid) = cuboid::tapered(size, taper, axis)?;
        Shape::placed(solid.into(), center, laid, look)
    }

    /// A cylinder around `center` along `axis` (any length), its `top_radius` at the end that `axis` points to.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`], and for an axis without direction.
    pub fn cylinder(
        center: Vec3,
        radius: f64,
        length: f64,
        axis: Vec3,
        top_radius: Option<f64>,
        look: &Look,
    ) -> Result<Shape, GeomError> {
        let (solid, laid) = cylinder::along(radius, length, axis, top_radius)?;
        Shape::placed(solid.into(), center, laid, look)
    }

    /// A bent, tapered segment between two round ends; a normal left out is the direction from start to end.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`], and when start and end coincide without normals.
    pub fn limb(
        start: Vec3,
        end: Vec3,
        radii: (f64, f64),
        normals: (Option<Vec3>, Option<Vec3>),
        look: &Look,
    ) -> Result<Shape, GeomError> {
        Shape::placed(limb::bent(start, end, radii, normals)?.into(), Vec3::ZERO, Mat3::IDENTITY, look)
    }

    /// A segment of a tree over the frames `[start, split, end]`, its base on `onto` where that is given.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`].
    pub fn segment(frames: [Frame; 3], onto: Option<Bark>, look: &Look) -> Result<Shape, GeomError> {
        Shape::placed(Tube::new(frames, onto).into(), Vec3::ZERO, Mat3::IDENTITY, look)
    }

    /// Flat: a straight stroke with round ends, from one width to another; both ends have the same z.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`].
    pub fn stroke(start: Vec3, end: Vec3, widths: (f64, f64), look: &Look) -> Result<Shape, GeomError> {
        Shape::new(Stroke::new(start, end, widths).into(), Placement::IDENTITY, look)
    }

    /// Flat: an ellipse of a length and a width, its length turned by `angle` (radians) from +x to +y.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`].
    pub fn ellipse(center: Vec3, size: (f64, f64), angle: f64, look: &Look) -> Result<Shape, GeomError> {
        let (solid, placement) = ellipse::at_angle(center, size, angle)?;
        Shape::new(solid.into(), placement, look)
    }

    /// A mesh, scaled about its own origin, turned and moved to `center`.
    ///
    /// # Errors
    /// `bad-shape`, as for [`Shape::new`], and for a scale that is not positive.
    pub fn mesh(mesh: &Arc<TriMesh>, center: Vec3, scale: f64, look: &Look) -> Result<Shape, GeomError> {
        Shape::placed(mesh::scaled(mesh, scale)?.into(), center, Mat3::IDENTITY, look)
    }
}

#[cfg(test)]
mod tests {
    //! Shapes have the place of their arguments, and impossible ones are refused.
    use super::*;
    use crate::vector::vec3;

    const PLAIN: Look =
        Look { rotation: None, bevel: None, color: None, metalness: None, roughness: None, material: None };

    #[test]
    fn a_cylinder_laid_along_z_has_vertices_on_the_axes() {
        let c = Shape::cylinder(vec3(1.0, 2.0, 3.0), 0.5, 4.0, vec3(0.0, 0.0, 2.0), None, &PLAIN).unwrap();
        assert_eq!(c.aabb().low, vec3(0.5, 1.5, 1.0));
        assert_eq!(c.aabb().high, vec3(1.5, 2.5, 5.0));
        assert_eq!(c.convex().unwrap().normals().len(), 5);
        assert_eq!(c.convex().unwrap().edges().len(), 5);
        assert_eq!(c.world_mesh().open_edges(), 0);
    }

    #[test]
    fn the_tapered_end_points_along_the_axis() {
        let size = vec3(2.0, 4.0, 6.0);
        for axis in 0..3 {
            let b = Shape::tapered_box(Vec3::ZERO, size, 0.5, axis, &PLAIN).unwrap();
            assert_eq!(b.aabb().extent(), size);
            let convex = b.convex().unwrap();
            let top = convex.corners().iter().filter(|p| p[axis] > 0.0);
            let other = (axis + 1) % 3;
            assert!(top.into_iter().all(|p| p[other].abs() == 0.25 * size[other]));
        }
    }

    #[test]
    fn a_cone_and_a_pyramid_close() {
        let cone = Shape::cylinder(Vec3::ZERO, 1.0, 1.0, vec3(0.0, 1.0, 0.0), Some(0.0), &PLAIN).unwrap();
        let pyramid = Shape::tapered_box(Vec3::ZERO, vec3(1.0, 1.0, 1.0), 0.0, 2, &PLAIN).unwrap();
        for shape in [cone, pyramid] {
            assert_eq!(shape.world_mesh().open_edges(), 0);
        }
    }

    #[test]
    fn limbs_that_name_the_same_ring_share_its_vertices() {
        let (a, b, c) = (vec3(0.0, 0.0, 0.0), vec3(0.1, 2.0, 0.0), vec3(0.7, 3.8, 0.5));
        let n = vec3(0.2, 1.0, 0.1);
        let low = Shape::limb(a, b, (0.5, 0.4), (None, Some(n)), &PLAIN).unwrap();
        let high = Shape::limb(b, c, (0.4, 0.3), (Some(n), None), &PLAIN).unwrap();
        assert_eq!(low.convex().unwrap().corners()[10..], high.convex().unwrap().corners()[..10]);
        assert_eq!(low.world_mesh().open_edges(), 0);
    }

    #[test]
    fn impossible_shapes_are_refused() {
        let size = vec3(1.0, -1.0, 1.0);
        let error = Shape::cuboid(Vec3::ZERO, size, &PLAIN).unwrap_err();
        assert_eq!(error.to_string(), "the size of a box is -1, expected a positive number");
        assert!(Shape::cuboid(vec3(f64::NAN, 0.0, 0.0), vec3(1.0, 1.0, 1.0), &PLAIN).is_err());
        assert!(Shape::cylinder(Vec3::ZERO, 1.0, 1.0, Vec3::ZERO, None, &PLAIN).is_err());
        let error = Shape::limb(Vec3::ZERO, Vec3::ZERO, (1.0, 1.0), (None, None), &PLAIN).unwrap_err();
        assert_eq!(error.to_string(), "the start and the end of a limb are the same point, [0.0, 0.0, 0.0]");
        let skew = Look {
            rotation: Some(Mat3::from_rows([[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])),
            ..PLAIN
        };
        assert!(Shape::cuboid(Vec3::ZERO, vec3(1.0, 1.0, 1.0), &skew).is_err());
        assert!(TriMesh::new(vec![], vec![]).is_err());
    }

    #[test]
    fn a_mesh_far_from_its_origin_turns_about_its_middle() {
        let corner = |far: f64| {
            [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]
                .map(|p| vec3(far, 0.0, 0.0) + Vec3::from(p))
        };
        for (far, expected) in [(190.0, vec3(1.0, 2.0, 3.0)), (210.0, vec3(212.0, 3.0, 4.0))] {
            let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
            let mesh = Arc::new(TriMesh::new(corner(far).to_vec(), faces).unwrap());
            let shape = Shape::mesh(&mesh, vec3(1.0, 2.0, 3.0), 1.0, &PLAIN).unwrap();
            assert_eq!(shape.frame().translation, expected);
        }
    }
}
