//! Kept loops: a loop node with its iterations, each of which is an activation of its own.
//!
//! If an iteration passes on the same values as before, and neither the loop's sequence nor the captures of its
//! iterations have changed, all later iterations are unchanged.

use super::super::Machine;
use super::super::address::{iteration_key, join};
use super::super::keep::Target;
use super::super::outcome::Continuation;
use super::super::registers::Registers;
use super::super::state::{NodeId, State};
use super::entry::Entry;
use super::journal::Cut;
use super::slot::Slot;
use super::strategy::Step;
use super::trace::{Active, Kept};
use crate::code::{Args, Loop, Operand, Site, SiteId, SiteKind, exit};
use crate::fault::Fault;
use crate::value::{Value, identical, iter_get, iter_len};
use niwaki_math::Scalar;

/// The source of the carried values that an iteration gets.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Carried {
    /// The values are the same as the last time.
    Unchanged,
    /// The values are in the machine's buffer.
    Buffer,
}

/// The place where a loop continues.
pub(super) enum Next {
    /// In this iteration, at this instruction.
    Enter(NodeId, u32),
    /// After the loop, with the same results as before or with others.
    Ended { changed: bool },
}

impl<S: Scalar> Kept<S> {
    /// Reaches a loop from above.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    pub(super) fn begin_loop(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
        l: &Loop,
    ) -> Result<Continuation, Fault> {
        let at = Kept::slot_at(state, node, number.0 as usize);
        macro_rules! over {
            () => {
                l.over.map(|o| r.get(state, &machine.scratch, o))
            };
        }
        if let Some(over) = over!()
            && iter_len(over)? == 0
        {
            self.vacate(machine.program, state, node, number.0);
            r.gather(state, &machine.scratch, l.carried, &mut machine.buffer);
            let changed = self.leave(machine, state, node, number, exit::NEXT);
            return Ok(self.after(r.f, site, changed));
        }
        let held = self.slots[at].held;
        let mut active = Active { header: NodeId(held), captures: Entry::Unchanged, over: false };
        let captures = &r.f.operands[l.captures.range()];
        if held == Slot::NOTHING {
            let path = join(state.nodes[node.0 as usize].path, site.key);
            let header = self.new_node(machine.program, state, l.header, node, u32::from(number.0), path);
            self.write_slot(self.quiet, at, Slot { held: header.0, mark: 0, log: 0.0 });
            let to = state.nodes[header.0 as usize].registers as usize;
            let over = over!().cloned().unwrap_or_default();
            state.registers[to].store(over);
            for (i, o) in captures.iter().enumerate() {
                let value = r.get(state, &machine.scratch, *o).clone();
                state.registers[to + 1 + i].store(value);
            }
            active.header = header;
        } else {
            let to = state.nodes[held as usize].registers as usize;
            let outers = &machine.program.function(l.body).outers;
            if let Some(over) = over!()
                && !identical(over, &state.registers[to])
            {
                let over = over.clone();
                active.over = self.write_to(state, false, to, over);
            }
            for (i, o) in captures.iter().enumerate() {
                let value = r.get(state, &machine.scratch, *o);
                if !identical(value, &state.registers[to + 1 + i]) {
                    let value = value.clone();
                    self.write_to(state, false, to + 1 + i, value);
                    active.captures.add(outers.get(1 + i).copied().unwrap_or(0));
                }
            }
        }
        r.gather(state, &machine.scratch, l.carried, &mut machine.buffer);
        self.counters.entered += 1;
        self.note(Step::Entered(active.header));
        match self.iterate(machine, state, active, 0, Carried::Buffer)? {
            Next::Enter(child, at) => {
                self.active.push(active);
                self.depth += 1;
                self.returns.push(self.pc + 1);
                Ok(Continuation::Enter(child, at))
            }
            Next::Ended { changed } => Ok(self.after(r.f, site, changed)),
        }
    }

    /// Continues with iteration `i` of a loop, up to the first iteration that must be entered, or to the end.
    pub(super) fn iterate(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        active: Active,
        mut i: usize,
        mut carried: Carried,
    ) -> Result<Next, Fault> {
        let header = active.header;
        let (path, at, list) = {
            let n = &state.nodes[header.0 as usize];
            (n.path, n.registers as usize, n.slots as usize)
        };
        let over = &state.registers[at];
        let count = if matches!(over, Value::None) { usize::MAX } else { iter_len(over)? };
        let first = usize::from(count != usize::MAX);
        loop {
            if i >= count {
                return Ok(self.end(machine, state, header, i, exit::NEXT, carried));
            }
            let element = |state: &State<S>| (first == 1).then(|| iter_get(&state.registers[at], i));
            let Some(child) = self.loops[list].get(i).copied() else {
                let element = element(state);
                self.leaves_its_activation();
                if carried == Carried::Unchanged {
                    // The loop gets more iterations: the results of its last iteration were the results of the
                    // loop.
                    self.gather_results(machine, state, header);
                }
                let (owner, number) = {
                    let n = &state.nodes[header.0 as usize];
                    (n.parent, n.site as usize)
                };
                let f = machine.program.function(state.nodes[owner.0 as usize].function);
                let SiteKind::Loop(l) = &f.sites[number].kind else { unreachable!("a loop's site") };
                let path = join(path, iteration_key(i as u32));
                let created = self.new_node(machine.program, state, l.body, header, 0, path);
                let node = &mut state.nodes[created.0 as usize];
                node.iteration = i as u32;
                let to = node.registers as usize;
                if !self.is_new(state, header) {
                    self.journal.more().loops.push(Cut {
                        number: list as u32,
                        len: i as u32,
                        removed: vec![],
                    });
                }
                self.loops[list].push(created);
                for (k, value) in element.into_iter().chain(machine.buffer.drain(..)).enumerate() {
                    state.registers[to + k].store(value);
                }
                machine.afford(state, self)?;
                self.counters.entered += 1;
                return Ok(Next::Enter(created, 0));
            };
            let to = state.nodes[child.0 as usize].registers as usize;
            let mut changed = active.captures;
            let inputs = &machine.program.function(state.nodes[child.0 as usize].function).inputs;
            if active.over
                && let Some(element) = element(state)
                && self.write_to(state, false, to, element)
            {
                changed.add(inputs[0]);
            }
            if carried == Carried::Buffer {
                for (k, value) in machine.buffer.drain(..).enumerate() {
                    if self.write_to(state, false, to + first + k, value) {
                        changed.add(inputs[first + k]);
                    }
                }
            }
            if changed != Entry::Unchanged || !self.reuse || self.is_marked(child) {
                self.leaves_its_activation();
                self.counters.entered += 1;
                self.note(Step::Entered(child));
                return Ok(Next::Enter(child, self.entry(changed)));
            }
            self.counters.skipped += 1;
            self.note(Step::Skipped(child));
            let ended = i64::from(state.nodes[child.0 as usize].pc);
            carried = Carried::Unchanged;
            if ended != exit::NEXT || (!active.over && !self.is_marked(header)) {
                return Ok(Next::Ended { changed: false });
            }
            i += 1;
        }
    }

    /// Ends an iteration. The run ends when no result has changed.
    pub(super) fn end_of_iteration(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        kind: i64,
        carried: Args,
    ) -> Result<Target, Fault> {
        self.note(Step::Unwound(node));
        let n = state.nodes[node.0 as usize];
        let (header, i) = (n.parent, n.iteration as usize);
        let above = state.nodes[header.0 as usize];
        let next = self.loops[above.slots as usize].get(i + 1).copied();
        let is_new = n.created == self.now;
        let operands = &r.f.operands[carried.range()];
        let is_base = self.depth == 0;
        let active = match self.active.last() {
            Some(active) if active.header == header && !is_base => *active,
            _ => Active { header, captures: Entry::Unchanged, over: false },
        };
        if let Some(next) = next
            && self.reuse
            && !active.over
            && (self.early || !is_base)
            && kind == exit::NEXT
            && i64::from(n.pc) == kind
        {
            // The frequent case: only carried values, or captures of all iterations, can have changed.
            let mut changed = active.captures;
            if !operands.is_empty() {
                let first = usize::from(!matches!(state.registers[above.registers as usize], Value::None));
                let to = state.nodes[next.0 as usize].registers as usize + first;
                for (k, o) in operands.iter().enumerate() {
                    let value = r.get(state, &machine.scratch, *o);
                    if !identical(value, &state.registers[to + k]) {
                        let value = value.clone();
                        self.journal.set(&mut state.registers[to + k], to + k, value);
                        changed.add(r.f.inputs[first + k]);
                    }
                }
            }
            if changed != Entry::Unchanged || self.is_marked(next) {
                self.leaves_its_activation();
                self.counters.entered += 1;
                self.note(Step::Entered(next));
                return Ok(Target::at(next, self.entry(changed)));
            }
            if is_base {
                return Ok(Target::END);
            }
            if !self.is_marked(header) {
                return Ok(self.continue_owner(machine, state, header, false, false));
            }
        }
        let mut is_unchanged = !is_new && i64::from(n.pc) == kind;
        if is_unchanged {
            let value = |k: usize| r.get(state, &machine.scratch, operands[k]);
            is_unchanged = match next {
                Some(next) => {
                    let to = state.nodes[next.0 as usize].registers as usize
                        + usize::from(self.is_for(state, header));
                    (0..operands.len()).all(|k| identical(value(k), &state.registers[to + k]))
                }
                None => {
                    let (base, results) = loop_results(machine, state, header, kind);
                    results.enumerate().all(|(k, o)| identical(value(k), &state.registers[base + o.index()]))
                }
            };
        }
        if i64::from(n.pc) != kind {
            if !is_new {
                self.journal.more().ends.push((node, n.pc));
            }
            state.nodes[node.0 as usize].pc = kind as u32;
        }
        if is_unchanged && self.reuse {
            if is_base && self.early {
                return Ok(Target::END);
            }
            if !is_base && active.captures == Entry::Unchanged && !active.over && !self.is_marked(header) {
                return Ok(self.continue_owner(machine, state, header, is_base, false));
            }
        }
        r.gather(state, &machine.scratch, carried, &mut machine.buffer);
        let next = if kind == exit::NEXT {
            self.iterate(machine, state, active, i + 1, Carried::Buffer)?
        } else {
            self.end(machine, state, header, i + 1, kind, Carried::Buffer)
        };
        Ok(match next {
            Next::Enter(child, at) => Target::at(child, at),
            Next::Ended { changed } => self.continue_owner(machine, state, header, is_base, changed),
        })
    }

    /// Continues the owner of a loop that has ended, unless nothing has changed for it.
    pub(super) fn continue_owner(
        &mut self,
        machine: &Machine<'_, S>,
        state: &State<S>,
        header: NodeId,
        is_base: bool,
        changed: bool,
    ) -> Target {
        let n = &state.nodes[header.0 as usize];
        let owner = &state.nodes[n.parent.0 as usize];
        let site = &machine.program.function(owner.function).sites[n.site as usize];
        if !is_base {
            self.depth -= 1;
            self.active.pop();
            let next = self.returns.pop().unwrap_or(site.next);
            return Target::at(n.parent, if changed { site.next } else { next });
        }
        if self.early && !changed {
            return Target::END;
        }
        self.leaves_its_activation();
        self.counters.entered += 1;
        self.note(Step::Entered(n.parent));
        Target::at(n.parent, if self.early { site.again } else { site.next })
    }

    fn is_for(&self, state: &State<S>, header: NodeId) -> bool {
        let at = state.nodes[header.0 as usize].registers as usize;
        !matches!(state.registers[at], Value::None)
    }

    /// Ends the loop before iteration `i`: later iterations are removed, and the owner gets the results.
    fn end(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        header: NodeId,
        i: usize,
        kind: i64,
        carried: Carried,
    ) -> Next {
        let n = state.nodes[header.0 as usize];
        let list = n.slots as usize;
        let shrunk = self.loops[list].len() > i;
        if shrunk {
            if carried == Carried::Unchanged {
                // The loop's results are the values that iteration `i` got.
                self.gather_inputs(machine, state, header, i);
            }
            let removed = self.loops[list].split_off(i);
            for child in &removed {
                self.remove(machine.program, state, *child);
            }
            self.journal.more().loops.push(Cut { number: list as u32, len: i as u32, removed });
        } else if carried == Carried::Unchanged {
            return Next::Ended { changed: false };
        }
        let changed = self.leave(machine, state, n.parent, SiteId(n.site as u16), kind);
        Next::Ended { changed }
    }

    /// Copies the loop's results in its owner to the buffer.
    fn gather_results(&self, machine: &mut Machine<'_, S>, state: &State<S>, header: NodeId) {
        let (base, loop_results) = loop_results(machine, state, header, exit::NEXT);
        let values: Vec<Value<S>> = loop_results.map(|o| state.registers[base + o.index()].clone()).collect();
        machine.buffer.clear();
        machine.buffer.extend(values);
    }

    /// Copies the carried values that iteration `i` got to the buffer.
    fn gather_inputs(&self, machine: &mut Machine<'_, S>, state: &State<S>, header: NodeId, i: usize) {
        let child = self.loops[state.nodes[header.0 as usize].slots as usize][i];
        let n = &state.nodes[child.0 as usize];
        let f = machine.program.function(n.function);
        let first = usize::from(self.is_for(state, header));
        let at = n.registers as usize;
        machine.buffer.clear();
        machine.buffer.extend(state.registers[at + first..at + f.params as usize].iter().cloned());
    }

    /// Writes the results of a loop, which are in the buffer, to the registers of its owner. Returns whether a
    /// register changed.
    fn leave(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        owner: NodeId,
        number: SiteId,
        kind: i64,
    ) -> bool {
        let n = &state.nodes[owner.0 as usize];
        let (f, base, is_new) =
            (machine.program.function(n.function), n.registers as usize, n.created == self.now);
        let SiteKind::Loop(l) = &f.sites[number.0 as usize].kind else { return false };
        let mut changed = false;
        if let Some((how, value)) = l.exit {
            if kind == exit::RETURN {
                let returned = machine.buffer.pop().unwrap_or_default();
                changed |= self.write_to(state, is_new, base + value.index(), returned);
            }
            changed |= self.write_to(state, is_new, base + how.index(), Value::Int(kind));
        }
        for (o, value) in f.operands[l.out.range()].iter().zip(machine.buffer.drain(..)) {
            changed |= self.write_to(state, is_new, base + o.index(), value);
        }
        changed
    }
}

/// The registers where a loop's last iteration wrote its carried values (and, by `return`, its value): the
/// first register of the owner, and the operands.
fn loop_results<'a, S: Scalar>(
    machine: &Machine<'a, S>,
    state: &State<S>,
    header: NodeId,
    kind: i64,
) -> (usize, impl Iterator<Item = Operand> + use<'a, S>) {
    let n = &state.nodes[header.0 as usize];
    let owner = &state.nodes[n.parent.0 as usize];
    let f = machine.program.function(owner.function);
    let SiteKind::Loop(l) = &f.sites[n.site as usize].kind else { unreachable!("a loop's site") };
    let value = l.exit.filter(|_| kind == exit::RETURN).map(|(_, value)| value);
    (owner.registers as usize, f.operands[l.out.range()].iter().copied().chain(value))
}
