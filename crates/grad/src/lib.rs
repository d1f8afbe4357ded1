//! Recordings of runs as graphs, and their gradients.
//!
//! * [`operation`]: the operations of nodes; [`graph`]: nodes, each stored once, simplified as they are added;
//! * [`reverse`]: the gradient, as more nodes; [`density`]: a value with its gradient and guards, and its interpreter;
//! * [`tape`]: a density over lanes, one for each chain, without compilation; [`kernels`]: functions over many numbers;
//! * [`wide`]: the tapes of a density with their memory;
//! * [`native`]: machine code by Cranelift;
//! * [`scalar`]: the number that records its operations; [`mod@record`]: the recording of a program's run;
//! * [`mod@positions`]: positions of the shapes of a run, as functions of its choices;
//! * [`coordinates`]: maps from bounded values to coordinates without bounds, and back;
//! * [`live`]: new recordings when a guard fails, over [`live::compiled`]: the tape first, then machine code;
//! * [`jax`]: a density as Python text for JAX.

#![cfg_attr(not(test), warn(clippy::cast_possible_truncation))]

pub mod coordinates;
pub mod density;
pub mod graph;
pub mod jax;
pub mod kernels;
pub mod live;
pub mod native;
pub mod operation;
pub mod positions;
pub mod record;
pub mod reverse;
pub mod scalar;
pub mod tape;
pub mod wide;

pub use coordinates::{Continuous, Transform};
pub use density::{Comparison, Density, Guard};
pub use graph::{Graph, Id};
pub use live::compiled::Compiled;
pub use live::{Live, Model, Refused};
pub use native::{Native, Rolling};
pub use operation::Op;
pub use positions::{Movable, Placed, Positions, positions};
pub use record::{Recorded, Run, Scope, record};
pub use scalar::Var;
pub use tape::{Lanes, Tape};
pub use wide::Wide;
