//! Points, directions and rotations of three dimensions: the small value types that shapes are made of.
//!
//! Right-handed, y up, `f64`, scene units; angles in radians. Shapes are in another crate.

use serde::{Deserialize, Serialize};
use std::ops::{Add, Div, Index, Mul, Neg, Sub};

/// A point or a direction.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Vec3 {
    /// Sideways.
    pub x: f64,
    /// Up.
    pub y: f64,
    /// Towards the viewer.
    pub z: f64,
}

/// The vector `(x, y, z)`.
#[inline]
pub const fn vec3(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}

impl Vec3 {
    /// The origin.
    pub const ZERO: Vec3 = vec3(0.0, 0.0, 0.0);
    /// The three coordinate directions.
    pub const AXES: [Vec3; 3] = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];

    /// Scalar product.
    #[inline]
    pub fn dot(self, other: Vec3) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product: x cross y is z.
    #[inline]
    pub fn cross(self, other: Vec3) -> Vec3 {
        vec3(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Length.
    #[inline]
    pub fn norm(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The direction, with length one; `None` for zero and for entries that are not finite.
    pub fn unit(self) -> Option<Vec3> {
        // The largest entry is divided out first: squares of 1e200 overflow, squares of 1e-200 vanish.
        let size = self.x.abs().max(self.y.abs()).max(self.z.abs());
        if size == 0.0 || !self.is_finite() {
            return None;
        }
        let near_one = self / size;
        Some(near_one / near_one.norm())
    }

    /// The smaller of each pair of entries.
    #[inline]
    pub fn min(self, other: Vec3) -> Vec3 {
        vec3(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    /// The larger of each pair of entries.
    #[inline]
    pub fn max(self, other: Vec3) -> Vec3 {
        vec3(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }

    /// True when all three entries are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The entries as an array.
    #[inline]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// The vector reflected at the plane x = 0.
    #[inline]
    pub fn mirrored(self) -> Vec3 {
        // Not `-x`, which is -0.0 for zero.
        vec3(0.0 - self.x, self.y, self.z)
    }

    /// The vector turned about the unit vector `axis` by `angle`, by the right-hand rule (Rodrigues' formula).
    pub fn rotated(self, axis: Vec3, angle: f64) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        self * cos + axis.cross(self) * sin + axis * (axis.dot(self) * (1.0 - cos))
    }

    /// A unit vector at right angles to this vector, which must not be zero.
    pub fn any_perpendicular(self) -> Vec3 {
        // The coordinate direction least along the vector gives the longest cross product.
        let [x, y, z] = [self.x.abs(), self.y.abs(), self.z.abs()];
        let other = if x <= y && x <= z {
            0
        } else if y <= z {
            1
        } else {
            2
        };
        self.cross(Vec3::AXES[other]).unit().unwrap_or(Vec3::AXES[other])
    }
}

impl From<[f64; 3]> for Vec3 {
    #[inline]
    fn from([x, y, z]: [f64; 3]) -> Vec3 {
        vec3(x, y, z)
    }
}

impl From<Vec3> for [f64; 3] {
    #[inline]
    fn from(v: Vec3) -> [f64; 3] {
        v.to_array()
    }
}

/// Entry 0, 1 or 2 (x, y or z).
impl Index<usize> for Vec3 {
    type Output = f64;
    #[inline]
    fn index(&self, axis: usize) -> &f64 {
        match axis {
            0 => &self.x,
            1 => &self.y,
            2 => &self.z,
            _ => panic!("entry {axis} of a vector of three"),
        }
    }
}

impl Add for Vec3 {
    type Output = Vec3;
    #[inline]
    fn add(self, o: Vec3) -> Vec3 {
        vec3(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl Sub for Vec3 {
    type Output = Vec3;
    #[inline]
    fn sub(self, o: Vec3) -> Vec3 {
        vec3(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl Neg for Vec3 {
    type Output = Vec3;
    #[inline]
    fn neg(self) -> Vec3 {
        vec3(-self.x, -self.y, -self.z)
    }
}

impl Mul<f64> for Vec3 {
    type Output = Vec3;
    #[inline]
    fn mul(self, by: f64) -> Vec3 {
        vec3(self.x * by, self.y * by, self.z * by)
    }
}

impl Div<f64> for Vec3 {
    type Output = Vec3;
    #[inline]
    fn div(self, by: f64) -> Vec3 {
        vec3(self.x / by, self.y / by, self.z / by)
    }
}

/// A 3 by 3 matrix, as its columns: the images of the x, y and z directions.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Mat3 {
    /// Images of the coordinate directions.
    pub columns: [Vec3; 3],
}

impl Mat3 {
    /// The rotation that changes nothing.
    pub const IDENTITY: Mat3 = Mat3 { columns: Vec3::AXES };

    /// A matrix from its rows.
    pub fn from_rows(rows: [[f64; 3]; 3]) -> Mat3 {
        Mat3 { columns: [0, 1, 2].map(|j| vec3(rows[0][j], rows[1][j], rows[2][j])) }
    }

    /// The rows.
    pub fn rows(&self) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|i| self.columns.map(|c| c[i]))
    }

    /// The turn about the unit vector `axis` by `angle`, by the right-hand rule.
    pub fn rotation(axis: Vec3, angle: f64) -> Mat3 {
        Mat3 { columns: Vec3::AXES.map(|v| v.rotated(axis, angle)) }
    }

    /// The smallest turn that takes the unit vector `from` to the unit vector `to`.
    ///
    /// With `c = from x to` and `k = 1 / (1 + from . to)` it is `v + c x v + k c x (c x v)`; exact (entries
    /// 0, 1, -1) between coordinate directions. To the opposite direction, where the smallest turn is not
    /// unique, it is the half turn about some direction at right angles.
    ///
    /// ```
    /// use niwaki_math::{Mat3, vec3};
    /// let laid_along_z = Mat3::between(vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    /// assert_eq!(laid_along_z.apply(vec3(0.0, 0.0, 1.0)), vec3(0.0, -1.0, 0.0));
    /// ```
    pub fn between(from: Vec3, to: Vec3) -> Mat3 {
        if from.dot(to) > -0.5 {
            return Mat3::between_near(from, to);
        }
        // Near the opposite direction `k` explodes: turn by half about the same axis first, then turn back by the excess.
        // Only for the exact opposite may the axis be any.
        let axis = from.cross(to).unit().unwrap_or_else(|| from.any_perpendicular());
        let half_turn = Mat3 { columns: Vec3::AXES.map(|v| axis * (2.0 * axis.dot(v)) - v) };
        Mat3::between_near(-from, to).after(&half_turn)
    }

    fn between_near(from: Vec3, to: Vec3) -> Mat3 {
        let c = from.cross(to);
        let k = 1.0 / (1.0 + from.dot(to));
        Mat3 { columns: Vec3::AXES.map(|v| v + c.cross(v) + c.cross(c.cross(v)) * k) }
    }

    /// The image of `v`.
    #[inline]
    pub fn apply(&self, v: Vec3) -> Vec3 {
        self.columns[0] * v.x + self.columns[1] * v.y + self.columns[2] * v.z
    }

    /// The product of `other` first, then this matrix.
    pub fn after(&self, other: &Mat3) -> Mat3 {
        Mat3 { columns: other.columns.map(|c| self.apply(c)) }
    }

    /// The transpose: for a rotation, its inverse.
    pub fn transpose(&self) -> Mat3 {
        Mat3::from_rows(self.columns.map(Vec3::to_array))
    }

    /// The largest deviation from a rotation (orthonormal columns, right-handed); NaN stays NaN.
    pub fn defect(&self) -> f64 {
        let [a, b, c] = self.columns;
        let deviations = [
            a.dot(a) - 1.0,
            b.dot(b) - 1.0,
            c.dot(c) - 1.0,
            a.dot(b),
            b.dot(c),
            c.dot(a),
            a.cross(b).dot(c) - 1.0,
        ];
        // `f64::max` would drop a NaN.
        deviations.into_iter().fold(0.0, |worst, d| if d.abs() <= worst { worst } else { d.abs() })
    }
}

#[cfg(test)]
mod tests {
    //! Rotations are orthonormal, turn by the right-hand rule, and are the smallest rotations to their goals.
    use super::*;

    #[test]
    fn between_is_the_smallest_rotation_to_its_goal() {
        let directions = [
            vec3(1.0, 2.0, -0.5),
            vec3(0.0, -1.0, 0.0),
            vec3(0.0, 1.0, 0.0),
            vec3(1e-9, -1.0, 0.0),
            vec3(1e-5, -1.0, 2e-5),
            vec3(0.0, 0.0, -3.0),
            vec3(-1.0, -2.0, 0.5),
        ];
        for from in directions {
            for to in directions {
                let (from, to) = (from.unit().unwrap(), to.unit().unwrap());
                let m = Mat3::between(from, to);
                assert!(m.defect() < 1e-9, "{from:?} {to:?} {}", m.defect());
                assert!((m.apply(from) - to).norm() < 1e-9, "{from:?} {to:?}");
                // A rotation's trace is 1 + 2 cos(angle); the smallest angle is that between the two directions.
                let trace = m.columns[0].x + m.columns[1].y + m.columns[2].z;
                assert!((trace - 1.0 - 2.0 * from.dot(to)).abs() < 1e-9, "{from:?} {to:?}");
            }
        }
    }

    #[test]
    fn between_coordinate_directions_is_exact() {
        for from in Vec3::AXES {
            for to in [Vec3::AXES, Vec3::AXES.map(|v| -v)].concat() {
                let m = Mat3::between(from, to);
                assert!((m.apply(from), m.defect()) == (to, 0.0), "{from:?} {to:?} {m:?}");
            }
        }
    }

    #[test]
    fn a_quarter_turn_about_y_takes_z_to_x() {
        let m = Mat3::rotation(Vec3::AXES[1], std::f64::consts::FRAC_PI_2);
        assert!((m.apply(Vec3::AXES[2]) - Vec3::AXES[0]).norm() < 1e-15);
        assert!(m.after(&m.transpose()).defect() < 1e-15);
    }

    #[test]
    fn units_of_huge_tiny_and_missing_directions() {
        assert_eq!(vec3(0.0, 1e300, 0.0).unit(), Some(Vec3::AXES[1]));
        assert_eq!(vec3(0.0, 0.0, 1e-300).unit(), Some(Vec3::AXES[2]));
        assert_eq!(Vec3::ZERO.unit(), None);
        assert_eq!(vec3(f64::NAN, 1.0, 0.0).unit(), None);
    }
}
