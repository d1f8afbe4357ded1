//! Flat shapes, and which cells of a page they cover.
//!
//! A drawing is a scene seen along -z, with y up: flat shapes lie on planes parallel to z = 0, and z only says which
//! lies in front of which. Solids are seen too, as the shadows of their coarse meshes on that plane.
//!
//! - [`outline`]: where a shape lies between two heights of the plane
//! - [`page`]: the cells of a page that it covers, as words of bits

pub mod outline;
pub mod page;

pub use outline::Outline;
pub use page::Page;
