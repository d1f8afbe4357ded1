//! Look-ahead: weights count what is expected of the rest of a run (dissertation 7.2.3).
//!
//! The score so far is greedy. With a *twist* `psi` (Whiteley & Lee 2014, "Twisted particle filters") particles that are
//! paused at a barrier target
//!
//! ```text
//! F_n psi_n,    psi_n = (exp(strength forecast_n))^T    of a run that is paused at its n-th barrier
//!               psi_n = 1                               before the first barrier, and of a run that has ended
//! ```
//!
//! in place of `F_n`: a step of the weights is multiplied by `psi_n / psi_(n-1)`. The best `psi_n` is the mean of what the score
//! is still multiplied by. As `psi` is one in the end, the product of the steps is what it is without: evidence and final
//! law stay right for every forecast, however bad, if it is a function of the run so far.
//!
//! Particle Gibbs weighs the held run like any other, and draws its ancestor without the `psi` of the prefix, as the law
//! of the whole run has none. Moves of particles that still run would need the forecast of each run that is proposed, and are refused.

use crate::guide::bound::Sight;
use crate::particle::Particle;
use niwaki_run::Task;
use niwaki_run::record::Record;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::state::State;
use std::fmt::Debug;
use std::sync::Arc;

/// A run that is paused at a barrier.
#[derive(Clone, Copy)]
pub struct Paused<'a> {
    /// What it is a run of.
    pub task: &'a Task,
    /// Its choices, its scene and scores so far.
    pub record: &'a Record,
    /// Its futures, and where each is.
    pub state: &'a State,
}

/// Says how much the log score of a paused run will still change.
pub trait Forecast: Debug + Send + Sync {
    /// The log of what the score is expected to be multiplied by until the run ends, nats. It depends on the run alone: machine
    /// and sight are room to compute in. What is not a finite number counts as 0.
    fn rise(&self, run: Paused<'_>, machine: &mut Machine<'_>, sight: &mut Sight) -> f64;
}

/// A forecast, and how much of it counts.
#[derive(Clone, Debug)]
pub struct LookAhead {
    /// The share of the forecast that counts, above 0.
    pub strength: f64,
    /// The forecast.
    pub forecast: Arc<dyn Forecast>,
}

impl Particle {
    /// Notes its twist at this barrier, and what was seen for it.
    pub fn foresee(
        &mut self,
        with: Option<&LookAhead>,
        task: &Task,
        machine: &mut Machine<'_>,
        sight: &mut Sight,
    ) {
        let Some(with) = with else { return };
        self.ahead = with.log_twist(self, task, machine, sight);
        sight.leave(&mut self.glance);
    }
}

impl LookAhead {
    /// The log of a particle's twist at power 1, nats.
    fn log_twist(
        &self,
        particle: &Particle,
        task: &Task,
        machine: &mut Machine<'_>,
        sight: &mut Sight,
    ) -> f64 {
        if !particle.is_running() {
            return 0.0;
        }
        let run = Paused { task, record: &particle.record, state: &particle.state };
        let log = self.strength * self.forecast.rise(run, machine, sight);
        if log.is_finite() { log } else { 0.0 }
    }
}
