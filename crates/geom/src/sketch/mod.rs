//! Sketches: summaries of a scene that inference scores, updated shape by shape.
//!
//! A sketch keeps sums of integers or order statistics, so its score is the same to the bit for every order of adding,
//! and adding then removing restores the old sketch.
//!
//! - [`volume`], over [`counters`]: fill a target's volume
//! - [`picture`], over [`tiles`]: look like a picture, or cast a shadow like one
//! - [`intersection`]: parts must not run into each other
//! - [`avoid`], [`floor`]: keep out of an obstacle, stay above a floor
//! - [`overshoot`]: stay inside of a box
//! - [`bag`]: the primitives of a sketch
//! - [`product`]: several sketches of one scene

pub mod avoid;
pub mod bag;
pub mod brick;
pub mod counters;
pub mod floor;
pub mod intersection;
pub mod overshoot;
pub mod picture;
pub mod product;
pub mod tiles;
pub mod volume;

use crate::error::GeomError;
use crate::primitive::Primitive;
use crate::tree::{BoxTree, Boxed};
use std::any::Any;
use std::sync::Arc;

/// A running score of a bag of primitives.
pub trait Sketch: Copied + Any + Send + Sync {
    /// Its name for people, for example `no_self_intersection`.
    fn name(&self) -> &'static str;
    /// Adds a primitive to the bag.
    fn add(&mut self, primitive: &Primitive);
    /// Removes one primitive equal to this from the bag; false, and nothing changed, when there is none.
    fn remove(&mut self, primitive: &Primitive) -> bool;
    /// Prepares for removals: the data that they need is kept from now on, so that copies share it.
    fn expect_removals(&mut self) {}
    /// Log of the score of the bag, nats; negative infinity when it is forbidden.
    fn log_score(&self) -> f64;
    /// Named numbers behind the score, for people.
    fn measures(&self) -> Vec<(&'static str, f64)>;
}

/// What to score, given by the caller: creates the sketch of the empty scene.
pub trait SketchSpec: Send + Sync {
    /// Name of its sketch.
    fn name(&self) -> &'static str;
    /// The sketch of the empty scene.
    fn start(&self) -> Box<dyn Sketch>;
}

/// Copies of a sketch whose kind is not known: every sketch that can be cloned has them.
pub trait Copied {
    /// A copy that shares all unchanged data.
    fn fork(&self) -> Box<dyn Sketch>;
    /// Becomes a copy of `other`, in place and sharing as `fork` does; false, and nothing changed, when that is another
    /// kind of sketch.
    fn become_copy(&mut self, other: &dyn Sketch) -> bool;
}

impl<T: Sketch + Clone> Copied for T {
    fn fork(&self) -> Box<dyn Sketch> {
        Box::new(self.clone())
    }

    fn become_copy(&mut self, other: &dyn Sketch) -> bool {
        let other: &dyn Any = other;
        other.downcast_ref::<T>().map(|other| self.clone_from(other)).is_some()
    }
}

/// Makes both the same. A reference that all sketches of a search share is not written again: its count would make
/// every processor that reads it wait.
#[inline]
pub(crate) fn share<T>(to: &mut Arc<T>, from: &Arc<T>) {
    if !Arc::ptr_eq(to, from) {
        to.clone_from(from);
    }
}

/// Equality of bags: every primitive of one is in the other as often.
pub(crate) fn same_bag<T: Clone + Boxed>(
    a: &BoxTree<T>,
    b: &BoxTree<T>,
    of: impl Fn(&T) -> &Primitive,
) -> bool {
    let mut rest = a.clone();
    let mut same = a.len() == b.len();
    b.each(|item| same = same && rest.remove(item.aabb(), |p| of(p) == of(item)).is_some());
    same
}

/// ln N(x; mean, sd), nats.
pub(crate) fn log_normal(x: f64, mean: f64, sd: f64) -> f64 {
    const HALF_LOG_TAU: f64 = 0.918_938_533_204_672_8;
    let z = (x - mean) / sd;
    -HALF_LOG_TAU - sd.ln() - 0.5 * z * z
}

/// Refuses a standard deviation that is not valid: `bad-setting`.
pub(crate) fn check_sigma(sigma: f64) -> Result<(), GeomError> {
    if sigma > 0.0 && sigma.is_finite() {
        return Ok(());
    }
    Err(GeomError::new("bad-setting", format!("sigma is {sigma}, expected a positive number")))
}
