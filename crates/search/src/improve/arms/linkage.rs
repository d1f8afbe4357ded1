//! Moves of a choice with which most parts of the scene stay in place.

use super::{Arm, Form, Step};
use niwaki_chain::kernel::Kernel;
use niwaki_chain::leaf::linkage::CHOICES;

pub(super) const LINKAGE: Arm = Arm {
    step: Step("linkage"),
    suits: |_, task| !task.sketches.is_empty(),
    most_reals: CHOICES,
    form: Form::Chain(|_| Ok(Kernel::LINKAGE), 1),
};
