//! Drift: small moves of a continuous choice, in coordinates without bounds.
//!
//! The step in the coordinate z is Gaussian ([`Dist::moved`]), so the density of a move from x to x' is symmetric except
//! for a Jacobian: log q(x' | x) = log dz/dx at x' + a symmetric term. Without the Jacobian the chain targets the wrong distribution.

use crate::walk::accept::Decision;
use crate::walk::proposal::{FromPrior, Move};
use niwaki_math::{Dist, Draw, Stream};
use niwaki_run::fresh::spread;
use niwaki_run::setting::{BETWEEN, POSITIVE, Ranges};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;
use serde::Deserialize;

/// Drift with a step size for each site, adapted during warm-up and frozen afterwards.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drift {
    /// The first step size, in spreads of the prior.
    step: Step,
    /// The target acceptance of the adaptation.
    target: f64,
    /// Step sizes by number of the site, up to the last site that has drifted.
    #[serde(skip)]
    steps: Vec<Step>,
    /// Whether the last proposal was a drift.
    #[serde(skip)]
    drifted: bool,
}

impl Drift {
    /// Ranges of its settings.
    pub(crate) const RANGES: Ranges = &[("step", POSITIVE), ("target", BETWEEN)];

    /// The adaptation: step sizes by number of the site.
    pub(crate) fn learnt(&self) -> Vec<Learnt> {
        self.steps.iter().map(Step::learnt).collect()
    }

    /// Restore an adaptation.
    pub(crate) fn restore(&mut self, steps: &[Learnt]) {
        self.steps = steps.iter().map(|step| Step::known(*step)).collect();
    }

    /// The step size at a site.
    fn step(&mut self, site: usize) -> f64 {
        if site >= self.steps.len() {
            self.steps.resize(site + 1, self.step);
        }
        self.steps[site].size
    }
}

/// An adaptive step size.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(from = "f64")]
pub(crate) struct Step {
    /// The step size.
    pub size: f64,
    log: f64,
    /// The number of adaptations.
    adapted: u32,
}

impl From<f64> for Step {
    fn from(first: f64) -> Step {
        let log = first.ln();
        Step { size: log.exp(), log, adapted: 0 }
    }
}

/// The adaptation of a step size: the bits of its logarithm, and the number of adaptations.
pub(crate) type Learnt = (u64, u32);

impl Step {
    /// The adaptation.
    pub fn learnt(&self) -> Learnt {
        (self.log.to_bits(), self.adapted)
    }

    /// Restore an adaptation.
    pub fn known((log, adapted): Learnt) -> Step {
        let log = f64::from_bits(log);
        Step { size: log.exp(), log, adapted }
    }

    /// Robbins and Monro's step towards a share of accepted proposals.
    pub fn adapt(&mut self, decision: Decision, target: f64) {
        self.adapted += 1;
        let probability = decision.log_ratio.min(0.0).exp();
        let gain = 2.0 / f64::from(self.adapted).powf(0.6);
        let off = (if probability.is_nan() { 0.0 } else { probability }) - target;
        self.log = (self.log + gain * off).clamp(-30.0, 10.0);
        self.size = self.log.exp();
    }
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
        let moved = old.draw().and_then(|old| dist.moved(&old, size, rng));
        self.drifted = moved.is_some();
        match moved {
            Some((draw, forward, backward)) => Ok(Proposed { value: draw.into(), forward, backward }),
            None => FromPrior.propose(at, site, dist, old, log_density, rng),
        }
    }

    fn learn(&mut self, site: usize, decision: Decision) {
        if self.drifted {
            self.steps[site].adapt(decision, self.target);
        }
    }
}

/// Draw a standard Gaussian number.
pub(crate) fn normal(rng: &mut Stream) -> f64 {
    match (Dist::Gaussian { mean: 0.0, sd: 1.0 }).sample(rng) {
        Draw::Real(x) => x,
        _ => 0.0,
    }
}
