//! Strokes, which are flat: `stroke`.

use super::measured::{Checks, Form, Measured};
use super::plate::{self, Flat, arc};
use super::word::kinds::{Length, Point};
use super::word::{Word, between, plain};
use crate::bounds::Aabb;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::FineMesh;
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A round end of a stroke.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Round {
    /// The middle, scene units.
    pub center: Vec3,
    /// The radius, greater than zero.
    pub radius: f64,
}

/// The convex hull of two circles on one plane parallel to z = 0: straight, with round ends.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Stroke {
    /// Start and end.
    pub ends: Box<[Round; 2]>,
}

impl Stroke {
    /// A stroke from one width to another.
    pub(super) fn new(start: Vec3, end: Vec3, widths: (f64, f64)) -> Stroke {
        let round = |center, width| Round { center, radius: 0.5 * width };
        Stroke { ends: Box::new([round(start, widths.0), round(end, widths.1)]) }
    }
}

impl Flat for Stroke {
    fn half_width(&self) -> f64 {
        self.ends[0].radius.min(self.ends[1].radius)
    }

    fn reach(&self, placement: &Placement) -> Aabb {
        self.ends.iter().fold(Aabb::EMPTY, |boxed, end| {
            let (center, reach) = (placement.apply(end.center), vec3(end.radius, end.radius, 0.0));
            boxed.union(&Aabb { low: center - reach, high: center + reach })
        })
    }

    fn corners(&self, sides: usize) -> Vec<Vec3> {
        let [a, b] = *self.ends;
        let along = b.center - a.center;
        let length = along.norm();
        if length <= (a.radius - b.radius).abs() {
            let large = if a.radius > b.radius { a } else { b };
            return arc(large.center, large.radius, 0.0, TAU, sides);
        }
        // The straight sides touch both circles where their normals have this angle to the stroke.
        let (ahead, open) = (along.y.atan2(along.x), ((a.radius - b.radius) / length).acos());
        let mut all = arc(b.center, b.radius, ahead - open, 2.0 * open, sides / 2);
        all.extend(arc(a.center, a.radius, ahead + open, TAU - 2.0 * open, sides / 2));
        all
    }
}

impl Measured for Stroke {
    const KIND: &'static str = "stroke";
    const FORM: Form = Form::Flat;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        self.ends.iter().try_for_each(|end| {
            checks.positive("radius", end.radius)?;
            checks.finite("end of a stroke", end.center)
        })
    }

    fn bytes(&self) -> usize {
        size_of::<[Round; 2]>()
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        plate::coarse(self, placement)
    }

    fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
        let boxed = plate::aabb(self, placement)?;
        let [start, end] = [self.ends[0].center.z, self.ends[1].center.z];
        if start != end {
            return bad(format!(
                "the ends of a stroke are at z = {start} and {end}, expected the same: it lies on one plane"
            ));
        }
        Ok(boxed)
    }

    /// A frame at the start; x towards the end, by a turn about z.
    fn frame(&self, placement: &Placement) -> Placement {
        let [start, end] = self.ends.each_ref().map(|end| end.center);
        let along = end - start;
        // Two steps, because files keep all digits of a turn, and the first may vanish for a tiny stroke.
        let near = match along.y.mul_add(along.y, along.x * along.x).sqrt() {
            0.0 => along,
            length => along / length,
        };
        let length = near.x.hypot(near.y);
        let (x, y) = if length > 0.0 { (near.x / length, near.y / length) } else { (1.0, 0.0) };
        let rotation = Mat3 { columns: [vec3(x, y, 0.0), vec3(-y, x, 0.0), vec3(0.0, 0.0, 1.0)] };
        placement.after(&Placement { rotation, translation: start })
    }

    fn mirrored(&self) -> Stroke {
        let mirrored = |end: &Round| Round { center: end.center.mirrored(), ..*end };
        Stroke { ends: Box::new(self.ends.each_ref().map(mirrored)) }
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        plate::fine(self)
    }
}

word! {
    /// A straight stroke with round ends. Flat: z says only what lies in front of what.
    "stroke" StrokeWord {
        /// The middles of its ends, with the same z.
        start: Point,
        /// The middles of its ends, with the same z.
        end: Point,
        /// Width of the start, greater than 0.
        width: Length,
        /// Width of the end; `width` when left out.
        end_width: Option<Length>,
        ..COLORED
    }
}

impl<S: Scalar> Word<S> for StrokeWord<S> {
    type Solid = Stroke;

    fn solid(&self) -> Result<(Stroke, Placement), GeomError> {
        let widths = (self.width.value(), self.end_width.unwrap_or(self.width).value());
        Ok((Stroke::new(plain(self.start), plain(self.end), widths), Placement::IDENTITY))
    }

    fn at(&self) -> [[S; 3]; 4] {
        between(self.start, self.end)
    }
}
