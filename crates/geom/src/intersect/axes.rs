//! Convex solids by separating axes: two are apart exactly when their shadows on some face normal, or on some
//! product of two edges, are apart (Gottschalk, Lin & Manocha 1996).
//!
//! The smallest overlap over all these directions is the distance that separates the two; up to a tolerance they
//! only touch.

use crate::bounds::Aabb;
use crate::convex::Convex;
use crate::polytope::span;
use crate::vector::Vec3;

/// The sine up to which edges count as parallel: a face normal separates what they could separate.
pub(super) const PARALLEL: f64 = 1e-6;

/// True when the boxes overlap by no more than `tolerance` along some coordinate.
#[inline]
pub fn boxes_apart(a: &Aabb, b: &Aabb, tolerance: f64) -> bool {
    let apart = |axis: usize| (a.high[axis] - b.low[axis]).min(b.high[axis] - a.low[axis]) <= tolerance;
    apart(0) || apart(1) || apart(2)
}

/// True when the solids overlap by no more than `tolerance` along `between`, the way from one middle to the other.
///
/// No overlap is smaller than the least overlap over face normals and products of edges. So this test decides nothing that
/// those would not, but it separates most solids that are apart.
pub fn middles_apart(a: &Convex<'_>, b: &Convex<'_>, between: Vec3, tolerance: f64) -> bool {
    between.unit().is_some_and(|way| apart(a, b, way, tolerance))
}

/// True when the solids overlap by no more than `tolerance` along a face normal of either.
pub fn faces_apart(a: &Convex<'_>, b: &Convex<'_>, tolerance: f64) -> bool {
    let [p, q] = [a, b].map(|solid| solid.normals().iter().rev());
    p.chain(q).any(|n| apart(a, b, *n, tolerance))
}

/// True when the solids overlap by no more than `tolerance` along one of the last face normals of either.
///
/// The end faces come last, and flush shapes usually touch there.
pub fn ends_apart(a: &Convex<'_>, b: &Convex<'_>, tolerance: f64) -> bool {
    let [p, q] = [a, b].map(|solid| solid.normals().iter().rev().take(2));
    p.chain(q).any(|n| apart(a, b, *n, tolerance))
}

/// True when the solids overlap by more than `tolerance`, scene units, in every direction.
pub fn overlap(a: &Convex<'_>, b: &Convex<'_>, tolerance: f64) -> bool {
    if faces_apart(a, b, tolerance) {
        return false;
    }
    for p in a.edges() {
        for q in b.edges() {
            let product = p.cross(*q);
            let length = product.norm();
            if length > PARALLEL && apart(a, b, product * (1.0 / length), tolerance) {
                return false;
            }
        }
    }
    true
}

/// True when the point is in the solid, or at most `tolerance` away from it along each of its face normals.
pub fn reaches(a: &Convex<'_>, p: Vec3, tolerance: f64) -> bool {
    a.normals().iter().all(|normal| {
        let ((low, high), along) = (span(a.corners(), *normal), p.dot(*normal));
        low - tolerance <= along && along <= high + tolerance
    })
}

/// True when the solids overlap by no more than `tolerance` along `axis`. The loop over the corners of the second solid ends
/// as soon as some are too far inside, from either end.
fn apart(a: &Convex<'_>, b: &Convex<'_>, axis: Vec3, tolerance: f64) -> bool {
    let (low, high) = span(a.corners(), axis);
    let (mut above, mut below) = (true, true);
    for p in b.corners() {
        let along = p.dot(axis);
        above &= high - along <= tolerance;
        below &= along - low <= tolerance;
        if !above && !below {
            return false;
        }
    }
    true
}
