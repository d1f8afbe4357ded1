//! How a run stops, and how it continues after a question or a site.

use super::ids::NodeId;
use crate::code::{FunctionId, Operand};
use crate::fault::Fault;

/// The reason why a run stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The answer was to pause.
    Paused,
    /// The running future has returned.
    Returned,
    /// The running future waits for another future.
    Waiting,
    /// The score is minus infinity. Used only where activations are kept: elsewhere the answers report it.
    Impossible,
}

/// The reason why a run stops at a question. It has two words with the `Ok` around it, so that it is returned
/// in registers.
pub(super) enum Halt {
    /// The answer was to pause.
    Paused,
    /// The answer to a held choice was to pause. The run continues after it.
    PausedAfter,
    /// The score is minus infinity.
    Impossible,
    /// The question is not valid, or the answer was a fault.
    Fault(Fault),
}

impl From<Fault> for Halt {
    #[inline]
    fn from(fault: Fault) -> Halt {
        Halt::Fault(fault)
    }
}

/// The continuation after a site.
pub(super) enum Continuation {
    /// At the next instruction.
    Next,
    /// In another activation, at this instruction.
    Enter(NodeId, u32),
    /// At another instruction of this activation.
    Goto(u32),
    /// In a pure function, whose arguments are in the buffer.
    Pure { function: FunctionId, to: Operand, as_future: bool },
    /// In a pure function that lanes have entered.
    Entered,
    /// The run stops here.
    Stop(Stop),
}
