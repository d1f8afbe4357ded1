//! Shapes, voxels, intersections and sketches.
//!
//! - [`bounds`]: boxes along the axes
//! - [`placement`], [`ring`], [`tube`], [`look`]: the measures of a shape, and what else is given of it
//! - [`mesh`], [`topology`], [`polytope`], [`hull`], [`limb`], [`segment`], [`convex`]: surfaces and convex solids
//! - [`solids`]: every kind of solid, a file each, and the shapes that a model emits
//! - [`polygon`]: sections of solids
//! - [`plane`]: flat shapes, and which pixels of a page they cover
//! - [`voxel`]: which cells of a grid a shape fills
//! - [`intersect`]: whether two shapes intersect
//! - [`view`]: the rays of a picture, and which of them meet a shape
//! - [`tree`]: a bag of boxes that copies share
//! - [`bricks`]: counts of the shapes in each cell, and the cells of a target
//! - [`sketch`]: running scores of the emitted shapes
//! - [`window`]: what a sketch shows around a place
//! - [`fine`]: meshes with many sides, for pictures and files
//! - [`store`]: geometry that shapes have needed lately
//! - `winding`: closed surfaces around a point
//! - `once`: values that are computed when they are first needed

pub mod bounds;
pub mod bricks;
pub mod convex;
pub mod error;
pub mod fine;
mod folds;
pub mod hull;
pub mod intersect;
pub mod limb;
pub mod look;
pub mod mesh;
mod once;
pub mod placement;
pub mod plane;
pub mod polygon;
pub mod polytope;
pub mod ring;
pub mod segment;
pub mod sketch;
pub mod solids;
pub mod store;
pub mod topology;
pub mod tree;
pub mod tube;
pub mod view;
pub mod voxel;
mod winding;
pub mod window;

pub use bounds::{Aabb, FAR};
pub use bricks::Target;
pub use convex::{Coarse, Convex};
pub use error::GeomError;
pub use intersect::{Rule, intersects};
pub use look::Look;
pub use mesh::TriMesh;
pub use niwaki_math::vector::{self, Mat3, Vec3, vec3};
pub use placement::Placement;
pub use plane::Page;
pub use polytope::Hull;
pub use ring::Ring;
pub use sketch::*;
pub use solids::cut::{Cut, Operation};
pub use solids::primitive::Primitive;
pub use solids::shape::Shape;
pub use solids::{Cuboid, Cylinder, Ellipse, Solid, Stroke};
pub use tube::{Bark, Frame, Tube};
pub use voxel::{Grid, Voxels};
pub use window::{Place, WindowForm, WindowKind, WindowPoint};
