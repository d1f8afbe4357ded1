//! Kernels as values: a tree whose leaves propose and whose branches choose the next leaf.
//!
//! One *application* of `cycle(a, b)` is one of `a` and then one of `b`; a chain applies its kernel again and again, and
//! counts proposals, so it may stop in the middle of a cycle and go on there.

use crate::leaf::Proposer;
use niwaki_run::select::Selection;

/// A Markov kernel.
#[derive(Clone, Debug)]
pub enum Kernel {
    /// One proposal.
    Leaf(Proposer),
    /// One after the other.
    Cycle(Vec<Kernel>),
    /// One of several, by weight.
    Mixture(Vec<(f64, Kernel)>),
    /// One kernel, a number of times.
    Repeat(u64, Box<Kernel>),
    /// Restricted to some choices, or with other selection weights.
    On(Selection, Box<Kernel>),
    /// The score's power goes from `start` to `end`, geometrically, in `steps` proposals.
    Anneal {
        /// First power.
        start: f64,
        /// Last power.
        end: f64,
        /// Proposals from the first to the last.
        steps: u64,
        /// What is annealed.
        kernel: Box<Kernel>,
    },
}

impl Kernel {
    /// One choice, from its own distribution.
    pub const PRIOR: Kernel = Kernel::Leaf(Proposer::Prior {});

    /// Whether the kernel, or one that it is made of, is of a kind.
    pub fn any(&self, is: &impl Fn(&Kernel) -> bool) -> bool {
        is(self)
            || match self {
                Kernel::Cycle(inner) => inner.iter().any(|kernel| kernel.any(is)),
                Kernel::Mixture(inner) => inner.iter().any(|(_, kernel)| kernel.any(is)),
                Kernel::Repeat(_, kernel) | Kernel::On(_, kernel) | Kernel::Anneal { kernel, .. } => {
                    kernel.any(is)
                }
                Kernel::Leaf(_) => false,
            }
    }
}
