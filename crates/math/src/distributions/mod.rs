//! The families a model may draw from: density, support, sampler and parameter checks of each.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `family` | the table: [`Family`] and [`Dist`], names, parameters, and spaces of values: [`Space`] |
//! | `draw`, `param` | outputs and inputs: [`Draw`], [`Param`] |
//! | `check`, `read` | reading parameters, and the error of a bad parameter: [`BadParameter`] |
//! | `fields` | fields of distributions: conversion to another kind of number, and parameters |
//! | `dist` | what each family does: building, scoring, drawing |
//! | `support` | the set of a distribution's values: [`Support`] |
//! | `listing` | the values of the finite discrete families |
//! | `ends` | the last numbers of 64 bits inside an interval, and the numbers for which they stand |
//! | `coordinates` | real numbers with bounds as numbers without bounds, and small moves there: [`Interval`] |
//! | `whole` | bernoulli, discrete_uniform, geometric |
//! | `counts` | numbers of events |
//! | `ranks` | ranks of whole numbers in their distributions, as normal scores |
//! | `weights` | categorical, and the table of weights that mixtures share |
//! | `tables` | categorical distributions side by side, for many draws |
//! | `bell` | gaussian, and log_normal, whose logarithm is gaussian |
//! | `truncated` | truncated_gaussian |
//! | `waiting` | waiting times |
//! | `interval` | families over an interval |
//! | `tails` | families with heavier tails than the bell curve |
//! | `circle` | von_mises |
//! | `vectors` | dirichlet, multivariate_gaussian |
//! | `lists` | multinomial, multivariate_bernoulli, diagonal_gaussian |
//! | `mixture` | mixture |
//!
//! Conventions. Densities are natural logarithms, in nats, with respect to counting (bool, int, lists of them, delta) or
//! Conventions. Densities are natural logarithms, in nats, with respect to counting (bool, int, lists of them, delta) or
//! length, area, ... (real, vector); minus infinity outside the support. A sampler computes in `f64` with
//! bits of its source alone, so its draws do not depend on the scalar. A draw out of the range of `f64` (a log-normal
//! that overflows, a gamma that underflows) becomes the nearest finite number
//! inside the support: see `ends`. No log density is NaN or plus infinity (tested with parameters from 1e-120 to 1e120). At an
//! end of its interval, or a corner of the simplex, a density is its limit there: zero, or a number, as the rate of an
//! exponential or the 1 of `beta(1, 1)`. If the limit is infinite, the end is outside.

mod bell;
mod check;
mod circle;
mod coordinates;
mod counts;
mod dist;
mod draw;
mod ends;
mod family;
mod fields;
mod interval;
mod listing;
mod lists;
mod mixture;
mod param;
mod ranks;
mod read;
mod space;
mod support;
mod tables;
mod tails;
mod truncated;
mod vectors;
mod waiting;
mod weights;
mod whole;

#[cfg(test)]
mod testing;

pub use check::BadParameter;
pub use coordinates::{Interval, Placed, logistic};
pub use draw::Draw;
pub use ends::{COORDINATES, LEAST};
pub use family::{Dist, Family, MOST_NUMBERS, Parameter};
pub use lists::{DiagonalGaussian, Multinomial};
pub use mixture::Mixture;
pub use param::Param;
pub use space::Space;
pub use support::Support;
pub use tables::Tables;
pub use vectors::MultivariateGaussian;
pub use weights::Weights;
