//! Reads and checks parameters, once when a distribution is built; every refusal is a [`BadParameter`].

use super::draw::Draw;
use super::family::Dist;
use super::family::Family;
use super::param::Param;
use crate::scalar::Scalar;
use std::fmt;

/// A parameter that a family cannot use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadParameter {
    /// The family.
    pub family: Family,
    /// The parameter's name.
    pub parameter: &'static str,
    /// The value of the parameter, as text.
    pub value: String,
    /// The expected values.
    pub expected: &'static str,
    /// Whether kind and shape are right, and only the numbers are wrong.
    pub out_of_range: bool,
}

impl fmt::Display for BadParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BadParameter { family, parameter, value, expected, .. } = self;
        write!(f, "`{parameter}` of {family} is {value}, expected {expected}")
    }
}

impl std::error::Error for BadParameter {}

/// The parameters of one distribution to be built.
pub(super) struct Reader<'a, S: Scalar> {
    family: Family,
    params: &'a [Param<S>],
}

type Checked<T> = Result<T, BadParameter>;

impl<'a, S: Scalar> Reader<'a, S> {
    /// Fails if there are more or fewer parameters than the family has.
    #[inline]
    pub fn new(family: Family, params: &'a [Param<S>]) -> Checked<Self> {
        let names = family.parameters();
        if let Some(parameter) = names.get(params.len()) {
            let (value, expected) = ("missing".to_string(), "a value");
            return Err(BadParameter { family, parameter, value, expected, out_of_range: false });
        }
        if params.len() > names.len() {
            let value = format!("followed by {} more", params.len() - names.len());
            let (parameter, expected) = (names[names.len() - 1], "no more parameters");
            return Err(BadParameter { family, parameter, value, expected, out_of_range: false });
        }
        Ok(Reader { family, params })
    }

    /// The error of parameter `k`, whose kind and shape are right and whose numbers are wrong.
    #[cold]
    pub fn refuse<T>(&self, k: usize, expected: &'static str) -> Checked<T> {
        let (family, parameter) = (self.family, self.family.parameters()[k]);
        let value = self.params[k].to_string();
        Err(BadParameter { family, parameter, value, expected, out_of_range: true })
    }

    /// The error of parameter `k`, which has another kind or shape: no number is valid in its place.
    #[cold]
    pub fn refuse_kind<T>(&self, k: usize, expected: &'static str) -> Checked<T> {
        self.refuse(k, expected).map_err(|bad| BadParameter { out_of_range: false, ..bad })
    }

    #[inline]
    fn number(&self, k: usize) -> Option<S> {
        match &self.params[k] {
            Param::Real(x) => Some(*x),
            Param::Int(i) => Some(S::from_f64(*i as f64)),
            Param::Bool(b) => Some(S::from_f64(f64::from(u8::from(*b)))),
            Param::Draw(d) => d.as_real(),
            _ => None,
        }
    }

    /// A number for which `accept` holds; `accept` must refuse NaN.
    #[inline]
    pub fn real_where(&self, k: usize, expected: &'static str, accept: impl Fn(S) -> bool) -> Checked<S> {
        match self.number(k) {
            Some(x) if accept(x) => Ok(x),
            Some(_) => self.refuse(k, expected),
            None => self.refuse_kind(k, expected),
        }
    }

    /// A finite number.
    #[inline]
    pub fn finite(&self, k: usize) -> Checked<S> {
        self.real_where(k, "a finite number", S::is_finite)
    }

    /// A finite number above zero.
    #[inline]
    pub fn positive(&self, k: usize) -> Checked<S> {
        self.real_where(k, "a finite number above zero", |x| x > S::from_f64(0.0) && x.is_finite())
    }

    /// A number from zero to one.
    #[inline]
    pub fn probability(&self, k: usize) -> Checked<S> {
        self.real_where(k, "a number from 0 to 1", |x| x >= S::from_f64(0.0) && x <= S::from_f64(1.0))
    }

    /// A whole number.
    #[inline]
    pub fn whole(&self, k: usize) -> Checked<i64> {
        match &self.params[k] {
            Param::Int(i) => Ok(*i),
            Param::Bool(b) => Ok(i64::from(*b)),
            Param::Draw(Draw::Int(i)) => Ok(*i),
            _ => self.refuse_kind(k, "a whole number"),
        }
    }

    /// Finite numbers, at least one, for all of which `accept` holds.
    pub fn vector_where(
        &self,
        k: usize,
        expected: &'static str,
        accept: impl Fn(S) -> bool,
    ) -> Checked<&'a [S]> {
        let numbers: &[S] = match &self.params[k] {
            Param::Vector(v) => v,
            Param::Draw(Draw::Vector(v)) => v,
            _ => return self.refuse_kind(k, expected),
        };
        if numbers.is_empty() {
            return self.refuse_kind(k, expected);
        }
        let fine = numbers.iter().all(|x| x.is_finite() && accept(*x));
        if fine { Ok(numbers) } else { self.refuse(k, expected) }
    }

    /// A square matrix of finite numbers with `n` rows.
    pub fn square(&self, k: usize, n: usize, expected: &'static str) -> Checked<&'a [Vec<S>]> {
        match &self.params[k] {
            Param::Matrix(rows) if rows.len() == n && rows.iter().all(|r| r.len() == n) => {
                let fine = rows.iter().flatten().all(|x| x.is_finite());
                if fine { Ok(rows) } else { self.refuse(k, expected) }
            }
            _ => self.refuse_kind(k, expected),
        }
    }

    /// Distributions.
    pub fn dists(&self, k: usize, expected: &'static str) -> Checked<&'a [Dist<S>]> {
        match &self.params[k] {
            Param::Dists(dists) => Ok(dists),
            _ => self.refuse_kind(k, expected),
        }
    }

    /// A finite value of any kind.
    pub fn value(&self, k: usize) -> Checked<Draw<S>> {
        let value = match &self.params[k] {
            Param::Bool(b) => Draw::Bool(*b),
            Param::Int(i) => Draw::Int(*i),
            Param::Real(x) => Draw::Real(*x),
            Param::Vector(v) => Draw::Vector(v.as_slice().into()),
            Param::Draw(d) => d.clone(),
            _ => return self.refuse_kind(k, "a truth value, a number or a vector"),
        };
        let finite = match &value {
            Draw::Real(x) => x.is_finite(),
            Draw::Vector(v) => v.iter().all(|x| x.is_finite()),
            _ => true,
        };
        if finite { Ok(value) } else { self.refuse(k, "a finite value") }
    }
}
