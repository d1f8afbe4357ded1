//! The machine: runs a program up to its next question.
//!
//! Its verbs are few: [`Machine::start`] a run, [`Machine::resume`] one of its futures, fork (a `clone` of the
//! [`State`]). It never recurses on the host stack, draws no random numbers and does not know which algorithm uses it.
//!
//! * [`address`]: paths of sites as 128-bit hashes; [`held`]: choices whose values are given;
//! * [`answers`]: the questions, and the trait of those who answer;
//! * [`state`]: nodes, registers, futures; [`runnable`]: the futures that can run; `begin`: those of a run that has not begun;
//! * `budget`: what an operation costs in steps and bytes, and the audit of a run's memory;
//! * `parts`: what activations emitted last, for guides;
//! * [`kept`]: traces: kept activations, and re-running what changed;
//! * [`lanes`]: many runs at the same place, an instruction at a time for all of them;
//! * `interpret`: the loop over instructions; `registers`: from operands to values;
//! * `cache`: a cache of distributions by their parameters;
//! * `enter`: machine code, where there is some;
//! * `operate`: operations of two operands; `construct`: instructions that build or unpack an aggregate;
//! * `question`: choices and factors; `suspend`: what happens at any other site; `loops`: lifted loops; `memo`:
//!   memoised functions;
//! * [`stack`]: the model's own call stack, for messages; [`invalid`]: faults of runs that are outside of the
//!   model's support.

pub mod address;
pub mod answers;
mod begin;
mod budget;
mod cache;
mod construct;
mod enter;
pub mod held;
mod interpret;
pub mod invalid;
mod keep;
pub mod kept;
pub mod lanes;
mod loops;
mod memo;
mod operate;
mod parts;
mod question;
mod registers;
pub mod runnable;
pub mod stack;
pub mod state;
mod suspend;

use crate::code::{FunctionId, Operand, Program};
use crate::fault::Fault;
use crate::value::Value;
use answers::Answers;
use cache::DistCache;
use held::Held;
use keep::Dropped;
use niwaki_geom::Shape;
use niwaki_math::{LastLog, Scalar};
use stack::RunFault;
use state::{FutureId, NodeId, State, Status};
use std::sync::atomic::{AtomicU64, Ordering};

/// How much a run may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Calls, iterations and backward jumps, of one run; an operation on many elements counts one for every 8 of
    /// them, a primitive 256.
    pub steps: u64,
    /// Bytes of nodes, registers and values, of one run.
    pub bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { steps: 20_000_000, bytes: 1 << 30 }
    }
}

/// The steps that many runs may take together. Whether they are too many does not depend on the order of the runs.
#[derive(Debug)]
pub struct Together {
    most: u64,
    taken: AtomicU64,
}

impl Together {
    /// That many steps.
    pub fn new(most: u64) -> Self {
        Together { most, taken: AtomicU64::new(0) }
    }

    /// The steps taken so far.
    pub fn taken(&self) -> u64 {
        self.taken.load(Ordering::Relaxed)
    }

    /// Whether more were taken than there were.
    pub fn is_spent(&self) -> bool {
        self.taken() > self.most
    }

    fn take(&self, steps: u64) {
        self.taken.fetch_add(steps, Ordering::Relaxed);
    }
}

/// Why a run stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The answer was to pause.
    Paused,
    /// The future that ran has returned.
    Returned,
    /// The future that ran waits for another.
    Waiting,
    /// The score is minus infinity. Only where activations are kept: elsewhere the answers report it.
    Impossible,
}

/// A call of a pure function in progress: where to continue when it returns.
struct PureCall {
    caller: FunctionId,
    pc: usize,
    scratch: usize,
    to: Operand,
    /// The result is a future that has returned already.
    as_future: bool,
}

/// Where the machine is, for the call stack of a fault.
#[derive(Clone, Copy)]
struct Here {
    node: NodeId,
    function: FunctionId,
    pc: usize,
    /// The first register of a pure function.
    scratch: usize,
}

/// Runs programs. It holds scratch space only, so one machine serves any number of states.
pub struct Machine<'p, S: Scalar = f64> {
    program: &'p Program<S>,
    limits: Limits,
    held: Option<&'p Held<S>>,
    together: Option<&'p Together>,
    scratch: Vec<Value<S>>,
    /// How many scratch registers were used since they were emptied.
    high: usize,
    pure: Vec<PureCall>,
    buffer: Vec<Value<S>>,
    /// What machine code and the machine exchange.
    words: Vec<u64>,
    shapes: Vec<Shape>,
    cache: DistCache<S>,
    logs: LastLog<S>,
    here: Here,
    /// It runs many runs at once, which go apart where their memory would have to be counted.
    in_lanes: bool,
}

impl<'p, S: Scalar> Machine<'p, S> {
    /// A machine for that program.
    pub fn new(program: &'p Program<S>, limits: Limits) -> Self {
        Machine {
            program,
            limits,
            held: None,
            together: None,
            scratch: Vec::new(),
            high: 0,
            pure: Vec::new(),
            buffer: Vec::new(),
            words: Vec::new(),
            shapes: Vec::new(),
            cache: DistCache::holding(limits.bytes / 16),
            logs: LastLog::default(),
            here: Here { node: NodeId::NONE, function: program.entry, pc: 0, scratch: 0 },
            in_lanes: false,
        }
    }

    /// The machine with choices held, where there are any.
    pub fn holding(self, held: Option<&'p Held<S>>) -> Self {
        Machine { held, ..self }
    }

    /// The machine with steps that its runs share, where there are any.
    pub fn within(self, together: Option<&'p Together>) -> Self {
        Machine { together, ..self }
    }

    /// Takes the steps of a part of a run from those that are shared.
    #[inline]
    fn take_steps(&self, steps: u64) -> Result<(), Fault> {
        if let Some(together) = self.together {
            together.take(steps);
            if together.is_spent() {
                return Err(self.out_of_steps());
            }
        }
        Ok(())
    }

    /// The program that it runs.
    pub fn program(&self) -> &'p Program<S> {
        self.program
    }

    /// The state of a run that has not begun: one runnable future, the call of the entry function.
    ///
    /// With `depth_first`, futures run where they are created.
    ///
    /// # Errors
    /// The wrong number of arguments.
    pub fn start(&self, args: &[Value<S>], depth_first: bool) -> Result<State<S>, Fault> {
        self.start_call(self.program.entry, &[], args, depth_first)
    }

    /// Runs a runnable future until an answer pauses it, it returns, or it must wait.
    ///
    /// # Errors
    /// A fault of the program, with the model's call stack. The state cannot be used afterwards.
    #[inline]
    pub fn resume<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        future: FutureId,
        answers: &mut A,
    ) -> Result<Stop, Box<RunFault>> {
        self.empty_scratch();
        self.set_ceiling(state);
        let Some(Status::Runnable(node)) = state.futures.get(future.0 as usize).map(|f| &f.status) else {
            return Err(Box::new(
                self.report(state, Fault::new("not-runnable", "this future cannot run now")),
            ));
        };
        let node = *node;
        let (pc, before) = (state.nodes[node.0 as usize].pc as usize, state.steps);
        let stop = self.interpret(state, &mut Dropped, future, (node, pc), answers);
        match stop {
            Ok(stop) => {
                if let Err(fault) = self.take_steps(state.steps - before) {
                    return Err(Box::new(self.report(state, fault)));
                }
                if let Some(held) = self.held
                    && state.has_ended()
                    && let Some(number) = state.unmet.first()
                {
                    answers.unmet(held.name(number));
                }
                Ok(stop)
            }
            Err(fault) => Err(Box::new(self.report(state, fault))),
        }
    }

    /// Runs every future in the order of creation, until none is left. For answers that never pause.
    ///
    /// # Errors
    /// A fault of the program, or futures that wait for each other.
    pub fn finish<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
    ) -> Result<(), Box<RunFault>> {
        while !state.has_ended() {
            let Some(next) = state.runnable().first() else {
                return Err(Box::new(self.waiting_cycle(state)));
            };
            self.resume(state, next, answers)?;
        }
        Ok(())
    }
}
