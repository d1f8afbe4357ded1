//! The fields of distributions: over another kind of number, and as parameters.

use super::draw::{Draw, Param};
use crate::scalar::Scalar;
use std::sync::Arc;

/// A field of a distribution over the numbers `S`.
pub(super) trait Field<S: Scalar> {
    /// The same field over other numbers.
    type Over<T: Scalar>;

    /// The same field over another kind of number.
    fn over<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Self::Over<T>;

    /// The parameters that it holds, in their order.
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
