//! Exact enumeration: every value of every choice, by forking the run at each.
//!
//! `p(outcome, score) = sum over runs of exp(log_prior + log_score)`, an outcome being the program's value.
//!
//! A program with too many runs, or with endlessly many, can be enumerated in part: the branch with the largest joint
//! probability so far goes on first, until so many runs have been visited. The prior probability of what is left is known
//! exactly, and where a run's later scores are bounded, so is what it could add to the evidence.

mod frontier;

use crate::Failure;
use crate::chooser::{Chooser, Chosen, Context};
use crate::forward::Forward;
use crate::record::{AllInvalid, Record};
use crate::task::Task;
use frontier::{Branch, Frontier, Next};
use niwaki_math::log_sums::log_sum_exp;
use niwaki_math::{Dist, Support};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::{Value, repr};
use std::collections::HashMap;

/// The exact distribution of a program's value.
pub struct Enumerated {
    /// Outcomes in order of first appearance, with their unnormalised log probabilities, nats.
    pub outcomes: Vec<(Value, f64)>,
    /// Log of their sum: the evidence, or of a part of the runs a lower bound of it.
    pub log_evidence: f64,
    /// How many complete runs were visited.
    pub runs: usize,
    /// The prior probability of the runs that were not.
    pub unseen: f64,
    /// Log of the most that they add to the evidence, nats.
    pub log_unseen: f64,
}

/// What to visit.
#[derive(Clone, Copy, Debug)]
pub enum Visit {
    /// All runs; more than so many are a failure.
    All(usize),
    /// So many, the likeliest branches first.
    Likely {
        /// How many.
        runs: usize,
        /// The most that the rest of a run adds to its log score, nats.
        rest: f64,
    },
}

/// Gives the next choice its value. At the choice after it the run pauses, with all values of that choice.
struct Branching {
    next: Option<Chosen>,
    open: Vec<Next>,
    /// Whether values may be endlessly many.
    endless: bool,
}

impl Chooser for Branching {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        if self.next.is_some() {
            return Ok(self.next.take());
        }
        let Some(draws) = dist.enumerate() else {
            if let (true, Support::Integers { lo, hi: None }) = (self.endless, dist.support()) {
                self.open.push(Next::From { dist: dist.clone(), value: lo, left: 1.0 });
                return Ok(None);
            }
            return Err(not_enumerable(&at.path()));
        };
        for draw in draws {
            let log = dist.log_density(&draw);
            if log > f64::NEG_INFINITY {
                self.open.push(Next::Value(Chosen::from_prior(draw, log)));
            }
        }
        Ok(None)
    }
}

/// The fault of a choice whose values are not finitely many.
#[cold]
pub fn not_enumerable(path: &str) -> Fault {
    Fault::new("not-enumerable", format!("the choice `{path}` has no finite list of values"))
        .with_help("use particles or importance sampling for continuous and unbounded choices")
}

/// The fault of a program with more runs than this.
#[cold]
pub fn too_many(max_runs: usize) -> Fault {
    let message = format!("the program has more than {max_runs} runs, the impossible ones included");
    Fault::new("too-many-runs", message)
        .with_help("enumerate the likeliest of them (`likely=True`), or use particles")
}

/// Enumerates every run of the program, at most `max_runs`, impossible ones included; see [`visit`].
///
/// # Errors
/// As for [`visit`].
pub fn enumerate(
    task: &Task,
    max_runs: usize,
    watch: &mut dyn FnMut(usize) -> bool,
) -> Result<Enumerated, Failure> {
    visit(task, Visit::All(max_runs), watch)
}

/// Visits runs of the program. `watch` is called with the number of runs after each; when it returns false, the search stops:
/// without a result where all runs are to be visited, else with what it has.
///
/// # Errors
/// A choice that cannot be enumerated, more runs than allowed, runs that are all impossible, or a fault of the program: also
/// of runs that are all invalid.
pub fn visit(task: &Task, what: Visit, watch: &mut dyn FnMut(usize) -> bool) -> Result<Enumerated, Failure> {
    let mut machine = task.machine();
    let mut open = Frontier::new(what);
    open.push(Branch {
        state: task.start(&machine, true)?,
        record: Record::start(&task.sketches),
        next: Next::Start,
    });
    let (endless, rest) = match what {
        Visit::All(_) => (false, 0.0),
        Visit::Likely { rest, .. } => (true, rest),
    };
    let mut outcomes: Vec<(Value, Vec<f64>)> = Vec::new();
    let mut index: HashMap<String, usize> = HashMap::new();
    // Complete runs, and with them those that are impossible, which may be far more.
    let (mut runs, mut met, mut all) = (0, 0, AllInvalid::default());
    let mut causes: HashMap<String, usize> = HashMap::new();
    while let Some(mut branch) = open.pop() {
        let next = match branch.next {
            Next::Start => None,
            Next::Value(chosen) => Some(chosen),
            Next::From { dist, value, left } => {
                let log = dist.log_density_of_int(value);
                let chosen = Chosen::from_prior(Value::Int(value), log);
                let others = left - log.exp();
                if let (true, Some(value)) = (others > 0.0, value.checked_add(1)) {
                    let next = Next::From { dist, value, left: others };
                    open.push(Branch { state: branch.state.clone(), record: branch.record.fork(), next });
                }
                if log > f64::NEG_INFINITY {
                    open.push(Branch { next: Next::Value(chosen), ..branch });
                }
                continue;
            }
        };
        let hosts = &*task.hosts;
        let (record, chooser) = (&mut branch.record, Branching { next, open: Vec::new(), endless });
        let mut answers =
            Forward { record, chooser, log_ratio: 0.0, hosts, barriers: false, complete: false };
        answers.run(task, &mut machine, &mut branch.state)?;
        let values = answers.chooser.open;
        let is_run = branch.record.cause.is_some() || branch.state.has_ended();
        if is_run {
            met += 1;
            if let Visit::All(max_runs) = what
                && met > max_runs
            {
                return Err(too_many(max_runs).into());
            }
        }
        // Reversed, so that outcomes appear in the order of the values.
        for next in values.into_iter().rev() {
            open.push(Branch { state: branch.state.clone(), record: branch.record.fork(), next });
        }
        if let Some(cause) = branch.record.cause {
            all.note(branch.record.invalid.as_ref());
            *causes.entry(cause).or_insert(0) += 1;
        } else if branch.state.has_ended() {
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
        let enough = matches!(what, Visit::Likely { runs, .. } if met >= runs);
        if is_run && !watch(met) {
            match what {
                Visit::All(_) => {
                    return Err(Fault::new("out-of-time", format!("stopped after {met} runs")).into());
                }
                Visit::Likely { .. } => break,
            }
        }
        if enough {
            break;
        }
    }
    let (unseen, log_unseen) = open.unseen(rest);
    let outcomes: Vec<(Value, f64)> =
        outcomes.into_iter().map(|(v, logs)| (v, log_sum_exp(logs.into_iter()))).collect();
    if outcomes.is_empty() {
        if unseen > 0.0 {
            return Err(Fault::new("too-many-runs", format!("none of the {met} likeliest runs is possible"))
                .with_help("visit more of them, or use particles")
                .into());
        }
        all.check()?;
        return Err(Failure::impossible(0, causes.iter().map(|(cause, n)| (cause.as_str(), *n))));
    }
    let log_evidence = log_sum_exp(outcomes.iter().map(|o| o.1));
    Ok(Enumerated { outcomes, log_evidence, runs, unseen, log_unseen })
}

#[cfg(test)]
mod tests {
    use super::*;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use std::sync::Arc;

    /// The claim: a program whose every run is impossible has no distribution. It is a failure that counts what made them impossible.
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
        let possible = text.replace("(lt $x 0)", "(lt $x 1)");
        let task = Task::new(Arc::new(compile(&parse(&possible).unwrap(), vec![]).unwrap()));
        let found = enumerate(&task, 100, &mut |_| true).unwrap();
        assert!(found.runs == 1 && (found.log_evidence - 0.1f64.ln()).abs() < 1e-9);
    }

    fn likely(text: &str, runs: usize) -> Enumerated {
        let task = Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()));
        visit(&task, Visit::Likely { runs, rest: 0.0 }, &mut |_| true).unwrap()
    }

    /// A geometric recursion, whose runs are endlessly many: run `n` has probability 2^-n, and each heads halves its score.
    const ENDLESS: &str = r#"(module (fn "m" (params $n)
        (if (sample (dist bernoulli 0.5)) (then (do (factor -0.6931471805599453)) (return (call "m" (add $n 1)))) (else (return $n))))
        (fn "main" (params) (return (call "m" 0))) (entry "main"))"#;

    /// The claim: the likeliest runs come first; what is left has exactly the prior probability and the joint probability
    /// that the laws say: 2^-n and 4^-n.
    #[test]
    fn a_part_of_endlessly_many_runs_is_bounded() {
        for n in [1, 2, 5, 20] {
            let found = likely(ENDLESS, n);
            let values: Vec<String> = found.outcomes.iter().map(|(value, _)| repr(value).unwrap()).collect();
            assert_eq!(values, (0..n).map(|i| i.to_string()).collect::<Vec<_>>());
            assert!((found.unseen - 0.5f64.powi(n as i32)).abs() < 1e-9);
            // The rest of a run adds at most nothing: its branch has the score of the heads before it. Sums are exact to
            // parts of 2^-32, so each flip may add such an error.
            assert!((found.log_unseen - (n as f64 * 0.25f64.ln() + 2f64.ln())).abs() < 1e-8 * n as f64);
            let whole = (2.0f64 / 3.0).ln();
            assert!(found.log_evidence <= whole + 1e-8);
            assert!(log_sum_exp([found.log_evidence, found.log_unseen].into_iter()) >= whole - 1e-8);
        }
    }

    /// The claim: whole numbers without a bound are listed, and the tail is what is left.
    #[test]
    fn a_poisson_number_is_listed() {
        let text = r#"(module (fn "m" (params) (return (sample (dist poisson 3.0)))) (entry "m"))"#;
        let found = likely(text, 12);
        let law = Dist::Poisson { rate: 3.0 };
        let mut left = 1.0;
        for (value, log) in &found.outcomes {
            let Value::Int(n) = value else { panic!("{value:?}") };
            assert!((log - law.log_density_of_int(*n)).abs() < 1e-9);
            left -= log.exp();
        }
        assert!(found.outcomes.len() == 12 && (found.unseen - left).abs() < 1e-9 && left > 0.0);
    }

    /// The claim: where branches are given up their probability stays in the bounds; a program with few runs is whole.
    #[test]
    fn what_is_given_up_is_counted() {
        let text = r#"(module (fn "m" (params) (set $s 0) (for $i (range 14) (body
            (set $s (add $s (sample (dist discrete_uniform 0 1)))))) (return $s)) (entry "m"))"#;
        let found = likely(text, 10);
        let seen: f64 = found.outcomes.iter().map(|(_, log)| log.exp()).sum();
        assert!(found.runs == 10 && (seen - 10.0 / 16384.0).abs() < 1e-12, "{seen}");
        assert!((found.unseen + seen - 1.0).abs() < 1e-9, "{}", found.unseen);
        let whole = likely(text, 20_000);
        assert!(whole.runs == 16384 && whole.unseen == 0.0 && whole.log_unseen == f64::NEG_INFINITY);
    }
}
