//! No self-intersection: the number of pairs of primitives that intersect must be zero.
//!
//! Pieces of one primitive are not tested against each other. A tree of boxes that copies share finds the few
//! primitives near a new one, so that the cost does not grow with distant primitives.

use super::bag::same_bag;
use super::form::Forbids;
use super::score::{Sketch, SketchSpec};
use crate::intersect::{Rule, primitives_intersect};
use crate::solids::primitive::Primitive;
use crate::tree::BoxTree;
use std::sync::Arc;

/// The texts for forbidden scenes.
pub(super) const FORBIDS: Forbids = Forbids {
    part: "runs into another part",
    cure: "put parts that belong together into one `emit`, or leave a gap between them",
};

/// Forbids scenes in which two primitives intersect by `rule`.
pub fn no_self_intersection(rule: Rule) -> Arc<dyn SketchSpec> {
    Arc::new(NoSelfIntersection::new(rule))
}

impl SketchSpec for NoSelfIntersection {
    fn name(&self) -> &'static str {
        "no_self_intersection"
    }

    fn most(&self) -> f64 {
        0.0
    }
}

/// The primitives so far, and the count of pairs that intersect.
#[derive(Clone, Debug)]
pub struct NoSelfIntersection {
    rule: Rule,
    boxes: BoxTree<Primitive>,
    pairs: u64,
}

impl NoSelfIntersection {
    /// The empty scene.
    pub fn new(rule: Rule) -> NoSelfIntersection {
        NoSelfIntersection { rule, boxes: BoxTree::default(), pairs: 0 }
    }

    /// Number of pairs of primitives that intersect.
    pub fn pairs(&self) -> u64 {
        self.pairs
    }

    fn pairs_with(&self, primitive: &Primitive) -> u64 {
        let mut pairs = 0;
        self.boxes
            .visit(primitive.aabb(), |p| pairs += u64::from(primitives_intersect(p, primitive, self.rule)));
        pairs
    }
}

impl PartialEq for NoSelfIntersection {
    fn eq(&self, other: &NoSelfIntersection) -> bool {
        (self.rule, self.pairs) == (other.rule, other.pairs) && same_bag(&self.boxes, &other.boxes, |p| p)
    }
}

impl Sketch for NoSelfIntersection {
    fn add(&mut self, primitive: &Primitive) {
        self.pairs += self.pairs_with(primitive);
        self.boxes.insert(primitive.clone());
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        if self.boxes.remove(primitive.aabb(), |p| p == primitive).is_none() {
            return false;
        }
        self.pairs -= self.pairs_with(primitive);
        true
    }

    fn log_score(&self) -> f64 {
        if self.pairs == 0 { 0.0 } else { f64::NEG_INFINITY }
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("intersecting_pairs", self.pairs as f64)]
    }
}
