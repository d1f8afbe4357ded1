//! Activations that are entered for one change only, in a slice of their code (see `passes::slices`).
//!
//! Only C3 uses slices. A run from the root marks readers of changed elements while it runs, and these may be
//! in a call that a slice omits.

use super::super::Machine;
use super::super::keep::Target;
use super::super::outcome::Continuation;
use super::super::registers::Registers;
use super::super::state::{NodeId, State};
use super::entry::Entry;
use super::loops::{Carried, Next};
use super::strategy::Step;
use super::trace::{Active, Kept};
use crate::code::{Function, Mode, Site, SiteId, exit};
use crate::fault::Fault;
use crate::value::identical;
use niwaki_math::Scalar;

impl<S: Scalar> Kept<S> {
    /// The instruction at which an activation is entered.
    #[inline(always)]
    pub(super) fn entry(&self, changed: Entry) -> u32 {
        match changed {
            Entry::Slice(slice) if self.early => slice,
            _ => 0,
        }
    }

    /// The continuation after a site: in the whole code if the site's result has changed.
    #[inline(always)]
    pub(super) fn after(&self, f: &Function<S>, site: &Site, changed: bool) -> Continuation {
        if changed && self.pc >= f.body { Continuation::Goto(site.next) } else { Continuation::Next }
    }

    /// Repeats a call of which only one argument may have changed.
    #[inline]
    pub(super) fn pass_argument(
        &mut self,
        machine: &Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        arg: u16,
    ) -> Continuation {
        let site = &r.f.sites[number.0 as usize];
        let child = NodeId(self.slots[Kept::slot_at(state, node, number.0 as usize)].held);
        let n = &state.nodes[child.0 as usize];
        let (place, function) = (n.registers as usize + arg as usize, n.function);
        let value = r.get(state, &machine.scratch, r.f.operands[site.args.start as usize + arg as usize]);
        if identical(value, &state.registers[place]) {
            return Continuation::Next;
        }
        let value = value.clone();
        self.journal.set(&mut state.registers[place], place, value);
        self.call_again(state, child, Entry::Slice(machine.program.function(function).inputs[arg as usize]))
    }

    /// Leaves an activation with the same results as before. The run ends if the activation was not entered
    /// from above.
    pub(super) fn leave_unchanged(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
    ) -> Result<Target, Fault> {
        self.note(Step::Unwound(node));
        if self.depth == 0 {
            return Ok(Target::END);
        }
        let n = &state.nodes[node.0 as usize];
        let (header, end, i) = (n.parent, i64::from(n.pc), n.iteration as usize);
        // The iteration was entered because its loop was entered from above, or because the iteration before
        // changed its carried values.
        let active = match self.active.last() {
            Some(active) if active.header == header => *active,
            _ if machine.program.function(n.function).mode == Mode::Node => {
                let (function, site) = Kept::caller(state, node);
                self.sites.paid(function, site);
                self.depth -= 1;
                return Ok(self.returns.pop().map_or(Target::END, |next| Target::at(header, next)));
            }
            _ => Active { header, captures: Entry::Unchanged, over: false },
        };
        if end != exit::NEXT {
            return Ok(self.continue_owner(machine, state, header, false, false));
        }
        if !active.over {
            // There are as many iterations as before; only the captures can have changed for the next
            // iteration.
            let list = state.nodes[header.0 as usize].slots as usize;
            let next = self.loops[list].get(i + 1).copied();
            return Ok(match next.filter(|_| active.captures != Entry::Unchanged) {
                Some(next) => {
                    self.leaves_its_activation();
                    self.counters.entered += 1;
                    self.note(Step::Entered(next));
                    Target::at(next, self.entry(active.captures))
                }
                None => self.continue_owner(machine, state, header, false, false),
            });
        }
        Ok(match self.iterate(machine, state, active, i + 1, Carried::Unchanged)? {
            Next::Enter(child, at) => Target::at(child, at),
            Next::Ended { changed } => self.continue_owner(machine, state, header, false, changed),
        })
    }
}
