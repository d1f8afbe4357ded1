//! Limbs: bent, tapered segments between two rings: `limb`.

use super::measured::{Checks, Measured, Tone};
use super::word::kinds::{Length, Point};
use super::word::{Word, between, direction, plain};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, limb};
use crate::limb::band;
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::ring::Ring;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Default number of sides.
const SIDES: usize = 10;

/// Convex hull of two rings, at their coordinates. Limbs that share a ring only touch, as long as each lies on its own side of
/// the ring's plane.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Limb {
    /// The rings at the start and the end.
    pub rings: Box<[Ring; 2]>,
    /// The number of sides of both rings.
    pub sides: usize,
}

impl Measured for Limb {
    const KIND: &'static str = "limb";
    const TONE: Tone = Tone::Bark;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        for ring in self.rings.iter() {
            checks.positive("radius", ring.radius)?;
            checks.finite("centre of an end of a limb", ring.center)?;
            checks.unit("normal of an end of a limb", ring.normal)?;
        }
        checks.sides(self.sides)
    }

    fn bytes(&self) -> usize {
        size_of::<[Ring; 2]>()
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let points = self.rings.iter().flat_map(|ring| ring.vertices(self.sides));
        let vertices: Vec<Vec3> = points.map(|p| placement.apply(p)).collect();
        let hull = match band(&vertices, self.sides) {
            Some(topology) => Hull::new(vertices, Arc::new(topology)),
            // The rings cut each other's plane.
            None => Hull::around(vertices),
        };
        hull.map(Coarse::new)
    }

    /// A frame in the middle of the first ring; y along its direction, by the shortest turn (Moller and Hughes 1999).
    fn frame(&self, placement: &Placement) -> Placement {
        let Ring { center, normal, .. } = self.rings[0];
        let [x, y, z] = normal.to_array();
        let columns = if y < -1.0 + 1e-12 {
            // A half turn, about x.
            [vec3(1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, -1.0)]
        } else {
            let h = 1.0 / (1.0 + y);
            [vec3(1.0 - h * x * x, -x, -h * x * z), normal, vec3(-h * x * z, -z, 1.0 - h * z * z)]
        };
        placement.after(&Placement { rotation: Mat3 { columns }, translation: center })
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        limb::domed(&self.rings[0], &self.rings[1])
    }
}

/// A limb between two round ends; a normal left out is the direction from start to end.
pub(super) fn bent(
    start: Vec3,
    end: Vec3,
    radii: (f64, f64),
    normals: (Option<Vec3>, Option<Vec3>),
) -> Result<Limb, GeomError> {
    for (end_name, p) in [("start", start), ("end", end)] {
        if !p.is_finite() {
            return bad(format!("the {end_name} of a limb is {:?}, expected finite numbers", p.to_array()));
        }
    }
    let message = || format!("the start and the end of a limb are the same point, {:?}", start.to_array());
    let along = || (end - start).unit().ok_or_else(|| GeomError::new("bad-shape", message()));
    let normal = |normal: Option<Vec3>, name| normal.map_or_else(along, |normal| direction(normal, name));
    let start = Ring { center: start, normal: normal(normals.0, "start normal")?, radius: radii.0 };
    let end = Ring { center: end, normal: normal(normals.1, "end normal")?, radius: radii.1 };
    Ok(Limb { rings: Box::new([start, end]), sides: SIDES })
}

word! {
    /// A tapering, bending segment between two rings; limbs that share a ring only touch.
    "limb" LimbWord {
        /// Centres of the rings.
        start: Point,
        /// Centres of the rings.
        end: Point,
        /// Their radii, greater than 0.
        start_radius: Length,
        /// Their radii, greater than 0.
        end_radius: Length,
        /// Their directions; from `start` to `end` when left out.
        start_normal: Option<Point>,
        /// Their directions; from `start` to `end` when left out.
        end_normal: Option<Point>,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for LimbWord<S> {
    type Solid = Limb;

    fn solid(&self) -> Result<(Limb, Placement), GeomError> {
        let radii = (self.start_radius.value(), self.end_radius.value());
        let normals = (self.start_normal.map(plain), self.end_normal.map(plain));
        Ok((bent(plain(self.start), plain(self.end), radii, normals)?, Placement::IDENTITY))
    }

    fn at(&self) -> [[S; 3]; 4] {
        between(self.start, self.end)
    }
}
