//! Convex solids by their corners and faces, with the directions along which they can be separated.

use crate::hull::hull;
use crate::topology::Topology;
use crate::vector::Vec3;
use std::cell::OnceCell;
use std::sync::Arc;
use wide::f64x2;

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
        let (count, mut points) = (vertices.len(), vertices);
        points.reserve_exact(sides / 2 + 1);
        for face in topology.faces[..sides / 2].iter().chain([&topology.faces[sides]]) {
            points.push(face_normal(face, &points)?);
        }
        Hull::of_parts(points, count, topology)
    }

    fn over(vertices: Vec<Vec3>, topology: Arc<Topology>, flat_faces: bool) -> Option<Hull> {
        let (count, mut points) = (vertices.len(), vertices);
        points.reserve_exact(topology.faces.len());
        for face in &topology.faces {
            match face_normal(face, &points) {
                Some(normal) => push_direction(&mut points, count, normal),
                None if flat_faces => {}
                None => return None,
            }
        }
        Hull::of_parts(points, count, topology)
    }

    /// A solid of so many vertices and of the normals after them.
    fn of_parts(points: Vec<Vec3>, vertices: usize, topology: Arc<Topology>) -> Option<Hull> {
        let width = narrowest(&points[..topology.corners], &points[vertices..]);
        let edges = OnceCell::new();
        (width > 0.0).then(|| Hull { points: points.into(), vertices, topology, edges, width })
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
                    push_direction(&mut edges, 0, direction);
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
    // Two points at a time are the two halves of a register of the processor.
    let [x, y, z] = axis.to_array().map(f64x2::splat);
    let (mut low, mut high) = (f64x2::splat(f64::INFINITY), f64x2::splat(f64::NEG_INFINITY));
    let mut look = |p: &Vec3, q: &Vec3| {
        let pair = |a, b| f64x2::new([a, b]);
        let along = pair(p.x, q.x) * x + pair(p.y, q.y) * y + pair(p.z, q.z) * z;
        (low, high) = (low.fast_min(along), high.fast_max(along));
    };
    let (pairs, rest) = points.as_chunks::<2>();
    pairs.iter().for_each(|[p, q]| look(p, q));
    rest.iter().for_each(|p| look(p, p));
    let (low, high) = (low.to_array(), high.to_array());
    (low[0].min(low[1]), high[0].max(high[1]))
}

/// Newell's normal: exact for planar faces, a mean otherwise.
fn face_normal(face: &[u32], vertices: &[Vec3]) -> Option<Vec3> {
    let origin = vertices[face[0] as usize];
    let mut sides = face[1..].iter().map(|corner| vertices[*corner as usize] - origin);
    let mut before = sides.next()?;
    let add = |sum: Vec3, next: Vec3| sum + std::mem::replace(&mut before, next).cross(next);
    sides.fold(Vec3::ZERO, add).unit()
}

/// Adds a direction to those that begin at `first`, unless they have it.
fn push_direction(points: &mut Vec<Vec3>, first: usize, new: Vec3) {
    // Parallel to within 1e-10 radians, in either direction.
    let is_new = |d: &Vec3| d.dot(new).abs() <= 0.999_999 || d.cross(new).dot(d.cross(new)) >= 1e-20;
    if points[first..].iter().all(is_new) {
        points.push(new);
    }
}
