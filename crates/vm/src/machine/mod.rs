//! The machine: runs a program up to its next question.
//!
//! The verbs are few: [`Machine::start`] a run, [`Machine::resume`] one of its futures, fork it (a `clone` of
//! the [`State`]). The machine never recurses on the host stack, draws no random numbers and does not know
//! which algorithm uses it.
//!
//! * [`address`]: paths of sites as 128-bit hashes; [`held`]: choices with fixed values, by `numbers`;
//! * `workspace`: the machine itself; `outcome`: how a run stops, and how it continues;
//! * [`answers`]: the questions, and the trait of those who answer;
//! * [`state`]: nodes, registers and futures, with their numbers (`ids`) and the copies of their vectors
//!   (`buffers`); [`runnable`]: the futures that can run; `begin`: the state of a run that has not begun;
//! * `budget`: the price of operations in steps and bytes, and the audit of a run's memory;
//! * `parts`: the parts that activations emitted last, for guides, in `boxes`;
//! * [`kept`]: traces: kept activations, and the re-running of changes;
//! * [`lanes`]: many runs at the same place, one instruction at a time for all of them;
//! * `interpret`: the loop over instructions; `registers`: from operands to values;
//! * `cache`: a cache of distributions by their parameters;
//! * `enter`: the entry into machine code; `ask`: the choices that it makes;
//! * `operate`: operations of two operands; `construct`: instructions that build or unpack an aggregate;
//! * `question`: choices and factors; `suspend`: all other sites; `loops`: lifted loops; `memo`: memoised
//!   functions, over `memos`, the existing calls; `keep`: the interface to what is kept of an activation that
//!   returns;
//! * [`stack`]: the model's own call stack, for messages; [`invalid`]: faults of runs that are outside of the
//!   model's support.

pub mod address;
pub mod answers;
mod ask;
mod begin;
mod boxes;
mod budget;
mod buffers;
mod cache;
mod construct;
mod enter;
pub mod held;
mod ids;
mod interpret;
pub mod invalid;
mod keep;
pub mod kept;
pub mod lanes;
mod loops;
mod memo;
mod memos;
mod numbers;
mod operate;
mod outcome;
mod parts;
mod question;
mod registers;
pub mod runnable;
pub mod stack;
pub mod state;
mod suspend;
pub mod words;
mod workspace;

pub use outcome::Stop;
pub use workspace::{Limits, Machine, SharedSteps};

use crate::fault::Fault;
use crate::value::Value;
use answers::Answers;
use keep::Dropped;
use niwaki_math::Scalar;
use stack::RunFault;
use state::{FutureId, State, Status};

impl<S: Scalar> Machine<'_, S> {
    /// The state of a run that has not begun: it has one runnable future, the call of the entry function.
    ///
    /// With `depth_first`, futures run where they are created.
    ///
    /// # Errors
    /// The number of arguments is wrong.
    pub fn start(&self, args: &[Value<S>], depth_first: bool) -> Result<State<S>, Fault> {
        self.start_call(self.program.entry, &[], args, depth_first)
    }

    /// Runs a runnable future until an answer pauses it, the future returns, or it must wait.
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
                self.report(state, Fault::new("not-runnable", "the future cannot run now")),
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

    /// Runs futures one after another until the run has ended. Before each, `next` gives the place of the future among those
    /// that can run; it sees which future ran last and how that stopped. `None` leaves the run where it is.
    ///
    /// # Errors
    /// A fault of the program, or futures that wait for each other.
    #[inline(always)]
    pub fn drive<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
        mut next: impl FnMut(&mut A, &State<S>, Option<(FutureId, Stop)>) -> Option<usize>,
    ) -> Result<(), Box<RunFault>> {
        let mut last = None;
        while !state.has_ended() {
            let Some(place) = next(answers, state, last) else { break };
            let Some(future) = state.runnable().get(place) else {
                return Err(Box::new(self.waiting_cycle(state)));
            };
            last = Some((future, self.resume(state, future, answers)?));
        }
        Ok(())
    }

    /// Runs every future in the order of creation, until none is left. For answers that never pause.
    ///
    /// # Errors
    /// As [`Machine::drive`].
    pub fn finish<A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        answers: &mut A,
    ) -> Result<(), Box<RunFault>> {
        self.drive(state, answers, |_, _, _| Some(0))
    }
}
