//! Proposals beside the prior, and particles: runs that stop at barriers.
//!
//! * [`proposal`]: users' functions ([`user`]) and [`guide`]s for new runs; [`importance`]: importance sampling with proposals;
//! * [`particle`]: a run that stops at barriers; [`look_ahead`]: forecasts of its further score, [`foresight`]: by a guide;
//! * [`sweep`]: sequential Monte Carlo over particles;
//! * [`gradient`]: a task as a log density over its continuous choices.

pub mod foresight;
pub mod gradient;
pub mod guide;
pub mod importance;
pub mod look_ahead;
pub mod particle;
pub mod proposal;
pub mod sweep;
pub mod user;
