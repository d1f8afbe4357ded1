//! Rows from traces, and training on them.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `rows` | [`Rows`]: for each choice of some traces, a guide's inputs and the chosen value |
//! | `slope` | the loss of a row, and its derivatives by all weights |
//! | `scaling` | means and deviations of inputs, with which training standardises them |
//! | `adam` | [`Adam`]: the optimiser |
//! | `train` | [`train`]: steps on choices of all traces; the best weights by rows held out |
//! | `climb` | [`Climb`]: steps on choices with signed weights |
//!
//! The loss of a choice is `-ln(q / p)`, nats: how much less likely the choice is under the guide than under the prior. The
//! prior's share is in `q`.

mod adam;
mod climb;
mod rows;
mod scaling;
mod slope;
mod stored;
mod train;

pub use adam::Adam;
pub use climb::Climb;
pub use rows::Rows;
pub(crate) use slope::{add_scaled, back_through, dot};
pub use slope::{loss, loss_and_slope};
pub(crate) use stored::Moving;
pub use stored::{Stored, Unfit, Way};
pub use train::{Diverged, Progress, State, Trained, Training, resume, train, train_along};
