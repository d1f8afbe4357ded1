//! The machine that runs a procedural model.
