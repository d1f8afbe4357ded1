//! Prefetches the memory that the next proposals will need, while the current one runs. In a long chain the
//! activation of a choice is in no cache, and each access on the way to it would wait for the one before.
#![allow(unsafe_code)] // The processor's prefetch, which reads nothing and accepts any address.

use super::trace::{ChoiceAt, Trace};
use crate::code::{Mode, Program};
use niwaki_math::Scalar;

/// Prefetches one address.
#[inline(always)]
fn fetch<T>(items: &[T], at: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: this is a hint, which changes nothing and cannot fail; it is part of every x86-64.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(items.as_ptr().wrapping_add(at).cast()) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (items, at);
}

impl<S: Scalar> Trace<S> {
    /// Prefetches what a proposal to a choice reads: the registers and slots of its activation and of the iteration after it.
    #[inline]
    pub fn prefetch(&self, program: &Program<S>, choice: usize) {
        let ChoiceAt { node, .. } = self.kept.choices[choice];
        let n = &self.state.nodes[node.0 as usize];
        let (registers, slots) = (n.registers as usize, n.slots as usize);
        fetch(&self.state.registers, registers);
        fetch(&self.state.registers, registers + 4);
        fetch(&self.kept.slots, slots);
        let f = program.function(n.function);
        if f.mode == Mode::Iteration {
            let header = &self.state.nodes[n.parent.0 as usize];
            fetch(&self.kept.loops[header.slots as usize], n.iteration as usize + 1);
            // Iterations that were created one after another are adjacent in memory.
            fetch(&self.state.nodes, node.0 as usize + 1);
            fetch(&self.state.registers, registers + 8);
            fetch(&self.kept.slots, slots + 4);
        }
    }
}
