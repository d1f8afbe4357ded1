//! Flat shapes, and the cells of a page that they cover.
//!
//! A drawing is a scene seen along -z, with y up: flat shapes lie on planes parallel to z = 0, and z is only their
//! order from back to front. A solid is the shadow of its coarse mesh on that plane.
//!
//! - [`outline`]: the interval of a shape between two heights of the plane
//! - [`page`]: the cells of a page that a shape covers, as words of bits

pub mod outline;
pub mod page;

pub use outline::Outline;
pub use page::Page;
