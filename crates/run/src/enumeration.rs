//! Exact enumeration: the run is forked at each choice, for every value of the choice.
//!
//! `p(outcome, score) = sum over runs of exp(log_prior + log_score)`, where an outcome is a value of the program.
//!
//! A program with too many or infinitely many runs can be enumerated in part: the branch with the largest joint probability
//! resumes first, until a given number of runs have been visited. The prior probability of all other runs is known exactly.
//! Where later scores are bounded, the evidence of the other runs is bounded, too.

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
    /// Log of the sum of the outcomes: the evidence, or its lower bound where runs were not visited.
    pub log_evidence: f64,
    /// The number of complete runs that were visited.
    pub runs: usize,
    /// The prior probability of the runs that were not visited.
    pub unseen: f64,
    /// The log of the most that unvisited runs add to the evidence, nats.
    pub log_unseen: f64,
}

/// The runs that an enumeration visits.
#[derive(Clone, Copy, Debug)]
pub enum Visit {
    /// All runs. More runs than this number are a failure.
    All(usize),
    /// The runs of the most probable branches.
    Likely {
        /// The number of runs.
        runs: usize,
        /// The most that the remainder of a run adds to its log score, nats.
        rest: f64,
    },
}

/// Chooser that gives the next choice its value, and pauses the run at the choice after it with all values of that choice.
struct Branching {
    next: Option<Chosen>,
    open: Vec<Next>,
    /// Whether a choice may have infinitely many values.
    endless: bool,
}

impl Chooser for Branching {
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        if self.next.is_some() {
            return Ok(self.next.take());
        }
        let Some(draws) = dist.enumerate() else {
            if let (true, Support::Integers { lo, hi: None }) = (self.endless, dist.support()) {
                self.open.push(Next::From { dist: dist.clone(), value: lo, tail: 1.0 });
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

/// Enumerate every run of the program. `max_runs` limits the number of runs, including impossible runs.
///
/// # Errors
/// The errors of [`visit`].
pub fn enumerate(
    task: &Task,
    max_runs: usize,
    watch: &mut dyn FnMut(usize) -> bool,
) -> Result<Enumerated, Failure> {
    visit(task, Visit::All(max_runs), watch)
}

/// Visit runs of the program. `watch` is called with the number of runs after each run. When it returns false, [`Visit::All`]
/// fails and [`Visit::Likely`] returns the outcomes so far.
///
/// # Errors
/// A choice that cannot be enumerated, too many runs, only impossible runs, or a fault of the program, also where all runs are
/// invalid.
pub fn visit(
    task: &Task,
    extent: Visit,
    watch: &mut dyn FnMut(usize) -> bool,
) -> Result<Enumerated, Failure> {
    let mut machine = task.machine();
    let mut open = Frontier::new(extent);
    open.push(Branch {
        state: task.start(&machine, true)?,
        record: Record::start(&task.sketches),
        next: Next::Start,
    });
    let (endless, rest) = match extent {
        Visit::All(_) => (false, 0.0),
        Visit::Likely { rest, .. } => (true, rest),
    };
    let mut outcomes: Vec<(Value, Vec<f64>)> = Vec::new();
    let mut index: HashMap<String, usize> = HashMap::new();
    // `met` counts impossible runs as well, which may be far more than the complete runs.
    let (mut runs, mut met, mut all) = (0, 0, AllInvalid::default());
    let mut causes: HashMap<String, usize> = HashMap::new();
    while let Some(mut branch) = open.pop() {
        let next = match branch.next {
            Next::Start => None,
            Next::Value(chosen) => Some(chosen),
            Next::From { dist, value, tail } => {
                let log = dist.log_density_of_int(value);
                let chosen = Chosen::from_prior(Value::Int(value), log);
                let tail = tail - log.exp();
                if let (true, Some(value)) = (tail > 0.0, value.checked_add(1)) {
                    let next = Next::From { dist, value, tail };
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
            if let Visit::All(max_runs) = extent
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
        let enough = matches!(extent, Visit::Likely { runs, .. } if met >= runs);
        if is_run && !watch(met) {
            match extent {
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
    let (unseen, log_unseen) = open.unvisited(rest);
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

    /// Programs with only impossible runs fail; the failure counts the causes.
    #[test]
    fn a_program_with_only_impossible_runs_fails() {
        let text = r#"(module (fn "m" (params) (set $x (sample (dist discrete_uniform 0 9)))
            (do (condition (lt $x 3))) (do (condition (lt $x 0))) (return $x)) (entry "m"))"#;
        let task = Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()));
        let causes = |failure: Option<Failure>| match failure {
            Some(Failure::Impossible { barrier: 0, causes, .. }) => {
                causes.into_iter().map(|(_, n)| n).collect::<Vec<_>>()
            }
            failure => panic!("{failure:?}"),
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
        let result = enumerate(&task, 100, &mut |_| true).unwrap();
        assert!(result.runs == 1 && (result.log_evidence - 0.1f64.ln()).abs() < 1e-9);
    }

    fn likely(text: &str, runs: usize) -> Enumerated {
        let task = Task::new(Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap()));
        visit(&task, Visit::Likely { runs, rest: 0.0 }, &mut |_| true).unwrap()
    }

    /// A geometric recursion with infinitely many runs: run `n` has probability 2^-n, and each heads halves its score.
    const ENDLESS: &str = r#"(module (fn "m" (params $n)
        (if (sample (dist bernoulli 0.5)) (then (do (factor -0.6931471805599453)) (return (call "m" (add $n 1)))) (else (return $n))))
        (fn "main" (params) (return (call "m" 0))) (entry "main"))"#;

    /// The most probable runs come first. Unvisited runs have the exact prior probability 2^-n and joint probability 4^-n.
    #[test]
    fn unvisited_runs_are_bounded() {
        for n in [1, 2, 5, 20] {
            let result = likely(ENDLESS, n);
            let values: Vec<String> = result.outcomes.iter().map(|(value, _)| repr(value).unwrap()).collect();
            assert_eq!(values, (0..n).map(|i| i.to_string()).collect::<Vec<_>>());
            assert!((result.unseen - 0.5f64.powi(n as i32)).abs() < 1e-9);
            // A later score is at most zero: a branch has the score of the heads before it. Sums are rounded to multiples of
            // 2^-32, so each flip may add such an error.
            assert!((result.log_unseen - (n as f64 * 0.25f64.ln() + 2f64.ln())).abs() < 1e-8 * n as f64);
            let whole = (2.0f64 / 3.0).ln();
            assert!(result.log_evidence <= whole + 1e-8);
            assert!(log_sum_exp([result.log_evidence, result.log_unseen].into_iter()) >= whole - 1e-8);
        }
    }

    /// Whole numbers without an upper bound are listed; the probability of the tail is exact.
    #[test]
    fn a_poisson_number_is_listed() {
        let text = r#"(module (fn "m" (params) (return (sample (dist poisson 3.0)))) (entry "m"))"#;
        let result = likely(text, 12);
        let law = Dist::Poisson { rate: 3.0 };
        let mut tail = 1.0;
        for (value, log) in &result.outcomes {
            let Value::Int(n) = value else { panic!("{value:?}") };
            assert!((log - law.log_density_of_int(*n)).abs() < 1e-9);
            tail -= log.exp();
        }
        assert!(result.outcomes.len() == 12 && (result.unseen - tail).abs() < 1e-9 && tail > 0.0);
    }

    /// Dropped branches count as unvisited; a program with few runs is enumerated completely.
    #[test]
    fn dropped_branches_count_as_unvisited() {
        let text = r#"(module (fn "m" (params) (set $s 0) (for $i (range 14) (body
            (set $s (add $s (sample (dist discrete_uniform 0 1)))))) (return $s)) (entry "m"))"#;
        let result = likely(text, 10);
        let seen: f64 = result.outcomes.iter().map(|(_, log)| log.exp()).sum();
        assert!(result.runs == 10 && (seen - 10.0 / 16384.0).abs() < 1e-12, "{seen}");
        assert!((result.unseen + seen - 1.0).abs() < 1e-9, "{}", result.unseen);
        let whole = likely(text, 20_000);
        assert!(whole.runs == 16384 && whole.unseen == 0.0 && whole.log_unseen == f64::NEG_INFINITY);
    }
}
