//! Cells of a grid in bricks that copies share: counts of the shapes that fill them, and the cells of a target.
//!
//! - [`layout`]: the cells of a brick
//! - [`brick`]: a small block of counts, bit-sliced
//! - `sums`: counts over larger boxes, for windows
//! - [`counters`]: counts of the shapes that fill each cell
//! - [`target`]: the cells to fill

pub mod brick;
pub mod counters;
pub mod layout;
pub(crate) mod sums;
pub mod target;

pub use counters::Counters;
pub use target::Target;
