//! Open branches of an enumeration: a stack, or a queue by probability.

use super::Visit;
use crate::chooser::Chosen;
use crate::record::Record;
use niwaki_math::Dist;
use niwaki_math::log_sums::log_sum_exp;
use niwaki_vm::machine::state::State;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A run up to an open choice, and the value with which it resumes.
pub(super) struct Branch {
    pub state: State,
    pub record: Record,
    pub next: Next,
}

/// The value with which a run resumes.
pub(super) enum Next {
    /// The start of the run, before any choice.
    Start,
    /// A value.
    Value(Chosen),
    /// All whole numbers from `value` on, with the sum of their probabilities.
    From { dist: Dist, value: i64, tail: f64 },
}

impl Next {
    /// The log probability of the value at the choice.
    fn log(&self) -> f64 {
        match self {
            Next::Start => 0.0,
            Next::Value(chosen) => chosen.log_prior,
            Next::From { tail, .. } => tail.ln(),
        }
    }
}

/// The open branches.
pub(super) enum Frontier {
    /// A stack: the last branch resumes first.
    All(Vec<Branch>),
    /// A queue: the most probable branch resumes first.
    Likely(Likely),
}

impl Frontier {
    pub fn new(visit: Visit) -> Frontier {
        match visit {
            Visit::All(_) => Frontier::All(Vec::new()),
            Visit::Likely { runs, .. } => Frontier::Likely(Likely {
                most: runs.saturating_mul(OPEN).saturating_add(FEWEST),
                open: BinaryHeap::new(),
                count: 0,
                dropped: Vec::new(),
            }),
        }
    }

    pub fn push(&mut self, branch: Branch) {
        match self {
            Frontier::All(open) => open.push(branch),
            Frontier::Likely(likely) => likely.push(branch),
        }
    }

    pub fn pop(&mut self) -> Option<Branch> {
        match self {
            Frontier::All(open) => open.pop(),
            Frontier::Likely(likely) => likely.open.pop().map(|ranked| ranked.branch),
        }
    }

    /// The prior probability of all runs that were never visited, and the log of the most that they add to the evidence. The
    /// remainder of a run adds at most `max_gain` nats to its score. A stack leaves no runs.
    pub fn unvisited(self, max_gain: f64) -> (f64, f64) {
        let Frontier::Likely(likely) = self else { return (0.0, f64::NEG_INFINITY) };
        let open = likely.open.into_iter().map(|ranked| ranked.logs);
        let left: Vec<Logs> = likely.dropped.into_iter().chain(open).collect();
        if left.is_empty() {
            return (0.0, f64::NEG_INFINITY);
        }
        let sum = |of: fn(&Logs) -> f64| log_sum_exp(left.iter().map(of));
        (sum(|logs| logs.prior).exp(), sum(|logs| logs.joint) + max_gain)
    }
}

/// The most open branches for each run that may be visited, beside [`FEWEST`]: the least probable branches beyond are dropped.
const OPEN: usize = 4;
const FEWEST: usize = 1000;

/// Branches by their joint probability.
pub(super) struct Likely {
    /// The most open branches.
    most: usize,
    open: BinaryHeap<Ranked>,
    count: u64,
    /// The probabilities of dropped branches.
    dropped: Vec<Logs>,
}

impl Likely {
    fn push(&mut self, branch: Branch) {
        let prior = branch.record.log_prior.value() + branch.next.log();
        let logs = Logs { prior, joint: prior + branch.record.score().value() };
        self.open.push(Ranked { logs, number: self.count, branch });
        self.count += 1;
        if self.open.len() > self.most {
            let mut sorted = std::mem::take(&mut self.open).into_sorted_vec();
            self.dropped.extend(sorted.drain(..self.most / 2).map(|ranked| ranked.logs));
            self.open = sorted.into();
        }
    }
}

/// Logs of the probability of all runs of a branch, nats: by the prior, and with the scores so far.
struct Logs {
    prior: f64,
    joint: f64,
}

/// A branch with its probability and the number of branches before it.
struct Ranked {
    logs: Logs,
    number: u64,
    branch: Branch,
}

/// The order by joint probability; of equal branches the last comes first.
impl Ord for Ranked {
    fn cmp(&self, other: &Ranked) -> Ordering {
        self.logs.joint.total_cmp(&other.logs.joint).then(self.number.cmp(&other.number))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Ranked) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Ranked) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Ranked {}
