//! Proposals that change one choice: it is picked, moved, and the run goes on from it.

use super::Chain;
use super::accept::Rules;
use super::decide::Decision;
use super::state::Fresh;
use super::streams::Streams;
use crate::{Failure, Task};
use niwaki_math::{Dist, RngCore, Stream, StreamKey, grid};
use niwaki_vm::builtins::draw_to_value;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::{Propose, Proposed};
use niwaki_vm::value::Value;

/// A way to move one choice.
pub(crate) trait Move {
    /// Whether it draws from the choice's own distribution, and gives the log density of what it drew.
    const FROM_PRIOR: bool = false;

    /// A new value for a choice at the site of that number, its random bits from `rng`.
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        site: usize,
        dist: &Dist,
        old: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault>;

    /// What became of it, so that the way can be adapted.
    #[inline(always)]
    fn learn(&mut self, _site: usize, _decision: Decision) {}
}

/// From the choice's own distribution, whatever its value was.
pub(crate) struct FromPrior;

impl Move for FromPrior {
    const FROM_PRIOR: bool = true;

    #[inline(always)]
    fn propose(
        &mut self,
        _: &At<'_, f64>,
        _: usize,
        dist: &Dist,
        _: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let (draw, log) = dist.sample_and_score(rng);
        Ok(Proposed { value: draw_to_value(draw), forward: grid(log), backward: log_density })
    }
}

/// What the machine asks for a new value.
struct Asked<'a, M> {
    way: &'a mut M,
    site: usize,
    key: StreamKey,
    /// Whether the value before is wanted afterwards.
    noting: bool,
    old: Option<(u128, Value)>,
}

impl<M: Move> Propose<f64> for Asked<'_, M> {
    const FROM_PRIOR: bool = M::FROM_PRIOR;

    #[inline]
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        old: &Value,
        log_density: f64,
    ) -> Result<Proposed<f64>, Fault> {
        let address = at.address();
        if self.noting {
            self.old = Some((address, old.clone()));
        }
        self.way.propose(at, self.site, dist, old, log_density, &mut self.key.at(address))
    }
}

/// The random numbers that decide over a proposal, drawn while the one before runs, so that what it will need can be
/// asked for.
pub(crate) struct Ahead {
    visit: u64,
    /// The first number: which choice.
    first: u64,
    rest: Stream,
}

impl Ahead {
    /// Of that visit.
    pub fn of(streams: &Streams, visit: u64) -> Ahead {
        let mut rest = streams.decisions(visit);
        Ahead { visit, first: rest.next_u64(), rest }
    }

    /// A number below `n`, evenly (up to `n / 2^64`).
    #[inline(always)]
    fn below(&self, n: u64) -> u64 {
        ((u128::from(self.first) * u128::from(n)) >> 64) as u64
    }
}

impl<R: Rules> Chain<R> {
    /// One proposal: a choice is picked (evenly, or by the weights of a table), moved, and the move kept or undone.
    #[inline(always)]
    pub(super) fn single<M: Move>(
        &mut self,
        task: &Task,
        machine: &mut Machine<'_>,
        way: &mut M,
        table: Option<usize>,
        beta: f64,
    ) -> Result<(), Failure> {
        let visit = self.visit;
        self.visit += 1;
        let ahead = std::mem::replace(&mut self.ahead, Ahead::of(&self.streams, visit + 1));
        let now = if ahead.visit == visit { ahead } else { Ahead::of(&self.streams, visit) };
        let total = table.map_or(self.state.trace.len() as u64, |t| self.tables[t].total());
        if total == 0 {
            return Ok(());
        }
        let at = now.below(total);
        let next = self.ahead.below(total) as usize;
        if table.is_none() {
            self.state.trace.approach(next);
        }
        let mut rng = now.rest;
        let choice = table.map_or(at as usize, |t| self.tables[t].find(at));
        let site = self.counts.number(self.state.trace.site_of(choice));
        let noting = self.best.is_noting();
        let mut asked = Asked { way, site, key: self.streams.moves(visit), noting, old: None };
        let mut answers = Fresh::plain(self.streams.fresh(visit), &*task.hosts);
        let (trace, strategy) = (&mut self.state.trace, self.settings.strategy);
        let change = match machine.propose(trace, choice, strategy, &mut asked, &mut answers) {
            Ok(change) => change,
            Err(met) => self.give_up(task, met)?,
        };
        let trace = &mut self.state.trace;
        if table.is_none() {
            trace.approach_closer(&task.program, next);
        }
        let (old, outside) = (asked.old.take(), trace.left_support());
        let decision = self.decide(
            task,
            change,
            beta,
            &mut rng,
            |chain, trace| match table {
                // The choice itself is still there, and weighs what it did.
                None => {
                    let after = trace.len_after() as u64;
                    if after == total { 0.0 } else { (total as f64 / after as f64).ln() }
                }
                Some(t) => {
                    let after = chain.tables[t].total_after(trace, &task.program);
                    if after == total { 0.0 } else { (total as f64 / after as f64).ln() }
                }
            },
            |_| old,
        )?;
        let count = &mut self.counts.sites[site];
        count.proposed += 1;
        count.accepted += u64::from(decision.accepted);
        count.outside += u64::from(outside);
        if !decision.same {
            way.learn(site, decision);
        }
        Ok(())
    }
}
