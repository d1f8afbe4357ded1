//! The journal: the data that a transaction has overwritten, created and removed.
//!
//! An entry is a place and its earlier content. Undoing reads the entries backwards, so that a place that was
//! written twice gets its first content back. An activation created in the transaction needs no entries: it is
//! removed as a whole.

use super::super::state::NodeId;
use super::readers::Reader;
use super::slot::Slot;
use crate::value::Value;
use niwaki_math::Scalar;

/// The changes of an open transaction that can be undone.
#[derive(Debug)]
pub(crate) struct Journal<S: Scalar> {
    pub registers: Vec<(u32, Value<S>)>,
    pub slots: Vec<(u32, Slot)>,
    /// Reads that moved to another list of readers, and their places before.
    pub reads: Vec<(Reader, u32)>,
    /// Reads of another element than before, and the list that still contains them.
    pub moves: Vec<(Reader, u32)>,
    /// The changes that most transactions do not make.
    pub more: More<S>,
    /// Whether `more` may have entries.
    has_more: bool,
}

/// The changes of the activations, of the set of choices, or of the scene.
#[derive(Debug)]
pub(crate) struct More<S: Scalar> {
    /// The earlier kinds of exit of iterations.
    pub ends: Vec<(NodeId, u32)>,
    /// The changes of the iterations of loops.
    pub loops: Vec<Cut>,
    pub created: Vec<NodeId>,
    pub removed: Vec<NodeId>,
    /// Numbers of primitives that were added to the scene, and of primitives that were removed.
    pub emitted: Vec<u32>,
    pub retracted: Vec<u32>,
    pub births: Vec<Birth>,
    pub deaths: Vec<u32>,
    /// Lists of readers of cells that were created, and of cells that were removed.
    pub cells: Vec<u32>,
    pub dead_cells: Vec<u32>,
    /// Held choices that entered the trace (1) or left it (-1).
    pub met: Vec<(u32, i32)>,
    /// Choices that were drawn again in place: the address, and the value before.
    pub anew: Vec<(u128, Value<S>)>,
}

/// A change of the iterations of a loop: the loop's number, and the number of its iterations that stayed.
#[derive(Debug)]
pub(crate) struct Cut {
    pub number: u32,
    pub len: u32,
    /// The removed iterations, from `len` on.
    pub removed: Vec<NodeId>,
}

/// A choice that the open transaction added.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Birth {
    pub address: u128,
    pub node: NodeId,
    pub site: u16,
}

impl<S: Scalar> Default for Journal<S> {
    fn default() -> Self {
        let more = More {
            ends: vec![],
            loops: vec![],
            created: vec![],
            removed: vec![],
            emitted: vec![],
            retracted: vec![],
            births: vec![],
            deaths: vec![],
            cells: vec![],
            dead_cells: vec![],
            met: vec![],
            anew: vec![],
        };
        Journal { registers: vec![], slots: vec![], reads: vec![], moves: vec![], more, has_more: false }
    }
}

/// Bytes that are counted for each created activation, beside its stored data.
pub(crate) const MOVING: usize = 32;

impl<S: Scalar> Journal<S> {
    /// The changes that most transactions do not make, to add some.
    #[inline]
    pub fn more(&mut self) -> &mut More<S> {
        self.has_more = true;
        &mut self.more
    }

    /// Whether changes of [`Journal::more`] may have been recorded.
    #[inline(always)]
    pub fn has_more(&self) -> bool {
        self.has_more
    }

    /// Stores a value in a register, by its number, and records the earlier value.
    #[inline(always)]
    pub fn set(&mut self, register: &mut Value<S>, place: usize, value: Value<S>) {
        self.registers.push((place as u32, std::mem::replace(register, value)));
    }

    /// Bytes of the entries, without the data behind values.
    pub fn bytes(&self) -> usize {
        fn of<T>(entries: &[T]) -> usize {
            size_of_val(entries)
        }
        let more = &self.more;
        of(&self.registers)
            + of(&self.slots)
            + of(&self.reads)
            + of(&self.moves)
            + of(&more.ends)
            + of(&more.loops)
            + more.loops.iter().map(|cut| of(&cut.removed)).sum::<usize>()
            + of(&more.created)
            // Vectors that grow with the nodes are in memory twice while they move.
            + more.created.len() * MOVING
            + of(&more.removed)
            + of(&more.emitted)
            + of(&more.retracted)
            + of(&more.births)
            + of(&more.deaths)
            + of(&more.cells)
            + of(&more.dead_cells)
            + of(&more.met)
            + of(&more.anew)
    }

    /// Forgets all entries.
    #[inline(always)]
    pub fn clear(&mut self) {
        // Most values are numbers: there is nothing to drop, but the compiler does not know that.
        while let Some((_, value)) = self.registers.pop() {
            if value.is_plain() {
                std::mem::forget(value);
            }
        }
        self.slots.clear();
        self.reads.clear();
        self.moves.clear();
        if self.has_more {
            self.clear_more();
        }
    }

    #[inline(never)]
    fn clear_more(&mut self) {
        self.has_more = false;
        let more = &mut self.more;
        more.ends.clear();
        more.loops.clear();
        more.created.clear();
        more.removed.clear();
        more.emitted.clear();
        more.retracted.clear();
        more.births.clear();
        more.deaths.clear();
        more.cells.clear();
        more.dead_cells.clear();
        more.met.clear();
        more.anew.clear();
    }
}
