//! The instructions.

use super::operand::{Args, Operand, SiteId};
use niwaki_math::Family;

/// The ways in which an iteration of a lifted loop ends, as small integers in a register.
pub mod exit {
    /// The iteration reached its end or `continue`.
    pub const NEXT: i64 = 0;
    /// The iteration reached `break`.
    pub const BREAK: i64 = 1;
    /// The iteration reached `return`; the returned value follows the carried variables.
    pub const RETURN: i64 = 2;
}

/// The operations of two operands that have an instruction of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    FloorDiv,
    Mod,
    Pow,
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
    Index,
    In,
}

/// One instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // each instruction's line describes its fields
pub enum Op {
    /// Copy a value.
    Move { to: Operand, from: Operand },
    /// A sum. The four most frequent operations have instructions of their own.
    Add { to: Operand, a: Operand, b: Operand },
    /// A difference.
    Sub { to: Operand, a: Operand, b: Operand },
    /// A product.
    Mul { to: Operand, a: Operand, b: Operand },
    /// A quotient.
    Div { to: Operand, a: Operand, b: Operand },
    /// Any other operation of two operands.
    Binary { op: Binary, to: Operand, a: Operand, b: Operand },
    /// Arithmetic negation.
    Neg { to: Operand, a: Operand },
    /// Python's `not`.
    Not { to: Operand, a: Operand },
    /// A built-in function by number.
    Builtin { to: Operand, id: u16, args: Args },
    /// A list of the arguments.
    List { to: Operand, args: Args },
    /// A tuple of the arguments.
    Tuple { to: Operand, args: Args },
    /// A dictionary: keys, then values.
    Dict { to: Operand, args: Args },
    /// A record of the numbered class.
    Record { to: Operand, class: u16, args: Args },
    /// A named field.
    Field { to: Operand, a: Operand, name: u16 },
    /// The elements of a sequence of exactly that length, stored in registers.
    Unpack { from: Operand, to: Args },
    /// Like `Unpack`, with the elements in the middle as a list in the register at place `star` of `to`.
    UnpackStar { from: Operand, to: Args, star: u16 },
    /// A function value.
    Closure { to: Operand, function: u16, args: Args },
    /// A distribution value.
    Dist { to: Operand, family: Family, args: Args },
    /// A pure host function, by constant number of the program.
    Host { to: Operand, constant: u16, args: Args },
    /// Call of a pure function: no node, no site.
    CallPure { to: Operand, function: u16, args: Args },
    /// Jump. Backward jumps count as steps.
    Jump { target: u32 },
    /// Jump when the value is true.
    JumpIf { a: Operand, target: u32 },
    /// Jump when the value is not true.
    JumpUnless { a: Operand, target: u32 },
    /// Jump unless a comparison such as `a < b` holds: a comparison and a jump in one instruction.
    JumpUnlessCompare { op: Binary, a: Operand, b: Operand, target: u32 },
    /// Check that a value can be iterated over, and store its length as an integer.
    Length { to: Operand, a: Operand },
    /// If `index < length`, store the element there in `to` and add one to `index`; else jump.
    Next { to: Operand, over: Operand, index: Operand, length: Operand, target: u32 },
    /// Raise a fault unless the variable has been assigned.
    CheckSet { a: Operand, name: u16 },
    /// Raise a fault with the message in `message` unless `a` is true.
    Assert { a: Operand, message: Operand },
    /// Run the numbered site, which may suspend.
    Site { site: SiteId },
    /// Remove what the sites numbered `from..to` hold: they are not on the path taken.
    Clear { from: u16, to: u16 },
    /// Return from the function.
    Return { a: Operand },
    /// Return from an iteration: the kind of exit, the carried values and, after `return`, the returned value.
    ReturnIteration { exit: i8, args: Args },
    /// In a slice, a repeated call for which only the argument numbered `arg` may have changed.
    Pass { site: SiteId, arg: u16 },
    /// The end of a slice: the value that the activation returns has not changed.
    Done,
}
