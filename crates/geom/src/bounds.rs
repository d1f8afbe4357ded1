//! Boxes along the axes: the first test of every spatial query.

use crate::vector::{Vec3, vec3};

/// The distance from the origin from which a box is far, in its longest sides: 32 bits have 170,000 steps of it there.
pub const FAR: f64 = 100.0;

/// A closed box along the axes. The empty box has `low` above `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub low: Vec3,
    /// Largest coordinates.
    pub high: Vec3,
}

impl Aabb {
    /// The empty box.
    pub const EMPTY: Aabb = Aabb {
        low: vec3(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: vec3(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest box around `points`.
    #[inline]
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Aabb {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        // Like `f64::min`, but in an instruction: the bounds are never without a value.
        for p in points.into_iter().map(Vec3::to_array) {
            low = std::array::from_fn(|a| if p[a] < low[a] { p[a] } else { low[a] });
            high = std::array::from_fn(|a| if p[a] > high[a] { p[a] } else { high[a] });
        }
        Aabb { low: low.into(), high: high.into() }
    }

    /// The smallest box around two boxes.
    #[inline]
    pub fn union(&self, other: &Aabb) -> Aabb {
        Aabb { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// True when the closed boxes share a point.
    #[inline]
    pub fn meets(&self, other: &Aabb) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
            && self.low.z <= other.high.z
            && other.low.z <= self.high.z
    }

    /// True when `other` lies inside, border included.
    pub fn contains(&self, other: &Aabb) -> bool {
        self.union(other) == *self
    }

    /// The box moved outwards by `by` on all six sides.
    pub fn grown(&self, by: f64) -> Aabb {
        let by = vec3(by, by, by);
        Aabb { low: self.low - by, high: self.high + by }
    }

    /// Lengths of the sides (negative infinity when empty).
    #[inline]
    pub fn extent(&self) -> Vec3 {
        self.high - self.low
    }

    /// The middle.
    pub fn center(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    /// True for a box that is [`FAR`] from the origin.
    pub fn is_far(&self) -> bool {
        let most = |v: Vec3| v.x.max(v.y).max(v.z);
        let longest = most(self.extent());
        longest > 0.0 && most(self.high.max(self.low * -1.0)) / longest > FAR
    }

    /// True when there is no point inside.
    pub fn is_empty(&self) -> bool {
        self.low.x > self.high.x
    }

    /// Half the surface: a tree of boxes minimises it.
    #[inline]
    pub fn half_area(&self) -> f64 {
        let e = self.extent();
        e.x * e.y + e.y * e.z + e.z * e.x
    }
}
