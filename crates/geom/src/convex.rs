//! What a convex solid keeps for intersection and voxels, computed once when the shape is made.

use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use std::sync::{Arc, OnceLock};

/// A convex solid in the world.
#[derive(Debug)]
pub struct Convex {
    vertices: Vec<Vec3>,
    topology: Arc<Topology>,
    normals: Vec<Vec3>,
    edges: OnceLock<Vec<Vec3>>,
    width: f64,
    aligned: bool,
}

impl Convex {
    /// From world vertices (hull corners first, then the points that only triangles use).
    ///
    /// `None` when a face has no normal, which a flat solid has.
    pub(crate) fn new(vertices: Vec<Vec3>, topology: Arc<Topology>) -> Option<Convex> {
        let mut normals = Vec::with_capacity(topology.faces.len());
        for face in &topology.faces {
            push_direction(&mut normals, face_normal(face, &vertices)?);
        }
        Convex::with_normals(vertices, topology, normals, false)
    }

    /// As [`Convex::new`], for a solid that is convex but for a little; a face without a normal is left out.
    pub(crate) fn nearly(vertices: Vec<Vec3>, topology: Arc<Topology>) -> Option<Convex> {
        let mut normals = Vec::with_capacity(topology.faces.len());
        for face in &topology.faces {
            if let Some(normal) = face_normal(face, &vertices) {
                push_direction(&mut normals, normal);
            }
        }
        Convex::with_normals(vertices, topology, normals, false)
    }

    /// A box whose sides point along the columns of `rotation`.
    pub(crate) fn cuboid(vertices: Vec<Vec3>, rotation: &Mat3) -> Option<Convex> {
        let aligned =
            rotation.columns.iter().all(|c| Vec3::AXES.contains(&vec3(c.x.abs(), c.y.abs(), c.z.abs())));
        let normals = if aligned { Vec3::AXES.to_vec() } else { rotation.columns.to_vec() };
        Convex::with_normals(vertices, Topology::cuboid(), normals, aligned)
    }

    fn with_normals(
        vertices: Vec<Vec3>,
        topology: Arc<Topology>,
        normals: Vec<Vec3>,
        aligned: bool,
    ) -> Option<Convex> {
        let corners = &vertices[..topology.corners];
        let width =
            normals.iter().map(|n| span(corners, *n)).map(|(lo, hi)| hi - lo).fold(f64::INFINITY, f64::min);
        (width > 0.0).then(|| Convex { vertices, topology, normals, edges: OnceLock::new(), width, aligned })
    }

    /// Corners of the hull, world space.
    #[inline]
    pub fn corners(&self) -> &[Vec3] {
        &self.vertices[..self.topology.corners]
    }

    /// Corners and the centres of caps: what the indices of the topology mean.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Faces, edges and triangles.
    #[inline]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Unit face normals, each direction once (never both a direction and its opposite).
    #[inline]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Unit edge directions, each once, up to sign.
    pub fn edges(&self) -> &[Vec3] {
        self.edges.get_or_init(|| {
            if self.topology.corners == 8 && self.normals.len() == 3 {
                // A box: its edges run along its normals.
                return self.normals.clone();
            }
            let mut edges = Vec::new();
            for [a, b] in &self.topology.edges {
                if let Some(direction) = (self.vertices[*b as usize] - self.vertices[*a as usize]).unit() {
                    push_direction(&mut edges, direction);
                }
            }
            edges
        })
    }

    /// Smallest extent along a face normal: how thick the solid is.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// True for a box whose sides are exactly the coordinate directions.
    pub fn is_aligned_box(&self) -> bool {
        self.aligned
    }
}

/// Extent of `points` along `axis`.
#[inline]
pub(crate) fn span(points: &[Vec3], axis: Vec3) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for p in points {
        let along = p.dot(axis);
        low = if along < low { along } else { low };
        high = if along > high { along } else { high };
    }
    (low, high)
}

/// Newell's normal: exact for planar faces, the mean one otherwise.
fn face_normal(face: &[u32], vertices: &[Vec3]) -> Option<Vec3> {
    let at = |i: usize| vertices[face[i % face.len()] as usize];
    let origin = at(0);
    (1..face.len() - 1).fold(Vec3::ZERO, |sum, i| sum + (at(i) - origin).cross(at(i + 1) - origin)).unit()
}

fn push_direction(directions: &mut Vec<Vec3>, new: Vec3) {
    // Parallel to within 1e-10 radians, either way round.
    if !directions.iter().any(|d| d.dot(new).abs() > 0.999_999 && d.cross(new).dot(d.cross(new)) < 1e-20) {
        directions.push(new);
    }
}
