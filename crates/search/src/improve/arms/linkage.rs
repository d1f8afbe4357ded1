//! Moves of a choice with which most parts of the scene stay in place.

use super::{Arm, Form, Step};
use niwaki_chain::kernel::Kernel;

pub(super) const LINKAGE: Arm = Arm {
    step: Step("linkage"),
    suits: |_, task| !task.sketches.is_empty(),
    form: Form::Chain(|_| Ok(Kernel::LINKAGE), 1),
};
