//! How much each of a target's runs counts in the gradient of a bound of the evidence.
//!
//! Runs `x_1 .. x_K` are drawn by a guide `q`, with `w_k = log p(x_k) - log q(x_k)`, nats. Two bounds of the log evidence, and
//! the weights `a_k` by which `sum of a_k grad log q(x_k)` is an unbiased estimate of the gradient:
//!
//! ```text
//! run        E[w]                             a_k = (w_k - mean of w_j, j != k) / K
//! particles  E[L], L = log mean of exp w_k    a_k = (L - L_-k) - exp(w_k) / sum of exp w_j
//! ```
//!
//! `L_-k` is `L` with the mean of the other `w_j` in place of `w_k`. The first is the score-function gradient with the other
//! runs as its control variate (Kool, van Hoof & Welling 2019), the second VIMCO (Mnih & Rezende 2016, eq. 7 to 10). A
//! baseline must not depend on the run that it is for: otherwise the estimate is biased.

use niwaki_math::log_sums::{log_mean_exp, log_sum_exp};
use serde::Deserialize;

/// What training raises.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Objective {
    /// The density of traces, which searches have found.
    #[default]
    Examples,
    /// The evidence bound of a single run.
    Bound,
    /// The evidence bound of several runs, by their mean weight.
    Particles,
}

/// An impossible run counts so many nats less than the worst possible one of its target: as if it were that much less likely.
/// Its true weight is minus infinity, by which no two guides could be compared.
const BELOW: f64 = 10.0;

/// The log weights of a target's runs, those of impossible ones (minus infinity) replaced by what they count as; `None` where
/// all are impossible.
fn counted(logs: &[f64]) -> Option<Vec<f64>> {
    let possible = logs.iter().copied().filter(|w| w.is_finite());
    let worst = possible.fold(f64::INFINITY, f64::min);
    let count = |w: &f64| if w.is_finite() { *w } else { worst - BELOW };
    worst.is_finite().then(|| logs.iter().map(count).collect())
}

/// How much each of a target's runs counts, from their log weights, nats; zeros where all runs are impossible, or there is
/// only one.
pub fn credit(objective: Objective, logs: &[f64]) -> Vec<f64> {
    let count = logs.len() as f64;
    let Some(w) = counted(logs).filter(|w| w.len() > 1) else { return vec![0.0; logs.len()] };
    let sum: f64 = w.iter().sum();
    let others = |k: usize| (sum - w[k]) / (count - 1.0);
    if objective != Objective::Particles {
        return (0..w.len()).map(|k| (w[k] - others(k)) / count).collect();
    }
    // What is impossible has no weight in the mean, but counts in the baselines of the others.
    let (bound, all) = (log_mean_exp(logs.iter().copied()), log_sum_exp(logs.iter().copied()));
    let one = |k: usize| {
        let without = logs.iter().enumerate().map(|(j, w)| if j == k { others(k) } else { *w });
        bound - log_mean_exp(without) - (logs[k] - all).exp()
    };
    (0..w.len()).map(one).collect()
}

/// The bound of a target's runs, nats: an unbiased estimate, but that impossible runs count as in [`credit`]. `None` where all
/// are impossible.
pub fn bound(objective: Objective, logs: &[f64]) -> Option<f64> {
    match objective {
        Objective::Particles => Some(log_mean_exp(logs.iter().copied())).filter(|log| log.is_finite()),
        _ => counted(logs).map(|w| w.iter().sum::<f64>() / w.len() as f64),
    }
}

#[cfg(test)]
mod tests {
    //! By hand; and no number that is not finite, whatever runs are impossible. The gradient as a whole: `climbing.rs`.
    use super::*;

    const NEVER: f64 = f64::NEG_INFINITY;

    #[test]
    fn weights_by_hand() {
        assert_eq!(credit(Objective::Bound, &[1.0, 4.0, 1.0]), [-0.5, 1.0, -0.5]);
        // exp w = 1 and 3: L = ln 2, without the first ln 3, without the second 0.
        let found = credit(Objective::Particles, &[0.0, 3.0f64.ln()]);
        let exact = [2.0f64.ln() - 3.0f64.ln() - 0.25, 2.0f64.ln() - 0.75];
        assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        assert_eq!(bound(Objective::Bound, &[1.0, 4.0, 1.0]), Some(2.0));
        assert!((bound(Objective::Particles, &[0.0, 3.0f64.ln()]).unwrap() - 2.0f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn impossible_runs_count_less_than_all_others() {
        for objective in [Objective::Bound, Objective::Particles] {
            for logs in [vec![NEVER, -700.0, -2000.0], vec![NEVER, NEVER, -3.0], vec![NEVER, 5.0]] {
                let found = credit(objective, &logs);
                // Among several runs one that is far below the best counts for nothing.
                let least = if objective == Objective::Bound { -1e-9 } else { 0.0 };
                assert!(found.iter().all(|a| a.is_finite()) && found[0] <= least, "{logs:?}: {found:?}");
                assert!(bound(objective, &logs).unwrap().is_finite());
            }
            assert_eq!(credit(objective, &[NEVER, NEVER]), [0.0, 0.0]);
            assert_eq!(bound(objective, &[NEVER, NEVER]), None);
            assert_eq!(credit(objective, &[2.0]), [0.0]);
        }
        assert_eq!(bound(Objective::Bound, &[NEVER, 5.0]), Some(0.0));
    }
}
