//! Search for the parameters of a model that somebody else wrote, when each evaluation is dear.
//!
//! An evaluation gives a score, one number, and *features*: what the scene gets wrong, a vector that is zero for a scene
//! that matches. A Gaussian process learns the features as a function of the parameters. The next points are those whose
//! features are predicted to be shortest, or may be.
//!
//! | part | what it holds |
//! | --- | --- |
//! | [`space`] | parameters, the conditions under which they are used, points |
//! | [`dice`] | random numbers with the same bits on every machine |
//! | [`linear`] | sums in a fixed order, Cholesky factors, eigenvectors |
//! | [`archive`] | the evaluations, in the order of asking |
//! | [`kernel`] | how similar two points are |
//! | [`directions`] | the directions in which the features of good points vary |
//! | [`emulator`] | the Gaussian process |
//! | [`moves`] | new points from good ones, and what is learnt about them |
//! | [`design`] | the first points |
//! | [`proposer`] | ask and tell |
//! | [`posterior`] | points that the evaluations leave possible |
//!
//! All sums have a fixed order and all functions are portable: the same evaluations give the same points, to the bit, on
//! every machine. This crate does not know shapes, scores or Python.

#![cfg_attr(not(test), warn(clippy::cast_possible_truncation))]

pub mod archive;
pub mod design;
pub mod dice;
pub mod directions;
pub mod emulator;
pub mod kernel;
pub mod linear;
pub mod moves;
pub mod posterior;
pub mod proposer;
pub mod space;

pub use archive::{Archive, Evaluation};
pub use emulator::Emulator;
pub use posterior::{Posterior, sample};
pub use proposer::Proposer;
pub use space::{Axis, Kind, Point, Space};
