//! Markov chains over kept runs: Metropolis-Hastings with kernels as values (dissertation chapter 3).
//!
//! * [`state`]: where a chain is; [`streams`]: its random numbers;
//! * [`accept`]: the acceptance ratio, in plain letters; [`decide`](Chain): a proposal is kept or undone;
//! * [`odds`]: which choice is changed;
//! * `single`: proposals that change one choice;
//! * [`counts`], [`harvest`]: what is told afterwards;
//! * [`many`]: several chains side by side.
//!
//! A chain's states depend on its seed and number only: not on the strategy, not on the number of threads.

pub mod accept;
pub mod counts;
mod decide;
pub mod harvest;
pub mod many;
pub mod odds;
mod single;
pub mod state;
pub mod streams;

use crate::{Failure, Task};
use accept::{MetropolisHastings, Rules};
use counts::Counts;
use harvest::Harvest;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::value::Value;
use odds::Table;
use state::State;
use std::collections::HashMap;
use std::marker::PhantomData;
use streams::Streams;

/// What a chain is asked for.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Decides every random number.
    pub seed: u64,
    /// How much of a run is done again.
    pub strategy: Strategy,
    /// Proposals before the first sample, in which step sizes are adapted.
    pub warmup: u64,
    /// Proposals between two samples; zero for none.
    pub thin: u64,
    /// Most choices that the samples of a chain may hold together.
    pub room: usize,
    /// Most forward runs for a first state.
    pub tries: u64,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings { seed: 0, strategy: Strategy::C3, warmup: 0, thin: 1, room: 1 << 22, tries: 1000 }
    }
}

/// One chain, alive between two calls.
pub struct Chain<R: Rules = MetropolisHastings> {
    /// Where it is.
    pub state: State,
    /// Proposals by site.
    pub counts: Counts,
    /// What it keeps.
    pub harvest: Harvest,
    settings: Settings,
    streams: Streams,
    tables: Vec<Table>,
    /// The number of proposals so far.
    visit: u64,
    rules: PhantomData<R>,
}

/// Proposals between two looks of whoever watches.
const BLOCK: u64 = 1024;

impl<R: Rules> Chain<R> {
    /// The `number`-th chain of a seed, in its first state. With `known`, choices start with those values.
    ///
    /// # Errors
    /// No possible first state, or a fault of the program.
    pub fn start(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Chain<R>, Failure> {
        let streams = Streams::new(settings.seed, number);
        let state = State::start(task, streams, settings.tries, known)?;
        Ok(Chain {
            counts: Counts::new(&task.program),
            harvest: Harvest::new(&state, settings.thin, settings.room),
            state,
            settings: settings.clone(),
            streams,
            tables: vec![],
            visit: 0,
            rules: PhantomData,
        })
    }

    /// How many proposals it has made.
    pub fn visit(&self) -> u64 {
        self.visit
    }

    /// The present state.
    pub fn now(&self, program: &niwaki_vm::code::Program) -> harvest::Snapshot {
        harvest::Snapshot::of(&self.state, program, self.visit)
    }

    /// Makes `steps` proposals. `watch` is told their number and the best score now and then; when it answers false,
    /// the chain stops where it is.
    ///
    /// # Errors
    /// A fault of the program, or of a proposal; the chain is then in its last state before.
    pub fn advance(
        &mut self,
        task: &Task,
        steps: u64,
        watch: &mut dyn FnMut(u64, f64) -> bool,
    ) -> Result<(), Failure> {
        let mut machine = task.machine();
        let end = self.visit + steps;
        while self.visit < end {
            let until = end.min(self.visit + BLOCK).min(self.next_sample());
            self.propose(task, &mut machine, until)?;
            if self.visit == self.next_sample_or_now() {
                self.harvest.sample(&self.state, &task.program, self.visit);
            }
            if !watch(self.visit, self.harvest.best_score()) {
                break;
            }
        }
        Ok(())
    }

    /// Proposals up to the `until`-th.
    fn propose(&mut self, task: &Task, machine: &mut Machine<'_>, until: u64) -> Result<(), Failure> {
        while self.visit < until {
            self.single(task, machine, &mut single::FromPrior, None, 1.0)?;
        }
        Ok(())
    }

    /// The visit after which the next sample is due.
    fn next_sample(&self) -> u64 {
        let thin = self.harvest.thin;
        if thin == 0 {
            return u64::MAX;
        }
        let done = self.visit.saturating_sub(self.settings.warmup);
        self.settings.warmup + (done / thin + 1) * thin
    }

    /// This visit, if a sample is due.
    fn next_sample_or_now(&self) -> u64 {
        let (thin, warmup) = (self.harvest.thin, self.settings.warmup);
        let due = thin > 0 && self.visit > warmup && (self.visit - warmup).is_multiple_of(thin);
        if due { self.visit } else { u64::MAX }
    }
}
