//! Blocks: joint small moves of many choices. Each choice takes part with a given probability.
//!
//! The support of a choice can depend on another choice of the block, so steps must not depend on parameters: a choice moves
//! in the coordinates of its *family* (positive ones by a factor, bounded ones in plain steps, which
//! are rejected outside), by its spread in the chain's first state. The step of a choice that does not exist after the
//! proposal, or has another family then, counts in neither direction.
//!
//! A discrete choice that takes part moves to a neighbour or stays, each with probability 1/2. If all of them always moved, two
//! equal truth values would always stay equal.

use crate::leaf::drift::{Step, normal};
use crate::leaf::neighbour::near;
use crate::walk::Walk;
use crate::walk::accept::Decision;
use niwaki_math::{Family, Space, Stream};
use niwaki_run::fresh::Fresh;
use niwaki_run::setting::{BETWEEN, POSITIVE, Range, Ranges};
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::kept::{Changed, Proposed};
use niwaki_vm::value::Value;
use serde::Deserialize;

/// A block.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// The first step size, in spreads of each choice's first distribution.
    pub(crate) step: Step,
    /// Probability with which each choice takes part.
    pub(crate) share: f64,
    /// The target acceptance of the adaptation during warm-up.
    target: f64,
}

impl Block {
    /// Ranges of its settings.
    pub(crate) const RANGES: Ranges = &[
        ("step", POSITIVE),
        ("share", Range::Real { low: 0.0, high: 1.0, ends: "(]" }),
        ("target", BETWEEN),
    ];

    /// The adapted step size, in spreads of each choice's first distribution.
    pub fn size(&self) -> f64 {
        self.step.size
    }

    /// Probability with which each choice takes part.
    pub fn share(&self) -> f64 {
        self.share
    }
}

/// Move a choice; `None` if the choice does not take part or cannot move.
pub fn step(family: Family, old: &Value, size: f64, rng: &mut Stream) -> Option<Proposed<f64>> {
    let space = family.space();
    let discrete = match old {
        _ if space == Space::Fixed => return None,
        Value::Bool(b) => Some(Value::Bool(!b)),
        Value::Int(k) => Some(Value::Int(near(*k, 1, rng))),
        _ => None,
    };
    if let Some(value) = discrete {
        if rng.uniform() < 0.5 {
            return None;
        }
        return Some(Proposed { value, forward: 0.0, backward: 0.0 });
    }
    let (old, coordinates) = (old.draw()?, space.coordinates()?);
    let (new, forward, backward) = coordinates.moved(&old, || size * normal(rng))?;
    // How much the last number inside stands for depends on parameters: a block moves between the others.
    if !(coordinates.has_inside(&old) && coordinates.has_inside(&new)) {
        return None;
    }
    Some(Proposed { value: new.into(), forward, backward })
}

impl Walk {
    /// Make a proposal for a whole block.
    pub(crate) fn block(
        &mut self,
        task: &Task,
        machine: &mut Machine<'_>,
        block: &mut Block,
        table: Option<usize>,
        beta: f64,
    ) -> Result<(), Failure> {
        let (visit, program) = (self.visit, &*task.program);
        self.visit += 1;
        let (mut rng, key, size) =
            (self.streams.decisions(visit), self.streams.moves(visit), block.step.size);
        let (mut changes, mut moved) = (Vec::new(), Vec::new());
        let trace = &self.state.trace;
        for choice in trace.numbers() {
            if table.is_some_and(|t| self.tables[t].weight(choice) == 0) {
                continue;
            }
            let address = trace.address(program, choice);
            let mut stream = key.at(address);
            if stream.uniform() >= block.share {
                continue;
            }
            let Some(family) = trace.family(choice) else { continue };
            let spread = self.spreads[self.counts.number(trace.site_of(choice))];
            let old = trace.choice(program, choice).0;
            if let Some(proposed) = step(family, old, size * spread, &mut stream) {
                moved.push((address, old.clone()));
                changes.push(Changed { choice, proposed });
            }
        }
        let mut answers = Fresh::plain(self.streams.fresh(visit), &*task.hosts);
        let change = match machine.change(&mut self.state.trace, changes, self.strategy, &mut answers) {
            Ok(change) => change,
            Err(met) => self.give_up(task, met)?,
        };
        let decision = self.decide(task, change, beta, &mut rng, |_| 0.0, moved)?;
        self.count_many(decision);
        if self.warming(visit).is_some() && !decision.is_same {
            block.step.adapt(decision, block.target);
        }
        Ok(())
    }

    pub(crate) fn count_many(&mut self, decision: Decision) {
        self.counts.many.proposed += 1;
        self.counts.many.accepted += u64::from(decision.accepted);
    }
}
