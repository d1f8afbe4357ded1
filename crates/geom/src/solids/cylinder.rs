//! Cylinders and frustums of cones: `cylinder`.

use super::measured::{Checks, Measured, Tone};
use super::word::kinds::{Axis, Length, Point, Turn};
use super::word::{Either, Word, direction, laid_along, placed, plain};
use crate::convex::Coarse;
use crate::error::GeomError;
use crate::fine::{FineMesh, revolve};
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::ring::ring;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};

/// Default number of sides (dissertation chapter 5's coarse mesh).
pub(super) const SIDES: usize = 8;
/// Rounding of rims whose shape gives none, as a share of the smaller of the radius and the half length.
pub(super) const BEVEL: f64 = 0.12;

/// A prism along +y over an inscribed polygon whose first vertex points to +z.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Cylinder {
    /// Distance of the vertices from the axis.
    pub radius: f64,
    /// Length along y.
    pub length: f64,
    /// Number of sides of the polygon.
    pub sides: usize,
}

/// A cylinder with two radii.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct TaperedCylinder {
    /// Radius at the -y end.
    pub radius: f64,
    /// Radius at the +y end.
    pub top_radius: f64,
    /// Length along y.
    pub length: f64,
    /// Number of sides of the polygon.
    pub sides: usize,
}

impl Measured for Cylinder {
    const KIND: &'static str = "cylinder";
    const TONE: Tone = Tone::Round;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.positive("radius", self.radius)?;
        checks.positive("length", self.length)?;
        checks.sides(self.sides)
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        prism(self.radius, self.radius, self.length, self.sides, placement).map(Coarse::new)
    }

    fn fine(&self, bevel: Option<f64>) -> FineMesh {
        revolve::rounded(self.radius, self.radius, self.length, bevel.unwrap_or(BEVEL))
    }
}

impl Measured for TaperedCylinder {
    const KIND: &'static str = "tapered-cylinder";
    const TONE: Tone = Tone::Round;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.positive("radius", self.radius)?;
        checks.not_negative("top radius", self.top_radius)?;
        checks.positive("length", self.length)?;
        checks.sides(self.sides)
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        prism(self.radius, self.top_radius, self.length, self.sides, placement).map(Coarse::new)
    }

    fn fine(&self, bevel: Option<f64>) -> FineMesh {
        revolve::rounded(self.radius, self.top_radius, self.length, bevel.unwrap_or(BEVEL))
    }
}

fn prism(bottom: f64, top: f64, length: f64, sides: usize, placement: &Placement) -> Option<Hull> {
    let half = 0.5 * length;
    let mut vertices = Vec::with_capacity(2 * sides + 2);
    vertices.extend(ring(sides).map(|(sin, cos)| placement.apply(vec3(sin * bottom, -half, cos * bottom))));
    if top == 0.0 {
        vertices.push(placement.apply(vec3(0.0, half, 0.0)));
        return Hull::around(vertices);
    }
    vertices.extend(ring(sides).map(|(sin, cos)| placement.apply(vec3(sin * top, half, cos * top))));
    vertices.extend([-half, half].map(|y| placement.apply(vec3(0.0, y, 0.0))));
    if top == bottom { Hull::prism(vertices, sides) } else { Hull::new(vertices, Topology::prism(sides)) }
}

/// A cylinder along `axis` (any length), its `top_radius` at the end that the axis points to, and how it is laid.
pub(super) fn along(
    radius: f64,
    length: f64,
    axis: Vec3,
    top_radius: Option<f64>,
) -> Result<(Either<Cylinder, TaperedCylinder>, Mat3), GeomError> {
    let sides = SIDES;
    let solid = match top_radius {
        Some(top_radius) if top_radius != radius => {
            Either::Other(TaperedCylinder { radius, top_radius, length, sides })
        }
        _ => Either::Plain(Cylinder { radius, length, sides }),
    };
    Ok((solid, Mat3::between(Vec3::AXES[1], direction(axis, "axis")?)))
}

word! {
    /// A cylinder, or a cone cut off when `top_radius` is given.
    "cylinder" CylinderWord {
        /// Its middle.
        center: Point,
        /// Radius of the start, greater than 0.
        radius: Length,
        /// Length along its axis, greater than 0.
        length: Length,
        /// "x", "y", "z" or a direction.
        axis: Axis = "y",
        /// Radius of the far end; `radius` when left out.
        top_radius: Option<Length>,
        /// Turns it about its middle.
        rotation: Option<Turn>,
        ..BEVELLED
    }
}

impl<S: Scalar> Word<S> for CylinderWord<S> {
    type Solid = Either<Cylinder, TaperedCylinder>;

    #[inline]
    fn solid(&self) -> Result<(Self::Solid, Placement), GeomError> {
        let top = self.top_radius.map(Scalar::value);
        let (solid, laid) = along(self.radius.value(), self.length.value(), plain(self.axis), top)?;
        Ok((solid, placed(self.center, laid, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        laid_along(self.center, self.axis, self.rotation, self.length)
    }
}

word! {
    /// A cone.
    "cone" ConeWord {
        /// The middle between its base and its tip.
        center: Point,
        /// Radius of the base, greater than 0.
        radius: Length,
        /// Length along its axis, greater than 0.
        length: Length,
        /// "x", "y", "z" or a direction: towards the tip.
        axis: Axis = "y",
        /// Turns it about its middle.
        rotation: Option<Turn>,
        ..BEVELLED
    }
}

impl<S: Scalar> Word<S> for ConeWord<S> {
    type Solid = Either<Cylinder, TaperedCylinder>;

    fn solid(&self) -> Result<(Self::Solid, Placement), GeomError> {
        let (solid, laid) = along(self.radius.value(), self.length.value(), plain(self.axis), Some(0.0))?;
        Ok((solid, placed(self.center, laid, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        laid_along(self.center, self.axis, self.rotation, self.length)
    }
}
