//! Solids cut from other solids: `a - b` (a hole), `a & b` (what both have) and `a | b` (what either has).
//!
//! A cut is a tree whose leaves are placed solids without holes of this kind. It is kept flat, in postfix order, so that neither
//! its depth nor its length meets a recursion.
//!
//! - `sides`: what is known of the two sides of a piece of a face
//! - `leaf`: the faces of a leaf, and whether it contains a point
//! - `surface`: the surface of the cut, exact up to rounding, of pieces of the leaves' faces
//! - [`crate::voxel::cut`]: the cells of a grid that it fills
//!
//! Everything else reads this surface as that of a mesh: intersections, views, drawings, pictures. Its pieces meet without gaps but
//! not corner to corner, so a file gets its mesh from a library (`niwaki/draw/closed.py`).
//!
//! The result is regular: faces of two leaves that lie on one another leave no film between them, and leave no solid without an
//! inside (Tilove & Requicha 1980).

use super::leaf::Leaf;
use super::measured::{Checks, Form, Measured};
use super::shape::Shape;
use super::sides::Sides;
use super::surface;
use crate::bounds::Aabb;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::Vec3;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, OnceLock};

/// The most leaves of a cut.
pub const MOST: usize = 256;

/// An operation on two solids.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Operation {
    /// The first without the second: `a - b`.
    Difference,
    /// The common part: `a & b`.
    Intersection,
    /// Both: `a | b`.
    Union,
}

impl Operation {
    /// Its operator in the language.
    pub fn sign(self) -> &'static str {
        match self {
            Operation::Difference => "-",
            Operation::Intersection => "&",
            Operation::Union => "|",
        }
    }

    fn of(self, a: Sides, b: Sides) -> Sides {
        match self {
            Operation::Difference => a.and(b.not()),
            Operation::Intersection => a.and(b),
            Operation::Union => a.or(b),
        }
    }
}

/// A step of the tree in postfix order.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// The next leaf.
    Solid,
    /// The first without the second of the last two.
    Difference,
    /// The common part of the last two.
    Intersection,
    /// The last two together.
    Union,
}

impl Step {
    /// `solid`, or the operator in the language.
    pub fn sign(self) -> &'static str {
        self.operation().map_or("solid", Operation::sign)
    }

    fn operation(self) -> Option<Operation> {
        match self {
            Step::Solid => None,
            Step::Difference => Some(Operation::Difference),
            Step::Intersection => Some(Operation::Intersection),
            Step::Union => Some(Operation::Union),
        }
    }
}

impl From<Operation> for Step {
    fn from(operation: Operation) -> Step {
        match operation {
            Operation::Difference => Step::Difference,
            Operation::Intersection => Step::Intersection,
            Operation::Union => Step::Union,
        }
    }
}

/// A tree of solids, placed in the world.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(try_from = "Plain")]
pub struct Cut {
    solids: Vec<Shape>,
    steps: Vec<Step>,
    /// The leaves whose faces pictures show; all, unless the cut is a coat of paint ([`Shape::coats`]).
    #[serde(skip)]
    shown: Option<Vec<usize>>,
    /// The smallest box around its surface, computed when it is first used.
    #[serde(skip)]
    pub(super) aabb: OnceLock<Aabb>,
}

impl PartialEq for Cut {
    fn eq(&self, other: &Cut) -> bool {
        (&self.solids, &self.steps, &self.shown) == (&other.solids, &other.steps, &other.shown)
    }
}

/// The serialised form of a cut.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Plain {
    solids: Vec<Shape>,
    steps: Vec<Step>,
}

impl TryFrom<Plain> for Cut {
    type Error = GeomError;

    fn try_from(Plain { solids, steps }: Plain) -> Result<Cut, GeomError> {
        let cut = Cut { solids, steps, shown: None, aabb: OnceLock::new() };
        cut.check().map(|()| cut)
    }
}

impl Cut {
    /// Applies an operation to two solids, each a leaf or a cut.
    ///
    /// # Errors
    /// `bad-shape` for a flat shape, and beyond [`MOST`] leaves.
    pub fn new(operation: Operation, a: &Shape, b: &Shape) -> Result<Cut, GeomError> {
        let (mut solids, mut steps) = (Vec::new(), Vec::new());
        for shape in [a, b] {
            solids.extend_from_slice(shape.leaves());
            match shape.cut() {
                Some(cut) => steps.extend_from_slice(&cut.steps),
                None => steps.push(Step::Solid),
            }
        }
        steps.push(operation.into());
        let cut = Cut { solids, steps, shown: None, aabb: OnceLock::new() };
        cut.check().map(|()| cut)
    }

    /// Refuses what is no tree of solids.
    ///
    /// # Errors
    /// As for [`Cut::new`].
    pub(crate) fn check(&self) -> Result<(), GeomError> {
        if self.solids.len() > MOST {
            return bad(format!("{} solids are in one cut, expected at most {MOST}", self.solids.len()));
        }
        if let Some(flat) = self.solids.iter().find(|shape| shape.solid().is_flat()) {
            return bad(format!("the {} is flat, expected a solid", flat.kind()));
        }
        let mut depth = 0_usize;
        for step in &self.steps {
            depth = match step {
                Step::Solid => depth + 1,
                _ if depth >= 2 => depth - 1,
                _ => return bad("an operation without two solids".to_string()),
            };
        }
        let leaves = self.steps.iter().filter(|step| **step == Step::Solid).count();
        if depth != 1 || leaves != self.solids.len() || self.solids.iter().any(|shape| shape.cut().is_some())
        {
            return bad("the steps of a cut do not fit its solids".to_string());
        }
        Ok(())
    }

    /// The leaves, in the world, in the order of the expression.
    pub fn solids(&self) -> &[Shape] {
        &self.solids
    }

    /// The tree in postfix order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The leaf from which the rest is cut: the first.
    pub fn base(&self) -> &Shape {
        &self.solids[0]
    }

    /// The smallest box around the solids.
    pub(super) fn around_solids(&self) -> Aabb {
        self.solids.iter().fold(Aabb::EMPTY, |all, shape| all.union(shape.aabb()))
    }

    /// The cut in a frame, which may reflect it.
    pub(crate) fn placed(&self, placement: &Placement) -> Result<Cut, GeomError> {
        let solids = self.solids.iter().map(|shape| shape.in_frame(placement)).collect::<Result<_, _>>()?;
        Ok(Cut { solids, steps: self.steps.clone(), shown: self.shown.clone(), aabb: OnceLock::new() })
    }

    /// The cut of which pictures show the faces of these leaves only.
    pub(crate) fn showing(&self, shown: Vec<usize>) -> Cut {
        Cut { shown: Some(shown), ..self.clone() }
    }

    /// True if pictures show the faces of a leaf.
    pub(crate) fn shows(&self, leaf: usize) -> bool {
        self.shown.as_ref().is_none_or(|shown| shown.contains(&leaf))
    }

    /// Its bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        let leaves: usize = self.solids.iter().map(|shape| size_of::<Shape>() + shape.bytes()).sum();
        size_of::<Cut>() + leaves + size_of_val(&self.steps[..])
    }

    /// The tree's value for values of the leaves.
    pub(super) fn evaluate(&self, leaves: &[Sides]) -> Sides {
        let mut next = leaves.iter();
        self.fold(|| *next.next().expect("a value for each leaf"), Operation::of)
    }

    /// Its inside, to ask which points are there.
    pub(crate) fn interior(&self) -> Interior<'_> {
        Interior { cut: self, leaves: surface::coarse_leaves(self) }
    }

    /// Combines values of the leaves, taken in order.
    pub(crate) fn fold<T>(
        &self,
        mut leaf: impl FnMut() -> T,
        mut combine: impl FnMut(Operation, T, T) -> T,
    ) -> T {
        let mut stack: Vec<T> = Vec::with_capacity(8);
        for step in &self.steps {
            match step.operation() {
                None => stack.push(leaf()),
                Some(operation) => {
                    let (b, a) = (stack.pop(), stack.pop());
                    let (a, b) = (a.expect("a checked tree"), b.expect("a checked tree"));
                    stack.push(combine(operation, a, b));
                }
            }
        }
        stack.pop().expect("a checked tree")
    }
}

/// The inside of a cut.
pub(crate) struct Interior<'a> {
    cut: &'a Cut,
    leaves: Vec<Leaf>,
}

impl Interior<'_> {
    /// True for a point inside, which must not be close to a face of a leaf.
    pub fn contains(&self, point: Vec3) -> bool {
        let mut next = self.leaves.iter();
        let there = || next.next().is_some_and(|leaf| leaf.contains(point));
        self.cut.fold(there, |operation, a, b| match operation {
            Operation::Difference => a && !b,
            Operation::Intersection => a && b,
            Operation::Union => a || b,
        })
    }
}

impl Measured for Arc<Cut> {
    const KIND: &'static str = "cut";
    const FORM: Form = Form::Mesh;

    fn check(&self, _checks: Checks) -> Result<(), GeomError> {
        Cut::check(self)
    }

    fn bytes(&self) -> usize {
        Cut::bytes(self)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        surface::mesh(self).map(|mesh| mesh.map(|p| placement.apply(p)))
    }

    /// The frame of the solid from which the rest is cut.
    fn frame(&self, placement: &Placement) -> Placement {
        placement.after(&self.base().frame())
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        surface::fine(self)
    }
}
