//! The arms of a search: the kinds of step among which it shares its rounds.
//!
//! An arm is a constant in a file here, with its name in reports, the tasks that it suits, and the form of its steps. A new one is
//! such a file and a row of [`ARMS`].

mod levels;
mod linkage;
mod moves;
mod population;
mod regrow;

use niwaki_chain::kernel::Kernel;
use niwaki_particles::Settings;
use niwaki_propose::proposal::Proposal;
use niwaki_run::Task;
use niwaki_vm::fault::Fault;
use serde::{Deserialize, Deserializer, Serialize};
use std::sync::Arc;

pub(super) use population::POPULATION;

/// All arms. Each that suits the task has the next of the first rounds, in this order.
const ARMS: [&Arm; 6] =
    [&regrow::FEW, &moves::MOVES, &regrow::MANY, &linkage::LINKAGE, &levels::LEVELS, &population::POPULATION];

/// The settings of a search that its arms use.
pub(super) struct Sizes {
    /// Particles of a population.
    pub particles: usize,
    /// Particles that grow a part again.
    pub regrow: usize,
    /// The power of the score.
    pub power: f64,
    /// The proposal that draws choices in place of the prior.
    pub drawn_by: Option<Arc<Proposal>>,
}

/// An arm.
pub(super) struct Arm {
    /// The name in reports.
    pub step: Step,
    /// Whether it suits a task.
    pub suits: fn(&Sizes, &Task) -> bool,
    /// The most real choices of a run for which it makes steps.
    pub most_reals: usize,
    /// The form of its steps.
    pub form: Form,
}

/// The form of the steps of an arm. The seed of a population, and the work of a round, are given by the search.
pub(super) enum Form {
    /// A population from the start.
    Population(fn(&Sizes) -> Settings),
    /// A chain from the best run: its kernel, and the number of proposals between two looks at its work.
    Chain(fn(&Sizes) -> Result<Kernel, Fault>, u64),
    /// Edits of the best run, each improved by a chain with this kernel.
    Edits(fn(&Sizes) -> Result<Kernel, Fault>),
}

/// A kind of step, by its name in reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Step(&'static str);

impl Step {
    /// A population from the start, from whose best run the next rounds go on.
    pub const RESTART: Step = Step("restart");
    /// A run that was given, in place of a first population.
    pub const START: Step = Step("start");

    /// The name in reports.
    pub fn name(self) -> &'static str {
        self.0
    }
}

impl<'de> Deserialize<'de> for Step {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Step, D::Error> {
        let name = String::deserialize(from)?;
        let mut all = ARMS.iter().map(|arm| arm.step).chain([Step::RESTART, Step::START]);
        all.find(|step| step.0 == name).ok_or_else(|| serde::de::Error::custom(format!("no step {name:?}")))
    }
}

/// The arms that suit a task.
pub(super) fn suitable(sizes: &Sizes, task: &Task) -> Vec<&'static Arm> {
    ARMS.into_iter().filter(|arm| (arm.suits)(sizes, task)).collect()
}

/// A leaf of a kernel from its settings.
fn leaf(name: &str, settings: serde_json::Value) -> Result<Kernel, Fault> {
    Kernel::leaf(name, settings).map_err(|error| Fault::new("bad-kernel", error.to_string()))
}
