//! The entry into machine code: registers go in, and changed registers come back.

use super::registers::Registers;
use super::state::State;
use super::workspace::{Machine, PureCall};
use crate::code::entries::Entry;
use crate::code::register::{FreshForm, Kind, Part, Reg, is_counted};
use crate::code::routine::{Exit, Input, Routine, words};
use crate::code::{FunctionId, Mode, Program};
use crate::native;
use crate::value::{Range, Value};
use niwaki_math::Scalar;
use std::any::Any;
use std::sync::Arc;

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
        if !writes_plainly && entry.routines().any(|routine| routine.writes_node) {
            return None;
        }
        for routine in entry.routines() {
            if self.load_inputs(state, r, routine) {
                let [steps, bytes] = [words::STEPS, words::BYTES].map(|at| self.words[at]);
                let exit = routine.run(&mut self.words);
                state.steps += steps - self.words[words::STEPS];
                state.charged += (bytes - self.words[words::BYTES]) as usize;
                let instructions = self.words[words::INSTRUCTIONS];
                entry.note(instructions + (bytes - self.words[words::BYTES]) / 8);
                self.store_results(state, r, exit);
                return Some(Resumption {
                    function: exit.function,
                    scratch: r.scratch + exit.base as usize,
                    pc: exit.pc as usize,
                    instructions,
                });
            }
        }
        if (writes_plainly || r.f.mode == Mode::Pure) && entry.is_due() {
            let program: &dyn Any = self.program;
            if let Some(program) = program.downcast_ref::<Program>() {
                native::write(entry, program, function, &|reg| {
                    let value: &dyn Any = self.content(state, r, reg)?;
                    value.downcast_ref::<Value>()
                });
            }
        }
        None
    }

    /// The content of a register; `None` for a register that the machine has not reserved so far.
    #[inline]
    fn content<'a>(&'a self, state: &'a State<S>, r: Registers<'_, S>, reg: Reg) -> Option<&'a Value<S>> {
        match reg {
            Reg::Node(i) => state.registers.get(r.base + usize::from(i)),
            Reg::Outer(i) => state.registers.get(r.outer + usize::from(i)),
            Reg::Scratch(i) => self.scratch.get(r.scratch + i as usize),
        }
    }

    /// Writes the inputs of the code to the words. Returns `false` if a register does not have the kind that
    /// the code was written for.
    fn load_inputs(&mut self, state: &State<S>, r: Registers<'_, S>, routine: &Routine) -> bool {
        if self.words.len() < routine.words {
            self.words.resize(routine.words, 0);
        }
        let mut words = std::mem::take(&mut self.words);
        let fits = self.fill(state, r, routine, &mut words);
        self.words = words;
        fits
    }

    fn fill(&self, state: &State<S>, r: Registers<'_, S>, routine: &Routine, words: &mut [u64]) -> bool {
        let address = |value: &Value<S>| std::ptr::from_ref(value) as u64;
        for &Input { reg, kind, word: at } in &routine.inputs {
            let Some(value) = self.content(state, r, reg) else { return false };
            match (value, kind) {
                (Value::Real(x), Kind::Real) => words[at] = x.value().to_bits(),
                (Value::Int(n), Kind::Int) => words[at] = n.cast_unsigned(),
                (Value::Bool(b), Kind::Bool) => words[at] = u64::from(*b),
                (Value::Range(range), Kind::Range) => {
                    let [first, step] = [range.start, range.step].map(i64::cast_unsigned);
                    words[at..at + 3].copy_from_slice(&[address(value), first, step]);
                }
                (value, Kind::Object(_)) if Kind::of(value) == kind => words[at] = address(value),
                (value, kind) if kind.words() == 0 && Kind::of(value) == kind => {}
                _ => return false,
            }
        }
        let is_free = |reg: &Reg| self.content(state, r, *reg).is_none_or(|value| !is_counted(*reg, value));
        let end = self.scratch.len().min(r.scratch + routine.scratch_end);
        let (nodes, scratch) = routine.overwritten.split_at(routine.overwritten_nodes);
        // Nearly always all scratch registers are free, which is found sooner by testing a whole row.
        let are_free =
            self.scratch[r.scratch..end].iter().all(Value::is_plain) || scratch.iter().all(is_free);
        if !(are_free && nodes.iter().all(is_free)) {
            return false;
        }
        for (k, (id, i)) in routine.constants.iter().enumerate() {
            words[words::CONSTANTS + k] = address(&self.program.function(*id).constants[usize::from(*i)]);
        }
        words[words::STEPS] = state.alarm.saturating_sub(state.steps).min(i64::MAX.cast_unsigned());
        words[words::BYTES] = state.ceiling.saturating_sub(state.bytes()) as u64;
        words[words::ROOM] = self.high.saturating_sub(r.scratch) as u64;
        true
    }

    /// Writes the registers that the code has changed, and turns its calls of pure functions into calls of the
    /// machine.
    fn store_results(&mut self, state: &mut State<S>, r: Registers<'_, S>, exit: &Exit) {
        if exit.has_objects {
            // All objects are copied before any register is written, because they may be in these registers.
            self.buffer.clear();
            let mut at = words::REGISTERS;
            for (_, kind) in &exit.registers {
                if matches!(kind, Kind::Object(_) | Kind::Range) {
                    self.buffer.push(shared(self.words[at]));
                }
                at += kind.words_out();
            }
        }
        let mut objects = self.buffer.drain(..);
        let mut fresh: Vec<(u16, Value<S>)> = Vec::new();
        let mut at = words::REGISTERS;
        for (reg, kind) in &exit.registers {
            let register = match *reg {
                Reg::Node(i) | Reg::Outer(i) => &mut state.registers[r.base + usize::from(i)],
                Reg::Scratch(i) => &mut self.scratch[r.scratch + i as usize],
            };
            let word = self.words[at];
            match kind {
                Kind::Real => register.store_real(S::from_f64(f64::from_bits(word))),
                Kind::Int => register.store_int(word.cast_signed()),
                Kind::Bool => register.store(Value::Bool(word != 0)),
                Kind::None | Kind::Opaque => register.store(Value::None),
                Kind::Unset => register.store(Value::Unset),
                Kind::Range | Kind::Object(_) => {
                    self.holds_shared = true;
                    register.store(objects.next().unwrap_or_default());
                }
                Kind::Fresh { form, parts, number } => {
                    let known =
                        fresh.iter().find(|(other, _)| other == number).map(|(_, value)| value.clone());
                    let value = known.unwrap_or_else(|| {
                        let value = build(*form, parts, &self.words[at..]);
                        fresh.push((*number, value.clone()));
                        value
                    });
                    self.holds_shared = true;
                    register.store(value);
                }
            }
            at += kind.words_out();
        }
        for call in &exit.calls {
            self.pure.push(PureCall {
                caller: call.caller,
                pc: call.back as usize,
                scratch: r.scratch + call.base as usize,
                to: call.to,
                as_future: false,
            });
        }
    }
}

/// A vector, tuple or range of the numbers in these words.
fn build<S: Scalar>(form: FreshForm, parts: &[Option<Part>], words: &[u64]) -> Value<S> {
    let numbers = parts.iter().flatten().zip(words).map(|(part, word)| match part {
        Part::Bool => Value::Bool(*word != 0),
        Part::Int => Value::Int(word.cast_signed()),
        Part::Real => Value::real(f64::from_bits(*word)),
    });
    match form {
        FreshForm::Tuple => Value::tuple(numbers.collect()),
        FreshForm::Range => {
            let [start, stop, step] = [0, 1, 2].map(|k| words[k].cast_signed());
            Range::new(start, stop, step).map_or(Value::None, |range| Value::Range(Arc::new(range)))
        }
        FreshForm::Vector => {
            let reals = words.iter().take(parts.iter().flatten().count());
            let reals: Vec<S> = reals.map(|word| S::from_f64(f64::from_bits(*word))).collect();
            Value::vector(&reals)
        }
    }
}

/// Copies the value at an address that the code returned.
#[allow(unsafe_code)]
fn shared<S: Scalar>(address: u64) -> Value<S> {
    // SAFETY: the code returns only addresses that it received, or addresses of parts of the values there.
    // Nothing has been written since.
    unsafe { (*(address as *const Value<S>)).clone() }
}
