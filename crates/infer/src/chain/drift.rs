//! Drift: a continuous choice moves a little, in coordinates in which it has no bounds.
//!
//! The step in the coordinate z is Gaussian ([`Support::moved`]), so the density of a move from x to x' is symmetric except
//! for a Jacobian: log q(x' | x) = log dz/dx at x' + a symmetric term. Leaving it out draws from the wrong distribution.

use super::metropolis::Decision;
use super::proposal::{FromPrior, Move};
use niwaki_math::{Dist, Draw, Interval, Space, Stream, Support};
use niwaki_vm::builtins::{draw_to_value, value_to_draw};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;

/// Drift with a step for each site, adapted while the chain warms up and frozen afterwards.
#[derive(Clone, Debug)]
pub struct Drift {
    /// The steps and their logs, by number of the site.
    steps: Vec<f64>,
    log_steps: Vec<f64>,
    /// How often each was adapted.
    adapted: Vec<u32>,
    target: f64,
    /// Whether steps are adapted now.
    pub adapting: bool,
    /// Whether the last proposal was a drift.
    drifted: bool,
}

impl Drift {
    /// The same first step at each site.
    pub fn new(step: f64, target: f64, sites: usize) -> Drift {
        let log_steps = vec![step.ln(); sites];
        let steps = log_steps.iter().map(|log| log.exp()).collect();
        Drift { steps, log_steps, adapted: vec![0; sites], target, adapting: false, drifted: false }
    }

    /// The step at a site.
    pub fn step(&self, site: usize) -> f64 {
        self.steps[site]
    }
}

/// Robbins and Monro's step towards a share of accepted proposals, the `n`-th.
pub(super) fn adapt(log_step: &mut f64, n: &mut u32, decision: Decision, target: f64) {
    *n += 1;
    let probability = decision.log_ratio.min(0.0).exp();
    let gain = 2.0 / f64::from(*n).powf(0.6);
    *log_step = (*log_step + gain * (if probability.is_nan() { 0.0 } else { probability } - target))
        .clamp(-30.0, 10.0);
}

impl Move for Drift {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        site: usize,
        dist: &Dist,
        old: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let size = self.step(site) * spread(dist);
        let moved = value_to_draw(old).and_then(|old| dist.support().moved(&old, || size * normal(rng)));
        self.drifted = moved.is_some();
        match moved {
            Some((draw, forward, backward)) => Ok(Proposed { value: draw_to_value(draw), forward, backward }),
            None => FromPrior.propose(at, site, dist, old, log_density, rng),
        }
    }

    fn learn(&mut self, site: usize, decision: Decision) {
        if self.adapting && self.drifted {
            adapt(&mut self.log_steps[site], &mut self.adapted[site], decision, self.target);
            self.steps[site] = self.log_steps[site].exp();
        }
    }
}

/// A standard Gaussian number.
pub(super) fn normal(rng: &mut Stream) -> f64 {
    match (Dist::Gaussian { mean: 0.0, sd: 1.0 }).sample(rng) {
        Draw::Real(x) => x,
        _ => 0.0,
    }
}

/// The approximate spread of a distribution, in the coordinate in which its values drift.
pub(super) fn spread(dist: &Dist) -> f64 {
    let own = if dist.family().space() == Space::Components { None } else { dist.scale() };
    own.unwrap_or(1.0)
}

/// The same in the choice's own coordinate, for steps that may leave the support.
pub(crate) fn plain_spread(dist: &Dist) -> f64 {
    match (dist.family().space(), dist.support()) {
        (Space::Bounded, Support::Reals(Interval { lo: Some(lo), hi: Some(hi) })) => (hi - lo) * 0.3,
        _ => spread(dist),
    }
}
