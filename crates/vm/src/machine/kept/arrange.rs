//! The numbers of a trace's choices, restored in a trace that was rebuilt from their values.
//!
//! The numbers depend on the proposals that a trace has seen, and a chain picks choices by number. So a chain
//! that resumes from stored choices needs them in their old order.

use super::trace::{Kept, Trace};
use crate::code::Program;
use niwaki_math::Scalar;
use std::collections::HashMap;

impl<S: Scalar> Trace<S> {
    /// Numbers the choices in the order of these addresses. No transaction may be open. Returns `false`, and
    /// does nothing, unless these are the addresses of the trace, each once.
    pub fn arrange(&mut self, program: &Program<S>, order: &[u128]) -> bool {
        let numbers: HashMap<u128, usize> =
            self.numbers().map(|number| (self.address(program, number), number)).collect();
        let numbers_in_order: Option<Vec<usize>> =
            order.iter().map(|address| numbers.get(address).copied()).collect();
        let Some(numbers_in_order) = numbers_in_order else { return false };
        let (state, kept) = (&self.state, &mut self.kept);
        let mut seen = vec![false; kept.choices.len()];
        numbers_in_order.iter().for_each(|number| seen[*number] = true);
        if numbers_in_order.len() != seen.len() || seen.contains(&false) {
            return false;
        }
        let choices: Vec<_> = numbers_in_order.into_iter().map(|number| kept.choices[number]).collect();
        for (number, at) in choices.iter().enumerate() {
            kept.slots[Kept::slot_at(state, at.node, at.site as usize)].held = number as u32;
        }
        kept.choices = choices;
        true
    }
}
