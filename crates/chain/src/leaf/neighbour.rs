//! Neighbour moves: a truth value flips, a whole number changes by a few, a category changes. In a list of truth values a single
//! value flips; in a list of counts some units move between two entries.
//!
//! The moves are symmetric, so they do not enter the acceptance ratio. Values outside of the support are rejected.

use crate::walk::proposal::{FromPrior, Move};
use niwaki_math::{Dist, Space, Stream, Support};
use niwaki_run::setting::{COUNT, Ranges};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;
use serde::Deserialize;
use std::num::NonZeroU64;

/// A move to a near value.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Neighbour {
    /// The largest distance.
    reach: NonZeroU64,
}

impl Neighbour {
    /// Ranges of its settings.
    pub(crate) const RANGES: Ranges = &[("reach", COUNT)];
}

impl Move for Neighbour {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        site: usize,
        dist: &Dist,
        old: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let value = match (dist.family().space(), old) {
            (Space::Fixed, _) => None,
            (_, Value::Bool(b)) => Some(Value::Bool(!b)),
            (_, Value::Int(k)) => Some(Value::Int(match dist.support() {
                Support::Categories(n @ 2..) => {
                    // One of the other categories: numbers from the old one on are one higher.
                    let other = crate::walk::streams::below(rng, n as u64 - 1) as i64;
                    other + i64::from(other >= *k)
                }
                _ => near(*k, self.reach.get(), rng),
            })),
            (Space::Truths, Value::Tuple(all)) => flipped(all.items(), rng),
            (Space::Counts, Value::Tuple(all)) => shifted(all.items(), self.reach.get(), rng),
            _ => None,
        };
        match value {
            Some(value) => Ok(Proposed { value, forward: 0.0, backward: 0.0 }),
            None => FromPrior.propose(at, site, dist, old, log_density, rng),
        }
    }
}

/// Flip one of the truth values.
fn flipped(all: &[Value], rng: &mut Stream) -> Option<Value> {
    let at = crate::walk::streams::below(rng, all.len() as u64) as usize;
    let flipped_value = |(i, x): (usize, &Value)| match x {
        Value::Bool(b) => Some(Value::Bool(*b != (i == at))),
        _ => None,
    };
    all.iter().enumerate().map(flipped_value).collect::<Option<_>>().map(Value::tuple)
}

/// Move up to `reach` units between two counts.
fn shifted(all: &[Value], reach: u64, rng: &mut Stream) -> Option<Value> {
    let n = all.len() as u64;
    if n < 2 {
        return None;
    }
    let from = crate::walk::streams::below(rng, n);
    let other = crate::walk::streams::below(rng, n - 1);
    let to = other + u64::from(other >= from);
    let by = (crate::walk::streams::below(rng, reach) + 1) as i64;
    let shifted_count = |(i, x): (u64, &Value)| match x {
        Value::Int(k) if i == from => Some(Value::Int(k.saturating_sub(by))),
        Value::Int(k) if i == to => Some(Value::Int(k.saturating_add(by))),
        Value::Int(k) => Some(Value::Int(*k)),
        _ => None,
    };
    (0..).zip(all).map(shifted_count).collect::<Option<_>>().map(Value::tuple)
}

/// Draw a different whole number within `reach`.
pub(crate) fn near(k: i64, reach: u64, rng: &mut Stream) -> i64 {
    let at = crate::walk::streams::below(rng, 2 * reach);
    let by = (at / 2 + 1) as i64;
    k.saturating_add(if at.is_multiple_of(2) { by } else { -by })
}
