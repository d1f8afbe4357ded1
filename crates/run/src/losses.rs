//! Partial runs that became impossible while others of their population lived: how many, by what, and by which parts.

use crate::Task;
use crate::blame::blame;
use crate::failure::{Blame, Dead};
use crate::record::Record;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Most runs that are looked at: a search that has a result shall not wait for more of them.
const LOOKED_AT: usize = 50;

/// What is kept of runs that became impossible: all are counted, and of some the choices are kept, evenly over the time.
#[derive(Clone, Debug, Default)]
pub struct Losses {
    counts: BTreeMap<String, usize>,
    kept: Vec<Dead>,
    /// So many were lost.
    seen: usize,
    /// One of 2 to this power is kept.
    thinned: u32,
}

/// What a person reads of them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lost {
    /// What made them impossible: constraint and count, most frequent first.
    pub causes: Vec<(String, usize)>,
    /// Where parts that break a constraint are emitted, most frequent first.
    pub blame: Vec<Blame>,
    /// Of how many runs.
    pub looked_at: usize,
}

impl Losses {
    /// Notes a run that has become impossible.
    #[cold]
    pub fn note(&mut self, record: &Record) {
        let cause = record.cause.as_deref().unwrap_or("weights");
        match self.counts.get_mut(cause) {
            Some(count) => *count += 1,
            None => drop(self.counts.insert(cause.to_string(), 1)),
        }
        if self.seen.is_multiple_of(1 << self.thinned) {
            self.keep(Dead { cause: cause.to_string(), entries: record.log.entries() });
        }
        self.seen += 1;
    }

    fn keep(&mut self, dead: Dead) {
        if self.kept.len() == LOOKED_AT {
            let mut number = 0;
            self.kept.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.thinned += 1;
        }
        self.kept.push(dead);
    }

    /// Those of another population, too.
    pub fn add(&mut self, other: Losses) {
        for (cause, count) in other.counts {
            *self.counts.entry(cause).or_insert(0) += count;
        }
        self.seen += other.seen;
        other.kept.into_iter().for_each(|dead| self.keep(dead));
    }

    /// With the parts that break a constraint; they are looked for only here.
    pub fn explained(self, task: &Task) -> Lost {
        let (blame, looked_at) = blame(task, &self.kept);
        let mut causes: Vec<_> = self.counts.into_iter().collect();
        causes.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        Lost { causes, blame, looked_at }
    }
}
