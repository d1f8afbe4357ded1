//! The model's own call stack, for the message of a fault.

use super::registers::Registers;
use super::state::{NodeId, State};
use super::workspace::{Here, Machine};
use crate::code::{FunctionId, Mode, Op, SiteKind};
use crate::core::{Name, Span};
use crate::fault::Fault;
use niwaki_math::Scalar;
use std::collections::VecDeque;

/// A call of a stack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// Qualified name of the function.
    pub function: Name,
    /// The number of the source file.
    pub file: u32,
    /// The place of the call; for the last entry, the place of the fault.
    pub span: Span,
}

/// A fault, and the place where it happened.
#[derive(Clone, Debug)]
pub struct RunFault {
    /// The fault.
    pub fault: Fault,
    /// The calls in progress, outermost first. Of a deep stack, only both ends.
    pub stack: Vec<Call>,
    /// The number of calls that were left out in the middle.
    pub omitted: usize,
    /// The readable path of the activation, for a replay; empty for a deep stack.
    pub path: String,
}

impl std::fmt::Display for RunFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.fault.code, self.fault.message)?;
        for call in self.stack.iter().rev() {
            write!(f, "\n  in {} at {}:{}", call.function, call.span.line, call.span.column)?;
        }
        Ok(())
    }
}

/// Faults that may be caused by a value of another kind.
const OF_KIND: [&str; 10] = [
    "type-mismatch",
    "bad-argument",
    "bad-parameter",
    "bad-shape",
    "bad-format",
    "missing-key",
    "missing-field",
    "missing-method",
    "not-callable",
    "not-a-distribution",
];

/// The number of calls that are kept at each end of a deep stack.
const ENDS: usize = 8;

/// Both ends of a stack. All calls of an endless recursion would take more memory than the run.
#[derive(Default)]
struct Ends {
    inner: Vec<Call>,
    outer: VecDeque<Call>,
    omitted: usize,
    /// The function of the call that was added last, if that call was the body of a loop.
    body_of: Option<Name>,
}

impl Ends {
    /// Adds the call around the call that was added last.
    fn add(&mut self, call: Call) {
        let is_body = call.function.contains('/');
        let name = match call.function.split_once('/') {
            Some((name, _)) => Name::from(name),
            None => call.function.clone(),
        };
        // For the author, the body of a loop is not a separate call.
        let inside = self.body_of.take().is_some_and(|inner| inner == name);
        self.body_of = is_body.then(|| name.clone());
        if inside {
            return;
        }
        let call = Call { function: name, ..call };
        if self.inner.len() < ENDS {
            return self.inner.push(call);
        }
        if self.outer.len() == ENDS {
            self.outer.pop_front();
            self.omitted += 1;
        }
        self.outer.push_back(call);
    }

    /// The calls, and the number of calls that were left out between them.
    fn outermost_first(self) -> (Vec<Call>, usize) {
        (self.outer.into_iter().rev().chain(self.inner.into_iter().rev()).collect(), self.omitted)
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// The fault, with the call stack at the current place of the machine.
    pub(super) fn report(&self, state: &State<S>, fault: Fault) -> RunFault {
        let fault = self.of_future(state, fault);
        let call = |function: FunctionId, pc: usize| {
            let f = self.program.function(function);
            Call { function: f.name.clone(), file: f.file, span: f.spans.get(pc).copied().unwrap_or(f.span) }
        };
        // Innermost first: pure calls, then activations up to the first activation of the future.
        let mut calls = Ends::default();
        calls.add(call(self.here.function, self.here.pc));
        for pure in self.pure.iter().rev() {
            calls.add(call(pure.caller, pure.pc - 1));
        }
        let mut at = self.here.node;
        while at != NodeId::NONE {
            let n = &state.nodes[at.0 as usize];
            if n.parent == NodeId::NONE {
                break;
            }
            let parent = &state.nodes[n.parent.0 as usize];
            let f = self.program.function(parent.function);
            if f.mode != Mode::Loop {
                let site = &f.sites[n.site as usize];
                calls.add(call(parent.function, site.next as usize - 1));
            }
            at = n.parent;
        }
        let (stack, omitted) = calls.outermost_first();
        let path = if omitted > 0 { String::new() } else { state.path(self.program, self.here.node) };
        RunFault { fault, stack, omitted, path }
    }

    /// Turns the fault into that of a future that is not forced, if the instruction met such a future.
    fn of_future(&self, state: &State<S>, fault: Fault) -> Fault {
        let Here { node, function, pc, scratch } = self.here;
        let f = self.program.function(function);
        let Some(op) = f.code.get(pc).filter(|_| node != NodeId::NONE && OF_KIND.contains(&fault.code))
        else {
            return fault;
        };
        // Operators, calls and indices look at their operands; built-in functions and questions look inside of
        // them as well.
        let looks_inside = match op {
            Op::Builtin { .. } | Op::Dist { .. } => true,
            Op::Site { site } => !matches!(
                f.sites[site.0 as usize].kind,
                SiteKind::Apply | SiteKind::FutureApply { .. } | SiteKind::Read | SiteKind::Loop(_)
            ),
            _ => false,
        };
        let (base, outer) = if f.mode == Mode::Pure { (0, 0) } else { self.bases(state, f, node) };
        let r = Registers { f, base, outer, scratch };
        let reads_future = f.reads(op).into_iter().any(|o| {
            let value = r.get(state, &self.scratch, o);
            if looks_inside { value.holds_future() } else { value.is_future() }
        });
        if reads_future { Fault::not_forced(fault.message.clone()) } else { fault }
    }

    pub(super) fn out_of_steps(&self) -> Fault {
        let n = self.limits.steps;
        Fault::new("step-budget", format!("the model took more than {n} steps without ending"))
            .with_help("check that every loop and recursion ends, or raise `max_steps`")
    }

    pub(super) fn out_of_memory(&self) -> Fault {
        let megabytes = self.limits.bytes >> 20;
        let needs = format!("the model needs more than {megabytes} MB for its calls and values");
        Fault::new("memory-budget", needs)
            .with_help("check that every recursion ends and every list stays short, or raise `max_memory`")
    }

    /// The fault of futures that wait for each other.
    pub fn waiting_cycle(&self, state: &State<S>) -> RunFault {
        let mut stack = Vec::new();
        for future in &state.futures {
            if let super::state::Status::Waiting(node, _) = future.status {
                let n = &state.nodes[node.0 as usize];
                let f = self.program.function(n.function);
                let span = f.spans.get(n.pc as usize).copied().unwrap_or(f.span);
                stack.push(Call { function: f.name.clone(), file: f.file, span });
            }
        }
        let fault = Fault::new("waiting-cycle", "futures wait for each other, so none of them can continue")
            .with_help("change one of them so that it does not need the other's value");
        RunFault { fault, stack, omitted: 0, path: String::new() }
    }
}
