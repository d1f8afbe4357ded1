//! Parts of the best run, grown again by few or by many particles. The parts of a run share calls of memoised functions, so no part of
//! a model with these can be grown again.

use super::{Arm, Form, Sizes, Step, leaf};
use niwaki_chain::kernel::Kernel;
use niwaki_run::Task;
use niwaki_vm::fault::Fault;
use serde_json::json;

/// The probability that a discrete choice of a part turns when the part is grown again.
const TURN: f64 = 0.7;
/// The share of the parts that a proposal draws, where there is one. The prior draws the others, for what the proposal has never met.
const GUIDED: f64 = 0.8;
/// Factor of the number of particles in rounds of "regrow more".
const MORE: usize = 5;

pub(super) const FEW: Arm = Arm {
    step: Step("regrow"),
    suits: has_parts,
    most_reals: usize::MAX,
    form: Form::Chain(|sizes| kernel(sizes, sizes.regrow), 1),
};

pub(super) const MANY: Arm = Arm {
    step: Step("regrow more"),
    suits: has_parts,
    most_reals: usize::MAX,
    form: Form::Chain(|sizes| kernel(sizes, MORE * sizes.regrow), 1),
};

fn has_parts(_: &Sizes, task: &Task) -> bool {
    !task.program.memoises()
}

fn kernel(sizes: &Sizes, particles: usize) -> Result<Kernel, Fault> {
    let settings = json!({"particles": particles, "turn": TURN, "pick": "size", "best": true});
    let plain = leaf("regrow", settings)?;
    Ok(match &sizes.drawn_by {
        None => plain,
        Some(proposal) => {
            let guided = plain.clone().drawn_by(proposal.clone());
            Kernel::Mixture(vec![(GUIDED, guided), (1.0 - GUIDED, plain)])
        }
    })
}
