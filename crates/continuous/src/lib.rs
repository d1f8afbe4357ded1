//! Inference over any log density of real coordinates. Programs are in other crates.
//!
//! * [`hamiltonian`]: chains along the gradient;
//! * [`variational`]: normal approximations of the density.
//!
//! The computation of gradients is in `niwaki-grad`.

pub mod hamiltonian;
pub mod variational;
