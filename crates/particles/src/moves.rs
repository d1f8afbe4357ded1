//! Moves of a particle. A running particle moves by a rerun of its partial run, an ended particle by a chain over its kept run.

use crate::partial_run::{Choice, Densities, FollowSettings, PartialRun};
use crate::rejuvenation::{Mover, Round};
use niwaki_chain::leaf::block;
use niwaki_chain::leaf::block::Block;
use niwaki_chain::leaf::{Leaf, Target};
use niwaki_chain::walk::accept::{Terms, accepts, selected};
use niwaki_chain::walk::counts::Count;
use niwaki_chain::walk::proposal::Move;
use niwaki_chain::walk::state::State as ChainState;
use niwaki_chain::walk::streams::below;
use niwaki_chain::{Chain, Settings as ChainSettings};
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::streams::RngCore;
use niwaki_math::{Dist, Stream, StreamKey};
use niwaki_propose::particle::Particle;
use niwaki_run::record::{Record, score_of};
use niwaki_run::replay::by_address;
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::state::State;
use std::cell::RefCell;
use std::collections::HashMap;

/// Visits of a particle's stream, four for each move: the model's own choices and the order have the first two.
const VISITS: u64 = 4;

/// A move of a running particle.
struct Moving<'a, 'm> {
    particle: &'a mut Particle,
    now: PartialRun,
    machine: &'a mut Machine<'m>,
    round: &'a Round<'a>,
    with: FollowSettings<'a>,
    /// The number of the selection weight that counts; `None` for equal weights.
    weight: Option<usize>,
    /// The first visit of this move.
    visit: u64,
    /// The random numbers that pick the choice and decide on the acceptance.
    rng: Stream,
    count: Count,
}

/// Move a running particle. Its batch has separate leaves, which do not adapt.
pub(super) fn move_running(
    p: &mut Particle,
    machine: &mut Machine<'_>,
    round: &Round<'_>,
    leaves: &mut [Leaf],
) -> Result<Count, Failure> {
    let mover = round.mover;
    let known: RefCell<HashMap<u128, Box<[u64]>>> = RefCell::default();
    let weigh = |at: &At<'_, f64>| match &mover.choosy[..] {
        [] => Box::default(),
        _ => known.borrow_mut().entry(at.address()).or_insert_with(|| mover.weights(at)).clone(),
    };
    let with = FollowSettings {
        task: round.task,
        order: &round.settings.order,
        origins: !mover.choosy.is_empty()
            || round.settings.proposal.as_ref().is_some_and(|proposal| proposal.needs_origins()),
        weigh: &weigh,
    };
    let run = PartialRun::of(with, machine, &p.record.log.entries(), round.barriers, &mut || 0.0)?;
    let now = run.ok_or_else(Failure::no_start)?;
    if now.choices().next().is_none() {
        return Ok(Count::default());
    }
    let (rng, stream) = (Stream::new(0, 0, 0, 0), p.stream);
    let mut moving = Moving {
        particle: p,
        now,
        machine,
        round,
        with,
        weight: None,
        visit: 0,
        rng,
        count: Count::default(),
    };
    for (number, &leaf) in (1 + round.number * round.schedule.len() as u64..).zip(&round.schedule) {
        moving.visit = VISITS * number;
        moving.rng = stream.revisited(moving.visit + 2).at(0);
        moving.weight = mover.choosy.iter().position(|choosy| *choosy == leaf);
        leaves[leaf].proposer.apply(&mut moving)?;
    }
    let Moving { now, count, .. } = moving;
    if count.accepted > 0 {
        p.record.log = now.log();
        p.record.log_prior = now.log_prior;
        p.record.log_factors = now.log_factors;
        p.weighed = p.record.score();
        p.state = now.state;
    }
    Ok(count)
}

/// Calls are not regenerated here, because the skeleton must stay; trajectories move particles at the end only.
impl Target for Moving<'_, '_> {
    fn single<M: Move>(&mut self, proposer: &mut M) -> Result<(), Failure> {
        let total = self.total(&self.now);
        if total == 0 {
            return Ok(());
        }
        let mut left = below(&mut self.rng, total);
        let picked = self.now.choices().find(|choice| {
            let (weight, here) = (self.weight(choice), left);
            left = left.saturating_sub(weight);
            here < weight
        });
        let (picked, numbers) = (picked.map(|choice| choice.address), &self.round.mover.numbers);
        let values = self.stream(1);
        let propose = |at: &At<'_, f64>, c: &Choice, dist: &Dist| {
            if Some(c.address) != picked {
                return Ok(None);
            }
            let site = numbers.get(&c.site).copied().unwrap_or(0);
            proposer.propose(at, site, dist, &c.value, c.log, &mut values.at(c.address)).map(Some)
        };
        let next = self.now.again(self.with, self.machine, propose, self.stream(0))?;
        let after = next.as_ref().map_or(total, |(next, _)| self.total(next));
        self.decide(next, selected(total, after))
    }

    fn block(&mut self, block: &mut Block) -> Result<(), Failure> {
        if self.total(&self.now) == 0 {
            return Ok(());
        }
        let (size, values) = (block.size(), self.stream(1));
        let (weight, mover) = (self.weight, self.round.mover);
        let propose = |_: &At<'_, f64>, c: &Choice, _: &Dist| {
            let mut stream = values.at(c.address);
            if weight.is_some_and(|n| c.weights[n] == 0) || stream.uniform() >= block.share() {
                return Ok(None);
            }
            Ok(block::step(c.family, &c.value, size * mover.spread(c.site), &mut stream))
        };
        let next = self.now.again(self.with, self.machine, propose, self.stream(0))?;
        self.decide(next, 0.0)
    }
}

impl Moving<'_, '_> {
    /// New choices have the first visit of a move, new values of old ones the second.
    fn stream(&self, purpose: u64) -> StreamKey {
        self.particle.stream.revisited(self.visit + purpose)
    }

    fn weight(&self, choice: &Choice) -> u64 {
        self.weight.map_or(1, |n| choice.weights[n])
    }

    fn total(&self, run: &PartialRun) -> u64 {
        run.choices().map(|choice| self.weight(choice)).sum()
    }

    /// Accepts or rejects; the particle's sketches then show the scene of the run that is kept. `next` is `None` where the
    /// move leads to another skeleton or is impossible.
    fn decide(&mut self, next: Option<(PartialRun, Densities)>, selection: f64) -> Result<(), Failure> {
        self.count.proposed += 1;
        let Some((next, densities)) = next else { return Ok(()) };
        let record = &mut self.particle.record;
        let (before, mut undone) = (record.log_sketches.clone(), None);
        let (removed, added) = next.exchanged(&self.now);
        if !record.sketches.is_empty() && removed.len() + added.len() > 0 {
            record.sketches.expect_removals();
            undone = Some(record.sketches.fork());
            let kept = record.sketches.exchange(removed.iter().copied(), added.iter().copied());
            debug_assert!(kept, "the sketches and the partial run hold the same scene");
            record.log_sketches = score_of(&record.sketches)?;
        }
        let mut score = next.log_factors.less(&self.now.log_factors);
        score.add_total(&record.log_sketches);
        score.remove_total(&before);
        let terms = Terms {
            prior: &next.log_prior.less(&self.now.log_prior),
            score: &score,
            beta: self.round.power,
            stale: &densities.stale,
            fresh: &densities.fresh,
            backward: densities.backward,
            forward: densities.forward,
            selection,
        };
        // At power zero a score counts only where it is impossible.
        let possible = !record.log_sketches.is_impossible();
        if accepts(terms.log_ratio(), &mut self.rng) && possible {
            self.count.accepted += 1;
            self.now = next;
        } else {
            record.sketches = undone.unwrap_or_else(|| std::mem::take(&mut record.sketches));
            record.log_sketches = before;
        }
        Ok(())
    }
}

/// Moves a particle that has ended, by a chain over its run: at the barrier at which this is noticed, and at the end.
pub(super) fn move_ended(p: &mut Particle, round: &Round<'_>) -> Result<Count, Failure> {
    if p.was_ended && round.ending.is_some() {
        return Ok(Count::default());
    }
    let seed =
        Reserved::ChainSeed.stream(round.settings.seed, u128::from(p.lineage), round.number).next_u64();
    let sketches = std::mem::take(&mut p.record.sketches);
    let mut chain = chain_from(&p.record, sketches, round.task, round.mover, seed)?;
    chain.restrict(round.power, round.ending);
    if !chain.state.trace.is_empty() {
        chain.advance(round.task, round.schedule.len() as u64, &mut |_, _| true)?;
    }
    let count = chain.counts.all();
    if count.accepted > 0 {
        p.record = record_of(&mut chain.state, &round.task.program);
        p.state = State::of_result(chain.state.trace.result());
    } else {
        p.record.sketches = chain.into_state().sketches;
    }
    p.weighed = p.record.score();
    Ok(count)
}

/// A chain in the state of a run that has ended, whose scene the sketches show.
pub(super) fn chain_from(
    record: &Record,
    sketches: Sketches,
    task: &Task,
    mover: &Mover,
    seed: u64,
) -> Result<Chain, Failure> {
    let known = by_address(&record.log.entries());
    let state = ChainState::of_run(task, &known, sketches, record.primitives)?;
    let settings = ChainSettings { seed, thin: 0, ..ChainSettings::default() };
    Chain::at(task, &settings, 0, mover.plan.clone(), state, &mover.spreads)
}

/// The record of the run that a chain is at.
fn record_of(state: &mut ChainState, program: &Program) -> Record {
    let totals = state.trace.totals();
    Record {
        log: state.choices(program).collect(),
        log_prior: totals.log_prior.clone(),
        log_factors: totals.log_factors.clone(),
        log_sketches: state.log_sketches.clone(),
        primitives: state.primitives,
        sketches: state.sketches.fork(),
        ..Record::default()
    }
}
