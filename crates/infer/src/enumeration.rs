//! Exact enumeration: every value of every choice, by forking the run at each.
//!
//! `p(outcome, score) = sum over runs of exp(log_prior + log_score)`, an outcome being the program's value.

use crate::Failure;
use crate::chooser::{Chooser, Chosen, Context};
use crate::forward::Forward;
use crate::record::{AllInvalid, Record};
use crate::task::Task;
use niwaki_math::Dist;
use niwaki_math::log_sums::log_sum_exp;
use niwaki_vm::builtins::draw_to_value;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::state::State;
use niwaki_vm::value::{Value, repr};
use std::collections::HashMap;

/// The exact distribution of a program's value.
pub struct Enumerated {
    /// Outcomes in order of first appearance, with their unnormalised log probabilities, nats.
    pub outcomes: Vec<(Value, f64)>,
    /// Log of their sum: the evidence.
    pub log_evidence: f64,
    /// How many complete runs there are.
    pub runs: usize,
}

/// A run up to an open choice, and the value that it goes on with.
struct Branch {
    state: State,
    record: Record,
    next: Option<Chosen>,
}

/// Gives the next choice its value. At the choice after it the run pauses, with all values of that choice.
struct Branching {
    next: Option<Chosen>,
    open: Vec<Chosen>,
}

impl Chooser for Branching {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        if self.next.is_some() {
            return Ok(self.next.take());
        }
        let Some(draws) = dist.enumerate() else {
            return Err(Fault::new(
                "not-enumerable",
                format!("the choice `{}` has no finite list of values", at.path()),
            )
            .with_help("use particles or importance sampling for continuous and unbounded choices"));
        };
        for draw in draws {
            let log = dist.log_density(&draw);
            if log > f64::NEG_INFINITY {
                self.open.push(Chosen { value: draw_to_value(draw), log_prior: log, log_drawn: log });
            }
        }
        Ok(None)
    }
}

/// Enumerates every run of the program, at most `max_runs`, impossible ones included. `watch` is called with the
/// number of runs after each; when it returns false, the search stops without a result.
///
/// # Errors
/// A choice that cannot be enumerated, more runs than allowed, runs that are all impossible, or a fault of the program: also
/// of distributions, where they are invalid in every run.
pub fn enumerate(
    task: &Task,
    max_runs: usize,
    watch: &mut dyn FnMut(usize) -> bool,
) -> Result<Enumerated, Failure> {
    let mut machine = task.machine();
    let first = task.start(&machine, true)?;
    let mut open = vec![Branch { state: first, record: Record::start(&task.sketches), next: None }];
    let mut outcomes: Vec<(Value, Vec<f64>)> = Vec::new();
    let mut index: HashMap<String, usize> = HashMap::new();
    // Complete runs, and with them those that are impossible, which may be far more.
    let (mut runs, mut met, mut all) = (0, 0, AllInvalid::default());
    let mut causes: HashMap<String, usize> = HashMap::new();
    while let Some(mut branch) = open.pop() {
        let hosts = &*task.hosts;
        let (record, chooser) = (&mut branch.record, Branching { next: branch.next, open: Vec::new() });
        let mut answers =
            Forward { record, chooser, log_ratio: 0.0, hosts, barriers: false, complete: false };
        answers.run(task, &mut machine, &mut branch.state)?;
        let values = answers.chooser.open;
        if branch.record.cause.is_some() || branch.state.has_ended() {
            met += 1;
            if met > max_runs {
                return Err(Fault::new(
                    "too-many-runs",
                    format!("the program has more than {max_runs} runs, the impossible ones included"),
                )
                .with_help("enumerate a smaller program, or use particles")
                .into());
            }
            if !watch(met) {
                return Err(Fault::new("out-of-time", format!("stopped after {met} runs")).into());
            }
        }
        if let Some(cause) = branch.record.cause {
            all.note(branch.record.invalid.as_ref());
            *causes.entry(cause).or_insert(0) += 1;
            continue;
        }
        // Reversed, so that outcomes appear in the order of the values.
        for next in values.into_iter().rev() {
            open.push(Branch { state: branch.state.clone(), record: branch.record.fork(), next: Some(next) });
        }
        if branch.state.has_ended() {
            runs += 1;
            all.note(None);
            let value = branch.state.result();
            let log_joint = branch.record.log_prior.plus(&branch.record.score()).value();
            let key = repr(&value)?;
            let at = *index.entry(key).or_insert_with(|| {
                outcomes.push((value, Vec::new()));
                outcomes.len() - 1
            });
            outcomes[at].1.push(log_joint);
        }
    }
    let outcomes: Vec<(Value, f64)> =
        outcomes.into_iter().map(|(v, logs)| (v, log_sum_exp(logs.into_iter()))).collect();
    if outcomes.is_empty() {
        all.check()?;
        return Err(Failure::impossible(0, causes.iter().map(|(cause, n)| (cause.as_str(), *n))));
    }
    let log_evidence = log_sum_exp(outcomes.iter().map(|o| o.1));
    Ok(Enumerated { outcomes, log_evidence, runs })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::importance::importance;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use std::sync::Arc;

    /// The claim: a program whose every run is impossible has no distribution and no weighted runs. It is a failure that
    /// counts what made them impossible.
    #[test]
    fn runs_that_are_all_impossible_are_a_failure() {
        let text = r#"(module (fn "m" (params) (set $x (sample (dist discrete_uniform 0 9)))
            (do (condition (lt $x 3))) (do (condition (lt $x 0))) (return $x)) (entry "m"))"#;
        let task = Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()));
        let causes = |failure: Option<Failure>| match failure {
            Some(Failure::Impossible { barrier: 0, causes, .. }) => {
                causes.into_iter().map(|(_, n)| n).collect::<Vec<_>>()
            }
            other => panic!("{other:?}"),
        };
        // Both conditions are in line 0.
        assert_eq!(causes(enumerate(&task, 10, &mut |_| true).err()), [10]);
        let fault = enumerate(&task, 9, &mut |_| true).err();
        assert!(matches!(fault, Some(Failure::Setting(fault)) if fault.code == "too-many-runs"));
        let mut seen = 0;
        assert!(
            enumerate(&task, 100, &mut |n| {
                seen = n;
                n < 4
            })
            .is_err()
                && seen == 4
        );
        assert_eq!(causes(importance(&task, None, 300, 1, &mut |_| true).err()), [300]);
        let possible = text.replace("(lt $x 0)", "(lt $x 1)");
        let task = Task::new(Arc::new(compile(&parse(&possible).unwrap(), vec![]).unwrap()));
        let found = enumerate(&task, 100, &mut |_| true).unwrap();
        assert!(found.runs == 1 && (found.log_evidence - 0.1f64.ln()).abs() < 1e-9);
        assert_eq!(importance(&task, None, 300, 1, &mut |_| true).unwrap().runs.len(), 300);
    }
}
