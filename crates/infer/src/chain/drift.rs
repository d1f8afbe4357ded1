//! Drift: a continuous choice moves a little, in coordinates in which it has no bounds.
//!
//! | support | coordinate z | log of dz/dx |
//! | --- | --- | --- |
//! | all reals, vectors | x | 0 |
//! | above lo | ln(x - lo) | -ln(x - lo) |
//! | lo to hi | ln((x - lo) / (hi - x)) | -ln((x - lo)(hi - x) / (hi - lo)) |
//! | the circle | x, around | 0 |
//! | the simplex | ln x, up to a common term | -sum of ln x |
//!
//! The step in z is Gaussian, so the density of going from x to x' is symmetric but for the last column:
//! log q(x' | x) = log dz/dx at x' + what is the same both ways. Leaving that out draws from the wrong distribution.

use super::metropolis::Decision;
use super::proposal::{FromPrior, Move};
use niwaki_math::{Dist, Draw, Stream, Support};
use niwaki_vm::builtins::{draw_to_value, value_to_draw};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::value::Value;
use std::f64::consts::PI;

/// Drift with a step for each site, adapted while the chain warms up and frozen then.
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
    /// The same first step at each of so many sites.
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
        let moved = value_to_draw(old).and_then(|old| moved(dist, &old, self.step(site), rng));
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

/// A drift of a continuous value: the new value, and the parts of the log densities of going there and back that
/// differ. `None` for a discrete one.
fn moved(dist: &Dist, old: &Draw, step: f64, rng: &mut Stream) -> Option<(Draw, f64, f64)> {
    if matches!(dist, Dist::Delta(_)) {
        return None;
    }
    match (dist.support(), old) {
        (Support::Reals { lo, hi }, Draw::Real(x)) => {
            if matches!(dist, Dist::VonMises { .. }) {
                return Some((Draw::Real(around(x + step * normal(rng))), 0.0, 0.0));
            }
            let (x, forward, backward) = within(*x, lo, hi, step * spread(dist), rng);
            Some((Draw::Real(x), forward, backward))
        }
        (Support::Simplex(_), Draw::Vector(x)) => {
            let (x, forward, backward) = on_simplex(x, step, rng);
            Some((x, forward, backward))
        }
        (Support::Vectors(_), Draw::Vector(x)) => {
            let scale = step * spread(dist);
            Some((Draw::Vector(x.iter().map(|x| x + scale * normal(rng)).collect()), 0.0, 0.0))
        }
        _ => None,
    }
}

/// A step of a number between `lo` and `hi`, either of which may be infinite: the number, and the log densities.
pub(super) fn within(x: f64, lo: f64, hi: f64, step: f64, rng: &mut Stream) -> (f64, f64, f64) {
    let z = step * normal(rng);
    match (lo.is_finite(), hi.is_finite()) {
        (false, false) => (x + z, 0.0, 0.0),
        (true, false) => {
            let new = lo + (x - lo) * z.exp();
            (new, -(new - lo).ln(), -(x - lo).ln())
        }
        (false, true) => {
            let new = hi - (hi - x) * z.exp();
            (new, -(hi - new).ln(), -(hi - x).ln())
        }
        (true, true) => {
            // With a = x - lo and b = hi - x, the odds a / b are multiplied by e^z.
            let (a, b, grown) = (x - lo, hi - x, z.exp());
            let new = if grown.is_finite() { lo + (hi - lo) * (a * grown / (a * grown + b)) } else { hi };
            let log = |x: f64| -((x - lo) * (hi - x)).ln();
            (new, log(new), log(x))
        }
    }
}

/// A step on the simplex.
pub(super) fn on_simplex(x: &[f64], step: f64, rng: &mut Stream) -> (Draw, f64, f64) {
    let grown: Vec<f64> = x.iter().map(|x| x * (step * normal(rng)).exp()).collect();
    let sum: f64 = grown.iter().sum();
    let new: Vec<f64> = grown.iter().map(|x| x / sum).collect();
    let log = |x: &[f64]| -x.iter().map(|x| x.ln()).sum::<f64>();
    let (forward, backward) = (log(&new), log(x));
    (Draw::Vector(new.into()), forward, backward)
}

/// An angle as one from -pi to pi.
pub(super) fn around(angle: f64) -> f64 {
    (angle + PI).rem_euclid(2.0 * PI) - PI
}

/// A standard Gaussian number.
pub(super) fn normal(rng: &mut Stream) -> f64 {
    match (Dist::Gaussian { mean: 0.0, sd: 1.0 }).sample(rng) {
        Draw::Real(x) => x,
        _ => 0.0,
    }
}

/// About how far a distribution's values lie from each other, in the coordinate in which they drift.
pub(super) fn spread(dist: &Dist) -> f64 {
    match dist {
        Dist::MultivariateGaussian(g) => {
            let n = g.covariance.len();
            ((0..n).map(|i| g.covariance[i][i]).sum::<f64>() / n as f64).sqrt()
        }
        Dist::Mixture(_) => 1.0,
        _ => dist.scale().unwrap_or(1.0),
    }
}

/// The same in the choice's own coordinate, for steps that may leave the support.
pub(crate) fn plain_spread(dist: &Dist) -> f64 {
    match dist {
        Dist::Uniform { lo, hi } | Dist::TruncatedGaussian { lo, hi, .. } => (hi - lo) * 0.3,
        _ => spread(dist),
    }
}
