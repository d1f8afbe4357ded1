//! A primitive: the shapes of one `emit`. One barrier, one score; its shapes are never tested against each other.

use crate::bounds::Aabb;
use crate::shape::Shape;
use std::sync::Arc;

/// The shapes of one `emit`. Cloning shares them.
#[derive(Clone, Debug)]
pub struct Primitive {
    shapes: Arc<[Shape]>,
    aabb: Aabb,
}

impl Primitive {
    /// A primitive of `shapes`, in order.
    pub fn new(shapes: impl Into<Arc<[Shape]>>) -> Primitive {
        let shapes = shapes.into();
        let aabb = shapes.iter().fold(Aabb::EMPTY, |b, s| b.union(s.aabb()));
        Primitive { shapes, aabb }
    }

    /// The shapes.
    #[inline]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// The smallest box around all of them.
    #[inline]
    pub fn aabb(&self) -> &Aabb {
        &self.aabb
    }
}

impl PartialEq for Primitive {
    fn eq(&self, other: &Primitive) -> bool {
        Arc::ptr_eq(&self.shapes, &other.shapes) || (self.aabb == other.aabb && self.shapes == other.shapes)
    }
}
