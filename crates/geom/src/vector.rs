//! Points, directions and rotations of three dimensions: the few operations that shapes need.
//!
//! Everything is `f64`, right-handed, in scene units.

use std::ops::{Add, Index, Mul, Neg, Sub};

/// A point or a direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3 {
    /// Sideways.
    pub x: f64,
    /// Up.
    pub y: f64,
    /// Towards the viewer.
    pub z: f64,
}

/// The vector `(x, y, z)`.
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

    /// Vector product, right-handed.
    #[inline]
    pub fn cross(self, other: Vec3) -> Vec3 {
        vec3(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Euclidean length.
    #[inline]
    pub fn norm(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The same direction with length one, or `None` when there is no direction to keep.
    pub fn unit(self) -> Option<Vec3> {
        let largest = self.x.abs().max(self.y.abs()).max(self.z.abs());
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        // Dividing by the largest entry first keeps squares from overflowing or vanishing.
        let scaled = self * (1.0 / largest);
        let unit = scaled * (1.0 / scaled.norm());
        unit.is_finite().then_some(unit)
    }

    /// Smaller entry of each coordinate.
    #[inline]
    pub fn min(self, other: Vec3) -> Vec3 {
        vec3(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    /// Larger entry of each coordinate.
    #[inline]
    pub fn max(self, other: Vec3) -> Vec3 {
        vec3(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }

    /// True when no entry is infinite or not a number.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The three entries.
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Entry by entry product.
    #[inline]
    pub fn scale(self, by: Vec3) -> Vec3 {
        vec3(self.x * by.x, self.y * by.y, self.z * by.z)
    }
}

impl From<[f64; 3]> for Vec3 {
    fn from(v: [f64; 3]) -> Vec3 {
        vec3(v[0], v[1], v[2])
    }
}

impl Index<usize> for Vec3 {
    type Output = f64;
    #[inline]
    fn index(&self, axis: usize) -> &f64 {
        match axis {
            0 => &self.x,
            1 => &self.y,
            _ => &self.z,
        }
    }
}

impl Add for Vec3 {
    type Output = Vec3;
    #[inline]
    fn add(self, other: Vec3) -> Vec3 {
        vec3(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Vec3 {
    type Output = Vec3;
    #[inline]
    fn sub(self, other: Vec3) -> Vec3 {
        vec3(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<f64> for Vec3 {
    type Output = Vec3;
    #[inline]
    fn mul(self, by: f64) -> Vec3 {
        vec3(self.x * by, self.y * by, self.z * by)
    }
}

impl Neg for Vec3 {
    type Output = Vec3;
    #[inline]
    fn neg(self) -> Vec3 {
        vec3(-self.x, -self.y, -self.z)
    }
}

/// A 3 by 3 matrix, kept as its three columns: the images of the coordinate directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat3 {
    /// Images of x, y and z.
    pub columns: [Vec3; 3],
}

impl Mat3 {
    /// The matrix that changes nothing.
    pub const IDENTITY: Mat3 = Mat3 { columns: Vec3::AXES };

    /// From rows, as a person writes a matrix down.
    pub fn from_rows(rows: [[f64; 3]; 3]) -> Mat3 {
        Mat3 { columns: std::array::from_fn(|c| vec3(rows[0][c], rows[1][c], rows[2][c])) }
    }

    /// The rows.
    pub fn rows(&self) -> [[f64; 3]; 3] {
        std::array::from_fn(|r| std::array::from_fn(|c| self.columns[c][r]))
    }

    /// Image of `v`.
    #[inline]
    pub fn apply(&self, v: Vec3) -> Vec3 {
        self.columns[0] * v.x + self.columns[1] * v.y + self.columns[2] * v.z
    }

    /// First `other`, then `self`.
    pub fn after(&self, other: &Mat3) -> Mat3 {
        Mat3 { columns: other.columns.map(|c| self.apply(c)) }
    }

    /// Right-handed turn about `axis` (unit) by `angle` radians (Rodrigues' formula).
    pub fn rotation(axis: Vec3, angle: f64) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        Mat3 { columns: Vec3::AXES.map(|v| turn(v, axis, sin, cos)) }
    }

    /// The smallest turn that takes the coordinate direction `from` (0, 1 or 2) to the unit vector `to`.
    ///
    /// Exact (entries 0, 1 and -1) when `to` is a coordinate direction. For the opposite direction, where
    /// the smallest turn is not unique, the half turn about the next axis is taken.
    pub fn between(from: usize, to: Vec3) -> Mat3 {
        let start = Vec3::AXES[from];
        let (cos, axis) = (start.dot(to), start.cross(to));
        let sin = axis.norm();
        if sin < 1e-15 {
            let mut columns = Vec3::AXES;
            if cos < 0.0 {
                columns[from] = -columns[from];
                columns[(from + 2) % 3] = -columns[(from + 2) % 3];
            }
            return Mat3 { columns };
        }
        let axis = axis * (1.0 / sin);
        Mat3 { columns: Vec3::AXES.map(|v| turn(v, axis, sin, cos)) }
    }

    /// Largest deviation of the columns from being orthonormal and right-handed.
    pub fn defect(&self) -> f64 {
        let [a, b, c] = self.columns;
        let lengths = [a.dot(a) - 1.0, b.dot(b) - 1.0, c.dot(c) - 1.0];
        let angles = [a.dot(b), b.dot(c), c.dot(a)];
        let handed = a.cross(b).dot(c) - 1.0;
        let mut worst = handed.abs();
        for term in lengths.into_iter().chain(angles) {
            // A plain `max` would drop NaN.
            worst = if term.abs() > worst || term.is_nan() { term.abs() } else { worst };
        }
        worst
    }

    /// True when every column is a coordinate direction or its opposite, exactly.
    pub fn is_axis_aligned(&self) -> bool {
        self.columns.iter().all(|c| {
            let zeros = [c.x, c.y, c.z].iter().filter(|e| **e == 0.0).count();
            zeros == 2 && (c.x + c.y + c.z).abs() == 1.0
        })
    }
}

fn turn(v: Vec3, axis: Vec3, sin: f64, cos: f64) -> Vec3 {
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos))
}

#[cfg(test)]
mod tests {
    //! Rotations are rotations, and turning to a coordinate direction is exact.
    use super::*;

    #[test]
    fn a_cylinder_laid_along_z_takes_y_to_z_and_z_to_minus_y() {
        let m = Mat3::between(1, vec3(0.0, 0.0, 1.0));
        assert_eq!(m.apply(vec3(0.0, 1.0, 0.0)), vec3(0.0, 0.0, 1.0));
        assert_eq!(m.apply(vec3(0.0, 0.0, 1.0)), vec3(0.0, -1.0, 0.0));
        assert!(m.is_axis_aligned());
    }

    #[test]
    fn smallest_turns_are_rotations_to_their_goal() {
        for to in [vec3(1.0, 2.0, -0.5), vec3(0.0, -1.0, 0.0), vec3(1e-9, -1.0, 0.0), vec3(0.0, 0.0, -3.0)] {
            let to = to.unit().unwrap();
            for from in 0..3 {
                let m = Mat3::between(from, to);
                assert!(m.defect() < 1e-12, "{from} {to:?} {}", m.defect());
                assert!((m.columns[from] - to).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn a_quarter_turn_about_y_takes_z_to_x() {
        let m = Mat3::rotation(vec3(0.0, 1.0, 0.0), std::f64::consts::FRAC_PI_2);
        assert!((m.apply(vec3(0.0, 0.0, 1.0)) - vec3(1.0, 0.0, 0.0)).norm() < 1e-15);
    }
}
