//! Moves of one particle: of one that still runs by its way done again, of one that has ended by a chain over its kept
//! run.

use super::advance::Particle;
use super::course::{Choice, Course, Densities, With};
use super::rejuvenation::Round;
use super::settings::Order;
use crate::Failure;
use crate::chain::accept::{MetropolisHastings, Rules, Terms};
use crate::chain::by_family::ByFamily;
use crate::chain::counts::Count;
use crate::chain::decide::below;
use crate::chain::plan::Way;
use crate::chain::single::{FromPrior, Move};
use crate::chain::state::State as ChainState;
use crate::chain::user::Asking;
use crate::chain::{Chain, Settings as ChainSettings, block};
use crate::replay::by_address;
use niwaki_math::streams::{RngCore, open_unit};
use niwaki_math::{Dist, Stream, StreamKey, Total};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::Proposed;
use niwaki_vm::machine::state::State;

/// Visits of a particle's stream, four for each move: the model's own choices and the order have the first two.
const VISITS: u64 = 4;
/// The stream from which seeds of chains come: no lineage has this number.
pub(super) const CHAINS: u64 = u64::MAX - 8;

/// Moves a particle that still runs.
pub(super) fn move_running(
    p: &mut Particle,
    machine: &mut Machine<'_>,
    round: &Round<'_>,
) -> Result<Count, Failure> {
    let mover = round.mover;
    let weigh = |at: &At<'_, f64>| -> Box<[u64]> {
        let leaves = mover.choosy.iter().map(|n| &mover.plan.leaves[*n].selection);
        let depth = || at.path().split('/').filter(|part| !part.contains('[')).count() - 1;
        leaves.map(|selection| selection.weigh(|| at.path(), depth)).collect()
    };
    let with = With {
        task: round.task,
        depth_first: round.settings.order == Order::DepthFirst,
        origins: !mover.choosy.is_empty()
            || round.settings.proposal.as_ref().is_some_and(|own| own.needs_origins()),
        weigh: &weigh,
        careless: careless(round),
    };
    let mut count = Count::default();
    let mut now = Course::of(with, machine, &p.record.log.entries(), round.barriers)?;
    if now.len() == 0 {
        return Ok(count);
    }
    for (i, &leaf) in round.leaves.iter().enumerate() {
        let number = 1 + round.number * round.leaves.len() as u64 + i as u64;
        let stream = |which| p.stream.revisited(VISITS * number + which);
        let (fresh, values, mut rng) = (stream(0), stream(1), stream(2).at(0));
        let Some(proposed) = propose(&now, with, machine, round, leaf, fresh, values, &mut rng)? else {
            continue;
        };
        count.proposed += 1;
        let Some((next, densities, odds)) = proposed.found else { continue };
        let accepted = decide(p, &now, &next, densities, odds, round, machine, &mut rng)?;
        if accepted {
            count.accepted += 1;
            now = next;
        }
    }
    if count.accepted > 0 {
        p.record.log = now.log();
        p.record.log_prior = now.log_prior;
        p.record.log_factors = now.log_factors;
        p.weighed = p.record.score();
        #[cfg(test)]
        if round.settings.is(super::tests::Mutant::StateStays) {
            return Ok(count);
        }
        p.state = now.state;
    }
    Ok(count)
}

#[cfg(test)]
fn careless(round: &Round<'_>) -> bool {
    round.settings.is(super::tests::Mutant::AnySkeleton)
}

#[cfg(not(test))]
fn careless(_: &Round<'_>) -> bool {
    false
}

/// A way to move one choice, under its distribution now.
type Single<'a> = dyn FnMut(&At<'_, f64>, &Choice, &Dist, &mut Stream) -> Result<Proposed<f64>, Fault> + 'a;

/// A proposal; nothing was found where it leads to another skeleton or is impossible.
struct Proposal {
    found: Option<(Course, Densities, f64)>,
}

#[expect(clippy::too_many_arguments, reason = "what a move is made of")]
fn propose(
    now: &Course,
    with: With<'_>,
    machine: &mut Machine<'_>,
    round: &Round<'_>,
    leaf: usize,
    fresh: StreamKey,
    values: StreamKey,
    rng: &mut Stream,
) -> Result<Option<Proposal>, Failure> {
    let mover = round.mover;
    let own = &mover.plan.leaves[leaf];
    let choosy = mover.choosy.iter().position(|n| *n == leaf);
    let weight = |choice: &Choice| choosy.map_or(1, |n| choice.weights[n]);
    let total_of = |course: &Course| match choosy {
        None => course.len() as u64,
        Some(_) => course.choices().map(weight).sum::<u64>(),
    };
    let total = total_of(now);
    if total == 0 {
        return Ok(None);
    }
    let single = |way: &mut Single<'_>, machine: &mut Machine<'_>, rng: &mut Stream| {
        let mut left = below(rng, total);
        let picked = now.choices().position(|choice| {
            let (own, here) = (weight(choice), left);
            left = left.saturating_sub(own);
            here < own
        });
        let mut ask = |at: &At<'_, f64>, n: usize, choice: &Choice, dist: &Dist| {
            if Some(n) != picked {
                return Ok(None);
            }
            way(at, choice, dist, &mut values.at(choice.address)).map(Some)
        };
        now.again(with, machine, &mut ask, fresh)
    };
    let number = |choice: &Choice| mover.numbers.get(&choice.site).copied().unwrap_or(0);
    let mut moved = |way: &mut Single<'_>| single(way, machine, rng);
    let found = match &own.way {
        Way::Prior => moved(&mut |at, c, dist, rng| FromPrior.propose(at, 0, dist, &c.value, c.log, rng))?,
        Way::Drift(drift) => {
            let mut drift = (**drift).clone();
            moved(&mut |at, c, dist, rng| drift.propose(at, number(c), dist, &c.value, c.log, rng))?
        }
        Way::Neighbour(neighbour) => {
            let mut neighbour = *neighbour;
            moved(&mut |at, c, dist, rng| neighbour.propose(at, 0, dist, &c.value, c.log, rng))?
        }
        Way::ByFamily => moved(&mut |at, c, dist, rng| ByFamily.propose(at, 0, dist, &c.value, c.log, rng))?,
        Way::User(user) => {
            moved(&mut |at, c, dist, rng| Asking(user).propose(at, 0, dist, &c.value, c.log, rng))?
        }
        Way::Block(block) => {
            let size = block.log_step.exp();
            let mut ask = |_: &At<'_, f64>, _: usize, choice: &Choice, _: &Dist| {
                let mut own = values.at(choice.address);
                if weight(choice) == 0 || own.uniform() >= block.share {
                    return Ok(None);
                }
                Ok(block::step(choice.family, &choice.value, size * mover.spread(choice.site), &mut own))
            };
            now.again(with, machine, &mut ask, fresh)?
        }
        // One is made to change what there is, and here that must stay; the other moves particles at the end only.
        Way::Regenerate(_) | Way::Trajectory(_) => return Ok(None),
    };
    let blocks = matches!(own.way, Way::Block(_));
    let found = found.map(|(next, densities)| {
        let after = if blocks { total } else { total_of(&next) };
        let odds = if after == total { 0.0 } else { (total as f64 / after as f64).ln() };
        (next, densities, odds)
    });
    Ok(Some(Proposal { found }))
}

/// Accepts or rejects; the particle's sketches then show the scene of the one that holds.
#[expect(clippy::too_many_arguments, reason = "what a decision is made of")]
fn decide(
    p: &mut Particle,
    now: &Course,
    next: &Course,
    densities: Densities,
    odds: f64,
    round: &Round<'_>,
    machine: &mut Machine<'_>,
    rng: &mut Stream,
) -> Result<bool, Failure> {
    let record = &mut p.record;
    let before = record.log_sketches.clone();
    let (gone, come) = next.exchanged(now);
    let mut undone = None;
    if !record.sketches.is_empty() && gone.len() + come.len() > 0 {
        record.sketches.expect_removals();
        undone = Some(record.sketches.fork());
        let kept = record.sketches.exchange(gone.iter().copied(), come.iter().copied());
        debug_assert!(kept, "the sketches and the way hold the same scene");
        record.log_sketches = record.sketches.total();
    }
    if record.log_sketches.value().is_nan() {
        return Err(Fault::new("non-finite-score", "a sketch scores nan")
            .with_help("look for shapes whose measures are not numbers")
            .into());
    }
    let mut score = next.log_factors.less(&now.log_factors);
    score.add_total(&record.log_sketches);
    score.remove_total(&before);
    let mut densities = densities;
    corrupt(&mut densities, &mut score, now, next, round, machine, p.stream);
    let terms = Terms {
        prior: &next.log_prior.less(&now.log_prior),
        score: &score,
        beta: round.temper,
        stale: &densities.stale,
        fresh: &densities.fresh,
        backward: densities.backward,
        forward: densities.forward,
        odds,
    };
    // A temperature of zero sees no score, but for the impossible.
    let possible = !record.log_sketches.is_impossible();
    let u = open_unit(rng);
    let log_ratio = MetropolisHastings::log_ratio(&terms);
    let accepted = possible && (log_ratio >= 0.0 || u.ln() < log_ratio);
    if !accepted {
        if let Some(sketches) = undone {
            record.sketches = sketches;
        }
        record.log_sketches = before;
    }
    Ok(accepted)
}

#[cfg(test)]
fn corrupt(
    densities: &mut Densities,
    score: &mut Total,
    now: &Course,
    next: &Course,
    round: &Round<'_>,
    machine: &mut Machine<'_>,
    stream: StreamKey,
) {
    use super::tests::{Mutant, complete_score};
    if round.settings.is(Mutant::StaleFree) {
        (densities.stale, densities.fresh) = Default::default();
    }
    if round.settings.is(Mutant::WholeScore) {
        let mut of = |course: &Course| complete_score(round.task, machine, &course.state, stream);
        score.add(of(next) - of(now));
    }
}

#[cfg(not(test))]
fn corrupt(
    _: &mut Densities,
    _: &mut Total,
    _: &Course,
    _: &Course,
    _: &Round<'_>,
    _: &mut Machine<'_>,
    _: StreamKey,
) {
}

/// Moves a particle that has ended, by a chain that keeps its run.
pub(super) fn move_ended(p: &mut Particle, round: &Round<'_>) -> Result<Count, Failure> {
    let (task, mover) = (round.task, round.mover);
    let sketches = std::mem::take(&mut p.record.sketches);
    let known = by_address(&p.record.log.entries());
    let state = ChainState::of_run(task, &known, sketches, p.record.primitives)?;
    if state.trace.is_empty() {
        p.record.sketches = state.sketches;
        return Ok(Count::default());
    }
    let seed = Stream::new(round.settings.seed, CHAINS, u128::from(p.lineage), round.number).next_u64();
    let settings = ChainSettings { seed, thin: 0, ..ChainSettings::default() };
    let mut chain: Chain = Chain::at(task, &settings, 0, mover.plan.clone(), state, &mover.spreads)?;
    let ending = round.ending;
    #[cfg(test)]
    let ending = super::tests::own_ending(ending, &chain.state, round);
    chain.restrict(round.temper, ending);
    chain.advance(task, round.leaves.len() as u64, &mut |_, _| true)?;
    let mut count = chain.counts.many;
    chain.counts.sites.iter().for_each(|site| count += *site);
    count.outside = 0;
    let state = chain.state;
    if count.accepted > 0 {
        let totals = state.trace.totals();
        p.record.log = state.choices(&task.program).collect();
        p.record.log_prior.clone_from(&totals.log_prior);
        p.record.log_factors.clone_from(&totals.log_factors);
        p.record.primitives = state.primitives;
        p.state = State::of_result(state.trace.result());
    }
    p.record.log_sketches = state.log_sketches;
    p.record.sketches = state.sketches;
    p.weighed = p.record.score();
    Ok(count)
}
