//! One chain, and its settings.

use crate::kernel::Kernel;
use crate::leaf::block::Block;
use crate::leaf::trajectory::counts::TrajectoryCounts;
use crate::leaf::{Proposer, Target};
use crate::plan::Plan;
use crate::walk::proposal::{FromPrior, Move};
use crate::walk::samples::Samples;
use crate::walk::state::State;
use crate::walk::streams::Streams;
use crate::walk::weights::Table;
use crate::walk::{ChainMove, Proposing, Walk};
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::ops::{Deref, DerefMut};

/// The settings of a chain.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Decides every random number.
    pub seed: u64,
    /// How it proposes.
    pub kernel: Kernel,
    /// How much of a run is executed again.
    pub strategy: Strategy,
    /// Proposals before the first sample, in which step sizes are adapted.
    pub warmup: u64,
    /// Proposals between two samples; zero for none.
    pub thin: u64,
    /// Most choices that the samples of a chain may hold together.
    pub room: usize,
    /// Most forward runs for a first state.
    pub tries: u64,
    /// Powers of the score, falling from 1: more than one is parallel tempering.
    pub powers: Vec<f64>,
    /// Proposals between two exchanges of states.
    pub every: u64,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            seed: 0,
            kernel: Kernel::PRIOR,
            strategy: Strategy::C3,
            warmup: 0,
            thin: 1,
            room: 1 << 22,
            tries: 1000,
            powers: vec![1.0],
            every: 100,
        }
    }
}

/// One chain; it can go on at any time.
pub struct Chain {
    /// Its state, and what is noted of it.
    pub(crate) walk: Walk,
    pub(crate) plan: Plan,
}

impl Deref for Chain {
    type Target = Walk;

    #[inline(always)]
    fn deref(&self) -> &Walk {
        &self.walk
    }
}

impl DerefMut for Chain {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Walk {
        &mut self.walk
    }
}

/// Proposals between two calls of `watch`.
const BLOCK: u64 = 1024;

impl Chain {
    /// The `number`-th chain of a seed, in its first state. With `known`, choices start with those values.
    ///
    /// # Errors
    /// No possible first state, a kernel that makes no sense for the program, or a fault of the program.
    pub fn start(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Chain, Failure> {
        let (plan, streams) = (Plan::new(&settings.kernel)?, Streams::new(settings.seed, number));
        let (state, spreads) = State::start(task, streams, settings.tries, known)?;
        plan.check(&state, task)?;
        Chain::at(task, settings, number, plan, state, &spreads)
    }

    /// The `number`-th chain of a seed, in a state that is given, at its next place of a plan.
    ///
    /// # Errors
    /// A kernel that makes no sense for the program.
    pub fn at(
        task: &Task,
        settings: &Settings,
        number: u64,
        mut plan: Plan,
        mut state: State,
        spreads: &HashMap<u128, f64>,
    ) -> Result<Chain, Failure> {
        let (program, streams) = (&*task.program, Streams::new(settings.seed, number));
        if plan.leaves.iter().any(|leaf| leaf.proposer.looks()) {
            state.sketches.expect_windows();
        }
        let mut walk = Walk::start(program, streams, state, spreads);
        for leaf in &mut plan.leaves {
            leaf.prepare(task)?;
            if !leaf.selection.is_all() {
                leaf.table = Some(walk.tables.len());
                walk.tables.push(Table::new(Box::new(leaf.selection.clone()), &walk.state.trace, program));
            }
        }
        (walk.strategy, walk.warmup) = (settings.strategy, settings.warmup);
        walk.samples = Samples::new(settings.thin, settings.room);
        Ok(Chain { walk, plan })
    }

    /// Its state alone.
    pub fn into_state(self) -> State {
        self.walk.state
    }

    /// Of each leaf that follows the gradient, in the order of the kernel: the counts of its trajectories,
    /// the step for one coordinate, structures met and runs recorded.
    pub fn trajectories(&self) -> impl Iterator<Item = (&TrajectoryCounts, f64, (u64, u64))> {
        self.plan.trajectories().map(|own| (&own.counts, own.step(), own.recorded()))
    }

    /// Makes `steps` proposals. `watch` is called regularly with their number and the best score; when it returns
    /// false, the chain stops.
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
            let due = self.next_sample();
            let until = due.min(end).min(self.visit + BLOCK);
            self.propose(task, &mut machine, until)?;
            if self.visit == due {
                self.walk.sample(&task.program);
            }
            if !watch(self.visit, self.best.score()) {
                break;
            }
        }
        Ok(())
    }

    /// Proposals up to the `until`-th.
    pub(crate) fn propose(
        &mut self,
        task: &Task,
        machine: &mut Machine<'_>,
        until: u64,
    ) -> Result<(), Failure> {
        if self.plan.is_plain() {
            while self.visit < until {
                {
                    let beta = self.beta;
                    self.walk.single(task, machine, &mut FromPrior, None, beta)?
                };
            }
            return Ok(());
        }
        while self.visit < until {
            let (leaf, power) = self.plan.next(&mut self.streams.schedule(self.visit));
            let (table, beta) = (self.plan.leaves[leaf].table, self.beta * power);
            let mut proposer = std::mem::replace(&mut self.plan.leaves[leaf].proposer, Proposer::Prior {});
            let done = proposer.apply(&mut Proposing { chain: &mut self.walk, task, machine, table, beta });
            self.plan.leaves[leaf].proposer = proposer;
            done?;
        }
        Ok(())
    }
}

impl Target for Proposing<'_, '_> {
    #[inline(always)]
    fn single<M: Move>(&mut self, proposer: &mut M) -> Result<(), Failure> {
        self.chain.single(self.task, self.machine, proposer, self.table, self.beta)
    }

    fn block(&mut self, block: &mut Block) -> Result<(), Failure> {
        self.chain.block(self.task, self.machine, block, self.table, self.beta)
    }

    fn kept(&mut self, proposer: &mut impl ChainMove) -> Result<(), Failure> {
        let Proposing { chain, task, machine, table, beta } = self;
        proposer.apply(Proposing { chain, task, machine, table: *table, beta: *beta })
    }
}
