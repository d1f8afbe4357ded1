//! Regeneration: a call and all choices below it are redrawn from the prior, in program order.
//!
//! Picking a choice selects the activation a fixed number of levels above it. The activation keeps its place for any draws below.
//! So its probability is the sum of the weights of the choices that lead to it, divided by the sum of all weights, before and after
//! the proposal.

use crate::walk::Walk;
use crate::walk::streams::below;
use crate::walk::{ChainMove, Proposing};
use niwaki_run::Failure;
use niwaki_run::fresh::Fresh;
use niwaki_run::setting::{Ranges, whole};
use niwaki_vm::code::Program;
use niwaki_vm::machine::state::NodeId;
use serde::Deserialize;

/// The regeneration of a call.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Regenerate {
    /// The number of levels between the call and the picked choice.
    levels: usize,
}

impl Regenerate {
    /// Ranges of its settings.
    pub(crate) const RANGES: Ranges = &[("levels", whole(0))];
}

impl ChainMove for Regenerate {
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure> {
        let (levels, Proposing { chain, task, machine, table, beta }) = (self.levels, proposing);
        let (visit, program) = (chain.visit, &*task.program);
        chain.visit += 1;
        let mut rng = chain.streams.decisions(visit);
        let total = table.map_or(chain.state.trace.len() as u64, |t| chain.tables[t].total());
        if total == 0 {
            return Ok(());
        }
        let at = below(&mut rng, total);
        let choice = table.map_or(at as usize, |t| chain.tables[t].find(at));
        let activation = chain.state.trace.activation(choice, levels);
        let weight = chain.leading(program, activation, levels, table);
        let (mut choices, trace) = (Vec::new(), &chain.state.trace);
        trace.below(program, activation, |_, number, _| choices.extend(number));
        let old = |n: &usize| (trace.address(program, *n), trace.choice(program, *n).0.clone());
        let moved: Vec<_> = if chain.best.is_noting() { choices.iter().map(old).collect() } else { vec![] };
        let mut answers = Fresh::plain(chain.streams.fresh(visit), &*task.hosts);
        let change = match machine.redraw(&mut chain.state.trace, &choices, chain.strategy, &mut answers) {
            Ok(change) => change,
            Err(met) => chain.give_up(task, met)?,
        };
        let selection = |chain: &Walk| {
            let trace = &chain.state.trace;
            let after =
                table.map_or(trace.len_after() as u64, |t| chain.tables[t].total_after(trace, program));
            let leading = chain.leading(program, activation, levels, table);
            (leading as f64 / after as f64).ln() - (weight as f64 / total as f64).ln()
        };
        let decision = chain.decide(task, change, beta, &mut rng, selection, moved)?;
        chain.count_many(decision);
        Ok(())
    }
}

impl Walk {
    /// The weight of the choices that lead to an activation: those `levels` below it. The root also takes
    /// the choices that are nearer to it, because their activation would be above the root.
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
