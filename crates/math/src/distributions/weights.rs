//! The table of weights behind categorical and mixture.
//!
//! Weights need not sum to one. Logarithms and running sums are computed once, when the table is built. So
//! a score is a look-up, and a draw needs one uniform and a search.

use crate::scalar::Scalar;
use crate::streams::{RngCore, open_unit};

/// Weights of the choices 0, 1, ..., n - 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights<S: Scalar = f64> {
    /// The weights before scaling, as the model passed them.
    pub(super) unscaled: Box<[S]>,
    /// Log probabilities, nats.
    pub(super) log: Box<[S]>,
    /// Running sums of the probabilities; from the last possible choice on exactly 1.
    pub(super) cumulative: Box<[f64]>,
}

impl<S: Scalar> Weights<S> {
    /// The number of choices.
    pub fn len(&self) -> usize {
        self.log.len()
    }

    /// Always false: a table has at least one choice.
    pub fn is_empty(&self) -> bool {
        self.log.is_empty()
    }

    /// The weights before scaling, as the model passed them.
    pub fn unscaled(&self) -> &[S] {
        &self.unscaled
    }

    /// Running sums of the probabilities; from the last possible choice on exactly 1.
    pub(super) fn cumulative(&self) -> &[f64] {
        &self.cumulative
    }

    /// Log probability of choice `k`, nats; minus infinity if there is no such choice.
    #[inline]
    pub fn log_probability(&self, k: i64) -> S {
        match usize::try_from(k).ok().and_then(|k| self.log.get(k)) {
            Some(log) => *log,
            None => S::from_f64(f64::NEG_INFINITY),
        }
    }

    /// The first choice whose running sum exceeds a uniform; never a choice of weight zero.
    #[inline]
    pub fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> usize {
        let u = open_unit(rng);
        if self.cumulative.len() <= 16 {
            // The sums never fall, so all are compared: the processor has no jump to predict.
            self.cumulative.iter().filter(|sum| **sum <= u).count()
        } else {
            self.cumulative.partition_point(|sum| *sum <= u)
        }
    }
}

#[cfg(test)]
mod tests {
    //! Draws follow the weights, whatever the weights sum to, and choices of weight zero are never drawn.
    use super::super::testing::*;
    use crate::{Dist, Draw, Family, Param};

    fn categorical(weights: &[f64]) -> Dist {
        Dist::new(Family::Categorical, &[Param::Vector(weights.to_vec())]).unwrap()
    }

    #[test]
    fn draws_follow_the_weights() {
        discrete_agrees(&categorical(&[5.0]), 0..=0);
        discrete_agrees(&categorical(&[0.1, 0.2, 0.7]), 0..=2);
        discrete_agrees(&categorical(&[0.0, 3.0, 0.0, 1.0, 0.0]), 0..=4);
        let many: Vec<f64> = (0..100).map(|k| f64::from(k % 7)).collect();
        discrete_agrees(&categorical(&many), 0..=99);
    }

    #[test]
    fn indices_outside_have_no_probability() {
        let d = categorical(&[1.0, 1.0]);
        for x in [Draw::Int(-1), Draw::Int(2), Draw::Int(i64::MAX), Draw::Real(0.5)] {
            assert_eq!(d.log_density(&x), f64::NEG_INFINITY);
        }
    }

    #[test]
    fn weights_without_a_sum_are_refused() {
        for bad in [vec![], vec![0.0, 0.0], vec![1.0, -0.5], vec![f64::NAN], vec![f64::MAX, f64::MAX]] {
            let refused = Dist::new(Family::Categorical, &[Param::Vector(bad)]).unwrap_err();
            assert_eq!(refused.parameter, "weights");
        }
    }
}
