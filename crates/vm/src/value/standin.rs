//! Stand-in for the numbers' room until it is merged: same names, no mathematics.
#![allow(missing_docs)]

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::Arc;

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
    fn from_f64(x: f64) -> Self;
    fn value(self) -> f64;
    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn ln_1p(self) -> Self;
    fn exp_m1(self) -> Self;
    fn sin(self) -> Self;
    fn cos(self) -> Self;
    fn tan(self) -> Self;
    fn asin(self) -> Self;
    fn acos(self) -> Self;
    fn atan(self) -> Self;
    fn atan2(self, x: Self) -> Self;
    fn sinh(self) -> Self;
    fn cosh(self) -> Self;
    fn tanh(self) -> Self;
    fn abs(self) -> Self;
    fn powf(self, y: Self) -> Self;
    fn powi(self, n: i32) -> Self;
    fn ln_gamma(self) -> Self;
    fn erf(self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn is_finite(self) -> bool;
}

macro_rules! unary { ($($n:ident)*) => { $(fn $n(self) -> f64 { f64::$n(self) })* } }
impl Scalar for f64 {
    fn from_f64(x: f64) -> f64 {
        x
    }
    fn value(self) -> f64 {
        self
    }
    unary! { sqrt exp ln ln_1p exp_m1 sin cos tan asin acos atan sinh cosh tanh abs }
    fn atan2(self, x: f64) -> f64 {
        f64::atan2(self, x)
    }
    fn powf(self, y: f64) -> f64 {
        f64::powf(self, y)
    }
    fn powi(self, n: i32) -> f64 {
        f64::powi(self, n)
    }
    fn ln_gamma(self) -> f64 {
        self
    }
    fn erf(self) -> f64 {
        self
    }
    fn min(self, other: f64) -> f64 {
        f64::min(self, other)
    }
    fn max(self, other: f64) -> f64 {
        f64::max(self, other)
    }
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum Draw<S = f64> {
    Bool(bool),
    Int(i64),
    Real(S),
    Vector(Arc<[S]>),
}

#[derive(Clone, Debug)]
pub enum Param<S: Scalar = f64> {
    Bool(bool),
    Int(i64),
    Real(S),
    Vector(Vec<S>),
    Matrix(Vec<Vec<S>>),
    Dists(Vec<Dist<S>>),
    Draw(Draw<S>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    Bernoulli,
    Delta,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Dist<S: Scalar = f64> {
    Bernoulli { p: S },
    Delta(Draw<S>),
}

pub struct BadParameter {
    pub family: Family,
    pub parameter: &'static str,
    pub found: String,
    pub expected: &'static str,
}

impl Family {
    pub fn name(self) -> &'static str {
        match self {
            Family::Bernoulli => "bernoulli",
            Family::Delta => "delta",
        }
    }
}

impl<S: Scalar> Dist<S> {
    pub fn family(&self) -> Family {
        Family::Delta
    }
    pub fn new(family: Family, params: &[Param<S>]) -> Result<Dist<S>, BadParameter> {
        match params {
            [Param::Real(p)] => Ok(Dist::Bernoulli { p: *p }),
            [Param::Draw(d)] => Ok(Dist::Delta(d.clone())),
            _ => Err(BadParameter { family, parameter: "p", found: "nothing".into(), expected: "a number" }),
        }
    }
}
