//! A distribution over another kind of number.

use super::dist::Dist;
use super::draw::Draw;
use super::mixture::Mixture;
use crate::scalar::Scalar;
use std::sync::Arc;

impl<S: Scalar> Draw<S> {
    /// The same value over another kind of number.
    pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Draw<T> {
        match self {
            Draw::Bool(b) => Draw::Bool(*b),
            Draw::Int(i) => Draw::Int(*i),
            Draw::Real(x) => Draw::Real(number(*x)),
            Draw::Vector(v) => Draw::Vector(v.iter().map(|x| number(*x)).collect()),
        }
    }
}

impl<S: Scalar> Dist<S> {
    /// The same distribution over another kind of number.
    pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Dist<T> {
        match self {
            Dist::Bernoulli { p } => Dist::Bernoulli { p: number(*p) },
            Dist::Categorical(w) => Dist::Categorical(Arc::new(w.convert(number))),
            Dist::DiscreteUniform { lo, hi } => Dist::DiscreteUniform { lo: *lo, hi: *hi },
            Dist::Poisson { rate } => Dist::Poisson { rate: number(*rate) },
            Dist::Binomial { n, p } => Dist::Binomial { n: *n, p: number(*p) },
            Dist::Geometric { p } => Dist::Geometric { p: number(*p) },
            Dist::Uniform { lo, hi } => Dist::Uniform { lo: number(*lo), hi: number(*hi) },
            Dist::Gaussian { mean, sd } => Dist::Gaussian { mean: number(*mean), sd: number(*sd) },
            Dist::LogNormal { mean, sd } => Dist::LogNormal { mean: number(*mean), sd: number(*sd) },
            Dist::Gamma { shape, scale } => Dist::Gamma { shape: number(*shape), scale: number(*scale) },
            Dist::InverseGamma { shape, scale } => {
                Dist::InverseGamma { shape: number(*shape), scale: number(*scale) }
            }
            Dist::Beta { a, b } => Dist::Beta { a: number(*a), b: number(*b) },
            Dist::Exponential { rate } => Dist::Exponential { rate: number(*rate) },
            Dist::Laplace { loc, scale } => Dist::Laplace { loc: number(*loc), scale: number(*scale) },
            Dist::Cauchy { loc, scale } => Dist::Cauchy { loc: number(*loc), scale: number(*scale) },
            Dist::StudentT { df, loc, scale } => {
                Dist::StudentT { df: number(*df), loc: number(*loc), scale: number(*scale) }
            }
            Dist::VonMises { mean, concentration } => {
                Dist::VonMises { mean: number(*mean), concentration: number(*concentration) }
            }
            Dist::TruncatedGaussian { mean, sd, lo, hi } => Dist::TruncatedGaussian {
                mean: number(*mean),
                sd: number(*sd),
                lo: number(*lo),
                hi: number(*hi),
            },
            Dist::Dirichlet(a) => Dist::Dirichlet(a.iter().map(|a| number(*a)).collect()),
            Dist::MultivariateGaussian(g) => Dist::MultivariateGaussian(Arc::new(g.convert(number))),
            Dist::Mixture(m) => Dist::Mixture(Arc::new(Mixture {
                weights: m.weights.convert(number),
                components: m.components.iter().map(|c| c.convert(number)).collect(),
            })),
            Dist::Delta(value) => Dist::Delta(value.convert(number)),
        }
    }
}
