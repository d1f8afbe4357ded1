//! Calls of kept activations: entered, skipped, created and removed.

use super::super::Machine;
use super::super::address::join;
use super::super::keep::Target;
use super::super::outcome::Continuation;
use super::super::outcome::Halt;
use super::super::registers::Registers;
use super::super::state::{Node, NodeId, State};
use super::super::suspend::Callee;
use super::entry::Entry;
use super::slot::Slot;
use super::strategy::Step;
use super::trace::Kept;
use crate::code::{FunctionId, Mode, Program, Site, SiteId, SiteKind};
use crate::fault::Fault;
use crate::value::{Value, identical};
use niwaki_math::Scalar;

impl<S: Scalar> Kept<S> {
    /// Calls a known function. The callee is skipped if it exists with the same arguments.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    pub(super) fn call_known(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
        function: FunctionId,
    ) -> Result<Continuation, Halt> {
        if machine.program.function(function).mode == Mode::Pure {
            // The site is a future of a pure function.
            r.gather(state, &machine.scratch, site.args, &mut machine.buffer);
            return Ok(Continuation::Pure { function, to: site.to, as_future: site.kind.gives_future() });
        }
        let at = Kept::slot_at(state, node, number.0 as usize);
        let held = self.slots[at].held;
        let operands = &r.f.operands[site.args.range()];
        if held == Slot::NOTHING {
            let created = self.make(machine, state, node, number, site, function, at)?;
            let to = state.nodes[created.0 as usize].registers as usize;
            for (i, o) in operands.iter().enumerate() {
                let value = r.get(state, &machine.scratch, *o).clone();
                state.registers[to + i].store(value);
            }
            return Ok(self.enter_call(created, 0));
        }
        let child = NodeId(held);
        let to = state.nodes[held as usize].registers as usize;
        let mut changed = Entry::Unchanged;
        if !self.sites.is_on(state.nodes[node.0 as usize].function, u32::from(number.0)) {
            for (i, o) in operands.iter().enumerate() {
                let value = r.get(state, &machine.scratch, *o).clone();
                self.journal.set(&mut state.registers[to + i], to + i, value);
            }
            return Ok(self.enter_call(child, 0));
        }
        let inputs = &machine.program.function(function).inputs;
        for (i, o) in operands.iter().enumerate() {
            let value = r.get(state, &machine.scratch, *o);
            if !identical(value, &state.registers[to + i]) {
                let value = value.clone();
                self.journal.set(&mut state.registers[to + i], to + i, value);
                changed.add(inputs[i]);
            }
        }
        Ok(self.call_again(state, child, changed))
    }

    /// Calls a function value. A different function means a new activation.
    pub(super) fn apply(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
    ) -> Result<Continuation, Halt> {
        r.gather(state, &machine.scratch, site.args, &mut machine.buffer);
        let Callee { function, pure, memo } = machine.unwrap_callee()?;
        if pure {
            self.vacate(machine.program, state, node, number.0);
            return Ok(Continuation::Pure { function, to: site.to, as_future: site.kind.gives_future() });
        }
        if let Some(memo) = memo {
            return self.recall(machine, state, r, (node, number), site, function, &memo);
        }
        let at = Kept::slot_at(state, node, number.0 as usize);
        let held = self.slots[at].held;
        let is_reusable = |n: &Node| n.function == function && n.memo().is_none();
        if held != Slot::NOTHING && is_reusable(&state.nodes[held as usize]) {
            let to = state.nodes[held as usize].registers as usize;
            let mut changed = Entry::Unchanged;
            let inputs = &machine.program.function(function).inputs;
            for (i, value) in machine.buffer.drain(..).enumerate() {
                if self.write_to(state, false, to + i, value) {
                    changed.add(inputs[i]);
                }
            }
            return Ok(self.call_again(state, NodeId(held), changed));
        }
        self.vacate(machine.program, state, node, number.0);
        let created = self.make(machine, state, node, number, site, function, at)?;
        let to = state.nodes[created.0 as usize].registers as usize;
        for (i, value) in machine.buffer.drain(..).enumerate() {
            state.registers[to + i].store(value);
        }
        Ok(self.enter_call(created, 0))
    }

    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    fn make(
        &mut self,
        machine: &Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
        function: FunctionId,
        at: usize,
    ) -> Result<NodeId, Fault> {
        let path = join(state.nodes[node.0 as usize].path, site.key);
        let created = self.new_node(machine.program, state, function, node, u32::from(number.0), path);
        machine.afford(state, self)?;
        self.write_slot(self.quiet, at, Slot { held: created.0, mark: 0, log: 0.0 });
        Ok(created)
    }

    /// Repeats a call: enters it, unless it can be skipped. Its result is in the caller's register.
    #[inline]
    pub(super) fn call_again(&mut self, state: &State<S>, child: NodeId, changed: Entry) -> Continuation {
        let (function, site) = Kept::caller(state, child);
        if changed == Entry::Unchanged && self.reuse && !self.is_marked(child) {
            self.sites.paid(function, site);
            self.counters.skipped += 1;
            self.note(Step::Skipped(child));
            return Continuation::Next;
        }
        if self.reuse {
            self.sites.missed(function, site, self.now);
        }
        self.enter_call(child, self.entry(changed))
    }

    #[inline]
    pub(super) fn enter_call(&mut self, child: NodeId, at: u32) -> Continuation {
        self.leaves_its_activation();
        self.depth += 1;
        self.returns.push(self.pc + 1);
        self.counters.entered += 1;
        self.note(Step::Entered(child));
        Continuation::Enter(child, at)
    }

    /// Returns from an activation. The run ends when no result has changed.
    pub(super) fn return_to_caller(
        &mut self,
        program: &Program<S>,
        state: &mut State<S>,
        node: NodeId,
        value: Value<S>,
    ) -> Target {
        self.note(Step::Unwound(node));
        let (parent, number, memo) = {
            let n = &state.nodes[node.0 as usize];
            (n.parent, n.site as usize, n.memo())
        };
        if let Some(memo) = memo
            && !self.settle(memo, &value)
        {
            return Target::END;
        }
        if parent == NodeId::NONE {
            if !identical(&value, &self.result) {
                let old = std::mem::replace(&mut self.result, value);
                self.result_before.get_or_insert(old);
            }
            return Target::END;
        }
        let above = &state.nodes[parent.0 as usize];
        let (base, is_new) = (above.registers as usize, above.created == self.now);
        let site = &program.function(above.function).sites[number];
        let value = if site.kind.gives_future() { Value::returned(value) } else { value };
        let changed = self.write_to(state, is_new, base + site.to.index(), value);
        if !changed {
            let (function, site) = Kept::caller(state, node);
            self.sites.paid(function, site);
        }
        if self.depth > 0 {
            self.depth -= 1;
            let next = self.returns.pop().unwrap_or(site.next);
            return Target::at(parent, if changed { site.next } else { next });
        }
        if self.early && !changed {
            return Target::END;
        }
        self.leaves_its_activation();
        self.counters.entered += 1;
        self.note(Step::Entered(parent));
        Target::at(parent, if self.early { site.again } else { site.next })
    }

    /// Removes the contents of a site's slot: the site is not on the path taken.
    pub(super) fn vacate(&mut self, program: &Program<S>, state: &mut State<S>, node: NodeId, site: u16) {
        let at = Kept::slot_at(state, node, site as usize);
        let slot = self.slots[at];
        if !slot.is_filled() {
            return;
        }
        let kind = &program.function(state.nodes[node.0 as usize].function).sites[site as usize].kind;
        match kind {
            kind if kind.makes_activation() => match self.shared(state, slot) {
                Some(number) => self.memos.leave(number, (node.0, site)),
                None => self.remove(program, state, NodeId(slot.held)),
            },
            SiteKind::Read => return self.withdraw(kind, at, node, site),
            _ => self.withdraw(kind, at, node, site),
        }
        self.write_slot(self.is_new(state, node), at, Slot::EMPTY);
    }

    /// Removes an activation and all activations below it. The nodes stay as they are until the commit.
    pub(super) fn remove(&mut self, program: &Program<S>, state: &State<S>, node: NodeId) {
        self.leaves_its_activation();
        let from = self.journal.more.removed.len();
        self.journal.more().removed.push(node);
        let mut next = from;
        while let Some(id) = self.journal.more.removed.get(next).copied() {
            next += 1;
            self.note(Step::Removed(id));
            let n = &state.nodes[id.0 as usize];
            let f = program.function(n.function);
            if f.mode == Mode::Loop {
                let children = &self.loops[n.slots as usize];
                self.journal.more().removed.extend_from_slice(children);
                continue;
            }
            for (i, site) in f.sites.iter().enumerate() {
                let at = n.slots as usize + i;
                let slot = self.slots[at];
                if !slot.is_filled() {
                    continue;
                }
                if site.kind.makes_activation() {
                    match self.shared(state, slot) {
                        Some(number) => self.memos.leave(number, (id.0, i as u16)),
                        None => self.journal.more().removed.push(NodeId(slot.held)),
                    }
                } else {
                    self.withdraw(&site.kind, at, id, i as u16);
                }
            }
        }
    }
}
