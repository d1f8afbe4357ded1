//! Guides: small networks that draw choices in place of the prior.
//!
//! A guide is a proposal. It sees windows of the scene and values that are live at a site, and gives a density for the
//! choice there. The weight of a run is corrected by the quotient of the prior's density to the guide's, so a bad guide costs
//! time but never changes the answer. A share of the prior in every density bounds that quotient by one over the share.
//!
//! | part | what it holds |
//! | --- | --- |
//! | [`heads`] | outputs of a network as a density of a choice: drawing, scoring, gradients |
//! | [`net`] | the network: its form, its weights, its answers, its file |
//! | [`filtered`] | the dissertation's network and its training, for comparison |
//! | [`learn`] | rows from traces, and training on them |
//!
//! This crate does not know programs, scenes or traces: numbers and distributions in, numbers and draws out.

#![cfg_attr(not(test), warn(clippy::cast_possible_truncation))]

pub mod filtered;
pub mod heads;
pub mod learn;
pub mod net;

pub use filtered::{
    Filtered, FilteredForm, FilteredTraining, read_filtered, train_filtered, train_filtered_along,
    write_filtered,
};
pub use heads::{Drawn, Head, Lesson};
pub use learn::{
    Adam, Climb, Diverged, Progress, Rows, State, Stored, Trained, Training, Unfit, Way, loss_and_slope,
    resume, train, train_along,
};
pub use net::{BadFile, Net, NetForm, Real, Scratch, read, write};
