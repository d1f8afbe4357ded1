//! Importance sampling: independent forward runs, weighted by score and by prior over proposal. Without a proposal the method is
//! likelihood weighting.
//!
//! `w_i = s(x_i) p(x_i) / q(x_i)`, `p(value | score) ~ sum of w_i [value_i = value]`; the evidence is the mean weight.

use crate::guide::bound::Sight;
use crate::proposal::{ByProposal, Proposal};
use niwaki_math::StreamKey;
use niwaki_math::log_sums::log_mean_exp;
use niwaki_run::chooser::Prior;
use niwaki_run::forward::forward_by;
use niwaki_run::record::AllInvalid;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use rayon::prelude::*;

/// Runs between two calls of `watch`.
const BLOCK: u64 = 256;

/// Independent weighted runs.
pub struct Weighted {
    /// The runs, with their weights.
    pub runs: Vec<Run>,
    /// The log of the mean weight, nats. The mean weight is an unbiased estimate of the evidence, unless `watch` stopped the search
    /// because of its results.
    pub log_evidence: f64,
}

/// Run the program `n` times forward, in parallel. `proposal` draws the choices that it covers. `watch` is called regularly with
/// the number of runs; when it returns false, the runs so far are returned.
///
/// # Errors
/// A fault of the program; only invalid runs; only impossible runs; `n` zero.
pub fn importance(
    task: &Task,
    proposal: Option<&Proposal>,
    n: usize,
    seed: u64,
    watch: &mut dyn FnMut(usize) -> bool,
) -> Result<Weighted, Failure> {
    if let Some(proposal) = proposal {
        proposal.check(&task.program)?;
    }
    let run = |i: u64| {
        let stream = StreamKey::new(seed, i, 0);
        match proposal {
            None => forward_by(task, Prior(stream), false),
            Some(proposal) => {
                let sight = &mut Sight::default();
                forward_by(task, ByProposal { proposal, stream, sight, fallback: Prior(stream) }, false)
            }
        }
    };
    let n = n as u64;
    let mut runs = Vec::new();
    while (runs.len() as u64) < n {
        let from = runs.len() as u64;
        let next = (from..n.min(from + BLOCK)).into_par_iter().map(run);
        runs.extend(next.collect::<Result<Vec<_>, _>>()?);
        if !watch(runs.len()) {
            break;
        }
    }
    AllInvalid::check_all(runs.iter().map(|run| run.invalid.as_ref()))?;
    let log_evidence = log_mean_exp(runs.iter().map(|run| run.log_weight));
    if log_evidence == f64::NEG_INFINITY {
        let causes = runs.iter().filter_map(|run| run.cause.as_deref());
        return Err(Failure::impossible(0, causes.map(|cause| (cause, 1))));
    }
    Ok(Weighted { runs, log_evidence })
}

#[cfg(test)]
mod tests {
    use super::*;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use std::sync::Arc;

    #[test]
    fn the_mean_weight_is_the_evidence() {
        // Weights 0, 1 and exp(0.5) with probability 0.5, 0.3, 0.2. Beyond five standard errors once in 1.7 million.
        let text = r#"(module (fn "m" (params) (set $x (sample (dist categorical (list 0.5 0.3 0.2))))
            (do (condition (gt $x 0))) (do (factor (cond (eq $x 2) 0.5 0.0))) (return $x)) (entry "m"))"#;
        let task = Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()));
        let n = 20_000;
        let result = importance(&task, None, n, 1, &mut |_| true).unwrap();
        let (mean, square) = (0.3 + 0.2 * 0.5f64.exp(), 0.3 + 0.2 * 1.0f64.exp());
        let error = ((square - mean * mean) / n as f64).sqrt();
        let z = (result.log_evidence.exp() - mean) / error;
        assert!(result.runs.len() == n && z.abs() < 5.0, "{z}");
    }

    /// Only impossible runs are a failure, which counts the causes; some impossible runs are none.
    #[test]
    fn a_program_with_only_impossible_runs_fails() {
        let result = |low: usize| {
            let text = format!(
                r#"(module (fn "m" (params) (set $x (sample (dist discrete_uniform 0 9)))
                (do (condition (lt $x {low}))) (return $x)) (entry "m"))"#
            );
            let task = Task::new(Arc::new(compile(&parse(&text).unwrap(), vec![]).unwrap()));
            importance(&task, None, 300, 1, &mut |_| true)
        };
        let Err(Failure::Impossible { barrier: 0, causes, .. }) = result(0) else {
            panic!("a run is possible")
        };
        assert_eq!(causes.iter().map(|(_, n)| *n).collect::<Vec<_>>(), [300]);
        assert_eq!(result(1).unwrap().runs.len(), 300);
    }
}
