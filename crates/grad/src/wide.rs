//! A density at several points at once: the tapes with their memory.

use crate::density::Density;
use crate::tape::{Lanes, Tape};

/// A density over `L` lanes. Coordinate `k` of lane `l` is `x[k][l]`, shape (dim, L); gradients have the same shape.
#[derive(Clone, Debug)]
pub struct Wide<const L: usize> {
    both: (Tape, Lanes<L>),
    slope: (Tape, Lanes<L>),
}

impl<const L: usize> Wide<L> {
    /// The lanes of a density.
    pub fn new(density: &Density) -> Wide<L> {
        let with_memory = |tape: Tape| {
            let memory = tape.lanes();
            (tape, memory)
        };
        Wide { both: with_memory(Tape::new(density)), slope: with_memory(Tape::of_gradient(density)) }
    }

    /// The log densities, nats, with the gradients in `g`, and which lanes are inside the guards; the numbers of lanes outside
    /// have no meaning.
    ///
    /// # Panics
    /// If `x` or `g` does not have one entry for each coordinate.
    pub fn value_and_gradient(&mut self, x: &[[f64; L]], g: &mut [[f64; L]]) -> ([f64; L], [bool; L]) {
        let (tape, memory) = &mut self.both;
        let inside = memory.covered(tape, x, g);
        (memory.value(tape), inside)
    }

    /// The gradients alone.
    ///
    /// # Panics
    /// See [`Wide::value_and_gradient`].
    pub fn gradient(&mut self, x: &[[f64; L]], g: &mut [[f64; L]]) -> [bool; L] {
        let (tape, memory) = &mut self.slope;
        memory.covered(tape, x, g)
    }
}
