//! The trait of each kind of solid, and the checks of measures.

use crate::bounds::Aabb;
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::Vec3;

/// The form of the surface of a solid: it decides how the solid is voxelised and intersected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A box, which needs no store for its eight corners. Only [`super::Solid::Box`] has this form.
    Box,
    /// A convex solid, by [`Measured::hull`].
    Convex,
    /// Any closed surface, by [`Measured::mesh`]. It is slower than a hull, and right for a solid with a hollow or a hole.
    Mesh,
    /// A shape of drawings on a plane parallel to z = 0, in space a thin plate ([`Measured::mesh`]).
    Flat,
}

/// The tone that pictures and files give a solid without a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// The tone of flat faces: warm grey; among bark it is foliage.
    Plain,
    /// The tone of round solids: graphite; among bark it is foliage.
    Round,
    /// The tone of plants. A single such solid without a colour makes a scene a garden.
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
    /// The name in messages and in `Shape.kind`: lower case, words joined by hyphens.
    const KIND: &'static str;
    /// The form of the surface.
    const FORM: Form = Form::Convex;
    /// The tone without a colour.
    const TONE: Tone = Tone::Plain;

    /// The form of these measures: a kind of [`Form::Mesh`] may have convex solids, which are faster as such.
    #[inline]
    fn form(&self) -> Form {
        Self::FORM
    }

    /// Refuses measures that no solid has: sizes that are not positive and finite, vectors that are no directions. A solid that
    /// passes has a fine mesh; its hull or mesh decides whether it also has an inside at its place.
    ///
    /// # Errors
    /// `bad-shape`, with the measure, its value and what is expected; [`Checks`] has the sentences.
    fn check(&self, checks: Checks) -> Result<(), GeomError>;

    /// Its bytes on the heap.
    fn bytes(&self) -> usize {
        0
    }

    /// The convex solid of [`Form::Convex`] in the world, with few corners for voxels and intersections. Round parts are
    /// inscribed polygons with a vertex on each axis ([`crate::ring`]), because parts are attached flush there. `None`
    /// without an inside.
    fn hull(&self, _placement: &Placement) -> Option<Coarse> {
        None
    }

    /// The closed surface of [`Form::Mesh`] and [`Form::Flat`] in the world, counter-clockwise seen from outside.
    ///
    /// # Errors
    /// `bad-shape` for triangles that are no surface.
    fn mesh(&self, _placement: &Placement) -> Result<TriMesh, GeomError> {
        bad("a solid without geometry".to_string())
    }

    /// The smallest box around [`Measured::mesh`], for every form but [`Form::Convex`].
    ///
    /// # Errors
    /// `bad-shape` for a placement that this solid cannot have.
    fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
        self.mesh(placement).map(|mesh| mesh.aabb())
    }

    /// The frame about which a person turns the solid, in the world: one of its points, and its axes.
    fn frame(&self, placement: &Placement) -> Placement {
        *placement
    }

    /// The solid reflected at its plane x = 0, for kinds that are not their own reflection.
    fn mirrored(&self) -> Self
    where
        Self: Clone,
    {
        self.clone()
    }

    /// The mesh for pictures and files, around the origin: closed, round, with a unit normal at each vertex; edges are
    /// rounded by `bevel` (a share of the half lengths, from 0 to 1), if the shape has it.
    fn fine(&self, bevel: Option<f64>) -> FineMesh;
}

/// The frame of a solid that was drawn about an origin of its own: there, or in the middle of the solid where the origin is outside.
pub(crate) fn frame_within<M: Measured>(solid: &M, placement: &Placement) -> Placement {
    let Ok(around) = solid.aabb(placement) else { return *placement };
    let origin = placement.translation;
    let is_within = around.contains(&Aabb { low: origin, high: origin });
    Placement { translation: if is_within { origin } else { around.center() }, ..*placement }
}

/// The checks of measures, with the sentences of their errors (`bad-shape`). They name the kind of solid.
#[derive(Clone, Copy, Debug)]
pub struct Checks {
    kind: &'static str,
}

impl Checks {
    /// The checks of this kind of solid.
    pub fn of<M: Measured>() -> Checks {
        Checks { kind: M::KIND }
    }

    /// Refuses a length unless it is above zero.
    #[inline]
    pub fn positive(self, subject: &str, x: f64) -> Result<(), GeomError> {
        match x > 0.0 && x.is_finite() {
            true => Ok(()),
            false => bad(format!("the {subject} of a {} is {x}, expected a positive number", self.kind)),
        }
    }

    /// Refuses a length below zero.
    #[inline]
    pub fn not_negative(self, subject: &str, x: f64) -> Result<(), GeomError> {
        if x == 0.0 { Ok(()) } else { self.positive(subject, x) }
    }

    /// Refuses a number of sides that no polygon has.
    #[inline]
    pub fn sides(self, sides: usize) -> Result<(), GeomError> {
        match (3..=1024).contains(&sides) {
            true => Ok(()),
            false => bad(format!("a {} has {sides} sides, expected 3 to 1024", self.kind)),
        }
    }

    /// Refuses full lengths along x, y and z unless they are above zero.
    #[inline]
    pub fn sizes(self, size: Vec3) -> Result<(), GeomError> {
        size.to_array().into_iter().try_for_each(|s| self.positive("size", s))
    }

    /// Refuses a point that is not finite; `subject` begins the sentence.
    #[inline]
    pub fn finite(self, subject: &str, p: Vec3) -> Result<(), GeomError> {
        match p.is_finite() {
            true => Ok(()),
            false => bad(format!("the {subject} is {:?}, expected finite numbers", p.to_array())),
        }
    }

    /// Refuses a direction unless its length is 1; `subject` begins the sentence.
    #[inline]
    pub fn unit(self, subject: &str, v: Vec3) -> Result<(), GeomError> {
        match (v.norm() - 1.0).abs() < 1e-6 {
            true => Ok(()),
            false => bad(format!("the {subject} is {:?}, expected a direction of length 1", v.to_array())),
        }
    }
}

/// Refuses a solid that lies in a plane.
#[cold]
pub(crate) fn no_inside<T>(kind: &str) -> Result<T, GeomError> {
    bad(format!("{kind} has no inside"))
}
