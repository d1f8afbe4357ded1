//! How much of a run is done again, and what came of it.

use super::super::ids::NodeId;
use niwaki_math::Total;

/// How much of a run is done again when a choice changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// All of it, from the start: Lightweight MH.
    Rerun,
    /// Everything after the choice.
    Resume,
    /// From the start, but calls whose inputs are unchanged are skipped.
    Cache,
    /// From the choice on, skipping, until nothing that changed is left.
    #[default]
    C3,
}

impl Strategy {
    /// All of them, with their names.
    pub const NAMED: [(&str, Strategy); 4] = [
        ("rerun", Strategy::Rerun),
        ("resume", Strategy::Resume),
        ("cache", Strategy::Cache),
        ("c3", Strategy::C3),
    ];

    /// The strategy of a name.
    pub fn from_name(name: &str) -> Option<Strategy> {
        Strategy::NAMED.into_iter().find(|(own, _)| *own == name).map(|(_, strategy)| strategy)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Strategy::NAMED.into_iter().find(|(_, own)| *own == self).map_or("", |(name, _)| name)
    }

    /// Whether a run starts at the changed choice.
    pub fn starts_at_choice(self) -> bool {
        matches!(self, Strategy::Resume | Strategy::C3)
    }

    /// Whether calls with unchanged inputs are skipped.
    pub fn reuses(self) -> bool {
        matches!(self, Strategy::Cache | Strategy::C3)
    }
}

/// The outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// It ran to its end.
    Done,
    /// Nothing changed: the new value is the old one.
    Same,
    /// The score became minus infinity. The run stopped there and must be rolled back.
    Impossible,
}

/// Work done, for reports and tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Activations that were entered, from above or from inside.
    pub entered: u64,
    /// Calls and iterations that were skipped.
    pub skipped: u64,
    /// Instructions.
    pub instructions: u64,
}

/// What happened to an activation in a run, for reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Instructions of it were carried out.
    Entered(NodeId),
    /// It was skipped: its inputs were unchanged.
    Skipped(NodeId),
    /// It was created.
    Created(NodeId),
    /// It was removed.
    Removed(NodeId),
    /// It returned to its caller.
    Unwound(NodeId),
}

/// Sums over a trace, or what a transaction adds to them; exact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// Log densities of the choices, nats.
    pub log_prior: Total,
    /// Factors and observations, nats.
    pub log_factors: Total,
    /// The number of factors and observations.
    pub factors: i64,
}

impl Totals {
    /// Adds other sums.
    #[inline(always)]
    pub fn add(&mut self, other: &Totals) {
        self.log_prior.add_total(&other.log_prior);
        self.log_factors.add_total(&other.log_factors);
        self.factors += other.factors;
    }

    /// Whether a choice or a factor is minus infinity.
    #[inline(always)]
    pub fn is_impossible(&self) -> bool {
        self.log_prior.is_impossible() || self.log_factors.is_impossible()
    }
}
