//! Gains of short searches from paused particles: the training data of a forecast ([`look_ahead`](niwaki_propose::look_ahead)).
//!
//! A population is paused at each barrier. Of its running particles there one is drawn, and of these a few are kept, such that
//! each barrier is as likely (Vitter 1985, algorithm R). From each of them a population of its own grows to the end. If
//! `Z` estimates the mean of the score at the end, over runs that go on from a particle whose score is `s`, then its *rise* is
//!
//! ```text
//! log Z - log s    nats
//! ```
//!
//! which is what the best twist of this particle would be, but for the noise of `Z`.

use crate::population::Population;
use crate::settings::{Anneal, Settings};
use crate::smc::grow;
use niwaki_math::streams::RngCore;
use niwaki_propose::particle::Particle;
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};

/// The settings of a search whose particles are looked at, and of those that go on from them: nothing is sharpened, moved or
/// foreseen.
pub fn plainly(settings: &Settings) -> Settings {
    let (anneal, power) = (Anneal::Constant, 1.0);
    Settings { anneal, power, rejuvenate: None, look_ahead: None, ..settings.clone() }
}

/// At most `count` paused particles of a population, each of a barrier of its own. One that dies out gives those it had.
///
/// # Errors
/// As for [`smc`](crate::smc()), except for impossible particles.
pub fn paused(task: &Task, settings: &Settings, count: usize) -> Result<Vec<Particle>, Failure> {
    let mut population = Population::start(task, settings, true)?;
    let (mut kept, mut seen) = (Vec::new(), 0);
    let done = grow(&mut population, &mut |population, _| {
        let particles = population.swarm.alone();
        let running: Vec<usize> = (0..particles.len()).filter(|i| particles[*i].is_running()).collect();
        if running.is_empty() {
            return true;
        }
        let mut random = Reserved::Paused.stream(settings.seed, population.barriers as u128, 0);
        let mut draw = |n: usize| ((random.uniform() * n as f64) as usize).min(n - 1);
        seen += 1;
        let place = if kept.len() < count { kept.len() } else { draw(seen) };
        if place < count {
            let paused = particles[running[draw(running.len())]].fork();
            if place < kept.len() { kept[place] = paused } else { kept.push(paused) }
        }
        true
    });
    match done {
        Ok(_) => Ok(kept),
        Err(failure) if failure.is_impossible() => Ok(kept),
        Err(failure) => Err(failure),
    }
}

/// The rise of a paused particle, nats, by `particles` that go on from it; minus infinity where all become impossible. `number`
/// tells the particles of one search apart.
///
/// # Errors
/// A fault of the program.
pub fn rise(
    task: &Task,
    settings: &Settings,
    particles: usize,
    from: &mut Particle,
    number: usize,
) -> Result<f64, Failure> {
    let seed = Reserved::Paused.stream(settings.seed, number as u128, 1).next_u64();
    let population_settings = Settings { particles, seed, ..settings.clone() };
    let mut population = Population::go_on(task, &population_settings, from)?;
    match grow(&mut population, &mut |_, _| true) {
        Ok(_) => Ok(population.estimate.log_normaliser - from.record.log_score()),
        Err(failure) if failure.is_impossible() => Ok(f64::NEG_INFINITY),
        Err(failure) => Err(failure),
    }
}
