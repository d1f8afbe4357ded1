//! Turns: alternative values of a discrete choice.
//!
//! From a short list of values the others are drawn by their probabilities: `g(v' | v) = p(v') / (1 - p(v))`. Any other
//! whole number moves up or down by one, with equal probability where both are possible.

use super::sweep::Seen;
use niwaki_math::{Dist, Stream, Support};
use niwaki_run::weights::index;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::{Value, log_density, same};

/// The longest list of values that is enumerated; longer lists count as whole numbers.
const SHORT: i64 = 64;

/// Values, each with the log probability of turning to it, nats.
pub(super) type Others = Vec<(Value, f64)>;

/// The alternative values of a choice; empty for a single value or a continuous choice.
pub(super) fn others(dist: &Dist, value: &Value) -> Result<Others, Fault> {
    let (listed, candidates): (bool, Vec<Value>) = match (dist.support().in_bounds(), value) {
        (_, Value::Bool(b)) => (true, vec![Value::Bool(!b)]),
        (Support::Integers { lo, hi: Some(hi) }, Value::Int(_)) if hi.saturating_sub(lo) < SHORT => {
            (true, (lo..=hi).map(Value::Int).filter(|other| !same(other, value)).collect())
        }
        (_, Value::Int(k)) => {
            (false, [k.checked_sub(1), k.checked_add(1)].into_iter().flatten().map(Value::Int).collect())
        }
        _ => return Ok(vec![]),
    };
    let mut others = Vec::with_capacity(candidates.len());
    for other in candidates {
        let log = log_density(dist, &other)?;
        if log > f64::NEG_INFINITY {
            others.push((other, if listed { log } else { 0.0 }));
        }
    }
    let sum: f64 = others.iter().map(|(_, log)| log.exp()).sum();
    others.iter_mut().for_each(|(_, log)| *log -= sum.ln());
    others.retain(|(_, log)| log.is_finite());
    Ok(others)
}

/// Draw an alternative value.
pub(super) fn draw(mut others: Others, rng: &mut Stream) -> Option<Value> {
    if others.is_empty() {
        return None;
    }
    let shares: Vec<f64> = others.iter().map(|(_, log)| log.exp()).collect();
    Some(others.swap_remove(index(&shares, rng.uniform())).0)
}

/// Log probability of the form of the move, in a particle's run: to grow a part with no choice turned, or to turn one, drawn
/// evenly among those that have other values, to the value that it has on the other side.
pub(super) fn log_form(share: f64, seen: &Seen) -> f64 {
    match seen.log_turn {
        Some(log_turn) => share.ln() + log_turn - (seen.turnable as f64).ln(),
        None if seen.turnable == 0 => 0.0,
        None => (1.0 - share).ln(),
    }
}
