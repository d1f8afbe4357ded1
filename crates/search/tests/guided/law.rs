//! The exact evidence and posterior of a program: discrete choices are enumerated, continuous ones integrated by the
//! midpoint rule.

use super::LIMIT;
use niwaki_math::Dist;
use niwaki_run::Task;
use niwaki_run::chooser::{Chooser, Chosen, Context};
use niwaki_run::forward::forward_by;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::{Value, repr};
use std::collections::BTreeMap;

/// Points of a continuous choice.
const POINTS: usize = 320;
/// Values of a count.
const COUNTS: usize = 20;

/// The evidence and the distribution of a program's value.
pub struct Law {
    pub log_evidence: f64,
    /// The shares of values that are not rare.
    pub shares: Vec<(String, f64)>,
}

/// A value of a choice by number, with the log of its probability.
type Visited<'a> = Box<dyn Fn(usize) -> (Value, f64) + 'a>;

/// The number of values of a choice to visit, and the function that gives them.
fn values(dist: &Dist) -> (usize, Visited<'_>) {
    if let Some(draws) = dist.enumerate() {
        let all = draws.into_iter().map(|draw| (Value::from(draw.clone()), dist.log_density(&draw)));
        let all: Vec<(Value, f64)> = all.collect();
        return (all.len(), Box::new(move |at| all[at].clone()));
    }
    let (low, high) = match dist {
        Dist::Uniform { lo, hi } => (*lo, *hi),
        Dist::Gaussian { mean, sd } => (mean - 7.0 * sd, mean + 7.0 * sd),
        Dist::Beta { .. } => (0.0, 1.0),
        Dist::Gamma { shape, scale } => (0.0, scale * (shape + 18.0)),
        _ => return (COUNTS, Box::new(|at| (Value::Int(at as i64), dist.log_density_of_int(at as i64)))),
    };
    let step = (high - low) / POINTS as f64;
    let value = move |at: usize| {
        let x = low + (at as f64 + 0.5) * step;
        (Value::Real(x), dist.log_density_of_real(x) + step.ln())
    };
    (POINTS, Box::new(value))
}

/// Gives the choices of a run the values with these numbers, and stops at the next one.
struct Visiting<'a> {
    numbers: &'a [usize],
    at: usize,
    log: f64,
    open: Option<usize>,
}

impl Chooser for &mut Visiting<'_> {
    fn choose(&mut self, _: &At<'_, f64>, dist: &Dist, _: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let (count, value) = values(dist);
        let Some(number) = self.numbers.get(self.at) else {
            self.open = Some(count);
            return Ok(None);
        };
        let (value, log) = value(*number);
        self.at += 1;
        self.log += log;
        Ok(Some(Chosen { value, log_prior: log, log_drawn: log }))
    }
}

impl Law {
    /// The law of a task.
    pub fn of(task: &Task) -> Law {
        let mut masses: BTreeMap<String, f64> = BTreeMap::new();
        let mut work = vec![vec![]];
        while let Some(numbers) = work.pop() {
            let mut visiting = Visiting { numbers: &numbers, at: 0, log: 0.0, open: None };
            let run = forward_by(task, &mut visiting, false).expect("a run");
            match visiting.open {
                Some(count) => work.extend((0..count).map(|next| {
                    let mut more = numbers.clone();
                    more.push(next);
                    more
                })),
                None => {
                    let mass = (visiting.log + run.log_score).exp();
                    if mass > 0.0 {
                        *masses.entry(repr(&run.value).expect("a value")).or_default() += mass;
                    }
                }
            }
        }
        let evidence: f64 = masses.values().sum();
        let shares = masses.into_iter().map(|(name, mass)| (name, mass / evidence));
        Law { log_evidence: evidence.ln(), shares: shares.filter(|(_, share)| *share > 0.01).collect() }
    }

    /// The values whose shares among the draws are further off than chance allows.
    pub fn wrong_counts(&self, drawn: &[String]) -> Vec<String> {
        let n = drawn.len() as f64;
        let far = self.shares.iter().filter_map(|(name, p)| {
            let share = drawn.iter().filter(|value| *value == name).count() as f64 / n;
            let z = (share - p) / (p * (1.0 - p) / n).sqrt();
            (z.abs() > LIMIT).then(|| format!("{name}: z = {z:.1}"))
        });
        far.collect()
    }

    /// The quantities whose estimates are further off than chance allows: the evidence, and each value's part of
    /// it. Each of the independent `runs` has its log evidence, and its values with log weights.
    pub fn wrong_estimates(&self, runs: impl Iterator<Item = (f64, Vec<(String, f64)>)>) -> Vec<String> {
        let mut estimates = vec![vec![]; self.shares.len() + 1];
        for (log_evidence, values) in runs {
            let evidence = (log_evidence - self.log_evidence).exp();
            let total: f64 = values.iter().map(|(_, log)| log.exp()).sum();
            estimates[0].push(evidence);
            for (estimates_of_value, (name, _)) in estimates[1..].iter_mut().zip(&self.shares) {
                let part: f64 =
                    values.iter().filter(|(value, _)| value == name).map(|(_, log)| log.exp()).sum();
                estimates_of_value.push(if total > 0.0 { evidence * part / total } else { 0.0 });
            }
        }
        let names =
            std::iter::once(("evidence", 1.0)).chain(self.shares.iter().map(|(n, p)| (n.as_str(), *p)));
        let far = names.zip(estimates).filter_map(|((name, expected), estimates)| {
            let n = estimates.len() as f64;
            let mean = estimates.iter().sum::<f64>() / n;
            let variance = estimates.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n;
            let z = (mean - expected) / (variance / n).sqrt().max(1e-12);
            (z.abs() > LIMIT).then(|| format!("{name}: z = {z:.1}"))
        });
        far.collect()
    }
}
