//! Conditional SMC and particle Gibbs with ancestor sampling: a Markov kernel on whole runs that leaves the posterior
//! as it is, for any number of particles above one (Andrieu, Doucet & Holenstein 2010, section 2.4.3; Lindsten, Jordan
//! & Schon 2014, algorithm 2).
//!
//! A sweep is SMC in which one row holds the run that the chain is at, its order choices and barriers included; at a
//! resampling the other rows are drawn by weight. Then one of the final set is drawn by weight, and is the run that
//! the chain goes to. With ancestor sampling the held run's past is drawn anew at each resampling. Prefix `i` with
//! weight `w_i` is followed by the rest `x'` of the held run with probability in proportion to
//!
//! ```text
//! w_i  p(x', order | prefix i)  s(prefix i, x')^T / s(prefix i)^(T_n)
//! ```
//!
//! in which a proposal for the choices has no part: the law that the sweep holds is that of the choices, `p s^T`, and the rest
//! is not drawn but held, so its density under the prior stands (Lindsten et al., eq. 15: the target of the whole over that
//! of the prefix). What the proposal drew of the prefix is in `w_i`. The held run's own weight counts `log p - log q` of its
//! choices like any other row's, though nobody drew them: it is found anew as the run is followed, and so by the prefix
//! that it has after its ancestor was drawn.
//!
//! The weight above is zero where the prefix leads to other addresses, other barriers or another family at an address. Only
//! multinomial resampling has this simple conditional form, so that is what it uses.

use super::many::Watch;
use super::path::Path;
use super::population::{Population, RESAMPLING};
use super::resampling::multinomial;
use super::settings::{Anneal, Settings, Weights};
use super::smc::{Outcome, Progress, outcome, run};
use super::weights::Normalised;
use crate::log::Entry;
use crate::{Failure, Task};
use niwaki_math::Stream;
use niwaki_math::streams::RngCore;
use niwaki_vm::fault::Fault;
use rayon::prelude::*;

/// Streams of the draws between sweeps, of the ancestors, and of an order that a first run lacks: no lineage has these
/// numbers.
const SWEEPS: u64 = u64::MAX - 2;
const ANCESTORS: u64 = u64::MAX - 3;
const ORDERS: u64 = u64::MAX - 4;

/// The runs that a chain of whole runs went through.
#[derive(Default)]
pub struct Chain {
    /// Where it was after each sweep, from the first one that found a possible run; weights are equal.
    pub states: Vec<Outcome>,
    /// How often it could have moved: ancestors drawn for the held run; proposals.
    pub tries: usize,
    /// How often it did: ancestors that were another row; proposals accepted.
    pub moves: usize,
    /// The share of choices that each of these sweeps made new.
    pub renewed: Vec<f64>,
    /// Populations in which every particle became impossible; their estimate is zero, and counts.
    pub died: usize,
    /// Log of the mean of the populations' estimates of the evidence, nats; where they are independent of the chain,
    /// at temperature 1 and not stopped.
    pub log_evidence: Option<f64>,
    /// Whether it was stopped before all sweeps were made.
    pub interrupted: bool,
}

/// How a held run meets the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ancestors {
    /// It keeps its past.
    Kept,
    /// Its past is drawn anew at each resampling.
    Sampled,
}

/// The seed of a sweep.
pub(super) fn sweep_seed(seed: u64, sweep: usize) -> u64 {
    Stream::new(seed, SWEEPS, sweep as u128, 0).next_u64()
}

/// Which of the final set a chain goes to.
pub(super) fn draw_row(weights: &Normalised, seed: u64, sweep: usize) -> usize {
    weights.row(Stream::new(seed, SWEEPS, sweep as u128, 1).uniform())
}

/// Refuses settings that a chain of whole runs cannot have.
pub(super) fn check_chain(settings: &Settings, sweeps: usize) -> Result<(), Fault> {
    settings.check()?;
    if sweeps == 0 {
        return Err(Fault::new("no-samples", "zero sweeps were asked for").with_help("ask for at least one"));
    }
    if settings.weights == Weights::Absolute {
        return Err(Fault::new("bad-setting", "absolute weights have no law that a chain could keep")
            .with_help("use ratio weights"));
    }
    if matches!(settings.anneal, Anneal::Adaptive(_)) {
        return Err(Fault::new("bad-anneal", "a chain needs the same temperatures in every sweep")
            .with_help(
                "give the temperature at each barrier, for example those that an adaptive search reported",
            ));
    }
    Ok(())
}

/// `sweeps` sweeps of particle Gibbs. It starts from a run with the choices `from`, or from one that SMC finds.
/// `watch` is told after each barrier; when it answers false, the sweeps so far are given.
///
/// # Errors
/// Settings that a chain cannot have, fewer than two particles, a fault of the program, or first populations that all
/// died.
pub fn particle_gibbs(
    task: &Task,
    settings: &Settings,
    ancestors: Ancestors,
    sweeps: usize,
    from: Option<&[Entry]>,
    watch: &mut Watch<'_>,
) -> Result<Chain, Failure> {
    check_chain(settings, sweeps)?;
    if settings.particles < 2 {
        return Err(Fault::new(
            "no-particles",
            "particle Gibbs needs a particle beside the one that is held",
        )
        .with_help("use at least two")
        .into());
    }
    let mut chain = Chain::default();
    let mut orders = Stream::new(settings.seed, ORDERS, 0, 0);
    let mut path = match from {
        Some(entries) => Path::of(task, settings, entries, &mut orders)?,
        None => {
            let Some(first) = first_run(task, settings, sweeps, &mut chain, watch)? else {
                chain.interrupted = true;
                return Ok(chain);
            };
            Path::of(task, settings, &first.record.log.entries(), &mut orders)?
        }
    };
    for sweep in 1..=sweeps {
        let own = Settings { seed: sweep_seed(settings.seed, sweep), ..settings.clone() };
        let Some(next) = conditional(task, &own, ancestors, &path, &mut chain, watch)? else {
            chain.interrupted = true;
            break;
        };
        let new = Path::of(task, settings, &next.record.log.entries(), &mut orders)?;
        chain.renewed.push(new.renewed(&path));
        chain.states.push(next);
        path = new;
    }
    Ok(chain)
}

/// A run of the first population that lives, of at most one more than there are sweeps. `None` when it was stopped.
fn first_run(
    task: &Task,
    settings: &Settings,
    sweeps: usize,
    chain: &mut Chain,
    watch: &mut Watch<'_>,
) -> Result<Option<Outcome>, Failure> {
    let mut seed = settings.seed;
    loop {
        match run(task, &Settings { seed, ..settings.clone() }, false, watch) {
            Ok(found) if found.interrupted => return Ok(None),
            Ok(mut found) => {
                let mut weights = Normalised::default();
                weights.read(found.particles.iter().map(|p| p.log_weight));
                return Ok(Some(found.particles.swap_remove(draw_row(&weights, seed, 0))));
            }
            Err(failure) if failure.is_impossible() && chain.died < sweeps => chain.died += 1,
            Err(failure) => return Err(failure),
        }
        seed = Stream::new(settings.seed, SWEEPS, chain.died as u128, 2).next_u64();
    }
}

/// One sweep: SMC with the path held, and a draw from its final set. `None` when it was stopped.
fn conditional(
    task: &Task,
    settings: &Settings,
    ancestors: Ancestors,
    path: &Path,
    chain: &mut Chain,
    watch: &mut Watch<'_>,
) -> Result<Option<Outcome>, Failure> {
    let mut population = Population::start(task, settings, false)?;
    let task = population.task.clone();
    let mut machine = task.machine();
    let segments = &path.segments;
    let proposal = settings.proposal.as_deref();
    // The row of the held run.
    let mut held = 0;
    while population.count().0 > 0 {
        population.advance(Some(held))?;
        if let Some(segment) = segments.get(population.barriers) {
            let last = population.barriers + 1 == segments.len();
            let row = &mut population.particles[held];
            #[cfg(test)]
            let proposal = proposal.filter(|_| !settings.is(super::tests::Mutant::HeldByPrior));
            if row.follow(&mut machine, &task, segment, last, proposal)?.is_none() {
                // Nothing was tried: the run was given.
                return Err(Failure::NoStart { tries: 0, causes: vec![] });
            }
        }
        let seen = population.weigh()?;
        if !watch(Progress { barriers: population.barriers, ended: seen.ended, best: seen.best }) {
            return Ok(None);
        }
        if !population.is_low() {
            continue;
        }
        let mut parent = held;
        if ancestors == Ancestors::Sampled {
            parent = sample_ancestor(&mut population, segments, held)?;
            chain.tries += 1;
            chain.moves += usize::from(parent != held);
        }
        let mut random = Stream::new(settings.seed, RESAMPLING, population.barriers as u128, 0);
        let others = population.particles.len() - 1;
        #[cfg(test)]
        super::tests::corrupt_draw(&mut population, held);
        let mut copies = multinomial(&population.weights.relative, others, &mut random);
        copies[parent] += 1;
        // The first copy stays where its parent is: there the path goes on.
        population.survive(&copies);
        held = parent;
    }
    population.finish();
    let row = draw_row(&population.weights, settings.seed, 0);
    Ok(Some(outcome(population.particles.swap_remove(row))).map(|mut chosen| {
        chosen.log_weight = 0.0;
        chosen
    }))
}

/// Draws which row's past the rest of the held run gets.
fn sample_ancestor(
    population: &mut Population<'_>,
    segments: &[Vec<super::path::Event>],
    held: usize,
) -> Result<usize, Failure> {
    let rest = segments.get(population.barriers..).unwrap_or(&[]);
    let (task, temper) = (&population.task, population.temper);
    let settings = population.settings;
    let log_weight = |p: &mut super::advance::Particle| -> Result<f64, Failure> {
        if p.log_weight == f64::NEG_INFINITY {
            return Ok(f64::NEG_INFINITY);
        }
        if rest.is_empty() || p.state.has_ended() {
            let both = rest.is_empty() && p.state.has_ended();
            // Nothing follows: what the declared temperature adds is all.
            let change = (settings.temper - temper) * p.weighed.value();
            return Ok(if both { p.log_weight + change } else { f64::NEG_INFINITY });
        }
        let mut machine = task.machine();
        let mut trial = p.fork();
        let mut log_order = 0.0;
        for (number, segment) in rest.iter().enumerate() {
            match trial.follow(&mut machine, task, segment, number + 1 == rest.len(), None)? {
                Some(log) => log_order += log,
                None => return Ok(f64::NEG_INFINITY),
            }
        }
        #[cfg(test)]
        if settings.is(super::tests::Mutant::BlindAncestors) {
            return Ok(p.log_weight);
        }
        #[cfg(test)]
        if settings.is(super::tests::Mutant::OrderFreeAncestors) {
            log_order = 0.0;
        }
        let log_prior = trial.record.log_prior.less(&p.record.log_prior).value();
        let score = trial.record.score();
        let log_scores = if (settings.temper, temper) == (1.0, 1.0) {
            score.less(&p.weighed).value()
        } else {
            settings.temper * score.value() - temper * p.weighed.value()
        };
        Ok(p.log_weight + log_prior + log_order + log_scores)
    };
    let logs: Vec<f64> = if population.parallel {
        population.particles.par_iter_mut().map(log_weight).collect::<Result<_, _>>()?
    } else {
        population.particles.iter_mut().map(log_weight).collect::<Result<_, _>>()?
    };
    let mut weights = Normalised::default();
    if !weights.read(logs.iter().copied()) {
        return Ok(held);
    }
    let mut random = Stream::new(settings.seed, ANCESTORS, population.barriers as u128, 0);
    Ok(weights.row(random.uniform()))
}
