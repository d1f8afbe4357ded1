//! Log weights: normalising, means, effective sample size. Sums run in the order of the rows, so that they are
//! the same for any number of threads.

/// Weights relative to the largest, with the log of their mean and the effective sample size.
pub(super) struct Normalised {
    /// `exp(w_i - max)`.
    pub relative: Vec<f64>,
    /// Log of the mean weight, nats.
    pub log_mean: f64,
    /// `(sum w)^2 / sum w^2`, between 1 and the number of particles.
    pub effective: f64,
}

/// `None` when every weight is zero.
pub(super) fn normalise(logs: &[f64]) -> Option<Normalised> {
    let max = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if max == f64::NEG_INFINITY {
        return None;
    }
    let relative: Vec<f64> = logs.iter().map(|w| (w - max).exp()).collect();
    let sum: f64 = relative.iter().sum();
    let squares: f64 = relative.iter().map(|w| w * w).sum();
    let log_mean = max + (sum / logs.len() as f64).ln();
    Some(Normalised { relative, log_mean, effective: sum * sum / squares })
}
