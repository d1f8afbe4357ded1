//! Flat shapes as solids: plates parallel to the plane z = 0, a tenth as thick as they are wide.
//!
//! Plates serve for exports, prints and reliefs of a drawing. The drawing itself never uses them.

use crate::bounds::Aabb;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::{Vec3, vec3};
use std::f64::consts::TAU;

/// Half the thickness of a plate, as a share of the smallest half width of its shape.
const THICK: f64 = 0.1;
/// Sides of a whole turn of the coarse mesh.
const COARSE: usize = 16;
/// Sides of a whole turn of the fine mesh.
const FINE: usize = 64;

/// A solid on a plane parallel to z = 0.
pub(super) trait Flat {
    /// The smallest half width, scene units.
    fn half_width(&self) -> f64;
    /// The box around its outline in the world, without thickness.
    fn reach(&self, placement: &Placement) -> Aabb;
    /// The outline's corners, counter-clockwise seen from +z, in its own coordinates; `sides` for a whole turn.
    fn corners(&self, sides: usize) -> Vec<Vec3>;
}

/// The box around the plate of a flat solid, in the world.
///
/// # Errors
/// `bad-shape` for a shape that is turned out of its plane.
pub(super) fn aabb(flat: &impl Flat, placement: &Placement) -> Result<Aabb, GeomError> {
    let up = Vec3::AXES[2];
    if (placement.rotation.apply(up) - up).norm() > 1e-6 {
        return bad(
            "a flat shape lies on a plane parallel to z = 0, its rotation turns it out of that".into()
        );
    }
    let (boxed, thick) = (flat.reach(placement), vec3(0.0, 0.0, THICK * flat.half_width()));
    Ok(Aabb { low: boxed.low - thick, high: boxed.high + thick })
}

/// Points of a circle from the angle `from` on; an arc has both its ends.
pub(super) fn arc(center: Vec3, radius: f64, from: f64, angle: f64, steps: usize) -> Vec<Vec3> {
    (0..steps + usize::from(angle < TAU))
        .map(|k| {
            let (sin, cos) = (from + angle * k as f64 / steps as f64).sin_cos();
            center + vec3(cos, sin, 0.0) * radius
        })
        .collect()
}

/// The plate in the world.
pub(super) fn coarse(flat: &impl Flat, placement: &Placement) -> Result<TriMesh, GeomError> {
    plate(flat, COARSE).map(|mesh| mesh.map(|p| placement.apply(p)))
}

/// The plate with many sides, in its own coordinates.
pub(super) fn fine(flat: &impl Flat) -> FineMesh {
    plate(flat, FINE).map_or_else(|_| FineMesh::default(), |mesh| crease::creased(&mesh, crease::SHARP))
}

fn plate(flat: &impl Flat, sides: usize) -> Result<TriMesh, GeomError> {
    let (corners, thick) = (flat.corners(sides), THICK * flat.half_width());
    let n = corners.len() as u32;
    let level = |by: f64| corners.iter().map(move |p| vec3(p.x, p.y, p.z + by));
    let mut faces = Vec::with_capacity(4 * corners.len());
    for k in 1..n.saturating_sub(1) {
        faces.extend([[0, k + 1, k], [n, n + k, n + k + 1]]);
    }
    for k in 0..n {
        let next = (k + 1) % n;
        faces.extend([[k, next, n + next], [k, n + next, n + k]]);
    }
    TriMesh::new(level(-thick).chain(level(thick)).collect(), faces)
}

#[cfg(test)]
mod tests {
    //! A flat shape is a closed plate as large as its outline, and lies in its plane.
    use super::*;
    use crate::look::Look;
    use crate::solids::shape::Shape;
    use crate::solids::{Ellipse, Solid};
    use crate::vector::Mat3;
    use std::f64::consts::PI;

    fn volume(mesh: &TriMesh) -> f64 {
        mesh.corners().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn plates_close_and_fill_their_outlines() {
        let look = Look::default();
        let at = |x: f64, y: f64| vec3(x, y, 0.5);
        for (shape, area, width) in [
            (Shape::stroke(at(1.0, 2.0), at(4.0, 6.0), (1.0, 1.0), &look), 5.0 + PI / 4.0, 1.0),
            (Shape::stroke(at(1.0, 2.0), at(1.1, 2.0), (1.0, 3.0), &look), 9.0 * PI / 4.0, 1.0),
            (Shape::ellipse(at(0.0, 0.0), (4.0, 1.0), 0.7, &look), PI, 1.0),
        ] {
            let shape = shape.unwrap();
            let mesh = shape.world_mesh();
            assert_eq!(mesh.open_edges(), 0);
            let filled = volume(&mesh) / (area * width * THICK);
            assert!((0.9..1.0).contains(&filled), "{} {filled}", shape.kind());
            assert!(shape.aabb().grown(1e-12).contains(&mesh.aabb()));
            assert!((shape.aabb().center().z - 0.5).abs() < 1e-12);
            assert!(shape.convex().is_none() && !shape.is_convex());
        }
    }

    #[test]
    fn flat_shapes_stay_in_their_plane() {
        let (look, a) = (Look::default(), vec3(0.0, 0.0, 0.0));
        let skew = Shape::stroke(a, vec3(1.0, 0.0, 0.1), (1.0, 1.0), &look).unwrap_err();
        assert!(skew.message.contains("expected the same"), "{skew}");
        let solid = Solid::Ellipse(Ellipse { size: [1.0, 1.0] });
        let turned = Placement { rotation: Mat3::rotation(Vec3::AXES[0], 1.0), translation: a };
        assert!(Shape::new(solid, turned, &Look::default()).is_err());
        assert!(Shape::stroke(a, a, (0.0, 1.0), &look).is_err());
        assert!(Shape::ellipse(a, (1.0, -1.0), 0.0, &look).is_err());
        assert!(Shape::stroke(a, a, (1.0, 1.0), &look).is_ok(), "a dot");
    }
}
