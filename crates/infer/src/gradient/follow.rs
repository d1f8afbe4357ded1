//! A task's density as a target of chains, and why a point was refused.

use crate::hamiltonian::lanes;
use crate::hamiltonian::{Cause, Potential, Stop};
use niwaki_grad::{Live, Refused, Rolling, Wide};
use niwaki_vm::machine::stack::RunFault;

impl Potential for Live {
    fn dim(&self) -> usize {
        Live::dim(self)
    }

    /// What is not finite stops a trajectory by itself: see [`crate::hamiltonian::potential::evaluate`].
    #[inline]
    fn value_and_gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<f64, Stop> {
        Live::value_and_gradient(self, x, gradient)
            .map_err(|refused| Stop { cause: cause(&refused), place: 0 })
    }

    #[inline]
    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Stop> {
        Live::gradient(self, x, gradient).map_err(|refused| Stop { cause: cause(&refused), place: 0 })
    }

    #[inline]
    fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        self.compiled().roll(at, kick, step, steps)
    }
}

impl<const L: usize> lanes::Wide<L> for Wide<L> {
    fn value_and_gradient(&mut self, x: &[[f64; L]], g: &mut [[f64; L]]) -> ([f64; L], [bool; L]) {
        Wide::value_and_gradient(self, x, g)
    }
    fn gradient(&mut self, x: &[[f64; L]], g: &mut [[f64; L]]) -> [bool; L] {
        Wide::gradient(self, x, g)
    }
}

#[cold]
fn cause(refused: &Refused) -> Cause {
    match refused {
        Refused::Structure | Refused::Rounding => Cause::Guard,
        Refused::Fault(met) if met.fault.code == "impossible-trace" || met.is_invalid() => Cause::Impossible,
        Refused::Fault(_) => Cause::NotFinite,
    }
}

/// Why there is no finite log density or gradient at `x`: the run's fault there, or the first term to blame, with its
/// line. `None` for a point that is not finite: that is no fault of the model.
pub fn reason(live: &Live, x: &[f64]) -> Option<Box<RunFault>> {
    if x.iter().any(|x| !x.is_finite()) {
        return None;
    }
    live.model().blame(&live.recorded().values(x))
}
