//! Exchange: of two real choices at one site of the program, one gets what the other loses, so that their sum stays.
//!
//! Iterations of a loop and levels of a recursion often add up: gaps to a height, turns to a direction. A move of one value moves all that
//! comes later; an exchange moves only what lies between the two.
//!
//! The first choice is picked evenly. The second is the next one of its site by number, or any other one of its site. A run that gets or
//! loses choices is rejected, so numbers stay, and the pick is as likely on the way back. The amount has a symmetric density.
//!
//! A choice that is no real, or has no other one at its site, is drawn from its prior. By this draw the site may get another choice, from which
//! the way back has another probability. So the step is for searches for the best, and no kernel of users.

use crate::leaf::drift::normal;
use crate::walk::proposal::FromPrior;
use crate::walk::streams::below;
use crate::walk::{ChainMove, Proposing, Walk};
use niwaki_math::Stream;
use niwaki_run::Failure;
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
        let real = |choice| chain.state.real(program, choice);
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
        let change = chain.change(task, machine, visit, changes)?;
        let selection = |chain: &Walk| chain.with_same_choices(program);
        let decision = chain.decide(task, change, beta, &mut rng, selection, moved)?;
        chain.count_many(decision);
        Ok(())
    }
}

/// Another choice at the site of a choice. `None` if there is none.
fn partner(trace: &Trace, first: usize, rng: &mut Stream) -> Option<usize> {
    let (site, count) = (trace.site_of(first), trace.len());
    let mut partners =
        (1..count).map(|by| (first + by) % count).filter(|other| trace.site_of(*other) == site);
    if rng.uniform() < NEXT {
        return partners.next();
    }
    let partners: Vec<usize> = partners.collect();
    (!partners.is_empty()).then(|| partners[below(rng, partners.len() as u64) as usize])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::plan::Plan;
    use crate::walk::state::State;
    use crate::walk::streams::Streams;
    use crate::{Chain, Settings};
    use niwaki_run::Task;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use std::collections::HashMap;
    use std::sync::Arc;

    /// Four numbers of a site, each with a truth value where it is above 1, and a number of another site.
    const NUMBERS: &str = r#"(module (fn "m" (params)
        (set $xs (list)) (set $first (sample (dist gaussian 0.0 1.0)))
        (for $i (range 4) (body
            (set $x (sample (dist gaussian 0.0 1.0)))
            (set $xs (append $xs $x))
            (if (gt $x 1.0) (then (do (sample (dist bernoulli 0.5)))) (else))))
        (return $xs)) (entry "m"))"#;

    /// The numbers of runs before and after so many exchanges.
    fn exchanged(steps: u64, count: u64) -> Vec<(Vec<f64>, Vec<f64>)> {
        let task =
            Task::new(Arc::new(compile(&parse(NUMBERS).expect("core form"), vec![]).expect("a program")));
        let numbers = |state: &State| match state.trace.result() {
            Value::List(list) => {
                list.iter().map(|value| if let Value::Real(x) = value { *x } else { 0.0 }).collect()
            }
            _ => Vec::new(),
        };
        let run = |seed| {
            let (state, _) = State::start(&task, Streams::new(seed, 0), 1, None).expect("a run");
            let before = numbers(&state);
            let settings = Settings { seed, thin: 0, ..Settings::default() };
            let plan = Plan::new(&Kernel::EXCHANGE).expect("a plan");
            let mut chain = Chain::at(&task, &settings, 1, plan, state, &HashMap::new()).expect("a chain");
            chain.advance(&task, steps, &mut |_, _| true).expect("no fault");
            (before, numbers(&chain.into_state()))
        };
        (0..count).map(run).collect()
    }

    #[test]
    fn the_sum_stays_and_the_choices_stay() {
        let sum = |xs: &[f64]| xs.iter().sum::<f64>();
        let (mut moved, mut drawn) = (0, 0);
        for (before, after) in exchanged(1, 400) {
            let pairs = || before.iter().zip(&after);
            match pairs().filter(|(a, b)| a != b).count() {
                0 => {}
                1 => drawn += 1,
                2 => {
                    moved += 1;
                    assert!((sum(&before) - sum(&after)).abs() < 1e-12, "{before:?} {after:?}");
                    assert!(pairs().all(|(a, b)| (*a > 1.0) == (*b > 1.0)), "{before:?} {after:?}");
                }
                _ => panic!("{before:?} {after:?}"),
            }
        }
        assert!(moved > 100 && drawn == 0, "{moved} {drawn}");
    }

    #[test]
    fn the_prior_stays() {
        let after: Vec<f64> = exchanged(40, 2500).into_iter().flat_map(|(_, after)| after).collect();
        let mean = |f: &dyn Fn(f64) -> f64| after.iter().map(|x| f(*x)).sum::<f64>() / after.len() as f64;
        assert!((mean(&|x| x * x) - 1.0).abs() < 0.06, "{}", mean(&|x| x * x));
        let above = mean(&|x| f64::from(x > 1.0));
        assert!((above - 0.1587).abs() < 0.016, "{above}");
    }
}
