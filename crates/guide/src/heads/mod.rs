//! Heads: outputs of a network as a density of a choice.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `head` | [`Head`]: the density of a site; drawing and scoring |
//! | `lesson` | [`Lesson`]: a choice's prior and value as numbers; the quotient of the two densities |
//! | `line` | coordinates in which the priors of real numbers are alike |
//! | `bells` | mixtures of Gaussians over such a coordinate |
//! | `classes` | finitely many values |
//! | [`natural`] | the dissertation's outputs, translated to those of a head |
//!
//! With the network's density `n`, the prior `p` and the share `s` of the prior, a choice is drawn from
//!
//! ```text
//! q = (1 - s) n + s p
//! ```
//!
//! This module computes in `f64`, for any number type of the network.

mod bells;
mod classes;
mod head;
mod lesson;
mod line;
pub mod natural;

pub use head::{Drawn, Head};
pub(crate) use lesson::Known;
pub use lesson::Lesson;

/// An output of a network: `f32` or `f64`.
pub(crate) trait Number: Copy + Into<f64> {}

impl Number for f32 {}
impl Number for f64 {}
