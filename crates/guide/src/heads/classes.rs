//! Finitely many values: a network's outputs are added to the logs of the prior's probabilities.
//!
//! ```text
//! n_k = p_k exp(o_k) / sum_j p_j exp(o_j)
//! ```
//!
//! A value that the prior excludes stays excluded.

use super::Number;

/// The most values that a head can have.
pub(super) const MOST: usize = 64;
/// Largest quotient: a value whose probability is below the smallest float is never drawn.
const LARGEST: f64 = 1e300;

/// The probabilities of all values.
pub(super) struct Classes {
    count: usize,
    /// `p_k`.
    prior: [f64; MOST],
    /// `n_k / p_k`.
    quotient: [f64; MOST],
}

impl Classes {
    /// The probabilities from a network's outputs and the logs of the prior's probabilities.
    pub(super) fn new<N: Number>(outputs: &[N], log_priors: &[f64]) -> Classes {
        let count = log_priors.len().min(outputs.len());
        let (mut prior, mut quotient) = ([0.0; MOST], [0.0; MOST]);
        let mut largest = f64::NEG_INFINITY;
        for k in 0..count {
            prior[k] = log_priors[k].exp();
            if prior[k] > 0.0 {
                largest = largest.max(outputs[k].into());
            }
        }
        let mut sum = 0.0;
        for k in 0..count {
            quotient[k] = (outputs[k].into() - largest).exp().min(LARGEST);
            sum += prior[k] * quotient[k];
        }
        quotient[..count].iter_mut().for_each(|x| *x = (*x / sum).min(LARGEST));
        Classes { count, prior, quotient }
    }

    /// The value at which the running sum of `(1 - share) n + share p` exceeds `u`; never an excluded value.
    pub(super) fn choose(&self, share: f64, u: f64) -> usize {
        let (mut sum, mut last) = (0.0, 0);
        for k in (0..self.count).filter(|k| self.prior[*k] > 0.0) {
            last = k;
            sum += self.prior[k] * self.mixed(k, share);
            if u < sum {
                break;
            }
        }
        last
    }

    /// `q_k / p_k` with this share of the prior.
    fn mixed(&self, k: usize, share: f64) -> f64 {
        (1.0 - share) * self.quotient[k] + share
    }

    /// `ln(q_k / p_k)`, nats. With `slope`, the derivatives by the outputs are added to it.
    pub(super) fn log_quotient(&self, k: usize, share: f64, slope: Option<&mut [f64]>) -> f64 {
        let mixed = self.mixed(k, share);
        if let Some(slope) = slope {
            let scale = (1.0 - share) * self.quotient[k] / mixed;
            slope[k] += scale;
            for (j, slope) in slope[..self.count].iter_mut().enumerate() {
                *slope -= scale * self.prior[j] * self.quotient[j];
            }
        }
        mixed.ln()
    }
}
