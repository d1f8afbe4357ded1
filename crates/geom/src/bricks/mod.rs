//! Cells of a grid in bricks that copies share: how many shapes fill each, and which of them a target fills.
//!
//! - [`layout`]: how cells lie in bricks
//! - [`brick`]: a small block of counts, bit-sliced
//! - `sums`: counts over larger boxes, for windows
//! - [`counters`]: how many shapes fill each cell
//! - [`target`]: the cells to fill

pub mod brick;
pub mod counters;
pub mod layout;
pub(crate) mod sums;
pub mod target;

pub use counters::Counters;
pub use target::Target;
