//! Finitely many values: a network's outputs are added to the logs of the prior's probabilities.
//!
//! ```text
//! n_k = p_k exp(o_k) / sum_j p_j exp(o_j)
//! ```
//!
//! A value that the prior excludes stays excluded.

/// The most values that a head can have.
pub(super) const MOST: usize = 64;

/// Log of `n_k / p_k` without its output: minus the log of `sum_j p_j exp(o_j)`.
fn log_norm(outputs: &[f64], log_priors: &[f64]) -> f64 {
    let term = |(o, p): (&f64, &f64)| o + p;
    let terms = || outputs.iter().zip(log_priors).map(term);
    let largest = terms().fold(f64::NEG_INFINITY, f64::max);
    largest + terms().map(|t| (t - largest).exp()).sum::<f64>().ln()
}

/// Log of `n_k / p_k`.
pub(super) fn log_quotient(outputs: &[f64], log_priors: &[f64], k: usize) -> f64 {
    outputs[k] - log_norm(outputs, log_priors)
}

/// Adds `scale` times the derivatives of [`log_quotient`].
pub(super) fn add_slope(outputs: &[f64], log_priors: &[f64], k: usize, scale: f64, slope: &mut [f64]) {
    let norm = log_norm(outputs, log_priors);
    for (j, (o, p)) in outputs.iter().zip(log_priors).enumerate() {
        slope[j] += scale * (f64::from(u8::from(j == k)) - (o + p - norm).exp());
    }
}

/// The value at which the running sum of `(1 - share) n + share p` exceeds `u`; never an excluded one.
pub(super) fn choose(outputs: &[f64], log_priors: &[f64], share: f64, u: f64) -> usize {
    let norm = log_norm(outputs, log_priors);
    let (mut sum, mut last) = (0.0, 0);
    for (k, (o, log_prior)) in outputs.iter().zip(log_priors).enumerate() {
        let p = log_prior.exp();
        if p > 0.0 {
            last = k;
            sum += (1.0 - share) * (o + log_prior - norm).exp() + share * p;
            if u < sum {
                return k;
            }
        }
    }
    last
}
