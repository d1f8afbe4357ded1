//! The model's own call stack, for the message of a fault.

use super::registers::Registers;
use super::state::{NodeId, State};
use super::{Here, Machine};
use crate::code::{FunctionId, Mode, Op, SiteKind};
use crate::core::{Name, Span};
use crate::fault::Fault;
use crate::passes::place::reads_and_writes;
use niwaki_math::Scalar;

/// One call of a stack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// Qualified name of the function.
    pub function: Name,
    /// Number of its source file.
    pub file: u32,
    /// The call, or (last entry) the place of the fault.
    pub span: Span,
}

/// A fault and where it happened.
#[derive(Clone, Debug)]
pub struct RunFault {
    /// What went wrong.
    pub fault: Fault,
    /// The calls in progress, outermost first. Of a deep stack, the two ends.
    pub stack: Vec<Call>,
    /// How many calls were left out in the middle.
    pub omitted: usize,
    /// Readable path of the activation, for replaying; empty for a deep stack.
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

/// Faults that a value of another kind may be the cause of.
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

/// Calls kept at each end of a deep stack.
const ENDS: usize = 8;

impl<S: Scalar> Machine<'_, S> {
    /// The fault with the call stack at the place where the machine is.
    pub(super) fn report(&self, state: &State<S>, fault: Fault) -> RunFault {
        let fault = self.of_future(state, fault);
        let call = |function: FunctionId, pc: usize| {
            let f = self.program.function(function);
            Call { function: f.name.clone(), file: f.file, span: f.spans.get(pc).copied().unwrap_or(f.span) }
        };
        // Innermost first: pure calls, then activations up to the future's own.
        let mut calls = vec![call(self.here.function, self.here.pc)];
        for pure in self.pure.iter().rev() {
            calls.push(call(pure.caller, pure.pc - 1));
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
                calls.push(call(parent.function, site.next as usize - 1));
            }
            at = n.parent;
        }
        // A loop's body is no call of its own to the person who wrote it.
        let mut stack: Vec<Call> = Vec::new();
        for (i, c) in calls.iter().enumerate() {
            let name = Name::from(c.function.split('/').next().unwrap_or(&c.function));
            if i > 0
                && stack.last().is_some_and(|inner: &Call| inner.function == name)
                && self.is_body(&calls[i - 1])
            {
                continue;
            }
            stack.push(Call { function: name, ..c.clone() });
        }
        stack.reverse();
        let omitted = stack.len().saturating_sub(2 * ENDS);
        if omitted > 0 {
            stack.drain(ENDS..ENDS + omitted);
        }
        let path = if omitted > 0 { String::new() } else { state.path(self.program, self.here.node) };
        RunFault { fault, stack, omitted, path }
    }

    /// The same fault, as that of a future that is not forced where the instruction met one.
    fn of_future(&self, state: &State<S>, fault: Fault) -> Fault {
        let Here { node, function, pc, scratch } = self.here;
        let f = self.program.function(function);
        let Some(op) = f.code.get(pc).filter(|_| node != NodeId::NONE && OF_KIND.contains(&fault.code))
        else {
            return fault;
        };
        // Operators, calls and indices look at their operands; built-in functions and questions look inside, too.
        let looks_inside = match op {
            Op::Builtin { .. } | Op::Dist { .. } => true,
            Op::Site { site } => !matches!(
                f.sites[site.0 as usize].kind,
                SiteKind::Apply | SiteKind::FutureApply { .. } | SiteKind::Read | SiteKind::Loop(_)
            ),
            _ => false,
        };
        let (own, outer) = if f.mode == Mode::Pure { (0, 0) } else { self.bases(state, f, node) };
        let r = Registers { f, own, outer, scratch };
        let met = reads_and_writes(f, op).0.into_iter().any(|o| {
            let value = r.get(state, &self.scratch, o);
            if looks_inside { value.holds_future() } else { value.is_future() }
        });
        if met { Fault::not_forced(fault.message.clone()) } else { fault }
    }

    fn is_body(&self, call: &Call) -> bool {
        call.function.contains('/')
    }

    pub(super) fn out_of_steps(&self) -> Fault {
        let n = self.limits.steps;
        Fault::new("step-budget", format!("the model took more than {n} steps without ending"))
            .with_help("check that every loop and recursion ends, or raise `max_steps`")
    }

    pub(super) fn out_of_memory(&self) -> Fault {
        let megabytes = self.limits.bytes >> 20;
        Fault::new("memory-budget", format!("the model needs more than {megabytes} MB for its calls"))
            .with_help("check that every recursion ends, or raise `max_memory`")
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
