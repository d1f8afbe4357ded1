//! How a run stops, and how it goes on after a question or a site.

use super::ids::NodeId;
use crate::code::{FunctionId, Operand};
use crate::fault::Fault;

/// Why a run stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The answer was to pause.
    Paused,
    /// The future that ran has returned.
    Returned,
    /// The future that ran waits for another.
    Waiting,
    /// The score is minus infinity. Only where activations are kept: elsewhere the answers report it.
    Impossible,
}

/// Why the run stops at a question. Two words with the `Ok` around it, so that it is returned in registers.
pub(super) enum Halt {
    /// The answer was to pause.
    Paused,
    /// The answer to a held choice was to pause. The run continues after it.
    PausedAfter,
    /// The score is minus infinity.
    Impossible,
    /// The question is not valid, or was answered by a fault.
    Fault(Fault),
}

impl From<Fault> for Halt {
    #[inline]
    fn from(fault: Fault) -> Halt {
        Halt::Fault(fault)
    }
}

/// How to continue after a site.
pub(super) enum After {
    /// At the next instruction.
    Next,
    /// In another activation, at that instruction.
    Enter(NodeId, u32),
    /// At another instruction of this one.
    Goto(u32),
    /// In a pure function, its arguments in the buffer.
    Pure { function: FunctionId, to: Operand, as_future: bool },
    /// In a pure function, which lanes have entered.
    Entered,
    /// The run stops here.
    Stop(Stop),
}
