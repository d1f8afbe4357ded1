//! The fields of distributions: their conversion to another kind of number, and their parameters.

use super::draw::Draw;
use super::lists::{DiagonalGaussian, Multinomial};
use super::mixture::Mixture;
use super::param::Param;
use super::vectors::MultivariateGaussian;
use super::weights::Weights;
use crate::scalar::Scalar;
use std::sync::Arc;

/// A field of a distribution over the numbers `S`.
pub(super) trait Field<S: Scalar> {
    /// The type of the field over other numbers.
    type Over<T: Scalar>;

    /// Converts the field to another kind of number.
    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Self::Over<T>;

    /// The parameters that the field holds, in order.
    fn params(&self) -> Vec<Param<S>>;
}

impl<S: Scalar> Field<S> for S {
    type Over<T: Scalar> = T;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> T {
        number(*self)
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Real(*self)]
    }
}

impl<S: Scalar> Field<S> for i64 {
    type Over<T: Scalar> = i64;

    fn over<T: Scalar>(&self, _: &impl Fn(S) -> T) -> i64 {
        *self
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Int(*self)]
    }
}

impl<S: Scalar> Field<S> for Arc<[S]> {
    type Over<T: Scalar> = Arc<[T]>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Arc<[T]> {
        self.iter().map(|x| number(*x)).collect()
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Vector(self.to_vec())]
    }
}

impl<S: Scalar> Field<S> for Draw<S> {
    type Over<T: Scalar> = Draw<T>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Draw<T> {
        self.convert(number)
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Draw(self.clone())]
    }
}

impl<S: Scalar, P: Field<S>> Field<S> for Arc<P> {
    type Over<T: Scalar> = Arc<P::Over<T>>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Self::Over<T> {
        Arc::new((**self).over(number))
    }

    fn params(&self) -> Vec<Param<S>> {
        (**self).params()
    }
}

impl<S: Scalar> Field<S> for Multinomial<S> {
    type Over<T: Scalar> = Multinomial<T>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Multinomial<T> {
        let all = |xs: &[S]| xs.iter().map(|x| number(*x)).collect();
        Multinomial { n: self.n, weights: all(&self.weights), shares: all(&self.shares) }
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Int(self.n), Param::Vector(self.weights.clone())]
    }
}

impl<S: Scalar> Field<S> for DiagonalGaussian<S> {
    type Over<T: Scalar> = DiagonalGaussian<T>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> DiagonalGaussian<T> {
        let all = |xs: &[S]| xs.iter().map(|x| number(*x)).collect();
        DiagonalGaussian { mean: all(&self.mean), sd: all(&self.sd) }
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Vector(self.mean.clone()), Param::Vector(self.sd.clone())]
    }
}

impl<S: Scalar> Field<S> for MultivariateGaussian<S> {
    type Over<T: Scalar> = MultivariateGaussian<T>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> MultivariateGaussian<T> {
        let all = |xs: &Vec<S>| xs.iter().map(|x| number(*x)).collect::<Vec<_>>();
        MultivariateGaussian {
            mean: all(&self.mean),
            covariance: self.covariance.iter().map(all).collect(),
            factor: self.factor.iter().map(all).collect(),
            log_peak: number(self.log_peak),
        }
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Vector(self.mean.clone()), Param::Matrix(self.covariance.clone())]
    }
}

impl<S: Scalar> Field<S> for Weights<S> {
    type Over<T: Scalar> = Weights<T>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Weights<T> {
        Weights {
            unscaled: self.unscaled.iter().map(|w| number(*w)).collect(),
            log: self.log.iter().map(|w| number(*w)).collect(),
            cumulative: self.cumulative.clone(),
        }
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Vector(self.unscaled.to_vec())]
    }
}

impl<S: Scalar> Field<S> for Mixture<S> {
    type Over<T: Scalar> = Mixture<T>;

    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Mixture<T> {
        let components = self.components.iter().map(|c| c.convert(number)).collect();
        Mixture { weights: self.weights.over(number), components }
    }

    fn params(&self) -> Vec<Param<S>> {
        vec![Param::Vector(self.weights.unscaled().to_vec()), Param::Dists(self.components.clone())]
    }
}
