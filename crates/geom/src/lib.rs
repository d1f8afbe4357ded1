//! Shapes, voxels, intersections, sketches and pictures.
//!
//! - [`bounds`]: boxes along the axes
//! - [`mesh`], [`topology`], [`hull`], [`limb`], [`segment`], [`convex`]: surfaces and convex solids
//! - [`shape`], [`words`], [`primitive`]: the shapes that a model emits
//! - [`plane`]: flat shapes, and which pixels of a page they cover
//! - [`voxel`]: which cells of a grid a shape fills
//! - [`intersect`]: whether two shapes intersect
//! - [`view`]: the rays of a picture, and which of them meet a shape
//! - [`tree`]: a bag of boxes that copies share
//! - [`sketch`]: running scores of the emitted shapes
//! - [`window`]: what a sketch shows around a place
//! - [`fine`], [`render`]: meshes with many sides, and pictures of them
//! - [`store`]: geometry that shapes have needed lately
//! - `once`: values that are computed when they are first needed

pub mod bounds;
mod coarse;
pub mod convex;
pub mod error;
pub mod fine;
mod folds;
pub mod hull;
pub mod intersect;
pub mod limb;
pub mod mesh;
mod once;
pub mod plane;
pub mod primitive;
pub mod render;
pub mod segment;
pub mod shape;
pub mod sketch;
pub mod store;
pub mod topology;
pub mod tree;
pub mod view;
pub mod voxel;
pub mod window;
pub mod words;

pub use bounds::Aabb;
pub use convex::{Coarse, Convex, Hull};
pub use error::GeomError;
pub use intersect::{Rule, intersects};
pub use mesh::TriMesh;
pub use niwaki_math::vector::{self, Mat3, Vec3, vec3};
pub use plane::{Page, Round};
pub use primitive::Primitive;
pub use segment::{Bark, Frame, Tube};
pub use shape::{Placement, Ring, Shape, Solid};
pub use sketch::*;
pub use voxel::{Grid, Voxels};
pub use window::{Place, WindowForm, WindowKind, WindowPoint};
pub use words::Look;
