//! Why a search gives no result.

use crate::log::Entry;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::RunFault;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Why a search gives no result.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The program met a fault.
    Run(Box<RunFault>),
    /// A setting makes no sense, or the algorithm does not suit the task.
    Setting(Fault),
    /// Every particle, or every run, is impossible.
    Impossible {
        /// The barrier at which the last particle died, from 1; 0 for runs, which have none.
        barrier: usize,
        /// What made them impossible: constraint and count, most frequent first.
        causes: Vec<(String, usize)>,
        /// Some of the runs, until `blame` is read from them.
        dead: Vec<Dead>,
        /// Where parts that break a constraint are emitted, most frequent first, and of how many runs.
        blame: (Vec<Blame>, usize),
        /// The populations that were tried, of which this is the first.
        attempts: Vec<Attempt>,
    },
    /// A chain has no state to start from.
    NoStart {
        /// How many forward runs were tried; none where the run was given.
        tries: u64,
        /// What made them impossible: constraint and count, most frequent first.
        causes: Vec<(String, usize)>,
    },
}

/// A run that became impossible.
#[derive(Clone, Debug)]
pub struct Dead {
    /// What made it impossible: the name of a sketch, or of a factor.
    pub cause: String,
    /// Its choices.
    pub entries: Vec<Entry>,
}

/// Where parts that break a constraint are emitted, and in how many runs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Blame {
    /// The name of the constraint.
    pub constraint: String,
    /// The part that breaks it.
    pub part: Emitted,
    /// The part before it that it breaks it with, where one alone does not.
    pub other: Option<Emitted>,
    /// In how many of the runs.
    pub runs: usize,
}

/// Where a part is emitted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Emitted {
    /// The readable address of one such part.
    pub path: String,
    /// Qualified name of the function.
    pub function: String,
    /// Number of its source file.
    pub file: u32,
    /// First line, first column, last line, column after the last character.
    pub span: [u32; 4],
}

impl Emitted {
    /// Number of its source file, and its place there.
    pub(crate) fn place(&self) -> (u32, [u32; 4]) {
        (self.file, self.span)
    }
}

/// A population of a search for the best.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// Its form.
    pub form: &'static str,
    /// Its particles.
    pub particles: usize,
    /// The barrier at which its last particle died; `None` where it lived.
    pub died_at: Option<usize>,
}

impl Failure {
    /// Every particle is impossible at this barrier (0: every run is); `causes` are constraints with counts.
    pub fn impossible<'a>(barrier: usize, causes: impl Iterator<Item = (&'a str, usize)>) -> Failure {
        let mut counts: HashMap<&str, usize> = HashMap::new();
        causes.for_each(|(cause, n)| *counts.entry(cause).or_insert(0) += n);
        let mut causes: Vec<(String, usize)> = counts.into_iter().map(|(c, n)| (c.to_string(), n)).collect();
        causes.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
        Failure::Impossible { barrier, causes, dead: vec![], blame: (vec![], 0), attempts: vec![] }
    }

    /// A run that was given is impossible: nothing was tried.
    pub fn no_start() -> Failure {
        Failure::NoStart { tries: 0, causes: vec![] }
    }

    /// Whether every run or particle was impossible, by scores or because it was invalid.
    pub fn is_impossible(&self) -> bool {
        match self {
            Failure::Run(met) => met.is_invalid(),
            Failure::Impossible { .. } => true,
            Failure::Setting(_) | Failure::NoStart { .. } => false,
        }
    }
}

fn listed(causes: &[(String, usize)]) -> String {
    causes.iter().map(|(name, n)| format!("{name} ({n})")).collect::<Vec<_>>().join(", ")
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::Run(fault) => write!(f, "{fault}"),
            Failure::Setting(fault) => write!(f, "{}", fault.message),
            Failure::Impossible { barrier: 0, causes, .. } => {
                write!(f, "every run is impossible: {}", listed(causes))
            }
            Failure::Impossible { barrier, causes, .. } => {
                write!(f, "every particle is impossible at barrier {barrier}: {}", listed(causes))
            }
            Failure::NoStart { tries: 0, .. } => write!(f, "the run to start from is impossible"),
            Failure::NoStart { tries, causes } => {
                write!(f, "{tries} runs gave no possible state to start from: {}", listed(causes))
            }
        }
    }
}

impl std::error::Error for Failure {}

impl From<Box<RunFault>> for Failure {
    fn from(fault: Box<RunFault>) -> Self {
        Failure::Run(fault)
    }
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Self {
        Failure::Setting(fault)
    }
}
