//! Kernels as values: a tree whose leaves propose and whose branches choose the next leaf.
//!
//! One *application* of `cycle(a, b)` is one of `a` and then one of `b`; a chain applies its kernel again and again, and
//! counts proposals, so it may stop in the middle of a cycle and go on there.

use super::regrow::Pick;
use super::user::User;
use crate::hamiltonian::chains::Length;
use std::sync::Arc;

/// Which choices a kernel may change, and with what selection weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Patterns over readable addresses: of each list, one must match.
    pub sites: Vec<Vec<String>>,
    /// Selection weights by number of calls above the choice; the last one counts for all deeper choices.
    pub depth: Vec<f64>,
    /// The names in addresses of the calls that count as depth; all calls where it is empty.
    pub calls: String,
    /// Selection weights by pattern over readable addresses; the first match counts, and 1 where none matches.
    pub weights: Vec<(String, f64)>,
}

/// A Markov kernel.
#[derive(Clone, Debug)]
pub enum Kernel {
    /// One choice, from its own distribution.
    Prior,
    /// One continuous choice moves a little; others are drawn from their own distribution.
    Drift {
        /// First step, in spreads of the choice's distribution.
        step: f64,
        /// Acceptance that the steps are adapted to while the chain warms up.
        target: f64,
    },
    /// One discrete choice moves to a value near by; others are drawn from their own distribution.
    Neighbour {
        /// How far at most.
        reach: u64,
    },
    /// One choice, by the move that the original's baseline has for its family.
    ByFamily,
    /// Many choices move a little at once.
    Block {
        /// First step, in spreads of each choice's first distribution.
        step: f64,
        /// Probability with which each choice takes part.
        share: f64,
        /// Acceptance that the step is adapted to while the chain warms up.
        target: f64,
    },
    /// A call and all below it are drawn anew.
    Regenerate {
        /// How many levels the call is above the picked choice.
        levels: usize,
    },
    /// A part of the run is grown again by conditional SMC.
    Regrow {
        /// Particles, the one with the present values among them.
        particles: usize,
        /// How often a discrete choice of the part gets another value, where it has one.
        turn: f64,
        /// Which part.
        pick: Pick,
    },
    /// The continuous choices move together along their gradient.
    Trajectory {
        /// How long trajectories are.
        length: Length,
        /// First step for one coordinate, in spreads of its site's first distribution.
        step: f64,
        /// Acceptance that the step is adapted to while the chain warms up.
        target: f64,
    },
    /// One choice, from a distribution that a model function computes from its value.
    User(Arc<User>),
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
    /// Whether the kernel, or one that it is made of, is of a kind.
    pub fn any(&self, is: &impl Fn(&Kernel) -> bool) -> bool {
        is(self)
            || match self {
                Kernel::Cycle(inner) => inner.iter().any(|kernel| kernel.any(is)),
                Kernel::Mixture(inner) => inner.iter().any(|(_, kernel)| kernel.any(is)),
                Kernel::Repeat(_, kernel) | Kernel::On(_, kernel) | Kernel::Anneal { kernel, .. } => {
                    kernel.any(is)
                }
                _ => false,
            }
    }
}
