//! The entry into machine code.

use super::answers::Answers;
use super::ask::QuestionsOf;
use super::question::LOGGED;
use super::registers::Registers;
use super::state::{NodeId, State};
use super::workspace::{Machine, PureCall};
use crate::code::entries::Entry;
use crate::code::register::Reg;
use crate::code::routine::{Exchange, Exit, Routine};
use crate::code::{FunctionId, Mode, Program};
use crate::native;
use crate::value::Value;
use niwaki_math::Scalar;
use std::any::Any;

/// The instructions that a choice counts for where the worth of code is judged.
const CHOICE: u64 = 16;

/// The exchange of code that may ask about an activation.
#[inline(always)]
fn asking<S: Scalar, A: Answers<S>>(state: &State<S>, node: NodeId, answers: &mut A) -> Exchange {
    let path = state.nodes[node.0 as usize].path;
    Exchange {
        path: [path as u64, (path >> 64) as u64],
        node: node.0,
        questions: QuestionsOf::<S, A>::ALL,
        answers: std::ptr::from_mut(answers).cast(),
        logged: if A::LOGS { LOGGED as i64 } else { 0 },
        ..Exchange::NOTHING
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// Runs the machine code that begins here, if there is code for these registers. If every write to a
    /// register of the activation must be recorded, only code without such writes runs. If the run `chooses`, the
    /// code asks the answers for choices of the activation. Returns where the code left, and how many instructions
    /// it ran.
    #[inline(never)]
    pub(super) fn enter<'e, A: Answers<S>>(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        (function, entry): (FunctionId, &'e Entry),
        writes_plainly: bool,
        (chooses, node, answers): (bool, NodeId, &mut A),
    ) -> Option<(&'e Exit, u64)> {
        let mut exchange = if chooses { asking(state, node, answers) } else { Exchange::NOTHING };
        for routine in entry.routines().filter(|routine| writes_plainly || !routine.writes_node) {
            if routine.counts {
                self.allow(state, r, &mut exchange);
            }
            let (steps, bytes) = (exchange.steps, exchange.bytes);
            if let Some(exit) = self.run_code(state, r, routine, &mut exchange) {
                let logged = (exchange.logged * exchange.choices.cast_signed()) as usize;
                state.logged += logged;
                let mut charged = 0;
                if routine.counts {
                    state.steps += (steps - exchange.steps).cast_unsigned();
                    charged = (bytes - exchange.bytes) as usize - logged;
                    state.charged += charged;
                }
                entry.note(|| exchange.instructions + charged as u64 / 8 + CHOICE * exchange.choices);
                self.holds_shared |= exit.has_shared;
                (self.called, self.pauses) = (NodeId(exchange.called), exchange.answer != 0);
                for call in &exit.calls {
                    self.pure.push(PureCall {
                        caller: call.caller,
                        pc: call.back as usize,
                        scratch: r.scratch + call.base as usize,
                        to: call.to,
                        as_future: false,
                    });
                }
                return Some((exit, exchange.instructions));
            }
        }
        if (writes_plainly || r.f.mode == Mode::Pure) && entry.is_due() {
            self.request_code(state, r, function, entry);
        }
        None
    }

    /// Allows code the steps, bytes and registers that are left.
    fn allow(&self, state: &State<S>, r: Registers<'_, S>, exchange: &mut Exchange) {
        let steps: u64 = state.alarm.saturating_sub(state.steps);
        exchange.steps = steps.min(i64::MAX.cast_unsigned()).cast_signed();
        exchange.bytes = state.ceiling.saturating_sub(state.bytes()) as i64;
        exchange.room = self.high.saturating_sub(r.scratch) as i64;
    }

    /// Runs a routine. `None` if the registers do not have the kinds that it was written for.
    #[inline]
    #[allow(unsafe_code)]
    fn run_code<'a>(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        routine: &'a Routine,
        exchange: &mut Exchange,
    ) -> Option<&'a Exit> {
        let end = r.scratch + routine.scratch_end;
        if self.scratch.len() < end {
            self.scratch.resize(end, Value::None);
        }
        let registers = state.registers.as_mut_ptr();
        let (node, outer) = (registers.wrapping_add(r.base), registers.wrapping_add(r.outer));
        let scratch = self.scratch.as_mut_ptr().wrapping_add(r.scratch);
        exchange.state = std::ptr::from_mut(state).cast();
        exchange.logs = std::ptr::from_mut(&mut self.logs_of_questions).cast();
        // SAFETY: routines are written for programs of `f64` alone. The verifier has found all registers of the
        // function below the numbers that an activation, and the loop node above it, have in the state.
        unsafe { routine.run(exchange, node.cast(), outer.cast(), scratch.cast()) }
    }

    #[cold]
    fn request_code(&self, state: &State<S>, r: Registers<'_, S>, function: FunctionId, entry: &Entry) {
        let program: &dyn Any = self.program;
        if let Some(program) = program.downcast_ref::<Program>() {
            native::write(entry, program, function, &|reg| {
                let value: &dyn Any = self.content(state, r, reg)?;
                value.downcast_ref::<Value>()
            });
        }
    }

    /// The content of a register; `None` for a register that the machine has not reserved so far.
    fn content<'a>(&'a self, state: &'a State<S>, r: Registers<'_, S>, reg: Reg) -> Option<&'a Value<S>> {
        match reg {
            Reg::Node(i) => state.registers.get(r.base + usize::from(i)),
            Reg::Outer(i) => state.registers.get(r.outer + usize::from(i)),
            Reg::Scratch(i) => self.scratch.get(r.scratch + i as usize),
        }
    }
}
