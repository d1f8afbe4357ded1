//! Convex solids for intersections and voxels.

use crate::placement::Placement;
use crate::polytope::{Hull, narrowest};
use crate::segment;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use std::cell::OnceCell;
use std::rc::Rc;
use std::sync::Arc;

/// A convex solid in the world, as scores use it.
///
/// The corners of a box are computed from its placement at each use, because most emitted shapes are boxes, and a population
/// has millions. Every other solid lends its stored hull.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "corners are on the stack only while they are used")]
pub enum Convex<'a> {
    /// Corners, and unit normals of the faces, along which the edges run too.
    Cuboid([Vec3; 8], [Vec3; 3]),
    /// Another convex solid, with its stored hull.
    Coarse(Rc<Coarse>),
    /// A piece of a solid.
    Hull(&'a Hull),
}

/// The hull of a coarse mesh, and its pieces where it is larger than the solid.
#[derive(Debug)]
pub struct Coarse {
    whole: Hull,
    /// For a segment: true if its base is on a parent's bark.
    welded: Option<bool>,
    /// The pieces of a segment, computed at the first use.
    pieces: OnceCell<Box<[Hull]>>,
}

impl Coarse {
    /// The hull of a convex solid.
    pub(crate) fn new(whole: Hull) -> Coarse {
        Coarse { whole, welded: None, pieces: OnceCell::new() }
    }

    /// The hull of a segment; `welded` for a base on a parent's bark.
    pub(crate) fn of_segment(whole: Hull, welded: bool) -> Coarse {
        Coarse { welded: Some(welded), ..Coarse::new(whole) }
    }

    /// Smallest extent along a face normal: how thick the solid is.
    pub fn width(&self) -> f64 {
        self.whole.width()
    }

    /// Corners of the hull, world space.
    pub fn corners(&self) -> &[Vec3] {
        self.whole.corners()
    }

    /// An upper bound of its bytes, with its pieces.
    pub(crate) fn bytes(&self) -> usize {
        let whole = self.whole.bytes() + size_of::<Coarse>();
        let topology = self.whole.topology();
        // The pieces of a segment have more corners than its hull.
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
            Convex::Hull(hull) => hull.width(),
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

    /// Corners and the centres of caps, by the indices of the topology.
    #[inline]
    pub fn vertices(&self) -> &[Vec3] {
        match self {
            Convex::Cuboid(corners, _) => corners,
            Convex::Coarse(coarse) => coarse.whole.vertices(),
            Convex::Hull(hull) => hull.vertices(),
        }
    }

    /// Faces, edges and triangles.
    #[inline]
    pub fn topology(&self) -> &Topology {
        match self {
            Convex::Cuboid(..) => Topology::cuboid(),
            Convex::Coarse(coarse) => coarse.whole.topology(),
            Convex::Hull(hull) => hull.topology(),
        }
    }

    /// Unit face normals, each direction once (never both a direction and its opposite).
    #[inline]
    pub fn normals(&self) -> &[Vec3] {
        match self {
            Convex::Cuboid(_, normals) => normals,
            Convex::Coarse(coarse) => coarse.whole.normals(),
            Convex::Hull(hull) => hull.normals(),
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

    /// The convex solids whose union is the shape, if this solid is larger than the shape.
    pub fn pieces(&self) -> Option<&[Hull]> {
        let Convex::Coarse(coarse) = self else { return None };
        let welded = coarse.welded?;
        Some(coarse.pieces.get_or_init(|| segment::pieces(coarse.corners(), welded)))
    }
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
