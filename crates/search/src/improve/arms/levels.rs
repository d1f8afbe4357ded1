//! Levels: a loop has an iteration more or less, a recursion a level more or less, or a discrete choice is turned, and what stands is
//! held. The edited run is improved by moves before it is compared with the run that it comes from.

use super::{Arm, Form, Step};

pub(super) const LEVELS: Arm =
    Arm { step: Step("levels"), suits: |_, _| true, form: Form::Edits(super::moves::kernel) };
