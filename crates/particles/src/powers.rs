//! The power of the score from barrier to barrier ([`Anneal`]).

use crate::settings::{Anneal, Settings};
use niwaki_propose::particle::Particle;
use niwaki_run::weights::conditional_share;

/// Halvings in the search for a power.
const HALVINGS: u32 = 20;

/// The powers so far.
pub(super) struct Powers {
    /// The power that the weights count now.
    pub now: f64,
    /// That at each barrier, where it is not constant.
    pub each: Vec<f64>,
}

impl Powers {
    pub fn start(settings: &Settings) -> Powers {
        let now = match &settings.anneal {
            Anneal::Constant => settings.power,
            Anneal::Schedule(_) | Anneal::Adaptive(_) => 0.0,
        };
        Powers { now, each: Vec::new() }
    }

    /// The power at the next barrier, which has this number; particles are only looked at where it adapts.
    pub fn next(&self, settings: &Settings, barrier: usize, particles: &[Particle]) -> f64 {
        match &settings.anneal {
            Anneal::Constant => self.now,
            Anneal::Schedule(powers) => powers[(barrier - 1).min(powers.len() - 1)],
            Anneal::Adaptive(share) => self.adapted(*share, settings.power, particles),
        }
    }

    /// The largest power up to the declared one with which this barrier's step keeps the conditional effective
    /// sample size at `share`; never below the power now.
    fn adapted(&self, share: f64, declared: f64, particles: &[Particle]) -> f64 {
        let keeps = |next: f64| {
            let old = particles.iter().map(|p| p.log_weight);
            let steps = particles.iter().map(|p| p.log_step(next, &p.record.score(), self.now));
            conditional_share(old, steps) >= share
        };
        let (mut low, mut high) = (self.now, declared);
        if high <= low || keeps(high) {
            return high.max(low);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if keeps(middle) { low = middle } else { high = middle }
        }
        low
    }
}
