//! The strategies for running again, and the outcomes of a run.

use super::super::ids::NodeId;
use niwaki_math::Total;

/// The part of a run that runs again when a choice changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// The whole run, from the start: Lightweight MH.
    Rerun,
    /// The rest of the run after the choice.
    Resume,
    /// The whole run from the start, but calls whose inputs are unchanged are skipped.
    Cache,
    /// The run from the choice on, with skipping, until no changed value remains.
    #[default]
    C3,
}

impl Strategy {
    /// All strategies, with their names.
    pub const NAMED: [(&str, Strategy); 4] = [
        ("rerun", Strategy::Rerun),
        ("resume", Strategy::Resume),
        ("cache", Strategy::Cache),
        ("c3", Strategy::C3),
    ];

    /// The strategy with a name.
    pub fn from_name(name: &str) -> Option<Strategy> {
        Strategy::NAMED.into_iter().find(|(known, _)| *known == name).map(|(_, strategy)| strategy)
    }

    /// The name of the strategy.
    pub fn name(self) -> &'static str {
        Strategy::NAMED.into_iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
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
    /// The run came to its end.
    Done,
    /// Nothing changed: the new value is the old one.
    Unchanged,
    /// The score became minus infinity. The run stopped there and must be rolled back.
    Impossible,
}

/// The work of runs, for reports and tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// The number of activations that were entered, from above or from inside.
    pub entered: u64,
    /// The number of calls and iterations that were skipped.
    pub skipped: u64,
    /// The number of instructions.
    pub instructions: u64,
}

/// A step of a run that concerns an activation, for reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Instructions of the activation ran.
    Entered(NodeId),
    /// The activation was skipped: its inputs were unchanged.
    Skipped(NodeId),
    /// The activation was created.
    Created(NodeId),
    /// The activation was removed.
    Removed(NodeId),
    /// The activation returned to its caller.
    Unwound(NodeId),
}

/// The sums over a trace, or the changes of these sums by a transaction; exact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// The log densities of the choices, in nats.
    pub log_prior: Total,
    /// The factors and observations, in nats.
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
