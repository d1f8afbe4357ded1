//! A machine: a program, limits, and scratch space for any number of states.

use super::cache::DistCache;
use super::held::Held;
use super::ids::NodeId;
use crate::code::{FunctionId, Operand, Program};
use crate::fault::Fault;
use crate::value::Value;
use niwaki_geom::Shape;
use niwaki_math::{LastLog, Scalar};
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

/// A call of a pure function in progress: where to continue when it returns.
pub(super) struct PureCall {
    pub(super) caller: FunctionId,
    pub(super) pc: usize,
    pub(super) scratch: usize,
    pub(super) to: Operand,
    /// The result is a future that has returned already.
    pub(super) as_future: bool,
}

/// Where the machine is, for the call stack of a fault.
#[derive(Clone, Copy)]
pub(super) struct Here {
    pub(super) node: NodeId,
    pub(super) function: FunctionId,
    pub(super) pc: usize,
    /// The first register of a pure function.
    pub(super) scratch: usize,
}

/// Runs programs. It holds scratch space only, so one machine serves any number of states.
pub struct Machine<'p, S: Scalar = f64> {
    pub(super) program: &'p Program<S>,
    pub(super) limits: Limits,
    pub(super) held: Option<&'p Held<S>>,
    pub(super) together: Option<&'p Together>,
    pub(super) scratch: Vec<Value<S>>,
    /// How many scratch registers were used since they were emptied.
    pub(super) high: usize,
    pub(super) pure: Vec<PureCall>,
    pub(super) buffer: Vec<Value<S>>,
    /// What machine code and the machine exchange.
    pub(super) words: Vec<u64>,
    pub(super) shapes: Vec<Shape>,
    pub(super) cache: DistCache<S>,
    pub(super) logs: LastLog<S>,
    pub(super) here: Here,
    /// It runs many runs at once, which go apart where their memory would have to be counted.
    pub(super) in_lanes: bool,
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
    pub(super) fn take_steps(&self, steps: u64) -> Result<(), Fault> {
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
}
