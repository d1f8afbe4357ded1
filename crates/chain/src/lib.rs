//! Markov chains over kept runs: Metropolis-Hastings with kernels as values (dissertation chapter 3).
//!
//! * [`kernel`]: kernels as values, and [`form`]: kernels as data; `plan`: the order of leaves; [`leaf`]: the proposals of leaves;
//! * [`walk`]: chains without kernels: state, algorithm, results;
//! * proposals for a single choice: from the prior, [`drift`], [`neighbour`], `by_family`, a [`user`]'s function, a guide
//!   ([`guided`]);
//! * [`block`], `regenerate`, [`regrow`]: proposals that change many choices;
//! * [`trajectory`]: joint moves of the continuous choices along their gradient;
//! * [`ladder`]: parallel tempering; [`many`]: several chains in parallel; `stored`: chains as data, from which a search resumes;
//! * [`explain`]: the work of each of the four strategies for a proposal.
//!
//! The states of a chain depend only on its seed and number, not on the strategy or the number of threads.

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
