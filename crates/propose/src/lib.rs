//! Where values come from beside the prior, and one run that stops on its way.
//!
//! * [`proposal`]: users' functions ([`user`]) and [`guide`]s for a run that begins; [`importance`]: such runs, weighed;
//! * [`particle`]: a run that stops at barriers; [`look_ahead`]: what is expected of the rest of it, [`foresight`]: by a guide;
//! * [`sweep`]: many such runs, weighed and resampled at each barrier;
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
