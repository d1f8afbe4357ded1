//! The outputs of a distribution: drawn values.

use crate::scalar::Scalar;
use std::fmt;
use std::sync::Arc;

/// A value that a distribution can take.
#[derive(Clone, Debug, PartialEq)]
pub enum Draw<S = f64> {
    /// True or false.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A real number.
    Real(S),
    /// A vector of reals, shape (n,).
    Vector(Arc<[S]>),
    /// Whole numbers in a row, shape (n,).
    Counts(Arc<[i64]>),
    /// Truth values in a row, shape (n,).
    Truths(Arc<[bool]>),
}

impl<S: Scalar> Draw<S> {
    /// The draw as a truth value. As in Python, 1 is true and 0 is false; other numbers are neither.
    #[inline]
    pub fn as_bool(&self) -> Option<bool> {
        match self {
            Draw::Bool(b) => Some(*b),
            Draw::Int(i @ (0 | 1)) => Some(*i == 1),
            Draw::Real(x) if x.value() == 0.0 || x.value() == 1.0 => Some(x.value() == 1.0),
            _ => None,
        }
    }

    /// The draw as a whole number. As in Python, true is 1, and 3.0 is 3.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most 2^53")]
    pub fn as_int(&self) -> Option<i64> {
        match self {
            Draw::Int(i) => Some(*i),
            Draw::Bool(b) => Some(i64::from(*b)),
            // Above 2^53 a float no longer stands for a single whole number.
            Draw::Real(x) if x.value().fract() == 0.0 && x.value().abs() <= 9_007_199_254_740_992.0 => {
                Some(x.value() as i64)
            }
            _ => None,
        }
    }

    /// The draw as a real number. As in Python, 3 is 3.0 and true is 1.0.
    #[inline]
    pub fn as_real(&self) -> Option<S> {
        match self {
            Draw::Real(x) => Some(*x),
            Draw::Int(i) => Some(S::from_f64(*i as f64)),
            Draw::Bool(b) => Some(S::from_f64(f64::from(u8::from(*b)))),
            Draw::Vector(_) | Draw::Counts(_) | Draw::Truths(_) => None,
        }
    }

    /// The draw as a vector.
    #[inline]
    pub fn as_vector(&self) -> Option<&[S]> {
        match self {
            Draw::Vector(v) => Some(v),
            _ => None,
        }
    }

    /// The draw as a list of whole numbers; kinds count as in [`Draw::as_int`].
    pub fn as_counts(&self) -> Option<Vec<i64>> {
        match self {
            Draw::Counts(all) => Some(all.to_vec()),
            Draw::Truths(all) => Some(all.iter().map(|b| i64::from(*b)).collect()),
            Draw::Vector(all) => all.iter().map(|x| Draw::Real(*x).as_int()).collect(),
            Draw::Bool(_) | Draw::Int(_) | Draw::Real(_) => None,
        }
    }

    /// The draw as a list of truth values; kinds count as in [`Draw::as_bool`].
    pub fn as_truths(&self) -> Option<Vec<bool>> {
        match self {
            Draw::Truths(all) => Some(all.to_vec()),
            Draw::Counts(all) => all.iter().map(|i| Draw::<S>::Int(*i).as_bool()).collect(),
            Draw::Vector(all) => all.iter().map(|x| Draw::Real(*x).as_bool()).collect(),
            Draw::Bool(_) | Draw::Int(_) | Draw::Real(_) => None,
        }
    }

    /// Converts the draw to another kind of number.
    pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Draw<T> {
        match self {
            Draw::Bool(b) => Draw::Bool(*b),
            Draw::Int(i) => Draw::Int(*i),
            Draw::Real(x) => Draw::Real(number(*x)),
            Draw::Vector(v) => Draw::Vector(v.iter().map(|x| number(*x)).collect()),
            Draw::Counts(v) => Draw::Counts(v.clone()),
            Draw::Truths(v) => Draw::Truths(v.clone()),
        }
    }
}

/// A number as Python writes it.
pub(super) fn number<S: Scalar>(f: &mut fmt::Formatter<'_>, x: S) -> fmt::Result {
    if x.value().is_nan() { f.write_str("nan") } else { write!(f, "{:?}", x.value()) }
}

/// Up to eight values of a row, for a message.
pub(super) fn row<T: Copy>(
    f: &mut fmt::Formatter<'_>,
    values: &[T],
    write: impl Fn(&mut fmt::Formatter<'_>, T) -> fmt::Result,
) -> fmt::Result {
    write!(f, "[")?;
    for (k, x) in values.iter().take(8).enumerate() {
        write!(f, "{}", if k > 0 { ", " } else { "" })?;
        write(f, *x)?;
    }
    write!(f, "{}]", if values.len() > 8 { ", ..." } else { "" })
}

/// A truth value as Python writes it.
fn truth(f: &mut fmt::Formatter<'_>, b: bool) -> fmt::Result {
    f.write_str(if b { "True" } else { "False" })
}

/// Text of the draw, shortened if it is long.
impl<S: Scalar> fmt::Display for Draw<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Draw::Bool(b) => truth(f, *b),
            Draw::Int(i) => write!(f, "{i}"),
            Draw::Real(x) => number(f, *x),
            Draw::Vector(v) => row(f, v, number),
            Draw::Counts(v) => row(f, v, |f, k| write!(f, "{k}")),
            Draw::Truths(v) => row(f, v, truth),
        }
    }
}
