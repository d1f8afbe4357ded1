//! Operations of numbers, as a trait: a run can compute with other scalars than `f64`.
//!
//! Plain runs use `f64`. A scalar that records its operations implements the same trait, so the generic densities can
//! be recorded. Decisions (inside the support or not, which series to use) compare scalars with `<` and `==`, which a
//! recording scalar notes. [`Scalar::value`] is for decisions that end in a fault, which need no note.

use crate::special;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number, or a scalar that records its operations.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The constant `x`.
    fn from_f64(x: f64) -> Self;
    /// The plain number, for decisions.
    fn value(self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// e to this power.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// `ln(1 + x)`, accurate near zero.
    fn ln_1p(self) -> Self;
    /// `exp(x) - 1`, accurate near zero.
    fn exp_m1(self) -> Self;
    /// Sine of radians.
    fn sin(self) -> Self;
    /// Cosine of radians.
    fn cos(self) -> Self;
    /// Tangent of radians.
    fn tan(self) -> Self;
    /// Angle with this sine, radians.
    fn asin(self) -> Self;
    /// Angle with this cosine, radians.
    fn acos(self) -> Self;
    /// Angle with this tangent, radians.
    fn atan(self) -> Self;
    /// Angle of the point `(x, self)`, radians in `[-pi, pi]`.
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Distance from zero.
    fn abs(self) -> Self;
    /// This number to the power `y`.
    fn powf(self, y: Self) -> Self;
    /// This number to the whole power `n`.
    fn powi(self, n: i32) -> Self;
    /// Logarithm of the gamma function's absolute value.
    fn ln_gamma(self) -> Self;
    /// Error function.
    fn erf(self) -> Self;
    /// `exp(x^2) erfc(x)`: the Gaussian's tail without its underflow.
    fn erfcx(self) -> Self;
    /// `ln(exp(-|x|) I_0(x))`: the Bessel function that normalises the von Mises density, without overflow.
    fn ln_bessel_i0e(self) -> Self;
    /// The smaller of two.
    fn min(self, other: Self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// The largest whole number not above this number. When recorded, the result may be one less at a whole number itself:
    /// use it only if the final result is equal on both sides of the jump.
    fn floor(self) -> Self;
    /// A function in two pieces: `over` if the number is above the bound, else `under`. A recording has both pieces and a
    /// select, so it also holds beyond the bound; neither piece may compare numbers.
    fn above(self, bound: f64, over: impl FnOnce() -> Self, under: impl FnOnce() -> Self) -> Self;
    /// True when neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Whether the number varies with the coordinates of a recording. Plain numbers never do.
    #[inline(always)]
    fn varies(self) -> bool {
        false
    }
    /// Stores numbers under the address of an object that has plain numbers and lives as long as the recording
    /// needs it: the place of a shape, under the shape's address. Only a recording that asks for these numbers calls `numbers`.
    #[inline(always)]
    fn note(_address: usize, _numbers: impl FnOnce() -> Vec<Self>) {}
    /// The last numbers noted under an address; empty if there are none.
    #[inline(always)]
    fn noted(_address: usize) -> Vec<Self> {
        Vec::new()
    }
}

/// A cache of the last logarithm: consecutive observations with equal deviations compute it once.
#[derive(Clone, Copy, Debug)]
pub struct LastLog<S: Scalar> {
    of: u64,
    log: S,
}

impl<S: Scalar> Default for LastLog<S> {
    fn default() -> Self {
        LastLog { of: 1.0_f64.to_bits(), log: S::from_f64(0.0) }
    }
}

impl<S: Scalar> LastLog<S> {
    /// `x.ln()`, bit for bit. The logarithm of a number that varies is computed (and recorded) each time.
    #[inline(always)]
    pub fn of(&mut self, x: S) -> S {
        self.by(x, S::ln)
    }

    /// `log(x)`, bit for bit, where `log` is always the same.
    #[inline(always)]
    fn by(&mut self, x: S, log: impl FnOnce(S) -> S) -> S {
        if x.varies() {
            return log(x);
        }
        if x.value().to_bits() != self.of {
            *self = LastLog { of: x.value().to_bits(), log: log(x) };
        }
        self.log
    }
}

/// The logarithms that the density of a draw needs.
pub trait Logs<S> {
    /// `x.ln()`.
    fn ln(&mut self, x: S) -> S;

    /// `(-p).ln_1p()`.
    fn ln_of_rest(&mut self, p: S) -> S;
}

/// Logarithms that are computed each time.
pub struct EachLog;

impl<S: Scalar> Logs<S> for EachLog {
    #[inline(always)]
    fn ln(&mut self, x: S) -> S {
        x.ln()
    }

    #[inline(always)]
    fn ln_of_rest(&mut self, p: S) -> S {
        (-p).ln_1p()
    }
}

/// The last logarithm of each kind: draws by equal parameters compute them once.
#[derive(Clone, Copy, Debug)]
pub struct LastLogs<S: Scalar> {
    log: LastLog<S>,
    rest: LastLog<S>,
}

impl<S: Scalar> Default for LastLogs<S> {
    fn default() -> Self {
        let rest = LastLog { of: 0.0_f64.to_bits(), log: (-S::from_f64(0.0)).ln_1p() };
        LastLogs { log: LastLog::default(), rest }
    }
}

impl<S: Scalar> Logs<S> for LastLogs<S> {
    #[inline(always)]
    fn ln(&mut self, x: S) -> S {
        self.log.of(x)
    }

    #[inline(always)]
    fn ln_of_rest(&mut self, p: S) -> S {
        self.rest.by(p, |p| (-p).ln_1p())
    }
}

/// The standard library's functions of one argument, under the same names.
macro_rules! standard {
    ($($name:ident)*) => { $( #[inline] fn $name(self) -> f64 { f64::$name(self) } )* };
}

impl Scalar for f64 {
    #[inline]
    fn from_f64(x: f64) -> f64 {
        x
    }
    #[inline]
    fn value(self) -> f64 {
        self
    }
    standard! { sqrt exp ln ln_1p exp_m1 sin cos tan asin acos atan sinh cosh tanh abs }
    #[inline]
    fn floor(self) -> f64 {
        f64::floor(self)
    }
    #[inline]
    fn above(self, bound: f64, over: impl FnOnce() -> f64, under: impl FnOnce() -> f64) -> f64 {
        if self > bound { over() } else { under() }
    }
    #[inline]
    fn atan2(self, x: f64) -> f64 {
        f64::atan2(self, x)
    }
    #[inline]
    fn powf(self, y: f64) -> f64 {
        f64::powf(self, y)
    }
    #[inline]
    fn powi(self, n: i32) -> f64 {
        f64::powi(self, n)
    }
    #[inline]
    fn ln_gamma(self) -> f64 {
        libm::lgamma(self)
    }
    #[inline]
    fn erf(self) -> f64 {
        libm::erf(self)
    }
    #[inline]
    fn erfcx(self) -> f64 {
        puruspe::erfcx(self)
    }
    #[inline]
    fn ln_bessel_i0e(self) -> f64 {
        special::ln_bessel_i0e(self)
    }
    #[inline]
    fn min(self, other: f64) -> f64 {
        f64::min(self, other)
    }
    #[inline]
    fn max(self, other: f64) -> f64 {
        f64::max(self, other)
    }
    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}
