//! For tests. [`compare`] runs the four strategies step by step: proposals, decisions, exchanges, scores and scenes are equal to
//! the bit, proposals that are not kept leave nothing behind, and sums equal those of a run from the start. With several powers,
//! on each rung. [`repetitions`] is the size of a statistical test.

use niwaki_chain::ladder::Ladder;
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_chain::{Chain, Settings};
use niwaki_run::replay::{Missing, Source, replay};
use niwaki_run::{Failure, Task};
use niwaki_vm::code::Program;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::machine::kept::inspect::Item;
use std::collections::HashMap;
use std::fmt::Write;

const STRATEGIES: [Strategy; 4] = [Strategy::Rerun, Strategy::Resume, Strategy::Cache, Strategy::C3];

/// The expected count below which z-scores of an outcome are not normal: tests count such outcomes together.
pub const RARE: f64 = 25.0;

/// The number of repetitions of a statistical test: a quarter of `full`, times the factor in the environment's
/// `NIWAKI_REPETITIONS`. `make soak` sets it to 4.
///
/// # Panics
/// If the factor is not a positive whole number.
pub fn repetitions(full: u64) -> u64 {
    let factor = std::env::var("NIWAKI_REPETITIONS").map_or(1, |text| text.parse().expect("a whole number"));
    assert!(factor > 0, "the factor of repetitions is 0");
    full * factor / 4
}

/// The size of a comparison.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compared {
    /// Proposals, of each rung of each strategy.
    pub proposals: u64,
    /// Those that were kept.
    pub accepted: u64,
    /// Those at which every strategy met the same fault.
    pub faults: u64,
    /// Exchanges of states between rungs.
    pub exchanges: u64,
    /// Proposals that are invalid, those of first states included.
    pub invalid: u64,
}

/// The whole content of a state, as text.
fn dump(state: &State, program: &Program) -> String {
    let trace = &state.trace;
    let mut text = format!("{:?} {:?} {:?}\n", trace.result(), trace.totals(), state.log_sketches);
    trace.visit(program, |place, item| {
        let content = match item {
            Item::Choice(value, log) => format!("{value:?} {log:?}"),
            Item::Held(value, log) => format!("held {value:?} {log:?}"),
            Item::Factor(log) => format!("{log:?}"),
            Item::Emit(primitive) => format!("{:?}", primitive.shapes()),
            Item::Query(key, value) => format!("{key:?} = {value:?}"),
        };
        let _ = writeln!(text, "{} {content}", place.path());
    });
    for choice in trace.numbers() {
        let _ = write!(text, "{:x} ", trace.address(program, choice));
    }
    text
}

/// Runs `steps` proposals under each strategy and compares them; every `every` proposals also everything that the states
/// hold, before and after a proposal that is not kept, and a run from the start. The first disagreement, if any.
///
/// # Errors
/// No possible first state, or a kernel that makes no sense for the program.
pub fn compare(
    task: &Task,
    settings: &Settings,
    steps: u64,
    every: u64,
) -> Result<(Option<String>, Compared), Failure> {
    let program = &*task.program;
    let (mut compared, mut ladders) = (Compared::default(), Vec::<Ladder>::new());
    let tasks = STRATEGIES.map(|_| task.uncounted());
    for (strategy, task) in STRATEGIES.into_iter().zip(&tasks) {
        ladders.push(Ladder::start(task, &Settings { strategy, thin: 0, ..settings.clone() }, 0, None)?);
    }
    for step in 0..steps {
        let is_close = (step + 1).is_multiple_of(every);
        let mut outcomes: Vec<Vec<String>> = Vec::new();
        for ((strategy, ladder), task) in STRATEGIES.iter().zip(&mut ladders).zip(&tasks) {
            let before: Vec<String> = if is_close {
                ladder.rungs.iter().map(|rung| dump(&rung.state, program)).collect()
            } else {
                vec![]
            };
            let propose = |rung: &mut Chain| match rung.advance(task, 1, &mut |_, _| true) {
                Ok(()) => format!("{:?} {:?}", rung.last(), rung.state.trace.totals()),
                Err(Failure::Run(run)) => format!("fault {} {}", run.fault.code, run.fault.message),
                Err(other) => format!("fault {other}"),
            };
            let mut outcome: Vec<String> = ladder.rungs.iter_mut().map(propose).collect();
            for ((rung, before), outcome) in ladder.rungs.iter().zip(before).zip(&outcome) {
                let is_kept = rung.last().accepted && !outcome.starts_with("fault");
                let after = dump(&rung.state, program);
                if !is_kept && after != before {
                    let difference =
                        format!("proposal {step}, {strategy:?}, rolled back to\n{after}\nfrom\n{before}");
                    return Ok((Some(difference), compared));
                }
            }
            outcome.push(format!("invalid: {:?}", task.invalid.counts()));
            outcomes.push(outcome);
            ladder.exchange_if_due();
        }
        for ((strategy, ladder), outcome) in STRATEGIES.iter().zip(&ladders).zip(&outcomes) {
            let (result, first) = ((outcome, &ladder.exchanges), (&outcomes[0], &ladders[0].exchanges));
            if result != first {
                let difference =
                    format!("proposal {step}, {strategy:?}: {result:?}\n  but a rerun: {first:?}");
                return Ok((Some(difference), compared));
            }
        }
        let rungs = ladders[0].rungs.len();
        compared.proposals += rungs as u64;
        compared.accepted += ladders[0].rungs.iter().map(|rung| u64::from(rung.last().accepted)).sum::<u64>();
        compared.faults += outcomes[0].iter().filter(|line| line.starts_with("fault")).count() as u64;
        compared.invalid = tasks[0].invalid.counts().iter().map(|place| place.1.runs).sum();
        compared.exchanges = ladders[0].exchanges.iter().map(|pair| pair.1).sum();
        if is_close {
            for rung in 0..rungs {
                let chains: Vec<_> = ladders.iter().map(|ladder| &ladder.rungs[rung]).collect();
                if let Some(difference) = look_closer(task, program, &chains, step) {
                    return Ok((Some(difference), compared));
                }
            }
        }
    }
    Ok((None, compared))
}

fn look_closer(task: &Task, program: &Program, chains: &[&Chain], step: u64) -> Option<String> {
    let dumps: Vec<String> = chains.iter().map(|chain| dump(&chain.state, program)).collect();
    for (strategy, dump) in STRATEGIES.iter().zip(&dumps) {
        if *dump != dumps[0] {
            return Some(format!(
                "after proposal {step}, {strategy:?} holds\n{dump}\nbut a rerun\n{}",
                dumps[0]
            ));
        }
    }
    // From the start: once keeping the calls, once dropping them.
    let known: HashMap<_, _> = chains[0].state.choices(program).collect();
    match State::start(task, Streams::new(0, 0), 1, Some(&known)) {
        Ok((fresh, _)) => {
            let (fresh, kept) = ((fresh.trace.totals(), fresh.score()), &chains[3].state);
            if fresh != (kept.trace.totals(), kept.score()) {
                return Some(format!(
                    "after proposal {step} a fresh run has {fresh:?}, the chain {:?}",
                    kept.trace.totals()
                ));
            }
        }
        Err(failure) => return Some(format!("after proposal {step} a fresh run fails: {failure}")),
    }
    match replay(task, Source::Addresses(known), Missing::Refuse) {
        Ok(fresh) => {
            let kept = &chains[3].state;
            let sums = (kept.trace.totals().log_prior.clone(), kept.score());
            if fresh.sums != sums {
                let fresh = fresh.sums;
                return Some(format!("after proposal {step} a replay has {fresh:?}, the chain {sums:?}"));
            }
        }
        // Two writes of one query are a fault of the replay only.
        Err(Failure::Run(run)) if run.fault.code == "query-twice" => {}
        Err(failure) => return Some(format!("after proposal {step} a replay fails: {failure}")),
    }
    None
}
