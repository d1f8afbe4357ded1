//! The families a model may draw from: density, support, sampler and parameter checks of each.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `family` | the table: [`Family`] and [`Dist`], names, parameters, and where values lie: [`Space`] |
//! | `draw`, `param` | outputs and inputs: [`Draw`], [`Param`] |
//! | `check`, `read` | reading parameters, and the error of a wrong one: [`BadParameter`] |
//! | `fields` | fields of distributions: over another kind of number, and as parameters |
//! | `dist` | what each family does: building, scoring, drawing |
//! | `support` | where the values of a distribution lie: [`Support`] |
//! | `listing` | the values of the finite discrete families |
//! | `ends` | the last numbers of 64 bits inside an interval, and what each stands for |
//! | `coordinates` | real numbers with bounds as numbers without, and small moves there: [`Interval`] |
//! | `whole` | bernoulli, discrete_uniform, geometric |
//! | `counts` | numbers of events |
//! | `ranks` | where a whole number stands in its distribution, as a normal score |
//! | `weights` | categorical, and the table of weights that mixtures share |
//! | `tables` | categorical distributions side by side, for many draws |
//! | `bell` | gaussian, and what becomes one by a logarithm |
//! | `truncated` | truncated_gaussian |
//! | `waiting` | waiting times |
//! | `interval` | families over an interval |
//! | `tails` | families with heavier tails than the bell curve's |
//! | `circle` | von_mises |
//! | `vectors` | dirichlet, multivariate_gaussian |
//! | `lists` | multinomial, multivariate_bernoulli, diagonal_gaussian |
//! | `mixture` | mixture |
//!
//! Conventions. Densities are natural logarithms, in nats, with respect to counting (bool, int, lists of them, delta) or
//! length, area, ... (real, vector); minus infinity outside the support. A sampler computes in `f64` with
//! bits from the given source only, so its draws do not depend on the scalar. Where a draw would fall off the
//! range of `f64` (a log-normal that overflows, a gamma that underflows) it is the nearest finite number
//! inside the support: see `ends`. No log density is NaN or plus infinity (tested with parameters from 1e-120 to 1e120). At an
//! end of its interval, or a corner of the simplex, a density is its limit there: zero, or a number, as the rate of an
//! exponential or the 1 of `beta(1, 1)`. Where the limit is infinite, the end is outside.

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
