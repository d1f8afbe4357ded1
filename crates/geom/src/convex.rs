//! Convex solids as intersection and voxels use them.

use crate::segment;
use crate::shape::Placement;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use std::cell::OnceCell;
use std::rc::Rc;
use std::sync::Arc;

/// A convex solid in the world, as scores use it.
///
/// A box's corners are computed from its placement when they are needed, which costs less than to keep them: most
/// emitted shapes are boxes, and a population holds millions. Every other solid lends its kept hull.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "corners are on the stack only while they are used")]
pub enum Convex<'a> {
    /// Corners, and unit normals of the faces, along which the edges run too.
    Cuboid([Vec3; 8], [Vec3; 3]),
    /// Another convex solid, and what is known about it.
    Coarse(Rc<Coarse>),
    /// A piece of one.
    Hull(&'a Hull),
}

/// The hull of a coarse mesh, and its pieces where it is larger than the solid.
#[derive(Debug)]
pub struct Coarse {
    whole: Hull,
    /// Of a segment, whether its base is on a parent's bark.
    welded: Option<bool>,
    /// Of a segment, computed when first needed.
    pieces: OnceCell<Box<[Hull]>>,
}

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
    /// From world vertices (hull corners first, then the points that only triangles use).
    ///
    /// `None` when a face has no normal, which a flat solid has.
    pub(crate) fn new(vertices: Vec<Vec3>, topology: Arc<Topology>) -> Option<Hull> {
        Hull::over(vertices, topology, false)
    }

    /// As [`Hull::new`], for a solid that is nearly convex; a face without a normal is left out.
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

    /// Smallest extent along a face normal: how thick the solid is.
    pub fn width(&self) -> f64 {
        self.width
    }

    fn corners(&self) -> &[Vec3] {
        &self.points[..self.topology.corners]
    }

    fn edges(&self) -> &[Vec3] {
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

impl Coarse {
    /// Of a convex solid.
    pub(crate) fn new(whole: Hull) -> Coarse {
        Coarse { whole, welded: None, pieces: OnceCell::new() }
    }

    /// Of a segment; `welded` where its base is on a parent's bark.
    pub(crate) fn of_segment(whole: Hull, welded: bool) -> Coarse {
        Coarse { welded: Some(welded), ..Coarse::new(whole) }
    }

    /// Smallest extent along a face normal: how thick the solid is.
    pub fn width(&self) -> f64 {
        self.whole.width
    }

    /// Corners of the hull, world space.
    pub fn corners(&self) -> &[Vec3] {
        self.whole.corners()
    }

    /// Bytes that it takes, or a little more, with all that it may compute.
    pub(crate) fn bytes(&self) -> usize {
        let Hull { points, topology, .. } = &self.whole;
        let whole = (points.len() + topology.edges.len()) * size_of::<Vec3>() + size_of::<Coarse>();
        // The pieces of a segment have more corners than it.
        whole * if self.welded.is_some() { 3 } else { 1 }
            + if Arc::strong_count(topology) == 1 { topology.bytes() } else { 0 }
    }
}

impl Convex<'_> {
    /// A box around the origin with full side lengths `size`, placed.
    #[inline]
    pub(crate) fn cuboid(size: Vec3, placement: &Placement) -> Convex<'static> {
        let normals = if is_aligned(&placement.rotation) { Vec3::AXES } else { placement.rotation.columns };
        Convex::Cuboid(cuboid(size, 1.0, placement), normals)
    }

    /// Smallest extent along a face normal: how thick the solid is.
    pub fn width(&self) -> f64 {
        match self {
            Convex::Cuboid(corners, normals) => narrowest(corners, normals),
            Convex::Coarse(coarse) => coarse.width(),
            Convex::Hull(hull) => hull.width,
        }
    }

    /// Corners of the hull, world space.
    #[inline]
    pub fn corners(&self) -> &[Vec3] {
        match self {
            Convex::Cuboid(corners, _) => corners,
            Convex::Coarse(coarse) => coarse.corners(),
            Convex::Hull(hull) => hull.corners(),
        }
    }

    /// Corners and the centres of caps: what the indices of the topology mean.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        match self {
            Convex::Cuboid(corners, _) => corners,
            Convex::Coarse(coarse) => &coarse.whole.points[..coarse.whole.vertices],
            Convex::Hull(hull) => &hull.points[..hull.vertices],
        }
    }

    /// Faces, edges and triangles.
    #[inline]
    pub fn topology(&self) -> &Topology {
        match self {
            Convex::Cuboid(..) => Topology::cuboid(),
            Convex::Coarse(coarse) => &coarse.whole.topology,
            Convex::Hull(hull) => &hull.topology,
        }
    }

    /// Unit face normals, each direction once (never both a direction and its opposite).
    #[inline]
    pub fn normals(&self) -> &[Vec3] {
        match self {
            Convex::Cuboid(_, normals) => normals,
            Convex::Coarse(coarse) => &coarse.whole.points[coarse.whole.vertices..],
            Convex::Hull(hull) => &hull.points[hull.vertices..],
        }
    }

    /// Unit edge directions, each once, up to sign.
    #[inline]
    pub fn edges(&self) -> &[Vec3] {
        match self {
            Convex::Cuboid(_, normals) => normals,
            Convex::Coarse(coarse) => coarse.whole.edges(),
            Convex::Hull(hull) => hull.edges(),
        }
    }

    /// The convex solids whose union the shape is, where this solid is larger than the shape.
    pub fn pieces(&self) -> Option<&[Hull]> {
        let Convex::Coarse(coarse) = self else { return None };
        let welded = coarse.welded?;
        Some(coarse.pieces.get_or_init(|| segment::pieces(coarse.corners(), welded)))
    }
}

/// Smallest extent of `corners` along one of `normals`.
fn narrowest(corners: &[Vec3], normals: &[Vec3]) -> f64 {
    normals.iter().map(|n| span(corners, *n)).map(|(low, high)| high - low).fold(f64::INFINITY, f64::min)
}

/// True when a rotation leaves the sides of a box exactly along the coordinate directions.
#[inline]
pub(crate) fn is_aligned(rotation: &Mat3) -> bool {
    rotation.columns.iter().all(|c| Vec3::AXES.contains(&vec3(c.x.abs(), c.y.abs(), c.z.abs())))
}

/// Corners of a box whose +z face is scaled by `taper`; bits 0, 1 and 2 of the index choose the high x, y and z.
#[inline]
pub(crate) fn cuboid(size: Vec3, taper: f64, placement: &Placement) -> [Vec3; 8] {
    let half = size * 0.5;
    std::array::from_fn(|i| {
        let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let end = if i >> 2 == 1 { taper } else { 1.0 };
        placement.apply(vec3(sign(0) * half.x * end, sign(1) * half.y * end, sign(2) * half.z))
    })
}

/// Extent of `points` along `axis`.
#[inline]
pub(crate) fn span(points: &[Vec3], axis: Vec3) -> (f64, f64) {
    // Two at a time, so that one need not wait for the other.
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

/// Newell's normal: exact for planar faces, the mean one otherwise.
fn face_normal(face: &[u32], vertices: &[Vec3]) -> Option<Vec3> {
    let at = |i: usize| vertices[face[i % face.len()] as usize];
    let origin = at(0);
    (1..face.len() - 1).fold(Vec3::ZERO, |sum, i| sum + (at(i) - origin).cross(at(i + 1) - origin)).unit()
}

/// Adds a direction, unless it is among them.
fn push_direction(directions: &mut Vec<Vec3>, new: Vec3) {
    // Parallel to within 1e-10 radians, in either direction.
    if !directions.iter().any(|d| d.dot(new).abs() > 0.999_999 && d.cross(new).dot(d.cross(new)) < 1e-20) {
        directions.push(new);
    }
}
