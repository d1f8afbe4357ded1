//! Convex solids by their corners and faces, with the directions along which they can be separated.

use crate::hull::hull;
use crate::topology::Topology;
use crate::vector::Vec3;
use std::cell::OnceCell;
use std::sync::Arc;

/// A convex solid that is no box.
#[derive(Debug)]
pub struct Hull {
    /// Vertices, then face normals: one allocation.
    points: Box<[Vec3]>,
    vertices: usize,
    topology: Arc<Topology>,
    edges: OnceCell<Box<[Vec3]>>,
    width: f64,
}

impl Hull {
    /// A solid of world vertices (hull corners first, then the points that only triangles use).
    ///
    /// `None` when a face has no normal, as in a flat solid.
    pub(crate) fn new(vertices: Vec<Vec3>, topology: Arc<Topology>) -> Option<Hull> {
        Hull::over(vertices, topology, false)
    }

    /// The convex hull of points; `None` when they lie in a plane.
    pub(crate) fn around(points: Vec<Vec3>) -> Option<Hull> {
        let topology = hull(&points)?;
        Hull::new(points, Arc::new(topology))
    }

    /// A convex solid between two rings of as many points, or from a ring to a tip; counter-clockwise seen from the end.
    pub(crate) fn between(mut ring: Vec<Vec3>, end: &[Vec3]) -> Option<Hull> {
        let count = ring.len();
        ring.extend(end);
        if end.len() == count {
            return Hull::new(ring, Topology::frustum(count));
        }
        let (n, tip) = (count as u32, count as u32);
        let mut faces: Vec<Vec<u32>> = (0..n).map(|k| vec![k, (k + 1) % n, tip]).collect();
        faces.push((0..n).rev().collect());
        Hull::new(ring, Arc::new(Topology::from_faces(count + 1, faces)))
    }

    /// A nearly convex solid, as [`Hull::new`] makes it, but without the faces that have no normal.
    pub(crate) fn nearly(vertices: Vec<Vec3>, topology: Arc<Topology>) -> Option<Hull> {
        Hull::over(vertices, topology, true)
    }

    /// A prism over a regular polygon, whose opposite sides are parallel when there is an even number of them.
    pub(crate) fn prism(vertices: Vec<Vec3>, sides: usize) -> Option<Hull> {
        let topology = Topology::prism(sides);
        if sides % 2 == 1 {
            return Hull::new(vertices, topology);
        }
        let faces = topology.faces[..sides / 2].iter().chain([&topology.faces[sides]]);
        let normals = faces.map(|face| face_normal(face, &vertices)).collect::<Option<Vec<Vec3>>>()?;
        Hull::of_parts(vertices, normals, topology)
    }

    fn over(vertices: Vec<Vec3>, topology: Arc<Topology>, flat_faces: bool) -> Option<Hull> {
        let mut normals = Vec::with_capacity(topology.faces.len());
        for face in &topology.faces {
            match face_normal(face, &vertices) {
                Some(normal) => push_direction(&mut normals, normal),
                None if flat_faces => {}
                None => return None,
            }
        }
        Hull::of_parts(vertices, normals, topology)
    }

    fn of_parts(vertices: Vec<Vec3>, normals: Vec<Vec3>, topology: Arc<Topology>) -> Option<Hull> {
        let width = narrowest(&vertices[..topology.corners], &normals);
        let points = [&vertices[..], &normals].concat().into();
        let edges = OnceCell::new();
        (width > 0.0).then_some(Hull { points, vertices: vertices.len(), topology, edges, width })
    }

    /// An upper bound of its bytes on the heap, with its edges.
    pub(crate) fn bytes(&self) -> usize {
        (self.points.len() + self.topology.edges.len()) * size_of::<Vec3>()
    }

    /// Smallest extent along a face normal: how thick the solid is.
    #[inline]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// The corners, without the centres of caps.
    #[inline]
    pub(crate) fn corners(&self) -> &[Vec3] {
        &self.points[..self.topology.corners]
    }

    /// Corners and the centres of caps, by the indices of the topology.
    #[inline]
    pub(crate) fn vertices(&self) -> &[Vec3] {
        &self.points[..self.vertices]
    }

    /// Unit face normals, each direction once.
    #[inline]
    pub(crate) fn normals(&self) -> &[Vec3] {
        &self.points[self.vertices..]
    }

    /// Faces, edges and triangles.
    #[inline]
    pub(crate) fn topology(&self) -> &Arc<Topology> {
        &self.topology
    }

    /// Unit edge directions, each once, up to sign; computed at the first use.
    pub(crate) fn edges(&self) -> &[Vec3] {
        self.edges.get_or_init(|| {
            let mut edges = Vec::new();
            for [a, b] in &self.topology.edges {
                if let Some(direction) = (self.points[*b as usize] - self.points[*a as usize]).unit() {
                    push_direction(&mut edges, direction);
                }
            }
            edges.into()
        })
    }
}

/// Smallest extent of `corners` along one of `normals`.
pub(crate) fn narrowest(corners: &[Vec3], normals: &[Vec3]) -> f64 {
    normals.iter().map(|n| span(corners, *n)).map(|(low, high)| high - low).fold(f64::INFINITY, f64::min)
}

/// Extent of `points` along `axis`.
#[inline]
pub(crate) fn span(points: &[Vec3], axis: Vec3) -> (f64, f64) {
    // Two points at a time, so that neither waits for the other.
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let mut look = |k: usize, p: &Vec3| {
        let along = p.dot(axis);
        low[k] = if along < low[k] { along } else { low[k] };
        high[k] = if along > high[k] { along } else { high[k] };
    };
    let (pairs, rest) = points.as_chunks::<2>();
    for [p, q] in pairs {
        look(0, p);
        look(1, q);
    }
    rest.iter().for_each(|p| look(0, p));
    (low[0].min(low[1]), high[0].max(high[1]))
}

/// Newell's normal: exact for planar faces, a mean otherwise.
fn face_normal(face: &[u32], vertices: &[Vec3]) -> Option<Vec3> {
    let at = |i: usize| vertices[face[i % face.len()] as usize];
    let origin = at(0);
    (1..face.len() - 1).fold(Vec3::ZERO, |sum, i| sum + (at(i) - origin).cross(at(i + 1) - origin)).unit()
}

/// Adds a direction, unless `directions` has it.
fn push_direction(directions: &mut Vec<Vec3>, new: Vec3) {
    // Parallel to within 1e-10 radians, in either direction.
    if !directions.iter().any(|d| d.dot(new).abs() > 0.999_999 && d.cross(new).dot(d.cross(new)) < 1e-20) {
        directions.push(new);
    }
}
