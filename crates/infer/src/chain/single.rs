//! Proposals that change one choice: it is picked, moved, and the run goes on from it.

use super::Chain;
use super::accept::Rules;
use super::decide::{Decision, below};
use super::state::Fresh;
use crate::{Failure, Task};
use niwaki_math::{Dist, Stream, StreamKey, grid};
use niwaki_vm::builtins::draw_to_value;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::{Propose, Proposed};
use niwaki_vm::value::Value;

/// A way to move one choice.
pub(crate) trait Move {
    /// A new value for a choice at the site of that number, its random bits from `rng`.
    fn propose(
        &mut self,
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
    #[inline(always)]
    fn propose(
        &mut self,
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
        self.way.propose(self.site, dist, old, log_density, &mut self.key.at(address))
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
        let mut rng = self.streams.decisions(visit);
        let total = table.map_or(self.state.trace.len() as u64, |t| self.tables[t].total());
        if total == 0 {
            return Ok(());
        }
        let at = below(&mut rng, total);
        let choice = table.map_or(at as usize, |t| self.tables[t].find(at));
        let site = self.counts.number(self.state.trace.site_of(choice));
        let noting = self.best.is_noting();
        let mut asked = Asked { way, site, key: self.streams.moves(visit), noting, old: None };
        let mut answers =
            Fresh { key: self.streams.fresh(visit), known: None, hosts: &*task.hosts, spreads: None };
        let trace = &mut self.state.trace;
        let change = match machine.propose(trace, choice, self.settings.strategy, &mut asked, &mut answers) {
            Ok(change) => change,
            Err(fault) => return Err(self.give_up(task, fault.into())),
        };
        let (old, outside) = (asked.old.take(), trace.left_support());
        let decision = self.decide(
            task,
            change,
            beta,
            &mut rng,
            |chain, trace| match table {
                // The choice itself is still there, and weighs what it did.
                None => {
                    let after = trace.totals().choices as u64;
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
