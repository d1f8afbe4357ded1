//! The original's single-site proposals (Ritchie's prototype, the Metropolis-Hastings baseline of dissertation 5.6), by
//! the family of the choice: a truth value always flips, a Gaussian number drifts by the standard deviation of its
//! prior, any other value is drawn from its prior. Flips and drifts are symmetric.

use crate::leaf::drift::normal;
use crate::walk::proposal::{FromPrior, Move};
use niwaki_math::{Dist, Stream};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;

/// The move by family.
pub(crate) struct ByFamily;

impl Move for ByFamily {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        site: usize,
        dist: &Dist,
        old: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let value = match (dist, old) {
            (Dist::Bernoulli { .. }, Value::Bool(b)) => Value::Bool(!b),
            (Dist::Gaussian { sd, .. }, Value::Real(x)) => Value::Real(x + sd * normal(rng)),
            _ => return FromPrior.propose(at, site, dist, old, log_density, rng),
        };
        Ok(Proposed { value, forward: 0.0, backward: 0.0 })
    }
}
