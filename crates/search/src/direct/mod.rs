//! Methods other than chains of kept runs and populations.
//!
//! * [`annealed`]: annealed importance sampling, by chains at rising powers of the score;
//! * [`explore`]: chains of a task that follow its slope, each from a possible run;
//! * [`normals`]: normals near a task's distribution.

pub mod annealed;
pub mod explore;
pub mod normals;
mod rows;
