//! Machine code as a program stores it: its inputs, its exits, and how it runs. This module does not know who
//! writes the code, or how.

use super::operand::{FunctionId, Operand};
use super::register::{Kind, Reg};
use crate::value::Value;
use std::any::Any;
use std::ffi::c_void;

/// A function over the first register of the activation, of the loop node above it, and of the machine. It
/// returns the number of the exit that it took, or [`NOT_ENTERED`].
pub(crate) type Start = unsafe extern "C" fn(*mut Exchange, *mut Value, *const Value, *mut Value) -> u64;

/// The answer of code that found a register of another kind, and did nothing.
pub(crate) const NOT_ENTERED: i64 = -1;

/// A question that machine code asks about a choice: the two halves of the key of the site, then the parameters. It
/// stores the word of the value in [`Exchange::answer`] and returns the mark of its kind. An answer without a
/// mark, [`NO_ANSWER`], has had no effect.
pub(crate) type Ask<A, B> = unsafe extern "C" fn(*mut Exchange, u64, u64, A, B) -> u64;

/// The mark of a call without an answer.
pub(crate) const NO_ANSWER: u64 = 255;

/// The questions that machine code may ask, for those who answer them.
#[repr(C)]
pub(crate) struct Questions {
    /// A choice from a Gaussian: its mean and its standard deviation.
    pub gaussian: Ask<f64, f64>,
    /// A choice from an interval: its ends.
    pub uniform: Ask<f64, f64>,
    /// A truth value: its probability; the second parameter is not read.
    pub bernoulli: Ask<f64, f64>,
    /// A choice from a distribution that a value holds: the value, and the mark that the answer must have.
    pub held: Ask<*const Value, u64>,
    /// A finite factor, in nats. The answer is whether the run pauses after it.
    pub score: unsafe extern "C" fn(*mut Exchange, f64),
    /// A call: the function and the site in one word, and what is dropped ([`Dropping`]). The first register of the new
    /// activation; null, without an effect, if no released activation of the function waits.
    pub call: unsafe extern "C" fn(*mut Exchange, u64, u64, u64, u64) -> *mut Value,
}

/// The part of the caller that a call drops.
#[derive(Clone, Copy)]
pub(crate) struct Dropping {
    /// The number of its registers, if nobody reads them again.
    pub registers: u16,
    /// Whether a deep recursion hands these registers over.
    pub may_hand_over: bool,
}

impl Dropping {
    /// The word.
    pub fn word(self) -> u64 {
        u64::from(self.registers) | u64::from(self.may_hand_over) << 16
    }

    /// The meaning of a word.
    pub fn of(word: u64) -> Dropping {
        Dropping { registers: word as u16, may_hand_over: word >> 16 == 1 }
    }
}

/// The numbers that machine code and the machine exchange.
#[derive(Clone, Copy)]
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
    /// The questions that the code may ask; null if it must leave before every choice.
    pub questions: *const Questions,
    /// Those who answer, and logarithms that they may need again; only the questions know the types.
    pub answers: *mut c_void,
    pub logs: *mut c_void,
    /// The state of the run.
    pub state: *mut c_void,
    /// The path of the activation, in halves, and its number.
    pub path: [u64; 2],
    pub node: u32,
    /// The number of the activation that was called.
    pub called: u32,
    /// The number of choices that were made.
    pub choices: u64,
    /// The word of the last answer.
    pub answer: u64,
    /// The bytes that the log takes for a choice.
    pub logged: i64,
}

impl Exchange {
    /// The exchange of code that takes no steps, charges no memory and asks nothing.
    pub const NOTHING: Exchange = Exchange {
        steps: 0,
        bytes: 0,
        room: 0,
        instructions: 0,
        questions: std::ptr::null(),
        answers: std::ptr::null_mut(),
        logs: std::ptr::null_mut(),
        state: std::ptr::null_mut(),
        path: [0; 2],
        node: 0,
        called: 0,
        choices: 0,
        answer: 0,
        logged: 0,
    };
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
    /// The instructions exist as long as `owner` does. They access nothing but the exchange, its
    /// questions, the registers that their routine names, and what is lent by constants and by registers whose kinds they have
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
    /// Whether the code changes registers of the activation in a run that may not ask.
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
    /// The continuation there.
    pub then: Then,
}

/// The continuation of a run where code has left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Then {
    /// It continues with the instruction.
    Continues,
    /// It pauses before the instruction, if that was the last answer ([`Exchange::answer`]).
    Pauses,
    /// It takes a step and continues in the activation that the instruction has called.
    Enters,
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
