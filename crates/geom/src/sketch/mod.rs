//! Sketches: summaries of a scene that inference scores, updated shape by shape (design section 4).
//!
//! What a sketch keeps is a sum of integers or an order statistic, so its score is the same to the bit whatever the
//! order of adding, and adding then removing gives the old sketch back.
//!
//! - [`volume`], over [`counters`]: fill a target's volume
//! - [`intersection`]: parts must not run into each other
//! - [`product`]: several sketches of one scene

pub mod counters;
pub mod intersection;
pub mod product;
pub mod volume;

use crate::primitive::Primitive;
use crate::tree::BoxTree;

/// A running score of a bag of primitives.
pub trait Sketch: Send + Sync {
    /// The name a person knows it by, e.g. `no_self_intersection`.
    fn name(&self) -> &'static str;
    /// Puts a primitive into the bag.
    fn add(&mut self, primitive: &Primitive);
    /// Takes one primitive equal to this out of the bag; false, and nothing changed, when there is none.
    fn remove(&mut self, primitive: &Primitive) -> bool;
    /// Log of the score of the bag, nats; negative infinity when it is forbidden.
    fn log_score(&self) -> f64;
    /// A copy that shares what neither changes.
    fn fork(&self) -> Box<dyn Sketch>;
    /// Named numbers behind the score, for people.
    fn measures(&self) -> Vec<(&'static str, f64)>;
}

/// What to score, given by the caller: makes the sketch of the empty scene.
pub trait SketchSpec: Send + Sync {
    /// Name of the sketch it makes.
    fn name(&self) -> &'static str;
    /// The sketch of the empty scene.
    fn start(&self) -> Box<dyn Sketch>;
}

/// Equality of bags: every item of one is in the other as often.
pub(crate) fn same_bag(a: &BoxTree<Primitive>, b: &BoxTree<Primitive>) -> bool {
    let mut rest = a.clone();
    let mut same = a.len() == b.len();
    b.each(|aabb, primitive| same = same && rest.remove(aabb, |p| p == primitive).is_some());
    same
}
