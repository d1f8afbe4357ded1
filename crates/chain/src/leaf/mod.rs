//! Proposals: the leaves of a kernel. Each is a file with its settings, which are read as data, and what it adapts;
//! [`Proposer`] lists them. A leaf is applied to the kept run of a chain or to the partial run of a particle.
//!
//! * a new value for one choice: from the prior, [`drift`], [`neighbour`], `by_family`, by the [`user`]'s function,
//!   by a guide ([`guided`]);
//! * [`block`], `regenerate`, [`regrow`]: proposals that change many choices;
//! * [`trajectory`]: the continuous choices move together along their gradient.

pub mod block;
mod by_family;
pub mod drift;
pub mod guided;
pub mod neighbour;
mod regenerate;
pub mod regrow;
pub mod trajectory;
pub mod user;

use crate::leaf::block::Block;
use crate::leaf::by_family::ByFamily;
use crate::leaf::drift::{Drift, Step};
use crate::leaf::guided::Guided;
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

/// How a leaf proposes. As data it is a name, which is the variant's in small letters, with the settings.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Proposer {
    /// One choice, from its own distribution.
    Prior {},
    /// One continuous choice moves a little; others are drawn from their own distribution.
    Drift(Box<Drift>),
    /// One discrete choice moves to a value near by; others are drawn from their own distribution.
    Neighbour(Neighbour),
    /// One choice, by the move that the original's baseline has for its family.
    ByFamily {},
    /// Many choices move a little at once.
    Block(Box<Block>),
    /// A call and all below it are drawn anew.
    Regenerate(Regenerate),
    /// A part of the run is grown again by conditional SMC.
    Regrow(Box<Regrow>),
    /// The continuous choices move together along their gradient, for a fixed number of steps.
    #[serde(deserialize_with = "trajectory::hmc_step")]
    HmcStep(Box<Trajectory>),
    /// The same until they turn back.
    #[serde(deserialize_with = "trajectory::nuts_step")]
    NutsStep(Box<Trajectory>),
    /// One choice, from a distribution that a model function computes from its value.
    #[serde(skip)]
    Proposal(Arc<User>),
    /// One choice, from what a guide sees around it.
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

    /// Makes one proposal.
    ///
    /// # Errors
    /// A fault of the program, or of the proposal.
    #[inline]
    pub fn apply(&mut self, target: &mut impl Target) -> Result<(), Failure> {
        match self {
            Proposer::Prior {} => target.single(&mut FromPrior),
            Proposer::Drift(own) => target.single(&mut **own),
            Proposer::Neighbour(own) => target.single(own),
            Proposer::ByFamily {} => target.single(&mut ByFamily),
            Proposer::Block(own) => target.block(own),
            Proposer::Regenerate(own) => target.kept(own),
            Proposer::Regrow(own) => target.kept(&mut **own),
            Proposer::HmcStep(own) | Proposer::NutsStep(own) => target.kept(&mut **own),
            Proposer::Proposal(own) => target.single(&mut UserMove(own)),
            Proposer::Guided(own) => target.kept(&mut **own),
        }
    }

    /// What it has learnt from the proposals so far.
    pub(crate) fn learnt(&self) -> Learnt {
        match self {
            Proposer::Drift(own) => Learnt::Steps(own.learnt()),
            Proposer::Block(own) => Learnt::Steps(vec![own.step.learnt()]),
            Proposer::HmcStep(own) | Proposer::NutsStep(own) => Learnt::Travels(Box::new(own.learnt())),
            _ => Learnt::Nothing,
        }
    }

    /// Takes what it had learnt; false where that is not of such a leaf.
    pub(crate) fn know(&mut self, learnt: Learnt) -> bool {
        match (self, learnt) {
            (Proposer::Drift(own), Learnt::Steps(steps)) => own.know(&steps),
            (Proposer::Block(own), Learnt::Steps(steps)) if steps.len() == 1 => {
                own.step = Step::known(steps[0])
            }
            (Proposer::HmcStep(own) | Proposer::NutsStep(own), Learnt::Travels(learnt)) => own.know(*learnt),
            (_, Learnt::Nothing) => {}
            _ => return false,
        }
        true
    }

    /// Whether it looks at the scene.
    pub(crate) fn looks(&self) -> bool {
        match self {
            Proposer::Guided(own) => own.guide.looks(),
            Proposer::Regrow(own) => own.looks(),
            _ => false,
        }
    }

    /// The trajectories of a leaf that follows the gradient.
    pub fn trajectory(&self) -> Option<&Trajectory> {
        match self {
            Proposer::HmcStep(own) | Proposer::NutsStep(own) => Some(own),
            _ => None,
        }
    }
}

/// What a leaf has learnt from its proposals, as data.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Learnt {
    /// Leaves that do not learn.
    Nothing,
    /// Steps.
    Steps(Vec<crate::leaf::drift::Learnt>),
    /// Of trajectories.
    Travels(Box<trajectory::Learnt>),
}

/// The run to which proposals are applied.
pub trait Target {
    /// One choice moves.
    fn single<M: Move>(&mut self, proposer: &mut M) -> Result<(), Failure>;

    /// Many choices move a little at once.
    fn block(&mut self, block: &mut Block) -> Result<(), Failure>;

    /// A move of a chain. It leaves a partial run unchanged.
    fn kept(&mut self, _: &mut impl ChainMove) -> Result<(), Failure> {
        Ok(())
    }
}

/// A leaf: how it proposes, and for which choices.
#[derive(Clone, Debug)]
pub struct Leaf {
    /// How it proposes.
    pub proposer: Proposer,
    /// The choices that it may change.
    pub selection: Selection,
    /// The table with its weights; none where all choices weigh the same.
    pub table: Option<usize>,
}

impl Leaf {
    /// Prepares the leaf for a task, once.
    ///
    /// # Errors
    /// Sketches, which have no gradient that a trajectory could follow; settings that make no sense.
    pub fn prepare(&mut self, task: &Task) -> Result<(), Failure> {
        match &mut self.proposer {
            Proposer::HmcStep(own) | Proposer::NutsStep(own) => own.prepare(task),
            Proposer::Regrow(own) => own.prepare(&self.selection),
            _ => Ok(()),
        }
    }
}
