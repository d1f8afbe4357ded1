//! The parts of a trace: its state, slots, choices and sums, and the current run.

use super::super::buffers::make_room;
use super::super::state::{NodeId, State};
use super::adapt::{Adaptation, Sites};
use super::entry::Entry;
use super::journal::{Journal, MOVING};
use super::memo::Memos;
use super::readers::{Reader, Readers};
use super::slot::Slot;
use super::strategy::{Change, Counters, Step, Totals};
use crate::code::{Mode, Program};
use crate::value::{Value, identical};
use niwaki_geom::Primitive;
use niwaki_math::{Scalar, Total};

/// The place of a choice in the trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChoiceAt {
    pub node: NodeId,
    pub site: u16,
}

/// A loop that was entered from above in the current run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Active {
    pub(super) header: NodeId,
    /// The changes of the captures of its iterations.
    pub(super) captures: Entry,
    /// Whether the loop's sequence has changed.
    pub(super) over: bool,
}

/// The kept data of a trace.
#[derive(Debug)]
pub(crate) struct Kept<S: Scalar> {
    pub slots: Vec<Slot>,
    /// The iterations of each loop node.
    pub loops: Vec<Vec<NodeId>>,
    pub choices: Vec<ChoiceAt>,
    pub emits: Vec<Option<Primitive>>,
    pub free_emits: Vec<u32>,
    /// The readers of each cell.
    pub readers: Vec<Readers>,
    pub free_readers: Vec<u32>,
    pub memos: Memos<S>,
    pub sites: Sites,
    pub result: Value<S>,
    /// The number of times that each held choice is in the trace, and the number of held choices that are not.
    pub met: Vec<i32>,
    pub unmet: usize,
    /// The sums over the trace before the open transaction.
    pub totals: Totals,
    pub counters: Counters,
    pub steps: Option<Vec<Step>>,
    // The open transaction.
    pub journal: Journal<S>,
    pub open: bool,
    /// The changes of the sums by the transaction.
    pub change: Totals,
    pub result_before: Option<Value<S>>,
    /// The log densities of choices that were drawn, and of choices that were removed.
    pub fresh: Total,
    pub stale: Total,
    /// Whether the new value of the changed choice is outside of its support.
    pub outside: bool,
    /// The changed choices: slot, and the log densities of the change and of its reverse.
    pub changed: Vec<(u32, f64, f64)>,
    pub now: u32,
    // The run in progress.
    pub(super) depth: u32,
    /// The current instruction, and the instruction where each activation that was entered from above continues
    /// when it is left.
    pub(super) pc: u32,
    pub(super) returns: Vec<u32>,
    /// Whether the current activation was created in this transaction: then the journal need not record it.
    pub(super) quiet: bool,
    pub(super) early: bool,
    pub(super) reuse: bool,
    pub(super) active: Vec<Active>,
    /// The last transaction in which each node was marked as being above a changed choice.
    pub(super) marks: Vec<u32>,
    pub(super) marking: bool,
    /// The readers of changed cells, and the number of those that have run.
    pub(super) woken: Vec<Reader>,
    pub(super) woken_done: usize,
    /// Whether the run must not leave the current activation, and whether it did.
    pub(super) confined: bool,
    pub(super) tangled: bool,
}

/// A run whose activations are kept.
#[derive(Debug)]
pub struct Trace<S: Scalar = f64> {
    pub(crate) state: State<S>,
    pub(crate) kept: Kept<S>,
}

impl<S: Scalar> Kept<S> {
    pub(super) fn new(program: &Program<S>) -> Self {
        Kept {
            slots: vec![],
            loops: vec![],
            choices: vec![],
            emits: vec![],
            free_emits: vec![],
            readers: vec![],
            free_readers: vec![],
            memos: Memos::default(),
            sites: Sites::new(program, Some(Adaptation::default())),
            result: Value::None,
            met: vec![],
            unmet: 0,
            totals: Totals::default(),
            counters: Counters::default(),
            steps: None,
            journal: Journal::default(),
            open: false,
            change: Totals::default(),
            result_before: None,
            fresh: Total::default(),
            stale: Total::default(),
            outside: false,
            changed: vec![],
            now: 0,
            depth: 0,
            pc: 0,
            returns: vec![],
            quiet: false,
            early: false,
            reuse: false,
            active: vec![],
            marks: vec![],
            marking: false,
            woken: vec![],
            woken_done: 0,
            confined: false,
            tangled: false,
        }
    }

    #[inline(always)]
    pub(super) fn slot_at(state: &State<S>, node: NodeId, site: usize) -> usize {
        state.nodes[node.0 as usize].slots as usize + site
    }

    #[inline]
    pub(super) fn is_new(&self, state: &State<S>, node: NodeId) -> bool {
        state.nodes[node.0 as usize].created == self.now
    }

    #[inline(always)]
    pub(super) fn note(&mut self, step: Step) {
        if let Some(steps) = &mut self.steps {
            steps.push(step);
        }
    }

    /// Stores a value in a register of a node; `false` if the register has that value already.
    #[inline]
    pub(super) fn write_to(
        &mut self,
        state: &mut State<S>,
        node_is_new: bool,
        place: usize,
        value: Value<S>,
    ) -> bool {
        let register = &mut state.registers[place];
        if identical(register, &value) {
            return false;
        }
        if node_is_new {
            register.store(value);
        } else {
            self.journal.set(register, place, value);
        }
        true
    }

    /// Writes a slot.
    #[inline]
    pub(super) fn write_slot(&mut self, node_is_new: bool, at: usize, slot: Slot) {
        if !node_is_new {
            self.journal.slots.push((at as u32, self.slots[at]));
        }
        self.slots[at] = slot;
    }

    /// Creates a node with empty slots.
    pub(super) fn new_node(
        &mut self,
        program: &Program<S>,
        state: &mut State<S>,
        function: crate::code::FunctionId,
        parent: NodeId,
        site: u32,
        path: u128,
    ) -> NodeId {
        let count = state.nodes.len();
        let created = state.new_node(program, function, parent, site, path);
        let node = &mut state.nodes[created.0 as usize];
        node.created = self.now;
        // A new iteration has a kind of exit with which no iteration ends.
        node.pc = u32::MAX;
        if created.0 as usize == count {
            let f = program.function(function);
            if f.mode == Mode::Loop {
                node.slots = self.loops.len() as u32;
                self.loops.push(Vec::new());
            } else {
                node.slots = self.slots.len() as u32;
                make_room(&mut self.slots, f.sites.len(), || state.ceiling.saturating_sub(state.bytes()));
                self.slots.resize(self.slots.len() + f.sites.len(), Slot::EMPTY);
            }
            state.charged += (f.sites.len() + 1) * size_of::<Slot>();
        }
        state.charged += size_of::<NodeId>() + MOVING;
        self.journal.more().created.push(created);
        self.note(Step::Created(created));
        created
    }

    /// Bytes of the kept data, without values and the journal.
    pub(super) fn own_bytes(&self) -> usize {
        self.slots.len() * size_of::<Slot>()
            + self.choices.len() * size_of::<ChoiceAt>()
            + self.loops.iter().map(|l| size_of_val(l) + l.capacity() * size_of::<NodeId>()).sum::<usize>()
            + self.emits.len() * (size_of::<Option<Primitive>>() + 16)
            + self.readers.iter().map(Readers::bytes).sum::<usize>()
            + self.marks.len() * size_of::<u32>()
            + self.memos.bytes()
    }

    /// Releases a node and empties its slots.
    pub(super) fn release(&mut self, program: &Program<S>, state: &mut State<S>, id: NodeId) {
        let node = state.nodes[id.0 as usize];
        let f = program.function(node.function);
        if f.mode == Mode::Loop {
            self.loops[node.slots as usize].clear();
        } else {
            let at = node.slots as usize;
            self.slots[at..at + f.sites.len()].fill(Slot::EMPTY);
        }
        state.release(program, id);
    }

    /// Counts a held choice that enters the trace (1) or leaves it (-1).
    pub(super) fn count_held(&mut self, number: u32, change: i32) {
        let met = &mut self.met[number as usize];
        self.unmet -= usize::from(*met == 0);
        *met += change;
        self.unmet += usize::from(*met == 0);
    }

    /// The outcome of a run that came to its end: without all held choices it is impossible.
    pub(super) fn with_all_held(&self, change: Change) -> Change {
        if change == Change::Done && self.unmet > 0 { Change::Impossible } else { change }
    }

    /// Whether a node is above a changed choice, in a run that starts at the root.
    #[inline(always)]
    pub(super) fn is_marked(&self, node: NodeId) -> bool {
        self.marking && self.marks.get(node.0 as usize).is_some_and(|mark| *mark == self.now)
    }
}
