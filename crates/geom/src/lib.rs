//! Shapes, voxels, intersections, sketches and pictures.
//!
//! - [`vector`], [`bounds`]: points, rotations, boxes along the axes
//! - [`mesh`], [`topology`], [`hull`], [`convex`]: surfaces and convex solids
//! - [`shape`], [`words`], [`primitive`]: what a model emits
//! - [`sketch`]: running scores of what was emitted
//! - [`fine`], [`render`]: meshes with many sides, and pictures of them

pub mod bounds;
pub mod convex;
pub mod error;
pub mod fine;
pub mod hull;
pub mod mesh;
pub mod primitive;
pub mod render;
pub mod shape;
pub mod sketch;
pub mod topology;
pub mod vector;
pub mod words;

pub use bounds::Aabb;
pub use convex::Convex;
pub use error::GeomError;
pub use mesh::TriMesh;
pub use primitive::Primitive;
pub use shape::{Placement, Ring, Shape, Solid};
pub use sketch::{Sketch, SketchSpec};
pub use vector::{Mat3, Vec3, vec3};
pub use words::Look;
