//! One chain, and its settings.

use crate::accept::{MetropolisHastings, Rules};
use crate::best::Best;
use crate::block::Block;
use crate::counts::Counts;
use crate::kernel::Kernel;
use crate::leaf::{ChainMove, Proposer, Target};
use crate::metropolis::Decision;
use crate::plan::Plan;
use crate::proposal::{FromPrior, Move};
use crate::samples::Samples;
use crate::state::State;
use crate::streams::{Ahead, Streams};
use crate::trajectory::counts::TrajectoryCounts;
use crate::weights::Table;
use niwaki_run::run::Run;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::marker::PhantomData;

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
pub struct Chain<R: Rules = MetropolisHastings> {
    /// Its state.
    pub state: State,
    /// Proposals by site.
    pub counts: Counts,
    /// The best state so far.
    pub best: Best,
    /// Thinned states.
    pub samples: Samples,
    /// The power of the score that it follows.
    pub(crate) beta: f64,
    pub(crate) settings: Settings,
    pub(crate) streams: Streams,
    pub(crate) plan: Plan,
    /// Weights of the choices, for the leaves that do not take all alike.
    pub(crate) tables: Vec<Table>,
    /// Spreads of the sites' distributions in the first state.
    pub(crate) spreads: Vec<f64>,
    /// The number of proposals so far.
    pub(crate) visit: u64,
    /// Particle-steps of parts that were grown again.
    pub(crate) grown: u64,
    /// The decisions of the next proposal.
    pub(crate) ahead: Ahead,
    /// The last decision.
    pub(crate) last: Decision,
    /// Whether every proposal is undone, to test that nothing is left behind.
    pub(crate) undoing: bool,
    /// How many primitives, factors and observations together a state must have, where that is fixed.
    pub(crate) barriers: Option<usize>,
    rules: PhantomData<R>,
}

/// Proposals between two calls of `watch`.
const BLOCK: u64 = 1024;

impl<R: Rules> Chain<R> {
    /// The `number`-th chain of a seed, in its first state. With `known`, choices start with those values.
    ///
    /// # Errors
    /// No possible first state, a kernel that makes no sense for the program, or a fault of the program.
    pub fn start(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Chain<R>, Failure> {
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
    ) -> Result<Chain<R>, Failure> {
        let (program, streams) = (&*task.program, Streams::new(settings.seed, number));
        let counts = Counts::new(program);
        let mut tables = Vec::new();
        for leaf in &mut plan.leaves {
            leaf.prepare(task)?;
            if !leaf.selection.is_all() {
                leaf.table = Some(tables.len());
                tables.push(Table::new(Box::new(leaf.selection.clone()), &state.trace, program));
            }
        }
        if plan.leaves.iter().any(|leaf| leaf.proposer.looks()) {
            state.sketches.expect_windows();
        }
        let sites = program.functions.iter().flat_map(|f| &f.sites);
        Ok(Chain {
            spreads: sites.map(|site| spreads.get(&site.key).copied().unwrap_or(1.0)).collect(),
            counts,
            best: Best::new(&state),
            samples: Samples::new(settings.thin, settings.room),
            state,
            beta: 1.0,
            settings: settings.clone(),
            streams,
            plan,
            tables,
            ahead: Ahead::default(),
            visit: 0,
            grown: 0,
            last: Decision::default(),
            undoing: false,
            barriers: None,
            rules: PhantomData,
        })
    }

    /// From now on the chain follows this power of the score, over states with a fixed number of barriers where it is given:
    /// primitives, factors and observations together.
    pub fn restrict(&mut self, beta: f64, barriers: Option<usize>) {
        (self.beta, self.barriers) = (beta, barriers);
    }

    /// What it has done: proposals, particle-steps of parts that were grown again, and shapes that its state's proposals placed
    /// or removed.
    pub fn work(&self) -> u64 {
        self.visit + self.grown + self.state.moved
    }

    /// How many proposals it has made.
    pub fn visit(&self) -> u64 {
        self.visit
    }

    /// Of each leaf that follows the gradient, in the order of the kernel: the counts of its trajectories,
    /// the step for one coordinate, structures met and runs recorded.
    pub fn trajectories(&self) -> impl Iterator<Item = (&TrajectoryCounts, f64, (u64, u64))> {
        self.plan.trajectories().map(|own| (&own.counts, own.step(), own.recorded()))
    }

    /// The present state.
    pub fn now(&self, program: &Program) -> Run {
        self.state.run(program, self.visit)
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
                self.samples.keep(&self.state, &task.program, self.visit, self.settings.warmup);
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
                self.single(task, machine, &mut FromPrior, None, self.beta)?;
            }
            return Ok(());
        }
        while self.visit < until {
            let (leaf, power) = self.plan.next(&mut self.streams.schedule(self.visit));
            let (table, beta) = (self.plan.leaves[leaf].table, self.beta * power);
            let mut proposer = std::mem::replace(&mut self.plan.leaves[leaf].proposer, Proposer::Prior {});
            let done = proposer.apply(&mut Proposing { chain: self, task, machine, table, beta });
            self.plan.leaves[leaf].proposer = proposer;
            done?;
        }
        Ok(())
    }

    /// The share of the warm-up that is over before a proposal; none after the warm-up, when nothing is adapted.
    pub(crate) fn warming(&self, visit: u64) -> Option<f64> {
        let warmup = self.settings.warmup;
        (visit < warmup).then(|| visit as f64 / warmup as f64)
    }

    /// The visit at which the next sample is due.
    fn next_sample(&self) -> u64 {
        let (thin, warmup) = (self.samples.thin, self.settings.warmup);
        if thin == 0 {
            return u64::MAX;
        }
        warmup + (self.visit.saturating_sub(warmup) / thin + 1) * thin
    }

    /// Exchanges states with another chain of the same program and kernel.
    pub(crate) fn exchange_with(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.state, &mut other.state);
        std::mem::swap(&mut self.tables, &mut other.tables);
        std::mem::swap(&mut self.best, &mut other.best);
    }
}

/// A chain with the context of its next proposal.
pub struct Proposing<'a, 'm, R: Rules> {
    pub(crate) chain: &'a mut Chain<R>,
    pub(crate) task: &'a Task,
    pub(crate) machine: &'a mut Machine<'m>,
    /// The weights of the leaf's choices; all weigh the same where there are none.
    pub(crate) table: Option<usize>,
    /// The power of the score.
    pub(crate) beta: f64,
}

impl<R: Rules> Target for Proposing<'_, '_, R> {
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
