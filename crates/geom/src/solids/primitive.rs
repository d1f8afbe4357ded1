//! Primitives: the shapes of one `emit`, with one barrier and one score. Shapes of a primitive never intersect each other.

use crate::bounds::Aabb;
use crate::solids::shape::Shape;
use crate::tree::Boxed;
use std::sync::Arc;

/// The shapes of one `emit`. Cloning shares them.
#[derive(Clone, Debug)]
pub struct Primitive(Held);

/// Most primitives are one shape, which is shared already.
#[derive(Clone, Debug)]
enum Held {
    Single(Shape),
    Several(Arc<Several>),
}

#[derive(Debug, PartialEq)]
struct Several {
    aabb: Aabb,
    shapes: Box<[Shape]>,
}

impl Primitive {
    /// A primitive of `shapes`, in order.
    pub fn new(shapes: impl AsRef<[Shape]>) -> Primitive {
        Primitive(match shapes.as_ref() {
            [shape] => Held::Single(shape.clone()),
            shapes => {
                let aabb = shapes.iter().fold(Aabb::EMPTY, |b, s| b.union(s.aabb()));
                Held::Several(Arc::new(Several { aabb, shapes: shapes.into() }))
            }
        })
    }

    /// The shapes.
    #[inline]
    pub fn shapes(&self) -> &[Shape] {
        match &self.0 {
            Held::Single(shape) => std::slice::from_ref(shape),
            Held::Several(several) => &several.shapes,
        }
    }

    /// The smallest box around all shapes.
    #[inline]
    pub fn aabb(&self) -> &Aabb {
        match &self.0 {
            Held::Single(shape) => shape.aabb(),
            Held::Several(several) => &several.aabb,
        }
    }
}

impl Boxed for Primitive {
    #[inline]
    fn aabb(&self) -> &Aabb {
        Primitive::aabb(self)
    }
}

impl PartialEq for Primitive {
    fn eq(&self, other: &Primitive) -> bool {
        match (&self.0, &other.0) {
            (Held::Single(a), Held::Single(b)) => a == b,
            (Held::Several(a), Held::Several(b)) => Arc::ptr_eq(a, b) || a == b,
            _ => false,
        }
    }
}
