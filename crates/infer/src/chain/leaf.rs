//! A leaf of a kernel: how it proposes, and for which choices. It is applied to the kept run of a chain or to the partial
//! run of a particle; the dispatch to a proposal is here, for both.

use super::block::Block;
use super::by_family::ByFamily;
use super::drift::Drift;
use super::kernel::Selection;
use super::neighbour::Neighbour;
use super::proposal::{FromPrior, Move};
use super::regrow::Regrow;
use super::trajectory::Trajectory;
use super::user::{User, UserMove};
use crate::{Failure, Task};
use std::sync::Arc;

/// A leaf: how it proposes, and for which choices.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    pub proposer: Proposer,
    pub selection: Selection,
    /// The table with its weights; none where all choices weigh the same.
    pub table: Option<usize>,
}

/// How a leaf proposes.
#[derive(Clone, Debug)]
pub(crate) enum Proposer {
    Prior,
    Drift(Box<Drift>),
    Neighbour(Neighbour),
    ByFamily,
    Block(Box<Block>),
    Regenerate(usize),
    Regrow(Box<Regrow>),
    Trajectory(Box<Trajectory>),
    User(Arc<User>),
}

impl Leaf {
    /// Prepares the leaf for a task, once.
    ///
    /// # Errors
    /// Sketches, which have no gradient that a trajectory could follow.
    pub fn prepare(&mut self, task: &Task) -> Result<(), Failure> {
        match &mut self.proposer {
            Proposer::Trajectory(own) => own.prepare(task),
            Proposer::Regrow(own) => own.prepare(&self.selection),
            _ => Ok(()),
        }
    }
}

/// The run to which proposals are applied. A proposal that it does not support leaves it unchanged.
pub(crate) trait Target {
    /// The share of the warm-up that is over, as long as steps are adapted.
    fn warming(&self) -> Option<f64> {
        None
    }

    /// One choice moves.
    fn single<M: Move>(&mut self, proposer: &mut M) -> Result<(), Failure>;

    /// Many choices move a little at once.
    fn block(&mut self, block: &mut Block) -> Result<(), Failure>;

    /// The call `levels` above a choice is drawn anew.
    fn regenerate(&mut self, _levels: usize) -> Result<(), Failure> {
        Ok(())
    }

    /// A part is grown again.
    fn regrow(&mut self, _own: &Regrow) -> Result<(), Failure> {
        Ok(())
    }

    /// The continuous choices move along their gradient.
    fn trajectory(&mut self, _own: &mut Trajectory) -> Result<(), Failure> {
        Ok(())
    }
}

impl Proposer {
    /// Makes one proposal.
    ///
    /// # Errors
    /// A fault of the program, or of the proposal.
    #[inline]
    pub fn apply(&mut self, target: &mut impl Target) -> Result<(), Failure> {
        let warming = target.warming();
        match self {
            Proposer::Prior => target.single(&mut FromPrior),
            Proposer::Drift(drift) => {
                drift.adapting = warming.is_some();
                target.single(&mut **drift)
            }
            Proposer::ByFamily => target.single(&mut ByFamily),
            Proposer::Neighbour(neighbour) => target.single(neighbour),
            Proposer::User(user) => target.single(&mut UserMove(user)),
            Proposer::Block(block) => {
                block.adapting = warming.is_some();
                target.block(block)
            }
            Proposer::Regenerate(levels) => target.regenerate(*levels),
            Proposer::Regrow(own) => target.regrow(own),
            Proposer::Trajectory(own) => {
                own.warming = warming;
                target.trajectory(own)
            }
        }
    }
}
