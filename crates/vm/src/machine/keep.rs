//! The interface that decides whether an activation is dropped when it returns, or kept as a node of the trace.
//!
//! The loop over instructions is written once and compiled twice. With [`Dropped`] it runs particles and
//! forward samples; with [`Kept`](super::kept::Kept) it also re-runs the part that a changed choice reaches.

use super::Machine;
use super::answers::Answers;
use super::outcome::Continuation;
use super::outcome::Halt;
use super::registers::Registers;
use super::state::{NodeId, State};
use crate::code::{Args, Operand, SiteId};
use crate::fault::Fault;
use crate::value::{Census, Value};
use niwaki_math::Scalar;

/// The place where a run continues: an instruction of an activation, or the end. It is one word, so that it
/// fits a register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Target(u64);

impl Target {
    /// The run is over.
    pub const END: Target = Target(u64::MAX);

    /// Continues at an instruction.
    #[inline(always)]
    pub fn at(node: NodeId, pc: u32) -> Target {
        Target(u64::from(node.0) << 32 | u64::from(pc))
    }

    /// The place, unless the run is over.
    #[inline(always)]
    pub fn place(self) -> Option<(NodeId, u32)> {
        (self != Target::END).then_some((NodeId((self.0 >> 32) as u32), self.0 as u32))
    }
}

/// The storage of activations. Where they are dropped, only `KEEPS` is used.
pub(super) trait Keep<S: Scalar>: Sized {
    /// Whether activations are kept.
    const KEEPS: bool;

    /// The machine continues in this activation.
    fn enter(&mut self, state: &State<S>, node: NodeId);

    /// Whether registers of the current activation are written without a record of their earlier contents.
    fn writes_plainly(&self) -> bool;

    /// Writes a register of the current activation.
    fn write(&mut self, state: &mut State<S>, place: usize, value: Value<S>);

    /// Records the current instruction.
    fn at(&mut self, pc: usize);

    /// Runs a choice, and returns the instruction at which to continue.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    fn choose<A: Answers<S>>(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        answers: &mut A,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<usize, Halt>;

    /// Runs a factor.
    fn factor(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<(), Halt>;

    /// Runs a site that is neither a choice nor a factor.
    fn suspend(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<Continuation, Halt>;

    /// Clears sites that are not on the path taken.
    fn clear(&mut self, machine: &Machine<'_, S>, state: &mut State<S>, node: NodeId, from: u16, to: u16);

    /// Returns from an activation, and returns where to continue, unless the run is over.
    fn give_back(
        &mut self,
        machine: &Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
        value: Value<S>,
    ) -> Target;

    /// Ends an iteration, and returns where to continue, unless the run is over.
    fn end_iteration(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        exit: i64,
        carried: Args,
    ) -> Result<Target, Fault>;

    /// Repeats a call of which only the argument `arg` may have changed.
    fn pass(
        &mut self,
        machine: &Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        arg: u16,
    ) -> Continuation;

    /// Ends an activation with the same results as before, and returns where to continue, unless the run is
    /// over.
    fn done(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
    ) -> Result<Target, Fault>;

    /// Counts instructions that were run.
    fn count(&mut self, instructions: u64);

    /// Counts the bytes of the trace, without nodes and registers.
    fn count_bytes<'v>(&'v self, census: &mut Census<'v, S>);
}

/// Puts a value into a register of the activation or of the machine. It is noted if a register may hold shared data: those of
/// the machine are emptied after the run.
#[inline(always)]
pub(super) fn put<S: Scalar, K: Keep<S>>(
    keep: &mut K,
    state: &mut State<S>,
    (scratch, holds_shared): (&mut [Value<S>], &mut bool),
    r: Registers<'_, S>,
    o: Operand,
    value: Value<S>,
) {
    if K::KEEPS && o.is_node() {
        keep.write(state, r.base + o.index(), value);
    } else {
        *holds_shared |= !o.is_node() && !value.is_plain();
        r.slot(state, scratch, o).store(value);
    }
}

/// Activations are released when they return.
pub(super) struct Dropped;

impl<S: Scalar> Keep<S> for Dropped {
    const KEEPS: bool = false;

    fn enter(&mut self, _: &State<S>, _: NodeId) {}

    fn writes_plainly(&self) -> bool {
        true
    }

    fn write(&mut self, _: &mut State<S>, _: usize, _: Value<S>) {}

    fn at(&mut self, _: usize) {}

    fn choose<A: Answers<S>>(
        &mut self,
        _: &mut Machine<'_, S>,
        _: &mut State<S>,
        _: &mut A,
        _: Registers<'_, S>,
        _: NodeId,
        _: SiteId,
    ) -> Result<usize, Halt> {
        Ok(0)
    }

    fn factor(
        &mut self,
        _: &mut Machine<'_, S>,
        _: &mut State<S>,
        _: Registers<'_, S>,
        _: NodeId,
        _: SiteId,
    ) -> Result<(), Halt> {
        Ok(())
    }

    fn suspend(
        &mut self,
        _: &mut Machine<'_, S>,
        _: &mut State<S>,
        _: Registers<'_, S>,
        _: NodeId,
        _: SiteId,
    ) -> Result<Continuation, Halt> {
        Ok(Continuation::Next)
    }

    fn clear(&mut self, _: &Machine<'_, S>, _: &mut State<S>, _: NodeId, _: u16, _: u16) {}

    fn give_back(&mut self, _: &Machine<'_, S>, _: &mut State<S>, _: NodeId, _: Value<S>) -> Target {
        Target::END
    }

    fn end_iteration(
        &mut self,
        _: &mut Machine<'_, S>,
        _: &mut State<S>,
        _: Registers<'_, S>,
        _: NodeId,
        _: i64,
        _: Args,
    ) -> Result<Target, Fault> {
        Ok(Target::END)
    }

    fn pass(
        &mut self,
        _: &Machine<'_, S>,
        _: &mut State<S>,
        _: Registers<'_, S>,
        _: NodeId,
        _: SiteId,
        _: u16,
    ) -> Continuation {
        Continuation::Next
    }

    fn done(&mut self, _: &mut Machine<'_, S>, _: &mut State<S>, _: NodeId) -> Result<Target, Fault> {
        Ok(Target::END)
    }

    fn count(&mut self, _: u64) {}

    fn count_bytes<'v>(&'v self, _: &mut Census<'v, S>) {}
}
