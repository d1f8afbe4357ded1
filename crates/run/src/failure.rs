//! Failures: the reasons why a search gives no result.

use crate::log::Entry;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::stack::RunFault;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The reason why a search gives no result.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The program met a fault.
    Run(Box<RunFault>),
    /// A setting is invalid, or the algorithm does not suit the task.
    Setting(Fault),
    /// Every particle, or every run, is impossible.
    Impossible {
        /// The barrier at which the last particle died, from 1; 0 for runs, which have none.
        barrier: usize,
        /// Constraints that made them impossible, with counts, most frequent first.
        causes: Vec<(String, usize)>,
        /// A sample of the impossible runs, from which `blame` is computed.
        dead: Vec<Dead>,
        /// The parts that break a constraint, most frequent first, and the number of runs that were examined.
        blame: (Vec<Blame>, usize),
        /// All populations that were tried; this failure is from the first.
        attempts: Vec<Attempt>,
    },
    /// A chain has no state to start from.
    NoStart {
        /// The number of forward runs that were tried; 0 where the caller gave the run.
        tries: u64,
        /// Constraints that made them impossible, with counts, most frequent first.
        causes: Vec<(String, usize)>,
    },
}

/// A run that became impossible.
#[derive(Clone, Debug)]
pub struct Dead {
    /// The name of the sketch or factor that made the run impossible.
    pub cause: String,
    /// Its choices.
    pub entries: Vec<Entry>,
}

/// A part that breaks a constraint, and the number of runs in which it does.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Blame {
    /// The name of the constraint.
    pub constraint: String,
    /// The part that breaks it.
    pub part: Emitted,
    /// The earlier part that breaks the constraint together with `part`; `None` where `part` alone breaks it.
    pub other: Option<Emitted>,
    /// The number of runs.
    pub runs: usize,
}

/// The place in the source where a part is emitted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Emitted {
    /// The readable address of a part that is emitted there.
    pub path: String,
    /// Qualified name of the function.
    pub function: String,
    /// Number of its source file.
    pub file: u32,
    /// First line, first column, last line, column after the last character.
    pub span: [u32; 4],
}

impl Emitted {
    /// The number of the source file, and the place in the file.
    pub(crate) fn place(&self) -> (u32, [u32; 4]) {
        (self.file, self.span)
    }
}

/// A population of a search for the best.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// The form of the population.
    pub form: &'static str,
    /// The number of particles.
    pub particles: usize,
    /// The barrier at which the last particle died; `None` where a particle survived.
    pub died_at: Option<usize>,
}

impl Failure {
    /// Fail because every particle is impossible at this barrier; at barrier 0, because every run is. `causes` are
    /// constraints with counts.
    pub fn impossible<'a>(barrier: usize, causes: impl Iterator<Item = (&'a str, usize)>) -> Failure {
        let mut counts: HashMap<&str, usize> = HashMap::new();
        causes.for_each(|(cause, n)| *counts.entry(cause).or_insert(0) += n);
        let mut causes: Vec<(String, usize)> = counts.into_iter().map(|(c, n)| (c.to_string(), n)).collect();
        causes.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
        Failure::Impossible { barrier, causes, dead: vec![], blame: (vec![], 0), attempts: vec![] }
    }

    /// Fail because the run that the caller gave is impossible.
    pub fn no_start() -> Failure {
        Failure::NoStart { tries: 0, causes: vec![] }
    }

    /// Whether every run or particle was impossible, because of scores or because of invalid runs.
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
