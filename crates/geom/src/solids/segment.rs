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
use crate::tube::{Bark, Frame, Tube};
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

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let mut corners = segment::corners(self)?;
        // A segment lies at the coordinates of its frames, unless it was put into another frame.
        if *placement != Placement::IDENTITY {
            corners.iter_mut().for_each(|p| *p = placement.apply(*p));
        }
        let whole = Hull::nearly(corners, segment::tube())?;
        Some(Coarse::of_segment(whole, self.is_welded()))
    }

    /// A frame in the middle of the first ring; y forward and z up.
    fn frame(&self, placement: &Placement) -> Placement {
        let [Frame { center, forward, up, .. }, ..] = self.frames();
        let rotation = Mat3 { columns: [forward.cross(up), forward, up] };
        placement.after(&Placement { rotation, translation: center })
    }

    fn mirrored(&self) -> Tube {
        let mirrored = |frame: Frame| Frame {
            center: frame.center.mirrored(),
            forward: frame.forward.mirrored(),
            up: frame.up.mirrored(),
            ..frame
        };
        let onto =
            self.onto().map(|bark| Bark { low: bark.low.mirrored(), high: bark.high.mirrored(), ..bark });
        Tube::new(self.frames().map(mirrored), onto)
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

#[cfg(test)]
mod tests {
    use super::super::shape::Shape;
    use super::*;
    use crate::look::Look;
    use crate::vector::vec3;

    /// A segment in a frame is where its corners are, also reflected.
    #[test]
    fn frames_move_segments() {
        let frame = |y: f64, radius: f64| Frame {
            center: vec3(0.1, y, 0.0),
            forward: vec3(0.0, 1.0, 0.0),
            up: vec3(0.6, 0.0, 0.8),
            radius,
        };
        let bark =
            Bark { low: vec3(-2.0, 0.2, 0.0), low_radius: 1.9, high: vec3(3.0, 0.2, 0.0), high_radius: 1.8 };
        let frames = [frame(2.0, 0.5), frame(2.3, 0.45), frame(5.0, 0.4)];
        for onto in [None, Some(bark)] {
            let shape = Shape::segment(frames, onto, &Look::default()).unwrap();
            for sign in [1.0, -1.0] {
                let mut rotation = Mat3::rotation(vec3(0.6, 0.0, 0.8), 0.9);
                rotation.columns[2] = rotation.columns[2] * sign;
                let place = Placement { rotation, translation: vec3(1.0, 2.0, 3.0) };
                let moved = shape.in_frame(&place).unwrap();
                let (points, there) = (shape.world_mesh(), moved.world_mesh());
                let near = |p: Vec3| there.vertices().iter().any(|q| (*q - place.apply(p)).norm() < 1e-9);
                assert!(points.vertices().iter().all(|p| near(*p)), "{sign} {onto:?}");
                let fine = moved.fine_mesh().vertices;
                let is_drawn_there = |p: &Vec3| fine.iter().any(|q| (*q - place.apply(*p)).norm() < 1e-9);
                assert!(shape.fine_mesh().vertices.iter().step_by(37).all(is_drawn_there), "{sign} {onto:?}");
                assert!(there.open_edges() == 0 && moved.frame().rotation.defect() < 1e-9);
            }
        }
    }
}
