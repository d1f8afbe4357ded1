//! Why a point of a task's density was refused.

use niwaki_grad::Live;
use niwaki_vm::machine::stack::RunFault;

/// Why there is no finite log density or gradient at `x`: the run's fault there, or the first term to blame, with its
/// line. `None` for a point that is not finite: that is no fault of the model.
pub fn reason(live: &Live, x: &[f64]) -> Option<Box<RunFault>> {
    if x.iter().any(|x| !x.is_finite()) {
        return None;
    }
    live.model().blame(&live.recorded().values(x))
}
