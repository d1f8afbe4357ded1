//! User moves: draws from a user's proposal. With `f(x, s)` for its distribution at the previous value `x` and variables `s`,
//!
//! ```text
//! forward = log f(x, s)(x')        backward = log f(x', s)(x)
//! ```

use crate::walk::proposal::Move;
use niwaki_math::{Dist, Stream, grid};
use niwaki_propose::user::User;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;

/// A move that draws from a user's proposal.
pub(crate) struct UserMove<'a>(pub &'a User);

impl Move for UserMove<'_> {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        _: usize,
        dist: &Dist,
        old: &Value,
        _: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let there = self.0.dist(at, Some(old))?;
        let draw = there.sample(rng);
        let value = Value::from(draw.clone());
        if value.kind() != old.kind() {
            let (name, family) = (self.0.name(), dist.family());
            let problem = format!(
                "the proposal `{name}` drew {}, where a choice of `{family}` holds {}",
                value.described(),
                old.described()
            );
            return Err(Fault::new("proposal-kind", problem)
                .with_help("propose values of the kind that the choice's own distribution draws"));
        }
        // A function that does not need the value before gives the same distribution for both directions.
        let back = if self.0.needs_old() { self.0.dist(at, Some(&value))? } else { there.clone() };
        let backward = old.draw().map_or(f64::NEG_INFINITY, |old| back.log_density(&old));
        Ok(Proposed { value, forward: grid(there.log_density(&draw)), backward: grid(backward) })
    }
}
