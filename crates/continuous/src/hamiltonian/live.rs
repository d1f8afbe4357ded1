//! A recorded density as a target of chains.

use super::lanes;
use super::{Cause, Potential, Stop};
use niwaki_grad::{Live, Refused, Rolling, Wide};

impl Potential for Live {
    fn dim(&self) -> usize {
        Live::dim(self)
    }

    /// A number that is not finite stops a trajectory by itself: see [`super::potential::evaluate`].
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
