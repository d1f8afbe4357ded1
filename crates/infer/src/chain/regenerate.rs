//! Regeneration: a call and all that it makes are drawn anew from the prior, in program order.
//!
//! A choice is picked, and with it the activation that stands so many levels above it. The activation keeps its place
//! whatever is drawn below, so the probability of choosing it is the weight of the choices that lead to it over the weight
//! of all, before and after.

use super::Chain;
use super::accept::Rules;
use super::state::Fresh;
use super::streams::below;
use crate::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::state::NodeId;

impl<R: Rules> Chain<R> {
    /// One regenerated call.
    pub(super) fn regenerate(
        &mut self,
        task: &Task,
        machine: &mut Machine<'_>,
        levels: usize,
        table: Option<usize>,
        beta: f64,
    ) -> Result<(), Failure> {
        let (visit, program) = (self.visit, &*task.program);
        self.visit += 1;
        let mut rng = self.streams.decisions(visit);
        let total = table.map_or(self.state.trace.len() as u64, |t| self.tables[t].total());
        if total == 0 {
            return Ok(());
        }
        let at = below(&mut rng, total);
        let choice = table.map_or(at as usize, |t| self.tables[t].find(at));
        let activation = self.state.trace.activation(choice, levels);
        let weight = self.leading(program, activation, levels, table);
        let (mut choices, trace) = (Vec::new(), &self.state.trace);
        trace.below(program, activation, |_, number, _| choices.extend(number));
        let old = |n: &usize| (trace.address(program, *n), trace.choice(program, *n).0.clone());
        let moved: Vec<_> = if self.best.is_noting() { choices.iter().map(old).collect() } else { vec![] };
        let mut answers = Fresh::plain(self.streams.fresh(visit), &*task.hosts);
        let change =
            match machine.redraw(&mut self.state.trace, &choices, self.settings.strategy, &mut answers) {
                Ok(change) => change,
                Err(met) => self.give_up(task, met)?,
            };
        let selection = |chain: &Self| {
            let trace = &chain.state.trace;
            let after =
                table.map_or(trace.len_after() as u64, |t| chain.tables[t].total_after(trace, program));
            let leading = chain.leading(program, activation, levels, table);
            (leading as f64 / after as f64).ln() - (weight as f64 / total as f64).ln()
        };
        let decision = self.decide(task, change, beta, &mut rng, selection, moved)?;
        self.count_many(decision);
        Ok(())
    }

    /// The weight of the choices that lead to an activation: those so many levels below, and above the root, which
    /// stands for all that lie too high, those nearer to it.
    fn leading(&self, program: &Program, activation: NodeId, levels: usize, table: Option<usize>) -> u64 {
        let (mut weight, trace) = (0, &self.state.trace);
        let root = activation == NodeId(0);
        trace.below(program, activation, |place, number, level| {
            if level == levels || (root && level < levels) {
                weight += match (table, number) {
                    (None, _) => 1,
                    (Some(t), Some(n)) => self.tables[t].weight(n),
                    (Some(t), None) => self.tables[t].weigh(&place),
                };
            }
        });
        weight
    }
}
