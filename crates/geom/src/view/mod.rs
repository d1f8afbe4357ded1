//! Views: the rays of a picture, and the rays that meet a shape.
//!
//! A camera sees a pixel when the ray through the pixel's middle meets a shape; a receiver's point lies in shadow
//! when its ray to the light meets a shape. Both query a family of rays that project to points of a plane: the plane of a
//! picture, or the plane across the light. So both share one index and one exact test, without a raster, a depth map or a
//! bias.
//!
//! - [`camera`]: cameras, and the rays through the pixels of their pictures
//! - [`rays`]: a family of rays in bundles of 64, in a tree over the plane that they fall on
//! - [`outline`]: the projection of a convex piece of a shape to that plane
//! - [`cover`]: the rays that meet a shape, one bit for each
//! - [`receiver`]: the points of a mesh that a camera sees, as rays to a light

pub mod camera;
pub mod cover;
pub mod outline;
pub mod rays;
pub mod receiver;

pub use camera::{Camera, Lens};
pub use cover::Cover;
pub use rays::{Projection, Ray, Rays};
pub use receiver::{Light, shadow_rays};
