//! The entry into machine code.

use super::registers::Registers;
use super::state::State;
use super::workspace::{Machine, PureCall};
use crate::code::entries::Entry;
use crate::code::register::Reg;
use crate::code::routine::{Exchange, Exit, Routine};
use crate::code::{FunctionId, Mode, Program};
use crate::native;
use crate::value::Value;
use niwaki_math::Scalar;
use std::any::Any;

/// The place where the interpreter continues after machine code.
pub(super) struct Resumption {
    pub function: FunctionId,
    pub scratch: usize,
    pub pc: usize,
    /// The number of instructions that the code ran.
    pub instructions: u64,
}

impl<S: Scalar> Machine<'_, S> {
    /// Runs the machine code that begins here, if there is code for these registers. If every write to a
    /// register of the activation must be recorded, only code without such writes runs.
    #[inline(never)]
    pub(super) fn enter(
        &mut self,
        state: &mut State<S>,
        r: Registers<'_, S>,
        function: FunctionId,
        entry: &Entry,
        writes_plainly: bool,
    ) -> Option<Resumption> {
        for routine in entry.routines().filter(|routine| writes_plainly || !routine.writes_node) {
            let before = if routine.counts { self.allowance(state, r) } else { Exchange::default() };
            let mut after = before;
            if let Some(exit) = self.run_code(state, r, routine, &mut after) {
                if routine.counts {
                    state.steps += (before.steps - after.steps).cast_unsigned();
                    state.charged += (before.bytes - after.bytes) as usize;
                }
                entry.note(|| after.instructions + (before.bytes - after.bytes).cast_unsigned() / 8);
                self.holds_shared |= exit.has_shared;
                for call in &exit.calls {
                    self.pure.push(PureCall {
                        caller: call.caller,
                        pc: call.back as usize,
                        scratch: r.scratch + call.base as usize,
                        to: call.to,
                        as_future: false,
                    });
                }
                return Some(Resumption {
                    function: exit.function,
                    scratch: r.scratch + exit.base as usize,
                    pc: exit.pc as usize,
                    instructions: after.instructions,
                });
            }
        }
        if (writes_plainly || r.f.mode == Mode::Pure) && entry.is_due() {
            self.request_code(state, r, function, entry);
        }
        None
    }

    /// The steps, bytes and registers that code may use.
    fn allowance(&self, state: &State<S>, r: Registers<'_, S>) -> Exchange {
        Exchange {
            steps: state.alarm.saturating_sub(state.steps).min(i64::MAX.cast_unsigned()).cast_signed(),
            bytes: state.ceiling.saturating_sub(state.bytes()) as i64,
            room: self.high.saturating_sub(r.scratch) as i64,
            instructions: 0,
        }
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
