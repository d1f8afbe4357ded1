//! mixture: one of several distributions, chosen by weights.
//!
//! ```text
//! density(x) = sum_k w_k density_k(x)
//! ```
//!
//! All components must have the same kind of value with the same measure: the density of a coin or a fixed
//! value cannot be compared with that of a Gaussian.

use super::draw::Draw;
use super::family::Dist;
use super::support::Support;
use super::weights::Weights;
use crate::log_sums::log_sum_exp_of;
use crate::scalar::Scalar;
use crate::streams::RngCore;

/// Weighted components.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixture<S: Scalar = f64> {
    /// Weights, one for each component.
    pub weights: Weights<S>,
    /// Components.
    pub components: Vec<Dist<S>>,
}

impl<S: Scalar> Mixture<S> {
    /// `ln sum exp(ln w_k + ln density_k(x))`, relative to the largest term.
    #[inline(never)]
    pub fn log_density(&self, x: &Draw<S>) -> S {
        let term = |(k, c): (usize, &Dist<S>)| self.weights.log_probability(k as i64) + c.log_density(x);
        log_sum_exp_of(self.components.iter().enumerate().map(term))
    }

    /// A draw from a random component.
    #[inline(never)]
    pub fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> Draw<S> {
        self.components[self.weights.sample(rng)].sample(rng)
    }

    /// The components that can be chosen, with these weights or with other values of recorded weights.
    fn possible(&self) -> impl Iterator<Item = &Dist<S>> {
        let is_possible =
            |k: usize| self.weights.unscaled()[k].varies() || self.weights.unscaled()[k].value() > 0.0;
        self.components.iter().enumerate().filter(move |(k, _)| is_possible(*k)).map(|(_, c)| c)
    }

    /// The smallest support in bounds that covers all components.
    pub(super) fn support(&self) -> Support<S> {
        let supports = self.possible().map(|c| c.support().in_bounds());
        supports.reduce(Support::cover).unwrap_or(Support::Booleans)
    }

    /// The values of all components, each listed once.
    pub(super) fn enumerate(&self) -> Option<Vec<Draw<S>>> {
        let mut values: Vec<Draw<S>> = Vec::new();
        for component in self.possible() {
            for value in component.enumerate()? {
                if !values.contains(&value) {
                    values.push(value);
                }
            }
        }
        Some(values)
    }
}

#[cfg(test)]
mod tests {
    //! Mixtures are sums, draw from their components, and refuse components of different kinds.
    use super::super::testing::*;
    use crate::{BadParameter, Dist, Draw, Family, Param};

    fn mixture(weights: &[f64], components: Vec<Dist>) -> Result<Dist, BadParameter> {
        Dist::new(Family::Mixture, &[Param::Vector(weights.to_vec()), Param::Dists(components)])
    }

    #[test]
    fn draws_follow_the_density() {
        let peaks = vec![dist(Family::Gaussian, &[-2.0, 0.5]), dist(Family::Gaussian, &[4.0, 1.0])];
        continuous_agrees(&mixture(&[3.0, 1.0], peaks).unwrap(), -10.0, 16.0);
        let counts = vec![Dist::DiscreteUniform { lo: 0, hi: 3 }, dist(Family::Poisson, &[6.0])];
        discrete_agrees(&mixture(&[0.5, 0.5], counts).unwrap(), 0..=60);
    }

    #[test]
    fn far_from_every_component_the_density_is_still_finite() {
        let far = vec![dist(Family::Gaussian, &[0.0, 1.0]), dist(Family::Gaussian, &[1.0, 1.0])];
        let d = mixture(&[0.5, 0.5], far).unwrap();
        assert!((d.log_density(&Draw::Real(1000.0)) + 499_001.4).abs() < 1.0);
        let gap = vec![dist(Family::Uniform, &[0.0, 1.0]), dist(Family::Uniform, &[2.0, 3.0])];
        let d = mixture(&[0.0, 1.0], gap).unwrap();
        assert_eq!(d.log_density(&Draw::Real(0.5)), f64::NEG_INFINITY);
        assert_eq!(d.log_density(&Draw::Real(2.5)), 0.0);
    }

    #[test]
    fn values_of_finite_mixtures_are_listed_once() {
        let parts = vec![Dist::DiscreteUniform { lo: 0, hi: 2 }, Dist::DiscreteUniform { lo: 2, hi: 3 }];
        let values = mixture(&[1.0, 1.0], parts).unwrap().enumerate().unwrap();
        assert_eq!(values, (0..4).map(Draw::Int).collect::<Vec<_>>());
    }

    #[test]
    fn components_of_different_kinds_are_refused() {
        let delta = Dist::Delta(Draw::Real(0.0));
        let spike = mixture(&[1.0, 1.0], vec![delta, dist(Family::Gaussian, &[0.0, 1.0])]);
        assert_eq!(spike.unwrap_err().expected, "distributions over values of one kind");
        assert_eq!(mixture(&[1.0], vec![]).unwrap_err().parameter, "components");
    }
}
