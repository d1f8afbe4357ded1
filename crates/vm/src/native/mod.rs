//! Models as machine code.
//!
//! The interpreter is the reference and starts at once. When it passes through the same instructions thousands
//! of times, they are compiled for the kinds of values that the registers hold there, with real and whole
//! numbers in registers of the processor. Machine code begins at the target of a backward jump, at the start of
//! a pure function, or where a run continues after a choice, and it goes as far as it can:
//!
//! ```text
//! interpreter --- a loop jumps back for the 20,000th time -> compile for these kinds,
//!     ^                                                            | while the run continues
//!     |            steps, bytes, place                             v
//!     +------------------------------------------------------ machine code
//!        an instruction that it has no code for, a fault, a number that does not fit, the limits
//! ```
//!
//! The code does nothing that the interpreter would not do. It leaves *before* an instruction that it cannot
//! run, with every register as the interpreter would have it there. So values are the same to the last bit, the
//! interpreter raises faults at their place, and limits of steps and memory are met at the same instruction.
//!
//! The result of the compilation is a routine ([`crate::code::routine`]) at a place of a function
//! ([`crate::code::entries`]). So programs hold machine code without knowing who writes it. `machine/enter`
//! runs it.
//!
//! * `entries`: the places where code may begin; `background`: the thread that writes code; `routine`: the
//!   writing of one routine;
//! * `border`: the tests of kinds where code begins, and the stores where it leaves;
//! * `write`: one piece of code for each instruction and each combination of kinds that reaches it;
//!   `registers`: the model's registers during the writing; `flow`: which registers are live;
//! * `operate`: the instructions; `numbers`, `vectors`, `functions`: arithmetic, vectors and tuples, built-in
//!   functions; `choose`: choices and factors; `activations`: calls of functions that can suspend;
//! * `typed`: a value in the processor; `calls`: functions that the code calls.
//!
//! Source: Chevalier-Boisvert & Feeley, "Simple and Effective Type Check Removal through Lazy Basic Block
//! Versioning" (ECOOP 2015), with all versions written at once.

mod activations;
mod background;
mod border;
mod calls;
mod choose;
mod entries;
mod flow;
mod functions;
mod numbers;
mod operate;
mod registers;
mod routine;
mod typed;
mod vectors;
mod write;

pub(crate) use choose::kind_of_draws;
pub(crate) use entries::{entries_of, write};
