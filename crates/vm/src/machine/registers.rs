//! From operands to values: the registers of the current activation.

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
            &state.registers[self.base.wrapping_add(o.0 as usize)]
        } else if o.is_outer() {
            &state.registers[self.outer.wrapping_add(o.index())]
        } else if o.is_constant() {
            &self.f.constants[o.index()]
        } else {
            &scratch[self.scratch.wrapping_add(o.index())]
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
        if o.is_node() {
            &mut state.registers[self.base.wrapping_add(o.0 as usize)]
        } else {
            &mut scratch[self.scratch.wrapping_add(o.index())]
        }
    }

    /// Copies a sequence of operands.
    #[inline(always)]
    pub fn gather(self, state: &State<S>, scratch: &[Value<S>], args: Args, into: &mut Vec<Value<S>>) {
        let Registers { f, base, outer, .. } = self;
        gather(f, base, outer, state, &scratch[self.scratch..], args, into);
    }
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
    for o in &f.operands[args.range()] {
        into.push(r.get(state, scratch, *o).clone());
    }
}
