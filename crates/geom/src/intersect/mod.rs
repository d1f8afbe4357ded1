//! Do two shapes intersect? Touching never counts, so that parts can be built flush.
//!
//! - [`axes`]: convex solids, by separating axes
//! - [`triangles`]: surfaces, triangle by triangle
//! - [`inside`]: containment in a closed mesh
//!
//! Two rules. *Solid*: the insides overlap by more than a millionth of the thinner solid; one inside the other
//! counts. *Surface*: the surfaces cross, as the original tests it; containment and overlap of equal cross-sections
//! are not seen. Use it to compare with the published figures.

pub mod axes;
pub mod inside;
pub mod triangles;

use crate::primitive::Primitive;
use crate::shape::Shape;
use std::slice::from_ref;
use triangles::Crossing;

/// What counts as an intersection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Insides overlap.
    Solid,
    /// Surfaces cross (dissertation chapter 5's test).
    Surface,
}

/// Share of the thinner solid's thickness by which solids must overlap.
pub const SOLID_TOLERANCE: f64 = 1e-6;
/// Below this share, convex solids are apart under the surface rule without looking at triangles.
const APART: f64 = 1e-9;

/// True when any shape of one intersects any shape of the other.
pub fn primitives_intersect(a: &Primitive, b: &Primitive, rule: Rule) -> bool {
    a.shapes().iter().any(|s| b.shapes().iter().any(|t| intersects(s, t, rule)))
}

/// True when the shapes intersect. Every step is symmetric in floating point too, so (b, a) has the same answer.
pub fn intersects(a: &Shape, b: &Shape, rule: Rule) -> bool {
    if !a.aabb().meets(b.aabb()) {
        return false;
    }
    let thickness = a.thickness().min(b.thickness());
    match (rule, a.convex(), b.convex()) {
        (Rule::Solid, Some(p), Some(q)) => {
            let tolerance = SOLID_TOLERANCE * thickness;
            if axes::boxes_apart(a.aabb(), b.aabb(), tolerance) {
                return false;
            }
            if p.is_aligned_box() && q.is_aligned_box() {
                return true;
            }
            !axes::faces_apart(p, q, tolerance) && {
                let (p, q) = (a.pieces().unwrap_or(from_ref(p)), b.pieces().unwrap_or(from_ref(q)));
                p.iter().any(|p| q.iter().any(|q| axes::overlap(p, q, tolerance)))
            }
        }
        (Rule::Solid, _, _) => {
            let tolerance = SOLID_TOLERANCE * thickness;
            !axes::boxes_apart(a.aabb(), b.aabb(), tolerance)
                && (triangles::cross(a, b, Crossing::Deeper(tolerance)) || inside::overlap(a, b))
        }
        (Rule::Surface, Some(p), Some(q)) => {
            let tolerance = APART * thickness;
            !axes::boxes_apart(a.aabb(), b.aabb(), tolerance)
                && !axes::faces_apart(p, q, tolerance)
                && triangles::cross(a, b, Crossing::Original)
        }
        (Rule::Surface, _, _) => triangles::cross(a, b, Crossing::Original),
    }
}
