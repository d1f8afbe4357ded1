//! Lists of the values of finite distributions, and values of one distribution that another lacks.

use super::coordinates::Interval;
use super::draw::Draw;
use super::family::Dist;
use super::lists::truths;
use super::support::Support;
use crate::scalar::Scalar;

/// Lists with more values are not enumerated.
const LONGEST_LIST: i64 = 1 << 20;

impl<S: Scalar> Dist<S> {
    /// The length of the values of a family of vectors.
    pub fn dimension(&self) -> Option<usize> {
        self.support().dimension()
    }

    /// Whether both densities have the same measure (counting, or length, area, ...), so that their ratio is defined
    /// and they can be mixed.
    pub fn compares_with(&self, other: &Dist<S>) -> bool {
        let (a, b) = (self.support().in_bounds(), other.support().in_bounds());
        std::mem::discriminant(&a) == std::mem::discriminant(&b) && a.dimension() == b.dimension()
    }

    /// Values of `other`, of the same measure, that this distribution certainly never draws, as text for a message: a value
    /// of finitely many, or an end of an interval. Gaps inside an interval are not detected.
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
        let outside =
            match (self.support().in_bounds(), other.support().in_bounds()) {
                (Support::Integers { lo, .. }, Support::Integers { lo: least, .. }) if least < lo => {
                    low(&|| lo.to_string())
                }
                (Support::Integers { hi: Some(hi), .. }, Support::Integers { hi: most, .. })
                    if most.is_none_or(|most| most > hi) =>
                {
                    high(&|| hi.to_string())
                }
                (
                    Support::Reals(Interval { lo: Some(lo), .. }),
                    Support::Reals(Interval { lo: least, .. }),
                ) if least.is_none_or(|least| least.value() < lo.value()) => low(&|| lo.value().to_string()),
                (
                    Support::Reals(Interval { hi: Some(hi), .. }),
                    Support::Reals(Interval { hi: most, .. }),
                ) if most.is_none_or(|most| most.value() > hi.value()) => high(&|| hi.value().to_string()),
                _ => None,
            };
        let has_gaps = matches!(
            self,
            Dist::Bernoulli { .. }
                | Dist::Categorical(_)
                | Dist::Binomial { .. }
                | Dist::Multinomial(_)
                | Dist::MultivariateBernoulli(_)
                | Dist::Mixture(_)
                | Dist::Delta(_)
        );
        if outside.is_none() && !has_gaps {
            return None;
        }
        // The ends of a finite support may be impossible, so each value is tested.
        let Some(values) = other.enumerate() else { return outside };
        let missing = values.into_iter().find(|x| self.log_density(x).value() == f64::NEG_INFINITY)?;
        Some(match missing {
            Draw::Bool(b) => if b { "True" } else { "False" }.into(),
            Draw::Int(i) => format!("the value {i}"),
            Draw::Real(x) => format!("the value {}", x.value()),
            Draw::Vector(_) => "a vector".into(),
            list @ (Draw::Counts(_) | Draw::Truths(_)) => format!("the value {list}"),
        })
    }

    /// The values of positive probability, in order, if there are finitely many (up to about a million). Over recorded
    /// numbers the list includes values whose probability is zero here but varies.
    ///
    /// ```
    /// use niwaki_math::{Dist, Draw};
    /// let coin = Dist::Bernoulli { p: 0.5 };
    /// assert_eq!(coin.enumerate(), Some(vec![Draw::Bool(false), Draw::Bool(true)]));
    /// ```
    pub fn enumerate(&self) -> Option<Vec<Draw<S>>> {
        let possible = |x: &Draw<S>| {
            let log = self.log_density(x);
            log.varies() || log.value() > f64::NEG_INFINITY
        };
        let (lo, hi) = match (self, self.support().in_bounds()) {
            (Dist::Delta(value), _) => return Some(vec![value.clone()]),
            (Dist::Mixture(m), _) => return m.enumerate(),
            (Dist::Multinomial(m), _) => {
                let lists = m.enumerate(LONGEST_LIST.unsigned_abs())?;
                let draws = lists.into_iter().map(|list| Draw::Counts(list.into()));
                return Some(draws.filter(possible).collect());
            }
            (_, Support::Truths(n)) => {
                let lists = truths(n, LONGEST_LIST.unsigned_abs())?;
                let draws = lists.into_iter().map(|list| Draw::Truths(list.into()));
                return Some(draws.filter(possible).collect());
            }
            (_, Support::Booleans) => {
                return Some([false, true].map(Draw::Bool).into_iter().filter(possible).collect());
            }
            (_, Support::Integers { lo, hi: Some(hi) }) => (lo, hi),
            (_, Support::Integers { hi: None, .. } | Support::Categories(_) | Support::Points { .. })
            | (_, Support::Reals(_) | Support::Circle)
            | (_, Support::Simplex(_) | Support::Vectors(_) | Support::VectorPoints(_))
            | (_, Support::Counts(_)) => return None,
        };
        if hi.checked_sub(lo)? >= LONGEST_LIST {
            return None;
        }
        Some((lo..=hi).map(Draw::Int).filter(possible).collect())
    }
}

#[cfg(test)]
mod tests {
    //! Lists hold exactly the possible values.
    use super::*;
    use crate::{Family, Param};

    #[test]
    fn lists_omit_impossible_values() {
        let weights = Param::Vector(vec![0.0, 1.0, 0.0, 2.0]);
        let d: Dist = Dist::new(Family::Categorical, &[weights]).unwrap();
        assert_eq!(d.enumerate(), Some(vec![Draw::Int(1), Draw::Int(3)]));
        assert_eq!(Dist::Bernoulli { p: 1.0 }.enumerate(), Some(vec![Draw::Bool(true)]));
        assert_eq!(Dist::Binomial { n: 5, p: 0.0 }.enumerate(), Some(vec![Draw::Int(0)]));
        assert_eq!(Dist::Poisson { rate: 1.0 }.enumerate(), None);
        assert_eq!(Dist::<f64>::DiscreteUniform { lo: i64::MIN, hi: i64::MAX }.enumerate(), None);
    }

    /// Messages name the missing values; impossible values at the ends do not count.
    #[test]
    fn values_that_are_never_drawn_are_reported() {
        let weights = |w: &[f64]| Dist::new(Family::Categorical, &[Param::Vector(w.to_vec())]).unwrap();
        let range = |lo, hi| Dist::<f64>::DiscreteUniform { lo, hi };
        let lacking = |q: Dist, p: Dist| q.lacks(&p);
        assert_eq!(lacking(weights(&[1.0, 0.0, 1.0]), range(0, 2)).as_deref(), Some("the value 1"));
        assert_eq!(lacking(range(1, 2), weights(&[0.0, 1.0, 1.0, 0.0])), None);
        assert_eq!(lacking(range(1, 2), weights(&[0.1, 1.0, 1.0])).as_deref(), Some("the value 0"));
        assert_eq!(lacking(Dist::Bernoulli { p: 1.0 }, Dist::Bernoulli { p: 0.5 }).as_deref(), Some("False"));
        assert_eq!(lacking(range(0, 9), Dist::Poisson { rate: 1.0 }).as_deref(), Some("numbers above 9"));
        assert_eq!(lacking(Dist::Geometric { p: 0.5 }, Dist::Poisson { rate: 1.0 }), None);
        let positive = Dist::Exponential { rate: 1.0 };
        assert_eq!(
            lacking(positive.clone(), Dist::Gaussian { mean: 0.0, sd: 1.0 }).as_deref(),
            Some("numbers below 0")
        );
        assert_eq!(
            lacking(Dist::Beta { a: 1.0, b: 1.0 }, positive.clone()).as_deref(),
            Some("numbers above 1")
        );
        assert!(
            !positive.compares_with(&range(0, 1)) && positive.compares_with(&Dist::Beta { a: 1.0, b: 1.0 })
        );
    }
}
