//! The numbers of a trace's choices, given back to a trace that was made again from their values.
//!
//! The numbers depend on the proposals that a trace has seen, and a chain picks choices by number. So a chain that goes on
//! from stored choices needs them in their order.

use super::trace::{Kept, Trace};
use crate::code::Program;
use niwaki_math::Scalar;
use std::collections::HashMap;

impl<S: Scalar> Trace<S> {
    /// Numbers the choices in the order of these addresses. No transaction is open. Returns false, and does nothing, where
    /// the addresses are not those of the trace, each once.
    pub fn arrange(&mut self, program: &Program<S>, order: &[u128]) -> bool {
        let numbers: HashMap<u128, usize> =
            self.numbers().map(|number| (self.address(program, number), number)).collect();
        let found: Option<Vec<usize>> = order.iter().map(|address| numbers.get(address).copied()).collect();
        let Some(found) = found else { return false };
        let (state, kept) = (&self.state, &mut self.kept);
        let mut seen = vec![false; kept.choices.len()];
        found.iter().for_each(|number| seen[*number] = true);
        if found.len() != seen.len() || seen.contains(&false) {
            return false;
        }
        let choices: Vec<_> = found.into_iter().map(|number| kept.choices[number]).collect();
        for (number, at) in choices.iter().enumerate() {
            kept.slots[Kept::slot_at(state, at.node, at.site as usize)].held = number as u32;
        }
        kept.choices = choices;
        true
    }
}
