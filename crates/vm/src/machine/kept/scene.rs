//! The primitives of the scene that belong to a part, by number, also while a transaction is open.

use super::super::state::NodeId;
use super::part::Part;
use super::trace::{ChoiceAt, Kept, Trace};
use crate::code::{Mode, Program, SiteKind};
use niwaki_geom::Primitive;
use niwaki_math::Scalar;

impl<S: Scalar> Trace<S> {
    /// The numbers of the primitives that a choice leads to, in ascending order: the primitives of its
    /// activation and of all activations below it, without those that the activation itself emitted before the
    /// choice. Later iterations of the same loop count as below, as in the recursion that the loop could be.
    /// Memoised calls that are requested there do not count.
    pub fn emits_below(&self, program: &Program<S>, choice: usize) -> Vec<u32> {
        let ChoiceAt { node, site } = self.kept.choices[choice];
        self.emits_from(program, node, site as usize, true)
    }

    /// The numbers of the primitives of a part, in ascending order.
    pub fn emits_of(&self, program: &Program<S>, part: Part) -> Vec<u32> {
        self.emits_from(program, part.node, 0, part.is_onward())
    }

    /// The numbers of the primitives that an activation emits from one of its sites on, and of all activations
    /// below it. With `onward`, later iterations count as well.
    fn emits_from(&self, program: &Program<S>, start: NodeId, site: usize, onward: bool) -> Vec<u32> {
        let mut numbers = Vec::new();
        let mut work = vec![start];
        if onward {
            work.extend(self.iterations_after(program, start));
        }
        while let Some(node) = work.pop() {
            let n = &self.state.nodes[node.0 as usize];
            let f = program.function(n.function);
            if f.mode == Mode::Loop {
                work.extend(&self.kept.loops[n.slots as usize]);
                continue;
            }
            for (i, at) in f.sites.iter().enumerate() {
                let slot = self.kept.slots[Kept::slot_at(&self.state, node, i)];
                match &at.kind {
                    _ if !slot.is_filled() => {}
                    SiteKind::Emit if node == start && i < site => {}
                    SiteKind::Emit => numbers.push(slot.held),
                    kind if kind.makes_activation() && self.kept.shared(&self.state, slot).is_none() => {
                        work.push(NodeId(slot.held));
                    }
                    _ => {}
                }
            }
        }
        numbers.sort_unstable();
        numbers
    }

    /// The iterations of a loop after a given one; none for another activation.
    fn iterations_after(&self, program: &Program<S>, node: NodeId) -> &[NodeId] {
        let n = &self.state.nodes[node.0 as usize];
        if program.function(n.function).mode != Mode::Iteration {
            return &[];
        }
        let header = &self.state.nodes[n.parent.0 as usize];
        self.kept.loops[header.slots as usize].get(n.iteration as usize + 1..).unwrap_or(&[])
    }

    /// The primitive with a number; `None` if there is none.
    pub fn primitive(&self, number: u32) -> Option<&Primitive> {
        self.kept.emits.get(number as usize)?.as_ref()
    }

    /// The numbers of the primitives that the open transaction removed from the scene, and of those that it
    /// added.
    pub fn exchanged(&self) -> (&[u32], &[u32]) {
        (&self.kept.journal.more.retracted, &self.kept.journal.more.emitted)
    }
}
