//! Coordinates without bounds: maps of a bounded real number to the line and back, and small moves of it on the line.
//!
//! With `s(v) = 1 / (1 + exp(-v))`:
//!
//! | support | value of the coordinate `v` | log of the size of dx/dv |
//! | --- | --- | --- |
//! | line | `v` | 0 |
//! | above `lo` | `lo + exp(v)` | `v` |
//! | below `hi` | `hi - exp(v)` | `v` |
//! | `lo` to `hi` | `lo + (hi - lo) s(v)` | `ln(hi - lo) + 2 ln s(v) - v` |
//! | circle | `v`, around | 0 |
//! | simplex | shares of `exp(v)` | sum of `ln x`, up to a constant |
//! | vectors | `v` | 0 |
//!
//! Gradient methods use the coordinate ([`Interval::value`]); a single small move multiplies the distances from the
//! bounds instead ([`Interval::moved`]), so that it loses no digits. See [`super::ends`] for the ends of the numbers of 64 bits.

use super::draw::Draw;
use super::space::Space;
use super::support::Support;
use crate::scalar::Scalar;
use std::f64::consts::PI;

/// Real numbers between two optional bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<S = f64> {
    /// Lower bound.
    pub lo: Option<S>,
    /// Upper bound.
    pub hi: Option<S>,
}

/// A number of an interval, computed from its coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Placed<S> {
    /// The number.
    pub value: S,
    /// Log of dx/dv, without the width.
    pub log_slope: S,
    /// Between two bounds: the log of the width, which the caller must add, and the log of the share `s(v)`.
    pub between: Option<(S, S)>,
}

/// `1 / (1 + exp(-v))`.
pub fn logistic<S: Scalar>(v: S) -> S {
    let unity = S::from_f64(1.0);
    unity / (unity + (-v).exp())
}

impl<S: Scalar> Interval<S> {
    /// All real numbers.
    pub const LINE: Interval<S> = Interval { lo: None, hi: None };

    /// The coordinate of a number; a bound has the coordinate of the last number inside.
    pub fn coordinate(&self, x: f64) -> f64 {
        let bounds = Interval { lo: self.lo.map(S::value), hi: self.hi.map(S::value) };
        if bounds == Interval::LINE {
            return x;
        }
        let (least, most) = bounds.inside();
        let x = if least < most { x.clamp(least, most) } else { x };
        match (bounds.lo, bounds.hi) {
            (None, None) => x,
            (Some(lo), None) => (x - lo).ln(),
            (None, Some(hi)) => (hi - x).ln(),
            (Some(lo), Some(hi)) => {
                let share = (x - lo) / (hi - lo);
                // If the share rounds to one, the distance from the bound has the digits.
                if share < 1.0 { share.ln() - (-share).ln_1p() } else { (x - lo).ln() - (hi - x).ln() }
            }
        }
    }

    /// The number of a coordinate.
    pub fn value(&self, v: S) -> Placed<S> {
        match (self.lo, self.hi) {
            (None, None) => Placed { value: v, log_slope: S::from_f64(0.0), between: None },
            (Some(lo), None) => Placed { value: lo + v.exp(), log_slope: v, between: None },
            (None, Some(hi)) => Placed { value: hi - v.exp(), log_slope: v, between: None },
            (Some(lo), Some(hi)) => {
                let share = logistic(v);
                let log_share = share.ln();
                let width = hi - lo;
                let value = lo + width * share;
                let log_slope = S::from_f64(2.0) * log_share - v;
                Placed { value, log_slope, between: Some((width.ln(), log_share)) }
            }
        }
    }
}

impl Interval {
    /// A number moved by `z` in its coordinate, and the log densities of the move and its reverse, up to common terms:
    /// minus the logs of dx/dv.
    pub fn moved(&self, x: f64, z: f64) -> (f64, f64, f64) {
        match (self.lo, self.hi) {
            (None, None) => (x + z, 0.0, 0.0),
            (Some(lo), None) => {
                let new = lo + (x - lo) * z.exp();
                (new, -(new - lo).ln(), -(x - lo).ln())
            }
            (None, Some(hi)) => {
                let new = hi - (hi - x) * z.exp();
                (new, -(hi - new).ln(), -(hi - x).ln())
            }
            (Some(lo), Some(hi)) => {
                // With a = x - lo and b = hi - x, the quotient a / b is multiplied by e^z.
                let (a, b, factor) = (x - lo, hi - x, z.exp());
                let share = if factor.is_finite() { a * factor / (a * factor + b) } else { 1.0 };
                // Rounding may pass the end.
                let new = (lo + (hi - lo) * share).clamp(lo, hi);
                let log = |x: f64| -((x - lo) * (hi - x)).ln();
                (new, log(new), log(x))
            }
        }
    }
}

impl Space {
    /// The coordinates in which a value may move for any parameters: on the line if the bounds depend on parameters.
    /// `None` for discrete values.
    pub fn coordinates(self) -> Option<Support> {
        match self {
            Space::Booleans | Space::Categories | Space::Integers | Space::Fixed => None,
            Space::Counts | Space::Truths => None,
            Space::Line | Space::Bounded | Space::Components => Some(Support::Reals(Interval::LINE)),
            Space::Positive => Some(Support::Reals(Interval { lo: Some(0.0), hi: None })),
            Space::Unit => Some(Support::Reals(Interval { lo: Some(0.0), hi: Some(1.0) })),
            Space::Circle => Some(Support::Circle),
            Space::Simplex => Some(Support::Simplex(0)),
            Space::Vectors => Some(Support::Vectors(0)),
        }
    }
}

impl Support {
    /// A value moved by a separate `z` in each coordinate, and the log densities of the move and its reverse, up to
    /// common terms. `None` for a value of another kind, and for a discrete value.
    pub fn moved(&self, old: &Draw, mut z: impl FnMut() -> f64) -> Option<(Draw, f64, f64)> {
        match (self, old) {
            (Support::Reals(interval), Draw::Real(x)) => {
                let (x, forward, backward) = interval.moved(*x, z());
                Some((Draw::Real(x), forward, backward))
            }
            (Support::Circle, Draw::Real(x)) => {
                Some((Draw::Real((x + z() + PI).rem_euclid(2.0 * PI) - PI), 0.0, 0.0))
            }
            (Support::Simplex(_), Draw::Vector(x)) => {
                let products: Vec<f64> = x.iter().map(|x| x * z().exp()).collect();
                let sum: f64 = products.iter().sum();
                let new: Vec<f64> = products.iter().map(|x| x / sum).collect();
                let log = |x: &[f64]| -x.iter().map(|x| x.ln()).sum::<f64>();
                let (forward, backward) = (log(&new), log(x));
                Some((Draw::Vector(new.into()), forward, backward))
            }
            (Support::Vectors(_), Draw::Vector(x)) => {
                Some((Draw::Vector(x.iter().map(|x| x + z()).collect()), 0.0, 0.0))
            }
            (Support::Reals(_) | Support::Circle | Support::Simplex(_) | Support::Vectors(_), _)
            | (Support::Booleans | Support::Categories(_) | Support::Integers { .. }, _)
            | (Support::Points { .. } | Support::VectorPoints(_), _)
            | (Support::Counts(_) | Support::Truths(_), _) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Coordinates are invertible, and their slopes agree with differences; moves too.
    use super::*;

    #[test]
    fn coordinates_are_invertible_and_have_the_stated_slopes() {
        let bounds = [(None, None), (Some(-1.0), None), (None, Some(3.0)), (Some(-1.0), Some(3.0))];
        for (lo, hi) in bounds {
            let interval = Interval { lo, hi };
            for x in [-0.9, 0.0, 0.5, 2.9] {
                let v = interval.coordinate(x);
                let at = |v: f64| interval.value(v).value;
                let placed = interval.value(v);
                assert!((placed.value - x).abs() < 1e-12);
                let log_slope = |v: f64| {
                    let placed = interval.value(v);
                    placed.log_slope + placed.between.map_or(0.0, |(log_width, _)| log_width)
                };
                let step = 1e-5;
                let slope = (at(v + step) - at(v - step)) / (2.0 * step);
                assert!((slope.abs().ln() - log_slope(v)).abs() < 1e-8, "{interval:?} at {x}");
                let (new, forward, backward) = interval.moved(x, 0.3);
                assert!((new - at(v + 0.3)).abs() < 1e-12);
                assert!((forward - backward - (log_slope(v) - log_slope(v + 0.3))).abs() < 1e-12);
            }
        }
    }
}
