//! Convex solids by separating axes: two are apart exactly when their shadows on some face normal, or on some
//! product of two edges, are apart (Gottschalk, Lin & Manocha 1996).
//!
//! The smallest overlap over all these directions is the distance that separates the two; up to a tolerance they
//! only touch.

use crate::bounds::Aabb;
use crate::convex::{Convex, span};
use crate::vector::Vec3;

/// True when the boxes overlap by no more than `tolerance` along some coordinate.
#[inline]
pub fn boxes_apart(a: &Aabb, b: &Aabb, tolerance: f64) -> bool {
    let apart = |axis: usize| (a.high[axis] - b.low[axis]).min(b.high[axis] - a.low[axis]) <= tolerance;
    apart(0) || apart(1) || apart(2)
}

/// True when the solids overlap by no more than `tolerance` along a face normal of either.
pub fn faces_apart(a: &Convex<'_>, b: &Convex<'_>, tolerance: f64) -> bool {
    // The end faces come last, and flush shapes usually touch there.
    a.normals().iter().rev().chain(b.normals().iter().rev()).any(|n| apart(a, b, *n, tolerance))
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
            // Edges parallel to a millionth: what they could separate, a face normal does.
            if length > 1e-6 && apart(a, b, product * (1.0 / length), tolerance) {
                return false;
            }
        }
    }
    true
}

fn apart(a: &Convex<'_>, b: &Convex<'_>, axis: Vec3, tolerance: f64) -> bool {
    let ((a_low, a_high), (b_low, b_high)) = (span(a.corners(), axis), span(b.corners(), axis));
    (a_high - b_low).min(b_high - a_low) <= tolerance
}
