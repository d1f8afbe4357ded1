//! Turns: alternative values of a discrete choice.
//!
//! From a short list of values the others are drawn by their probabilities: `g(v' | v) = p(v') / (1 - p(v))`. Any other
//! whole number moves up or down by one, with equal probability where both are possible.

use super::sweep::Seen;
use niwaki_math::{Dist, Stream, Support};
use niwaki_run::weights::index;
use niwaki_vm::fault::Fault;
use niwaki_vm::value::{Value, identical, log_density};

/// The longest list of values that is enumerated; longer lists count as whole numbers.
const SHORT: i64 = 64;

/// Values, each with the log probability of turning to it, nats.
pub(super) type Alternatives = Vec<(Value, f64)>;

/// The alternative values of a choice; empty for a single value or a continuous choice.
pub(super) fn alternatives(dist: &Dist, value: &Value) -> Result<Alternatives, Fault> {
    let (listed, candidates): (bool, Vec<Value>) = match (dist.support().in_bounds(), value) {
        (_, Value::Bool(b)) => (true, vec![Value::Bool(!b)]),
        (Support::Integers { lo, hi: Some(hi) }, Value::Int(_)) if hi.saturating_sub(lo) < SHORT => {
            (true, (lo..=hi).map(Value::Int).filter(|candidate| !identical(candidate, value)).collect())
        }
        (_, Value::Int(k)) => {
            (false, [k.checked_sub(1), k.checked_add(1)].into_iter().flatten().map(Value::Int).collect())
        }
        _ => return Ok(vec![]),
    };
    let mut alternatives = Vec::with_capacity(candidates.len());
    for candidate in candidates {
        let log = log_density(dist, &candidate)?;
        if log > f64::NEG_INFINITY {
            alternatives.push((candidate, if listed { log } else { 0.0 }));
        }
    }
    let sum: f64 = alternatives.iter().map(|(_, log)| log.exp()).sum();
    alternatives.iter_mut().for_each(|(_, log)| *log -= sum.ln());
    alternatives.retain(|(_, log)| log.is_finite());
    Ok(alternatives)
}

/// Draw an alternative value.
pub(super) fn draw(mut alternatives: Alternatives, rng: &mut Stream) -> Option<Value> {
    if alternatives.is_empty() {
        return None;
    }
    let shares: Vec<f64> = alternatives.iter().map(|(_, log)| log.exp()).collect();
    Some(alternatives.swap_remove(index(&shares, rng.uniform())).0)
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
