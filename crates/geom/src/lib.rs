//! Shapes, voxels, intersections, sketches and pictures.
