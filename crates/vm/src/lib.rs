//! The machine that runs a procedural model: a compiler from core form to bytecode, and an interpreter whose
//! activation records are trace nodes.
//!
//! * [`core`]: a model after names are resolved, as text and as types;
//! * [`passes`]: core form to bytecode;
//! * [`code`]: bytecode, its verifier and disassembler;
//! * [`value`]: the contents of registers; [`builtins`]: the functions on values; [`fault`]: faults of a run;
//! * `native`: bytecode as machine code;
//! * [`machine`]: runs a program up to its next question.
//!
//! Not here: random numbers, algorithms, Python.

pub mod builtins;
pub mod code;
pub mod core;
pub mod fault;
pub mod machine;
mod native;
pub mod passes;
pub mod refusal;
pub mod value;
