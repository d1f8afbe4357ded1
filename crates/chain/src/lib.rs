//! Markov chains over kept runs: Metropolis-Hastings with kernels as values (dissertation chapter 3).
//!
//! * [`kernel`]: kernels as values, and [`form`] as data; `plan`: which leaf is next; [`leaf`]: how it proposes;
//! * [`walk`]: a chain without its kernel: its state, the algorithm, what is reported afterwards;
//! * a new value for one choice: from the prior, [`drift`], [`neighbour`], `by_family`, by the [`user`]'s function,
//!   by a guide ([`guided`]);
//! * [`block`], `regenerate`, [`regrow`]: proposals that change many choices;
//! * [`trajectory`]: the continuous choices move together along their gradient;
//! * [`ladder`]: parallel tempering; [`many`]: several searches in parallel; `stored`: chains as data, to go on from;
//! * [`explain`]: what each of the four strategies does for one proposal.
//!
//! A chain's states depend on its seed and number only: not on the strategy, not on the number of threads.

pub mod block;
pub(crate) mod by_family;
mod chain;
pub mod drift;
pub mod explain;
pub mod form;
pub mod guided;
pub mod kernel;
pub mod ladder;
pub mod leaf;
pub mod many;
pub mod neighbour;
pub mod plan;
mod regenerate;
pub mod regrow;
pub mod stored;
pub mod trajectory;
pub mod user;
pub mod walk;

pub use chain::{Chain, Settings};
