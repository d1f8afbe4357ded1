//! What the engine must know of a solid: the trait that each kind implements, and the checks that kinds share.

use crate::bounds::Aabb;
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::Vec3;

/// What the surface of a solid is, and so how it is voxelised and compared with others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A box: it needs no store for its eight corners. Only [`super::Solid::Box`] is one.
    Box,
    /// Convex: [`Measured::hull`] gives it.
    Convex,
    /// Any closed surface: [`Measured::mesh`] gives it. Slower than a hull, and right for a solid with a hollow or a hole.
    Mesh,
    /// On a plane parallel to z = 0: a shape of drawings, in space a thin plate ([`Measured::mesh`]).
    Flat,
}

/// The tone that pictures and files give a solid without a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Of flat faces: warm grey; among bark it is foliage.
    Plain,
    /// Of what is round: graphite; among bark it is foliage.
    Round,
    /// Of what grows. One such solid without a colour makes a scene a garden.
    Bark,
}

impl Tone {
    /// `plain`, `round` or `bark`.
    pub fn name(self) -> &'static str {
        match self {
            Tone::Plain => "plain",
            Tone::Round => "round",
            Tone::Bark => "bark",
        }
    }
}

/// The measures of a kind of solid, as data: small, and serialised as it is (a stored scene has its fields by name).
///
/// The solid lies around the origin, in scene units, right-handed with y up. A method that takes a [`Placement`] gives
/// points of the world: `placement.apply(p)`, so that a corner that two parts share is computed once, with the same bits.
pub trait Measured {
    /// Its name in messages and in `Shape.kind`: lower case, words joined by hyphens.
    const KIND: &'static str;
    /// What its surface is.
    const FORM: Form = Form::Convex;
    /// Its tone where it has no colour.
    const TONE: Tone = Tone::Plain;

    /// Refuses measures that no solid has: sizes that are not positive and finite, directions that are none. What passes has
    /// a fine mesh; whether it also has an inside at its place says the hull or the mesh.
    ///
    /// # Errors
    /// `bad-shape`, with the measure, its value and what is expected; [`Checks`] has the sentences.
    fn check(&self, checks: Checks) -> Result<(), GeomError>;

    /// Bytes that it takes beside itself, on the heap.
    fn bytes(&self) -> usize {
        0
    }

    /// The convex solid in the world, of [`Form::Convex`]: few corners, which voxels and intersections use. Round parts are
    /// inscribed polygons with a vertex on each axis ([`crate::ring`]), because parts are attached flush there. `None`
    /// where it has no inside.
    fn hull(&self, _placement: &Placement) -> Option<Coarse> {
        None
    }

    /// The closed surface in the world, counter-clockwise seen from outside, of [`Form::Mesh`] and [`Form::Flat`].
    ///
    /// # Errors
    /// `bad-shape` for a surface that is none.
    fn mesh(&self, _placement: &Placement) -> Result<TriMesh, GeomError> {
        bad("a solid without geometry".to_string())
    }

    /// The smallest box around [`Measured::mesh`], of every form but [`Form::Convex`].
    ///
    /// # Errors
    /// `bad-shape` for a placement that this solid cannot have.
    fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
        self.mesh(placement).map(|mesh| mesh.aabb())
    }

    /// The frame about which a person would turn it, in the world: a point of it, and its own axes.
    fn frame(&self, placement: &Placement) -> Placement {
        *placement
    }

    /// The mesh for pictures and files, around the origin: closed, round, with a unit normal at each vertex; its edges are
    /// rounded by `bevel` (a share of the half lengths, from 0 to 1) where the shape gives one.
    fn fine(&self, bevel: Option<f64>) -> FineMesh;
}

/// The checks of measures, with the sentences of their errors (`bad-shape`). They name the kind of solid.
#[derive(Clone, Copy, Debug)]
pub struct Checks {
    kind: &'static str,
}

impl Checks {
    /// Of this kind of solid.
    pub fn of<M: Measured>() -> Checks {
        Checks { kind: M::KIND }
    }

    /// A length above zero.
    #[inline]
    pub fn positive(self, what: &str, x: f64) -> Result<(), GeomError> {
        match x > 0.0 && x.is_finite() {
            true => Ok(()),
            false => bad(format!("the {what} of a {} is {x}, expected a positive number", self.kind)),
        }
    }

    /// A length of zero or more.
    #[inline]
    pub fn not_negative(self, what: &str, x: f64) -> Result<(), GeomError> {
        if x == 0.0 { Ok(()) } else { self.positive(what, x) }
    }

    /// Sides of a polygon.
    #[inline]
    pub fn sides(self, sides: usize) -> Result<(), GeomError> {
        match (3..=1024).contains(&sides) {
            true => Ok(()),
            false => bad(format!("a {} has {sides} sides, expected 3 to 1024", self.kind)),
        }
    }

    /// Full lengths along x, y and z.
    #[inline]
    pub fn sizes(self, size: Vec3) -> Result<(), GeomError> {
        size.to_array().into_iter().try_for_each(|s| self.positive("size", s))
    }

    /// A point; `what` is the subject of the sentence.
    #[inline]
    pub fn finite(self, what: &str, p: Vec3) -> Result<(), GeomError> {
        match p.is_finite() {
            true => Ok(()),
            false => bad(format!("the {what} is {:?}, expected finite numbers", p.to_array())),
        }
    }

    /// A direction of length 1; `what` is the subject of the sentence.
    #[inline]
    pub fn unit(self, what: &str, v: Vec3) -> Result<(), GeomError> {
        match (v.norm() - 1.0).abs() < 1e-6 {
            true => Ok(()),
            false => bad(format!("the {what} is {:?}, expected a direction of length 1", v.to_array())),
        }
    }
}

/// The fault of a solid that lies in a plane.
#[cold]
pub(crate) fn no_inside<T>(kind: &str) -> Result<T, GeomError> {
    bad(format!("{kind} has no inside"))
}
