//! Chains without kernels: the present run, its statistics, and the decision on a proposal.
//!
//! * [`state`]: the state; [`streams`]: its random numbers; [`weights`]: selection weights of choices;
//! * `metropolis`: the algorithm for a single choice; [`accept`]: the acceptance ratio;
//! * [`proposal`]: a new value for a choice;
//! * [`counts`], [`best`], [`samples`]: results of the chain.
//!
//! Kernels are in other modules.

pub mod accept;
pub mod best;
pub mod counts;
mod metropolis;
pub mod proposal;
pub mod samples;
pub mod state;
pub mod streams;
pub mod weights;

use accept::Decision;
use best::Best;
use counts::Counts;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::Strategy;
use samples::Samples;
use state::State;
use std::collections::HashMap;
use streams::Streams;
use weights::Table;

/// A chain without its kernel.
pub struct Walk {
    /// The state.
    pub state: State,
    /// Counts of proposals by site.
    pub counts: Counts,
    /// The best state so far.
    pub best: Best,
    /// Thinned states.
    pub samples: Samples,
    /// The power of the score in the target of the chain.
    pub(crate) beta: f64,
    /// The strategy of re-execution.
    pub(crate) strategy: Strategy,
    /// The number of proposals before the first sample.
    pub(crate) warmup: u64,
    pub(crate) streams: Streams,
    /// Weights of the choices, for the leaves whose selection is not uniform.
    pub(crate) tables: Vec<Table>,
    /// Spreads of the sites' distributions in the first state.
    pub(crate) spreads: Vec<f64>,
    /// The number of proposals so far.
    pub(crate) visit: u64,
    /// The number of particle steps of regrown parts.
    pub(crate) grown: u64,
    /// The number of shapes that were moved before the chain began.
    moved_before: u64,
    /// The last decision.
    pub(crate) last: Decision,
    /// The number of barriers (primitives, factors and observations) of a state, if it is fixed.
    pub(crate) barriers: Option<usize>,
}

impl Walk {
    /// Start from a state, with the spreads of the distributions of its sites by key. The chain picks choices uniformly, has no
    /// warm-up and keeps no samples.
    pub(crate) fn start(
        program: &Program,
        streams: Streams,
        state: State,
        spreads: &HashMap<u128, f64>,
    ) -> Walk {
        let sites = program.functions.iter().flat_map(|f| &f.sites);
        Walk {
            spreads: sites.map(|site| spreads.get(&site.key).copied().unwrap_or(1.0)).collect(),
            counts: Counts::new(program),
            best: Best::new(&state),
            samples: Samples::new(0, 0),
            moved_before: state.moved,
            state,
            beta: 1.0,
            strategy: Strategy::C3,
            warmup: 0,
            streams,
            tables: Vec::new(),
            visit: 0,
            grown: 0,
            last: Decision::default(),
            barriers: None,
        }
    }

    /// Change the target of the chain to this power of the score. With `barriers`, the target has only states with that number of
    /// primitives, factors and observations.
    pub fn restrict(&mut self, beta: f64, barriers: Option<usize>) {
        (self.beta, self.barriers) = (beta, barriers);
    }

    /// The work of this chain: the number of proposals, of particle steps of regrown parts, and of shapes that proposals added or removed.
    pub fn work(&self) -> u64 {
        self.visit + self.grown + self.state.moved - self.moved_before
    }

    /// The decision on the last proposal.
    pub fn last(&self) -> Decision {
        self.last
    }

    /// The number of proposals so far.
    pub fn visit(&self) -> u64 {
        self.visit
    }

    /// The log probability of choosing a move after the open transaction, less the one before, for moves of several choices by number: a run
    /// that gets or loses choices is rejected, as its numbers change.
    pub(crate) fn with_same_choices(&self, program: &Program) -> f64 {
        let trace = &self.state.trace;
        let is_same = trace.births(program).len() == 0 && trace.deaths().is_empty();
        if is_same { 0.0 } else { f64::NEG_INFINITY }
    }

    /// The present state.
    pub fn now(&self, program: &Program) -> Run {
        self.state.run(program, self.visit)
    }

    /// The share of the warm-up that is over before a proposal; `None` after the warm-up, when adaptation has ended.
    pub(crate) fn warming(&self, visit: u64) -> Option<f64> {
        let warmup = self.warmup;
        (visit < warmup).then(|| visit as f64 / warmup as f64)
    }

    /// The visit at which the next sample is due.
    pub(crate) fn next_sample(&self) -> u64 {
        let (thin, warmup) = (self.samples.thin, self.warmup);
        if thin == 0 {
            return u64::MAX;
        }
        warmup + (self.visit.saturating_sub(warmup) / thin + 1) * thin
    }

    /// Add the present state to the samples.
    pub(crate) fn sample(&mut self, program: &Program) {
        self.samples.keep(&self.state, program, self.visit, self.warmup);
    }

    /// Exchange states with another chain of the same program and kernel.
    pub(crate) fn exchange_with(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.state, &mut other.state);
        std::mem::swap(&mut self.tables, &mut other.tables);
        std::mem::swap(&mut self.best, &mut other.best);
    }
}

/// A chain with the context of its next proposal.
pub struct Proposing<'a, 'm> {
    pub(crate) chain: &'a mut Walk,
    pub(crate) task: &'a Task,
    pub(crate) machine: &'a mut Machine<'m>,
    /// The weights of the leaf's choices; `None` for equal weights.
    pub(crate) table: Option<usize>,
    /// The power of the score.
    pub(crate) beta: f64,
}

/// A move on the kept run of a chain.
pub trait ChainMove {
    /// Make a proposal and decide on it.
    ///
    /// # Errors
    /// A fault of the program, or of the proposal.
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure>;
}
