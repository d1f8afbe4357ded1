//! The effects of an open transaction on the choices: added, removed, and drawn again in place. Also the
//! transaction that draws choices again.

use super::super::Machine;
use super::super::answers::Answers;
use super::super::stack::RunFault;
use super::super::state::NodeId;
use super::inspect::Place;
use super::slot::Slot;
use super::strategy::{Change, Strategy};
use super::trace::{ChoiceAt, Kept, Trace};
use crate::code::{Program, SiteKind};
use crate::value::Value;
use niwaki_math::{Family, Scalar};

impl<S: Scalar> Trace<S> {
    /// The places of the choices that the open transaction added.
    pub fn births<'a>(&'a self, program: &'a Program<S>) -> impl ExactSizeIterator<Item = Place<'a, S>> {
        self.kept.journal.more.births.iter().map(|birth| self.place_at(program, birth.node, birth.site))
    }

    /// The numbers of the choices that a commit will remove, in no order. Their values can still be read.
    pub fn deaths(&self) -> &[u32] {
        &self.kept.journal.more.deaths
    }

    /// The choices that the open transaction drew again in place: the address, and the value before.
    pub fn drawn_anew(&self) -> &[(u128, Value<S>)] {
        &self.kept.journal.more.anew
    }

    /// The family that a choice was drawn from.
    pub fn family(&self, choice: usize) -> Option<Family> {
        let at = self.kept.choices[choice];
        let mark = self.kept.slots[Kept::slot_at(&self.state, at.node, at.site as usize)].mark & Slot::FAMILY;
        Family::ALL.iter().copied().find(|family| *family as u32 == mark)
    }

    /// The activation that is `levels` calls or iterations above a choice's activation. It is at most the root,
    /// or the memoised call that the choice belongs to.
    pub fn activation(&self, choice: usize, levels: usize) -> NodeId {
        let mut node = self.kept.choices[choice].node;
        for _ in 0..levels {
            let n = &self.state.nodes[node.0 as usize];
            if n.parent == NodeId::NONE || n.memo().is_some() {
                break;
            }
            node = n.parent;
        }
        node
    }

    /// Visits the choices at and below an activation, in no order. Each comes with its place, its number and
    /// its level below the activation. The number is `None` for choices that the open transaction added.
    /// Memoised calls that are requested below are not visited.
    pub fn below(
        &self,
        program: &Program<S>,
        node: NodeId,
        mut each: impl FnMut(Place<'_, S>, Option<usize>, usize),
    ) {
        let mut work = vec![(node, 0)];
        while let Some((node, level)) = work.pop() {
            let n = &self.state.nodes[node.0 as usize];
            let f = program.function(n.function);
            if f.mode == crate::code::Mode::Loop {
                work.extend(self.kept.loops[n.slots as usize].iter().map(|child| (*child, level + 1)));
                continue;
            }
            for (i, site) in f.sites.iter().enumerate() {
                let slot = self.kept.slots[n.slots as usize + i];
                match &site.kind {
                    _ if !slot.is_filled() => {}
                    kind if kind.makes_activation() && self.kept.shared(&self.state, slot).is_none() => {
                        work.push((NodeId(slot.held), level + 1));
                    }
                    SiteKind::Sample(_) if !slot.is_held() => {
                        let number = (slot.held & Slot::BORN == 0).then_some(slot.held as usize);
                        each(self.place_at(program, node, i as u16), number, level);
                    }
                    _ => {}
                }
            }
        }
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// Draws choices again from their distributions, in program order, and runs. The transaction is open
    /// afterwards; its fresh and stale log densities belong to the drawn values and to the values that they
    /// replace.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn redraw<A: Answers<S>>(
        &mut self,
        trace: &mut Trace<S>,
        choices: &[usize],
        strategy: Strategy,
        answers: &mut A,
    ) -> Result<Change, Box<RunFault>> {
        let (state, kept) = (&mut trace.state, &mut trace.kept);
        kept.open();
        if choices.is_empty() {
            return Ok(Change::Unchanged);
        }
        kept.prepare(if strategy.reuses() { Strategy::Cache } else { Strategy::Rerun });
        for choice in choices {
            let ChoiceAt { node, site } = kept.choices[*choice];
            let at = Kept::slot_at(state, node, site as usize);
            // No family has this number, so the old value fits no distribution.
            kept.write_slot(false, at, Slot { mark: Slot::FAMILY, ..kept.slots[at] });
            kept.mark_above(state, node);
        }
        self.run_to_end(trace, answers)
    }
}
