//! Look-ahead: weights with a forecast of the further score of a run (dissertation 7.2.3).
//!
//! The score so far is greedy. With a *twist* `psi` (Whiteley & Lee 2014, "Twisted particle filters") particles that are
//! paused at a barrier target
//!
//! ```text
//! F_n psi_n,    psi_n = (exp(strength forecast_n))^T    of a run that is paused at its n-th barrier
//!               psi_n = 1                               before the first barrier, and of a run that has ended
//! ```
//!
//! in place of `F_n`: a step of the weights is multiplied by `psi_n / psi_(n-1)`. The optimal `psi_n` is the mean of the further
//! factor of the score. `psi` is 1 at the end, so the product of all steps does not change. Evidence and final law stay
//! correct for every forecast that is a function of the run so far.
//!
//! Particle Gibbs weighs the held run like any other run, and draws its ancestor without the `psi` of the prefix, because the law
//! of the whole run has no `psi`. Moves of running particles would need the forecast of each proposed run, and are refused.

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
    /// The task of the run.
    pub task: &'a Task,
    /// The choices, the scene and the scores so far.
    pub record: &'a Record,
    /// The state of its futures.
    pub state: &'a State,
}

/// A forecast of the further change of the log score of a paused run.
pub trait Forecast: Debug + Send + Sync {
    /// The log of the expected further factor of the score, nats. It is a function of the run alone: machine and sight are
    /// workspaces. A result that is not finite counts as 0.
    fn rise(&self, run: Paused<'_>, machine: &mut Machine<'_>, sight: &mut Sight) -> f64;
}

/// A look-ahead: a forecast and its strength.
#[derive(Clone, Debug)]
pub struct LookAhead {
    /// The share of the forecast that counts, above 0.
    pub strength: f64,
    /// The forecast.
    pub forecast: Arc<dyn Forecast>,
}

impl Particle {
    /// Store the twist at this barrier, and the view of the guide behind it.
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
