//! The measures of a segment: three rings with marks, and the bark under its base. [`crate::segment`] explains them.

use crate::vector::{Vec3, vec3};
use serde::{Deserialize, Serialize};

/// A ring with a mark: its middle, its direction, and the direction to its first vertex.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Frame {
    /// Middle of the ring, scene units.
    pub center: Vec3,
    /// Unit direction across the ring, towards the tip.
    pub forward: Vec3,
    /// Unit direction to the first vertex, at right angles to `forward`.
    pub up: Vec3,
    /// Distance of the vertices from the middle.
    pub radius: f64,
}

/// A piece of a parent's cone, on whose bark a branch begins.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Bark {
    /// A point of the axis, where the base begins.
    pub low: Vec3,
    /// The cone's radius there.
    pub low_radius: f64,
    /// A point of the axis, where the base ends.
    pub high: Vec3,
    /// The cone's radius there.
    pub high_radius: f64,
}

/// The three rings, and the bark under the base, in few bytes: a population holds millions.
///
/// ```text
/// start             middle, forward, up, radius       10 numbers
/// split             middle, radius                     4
///                   forward, up                        6, unless they are those of the end: the piece above is straight
/// end               middle, forward, up, radius       10
/// bark              low and its radius, high and its   8, where there is one
/// ```
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(from = "Parts", into = "Parts")]
pub struct Tube(Box<[f64]>);

/// A tube, part by part.
#[derive(Deserialize, PartialEq, Serialize)]
struct Parts {
    frames: [Frame; 3],
    onto: Option<Bark>,
}

impl From<Parts> for Tube {
    fn from(Parts { frames, onto }: Parts) -> Tube {
        Tube::new(frames, onto)
    }
}

impl From<Tube> for Parts {
    fn from(tube: Tube) -> Parts {
        Parts { frames: tube.frames(), onto: tube.onto() }
    }
}

impl PartialEq for Tube {
    fn eq(&self, other: &Tube) -> bool {
        (self.frames(), self.onto()) == (other.frames(), other.onto())
    }
}

/// Numbers of a frame, of two directions, and of a bark.
const FRAME: usize = 10;
const DIRECTIONS: usize = 6;
const BARK: usize = 8;

fn point(n: &[f64]) -> Vec3 {
    vec3(n[0], n[1], n[2])
}

impl Tube {
    /// A tube over the frames `[start, split, end]`, with its base on `onto`, if any.
    pub fn new(frames: [Frame; 3], onto: Option<Bark>) -> Tube {
        let [start, split, end] = frames;
        let directions = |f: &Frame| {
            let ([a, b, c], [d, e, f]) = (f.forward.to_array(), f.up.to_array());
            [a, b, c, d, e, f]
        };
        let bits = |f: &Frame| directions(f).map(f64::to_bits);
        let straight = bits(&split) == bits(&end);
        let mut all = Vec::with_capacity(4 * FRAME);
        let mut push = |numbers: &[f64]| all.extend_from_slice(numbers);
        for (frame, whole) in [(&start, true), (&split, !straight), (&end, true)] {
            push(&frame.center.to_array());
            if whole {
                push(&directions(frame));
            }
            push(&[frame.radius]);
        }
        if let Some(Bark { low, low_radius, high, high_radius }) = onto {
            push(&low.to_array());
            push(&[low_radius]);
            push(&high.to_array());
            push(&[high_radius]);
        }
        Tube(all.into())
    }

    /// Start, split and end.
    pub fn frames(&self) -> [Frame; 3] {
        let whole = |n: &[f64]| Frame {
            center: point(n),
            forward: point(&n[3..]),
            up: point(&n[6..]),
            radius: n[FRAME - 1],
        };
        let (start, rest) = self.0.split_at(FRAME);
        let straight = [FRAME + 4, FRAME + 4 + BARK].contains(&rest.len());
        let (split, rest) = rest.split_at(if straight { FRAME - DIRECTIONS } else { FRAME });
        let end = whole(rest);
        let split = match straight {
            true => Frame { center: point(split), radius: split[3], ..end },
            false => whole(split),
        };
        [whole(start), split, end]
    }

    /// The bark under the base.
    pub fn onto(&self) -> Option<Bark> {
        let at = self.0.len() - BARK;
        let n = &self.0[at..];
        let bark = || Bark { low: point(n), low_radius: n[3], high: point(&n[4..]), high_radius: n[7] };
        self.is_welded().then(bark)
    }

    /// True if its base is on a parent's bark.
    pub fn is_welded(&self) -> bool {
        let bare = 3 * FRAME;
        ![bare, bare - DIRECTIONS].contains(&self.0.len())
    }

    /// Its bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.0[..])
    }
}

impl Frame {
    /// The point of the ring at `turn` (cosine and sine) from the mark, counter-clockwise seen against `forward`.
    pub(crate) fn at(&self, (sin, cos): (f64, f64)) -> Vec3 {
        let side = self.forward.cross(self.up);
        self.center + (self.up * cos + side * sin) * self.radius
    }
}

impl Bark {
    /// Foot of `point` on the axis line and the radius there times `swell`.
    pub(crate) fn below(&self, point: Vec3, swell: f64) -> (Vec3, f64) {
        let along = self.high - self.low;
        let t = (point - self.low).dot(along) / along.dot(along);
        (self.low + along * t, swell * (self.low_radius + (self.high_radius - self.low_radius) * t))
    }

    /// The distance along the unit direction `down` from `point` to the radius times `swell` from its foot.
    ///
    /// The smaller root of `|point + k down - foot| = radius`, with a discriminant of at least zero. The foot does
    /// not move, which is exact for a cylinder and close for a slender cone.
    pub(crate) fn drop(&self, point: Vec3, down: Vec3, swell: f64) -> f64 {
        let (foot, radius) = self.below(point, swell);
        let from = point - foot;
        let half = from.dot(down);
        -half - (half * half - from.dot(from) + radius * radius).max(0.0).sqrt()
    }

    /// The direction from the middle of a base at `center` to the axis.
    pub(crate) fn down(&self, center: Vec3) -> Option<Vec3> {
        ((self.low + self.high) * 0.5 - center).unit()
    }
}
