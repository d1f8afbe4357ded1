//! The part that each activation emitted last, as a box: the place where a guide looks from in a model without
//! `look`.
//!
//! A part is the last shape of an `emit`: for a pair of wings it is one wing. Boxes are recorded by node,
//! beside the nodes and only in runs that ask for them, so that other runs neither copy nor write anything. A
//! box belongs to the activation whose path it has: a node that is used again has another path.

use super::state::{NodeId, State};
use crate::code::{Mode, Program};
use niwaki_geom::{Aabb, Shape};
use niwaki_math::Scalar;

impl<S: Scalar> State<S> {
    /// Lets the run record the part that each activation emitted last.
    pub fn note_parts(&mut self) {
        self.parts.are_recorded = true;
    }

    /// Records the last of the shapes that a node emits, for the activation of its function.
    #[inline]
    pub(super) fn note_part(&mut self, program: &Program<S>, node: NodeId, shapes: &[Shape]) {
        if self.parts.are_recorded
            && let Some(shape) = shapes.last()
        {
            let mut owner = node;
            loop {
                let n = &self.nodes[owner.0 as usize];
                let in_loop = matches!(program.function(n.function).mode, Mode::Iteration | Mode::Loop);
                if !in_loop || n.parent == NodeId::NONE {
                    break;
                }
                owner = n.parent;
            }
            self.put_part(owner, *shape.aabb());
        }
    }

    /// Gives a future the part that its creator sees.
    #[inline]
    pub(super) fn inherit_part(&mut self, creator: NodeId, created: NodeId) {
        if let Some(part) = self.part(creator).copied() {
            self.put_part(created, part);
        }
    }

    /// The part that was emitted last on the call path of a node.
    #[inline]
    pub(super) fn part(&self, node: NodeId) -> Option<&Aabb> {
        let mut at = node;
        while self.parts.are_recorded && at != NodeId::NONE {
            let n = &self.nodes[at.0 as usize];
            match self.parts.boxes.get(at.0 as usize) {
                Some((path, part)) if *path == n.path && !part.is_empty() => return Some(part),
                // The first caller of a memoised call does not belong to it.
                _ if n.memo().is_some() => return None,
                _ => at = n.parent,
            }
        }
        None
    }

    pub(super) fn put_part(&mut self, node: NodeId, part: Aabb) {
        let (at, path) = (node.0 as usize, self.nodes[node.0 as usize].path);
        if self.parts.boxes.len() <= at {
            self.parts.boxes.resize(self.nodes.len(), (0, Aabb::EMPTY));
        }
        self.parts.boxes[at] = (path, part);
    }
}
