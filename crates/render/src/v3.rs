//! Single-precision vectors for rays.
//!
//! A picture needs seven digits and twice the speed; everything that is *scored* stays in `f64`.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Three `f32`: a point, a direction or a linear colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct V3 {
    /// First component.
    pub x: f32,
    /// Second component; up, for points.
    pub y: f32,
    /// Third component.
    pub z: f32,
}

/// The vector `(x, y, z)`.
pub const fn v3(x: f32, y: f32, z: f32) -> V3 {
    V3 { x, y, z }
}

impl V3 {
    /// The zero vector.
    pub const ZERO: V3 = v3(0.0, 0.0, 0.0);

    /// All three components equal.
    pub const fn splat(s: f32) -> V3 {
        v3(s, s, s)
    }

    /// Scalar product.
    pub fn dot(self, o: V3) -> f32 {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// Vector product.
    pub fn cross(self, o: V3) -> V3 {
        v3(self.y * o.z - self.z * o.y, self.z * o.x - self.x * o.z, self.x * o.y - self.y * o.x)
    }

    /// Euclidean length.
    pub fn norm(self) -> f32 {
        self.dot(self).sqrt()
    }

    /// Unit vector; the zero vector stays zero.
    pub fn unit(self) -> V3 {
        let n = self.norm();
        if n > 0.0 { self / n } else { self }
    }

    /// Component-wise product, as light meets paint.
    pub fn tint(self, o: V3) -> V3 {
        v3(self.x * o.x, self.y * o.y, self.z * o.z)
    }

    /// Component-wise minimum.
    pub fn min(self, o: V3) -> V3 {
        v3(least(self.x, o.x), least(self.y, o.y), least(self.z, o.z))
    }

    /// Component-wise maximum.
    pub fn max(self, o: V3) -> V3 {
        v3(most(self.x, o.x), most(self.y, o.y), most(self.z, o.z))
    }

    /// From `self` at `t = 0` to `o` at `t = 1`.
    pub fn lerp(self, o: V3, t: f32) -> V3 {
        self * (1.0 - t) + o * t
    }

    /// Component by number: 0, 1 or 2.
    pub fn axis(self, k: usize) -> f32 {
        [self.x, self.y, self.z][k]
    }

    /// Brightness of a linear colour (Rec. 709 weights).
    pub fn luminance(self) -> f32 {
        0.2126 * self.x + 0.7152 * self.y + 0.0722 * self.z
    }

    /// Two directions that complete the unit vector `self` to a right-handed frame, without a branch on its
    /// direction that a rotation could cross visibly (Duff et al. 2017).
    pub fn frame(self) -> (V3, V3) {
        let sign = 1.0f32.copysign(self.z);
        let a = -1.0 / (sign + self.z);
        let b = self.x * self.y * a;
        (
            v3(1.0 + sign * self.x * self.x * a, sign * b, -sign * self.x),
            v3(b, sign + self.y * self.y * a, -self.y),
        )
    }
}

/// The smaller number; unlike `f32::min` it does not handle NaN, and so is one instruction.
pub fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger number, likewise.
pub fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl From<[f32; 3]> for V3 {
    fn from([x, y, z]: [f32; 3]) -> V3 {
        v3(x, y, z)
    }
}

impl Add for V3 {
    type Output = V3;
    fn add(self, o: V3) -> V3 {
        v3(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl Sub for V3 {
    type Output = V3;
    fn sub(self, o: V3) -> V3 {
        v3(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl Mul<f32> for V3 {
    type Output = V3;
    fn mul(self, s: f32) -> V3 {
        v3(self.x * s, self.y * s, self.z * s)
    }
}

impl Div<f32> for V3 {
    type Output = V3;
    fn div(self, s: f32) -> V3 {
        v3(self.x / s, self.y / s, self.z / s)
    }
}

impl Neg for V3 {
    type Output = V3;
    fn neg(self) -> V3 {
        v3(-self.x, -self.y, -self.z)
    }
}

#[cfg(test)]
mod tests {
    //! Claim: `frame` is orthonormal and right-handed in every octant and at both poles.
    use super::*;

    #[test]
    fn frames_are_orthonormal() {
        for d in [v3(0., 0., 1.), v3(0., 0., -1.), v3(1., 2., 3.), v3(-3., 1., -2.), v3(0., -1., 0.)] {
            let n = d.unit();
            let (t, b) = n.frame();
            assert!(t.dot(n).abs() < 1e-6 && b.dot(n).abs() < 1e-6 && t.dot(b).abs() < 1e-6);
            assert!((t.cross(b) - n).norm() < 1e-6);
        }
    }
}
