//! Two boxes in any direction, by their fifteen axes: three normals of each, and the nine products of their edges
//! (Gottschalk, Lin & Manocha 1996).
//!
//! With `t` the way from one middle to the other, and `g` and `h` the half sides of the two as vectors, the boxes overlap along a
//! direction `n` by
//!
//! ```text
//! sum_i |g_i . n| + sum_j |h_j . n| - |t . n|
//! ```
//!
//! This is the overlap of the spans of their corners, without corners. [`super::axes`] has the rule for all convex solids. The
//! two may differ if the overlap is the tolerance to within rounding.

use super::axes::PARALLEL;
use crate::solids::shape::Shape;
use crate::solids::{Cuboid, Solid};
use crate::vector::{Mat3, Vec3};

/// A box in any direction.
#[derive(Clone, Copy, Debug)]
pub struct Turned<'a> {
    half: Vec3,
    middle: Vec3,
    rotation: &'a Mat3,
}

/// Half sides as vectors, and their directions.
struct Sides {
    half: [Vec3; 3],
    directions: [Vec3; 3],
}

impl Sides {
    #[inline]
    fn of(turned: &Turned<'_>) -> Sides {
        let directions = turned.rotation.columns;
        Sides { half: [0, 1, 2].map(|i| directions[i] * turned.half[i]), directions }
    }

    /// Half the box's extent along `n`, times the length of `n`.
    #[inline]
    fn reach(&self, n: Vec3) -> f64 {
        let [x, y, z] = &self.half;
        x.dot(n).abs() + y.dot(n).abs() + z.dot(n).abs()
    }

    /// Half the box's extent along `n`, at right angles to side `i`, times the length of `n`.
    #[inline]
    fn reach_across(&self, i: usize, n: Vec3) -> f64 {
        self.half[(i + 1) % 3].dot(n).abs() + self.half[(i + 2) % 3].dot(n).abs()
    }
}

impl<'a> Turned<'a> {
    /// The box of a shape; `None` for other solids.
    #[inline]
    pub fn of(shape: &'a Shape) -> Option<Turned<'a>> {
        match shape.solid() {
            Solid::Box(Cuboid { size }) => {
                let (half, middle, rotation) = (*size * 0.5, shape.translation(), shape.rotation());
                Some(Turned { half, middle, rotation })
            }
            _ => None,
        }
    }

    /// True when both boxes overlap by more than `tolerance`, scene units, in every direction. Symmetric in floating point.
    pub fn overlaps(&self, other: &Turned<'_>, tolerance: f64) -> bool {
        let (a, b) = (Sides::of(self), Sides::of(other));
        let apart = other.middle - self.middle;
        let by_face = |n: &Vec3| a.reach(*n) + b.reach(*n) - apart.dot(*n).abs() <= tolerance;
        if a.directions.iter().any(by_face) || b.directions.iter().any(by_face) {
            return false;
        }
        for (i, p) in a.directions.iter().enumerate() {
            for (j, q) in b.directions.iter().enumerate() {
                let n = p.cross(*q);
                let overlap = a.reach_across(i, n) + b.reach_across(j, n) - apart.dot(n).abs();
                // A product of unit vectors is at most 1 long, so most tests need no length.
                if overlap > 2.0 * tolerance {
                    continue;
                }
                let length = n.norm();
                if length > PARALLEL && overlap <= tolerance * length {
                    return false;
                }
            }
        }
        true
    }
}
