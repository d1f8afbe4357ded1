//! Segments of a tree, over three frames: `segment`. [`crate::segment`] explains them.

use super::measured::{Checks, Measured, Tone};
use super::word::kinds::{Barked, Framed};
use super::word::{Word, between};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, segment as tubes};
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::segment;
use crate::tube::{Frame, Tube};
use crate::vector::{Mat3, Vec3};
use niwaki_math::Scalar;

impl Measured for Tube {
    const KIND: &'static str = "segment";
    const TONE: Tone = Tone::Bark;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        for frame in &self.frames() {
            checks.positive("radius", frame.radius)?;
            checks.finite("centre of a segment's frame", frame.center)?;
            checks.unit("forward direction of a segment's frame", frame.forward)?;
            checks.unit("up direction of a segment's frame", frame.up)?;
            let slant = frame.forward.dot(frame.up).abs();
            if slant.is_nan() || slant > 1e-6 {
                let [forward, up] = [frame.forward, frame.up].map(Vec3::to_array);
                return bad(format!(
                    "the directions of a segment's frame are {forward:?} and {up:?}, expected a right angle between them"
                ));
            }
        }
        self.onto().map_or(Ok(()), |bark| {
            checks.positive("parent's radius", bark.low_radius)?;
            checks.positive("parent's radius", bark.high_radius)
        })
    }

    fn bytes(&self) -> usize {
        Tube::bytes(self)
    }

    /// The hull at the coordinates of the frames; it ignores the placement.
    fn hull(&self, _placement: &Placement) -> Option<Coarse> {
        let whole = Hull::nearly(segment::corners(self)?, segment::tube())?;
        Some(Coarse::of_segment(whole, self.is_welded()))
    }

    /// A frame in the middle of the first ring; y forward and z up.
    fn frame(&self, placement: &Placement) -> Placement {
        let [Frame { center, forward, up, .. }, ..] = self.frames();
        let rotation = Mat3 { columns: [forward.cross(up), forward, up] };
        placement.after(&Placement { rotation, translation: center })
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        tubes::grown(&self.frames(), self.onto().as_ref())
    }
}

word! {
    /// A bent, tapering segment of a tree: a wedge from `start` to `split`, a clean cone from there to `end`.
    ///
    /// A segment that starts with the frame in which another ends only touches it. A branch starts on its parent's bark
    /// and names it: its base is laid onto the cone, and drawn as grown out of it.
    "segment" SegmentWord {
        /// Frames `(center, forward, up, radius)`: the two directions are unit vectors at right angles.
        start: Framed,
        /// Frames `(center, forward, up, radius)`: the two directions are unit vectors at right angles.
        split: Framed,
        /// Frames `(center, forward, up, radius)`: the two directions are unit vectors at right angles.
        end: Framed,
        /// What the base lies on, `(low, low_radius, high, high_radius)`.
        onto: Option<Barked>,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for SegmentWord<S> {
    type Solid = Tube;

    fn solid(&self) -> Result<(Tube, Placement), GeomError> {
        Ok((Tube::new([self.start.1, self.split.1, self.end.1], self.onto), Placement::IDENTITY))
    }

    fn at(&self) -> [[S; 3]; 4] {
        between(self.start.0, self.end.0)
    }
}
