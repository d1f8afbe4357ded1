//! Machine code as a program stores it: its inputs, its exits, and how it runs. This module does not know who
//! writes the code, or how.

use super::operand::{FunctionId, Operand};
use super::register::{Kind, Reg};
use crate::value::Value;
use std::any::Any;

/// A function over the first register of the activation, of the loop node above it, and of the machine. It
/// returns the number of the exit that it took, or [`NOT_ENTERED`].
pub(crate) type Start = unsafe extern "C" fn(*mut Exchange, *mut Value, *const Value, *mut Value) -> u64;

/// The answer of code that found a register of another kind, and did nothing.
pub(crate) const NOT_ENTERED: i64 = -1;

/// The numbers that machine code and the machine exchange.
#[derive(Clone, Copy, Default)]
#[repr(C)]
pub(crate) struct Exchange {
    /// Steps that the code may take; after the run, the steps that are left.
    pub steps: i64,
    /// Bytes that the code may charge; after the run, the bytes that are left.
    pub bytes: i64,
    /// Scratch registers that the run has used before, from the first one of the function on.
    pub room: i64,
    /// The number of instructions that the code ran.
    pub instructions: u64,
}

/// Instructions of the processor, and the memory that holds them.
pub(crate) struct Instructions {
    start: Start,
    bytes: usize,
    _owner: Box<dyn Any + Send + Sync>,
}

impl Instructions {
    /// Instructions that take `bytes` bytes from `start` on.
    ///
    /// # Safety
    /// The instructions exist as long as `owner` does. They access nothing but the numbers of the exchange, the
    /// registers that their routine names, and what is lent by constants and by registers whose kinds they have
    /// tested.
    #[allow(unsafe_code)]
    pub unsafe fn new(start: Start, bytes: usize, owner: Box<dyn Any + Send + Sync>) -> Instructions {
        Instructions { start, bytes, _owner: owner }
    }
}

/// Machine code for one combination of kinds.
pub(crate) struct Routine {
    /// Registers that the code reads where it begins, and the kinds that it tests there.
    pub inputs: Vec<(Reg, Kind)>,
    /// One past the last register of the machine that the code accesses.
    pub scratch_end: usize,
    /// The places where the code may leave.
    pub exits: Vec<Exit>,
    /// Whether the code writes registers of the activation.
    pub writes_node: bool,
    /// Whether the code takes steps or charges memory.
    pub counts: bool,
    /// The instructions.
    pub code: Instructions,
}

impl std::fmt::Debug for Routine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Routine({} bytes, {:?})", self.bytes(), self.inputs)
    }
}

/// A place where machine code leaves.
#[derive(Debug)]
pub(crate) struct Exit {
    /// Calls of pure functions that are in progress, from the outermost on.
    pub calls: Vec<Call>,
    /// The function in which the interpreter continues.
    pub function: FunctionId,
    /// The function's first scratch register, relative to that of the function where the code began.
    pub base: u32,
    /// The instruction at which the interpreter continues.
    pub pc: u32,
    /// Whether the code has put a shared value into a register of the machine.
    pub has_shared: bool,
}

/// A call of a pure function in progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Call {
    /// The calling function.
    pub caller: FunctionId,
    /// The caller's first scratch register.
    pub base: u32,
    /// The instruction where the caller continues.
    pub back: u32,
    /// The register for the result.
    pub to: Operand,
}

impl Routine {
    /// The size of the code in bytes.
    pub fn bytes(&self) -> usize {
        self.code.bytes
    }

    /// Runs the code and returns the exit that it took; `None` if a register has another kind.
    ///
    /// # Safety
    /// The registers of the activation, of the loop node above it, and [`Routine::scratch_end`] registers of the
    /// machine are at these places, and nobody else accesses them meanwhile.
    #[inline]
    #[allow(unsafe_code)]
    pub unsafe fn run(
        &self,
        exchange: &mut Exchange,
        node: *mut Value,
        outer: *const Value,
        scratch: *mut Value,
    ) -> Option<&Exit> {
        // SAFETY: the caller lends all that the code accesses.
        let exit = unsafe { (self.code.start)(exchange, node, outer, scratch) };
        self.exits.get(exit as usize)
    }
}
