//! Chains and their settings.

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
    /// The seed of all random numbers.
    pub seed: u64,
    /// The kernel.
    pub kernel: Kernel,
    /// The strategy of re-execution.
    pub strategy: Strategy,
    /// The number of proposals before the first sample, which adapt step sizes.
    pub warmup: u64,
    /// The number of proposals between two samples; 0 for no samples.
    pub thin: u64,
    /// The most choices of all samples of a chain together.
    pub room: usize,
    /// The most forward runs for a first state.
    pub tries: u64,
    /// Powers of the score, falling from 1; several powers mean parallel tempering.
    pub powers: Vec<f64>,
    /// The number of proposals between two exchanges of states.
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

/// A chain; it can resume at any time.
pub struct Chain {
    /// The state and the statistics of the chain.
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

/// The number of proposals between two calls of `watch`.
const BLOCK: u64 = 1024;

impl Chain {
    /// Start the `number`-th chain of a seed in a first state. `known` has first values of choices.
    ///
    /// # Errors
    /// No possible first state; a kernel that does not suit the program; a fault of the program.
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

    /// Start the `number`-th chain of a seed in a given state, at a place of a plan.
    ///
    /// # Errors
    /// A kernel that does not suit the program.
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

    /// The state without the statistics.
    pub fn into_state(self) -> State {
        self.walk.state
    }

    /// Statistics of each gradient leaf, in the order of the kernel: the counts of its trajectories, the step size of a coordinate, the
    /// numbers of structures and of recorded runs.
    pub fn trajectories(&self) -> impl Iterator<Item = (&TrajectoryCounts, f64, (u64, u64))> {
        self.plan
            .trajectories()
            .map(|trajectory| (&trajectory.counts, trajectory.step(), trajectory.recorded()))
    }

    /// Make `steps` proposals. `watch` is called regularly with the number of proposals and the best score; when it returns false,
    /// the chain stops.
    ///
    /// # Errors
    /// A fault of the program or of a proposal; the chain keeps its last state.
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

    /// Make proposals up to the `until`-th.
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
