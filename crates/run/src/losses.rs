//! Losses: partial runs that became impossible while other particles of the population survived, with their causes.

use crate::Task;
use crate::blame::blame;
use crate::failure::{Blame, Dead};
use crate::record::Record;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The most runs that are examined: a search with a result does not wait for more.
const EXAMINED: usize = 50;

/// Counts of runs that became impossible, and a sample of these runs, spread evenly over the search.
#[derive(Clone, Debug, Default)]
pub struct Losses {
    counts: BTreeMap<String, usize>,
    sample: Vec<Dead>,
    /// The number of lost runs.
    total: usize,
    /// The sample has every `2^thinning`-th lost run.
    thinning: u32,
}

/// A report of losses.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lost {
    /// Constraints that made runs impossible, with counts, most frequent first.
    pub causes: Vec<(String, usize)>,
    /// The parts that break a constraint, most frequent first.
    pub blame: Vec<Blame>,
    /// The number of runs that were examined for parts.
    pub looked_at: usize,
}

impl Losses {
    /// Add a run that has become impossible.
    #[cold]
    pub fn note(&mut self, record: &Record) {
        let cause = record.cause.as_deref().unwrap_or("weights");
        match self.counts.get_mut(cause) {
            Some(count) => *count += 1,
            None => drop(self.counts.insert(cause.to_string(), 1)),
        }
        if self.total.is_multiple_of(1 << self.thinning) {
            self.keep(Dead { cause: cause.to_string(), entries: record.log.entries() });
        }
        self.total += 1;
    }

    fn keep(&mut self, dead: Dead) {
        if self.sample.len() == EXAMINED {
            let mut number = 0;
            self.sample.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.thinning += 1;
        }
        self.sample.push(dead);
    }

    /// Add the losses of another population.
    pub fn add(&mut self, other: Losses) {
        for (cause, count) in other.counts {
            *self.counts.entry(cause).or_insert(0) += count;
        }
        self.total += other.total;
        other.sample.into_iter().for_each(|dead| self.keep(dead));
    }

    /// Report the losses, with the parts of the sample that break a constraint.
    pub fn explained(self, task: &Task) -> Lost {
        let (blame, looked_at) = blame(task, &self.sample);
        let mut causes: Vec<_> = self.counts.into_iter().collect();
        causes.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        Lost { causes, blame, looked_at }
    }
}
