//! Intersection of two shapes. Touching never counts, so that parts can be built flush.
//!
//! - [`axes`]: convex solids, by separating axes
//! - [`boxes`]: two boxes by separating axes, from their middles and sides
//! - [`triangles`]: surfaces, triangle by triangle
//! - [`inside`]: containment in a closed mesh
//!
//! There are two rules. *Solid*: the insides overlap by more than a millionth of the thinner solid; a solid inside of another
//! counts. *Surface*: the surfaces cross, by the test of the original; containment and overlap of equal cross-sections
//! are not detected. Use it to compare with the published figures.

pub mod axes;
pub mod boxes;
pub mod inside;
pub mod triangles;

use crate::convex::Convex;
use crate::solids::Solid;
use crate::solids::primitive::Primitive;
use crate::solids::shape::Shape;
use boxes::Turned;
use serde::Deserialize;
use triangles::Crossing;

/// A rule of intersection.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// Insides overlap.
    Solid,
    /// Surfaces cross (dissertation chapter 5's test).
    Surface,
}

/// Share of the thinner solid's thickness by which solids must overlap.
pub const SOLID_TOLERANCE: f64 = 1e-6;
/// The distance from a shape at which a round joint lies in it, as a share of the joint's radius.
const JOINT: f64 = 1e-6;
/// The share of overlap below which convex solids are apart under the surface rule, without a test of triangles.
const APART: f64 = 1e-9;

/// True when a shape of `a` intersects a shape of `b`.
pub fn primitives_intersect(a: &Primitive, b: &Primitive, rule: Rule) -> bool {
    a.shapes().iter().any(|s| b.shapes().iter().any(|t| intersects(s, t, rule)))
}

/// True when a limb begins in the other shape with a round joint: such neighbours may overlap.
fn are_joined(a: &Shape, b: &Shape) -> bool {
    let begins_in = |limb: &Shape, other: &Shape| match limb.solid() {
        Solid::Limb(solid) if solid.round => {
            let start = limb.placement().apply(solid.rings[0].center);
            // A limb at the end of another begins on the last face.
            match other.convex() {
                Some(convex) => axes::reaches(&convex, start, JOINT * solid.rings[0].radius),
                None => inside::contains(other, start),
            }
        }
        _ => false,
    };
    begins_in(a, b) || begins_in(b, a)
}

/// True when the shapes intersect. Every step is symmetric in floating point too, so (b, a) has the same answer.
pub fn intersects(a: &Shape, b: &Shape, rule: Rule) -> bool {
    if !a.aabb().meets(b.aabb()) || are_joined(a, b) {
        return false;
    }
    let thickness = a.thickness().min(b.thickness());
    let tolerance = thickness * if rule == Rule::Solid { SOLID_TOLERANCE } else { APART };
    let convex = a.is_convex() && b.is_convex();
    if (convex || rule == Rule::Solid) && axes::boxes_apart(a.aabb(), b.aabb(), tolerance) {
        return false;
    }
    if rule == Rule::Solid && a.is_aligned_box() && b.is_aligned_box() {
        return true;
    }
    if rule == Rule::Solid
        && let (Some(p), Some(q)) = (Turned::of(a), Turned::of(b))
    {
        return p.overlaps(&q, tolerance);
    }
    let (Some(p), Some(q)) = (a.convex(), b.convex()) else {
        return match rule {
            Rule::Solid => triangles::cross(a, b, Crossing::Deeper(tolerance)) || inside::overlap(a, b),
            Rule::Surface => triangles::cross(a, b, Crossing::Original),
        };
    };
    let between = b.aabb().center() - a.aabb().center();
    !axes::middles_apart(&p, &q, between, tolerance)
        && !axes::ends_apart(&p, &q, tolerance)
        && match rule {
            Rule::Solid => any_piece(&p, |p| any_piece(&q, |q| axes::overlap(p, q, tolerance))),
            Rule::Surface => {
                !axes::faces_apart(&p, &q, tolerance) && triangles::cross(a, b, Crossing::Original)
            }
        }
}

/// True when `f` holds for a convex piece of the solid.
fn any_piece(whole: &Convex<'_>, mut f: impl FnMut(&Convex<'_>) -> bool) -> bool {
    match whole.pieces() {
        Some(pieces) => pieces.iter().any(|piece| f(&Convex::Hull(piece))),
        None => f(whole),
    }
}
