//! Particle independent Metropolis-Hastings: SMC as the proposal of a chain of whole runs (Andrieu, Doucet &
//! Holenstein 2010, section 2.4.2).
//!
//! Each sweep runs a population of its own, draws a run from its final set by weight, and accepts it with probability
//! `min(1, Z' / Z)`, the ratio of the two populations' evidence estimates. The chain follows the posterior for any number
//! of particles; more of them make `Z'` and `Z` alike, and acceptance frequent.

use super::gibbs::{Chain, check_chain, draw_row, sweep_seed};
use super::many::Watch;
use super::settings::Settings;
use super::smc::{Outcome, run};
use super::weights::Normalised;
use crate::importance::log_mean_exp;
use crate::{Failure, Task};
use niwaki_math::Stream;

/// The stream of the acceptance draws: no lineage has this number.
const ACCEPTANCE: u64 = u64::MAX - 5;

/// `sweeps` sweeps. `watch` is told after each barrier; when it answers false, the sweeps so far are given.
///
/// # Errors
/// Settings that a chain cannot have, a fault of the program, or a first population that died; a later one that
/// died is a proposal that was rejected.
pub fn pimh(
    task: &Task,
    settings: &Settings,
    sweeps: usize,
    watch: &mut Watch<'_>,
) -> Result<Chain, Failure> {
    check_chain(settings, sweeps)?;
    let mut chain = Chain {
        states: Vec::new(),
        tries: 0,
        moves: 0,
        renewed: Vec::new(),
        log_evidence: None,
        interrupted: false,
    };
    let mut estimates = Vec::new();
    let mut now: Option<(f64, Outcome)> = None;
    for sweep in 0..=sweeps {
        let own = Settings { seed: sweep_seed(settings.seed, sweep), ..settings.clone() };
        let proposed = match run(task, &own, false, watch) {
            Ok(found) if found.interrupted => {
                chain.interrupted = true;
                break;
            }
            Ok(mut found) => {
                let log = found.log_normaliser.unwrap_or(f64::NEG_INFINITY);
                let mut weights = Normalised::default();
                weights.read(found.particles.iter().map(|p| p.log_weight));
                let mut one = found.particles.swap_remove(draw_row(&weights, own.seed, 0));
                one.log_weight = 0.0;
                Some((log, one))
            }
            Err(failure) if failure.is_impossible() && now.is_some() => None,
            Err(other) => return Err(other),
        };
        estimates.push(proposed.as_ref().map_or(f64::NEG_INFINITY, |p| p.0));
        let Some((log_now, at)) = &mut now else {
            now = proposed;
            continue;
        };
        chain.tries += 1;
        let u = Stream::new(settings.seed, ACCEPTANCE, sweep as u128, 0).uniform();
        let accepted = proposed.filter(|(log, _)| accepts(settings, u, log - *log_now));
        chain.renewed.push(f64::from(u8::from(accepted.is_some())));
        if let Some((log, one)) = accepted {
            chain.moves += 1;
            (*log_now, *at) = (log, one);
        }
        chain.states.push(at.copy());
    }
    if settings.temper == 1.0 && !estimates.is_empty() {
        chain.log_evidence = Some(log_mean_exp(estimates.into_iter()));
    }
    Ok(chain)
}

fn accepts(settings: &Settings, u: f64, log_ratio: f64) -> bool {
    #[cfg(test)]
    if settings.is(super::tests::Mutant::AcceptsAll) {
        return true;
    }
    let _ = settings;
    u.ln() < log_ratio
}
