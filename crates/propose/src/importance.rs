//! Importance sampling: independent forward runs, each weighted by its score and, where a proposal draws choices, by
//! prior over proposal. Without one it is likelihood weighting.
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
    /// Log of the mean weight, nats: an unbiased estimate of the evidence (not of its log), unless `watch` stopped
    /// the search because of its results.
    pub log_evidence: f64,
}

/// `n` forward runs in parallel, some of their choices drawn by `proposal` where there is one. `watch` is called
/// regularly with the number of runs; when it returns false, the runs so far are returned.
///
/// # Errors
/// A fault of the program, or of runs that are all invalid; runs that are all impossible.
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
    let one = |i: u64| {
        let stream = StreamKey::new(seed, i, 0);
        match proposal {
            None => forward_by(task, Prior(stream), false),
            Some(proposal) => {
                let sight = &mut Sight::default();
                forward_by(task, ByProposal { proposal, stream, sight, otherwise: Prior(stream) }, false)
            }
        }
    };
    let n = n as u64;
    let mut runs = Vec::new();
    while (runs.len() as u64) < n {
        let from = runs.len() as u64;
        let next = (from..n.min(from + BLOCK)).into_par_iter().map(one);
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
    //! The claim: the mean weight is the evidence, with runs that are impossible.
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
        let found = importance(&task, None, n, 1, &mut |_| true).unwrap();
        let (mean, square) = (0.3 + 0.2 * 0.5f64.exp(), 0.3 + 0.2 * 1.0f64.exp());
        let error = ((square - mean * mean) / n as f64).sqrt();
        let z = (found.log_evidence.exp() - mean) / error;
        assert!(found.runs.len() == n && z.abs() < 5.0, "{z}");
    }

    /// The claim: runs that are all impossible are a failure, which counts what made them impossible; some are not.
    #[test]
    fn runs_that_are_all_impossible_are_a_failure() {
        let found = |low: usize| {
            let text = format!(
                r#"(module (fn "m" (params) (set $x (sample (dist discrete_uniform 0 9)))
                (do (condition (lt $x {low}))) (return $x)) (entry "m"))"#
            );
            let task = Task::new(Arc::new(compile(&parse(&text).unwrap(), vec![]).unwrap()));
            importance(&task, None, 300, 1, &mut |_| true)
        };
        let Err(Failure::Impossible { barrier: 0, causes, .. }) = found(0) else {
            panic!("a run is possible")
        };
        assert_eq!(causes.iter().map(|(_, n)| *n).collect::<Vec<_>>(), [300]);
        assert_eq!(found(1).unwrap().runs.len(), 300);
    }
}
