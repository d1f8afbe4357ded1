//! Kernels as values: a tree whose leaves propose and whose branches choose the next leaf.
//!
//! An *application* of `cycle(a, b)` is an application of `a` and then of `b`. A chain applies its kernel repeatedly and counts
//! proposals, so it may stop in the middle of a cycle and resume there.

use crate::leaf::Proposer;
use niwaki_run::select::Selection;

/// A Markov kernel.
#[derive(Clone, Debug)]
pub enum Kernel {
    /// A leaf: a single proposal.
    Leaf(Proposer),
    /// All kernels in order.
    Cycle(Vec<Kernel>),
    /// A random kernel, drawn by weight.
    Mixture(Vec<(f64, Kernel)>),
    /// A kernel, repeated.
    Repeat(u64, Box<Kernel>),
    /// A kernel restricted to a selection of choices, or with other selection weights.
    On(Selection, Box<Kernel>),
    /// An annealed kernel: the power of the score changes geometrically from `start` to `end` in `steps` proposals.
    Anneal {
        /// The first power.
        start: f64,
        /// The last power.
        end: f64,
        /// The number of proposals from the first to the last power.
        steps: u64,
        /// The annealed kernel.
        kernel: Box<Kernel>,
    },
}

impl Kernel {
    /// Propose a value for a single choice from its prior.
    pub const PRIOR: Kernel = Kernel::Leaf(Proposer::Prior {});
    /// Exchanges between two choices of a site.
    pub const EXCHANGE: Kernel = Kernel::Leaf(Proposer::Exchange);
    /// Moves of a choice that leave most parts of the scene in place.
    pub const LINKAGE: Kernel = Kernel::Leaf(Proposer::Linkage);

    /// Whether the kernel or a part of it satisfies a predicate.
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
