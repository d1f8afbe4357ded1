//! From operands to values: the registers of the current activation.
#![allow(unsafe_code)] // What the verifier has held against lengths is not held against them again.

use super::state::State;
use crate::code::{Args, Function, Operand};
use crate::value::Value;
use niwaki_math::Scalar;

/// The places of an activation's operands. The struct is small and passed by value: so the loop of `interpret`
/// keeps its fields in registers of the processor, which a reference would prevent.
#[derive(Clone, Copy)]
pub(super) struct Registers<'a, S: Scalar> {
    /// The function.
    pub f: &'a Function<S>,
    /// The first register of the activation in the state.
    pub base: usize,
    /// The first register of the loop node above an iteration.
    pub outer: usize,
    /// The first register on the machine's scratch stack; zero for all functions that can suspend.
    pub scratch: usize,
}

impl<'a, S: Scalar> Registers<'a, S> {
    /// The value of an operand.
    // The most frequent cases are tested first: a `match` becomes a jump through a table, which the processor
    // predicts less well. An operand of the first class is its own index. A sum that wrapped would be out of bounds.
    #[inline(always)]
    pub fn get<'b>(self, state: &'b State<S>, scratch: &'b [Value<S>], o: Operand) -> &'b Value<S>
    where
        'a: 'b,
    {
        if o.is_node() {
            proven(&state.registers, self.base.wrapping_add(o.0 as usize))
        } else if o.is_outer() {
            proven(&state.registers, self.outer.wrapping_add(o.index()))
        } else if o.is_constant() {
            proven(&self.f.constants, o.index())
        } else {
            proven(scratch, self.scratch.wrapping_add(o.index()))
        }
    }

    /// The register that an instruction writes.
    #[inline(always)]
    pub fn slot<'b>(
        self,
        state: &'b mut State<S>,
        scratch: &'b mut [Value<S>],
        o: Operand,
    ) -> &'b mut Value<S> {
        let (values, at) = match o.is_node() {
            true => (&mut state.registers[..], self.base.wrapping_add(o.0 as usize)),
            false => (scratch, self.scratch.wrapping_add(o.index())),
        };
        debug_assert!(at < values.len(), "a register in range");
        // SAFETY: as in `proven`.
        unsafe { values.get_unchecked_mut(at) }
    }

    /// Copies a sequence of operands.
    #[inline(always)]
    pub fn gather(self, state: &State<S>, scratch: &[Value<S>], args: Args, into: &mut Vec<Value<S>>) {
        let Registers { f, base, outer, .. } = self;
        gather(f, base, outer, state, &scratch[self.scratch..], args, into);
    }
}

/// An element whose place the verifier has proven: a register, a constant or an instruction.
#[inline(always)]
pub(super) fn proven<T>(values: &[T], at: usize) -> &T {
    debug_assert!(at < values.len(), "a place in range");
    // SAFETY: no program without `code::verify` reaches a machine. It has refused operands outside of the constants and registers
    // of their function ("an operand out of range"); a node has all registers of its function (`State::new_node`), and the scratch
    // stack those of each function that runs (`Machine::reserve`). Code is left only by its returns: it has refused "a jump out of
    // the function" and control that "can run off the end".
    unsafe { values.get_unchecked(at) }
}

/// [`Registers::gather`] with separate fields: see there.
#[inline(never)]
fn gather<S: Scalar>(
    f: &Function<S>,
    base: usize,
    outer: usize,
    state: &State<S>,
    scratch: &[Value<S>],
    args: Args,
    into: &mut Vec<Value<S>>,
) {
    let r = Registers { f, base, outer, scratch: 0 };
    into.clear();
    into.extend(f.operands[args.range()].iter().map(|o| r.get(state, scratch, *o).clone()));
}
