//! Models as machine code.
//!
//! The interpreter is right and starts at once. Where it goes through the same instructions thousands of times, they
//! are compiled: for the kinds of values that the registers hold there, real and whole numbers in registers of the
//! processor. The code begins where a loop goes back to, where a pure function begins or where a run goes on after a choice,
//! and it goes as far as it can:
//!
//! ```text
//! interpreter --- a loop goes back, for the 20,000th time -> compile for the kinds found,
//!     ^                                                            | while the run goes on
//!     |            registers, steps, place                         v
//!     +------------------------------------------------------ machine code
//!        an instruction that it has no code for, a fault, a number that does not fit, the limits
//! ```
//!
//! It does nothing that the interpreter would not do, and it leaves *before* an instruction that it cannot carry out,
//! with every register as the interpreter would have it there. So values are the same to the last bit, a fault is raised by
//! the interpreter at its place, and limits of steps and memory are met at the same instruction.
//!
//! What was written is a routine ([`crate::code::routine`]) at a place of a function ([`crate::code::entries`]). So programs hold
//! machine code, and do not know who writes it. How it is run is in `machine/enter`.
//!
//! * `entries`: where code may begin; `apart`: the thread that writes it; `routine`: the writing of one routine;
//! * `write`: one piece of code for each instruction and each combination of kinds that it is met with; `registers`: the model's
//!   registers while it is written; `flow`: which of them are live;
//! * `operate`: the instructions; `numbers`, `vectors`, `functions`: arithmetic, vectors and tuples, built-in functions;
//! * `typed`: a value in the processor; `calls`: functions that the code calls.
//!
//! Source: Chevalier-Boisvert & Feeley, "Simple and Effective Type Check Removal through Lazy Basic Block Versioning"
//! (ECOOP 2015), with all versions made at once.

mod apart;
mod calls;
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

pub(crate) use entries::{entries_of, write};
