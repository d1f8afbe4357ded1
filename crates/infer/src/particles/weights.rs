//! Log weights: normalising, means, effective sample size. Sums run in the order of the rows, so that they are
//! the same for any number of threads.

/// Weights relative to the largest, with the log of their mean and the effective sample size.
#[derive(Default)]
pub(super) struct Normalised {
    /// `exp(w_i - max)`.
    pub relative: Vec<f64>,
    /// Log of the mean weight, nats.
    pub log_mean: f64,
    /// `(sum w)^2 / sum w^2`, between 1 and the number of particles.
    pub effective: f64,
}

impl Normalised {
    /// Fills in from log weights; false when every weight is zero.
    pub fn read(&mut self, logs: impl Iterator<Item = f64> + Clone) -> bool {
        let max = logs.clone().fold(f64::NEG_INFINITY, f64::max);
        if max == f64::NEG_INFINITY {
            return false;
        }
        self.relative.clear();
        self.relative.extend(logs.map(|w| (w - max).exp()));
        let (mut sum, mut squares) = (0.0, 0.0);
        for w in &self.relative {
            sum += w;
            squares += w * w;
        }
        self.log_mean = max + (sum / self.relative.len() as f64).ln();
        self.effective = sum * sum / squares;
        true
    }
}
