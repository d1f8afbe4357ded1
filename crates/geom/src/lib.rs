//! Shapes, voxels, intersections, sketches and pictures.

pub mod render;
