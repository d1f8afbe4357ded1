//! Floors: no shape may reach below a height. Touching is allowed.
//!
//! The original's setting of object avoidance (a scene with any vertex below the floor scores zero), as a separate
//! sketch. Touching has the tolerance of intersections: a millionth of a shape's thickness.

use super::bag::Bag;
use super::form::Forbids;
use super::score::{Sketch, SketchSpec};
use crate::error::GeomError;
use crate::intersect::SOLID_TOLERANCE;
use crate::solids::primitive::Primitive;
use crate::solids::shape::Shape;
use std::sync::Arc;

/// The texts for forbidden scenes.
pub(super) const FORBIDS: Forbids = Forbids {
    part: "reaches below the floor",
    cure: "move the floor below the model's first part, or start the model above it",
};

/// Forbids scenes that reach below `height`, scene units along y.
///
/// # Errors
/// `bad-setting` when the height is not finite.
pub fn floor(height: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    if !height.is_finite() {
        let message = format!("the floor is at {height}, expected a finite number");
        return Err(GeomError::new("bad-setting", message));
    }
    Ok(Arc::new(Floor { height, below: 0, bag: Bag::default() }))
}

impl SketchSpec for Floor {
    fn name(&self) -> &'static str {
        "floor"
    }

    fn most(&self) -> f64 {
        0.0
    }
}

/// The count of shapes below the floor.
#[derive(Clone, Debug)]
pub struct Floor {
    height: f64,
    below: u64,
    bag: Bag,
}

impl Floor {
    fn below(&self, primitive: &Primitive) -> u64 {
        let under = |s: &&Shape| s.aabb().low.y < self.height - SOLID_TOLERANCE * s.thickness();
        primitive.shapes().iter().filter(under).count() as u64
    }
}

impl PartialEq for Floor {
    fn eq(&self, other: &Floor) -> bool {
        (self.height, self.below) == (other.height, other.below) && self.bag == other.bag
    }
}

impl Sketch for Floor {
    fn add(&mut self, primitive: &Primitive) {
        self.below += self.below(primitive);
        self.bag.add(primitive, || ());
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let removed = self.bag.remove(primitive, || ()).is_some();
        if removed {
            self.below -= self.below(primitive);
        }
        removed
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn log_score(&self) -> f64 {
        if self.below == 0 { 0.0 } else { f64::NEG_INFINITY }
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("below_floor", self.below as f64)]
    }
}
