//! Where a distribution's values lie, and the list of them where it is finite.

use super::dist::Dist;
use super::draw::Draw;
use crate::scalar::Scalar;

/// Where the values of a distribution lie.
///
/// Single values inside may still be impossible: a weight of zero, the gap between a mixture's components.
#[derive(Clone, Debug, PartialEq)]
pub enum Support {
    /// True and false.
    Booleans,
    /// Whole numbers from `lo` to `hi`, both included; `None` is no bound.
    Integers {
        /// Smallest value.
        lo: i64,
        /// Largest value.
        hi: Option<i64>,
    },
    /// Real numbers between `lo` and `hi`, which may be infinite.
    Reals {
        /// Lower end.
        lo: f64,
        /// Upper end.
        hi: f64,
    },
    /// Vectors of `n` positive numbers that sum to one.
    Simplex(usize),
    /// All vectors of `n` numbers.
    Vectors(usize),
}

impl Support {
    /// The smallest support that contains both (which are of one kind).
    pub(super) fn cover(self, other: Support) -> Support {
        match (self, other) {
            (Support::Integers { lo, hi }, Support::Integers { lo: lo2, hi: hi2 }) => {
                Support::Integers { lo: lo.min(lo2), hi: hi.zip(hi2).map(|(a, b)| a.max(b)) }
            }
            (Support::Reals { lo, hi }, Support::Reals { lo: lo2, hi: hi2 }) => {
                Support::Reals { lo: lo.min(lo2), hi: hi.max(hi2) }
            }
            (Support::Simplex(n), Support::Vectors(_)) => Support::Vectors(n),
            (first, _) => first,
        }
    }
}

/// How a density is measured: two distributions with equal measures can be mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// Counting truth values.
    Booleans,
    /// Counting whole numbers.
    Integers,
    /// Counting single points of the line (a delta).
    Points,
    /// Length.
    Length,
    /// Area of the simplex of this many entries.
    Simplex(usize),
    /// Volume in this many dimensions.
    Volume(usize),
    /// Counting single vectors of this many entries (a delta).
    VectorPoints(usize),
}

/// Longer lists of values are not written out.
const LONGEST_LIST: i64 = 1 << 20;

impl<S: Scalar> Dist<S> {
    /// How many components its values have, of a family of vectors.
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Dist::Dirichlet(_) | Dist::MultivariateGaussian(_) | Dist::Mixture(_) => match self.support() {
                Support::Simplex(n) | Support::Vectors(n) => Some(n),
                _ => None,
            },
            Dist::Delta(Draw::Vector(x)) => Some(x.len()),
            _ => None,
        }
    }

    /// The scale of a family with a location and a scale on the whole line; the first of a mixture of such.
    pub fn scale(&self) -> Option<S> {
        match self {
            Dist::Gaussian { sd, .. } => Some(*sd),
            Dist::Laplace { scale, .. } | Dist::Cauchy { scale, .. } | Dist::StudentT { scale, .. } => {
                Some(*scale)
            }
            Dist::Mixture(m) => m.components.first()?.scale(),
            _ => None,
        }
    }

    /// Where the values lie.
    pub fn support(&self) -> Support {
        let reals = |lo, hi| Support::Reals { lo, hi };
        let inf = f64::INFINITY;
        match self {
            Dist::Bernoulli { .. } => Support::Booleans,
            Dist::Categorical(w) => Support::Integers { lo: 0, hi: Some(w.len() as i64 - 1) },
            Dist::DiscreteUniform { lo, hi } => Support::Integers { lo: *lo, hi: Some(*hi) },
            Dist::Poisson { .. } | Dist::Geometric { .. } => Support::Integers { lo: 0, hi: None },
            Dist::Binomial { n, .. } => Support::Integers { lo: 0, hi: Some(*n) },
            Dist::Uniform { lo, hi } | Dist::TruncatedGaussian { lo, hi, .. } => {
                reals(lo.value(), hi.value())
            }
            Dist::Gaussian { .. } | Dist::Laplace { .. } | Dist::Cauchy { .. } | Dist::StudentT { .. } => {
                reals(-inf, inf)
            }
            Dist::LogNormal { .. }
            | Dist::Gamma { .. }
            | Dist::InverseGamma { .. }
            | Dist::Exponential { .. } => reals(0.0, inf),
            Dist::Beta { .. } => reals(0.0, 1.0),
            Dist::VonMises { .. } => reals(-std::f64::consts::PI, std::f64::consts::PI),
            Dist::Dirichlet(a) => Support::Simplex(a.len()),
            Dist::MultivariateGaussian(g) => Support::Vectors(g.mean.len()),
            Dist::Mixture(m) => m.support(),
            Dist::Delta(Draw::Bool(_)) => Support::Booleans,
            Dist::Delta(Draw::Int(i)) => Support::Integers { lo: *i, hi: Some(*i) },
            Dist::Delta(Draw::Real(x)) => reals(x.value(), x.value()),
            Dist::Delta(Draw::Vector(v)) => Support::Vectors(v.len()),
        }
    }

    /// How the density is measured.
    pub(super) fn measure(&self) -> Measure {
        match self {
            Dist::Delta(Draw::Real(_)) => Measure::Points,
            Dist::Delta(Draw::Vector(v)) => Measure::VectorPoints(v.len()),
            Dist::Mixture(m) => m.components[0].measure(),
            _ => match self.support() {
                Support::Booleans => Measure::Booleans,
                Support::Integers { .. } => Measure::Integers,
                Support::Reals { .. } => Measure::Length,
                Support::Simplex(n) => Measure::Simplex(n),
                Support::Vectors(n) => Measure::Volume(n),
            },
        }
    }

    /// Whether both measure their densities alike, so that a ratio of them means something.
    pub fn compares_with(&self, other: &Dist<S>) -> bool {
        self.measure() == other.measure()
    }

    /// Values of `other`, of the same measure, that this distribution visibly never draws, for a message: one of finitely
    /// many, or an end of an interval. What is missing inside an interval is not seen.
    ///
    /// ```
    /// use niwaki_math::Dist;
    /// let (narrow, wide): (Dist, Dist) = (Dist::Uniform { lo: 0.0, hi: 1.0 }, Dist::Gaussian { mean: 0.5, sd: 1.0 });
    /// assert_eq!(narrow.lacks(&wide), Some("numbers below 0".into()));
    /// assert_eq!(wide.lacks(&narrow), None);
    /// ```
    pub fn lacks(&self, other: &Dist<S>) -> Option<String> {
        let low = |lo: &dyn Fn() -> String| Some(format!("numbers below {}", lo()));
        let high = |hi: &dyn Fn() -> String| Some(format!("numbers above {}", hi()));
        let outside = match (self.support(), other.support()) {
            (Support::Integers { lo, .. }, Support::Integers { lo: least, .. }) if least < lo => {
                low(&|| lo.to_string())
            }
            (Support::Integers { hi: Some(hi), .. }, Support::Integers { hi: most, .. })
                if most.is_none_or(|most| most > hi) =>
            {
                high(&|| hi.to_string())
            }
            (Support::Reals { lo, .. }, Support::Reals { lo: least, .. }) if least < lo => {
                low(&|| lo.to_string())
            }
            (Support::Reals { hi, .. }, Support::Reals { hi: most, .. }) if most > hi => {
                high(&|| hi.to_string())
            }
            _ => None,
        };
        let has_gaps = matches!(
            self,
            Dist::Bernoulli { .. }
                | Dist::Categorical(_)
                | Dist::Binomial { .. }
                | Dist::Mixture(_)
                | Dist::Delta(_)
        );
        if outside.is_none() && !has_gaps {
            return None;
        }
        // The ends of a finite support may themselves be impossible, so each of its values is asked for.
        let Some(values) = other.enumerate() else { return outside };
        let missing = values.into_iter().find(|x| self.log_density(x).value() == f64::NEG_INFINITY)?;
        Some(match missing {
            Draw::Bool(b) => if b { "True" } else { "False" }.into(),
            Draw::Int(i) => format!("the value {i}"),
            Draw::Real(x) => format!("the value {}", x.value()),
            Draw::Vector(_) => "a vector".into(),
        })
    }

    /// The values of positive probability, in order, where they are finitely many (up to about a million).
    ///
    /// ```
    /// use niwaki_math::{Dist, Draw};
    /// let coin = Dist::Bernoulli { p: 0.5 };
    /// assert_eq!(coin.enumerate(), Some(vec![Draw::Bool(false), Draw::Bool(true)]));
    /// ```
    pub fn enumerate(&self) -> Option<Vec<Draw<S>>> {
        let (lo, hi) = match self {
            Dist::Bernoulli { p } => {
                let possible = |b: bool| if b { p.value() > 0.0 } else { p.value() < 1.0 };
                return Some([false, true].into_iter().filter(|b| possible(*b)).map(Draw::Bool).collect());
            }
            Dist::Categorical(w) => (0, w.len() as i64 - 1),
            Dist::DiscreteUniform { lo, hi } => (*lo, *hi),
            Dist::Binomial { n, .. } => (0, *n),
            Dist::Delta(value) => return Some(vec![value.clone()]),
            Dist::Mixture(m) => return m.enumerate(),
            _ => return None,
        };
        if hi.checked_sub(lo)? >= LONGEST_LIST {
            return None;
        }
        let possible = |x: &Draw<S>| self.log_density(x).value() > f64::NEG_INFINITY;
        Some((lo..=hi).map(Draw::Int).filter(possible).collect())
    }
}

#[cfg(test)]
mod tests {
    //! Lists hold the possible values and nothing else.
    use super::*;
    use crate::{Family, Param};

    #[test]
    fn lists_leave_out_what_is_impossible() {
        let weights = Param::Vector(vec![0.0, 1.0, 0.0, 2.0]);
        let d: Dist = Dist::new(Family::Categorical, &[weights]).unwrap();
        assert_eq!(d.enumerate(), Some(vec![Draw::Int(1), Draw::Int(3)]));
        assert_eq!(Dist::Bernoulli { p: 1.0 }.enumerate(), Some(vec![Draw::Bool(true)]));
        assert_eq!(Dist::Binomial { n: 5, p: 0.0 }.enumerate(), Some(vec![Draw::Int(0)]));
        assert_eq!(Dist::Poisson { rate: 1.0 }.enumerate(), None);
        assert_eq!(Dist::<f64>::DiscreteUniform { lo: i64::MIN, hi: i64::MAX }.enumerate(), None);
    }

    /// A part that is missing is named; impossible values at the ends are no part.
    #[test]
    fn what_a_distribution_never_draws_is_seen() {
        let weights = |w: &[f64]| Dist::new(Family::Categorical, &[Param::Vector(w.to_vec())]).unwrap();
        let range = |lo, hi| Dist::<f64>::DiscreteUniform { lo, hi };
        let said = |q: Dist, p: Dist| q.lacks(&p);
        assert_eq!(said(weights(&[1.0, 0.0, 1.0]), range(0, 2)).as_deref(), Some("the value 1"));
        assert_eq!(said(range(1, 2), weights(&[0.0, 1.0, 1.0, 0.0])), None);
        assert_eq!(said(range(1, 2), weights(&[0.1, 1.0, 1.0])).as_deref(), Some("the value 0"));
        assert_eq!(said(Dist::Bernoulli { p: 1.0 }, Dist::Bernoulli { p: 0.5 }).as_deref(), Some("False"));
        assert_eq!(said(range(0, 9), Dist::Poisson { rate: 1.0 }).as_deref(), Some("numbers above 9"));
        assert_eq!(said(Dist::Geometric { p: 0.5 }, Dist::Poisson { rate: 1.0 }), None);
        let positive = Dist::Exponential { rate: 1.0 };
        assert_eq!(
            said(positive.clone(), Dist::Gaussian { mean: 0.0, sd: 1.0 }).as_deref(),
            Some("numbers below 0")
        );
        assert_eq!(said(Dist::Beta { a: 1.0, b: 1.0 }, positive.clone()).as_deref(), Some("numbers above 1"));
        assert!(
            !positive.compares_with(&range(0, 1)) && positive.compares_with(&Dist::Beta { a: 1.0, b: 1.0 })
        );
    }
}
