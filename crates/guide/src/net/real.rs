//! The numbers of a network's computations.

use std::fmt::Debug;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};

/// `f32`, or `f64` if digits matter more than time.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + MulAssign
    + Sum
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// The nearest number of this type.
    fn from_f64(x: f64) -> Self;
    /// The number as an `f64`.
    fn to_f64(self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// The number within two bounds.
    fn clamp(self, lo: Self, hi: Self) -> Self;
    /// Hyperbolic tangent, with equal bits on every machine.
    fn tanh(self) -> Self;
}

impl Real for f32 {
    const ZERO: f32 = 0.0;
    const ONE: f32 = 1.0;
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded to the precision of the network")]
    fn from_f64(x: f64) -> f32 {
        x as f32
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn sqrt(self) -> f32 {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn clamp(self, lo: f32, hi: f32) -> f32 {
        f32::clamp(self, lo, hi)
    }
    /// A quotient of polynomials in the square, fitted to minimise the largest error on `[0, 8]`; from there on tanh is 1 to
    /// all digits of an `f32` but the last. The error is below 4e-7. The compiler vectorises the additions,
    /// multiplications and the division, which every machine rounds alike.
    #[inline(always)]
    fn tanh(self) -> f32 {
        const UP: [f32; 5] = [0.999_999_97, 0.134_381_89, 3.564_153e-3, 2.177_319_7e-5, 1.506_174_2e-8];
        const DOWN: [f32; 5] = [1.0, 0.467_715_1, 2.613_600_4e-2, 3.399_174_5e-4, 8.453_634e-7];
        let x = f32::clamp(self, -8.0, 8.0);
        let s = x * x;
        let up = (((UP[4] * s + UP[3]) * s + UP[2]) * s + UP[1]) * s + UP[0];
        let down = (((DOWN[4] * s + DOWN[3]) * s + DOWN[2]) * s + DOWN[1]) * s + DOWN[0];
        x * up / down
    }
}

impl Real for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    #[inline(always)]
    fn from_f64(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn clamp(self, lo: f64, hi: f64) -> f64 {
        f64::clamp(self, lo, hi)
    }
    #[inline(always)]
    fn tanh(self) -> f64 {
        f64::tanh(self)
    }
}

#[cfg(test)]
mod tests {
    //! The fast tangent is near the exact one, odd, and never above one.
    use super::Real;

    #[test]
    fn tanh_is_within_a_millionth() {
        for k in -200_000..=200_000 {
            let x = k as f32 * 1e-4;
            let fast = Real::tanh(x);
            assert!((f64::from(fast) - f64::from(x).tanh()).abs() < 1e-6, "{x}: {fast}");
            assert!(fast.abs() <= 1.0 && fast == -Real::tanh(-x), "{x}");
        }
        assert_eq!(Real::tanh(0.0_f32), 0.0);
    }
}
