//! The machine that runs a procedural model.

pub mod builtins;
pub mod fault;
pub mod value;
