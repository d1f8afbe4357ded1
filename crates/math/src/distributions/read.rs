//! Distributions with tables, from parameters as a model passes them.

use super::bell::HALF_LN_TAU;
use super::check::{BadParameter, Reader};
use super::lists::{DiagonalGaussian, Multinomial};
use super::mixture::Mixture;
use super::vectors::{MultivariateGaussian, cholesky};
use super::weights::Weights;
use crate::scalar::Scalar;

impl<S: Scalar> Multinomial<S> {
    pub(super) fn read(reader: &Reader<'_, S>) -> Result<Self, BadParameter> {
        const EXPECTED: &str = "finite weights, none negative, with a positive finite sum";
        let n = reader.whole(0)?;
        if n < 0 {
            return reader.refuse(0, "a whole number, not negative");
        }
        let weights = reader.vector_where(1, EXPECTED, |w| w >= S::from_f64(0.0))?.to_vec();
        let mut rest = S::from_f64(0.0);
        let mut shares = vec![rest; weights.len()];
        for (share, w) in shares.iter_mut().zip(&weights).rev() {
            rest = rest + *w;
            if w.varies() || w.value() > 0.0 {
                *share = *w / rest;
            }
        }
        if !(rest.value() > 0.0 && rest.is_finite()) {
            return reader.refuse(1, EXPECTED);
        }
        Ok(Multinomial { n, weights, shares })
    }
}

impl<S: Scalar> DiagonalGaussian<S> {
    pub(super) fn read(reader: &Reader<'_, S>) -> Result<Self, BadParameter> {
        const EXPECTED: &str = "finite numbers above zero, as many as `mean` has";
        let mean = reader.vector_where(0, "finite numbers, at least one", |_| true)?.to_vec();
        let sd = reader.vector_where(1, EXPECTED, |x| x > S::from_f64(0.0))?.to_vec();
        if sd.len() != mean.len() {
            return reader.refuse_kind(1, EXPECTED);
        }
        Ok(DiagonalGaussian { mean, sd })
    }
}

impl<S: Scalar> MultivariateGaussian<S> {
    pub(super) fn read(reader: &Reader<'_, S>) -> Result<Self, BadParameter> {
        const SQUARE: &str = "as many rows and columns of finite numbers as `mean` has entries";
        let mean = reader.vector_where(0, "finite numbers, at least one", |_| true)?.to_vec();
        let n = mean.len();
        let covariance = reader.square(1, n, SQUARE)?;
        for i in 0..n {
            for j in 0..i {
                let (a, b) = (covariance[i][j].value(), covariance[j][i].value());
                // A product such as A A' is symmetric only up to rounding.
                if (a - b).abs() > 1e-10 * (covariance[i][i].value() * covariance[j][j].value()).abs().sqrt()
                {
                    return reader.refuse(1, "a symmetric matrix");
                }
            }
        }
        match cholesky(covariance) {
            Some(factor) => {
                let peak = S::from_f64(-HALF_LN_TAU * n as f64);
                let log_peak = factor.iter().enumerate().fold(peak, |sum, (i, row)| sum - row[i].ln());
                Ok(MultivariateGaussian { mean, covariance: covariance.to_vec(), factor, log_peak })
            }
            None => reader.refuse(1, "a positive definite matrix"),
        }
    }
}

impl<S: Scalar> Weights<S> {
    /// Parameter `k` of the reader as weights.
    pub(super) fn read(reader: &Reader<'_, S>, k: usize) -> Result<Self, BadParameter> {
        const EXPECTED: &str = "finite weights, none negative, with a positive finite sum";
        let weights = reader.vector_where(k, EXPECTED, |w| w >= S::from_f64(0.0))?;
        let total = weights.iter().fold(S::from_f64(0.0), |sum, w| sum + *w);
        if !(total.value() > 0.0 && total.is_finite()) {
            return reader.refuse(k, EXPECTED);
        }
        let log_total = total.ln();
        let log = weights.iter().map(|w| w.ln() - log_total).collect();
        let mut sum = 0.0;
        let mut cumulative: Box<[f64]> = weights
            .iter()
            .map(|w| {
                sum += w.value();
                sum / total.value()
            })
            .collect();
        // Rounding may leave the last sum below 1, and trailing zeros must never be drawn.
        let last = weights.iter().rposition(|w| w.value() > 0.0).unwrap_or(0);
        cumulative[last..].fill(1.0);
        Ok(Weights { unscaled: weights.into(), log, cumulative })
    }
}

impl<S: Scalar> Mixture<S> {
    pub(super) fn read(reader: &Reader<'_, S>) -> Result<Self, BadParameter> {
        const EXPECTED: &str = "as many distributions as there are weights";
        let weights = Weights::read(reader, 0)?;
        let components = reader.dists(1, EXPECTED)?;
        if components.len() != weights.len() {
            return reader.refuse_kind(1, EXPECTED);
        }
        if components.iter().any(|c| !c.compares_with(&components[0])) {
            return reader.refuse_kind(1, "distributions over values of one kind");
        }
        Ok(Mixture { weights, components: components.to_vec() })
    }
}
