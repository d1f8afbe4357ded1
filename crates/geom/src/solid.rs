//! The measures of a solid, as data: what it is, how large, and where it is placed.
//!
//! Solids are centred at the origin and *placed*: first turned, then moved.

use crate::error::{GeomError, bad_shape as bad};
use crate::mesh::TriMesh;
use crate::ring::Ring;
use crate::tube::Tube;
use crate::vector::{Mat3, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A round end of a stroke.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Round {
    /// Middle, scene units.
    pub center: Vec3,
    /// Greater than zero.
    pub radius: f64,
}

/// The solid of a shape, centred at the origin (a limb and a mesh: at their coordinates).
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Solid {
    /// Full side lengths.
    Box {
        /// Along x, y and z.
        size: Vec3,
    },
    /// A box whose +z face is scaled about its middle.
    TaperedBox {
        /// Along x, y and z.
        size: Vec3,
        /// Scale of the +z face in x and y.
        taper: f64,
    },
    /// A prism along +y over an inscribed polygon whose first vertex points to +z.
    Cylinder {
        /// Distance of the vertices from the axis.
        radius: f64,
        /// Along y.
        length: f64,
        /// Of the polygon.
        sides: usize,
    },
    /// A cylinder with two radii.
    TaperedCylinder {
        /// At the -y end.
        radius: f64,
        /// At the +y end.
        top_radius: f64,
        /// Along y.
        length: f64,
        /// Of the polygon.
        sides: usize,
    },
    /// Convex hull of two rings: a bent, tapered segment. Limbs that share a ring only touch, as long as each lies
    /// on its own side of the ring's plane.
    Limb {
        /// Start and end.
        rings: Box<[Ring; 2]>,
        /// Of both rings.
        sides: usize,
    },
    /// A bent, tapered tube over three rings whose base may lie on a parent's bark: see [`crate::segment`].
    Segment(Tube),
    /// Any closed mesh.
    Mesh(Arc<TriMesh>),
    /// Flat: the convex hull of two circles on one plane parallel to z = 0, a straight stroke with round ends.
    Stroke {
        /// Start and end.
        ends: Box<[Round; 2]>,
    },
    /// Flat: an ellipse on a plane parallel to z = 0.
    Ellipse {
        /// Full lengths along its own x and y.
        size: [f64; 2],
    },
}

impl Solid {
    /// True for what lies on a plane parallel to z = 0; in space it is a thin plate.
    pub fn is_flat(&self) -> bool {
        matches!(self, Solid::Stroke { .. } | Solid::Ellipse { .. })
    }

    /// `box`, `tapered-box`, `cylinder`, `tapered-cylinder`, `limb`, `segment`, `mesh`, `stroke` or `ellipse`.
    pub fn kind(&self) -> &'static str {
        match self {
            Solid::Box { .. } => "box",
            Solid::TaperedBox { .. } => "tapered-box",
            Solid::Cylinder { .. } => "cylinder",
            Solid::TaperedCylinder { .. } => "tapered-cylinder",
            Solid::Limb { .. } => "limb",
            Solid::Segment(_) => "segment",
            Solid::Mesh(_) => "mesh",
            Solid::Stroke { .. } => "stroke",
            Solid::Ellipse { .. } => "ellipse",
        }
    }

    /// Bytes that it takes beside itself, and of a mesh those of its triangles.
    pub(crate) fn bytes(&self) -> usize {
        match self {
            Solid::Limb { .. } => size_of::<[Ring; 2]>(),
            Solid::Segment(tube) => tube.bytes(),
            Solid::Mesh(mesh) => mesh.bytes(),
            Solid::Stroke { .. } => size_of::<[Round; 2]>(),
            _ => 0,
        }
    }

    /// Refuses measures that no solid has.
    ///
    /// # Errors
    /// `bad-shape` for sizes that are not positive and finite, and for directions that are none.
    #[inline]
    pub(crate) fn check(&self) -> Result<(), GeomError> {
        let positive = |what: &str, x: f64| match x > 0.0 && x.is_finite() {
            true => Ok(()),
            false => bad(format!("the {what} of a {} is {x}, expected a positive number", self.kind())),
        };
        let not_negative = |what: &str, x: f64| if x == 0.0 { Ok(()) } else { positive(what, x) };
        let polygon = |sides: usize| match (3..=1024).contains(&sides) {
            true => Ok(()),
            false => bad(format!("a {} has {sides} sides, expected 3 to 1024", self.kind())),
        };
        let sized = |size: Vec3| size.to_array().into_iter().try_for_each(|s| positive("size", s));
        let finite = |what: &str, p: Vec3| match p.is_finite() {
            true => Ok(()),
            false => bad(format!("the {what} is {:?}, expected finite numbers", p.to_array())),
        };
        let unit = |what: &str, v: Vec3| match (v.norm() - 1.0).abs() < 1e-6 {
            true => Ok(()),
            false => bad(format!("the {what} is {:?}, expected a direction of length 1", v.to_array())),
        };
        match self {
            Solid::Box { size } => sized(*size),
            Solid::TaperedBox { size, taper } => sized(*size).and_then(|()| not_negative("taper", *taper)),
            Solid::Cylinder { radius, length, sides } => {
                positive("radius", *radius)?;
                positive("length", *length)?;
                polygon(*sides)
            }
            Solid::TaperedCylinder { radius, top_radius, length, sides } => {
                positive("radius", *radius)?;
                not_negative("top radius", *top_radius)?;
                positive("length", *length)?;
                polygon(*sides)
            }
            Solid::Limb { rings, sides } => {
                for ring in rings.iter() {
                    positive("radius", ring.radius)?;
                    finite("centre of an end of a limb", ring.center)?;
                    unit("normal of an end of a limb", ring.normal)?;
                }
                polygon(*sides)
            }
            Solid::Segment(tube) => {
                for frame in &tube.frames() {
                    positive("radius", frame.radius)?;
                    finite("centre of a segment's frame", frame.center)?;
                    unit("forward direction of a segment's frame", frame.forward)?;
                    unit("up direction of a segment's frame", frame.up)?;
                    let slant = frame.forward.dot(frame.up).abs();
                    if slant.is_nan() || slant > 1e-6 {
                        let [forward, up] = [frame.forward, frame.up].map(Vec3::to_array);
                        return bad(format!(
                            "the directions of a segment's frame are {forward:?} and {up:?}, expected a right angle between them"
                        ));
                    }
                }
                tube.onto().map_or(Ok(()), |bark| {
                    positive("parent's radius", bark.low_radius)?;
                    positive("parent's radius", bark.high_radius)
                })
            }
            Solid::Mesh(_) => Ok(()),
            Solid::Stroke { ends } => ends.iter().try_for_each(|end| {
                positive("radius", end.radius)?;
                finite("end of a stroke", end.center)
            }),
            Solid::Ellipse { size } => size.iter().try_for_each(|s| positive("size", *s)),
        }
    }
}

/// First turn, then move.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Placement {
    /// A rotation.
    pub rotation: Mat3,
    /// Scene units.
    pub translation: Vec3,
}

impl Placement {
    /// No movement.
    pub const IDENTITY: Placement = Placement { rotation: Mat3::IDENTITY, translation: Vec3::ZERO };

    /// Refuses a place that is not finite, and what is no rotation.
    #[inline]
    pub(crate) fn check(&self) -> Result<(), GeomError> {
        if !self.translation.is_finite() {
            return bad(format!("the centre is {:?}, expected finite numbers", self.translation.to_array()));
        }
        let defect = self.rotation.defect();
        if defect.is_nan() || defect > 1e-6 {
            return bad(format!("the rotation is not a rotation: it is off by {defect}"));
        }
        Ok(())
    }

    /// From the solid's own coordinates to the world's.
    #[inline]
    pub fn apply(&self, p: Vec3) -> Vec3 {
        self.rotation.apply(p) + self.translation
    }
}
