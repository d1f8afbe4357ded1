//! Particle independent Metropolis-Hastings: SMC as the proposal of a chain of whole runs (Andrieu, Doucet &
//! Holenstein 2010, section 2.4.2).
//!
//! Each sweep runs a new population, draws a run from its final set by weight, and accepts it with probability
//! `min(1, Z' / Z)`, the ratio of the two populations' evidence estimates. The chain follows the posterior for any number
//! of particles; more of them make `Z'` and `Z` alike, and acceptance frequent.
//!
//! A population that died has `Z' = 0` and is never accepted. Before the first population that survives, the chain has
//! no state, which counts as `Z = 0`: any population that survives is accepted, and there are fewer states than sweeps.
//!
//! The evidence is the mean of `Z'` over all `sweeps + 1` populations, those that died as zero. Their number is fixed
//! beforehand and they do not depend on the chain, so the mean is unbiased, where a call in which all died counts as zero.
//! Continuing until a population survives, and then making all sweeps, would be biased: the number of populations would depend on the
//! estimates.

use crate::gibbs::{Chain, draw_index, sweep_seed};
use crate::many::Watch;
use crate::settings::Settings;
use crate::smc::run;
use niwaki_math::log_sums::log_mean_exp;
use niwaki_run::run::Run;
use niwaki_run::streams::Reserved;
use niwaki_run::weights::Normalised;
use niwaki_run::{Failure, Task};

/// Run `sweeps` sweeps after a first population. `watch` is called after each barrier; when it returns false, the sweeps so far are
/// returned.
///
/// # Errors
/// Invalid settings; a fault of the program; populations that all died.
pub fn pimh(
    task: &Task,
    settings: &Settings,
    sweeps: usize,
    watch: &mut Watch<'_>,
) -> Result<Chain, Failure> {
    let mut chain = Chain::default();
    let mut estimates = Vec::new();
    let mut first_death = None;
    let mut now: Option<(f64, Run)> = None;
    for sweep in 0..=sweeps {
        let sweep_settings = Settings { seed: sweep_seed(settings.seed, sweep), ..settings.clone() };
        let proposed = match run(task, &sweep_settings, false, watch) {
            Ok(result) if result.interrupted => {
                chain.interrupted = true;
                break;
            }
            Ok(mut result) => {
                let log = result.log_normaliser.unwrap_or(f64::NEG_INFINITY);
                let mut weights = Normalised::default();
                weights.read(result.particles.iter().map(|p| p.log_weight));
                let drawn = result.particles.swap_remove(draw_index(&weights, sweep_settings.seed, 0));
                Some((log, Run { log_weight: 0.0, ..drawn }))
            }
            Err(failure) if failure.is_impossible() => {
                chain.died += 1;
                first_death.get_or_insert(failure);
                None
            }
            Err(other) => return Err(other),
        };
        estimates.push(proposed.as_ref().map_or(f64::NEG_INFINITY, |p| p.0));
        if sweep == 0 {
            now = proposed;
            continue;
        }
        chain.tries += 1;
        let u = Reserved::SweepAcceptance.stream(settings.seed, sweep as u128, 0).uniform();
        let log_now = now.as_ref().map_or(f64::NEG_INFINITY, |at| at.0);
        let accepted = proposed.filter(|(log, _)| u.ln() < log - log_now);
        chain.moves += usize::from(accepted.is_some());
        let renewed = f64::from(u8::from(accepted.is_some()));
        now = accepted.or(now);
        if let Some((_, at)) = &mut now {
            chain.renewed.push(renewed);
            chain.states.push(at.copy());
        }
    }
    if let (Some(death), None, false) = (first_death, &now, chain.interrupted) {
        return Err(death);
    }
    // When a search is stopped may depend on its results so far.
    if settings.power == 1.0 && !chain.interrupted {
        chain.log_evidence = Some(log_mean_exp(estimates.into_iter()));
    }
    Ok(chain)
}
