//! Machine code as a program stores it: its inputs, its exits, and how it runs. This module does not know who
//! writes the code, or how.

use super::operand::{FunctionId, Operand};
use super::register::{Kind, Reg};
use std::any::Any;

/// A function over the words that [`words`] describes. It returns the number of the exit that it took.
pub(crate) type Start = unsafe extern "C" fn(*mut u64) -> u64;

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
    /// The instructions exist as long as `owner` does and stay within the words that their routine names. They
    /// access nothing but these words, and what is lent by constants and registers of the kinds that they were
    /// written for.
    #[allow(unsafe_code)]
    pub unsafe fn new(start: Start, bytes: usize, owner: Box<dyn Any + Send + Sync>) -> Instructions {
        Instructions { start, bytes, _owner: owner }
    }
}

/// Machine code for one combination of kinds.
pub(crate) struct Routine {
    /// Registers that the code reads where it begins, and their kinds there.
    pub inputs: Vec<Input>,
    /// Constants that are not numbers: the function and the index of each.
    pub constants: Vec<(FunctionId, u16)>,
    /// Other registers that the code may write: they must hold no shared value.
    pub overwritten: Vec<Reg>,
    /// The number of overwritten registers that belong to the activation: these come first.
    pub overwritten_nodes: usize,
    /// One past the last overwritten register that belongs to the machine.
    pub scratch_end: usize,
    /// The places where the code may leave.
    pub exits: Vec<Exit>,
    /// Whether the code writes registers of the activation.
    pub writes_node: bool,
    /// The number of words that the code exchanges with the machine.
    pub words: usize,
    /// The instructions.
    pub code: Instructions,
}

impl std::fmt::Debug for Routine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Routine({} bytes, {:?})", self.bytes(), self.inputs)
    }
}

/// A register that machine code reads where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input {
    pub reg: Reg,
    pub kind: Kind,
    /// The register's first word.
    pub word: usize,
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
    /// The registers that have changed, in the order of their words.
    pub registers: Vec<(Reg, Kind)>,
    /// Whether a changed register holds a shared value.
    pub has_objects: bool,
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

    /// Runs the code and returns the exit that it took.
    ///
    /// # Panics
    /// There are fewer words than [`Routine::words`].
    #[inline]
    #[allow(unsafe_code)]
    pub fn run(&self, words: &mut [u64]) -> &Exit {
        assert!(words.len() >= self.words);
        // SAFETY: the code stays within these words. The addresses among them point to values of the kinds that
        // the code was written for, because `enter` put them there, and nobody changes these values meanwhile.
        let exit = unsafe { (self.code.start)(words.as_mut_ptr()) };
        &self.exits[exit as usize]
    }
}

/// The words that machine code and the machine exchange.
pub(crate) mod words {
    /// Steps that the code may take; after the run, the steps that are left.
    pub const STEPS: usize = 0;
    /// The number of instructions that the code ran.
    pub const INSTRUCTIONS: usize = 1;
    /// Scratch registers that the run has used before, from the first one of the function on.
    pub const ROOM: usize = 2;
    /// Bytes that the code may charge; after the run, the bytes that are left.
    pub const BYTES: usize = 3;
    /// Addresses of constants, at most [`MOST_CONSTANTS`].
    pub const CONSTANTS: usize = 4;
    pub const MOST_CONSTANTS: usize = 32;
    /// Registers: their contents where the code begins, and where it leaves.
    pub const REGISTERS: usize = CONSTANTS + MOST_CONSTANTS;
}
