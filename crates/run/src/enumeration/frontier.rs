//! The branches of an enumeration that are open: all of them, the last first, or the likeliest first.

use super::Visit;
use crate::chooser::Chosen;
use crate::record::Record;
use niwaki_math::Dist;
use niwaki_math::log_sums::log_sum_exp;
use niwaki_vm::machine::state::State;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A run up to an open choice, and how it goes on.
pub(super) struct Branch {
    pub state: State,
    pub record: Record,
    pub next: Next,
}

/// The value with which a run goes on.
pub(super) enum Next {
    /// It has not begun.
    Start,
    /// This value.
    Value(Chosen),
    /// A whole number from here on, one by one; the probability of all of them.
    From { dist: Dist, value: i64, left: f64 },
}

impl Next {
    /// Log of its probability at the choice.
    fn log(&self) -> f64 {
        match self {
            Next::Start => 0.0,
            Next::Value(chosen) => chosen.log_prior,
            Next::From { left, .. } => left.ln(),
        }
    }
}

/// The branches that are open.
pub(super) enum Frontier {
    /// The last goes on first.
    All(Vec<Branch>),
    /// The likeliest goes on first.
    Likely(Likely),
}

impl Frontier {
    pub fn new(visit: Visit) -> Frontier {
        match visit {
            Visit::All(_) => Frontier::All(Vec::new()),
            Visit::Likely { runs, .. } => Frontier::Likely(Likely {
                most: runs.saturating_mul(OPEN).saturating_add(FEWEST),
                open: BinaryHeap::new(),
                made: 0,
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

    /// What was never visited: its prior probability, and the log of the most that it adds to the evidence, where the rest of
    /// a run adds at most `rest` to its score. Branches that must all be visited leave nothing.
    pub fn unseen(self, rest: f64) -> (f64, f64) {
        let Frontier::Likely(likely) = self else { return (0.0, f64::NEG_INFINITY) };
        let open = likely.open.into_iter().map(|ranked| ranked.logs);
        let left: Vec<Logs> = likely.dropped.into_iter().chain(open).collect();
        if left.is_empty() {
            return (0.0, f64::NEG_INFINITY);
        }
        let sum = |of: fn(&Logs) -> f64| log_sum_exp(left.iter().map(of));
        (sum(|logs| logs.prior).exp(), sum(|logs| logs.joint) + rest)
    }
}

/// Of more open branches than this for each run that may be visited, and [`FEWEST`], the least likely are given up.
const OPEN: usize = 4;
const FEWEST: usize = 1000;

/// Branches by their joint probability.
pub(super) struct Likely {
    /// How many may be open.
    most: usize,
    open: BinaryHeap<Ranked>,
    made: u64,
    /// Of branches that were given up.
    dropped: Vec<Logs>,
}

impl Likely {
    fn push(&mut self, branch: Branch) {
        let prior = branch.record.log_prior.value() + branch.next.log();
        let logs = Logs { prior, joint: prior + branch.record.score().value() };
        self.open.push(Ranked { logs, number: self.made, branch });
        self.made += 1;
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

/// A branch, how likely it is, and how many were made before it.
struct Ranked {
    logs: Logs,
    number: u64,
    branch: Branch,
}

/// In the order of their joint probability; of equals the last first.
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
