//! The placement of a solid: solids are made around the origin, then turned, then moved.

use crate::error::{GeomError, bad_shape as bad};
use crate::vector::{Mat3, Vec3};
use serde::{Deserialize, Serialize};

/// A turn, followed by a move.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Placement {
    /// A rotation.
    pub rotation: Mat3,
    /// The move, scene units.
    pub translation: Vec3,
}

impl Placement {
    /// No movement.
    pub const IDENTITY: Placement = Placement { rotation: Mat3::IDENTITY, translation: Vec3::ZERO };

    /// Refuses numbers that are not finite, and a matrix that is no rotation.
    #[inline]
    pub(crate) fn check(&self) -> Result<(), GeomError> {
        if !self.translation.is_finite() {
            return bad(format!("the centre is {:?}, expected finite numbers", self.translation.to_array()));
        }
        let defect = self.rotation.defect();
        if defect.is_nan() || defect > 1e-6 {
            return bad(format!("the rotation is not a rotation: it is off by {defect}"));
        }
        Ok(())
    }

    /// From the solid's own coordinates to the world's.
    #[inline]
    pub fn apply(&self, p: Vec3) -> Vec3 {
        self.rotation.apply(p) + self.translation
    }

    /// The placement by `inner`, followed by this placement.
    pub fn after(&self, inner: &Placement) -> Placement {
        Placement {
            rotation: self.rotation.after(&inner.rotation),
            translation: self.apply(inner.translation),
        }
    }
}
