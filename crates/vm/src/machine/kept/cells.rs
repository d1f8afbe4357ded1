//! Collections: elements in registers, and their readers.
//!
//! A read subscribes to its element. When the element changes, its readers are *woken*. A run from the root
//! marks them and the activations above them. A run from a choice (C3) runs them one by one when the rest has
//! ended.
//!
//! C3 runs readers in any order. That is correct as long as each of them only scores again: no activation is
//! entered or returns changed, no choice is added or removed, and no element changes while other readers wait.
//! Otherwise the run is *tangled*: it is undone and repeated from the root, in program order.

use super::super::Machine;
use super::super::answers::Answers;
use super::super::budget;
use super::super::keep::Keep;
use super::super::outcome::Halt;
use super::super::registers::Registers;
use super::super::stack::RunFault;
use super::super::state::{NodeId, State};
use super::readers::{Reader, Readers};
use super::slot::Slot;
use super::strategy::{Change, Step};
use super::trace::{Kept, Trace};
use crate::code::{Op, Operand, Site, SiteKind};
use crate::value::{Cell, List, Value, index, ops};
use niwaki_math::Scalar;

impl<S: Scalar> Kept<S> {
    /// Creates an element, or computes it again.
    pub(super) fn cell(
        &mut self,
        state: &mut State<S>,
        scratch: &[Value<S>],
        r: Registers<'_, S>,
        at: usize,
        site: &Site,
        content: Operand,
    ) {
        let value = r.get(state, scratch, r.f.operands[site.args.start as usize]).clone();
        if let Some(cell) = self.element(state, value, at, r.base + content.index(), 0.0) {
            self.write_to(state, self.quiet, r.base + site.to.index(), Value::Cell(cell));
        }
    }

    /// Appends an element to a list, for the first time or again. The slot's log is the list's address in
    /// memory: while the list is the same, the longer list is the same as well.
    pub(super) fn append(
        &mut self,
        state: &mut State<S>,
        scratch: &[Value<S>],
        r: Registers<'_, S>,
        at: usize,
        site: &Site,
        content: Operand,
    ) -> Result<(), Halt> {
        let operands = &r.f.operands[site.args.range()];
        let value = r.get(state, scratch, operands[1]).clone();
        let list = r.get(state, scratch, operands[0]);
        let address = match list {
            Value::List(list) => f64::from_bits(list.address() as u64),
            _ => 0.0,
        };
        let slot = self.slots[at];
        if slot.is_filled() && slot.log.to_bits() == address.to_bits() {
            self.element(state, value, at, r.base + content.index(), address);
            return Ok(());
        }
        let list = list.clone();
        let cell = match self.element(state, value, at, r.base + content.index(), address) {
            Some(cell) => cell,
            None => {
                self.write_slot(self.quiet, at, Slot { log: address, ..slot });
                Cell { register: self.readers[slot.held as usize].register, readers: slot.held }
            }
        };
        let longer = ops::append(list, Value::Cell(cell))?;
        state.charged += budget::of_append(&longer) + size_of::<Reader>();
        self.write_to(state, self.quiet, r.base + site.to.index(), longer);
        Ok(())
    }

    /// Stores an element in its register, and returns a reference to it when the site is met for the first
    /// time.
    #[inline]
    fn element(
        &mut self,
        state: &mut State<S>,
        value: Value<S>,
        at: usize,
        place: usize,
        log: f64,
    ) -> Option<Cell> {
        let changed = self.write_to(state, self.quiet, place, value);
        let slot = self.slots[at];
        if slot.is_filled() {
            if changed {
                self.wake(state, slot.held as usize);
            }
            return None;
        }
        let register = place as u32;
        let id = match self.free_readers.pop() {
            Some(id) => {
                self.readers[id as usize].register = register;
                id
            }
            None => {
                self.readers.push(Readers { register, all: vec![] });
                self.readers.len() as u32 - 1
            }
        };
        state.charged += size_of::<Readers>() + size_of::<u32>();
        self.journal.more().cells.push(id);
        self.write_slot(self.quiet, at, Slot { held: id, mark: 0, log });
        Some(Cell { register, readers: id })
    }

    /// Reads an element, for the first time or again.
    #[inline]
    pub(super) fn read(
        &mut self,
        state: &mut State<S>,
        scratch: &[Value<S>],
        r: Registers<'_, S>,
        node: NodeId,
        number: u16,
        site: &Site,
    ) -> Result<(), Halt> {
        let operands = &r.f.operands[site.args.range()];
        let (list, at) = (r.get(state, scratch, operands[0]), r.get(state, scratch, operands[1]));
        let element = match index::index_ref(list, at) {
            Some(element) => element.clone(),
            None => index::index(list, at)?,
        };
        let slot = Kept::slot_at(state, node, number as usize);
        let (value, held) = match element {
            Value::Cell(cell) => (state.registers[cell.register as usize].clone(), cell.readers),
            other => (other, Slot::UNWATCHED),
        };
        let before = self.slots[slot];
        if before.held != held {
            let reader = Reader { node, site: number, slot: slot as u32 };
            if before.is_filled() {
                // The list that contains a reader matters only when an element changes, and at a commit: most
                // transactions are not committed.
                if before.mark & Slot::MOVING == 0 {
                    self.journal.moves.push((reader, before.held));
                }
                self.slots[slot] = Slot { held, mark: before.mark | Slot::MOVING, ..before };
            } else {
                self.journal.reads.push((reader, before.held));
                self.subscribe(reader, held);
            }
        }
        self.write_to(state, self.quiet, r.base + site.to.index(), value);
        Ok(())
    }

    /// Moves readers that now read another element from their old lists to the lists of their elements.
    pub(super) fn move_readers(&mut self) {
        for i in 0..self.journal.moves.len() {
            let (reader, before) = self.journal.moves[i];
            let slot = &mut self.slots[reader.slot as usize];
            let held = std::mem::replace(&mut slot.held, before);
            slot.mark &= !Slot::MOVING;
            self.journal.reads.push((reader, before));
            self.subscribe(reader, held);
        }
        self.journal.moves.clear();
    }

    /// Moves a reader from its list to another; `held` may stand for no list.
    pub(super) fn subscribe(&mut self, reader: Reader, held: u32) {
        let slot = self.slots[reader.slot as usize];
        if slot.held < Slot::UNWATCHED {
            let all = &mut self.readers[slot.held as usize].all;
            all.swap_remove(slot.mark as usize);
            if let Some(moved) = all.get(slot.mark as usize) {
                let place = &mut self.slots[moved.slot as usize].mark;
                *place = slot.mark | *place & Slot::MOVING;
            }
        }
        let mut mark = 0;
        if held < Slot::UNWATCHED {
            let all = &mut self.readers[held as usize].all;
            mark = all.len() as u32;
            all.push(reader);
        }
        self.slots[reader.slot as usize] = Slot { held, mark, log: 0.0 };
    }

    /// Wakes the readers of a changed element.
    fn wake(&mut self, state: &State<S>, id: usize) {
        self.move_readers();
        if !self.reuse || self.readers[id].all.is_empty() {
            return;
        }
        if self.marking {
            for i in 0..self.readers[id].all.len() {
                let node = self.readers[id].all[i].node;
                self.mark_above(state, node);
            }
            return;
        }
        self.tangled |= self.woken_done < self.woken.len();
        self.woken.extend_from_slice(&self.readers[id].all);
        self.confined = true;
    }

    /// Records that the run leaves the current activation: a run that must stay within it cannot be used then.
    #[inline(always)]
    pub(super) fn leaves_its_activation(&mut self) {
        self.tangled |= self.confined;
    }

    /// Replaces the cells of a value by their elements, and futures by their values. The value may be a
    /// collection.
    // Tuples that hold collections are no deeper than the program's text.
    pub(super) fn resolved(&self, state: &State<S>, value: &Value<S>) -> Value<S> {
        let value = &value.replace_futures(&|_| None);
        if let Value::Tuple(tuple) = value
            && self.readers.len() > self.free_readers.len()
        {
            return Value::tuple(tuple.items().iter().map(|item| self.resolved(state, item)).collect());
        }
        let Value::List(list) = value else { return value.clone() };
        if !list.iter().any(|item| matches!(item, Value::Cell(_))) {
            return value.clone();
        }
        let element = |item: &Value<S>| match item {
            Value::Cell(cell) => state.registers[cell.register as usize].replace_futures(&|_| None),
            other => other.clone(),
        };
        Value::List(List::from_vec(list.iter().map(element).collect()))
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// Scores a reader here if it only scores. Returns `false` if it does more, or if scoring fails: then it
    /// must be run.
    #[inline(always)]
    fn scores_alone(&mut self, state: &mut State<S>, kept: &mut Kept<S>, node: NodeId, pc: usize) -> bool {
        let f = self.program.function(state.nodes[node.0 as usize].function);
        let (Op::Site { site: number }, Some(Op::Done)) = (f.code[pc], f.code.get(pc + 1)) else {
            return false;
        };
        let site = &f.sites[number.0 as usize];
        if !matches!(site.kind, SiteKind::Observe(_)) {
            return false;
        }
        let (base, outer) = self.bases(state, f, node);
        kept.enter(state, node);
        if kept.factor(self, state, Registers { f, base, outer, scratch: 0 }, node, number).is_err() {
            return false;
        }
        kept.counters.entered += 1;
        kept.counters.instructions += 2;
        kept.note(Step::Entered(node));
        kept.note(Step::Unwound(node));
        true
    }

    /// Runs the woken readers; `None` when the run is tangled.
    pub(super) fn run_readers<A: Answers<S>>(
        &mut self,
        trace: &mut Trace<S>,
        answers: &mut A,
    ) -> Result<Option<Change>, Box<RunFault>> {
        while trace.kept.woken_done < trace.kept.woken.len() {
            let (state, kept) = (&mut trace.state, &mut trace.kept);
            let Reader { node, site, slot } = kept.woken[kept.woken_done];
            kept.woken_done += 1;
            let Some(readers) = kept.readers.get(kept.slots[slot as usize].held as usize) else { continue };
            let n = &state.nodes[node.0 as usize];
            let site = &self.program.function(n.function).sites[site as usize];
            let place = n.registers as usize + site.to.index();
            let value = state.registers[readers.register as usize].clone();
            if !kept.write_to(state, false, place, value) {
                continue;
            }
            let alone = kept.woken.len() == 1;
            let next = site.again as usize;
            if self.scores_alone(state, kept, node, next) {
                continue;
            }
            let change = self.run_kept(trace, node, next, answers);
            if trace.kept.tangled {
                return Ok(None);
            }
            match change {
                Ok(Change::Done) => {}
                // Out of program order, a fault or a score of minus infinity may not be real.
                _ if !alone => return Ok(None),
                other => return other.map(Some),
            }
        }
        Ok(Some(Change::Done))
    }
}
