//! Memoised calls of a trace: activations with several callers.
//!
//! A call of a memoised function is an activation that no caller owns: its address consists of the function and
//! the arguments (`machine::memo`). Each site that requests it is a *reader*, whose slot has the activation's
//! node. In a transaction
//!
//! * a reader with other arguments leaves one call and joins another, which may exist;
//! * a call runs again at its first reader in program order, if at all: when its captures have changed, or when
//!   a changed choice is below it. All later readers get the value;
//! * a choice below a call may be read at many places, so a run that changes such a choice starts at the root.
//!   All readers and the activations above them are marked to be entered ([`Kept::mark_above`]). Nothing
//!   without a mark can change: the arguments of a call are its address, and its captures are in the function
//!   value that each reader has;
//! * a call without readers is removed at the end of the run, not when the last reader leaves: a reader that
//!   joins later in the same run finds the choices, as the reverse of this transaction would.
//!
//! While a call runs, the parent of its node is the reader for which it runs; at other times that field has no
//! meaning.

use super::super::Machine;
use super::super::memo::{TEXT, call_of, cycle};
use super::super::outcome::Continuation;
use super::super::outcome::Halt;
use super::super::registers::Registers;
use super::super::state::{NodeId, State};
use super::entry::Entry;
use super::slot::Slot;
use super::strategy::Step;
use super::trace::Kept;
use crate::code::{FunctionId, Program, Site, SiteId};
use crate::value::{Memo, Value, identical};
use niwaki_math::Scalar;
use std::collections::{BTreeSet, HashMap};

/// A site that requests a call: its activation, and its number.
type ReaderSite = (u32, u16);

/// A memoised call.
#[derive(Debug)]
struct Call<S: Scalar> {
    path: u128,
    name: String,
    node: NodeId,
    value: Value<S>,
    readers: BTreeSet<ReaderSite>,
    /// The transaction in which the call ran last.
    ran: u32,
}

/// The memoised calls of a trace.
#[derive(Debug)]
pub(crate) struct Memos<S: Scalar> {
    calls: Vec<Option<Call<S>>>,
    free: Vec<u32>,
    by_path: HashMap<u128, u32>,
    /// Calls that a reader left in the open transaction.
    left: Vec<u32>,
    /// Calls that run, outermost first.
    running: Vec<u32>,
    journal: Vec<Event<S>>,
}

/// An effect of the open transaction on the calls.
#[derive(Debug)]
enum Event<S: Scalar> {
    Created(u32),
    Joined(u32, ReaderSite),
    Left(u32, ReaderSite),
    /// The call returned another value; its value before.
    Revalued(u32, Value<S>),
    Removed(u32),
}

impl<S: Scalar> Default for Memos<S> {
    fn default() -> Self {
        Memos {
            calls: vec![],
            free: vec![],
            by_path: HashMap::new(),
            left: vec![],
            running: vec![],
            journal: vec![],
        }
    }
}

impl<S: Scalar> Memos<S> {
    /// Whether there are no calls.
    pub fn is_empty(&self) -> bool {
        self.by_path.is_empty()
    }

    /// Prepares a run.
    pub fn prepare(&mut self) {
        self.running.clear();
    }

    /// The values of the calls, and the values in the journal.
    pub fn values(&self) -> impl Iterator<Item = &Value<S>> {
        let before = self.journal.iter().filter_map(|event| match event {
            Event::Revalued(_, value) => Some(value),
            _ => None,
        });
        self.calls.iter().flatten().map(|call| &call.value).chain(before)
    }

    /// Bytes of the table and its journal, without values.
    pub fn bytes(&self) -> usize {
        let readers: usize =
            self.calls.iter().flatten().map(|call| call.readers.len() + call.name.len()).sum();
        self.calls.len() * (size_of::<Option<Call<S>>>() + 32)
            + readers * 2 * size_of::<ReaderSite>()
            + self.journal.len() * size_of::<Event<S>>()
    }

    fn at(&mut self, number: u32) -> &mut Call<S> {
        self.calls[number as usize].as_mut().expect("a call that is not removed")
    }

    /// The activations that read a call.
    pub fn readers(&self, number: u32) -> impl Iterator<Item = NodeId> {
        let call = self.calls[number as usize].as_ref();
        call.into_iter().flat_map(|call| call.readers.iter().map(|(node, _)| NodeId(*node)))
    }

    fn join(&mut self, number: u32, reader: ReaderSite) {
        self.at(number).readers.insert(reader);
        self.journal.push(Event::Joined(number, reader));
    }

    /// Removes a reader from a call.
    pub fn leave(&mut self, number: u32, reader: ReaderSite) {
        self.at(number).readers.remove(&reader);
        self.left.push(number);
        self.journal.push(Event::Left(number, reader));
    }

    /// Whether the open transaction may have changed a call, or its readers.
    #[inline(always)]
    pub fn has_changed(&self) -> bool {
        !self.journal.is_empty() || !self.left.is_empty()
    }

    /// Commits the transaction.
    pub fn commit(&mut self) {
        for event in std::mem::take(&mut self.journal) {
            if let Event::Removed(number) = event {
                self.calls[number as usize] = None;
                self.free.push(number);
            }
        }
        self.left.clear();
    }

    /// Undoes the transaction.
    pub fn undo(&mut self, state: &mut State<S>) {
        while let Some(event) = self.journal.pop() {
            match event {
                Event::Created(number) => {
                    let path = self.at(number).path;
                    self.by_path.remove(&path);
                    state.memos.forget(path);
                    self.calls[number as usize] = None;
                    self.free.push(number);
                }
                Event::Joined(number, reader) => {
                    self.at(number).readers.remove(&reader);
                }
                Event::Left(number, reader) => {
                    self.at(number).readers.insert(reader);
                }
                Event::Revalued(number, before) => self.at(number).value = before,
                Event::Removed(number) => {
                    let call = self.at(number);
                    let (path, name) = (call.path, call.name.clone());
                    self.by_path.insert(path, number);
                    state.memos.note(path, &name);
                }
            }
        }
        self.left.clear();
    }
}

impl<S: Scalar> Kept<S> {
    /// Calls a memoised function whose arguments and captures are in the machine's buffer.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    pub(super) fn recall(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        (node, number): (NodeId, SiteId),
        site: &Site,
        function: FunctionId,
        memo: &Memo,
    ) -> Result<Continuation, Halt> {
        let params = machine.program.function(function).params as usize;
        let (path, name) = call_of(memo, &machine.buffer[..params])?;
        state.steps = state.steps.saturating_add(name.len() as u64 / TEXT);
        let known = self.memos.by_path.get(&path).copied();
        let at = Kept::slot_at(state, node, number.0 as usize);
        let (held, reader) = (self.slots[at].held, (node.0, number.0));
        let is_joined = held != Slot::NOTHING
            && known.is_some_and(|known| state.nodes[held as usize].memo() == Some(known));
        if !is_joined {
            self.leaves_its_activation();
            self.vacate(machine.program, state, node, number.0);
        }
        let Some(known) = known else {
            let created = self.new_node(machine.program, state, function, node, u32::from(number.0), path);
            machine.afford(state, self)?;
            self.write_slot(self.quiet, at, Slot { held: created.0, mark: 0, log: 0.0 });
            let to = state.nodes[created.0 as usize].registers as usize;
            for (i, value) in machine.buffer.drain(..).enumerate() {
                state.registers[to + i].store(value);
            }
            self.make_call(state, created, path, name, reader);
            return Ok(self.enter_call(created, 0));
        };
        if self.memos.running.contains(&known) {
            return Err(Halt::Fault(cycle(&name)));
        }
        let (child, ran) = (self.memos.at(known).node, self.memos.at(known).ran);
        if !is_joined {
            self.write_slot(self.quiet, at, Slot { held: child.0, mark: 0, log: 0.0 });
            self.memos.join(known, reader);
        }
        let mut changed = Entry::Unchanged;
        let to = state.nodes[child.0 as usize].registers as usize;
        for (i, value) in machine.buffer.drain(..).enumerate().skip(params) {
            if self.write_to(state, false, to + i, value) {
                changed.add(0);
            }
        }
        let is_current = changed == Entry::Unchanged && self.reuse && !self.is_marked(child);
        if ran == self.now || is_current {
            debug_assert!(changed == Entry::Unchanged, "one function value for one identity in a run");
            self.counters.skipped += 1;
            self.note(Step::Skipped(child));
            let value = self.memos.at(known).value.clone();
            let value = if site.kind.gives_future() { Value::returned(value) } else { value };
            let changed = self.write_to(state, self.quiet, r.base + site.to.index(), value);
            return Ok(self.after(r.f, site, changed));
        }
        let n = &mut state.nodes[child.0 as usize];
        (n.parent, n.site) = (node, u32::from(number.0));
        self.memos.at(known).ran = self.now;
        self.memos.running.push(known);
        // The call does not run in a slice: the reader may have no value so far.
        Ok(self.enter_call(child, 0))
    }

    fn make_call(
        &mut self,
        state: &mut State<S>,
        node: NodeId,
        path: u128,
        name: String,
        reader: ReaderSite,
    ) {
        let call = Call {
            path,
            name: name.clone(),
            node,
            value: Value::None,
            readers: BTreeSet::new(),
            ran: self.now,
        };
        let number = match self.memos.free.pop() {
            Some(number) => {
                self.memos.calls[number as usize] = Some(call);
                number
            }
            None => {
                self.memos.calls.push(Some(call));
                self.memos.calls.len() as u32 - 1
            }
        };
        state.nodes[node.0 as usize].set_memo(number);
        state.memos.note(path, &name);
        state.charged += size_of::<Call<S>>() + name.len();
        self.memos.by_path.insert(path, number);
        self.memos.journal.push(Event::Created(number));
        self.memos.join(number, reader);
        self.memos.running.push(number);
    }

    /// Records the value of a memoised call. Returns `false` if the run is confined to the call, so that it
    /// must end here.
    pub(super) fn settle(&mut self, number: u32, value: &Value<S>) -> bool {
        let changed = !identical(&self.memos.at(number).value, value);
        if self.depth == 0 {
            if changed {
                self.leaves_its_activation();
            }
            return false;
        }
        self.memos.running.pop();
        if changed {
            let before = std::mem::replace(&mut self.memos.at(number).value, value.clone());
            self.memos.journal.push(Event::Revalued(number, before));
        }
        true
    }

    /// Removes calls without readers at the end of a run, and the calls that only these read.
    pub(super) fn remove_unread(&mut self, program: &Program<S>, state: &mut State<S>) {
        while !self.memos.left.is_empty() {
            let mut left = std::mem::take(&mut self.memos.left);
            left.retain(|number| {
                self.memos.calls[*number as usize].as_ref().is_some_and(|c| c.readers.is_empty())
            });
            // The order is the same in all strategies.
            left.sort_unstable_by_key(|number| self.memos.at(*number).path);
            left.dedup();
            for number in left {
                let (path, node) = (self.memos.at(number).path, self.memos.at(number).node);
                if self.memos.by_path.remove(&path).is_none() {
                    continue;
                }
                state.memos.forget(path);
                self.memos.journal.push(Event::Removed(number));
                self.remove(program, state, node);
            }
        }
    }

    /// The memoised call in the slot of a call, if it is one.
    #[inline]
    pub(super) fn shared(&self, state: &State<S>, slot: Slot) -> Option<u32> {
        state.nodes[slot.held as usize].memo()
    }

    /// Whether an activation belongs to a memoised call: then activations that are not above it may depend on
    /// it.
    pub(super) fn is_memoised(&self, state: &State<S>, node: NodeId) -> bool {
        let mut at = node;
        while !self.memos.is_empty() && at != NodeId::NONE {
            let n = &state.nodes[at.0 as usize];
            if n.memo().is_some() {
                return true;
            }
            at = n.parent;
        }
        false
    }
}

impl<S: Scalar> State<S> {
    /// The activation above another one in a trace: its caller, or the root for a memoised call. `NONE` for the
    /// root itself.
    pub(super) fn above(&self, node: NodeId) -> NodeId {
        let n = &self.nodes[node.0 as usize];
        if n.memo().is_some() { NodeId(0) } else { n.parent }
    }
}
