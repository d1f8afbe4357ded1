//! Credits: the weights of a target's runs in the gradient of a bound of the evidence.
//!
//! Runs `x_1 .. x_K` are drawn by a guide `q`, with `w_k = log p(x_k) - log q(x_k)`, nats. The table has two bounds of the log
//! evidence, and weights `a_k` for which `sum of a_k grad log q(x_k)` is an unbiased estimate of the gradient:
//!
//! ```text
//! run        E[w]                             a_k = (w_k - mean of w_j, j != k) / K
//! particles  E[L], L = log mean of exp w_k    a_k = (L - L_-k) - exp(w_k) / sum of exp w_j
//! ```
//!
//! `L_-k` is `L` with the mean of the other `w_j` in place of `w_k`. The first row is the score-function gradient with the other
//! runs as its control variate (Kool, van Hoof & Welling 2019), the second VIMCO (Mnih & Rezende 2016, eq. 7 to 10). The
//! baseline of a run must not depend on this run, or the estimate is biased.

use niwaki_math::log_sums::{log_mean_exp, log_sum_exp};
use serde::Deserialize;

/// The quantity that training raises.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Objective {
    /// The density of traces from searches.
    #[default]
    Examples,
    /// The evidence bound of a single run.
    Bound,
    /// The evidence bound of several runs, by their mean weight.
    Particles,
}

/// Difference in nats between the worst possible run of a target and an impossible run, which counts as that much less likely.
/// Its true weight is minus infinity, by which no two guides could be compared.
const BELOW: f64 = 10.0;

/// The log weights of a target's runs, with replacements for impossible runs (minus infinity); `None` if
/// all are impossible.
fn finite_logs(logs: &[f64]) -> Option<Vec<f64>> {
    let possible = logs.iter().copied().filter(|w| w.is_finite());
    let worst = possible.fold(f64::INFINITY, f64::min);
    let count = |w: &f64| if w.is_finite() { *w } else { worst - BELOW };
    worst.is_finite().then(|| logs.iter().map(count).collect())
}

/// The weight of each of a target's runs, from their log weights, nats; zeros if all runs are impossible, or there is
/// only one.
pub fn credit(objective: Objective, logs: &[f64]) -> Vec<f64> {
    let count = logs.len() as f64;
    let Some(w) = finite_logs(logs).filter(|w| w.len() > 1) else { return vec![0.0; logs.len()] };
    let sum: f64 = w.iter().sum();
    let mean_of_rest = |k: usize| (sum - w[k]) / (count - 1.0);
    if objective != Objective::Particles {
        return (0..w.len()).map(|k| (w[k] - mean_of_rest(k)) / count).collect();
    }
    // An impossible run has no weight in the mean, but counts in the baselines of the other runs.
    let (bound, all) = (log_mean_exp(logs.iter().copied()), log_sum_exp(logs.iter().copied()));
    let weight = |k: usize| {
        let without = logs.iter().enumerate().map(|(j, w)| if j == k { mean_of_rest(k) } else { *w });
        bound - log_mean_exp(without) - (logs[k] - all).exp()
    };
    (0..w.len()).map(weight).collect()
}

/// The bound of a target's runs, nats: an unbiased estimate, except that impossible runs count as in [`credit`]. `None` if all
/// are impossible.
pub fn bound(objective: Objective, logs: &[f64]) -> Option<f64> {
    match objective {
        Objective::Particles => Some(log_mean_exp(logs.iter().copied())).filter(|log| log.is_finite()),
        _ => finite_logs(logs).map(|w| w.iter().sum::<f64>() / w.len() as f64),
    }
}

#[cfg(test)]
mod tests {
    //! Weights agree with results by hand, and are finite for any impossible runs. `climbing.rs` tests the whole gradient.
    use super::*;

    const NEVER: f64 = f64::NEG_INFINITY;

    #[test]
    fn weights_agree_with_results_by_hand() {
        assert_eq!(credit(Objective::Bound, &[1.0, 4.0, 1.0]), [-0.5, 1.0, -0.5]);
        // exp w = 1 and 3: L = ln 2, without the first ln 3, without the second 0.
        let weights = credit(Objective::Particles, &[0.0, 3.0f64.ln()]);
        let exact = [2.0f64.ln() - 3.0f64.ln() - 0.25, 2.0f64.ln() - 0.75];
        assert!(weights.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{weights:?}");
        assert_eq!(bound(Objective::Bound, &[1.0, 4.0, 1.0]), Some(2.0));
        assert!((bound(Objective::Particles, &[0.0, 3.0f64.ln()]).unwrap() - 2.0f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn impossible_runs_count_less_than_all_others() {
        for objective in [Objective::Bound, Objective::Particles] {
            for logs in [vec![NEVER, -700.0, -2000.0], vec![NEVER, NEVER, -3.0], vec![NEVER, 5.0]] {
                let weights = credit(objective, &logs);
                // A run far below the best of several has no weight.
                let least = if objective == Objective::Bound { -1e-9 } else { 0.0 };
                assert!(
                    weights.iter().all(|a| a.is_finite()) && weights[0] <= least,
                    "{logs:?}: {weights:?}"
                );
                assert!(bound(objective, &logs).unwrap().is_finite());
            }
            assert_eq!(credit(objective, &[NEVER, NEVER]), [0.0, 0.0]);
            assert_eq!(bound(objective, &[NEVER, NEVER]), None);
            assert_eq!(credit(objective, &[2.0]), [0.0]);
        }
        assert_eq!(bound(Objective::Bound, &[NEVER, 5.0]), Some(0.0));
    }
}
