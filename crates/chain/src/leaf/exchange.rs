//! Exchange: of two real choices at one site of the program, one gets what the other loses, so that their sum stays.
//!
//! Iterations of a loop and levels of a recursion often add up: gaps to a height, turns to a direction. A move of one value moves all that
//! comes later; an exchange moves only what lies between the two.
//!
//! The first choice is picked evenly. The second is the next one of its site by number, or any other one of its site. A run that gets or
//! loses choices is rejected, so numbers stay, and the pick is as likely on the way back. The amount has a symmetric density.

use crate::leaf::drift::normal;
use crate::walk::proposal::FromPrior;
use crate::walk::streams::below;
use crate::walk::{ChainMove, Proposing};
use niwaki_math::Stream;
use niwaki_run::Failure;
use niwaki_run::fresh::Fresh;
use niwaki_vm::machine::kept::{Changed, Proposed, Trace};
use niwaki_vm::value::Value;

/// The probability that the second choice is the next one of the site.
const NEXT: f64 = 0.5;
/// The smallest size of an amount, as a power of e of the spread; the largest is the spread itself.
const SMALLEST: f64 = -4.0;

/// An exchange between two choices.
#[derive(Clone, Copy, Debug)]
pub struct Exchange;

impl ChainMove for Exchange {
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure> {
        let Proposing { chain, task, machine, table, beta } = proposing;
        let (visit, program) = (chain.visit, &*task.program);
        let trace = &chain.state.trace;
        let mut rng = chain.streams.decisions(visit);
        if trace.is_empty() {
            chain.visit += 1;
            return Ok(());
        }
        let first = below(&mut rng, trace.len() as u64) as usize;
        let real = |choice: usize| match trace.choice(program, choice).0 {
            Value::Real(x) => Some(*x),
            _ => None,
        };
        let pair = partner(trace, first, &mut rng)
            .and_then(|second| Some([(first, real(first)?), (second, real(second)?)]));
        let Some(pair) = pair else {
            return chain.single(task, machine, &mut FromPrior, table, beta);
        };
        chain.visit += 1;
        let spread = chain.spreads[chain.counts.number(trace.site_of(first))];
        let amount = spread * (SMALLEST * rng.uniform()).exp() * normal(&mut rng);
        let (mut changes, mut moved) = (vec![], vec![]);
        for ((choice, x), by) in pair.into_iter().zip([amount, -amount]) {
            moved.push((trace.address(program, choice), Value::Real(x)));
            let proposed = Proposed { value: Value::Real(x + by), forward: 0.0, backward: 0.0 };
            changes.push(Changed { choice, proposed });
        }
        let mut answers = Fresh::plain(chain.streams.fresh(visit), &*task.hosts);
        let change = match machine.change(&mut chain.state.trace, changes, chain.strategy, &mut answers) {
            Ok(change) => change,
            Err(met) => chain.give_up(task, met)?,
        };
        let selection = |chain: &crate::walk::Walk| {
            let trace = &chain.state.trace;
            let is_same = trace.births(program).len() == 0 && trace.deaths().is_empty();
            if is_same { 0.0 } else { f64::NEG_INFINITY }
        };
        let decision = chain.decide(task, change, beta, &mut rng, selection, moved)?;
        chain.count_many(decision);
        Ok(())
    }
}

/// Another choice at the site of a choice. `None` if there is none.
fn partner(trace: &Trace, first: usize, rng: &mut Stream) -> Option<usize> {
    let (site, count) = (trace.site_of(first), trace.len());
    let mut others = (1..count).map(|by| (first + by) % count).filter(|other| trace.site_of(*other) == site);
    if rng.uniform() < NEXT {
        return others.next();
    }
    let others: Vec<usize> = others.collect();
    (!others.is_empty()).then(|| others[below(rng, others.len() as u64) as usize])
}
