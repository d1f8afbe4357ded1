//! Points that the evaluations leave possible: chains over the parameters, by an emulator's likelihood of the target.
//!
//! The target's features are 0. With the emulator's mean `m` and variance along each direction `c`, and the mean squared
//! residual `r^2` of the best point, which no parameters remove,
//!
//! ```text
//! log likelihood = sum over c of log N(0; m_c(x), s_c^2 (v(x) + nugget) + r^2)
//! ```
//!
//! raised to a power, which is calibrated elsewhere. The prior is that of the ranges. Chains change one or several real
//! parameters, follow differences between chains (ter Braak 2006), and draw levels anew; what becomes used is drawn from
//! its range, so that its density cancels.

use crate::dice::{Dice, Purpose};
use crate::emulator::{Emulator, NUGGET};
use crate::linear::dot;
use crate::space::{Point, Space};
use niwaki_math::portable;

/// The settings of chains.
#[derive(Clone, Copy, Debug)]
pub struct Posterior {
    /// The power of the likelihood.
    pub power: f64,
    /// The number of chains.
    pub chains: usize,
    /// Steps of each chain, of which the second half is kept.
    pub steps: usize,
    /// The seed.
    pub seed: u64,
}

/// Every how many steps the states are kept.
const THIN: usize = 5;

/// Points of the posterior.
///
/// * `starts`: points where chains start, at least one, the best first
pub fn sample(space: &Space, emulator: &Emulator, starts: &[Point], settings: Posterior) -> Vec<Point> {
    let mut dice = Dice::new(settings.seed, Purpose::Chains, 1);
    let residual = {
        let mean = emulator.mean(&emulator.kernel(&starts[0].row));
        dot(&mean, &mean) / mean.len() as f64
    };
    let log_likelihood = |point: &Point| {
        let kernel = emulator.kernel(&point.row);
        let mean = emulator.mean(&kernel);
        let left = emulator.left(kernel) + NUGGET;
        let mut sum = 0.0;
        for (m, s) in mean.iter().zip(emulator.variances()) {
            let variance = s * left + residual;
            sum -= 0.5 * (m * m / variance + portable::ln(variance));
        }
        sum * settings.power
    };
    let mut states: Vec<Point> = (0..settings.chains)
        .map(|k| starts[if k == 0 { 0 } else { dice.below(starts.len()) }].clone())
        .collect();
    let mut logs: Vec<f64> = states.iter().map(log_likelihood).collect();
    let mut kept = vec![];
    for step in 0..settings.steps {
        for chain in 0..states.len() {
            let (a, b) = (dice.below(states.len()), dice.below(states.len()));
            let proposal = change(space, &states[chain], &states[a], &states[b], &mut dice);
            let log = log_likelihood(&proposal);
            if portable::ln(dice.uniform()) < log - logs[chain] {
                (states[chain], logs[chain]) = (proposal, log);
            }
        }
        if step >= settings.steps / 2 && step % THIN == 0 {
            kept.extend(states.iter().cloned());
        }
    }
    kept
}

/// A changed point. Every change is as likely as its way back.
fn change(space: &Space, point: &Point, a: &Point, b: &Point, dice: &mut Dice) -> Point {
    let reals: Vec<usize> = (0..space.len()).filter(|k| point.used[*k] && !space.has_levels(*k)).collect();
    let levelled: Vec<usize> = (0..space.len()).filter(|k| point.used[*k] && space.has_levels(*k)).collect();
    let mut row = point.row.clone();
    let kind = dice.uniform();
    if !levelled.is_empty() && (kind < 0.2 || reals.is_empty()) {
        let axis = levelled[dice.below(levelled.len())];
        row[axis] = space.draw(axis, dice);
        for dependent in space.dependents(axis) {
            if !point.used[*dependent] {
                row[*dependent] = space.draw(*dependent, dice);
            }
        }
    } else if kind < 0.4 {
        // Any value: what the target does not tell must not stay where the search happened to look.
        let axis = reals[dice.below(reals.len())];
        row[axis] = space.draw(axis, dice);
    } else if kind < 0.7 {
        let axis = reals[dice.below(reals.len())];
        let size = portable::exp(std::f64::consts::LN_10 * dice.between(-2.5, -0.3));
        row[axis] = fold(row[axis] + size * dice.normal());
    } else {
        let share = 0.5 * if dice.chance(0.5) { 0.3 } else { 1.0 };
        for axis in reals {
            row[axis] = fold(row[axis] + share * (a.row[axis] - b.row[axis]) + 0.003 * dice.normal());
        }
    }
    space.snap(&row)
}

/// A number reflected at 0 and 1 until it lies between.
fn fold(x: f64) -> f64 {
    let x = x.abs() % 2.0;
    if x > 1.0 { 2.0 - x } else { x }
}
