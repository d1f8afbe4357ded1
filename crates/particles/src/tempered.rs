//! Resampling by tempered weights: a particle is drawn by a power of its weight, and its copies carry the rest.
//!
//! After a barrier few particles may have nearly all of the weight. Plain resampling keeps only these, and what looked
//! worse at this moment is lost, although it may be what fits best in the end. Here particle `i` of weight `W_i` gets
//! `N r_i` copies in expectation, and each copy starts with the weight `V_i`:
//!
//! ```text
//! r_i = W_i^b / sum_j W_j^b                       0 < b <= 1
//! V_i = W_i / (mean(W) N r_i) = (W_i / mean(W)) / (W_i^b / mean(W^b))
//! ```
//!
//! The estimate of the normalising constant is multiplied by `mean(W)`, as at any resampling. For every function `f` of
//! a particle the expectation over the copies, given the particles, is what it was before:
//!
//! ```text
//! E[ mean(W) / N  sum over copies V f ] = mean(W) / N  sum_i N r_i V_i f_i = 1 / N  sum_i W_i f_i
//! ```
//!
//! So evidence and final law stay right for every rule that chooses `b` by the weights (Liu, Chen & Logvinenko 2001, "A
//! theoretical framework for sequential importance sampling with resampling"). `V` is one where `b` is one: plain
//! resampling.
//!
//! The rule: the largest `b` at which the effective sample size `(sum W^b)^2 / sum W^(2 b)` is half of the particles that
//! are possible. It falls as `b` grows: the derivative of its log is twice the mean log weight under `W^b` less that
//! under `W^(2 b)`. Impossible particles do not count. If they did, a constraint that kills most particles would need a `b`
//! of zero, and the others would not be selected at all.

use niwaki_run::weights::Normalised;

/// The effective sample size at the power, as a share of the possible particles.
const SHARE: f64 = 0.5;
/// Weights that differ by at most this, nats, have an effective sample size of half or more: for two values with the
/// ratio `x`, the worst shares of them give `4 x / (1 + x)^2` (Kantorovich), which is a half at `x = 3 - sqrt(8)`.
const EVEN: f64 = 1.762;
/// Halvings of the interval of `log b`.
const HALVINGS: u32 = 16;

/// Weights to a power below one.
pub(super) struct Tempered {
    /// `b`.
    power: f64,
    /// `W^b`.
    pub weights: Normalised,
}

impl Tempered {
    /// Temper log weights, of which at least one is possible; `None` where the power is one.
    pub fn of(logs: impl Iterator<Item = f64> + Clone) -> Option<Tempered> {
        let possible = logs.clone().filter(|w| *w > f64::NEG_INFINITY);
        let enough = SHARE * possible.clone().count() as f64;
        let mut weights = Normalised::default();
        let mut effective = |power: f64| {
            weights.read(logs.clone().map(|w| power * w));
            weights.effective
        };
        if effective(1.0) >= enough {
            return None;
        }
        let (least, most) =
            possible.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), w| (a.min(w), b.max(w)));
        let (mut low, mut high) = (EVEN / (most - least), 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::sqrt(low * high);
            if effective(middle) >= enough { low = middle } else { high = middle }
        }
        effective(low);
        Some(Tempered { power: low, weights })
    }

    /// `log V` of a particle's copies, nats, from its log weight and the log of the mean weight.
    pub fn carried(&self, log_weight: f64, log_mean: f64) -> f64 {
        (1.0 - self.power) * log_weight - log_mean + self.weights.log_mean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tempered(logs: &[f64]) -> Option<Tempered> {
        Tempered::of(logs.iter().copied())
    }

    /// At any size and spread of the weights, with impossible particles and without.
    #[test]
    fn half_of_the_possible_particles_are_effective() {
        let ramp: Vec<f64> = (0..40).map(|i| -f64::from(i)).collect();
        for spread in [0.1, 1.0, 1e3, 1e6] {
            for shift in [0.0, -1e5, 1e5] {
                for dead in [0, 60] {
                    let spread_logs = ramp.iter().map(|w| spread * w + shift);
                    let logs: Vec<f64> =
                        spread_logs.chain([f64::NEG_INFINITY; 60].into_iter().take(dead)).collect();
                    let effective = tempered(&logs).unwrap().weights.effective;
                    assert!((effective - 20.0).abs() < 0.01, "{spread}, {shift}, {dead}: {effective}");
                }
            }
        }
    }

    #[test]
    fn weights_of_which_half_are_effective_are_not_tempered() {
        assert!(tempered(&[0.0; 8]).is_none() && tempered(&[-3.0]).is_none());
        assert!(tempered(&[5.0, -9.0]).is_none());
        assert!(tempered(&[0.0, 0.0, -99.0, -99.0]).is_none());
        assert!(tempered(&[0.0, f64::NEG_INFINITY, f64::NEG_INFINITY]).is_none());
        assert!(tempered(&[0.0, 0.0, 0.0, -EVEN, -EVEN, -EVEN]).is_none());
        assert!(tempered(&[0.0, -99.0, -99.0]).is_some());
    }

    /// By the module's formulas: what all expected copies carry is what their particle weighed, relative to the mean.
    #[test]
    fn copies_carry_what_they_were_not_drawn_by() {
        let logs = [0.0, -4.0, -9.0, f64::NEG_INFINITY, -5.0];
        let mut weights = Normalised::default();
        weights.read(logs.into_iter());
        let resampling = tempered(&logs).unwrap();
        let total: f64 = resampling.weights.relative.iter().sum();
        for (i, log) in logs.into_iter().enumerate() {
            let copies = 5.0 * resampling.weights.relative[i] / total;
            let carried = copies * resampling.carried(log, weights.log_mean).exp();
            assert!((carried - (log - weights.log_mean).exp()).abs() < 1e-12, "{i}: {carried}");
        }
    }
}
