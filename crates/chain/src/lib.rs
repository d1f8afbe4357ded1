//! Markov chains over kept runs: Metropolis-Hastings with kernels as values (dissertation chapter 3).
//!
//! * [`kernel`]: kernels as values, and [`form`] as data; `plan`: which leaf is next; [`leaf`]: the proposals;
//! * [`walk`]: a chain without its kernel: its state, the algorithm, what is reported afterwards;
//! * [`ladder`]: parallel tempering; [`many`]: several searches in parallel; `stored`: chains as data, to go on from;
//! * [`explain`]: what each of the four strategies does for one proposal.
//!
//! A chain's states depend on its seed and number only: not on the strategy, not on the number of threads.

mod chain;
pub mod explain;
pub mod form;
pub mod kernel;
pub mod ladder;
pub mod leaf;
pub mod many;
pub mod plan;
pub mod stored;
pub mod walk;

pub use chain::{Chain, Settings};
