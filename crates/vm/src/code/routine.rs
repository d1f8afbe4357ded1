//! Machine code as a program holds it: what it reads, where it leaves, and how it is run. Who writes it, and how, is unknown here.

use super::kinds::{Kind, Reg};
use super::operand::{FunctionId, Operand};
use std::any::Any;

/// `(words)`, as [`words`] says; gives the number of the exit taken.
pub(crate) type Start = unsafe extern "C" fn(*mut u64) -> u64;

/// Instructions of the processor, and the memory that they are in.
pub(crate) struct Instructions {
    start: Start,
    bytes: usize,
    _owner: Box<dyn Any + Send + Sync>,
}

impl Instructions {
    /// So many bytes from `start` on.
    ///
    /// # Safety
    /// They are there as long as `owner` is, they stay within the words that their routine says, and nothing but these, and what
    /// constants and registers of the kinds that it was written for lend, is read or written.
    #[allow(unsafe_code)]
    pub unsafe fn new(start: Start, bytes: usize, owner: Box<dyn Any + Send + Sync>) -> Instructions {
        Instructions { start, bytes, _owner: owner }
    }
}

/// Machine code for one combination of kinds.
pub(crate) struct Routine {
    /// Registers that it reads where it begins, and their kinds there.
    pub inputs: Vec<Input>,
    /// Constants that are no numbers: of which function, and which.
    pub constants: Vec<(FunctionId, u16)>,
    /// Other registers that it may write: they must hold nothing shared.
    pub overwritten: Vec<Reg>,
    /// How many of these are of the activation: they come first.
    pub overwritten_nodes: usize,
    /// One past the last of these that is of the machine.
    pub scratch_end: usize,
    /// Where it may leave.
    pub exits: Vec<Exit>,
    /// Whether it writes registers of the activation.
    pub writes_node: bool,
    /// Words that it exchanges with the machine.
    pub words: usize,
    /// The code itself.
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
    /// Its first word.
    pub word: usize,
}

/// A place where machine code leaves.
#[derive(Debug)]
pub(crate) struct Exit {
    /// Calls of pure functions that are in progress, from the outermost: where each was called.
    pub calls: Vec<Call>,
    /// The function that the interpreter continues in.
    pub function: FunctionId,
    /// Its first scratch register, from that of the function where the code began.
    pub base: u32,
    /// The instruction that it continues at.
    pub pc: u32,
    /// Registers that have changed, in the order of their words.
    pub registers: Vec<(Reg, Kind)>,
    /// Whether some of them hold what is shared.
    pub has_objects: bool,
}

/// A call of a pure function in progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Call {
    /// Who calls.
    pub caller: FunctionId,
    /// The caller's first scratch register.
    pub base: u32,
    /// Where the caller continues.
    pub back: u32,
    /// The register for the result.
    pub to: Operand,
}

impl Routine {
    /// How much code it is.
    pub fn bytes(&self) -> usize {
        self.code.bytes
    }

    /// Runs it: gives the exit that it took.
    ///
    /// # Panics
    /// When there are fewer than [`Routine::words`].
    #[inline]
    #[allow(unsafe_code)]
    pub fn run(&self, words: &mut [u64]) -> &Exit {
        assert!(words.len() >= self.words);
        // SAFETY: the code stays within so many words. The addresses among them are those of values of the kinds that it
        // was written for, as `enter` put them there, and nobody changes these meanwhile.
        let exit = unsafe { (self.code.start)(words.as_mut_ptr()) };
        &self.exits[exit as usize]
    }
}

/// Words that code and machine exchange.
pub(crate) mod words {
    /// Steps that the code may take, and how many are left.
    pub const STEPS: usize = 0;
    /// Instructions carried out.
    pub const DONE: usize = 1;
    /// Scratch registers that the run has used before, from the first one of the function.
    pub const ROOM: usize = 2;
    /// Bytes that the code may charge, and how many are left.
    pub const BYTES: usize = 3;
    /// Addresses of constants, at most so many.
    pub const CONSTANTS: usize = 4;
    pub const MOST_CONSTANTS: usize = 32;
    /// Registers: what they hold where the code begins, and where it leaves.
    pub const REGISTERS: usize = CONSTANTS + MOST_CONSTANTS;
}
