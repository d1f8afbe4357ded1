//! Inference over any log density of real coordinates: it knows no programs.
//!
//! * [`hamiltonian`]: chains that follow the slope;
//! * [`variational`]: normals near the density.
//!
//! Not here: programs, how a gradient is computed.

pub mod hamiltonian;
pub mod variational;
