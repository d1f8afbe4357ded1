//! Rejection sampling: forward runs, kept with probability `exp(log_score - bound)`.

use crate::forward::forward;
use crate::record::AllInvalid;
use crate::run::Run;
use crate::streams::Reserved;
use crate::{Failure, Task};
use niwaki_vm::fault::Fault;

/// The result of rejection sampling.
pub struct Accepted {
    /// The samples.
    pub runs: Vec<Run>,
    /// The number of runs.
    pub tries: u64,
    /// Whether `watch` stopped the search before it had all samples.
    pub interrupted: bool,
}

/// Draw `n` exact samples. No run may score above `bound` nats; the bound of conditions is zero. The search fails after
/// `max_tries` runs. `watch` is called with the number of runs after each run; when it returns false, the samples so far are
/// returned.
///
/// # Errors
/// A run that scores above the bound; too many tries; a fault of the program, also where all runs are invalid.
pub fn rejection(
    task: &Task,
    n: usize,
    bound: f64,
    max_tries: u64,
    seed: u64,
    watch: &mut dyn FnMut(u64) -> bool,
) -> Result<Accepted, Failure> {
    let mut runs = Vec::new();
    let (mut tries, mut all) = (0, AllInvalid::default());
    while runs.len() < n {
        if tries == max_tries {
            all.check()?;
            let accepted = runs.len();
            return Err(Fault::new(
                "rejection-budget",
                format!("{tries} runs gave {accepted} of the {n} samples"),
            )
            .with_help("loosen the conditions, raise `max_tries`, or use particles")
            .into());
        }
        let run = forward(task, seed, tries, false)?;
        all.note(run.invalid.as_ref());
        let log_accept = run.log_score - bound;
        if log_accept > 1e-9 {
            return Err(Fault::new(
                "rejection-bound",
                format!("a run scores {} nats, above the bound of {bound}", run.log_score),
            )
            .with_help("give a bound that no run exceeds")
            .into());
        }
        let u = Reserved::RunAcceptance.stream(seed, u128::from(tries), 0).uniform();
        if u.ln() < log_accept {
            runs.push(run);
        }
        tries += 1;
        if !watch(tries) {
            return Ok(Accepted { runs, tries, interrupted: true });
        }
    }
    Ok(Accepted { runs, tries, interrupted: false })
}
