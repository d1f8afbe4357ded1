//! Boxes, also tapered: `box`.

use super::measured::{Checks, Form, Measured, no_inside};
use super::word::kinds::{Length, Lengths, Letter, Point, Turn};
use super::word::{Either, Word, placed, plain, turned};
use crate::bounds::Aabb;
use crate::convex::{Coarse, Convex, cuboid};
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, boxes};
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};

/// Rounding of boxes whose shape gives none, as a share of the smallest half length.
const BEVEL: f64 = 0.16;

/// A box.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Cuboid {
    /// Full side lengths along x, y and z.
    pub size: Vec3,
}

/// A box whose +z face is scaled about its middle.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct TaperedCuboid {
    /// Full side lengths along x, y and z.
    pub size: Vec3,
    /// Scale of the +z face in x and y.
    pub taper: f64,
}

impl Measured for Cuboid {
    const KIND: &'static str = "box";
    const FORM: Form = Form::Box;

    #[inline]
    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.sizes(self.size)
    }

    #[inline]
    fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
        let convex = Convex::cuboid(self.size, placement);
        // A size that is lost in rounding beside the placement leaves the corners equal.
        if convex.width() <= 0.0 {
            return no_inside(Self::KIND);
        }
        Ok(Aabb::around(convex.corners().iter().copied()))
    }

    fn fine(&self, bevel: Option<f64>) -> FineMesh {
        boxes::rounded(self.size, 1.0, bevel.unwrap_or(BEVEL))
    }
}

impl Measured for TaperedCuboid {
    const KIND: &'static str = "tapered-box";

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.sizes(self.size)?;
        checks.not_negative("taper", self.taper)
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let vertices = cuboid(self.size, self.taper, placement).to_vec();
        let hull = if self.taper > 0.0 {
            Hull::new(vertices, Topology::shared_cuboid())
        } else {
            Hull::around(vertices)
        };
        hull.map(Coarse::new)
    }

    fn fine(&self, bevel: Option<f64>) -> FineMesh {
        boxes::rounded(self.size, self.taper, bevel.unwrap_or(BEVEL))
    }
}

/// A box whose face at the + end of coordinate `axis` is scaled by `taper`, and how it is laid: the solid tapers along its
/// own z.
pub(super) fn tapered(
    size: Vec3,
    taper: f64,
    axis: usize,
) -> Result<(Either<Cuboid, TaperedCuboid>, Mat3), GeomError> {
    if axis > 2 {
        return bad(format!("the taper axis is {axis}, expected 0, 1 or 2"));
    }
    if taper == 1.0 {
        return Ok((Either::Plain(Cuboid { size }), Mat3::IDENTITY));
    }
    let size = match axis {
        0 => vec3(size.z, size.y, size.x),
        1 => vec3(size.x, size.z, size.y),
        _ => size,
    };
    let laid = Mat3::between(Vec3::AXES[2], Vec3::AXES[axis]);
    Ok((Either::Other(TaperedCuboid { size, taper }), laid))
}

word! {
    /// A box.
    "box" BoxWord {
        /// Its middle.
        center: Point,
        /// Its three side lengths, greater than 0.
        size: Lengths,
        /// Turns it about its middle.
        rotation: Option<Turn>,
        /// How much the end towards `taper_axis` is scaled; 1 for a plain box.
        taper: Length = 1.0,
        /// "x", "y" or "z".
        taper_axis: Letter = "z",
        ..BEVELLED
    }
}

impl<S: Scalar> Word<S> for BoxWord<S> {
    type Solid = Either<Cuboid, TaperedCuboid>;

    #[inline]
    fn solid(&self) -> Result<(Self::Solid, Placement), GeomError> {
        let (solid, laid) = tapered(plain(self.size), self.taper.value(), self.taper_axis)?;
        Ok((solid, placed(self.center, laid, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        turned(self.center, self.rotation, self.size)
    }
}
