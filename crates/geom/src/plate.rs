//! Flat shapes as solids: plates parallel to the plane z = 0, a tenth as thick as they are wide.
//!
//! So a drawing can also be exported, printed or shown as a relief. Drawings themselves never look at the plate.

use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::mesh::TriMesh;
use crate::ring::ring;
use crate::solid::{Placement, Round, Solid};
use crate::vector::{Vec3, vec3};
use std::f64::consts::TAU;

/// Half of a plate's thickness, as a share of the smallest half width of its shape.
const THICK: f64 = 0.1;
/// Sides of a whole turn of the coarse mesh.
pub(crate) const COARSE: usize = 16;
/// Sides of a whole turn of the fine mesh.
pub(crate) const FINE: usize = 64;

fn half_thickness(solid: &Solid) -> f64 {
    THICK
        * match solid {
            Solid::Stroke { ends } => ends[0].radius.min(ends[1].radius),
            Solid::Ellipse { size: [long, wide] } => 0.5 * long.min(*wide),
            _ => 0.0,
        }
}

/// The box around the plate of a flat solid, in the world; `None` for other solids.
pub(crate) fn aabb(solid: &Solid, placement: &Placement) -> Option<Aabb> {
    let boxed = match solid {
        Solid::Stroke { ends } => ends.iter().fold(Aabb::EMPTY, |boxed, end| {
            let (center, reach) = (placement.apply(end.center), vec3(end.radius, end.radius, 0.0));
            boxed.union(&Aabb { low: center - reach, high: center + reach })
        }),
        Solid::Ellipse { size: [long, wide] } => {
            // Half the extent along an axis is the length of what both half axes have along it.
            let u = placement.rotation.apply(vec3(0.5 * long, 0.0, 0.0));
            let v = placement.rotation.apply(vec3(0.0, 0.5 * wide, 0.0));
            let half = vec3((u.x * u.x + v.x * v.x).sqrt(), (u.y * u.y + v.y * v.y).sqrt(), 0.0);
            Aabb { low: placement.translation - half, high: placement.translation + half }
        }
        _ => return None,
    };
    let thick = vec3(0.0, 0.0, half_thickness(solid));
    Some(Aabb { low: boxed.low - thick, high: boxed.high + thick })
}

/// Refuses a flat shape that is turned out of its plane, and a stroke whose ends lie on two planes.
pub(crate) fn check(solid: &Solid, placement: &Placement) -> Result<(), GeomError> {
    let bad = |message: String| Err(GeomError::new("bad-shape", message));
    let up = Vec3::AXES[2];
    if (placement.rotation.apply(up) - up).norm() > 1e-6 {
        return bad(
            "a flat shape lies on a plane parallel to z = 0, its rotation turns it out of that".into()
        );
    }
    match solid {
        Solid::Stroke { ends } if ends[0].center.z != ends[1].center.z => bad(format!(
            "the ends of a stroke are at z = {} and {}, expected the same: it lies on one plane",
            ends[0].center.z, ends[1].center.z
        )),
        _ => Ok(()),
    }
}

/// The outline's corners, counter-clockwise seen from +z, in the solid's own coordinates.
fn corners(solid: &Solid, sides: usize) -> Vec<Vec3> {
    match solid {
        Solid::Stroke { ends } => {
            let [a, b] = **ends;
            let along = b.center - a.center;
            let length = along.norm();
            if length <= (a.radius - b.radius).abs() {
                let large = if a.radius > b.radius { a } else { b };
                return arc(&large, 0.0, TAU, sides);
            }
            // The straight sides touch both circles where their normals have this angle to the stroke.
            let (ahead, open) = (along.y.atan2(along.x), ((a.radius - b.radius) / length).acos());
            let mut all = arc(&b, ahead - open, 2.0 * open, sides / 2);
            all.extend(arc(&a, ahead + open, TAU - 2.0 * open, sides / 2));
            all
        }
        Solid::Ellipse { size: [long, wide] } => {
            ring(sides).map(|(sin, cos)| vec3(0.5 * long * cos, 0.5 * wide * sin, 0.0)).collect()
        }
        _ => Vec::new(),
    }
}

/// Points of a circle from the angle `from` on; of an arc both ends.
fn arc(round: &Round, from: f64, angle: f64, steps: usize) -> Vec<Vec3> {
    (0..steps + usize::from(angle < TAU))
        .map(|k| {
            let (sin, cos) = (from + angle * k as f64 / steps as f64).sin_cos();
            round.center + vec3(cos, sin, 0.0) * round.radius
        })
        .collect()
}

/// The plate of a flat solid in its own coordinates.
///
/// # Errors
/// `bad-shape` for a solid that is not flat.
pub(crate) fn plate(solid: &Solid, sides: usize) -> Result<TriMesh, GeomError> {
    let (corners, thick) = (corners(solid, sides), half_thickness(solid));
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
    use crate::shape::Shape;
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
        let solid = Solid::Ellipse { size: [1.0, 1.0] };
        let turned = Placement { rotation: Mat3::rotation(Vec3::AXES[0], 1.0), translation: a };
        assert!(Shape::new(solid, turned, &Look::default()).is_err());
        assert!(Shape::stroke(a, a, (0.0, 1.0), &look).is_err());
        assert!(Shape::ellipse(a, (1.0, -1.0), 0.0, &look).is_err());
        assert!(Shape::stroke(a, a, (1.0, 1.0), &look).is_ok(), "a dot");
    }
}
