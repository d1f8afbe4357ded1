//! The sets that the values of distributions lie in.

use super::coordinates::Interval;
use super::draw::Draw;
use crate::scalar::Scalar;
use std::f64::consts::PI;

/// The set of a distribution's values.
///
/// Single values inside may still be impossible: a weight of zero, the gap between a mixture's components.
#[derive(Clone, Debug, PartialEq)]
pub enum Support<S = f64> {
    /// True and false.
    Booleans,
    /// Whole numbers from zero, as many as this number, without order.
    Categories(usize),
    /// Whole numbers from `lo` to `hi`, both included; `None` is no bound.
    Integers {
        /// Smallest value.
        lo: i64,
        /// Largest value.
        hi: Option<i64>,
    },
    /// Single real numbers, each with a probability.
    Points {
        /// Smallest value.
        lo: S,
        /// Largest value.
        hi: S,
    },
    /// Real numbers.
    Reals(Interval<S>),
    /// Angles within half a turn of zero, radians.
    Circle,
    /// Vectors of `n` positive numbers that sum to one.
    Simplex(usize),
    /// All vectors of `n` numbers.
    Vectors(usize),
    /// Single vectors of `n` numbers, each with a probability.
    VectorPoints(usize),
    /// Lists of `n` counts, each with a probability.
    Counts(usize),
    /// Lists of `n` truth values.
    Truths(usize),
}

impl<S: Scalar> Support<S> {
    /// The support of a single value.
    pub(super) fn of_value(value: &Draw<S>) -> Support<S> {
        match value {
            Draw::Bool(_) => Support::Booleans,
            Draw::Int(i) => Support::Integers { lo: *i, hi: Some(*i) },
            Draw::Real(x) => Support::Points { lo: *x, hi: *x },
            Draw::Vector(v) => Support::VectorPoints(v.len()),
            Draw::Counts(v) => Support::Counts(v.len()),
            Draw::Truths(v) => Support::Truths(v.len()),
        }
    }

    /// The support by bounds alone: categories become whole numbers, and angles real numbers.
    #[must_use]
    pub fn in_bounds(self) -> Support<S> {
        match self {
            Support::Categories(n) => Support::Integers { lo: 0, hi: Some(n as i64 - 1) },
            Support::Circle => {
                Support::Reals(Interval { lo: Some(S::from_f64(-PI)), hi: Some(S::from_f64(PI)) })
            }
            Support::Booleans | Support::Integers { .. } | Support::Points { .. } | Support::Reals(_) => self,
            Support::Simplex(_) | Support::Vectors(_) | Support::VectorPoints(_) => self,
            Support::Counts(_) | Support::Truths(_) => self,
        }
    }

    /// The smallest support in bounds that contains both supports, which must be of one kind.
    pub(super) fn cover(self, other: Support<S>) -> Support<S> {
        match (self, other) {
            (Support::Integers { lo, hi }, Support::Integers { lo: lo2, hi: hi2 }) => {
                Support::Integers { lo: lo.min(lo2), hi: hi.zip(hi2).map(|(a, b)| a.max(b)) }
            }
            (Support::Points { lo, hi }, Support::Points { lo: lo2, hi: hi2 }) => {
                Support::Points { lo: lo.min(lo2), hi: hi.max(hi2) }
            }
            (Support::Reals(a), Support::Reals(b)) => Support::Reals(Interval {
                lo: a.lo.zip(b.lo).map(|(a, b)| a.min(b)),
                hi: a.hi.zip(b.hi).map(|(a, b)| a.max(b)),
            }),
            (first @ (Support::Booleans | Support::Categories(_) | Support::Integers { .. }), _)
            | (first @ (Support::Points { .. } | Support::Reals(_) | Support::Circle), _)
            | (first @ (Support::Simplex(_) | Support::Vectors(_) | Support::VectorPoints(_)), _)
            | (first @ (Support::Counts(_) | Support::Truths(_)), _) => first,
        }
    }

    /// The length of the vectors or lists.
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Support::Simplex(n) | Support::Vectors(n) | Support::VectorPoints(n) => Some(*n),
            Support::Counts(n) | Support::Truths(n) => Some(*n),
            Support::Booleans | Support::Categories(_) | Support::Integers { .. } => None,
            Support::Points { .. } | Support::Reals(_) | Support::Circle => None,
        }
    }
}
