//! Moves of single choices, exchanges between two choices of a site, and calls drawn anew.

use super::{Arm, Form, Sizes, Step, leaf};
use niwaki_chain::kernel::Kernel;
use niwaki_vm::fault::Fault;
use serde_json::json;

pub(super) const MOVES: Arm =
    Arm { step: Step("move"), suits: |_, _| true, most_reals: usize::MAX, form: Form::Chain(kernel, 32) };

pub(super) fn kernel(_: &Sizes) -> Result<Kernel, Fault> {
    let drift = |step| leaf("drift", json!({"step": step, "target": 0.44}));
    Ok(Kernel::Mixture(vec![
        (4.0, Kernel::PRIOR),
        (4.0, drift(0.3)?),
        (2.0, drift(0.05)?),
        (4.0, Kernel::EXCHANGE),
        (1.0, leaf("regenerate", json!({"levels": 0}))?),
    ]))
}
