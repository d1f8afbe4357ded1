//! Proposals: the leaves of a kernel. Each has a file with its settings, which are read as data, and its adaptation. [`Proposer`]
//! lists them. A leaf applies to the kept run of a chain or to the partial run of a particle.

pub mod block;
mod by_family;
pub mod drift;
mod exchange;
pub mod guided;
pub mod linkage;
pub mod neighbour;
mod regenerate;
pub mod regrow;
pub mod trajectory;
pub mod user;

use crate::leaf::block::Block;
use crate::leaf::by_family::ByFamily;
use crate::leaf::drift::{Drift, Step};
use crate::leaf::exchange::Exchange;
use crate::leaf::guided::Guided;
use crate::leaf::linkage::Linkage;
use crate::leaf::neighbour::Neighbour;
use crate::leaf::regenerate::Regenerate;
use crate::leaf::regrow::Regrow;
use crate::leaf::trajectory::Trajectory;
use crate::leaf::user::UserMove;
use crate::walk::ChainMove;
use crate::walk::proposal::{FromPrior, Move};
use niwaki_propose::user::User;
use niwaki_run::select::Selection;
use niwaki_run::setting::Ranges;
use niwaki_run::{Failure, Task};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The proposal of a leaf. As data it is the name of the variant in small letters, with its settings.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Proposer {
    /// A single choice, from its prior.
    Prior {},
    /// A small move of a continuous choice; a discrete choice is drawn from its prior.
    Drift(Box<Drift>),
    /// A move of a discrete choice to a near value; a continuous choice is drawn from its prior.
    Neighbour(Neighbour),
    /// A single choice, by the move of the dissertation's baseline for its family.
    ByFamily {},
    /// A joint small move of many choices.
    Block(Box<Block>),
    /// A redraw of a call and all choices below it.
    Regenerate(Regenerate),
    /// A regrowth of a part of the run by conditional SMC.
    Regrow(Box<Regrow>),
    /// A joint move of the continuous choices along their gradient, for a fixed number of steps.
    #[serde(deserialize_with = "trajectory::hmc_step")]
    HmcStep(Box<Trajectory>),
    /// Like `Hmc`, until the trajectory turns back.
    #[serde(deserialize_with = "trajectory::nuts_step")]
    NutsStep(Box<Trajectory>),
    /// Two real choices of a site, whose sum stays.
    #[serde(skip)]
    Exchange,
    /// A real choice with others that keep most parts of the scene in place.
    #[serde(skip)]
    Linkage,
    /// A single choice, from a distribution that a model function computes from the value.
    #[serde(skip)]
    Proposal(Arc<User>),
    /// A single choice, from a guide.
    #[serde(skip)]
    Guided(Box<Guided>),
}

impl Proposer {
    /// Ranges of the settings of a leaf, by its name.
    pub(crate) fn ranges(name: &str) -> Ranges {
        match name {
            "drift" => Drift::RANGES,
            "neighbour" => Neighbour::RANGES,
            "block" => Block::RANGES,
            "regenerate" => Regenerate::RANGES,
            "regrow" => Regrow::RANGES,
            "hmc_step" => trajectory::HMC_RANGES,
            "nuts_step" => trajectory::NUTS_RANGES,
            _ => &[],
        }
    }

    /// Make a proposal.
    ///
    /// # Errors
    /// A fault of the program, or of the proposal.
    #[inline]
    pub fn apply(&mut self, target: &mut impl Target) -> Result<(), Failure> {
        match self {
            Proposer::Prior {} => target.single(&mut FromPrior),
            Proposer::Drift(drift) => target.single(&mut **drift),
            Proposer::Neighbour(neighbour) => target.single(neighbour),
            Proposer::ByFamily {} => target.single(&mut ByFamily),
            Proposer::Block(block) => target.block(block),
            Proposer::Regenerate(regenerate) => target.kept(regenerate),
            Proposer::Regrow(regrow) => target.kept(&mut **regrow),
            Proposer::HmcStep(trajectory) | Proposer::NutsStep(trajectory) => target.kept(&mut **trajectory),
            Proposer::Exchange => target.kept(&mut Exchange),
            Proposer::Linkage => target.kept(&mut Linkage),
            Proposer::Proposal(proposal) => target.single(&mut UserMove(proposal)),
            Proposer::Guided(guided) => target.kept(&mut **guided),
        }
    }

    /// The adaptation so far, as data.
    pub(crate) fn learnt(&self) -> Learnt {
        match self {
            Proposer::Drift(drift) => Learnt::Steps(drift.learnt()),
            Proposer::Block(block) => Learnt::Steps(vec![block.step.learnt()]),
            Proposer::HmcStep(trajectory) | Proposer::NutsStep(trajectory) => {
                Learnt::Travels(Box::new(trajectory.learnt()))
            }
            _ => Learnt::Unadapted,
        }
    }

    /// Restore an adaptation; return false if it belongs to another kind of leaf.
    pub(crate) fn restore(&mut self, learnt: Learnt) -> bool {
        match (self, learnt) {
            (Proposer::Drift(drift), Learnt::Steps(steps)) => drift.restore(&steps),
            (Proposer::Block(block), Learnt::Steps(steps)) if steps.len() == 1 => {
                block.step = Step::known(steps[0])
            }
            (Proposer::HmcStep(trajectory) | Proposer::NutsStep(trajectory), Learnt::Travels(learnt)) => {
                trajectory.restore(*learnt)
            }
            (_, Learnt::Unadapted) => {}
            _ => return false,
        }
        true
    }

    /// Whether the leaf uses the scene.
    pub(crate) fn looks(&self) -> bool {
        match self {
            Proposer::Guided(guided) => guided.guide.looks(),
            Proposer::Regrow(regrow) => regrow.looks(),
            _ => false,
        }
    }

    /// The trajectories of a gradient leaf.
    pub fn trajectory(&self) -> Option<&Trajectory> {
        match self {
            Proposer::HmcStep(trajectory) | Proposer::NutsStep(trajectory) => Some(trajectory),
            _ => None,
        }
    }
}

/// The adaptation of a leaf, as data.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Learnt {
    /// No adaptation.
    #[serde(rename = "Nothing")]
    Unadapted,
    /// Step sizes.
    Steps(Vec<crate::leaf::drift::Learnt>),
    /// The scales of trajectories.
    Travels(Box<trajectory::Learnt>),
}

/// The run to which proposals are applied.
pub trait Target {
    /// A move of a single choice.
    fn single<M: Move>(&mut self, proposer: &mut M) -> Result<(), Failure>;

    /// Many choices move a little at once.
    fn block(&mut self, block: &mut Block) -> Result<(), Failure>;

    /// A move of a chain, which leaves a partial run unchanged.
    fn kept(&mut self, _: &mut impl ChainMove) -> Result<(), Failure> {
        Ok(())
    }
}

/// A leaf: a proposal and a selection of choices.
#[derive(Clone, Debug)]
pub struct Leaf {
    /// The proposal.
    pub proposer: Proposer,
    /// The selection of choices.
    pub selection: Selection,
    /// The number of the table of weights; `None` for equal weights.
    pub table: Option<usize>,
}

impl Leaf {
    /// Prepare the leaf for a task, once.
    ///
    /// # Errors
    /// Sketches, which have no gradient for a trajectory; invalid settings.
    pub fn prepare(&mut self, task: &Task) -> Result<(), Failure> {
        match &mut self.proposer {
            Proposer::HmcStep(trajectory) | Proposer::NutsStep(trajectory) => trajectory.prepare(task),
            Proposer::Regrow(regrow) => regrow.prepare(&self.selection),
            _ => Ok(()),
        }
    }
}
