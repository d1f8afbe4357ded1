//! A machine: a program, limits, and scratch space for any number of states.

use super::ask::LogsOfQuestions;
use super::cache::DistCache;
use super::held::Held;
use super::ids::NodeId;
use crate::code::{FunctionId, Operand, Program};
use crate::fault::Fault;
use crate::value::Value;
use niwaki_geom::Shape;
use niwaki_math::{LastLog, Scalar};
use std::sync::atomic::{AtomicU64, Ordering};

/// The limits of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Calls, iterations and backward jumps of one run. An operation on many elements counts one step for every
    /// 8 elements, and a primitive counts 256.
    pub steps: u64,
    /// Bytes of nodes, registers and values of one run.
    pub bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { steps: 20_000_000, bytes: 1 << 30 }
    }
}

/// The steps that many runs share. Whether they are too many does not depend on the order of the runs.
#[derive(Debug)]
pub struct SharedSteps {
    most: u64,
    used: AtomicU64,
}

impl SharedSteps {
    /// Allows `most` steps.
    pub fn new(most: u64) -> Self {
        SharedSteps { most, used: AtomicU64::new(0) }
    }

    /// The steps used so far.
    pub fn used(&self) -> u64 {
        self.used.load(Ordering::Relaxed)
    }

    /// Whether more steps were used than allowed.
    pub fn is_spent(&self) -> bool {
        self.used() > self.most
    }

    fn take(&self, steps: u64) {
        self.used.fetch_add(steps, Ordering::Relaxed);
    }
}

/// A call of a pure function in progress: the place to continue when it returns.
pub(super) struct PureCall {
    pub(super) caller: FunctionId,
    pub(super) pc: usize,
    pub(super) scratch: usize,
    pub(super) to: Operand,
    /// Whether the result is wrapped in a future that has returned already.
    pub(super) as_future: bool,
}

/// The place of the machine, for the call stack of a fault.
#[derive(Clone, Copy)]
pub(super) struct Here {
    pub(super) node: NodeId,
    pub(super) function: FunctionId,
    pub(super) pc: usize,
    /// The first scratch register of a pure function.
    pub(super) scratch: usize,
}

/// Runs programs. It holds scratch space only, so one machine serves any number of states.
pub struct Machine<'p, S: Scalar = f64> {
    pub(super) program: &'p Program<S>,
    pub(super) limits: Limits,
    pub(super) held: Option<&'p Held<S>>,
    pub(super) together: Option<&'p SharedSteps>,
    pub(super) scratch: Vec<Value<S>>,
    /// The number of scratch registers that were used since they were emptied.
    pub(super) high: usize,
    /// Whether one of these may hold shared data.
    pub(super) holds_shared: bool,
    pub(super) pure: Vec<PureCall>,
    pub(super) buffer: Vec<Value<S>>,
    pub(super) shapes: Vec<Shape>,
    pub(super) cache: DistCache<S>,
    pub(super) logs: LastLog<S>,
    pub(super) logs_of_questions: LogsOfQuestions<S>,
    pub(super) here: Here,
    /// The activation that machine code has called, and whether the run pauses at its factor.
    pub(super) called: NodeId,
    pub(super) pauses: bool,
    /// Whether the machine runs many runs at once; these separate where their memory would have to be counted.
    pub(super) in_lanes: bool,
}

impl<'p, S: Scalar> Machine<'p, S> {
    /// A machine for a program.
    pub fn new(program: &'p Program<S>, limits: Limits) -> Self {
        Machine {
            program,
            limits,
            held: None,
            together: None,
            scratch: Vec::new(),
            high: 0,
            holds_shared: false,
            pure: Vec::new(),
            buffer: Vec::new(),
            shapes: Vec::new(),
            cache: DistCache::holding(limits.bytes / 16),
            logs: LastLog::default(),
            logs_of_questions: Default::default(),
            here: Here { node: NodeId::NONE, function: program.entry, pc: 0, scratch: 0 },
            called: NodeId::NONE,
            pauses: false,
            in_lanes: false,
        }
    }

    /// The machine with held choices, if there are any.
    pub fn holding(self, held: Option<&'p Held<S>>) -> Self {
        Machine { held, ..self }
    }

    /// The machine with steps that its runs share, if there is such a limit.
    pub fn within(self, together: Option<&'p SharedSteps>) -> Self {
        Machine { together, ..self }
    }

    /// Takes the steps of a part of a run from the shared steps.
    #[inline]
    pub(super) fn take_steps(&self, steps: u64) -> Result<(), Fault> {
        if let Some(together) = self.together {
            together.take(steps);
            if together.is_spent() {
                return Err(self.out_of_steps());
            }
        }
        Ok(())
    }

    /// The machine's program.
    pub fn program(&self) -> &'p Program<S> {
        self.program
    }
}
