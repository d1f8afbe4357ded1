//! The inputs of a distribution: parameters.

use super::draw::{Draw, number, row};
use super::family::Dist;
use crate::scalar::Scalar;
use std::fmt;

/// A parameter of a distribution, as a model passes it.
#[derive(Clone, Debug, PartialEq)]
pub enum Param<S: Scalar = f64> {
    /// A truth value; counts as 0 or 1 if a number is expected.
    Bool(bool),
    /// A whole number; counts as a real number if that is expected.
    Int(i64),
    /// A real number.
    Real(S),
    /// Numbers in a row.
    Vector(Vec<S>),
    /// Rows of numbers.
    Matrix(Vec<Vec<S>>),
    /// Distributions.
    Dists(Vec<Dist<S>>),
    /// A value that the distribution returns unchanged.
    Draw(Draw<S>),
}

/// Text of the parameter, shortened if it is long.
impl<S: Scalar> fmt::Display for Param<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Param::Bool(b) => Draw::<S>::Bool(*b).fmt(f),
            Param::Int(i) => write!(f, "{i}"),
            Param::Real(x) => Draw::Real(*x).fmt(f),
            Param::Vector(v) => row(f, v, number),
            Param::Matrix(rows) if rows.len() <= 3 => {
                write!(f, "[")?;
                for (k, r) in rows.iter().enumerate() {
                    write!(f, "{}", if k > 0 { ", " } else { "" })?;
                    row(f, r, number)?;
                }
                write!(f, "]")
            }
            Param::Matrix(rows) => write!(f, "{} rows of numbers", rows.len()),
            Param::Dists(dists) if dists.len() == 1 => write!(f, "one distribution"),
            Param::Dists(dists) => write!(f, "{} distributions", dists.len()),
            Param::Draw(d) => d.fmt(f),
        }
    }
}
