//! Views: the rays of a picture, and which of them meet a shape.
//!
//! A camera sees a pixel when the ray through the pixel's middle meets a shape; a receiver's point lies in shadow
//! when its ray to the light meets one. Both are one query of a family of rays that project to points of a plane:
//! the plane of a picture, or the plane across the light. So both share one index and one exact test, without a
//! raster, a depth map or a bias.
//!
//! - [`camera`]: from where a picture is seen, and the rays through its pixels
//! - [`rays`]: a family of rays in bundles of 64, in a tree over the plane that they fall on
//! - [`outline`]: a convex piece of a shape as it falls on that plane
//! - [`cover`]: which rays meet a shape, one bit for each
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
