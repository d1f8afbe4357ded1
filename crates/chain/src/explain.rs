//! The work of each strategy for a proposal: the activations that it creates, invokes, unwinds into, skips and removes
//! (dissertation figure 3.1, for any program).

use crate::walk::proposal::{FromPrior, Move};
use crate::walk::state::State;
use crate::walk::streams::Streams;
use niwaki_math::{Dist, StreamKey};
use niwaki_run::fresh::Fresh;
use niwaki_run::glob::matches;
use niwaki_run::select::no_choice;
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::inspect::Activation;
use niwaki_vm::machine::kept::{Change, Propose, Proposed, Step, Strategy};
use niwaki_vm::machine::words;
use niwaki_vm::value::Value;
use std::collections::HashMap;

/// An event of an activation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The activation was created and run.
    Created,
    /// The activation was run from its start.
    Invoked,
    /// The activation resumed after a call that had returned, or at the choice.
    Unwound,
    /// The activation was skipped, because its inputs were unchanged.
    Skipped,
    /// The activation was removed.
    Removed,
}

/// A run: the strategy, and its events in order, by place among the activations.
#[derive(Clone, Debug)]
pub struct Run {
    /// The strategy.
    pub strategy: Strategy,
    /// The events.
    pub steps: Vec<(Event, usize)>,
    /// Whether the run ended; it stops early at a score of minus infinity.
    pub is_complete: bool,
}

/// A proposal under every strategy.
#[derive(Clone, Debug)]
pub struct Explained {
    /// Activations before and after, each before its callees; `depth` is its depth in the call tree.
    pub activations: Vec<Activation>,
    /// The activation that holds the choice.
    pub home: usize,
    /// The choice's readable address.
    pub path: String,
    /// The previous value.
    pub old: Value,
    /// The proposed value.
    pub new: Value,
    /// The runs.
    pub runs: Vec<Run>,
}

/// Events in order, by key of the activation.
type Keyed = Vec<(Event, u128)>;

struct Draws {
    key: StreamKey,
    /// The old and the new value.
    drawn: Option<(Value, Value)>,
}

impl Propose<f64> for Draws {
    fn propose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        old: &Value,
        log: f64,
    ) -> Result<Proposed<f64>, Fault> {
        let proposed = FromPrior.propose(at, 0, dist, old, log, &mut self.key.at(at.address()))?;
        let names = at.words();
        let [old, new] = [old, &proposed.value].map(|value| words::named(value, names.as_deref()));
        self.drawn = Some((old, new));
        Ok(proposed)
    }
}

/// The most proposals that may draw the old value again.
const DRAWS: u64 = 200;

/// Propose a value from the prior for the choice at `address`, in the first state of a seed, under each strategy. `address` is
/// readable, or a pattern whose first match counts. All proposals are undone.
///
/// # Errors
/// No such choice; a choice with a single value; no first state; a fault of the program.
pub fn explain(task: &Task, seed: u64, tries: u64, address: &str) -> Result<Explained, Failure> {
    let program = &*task.program;
    let streams = Streams::new(seed, 0);
    let (mut state, _) = State::start(task, streams, tries, None)?;
    let paths: Vec<String> = state.trace.numbers().map(|n| state.trace.path(program, n)).collect();
    let exact = paths.iter().position(|path| path == address);
    let Some(choice) = exact.or_else(|| paths.iter().position(|path| matches(address, path))) else {
        return Err(no_choice(address, &paths).into());
    };
    let home = state.trace.key_of(program, state.trace.activation(choice, 0));
    let before = state.trace.outline(program);
    let mut machine = task.machine();
    let mut runs: Vec<(Strategy, Keyed, bool)> = Vec::new();
    let (mut after, mut new) = (Vec::new(), None);
    for strategy in [Strategy::Rerun, Strategy::Resume, Strategy::Cache, Strategy::C3] {
        for visit in 0..DRAWS {
            let mut draws = Draws { key: streams.moves(visit), drawn: None };
            let (key, hosts) = (streams.fresh(visit), &*task.hosts);
            let mut answers = Fresh::plain(key, hosts);
            state.trace.note_steps();
            let change = machine.propose(&mut state.trace, choice, strategy, &mut draws, &mut answers);
            let noted = state.trace.take_steps();
            let change = match change {
                Ok(change) => change,
                Err(met) if met.is_invalid() => Change::Impossible,
                Err(met) => {
                    state.trace.rollback(program);
                    return Err(met.into());
                }
            };
            if change != Change::Unchanged {
                let steps = named(&state, task, &noted);
                if after.is_empty() {
                    after = state.trace.outline(program);
                }
                runs.push((strategy, steps, change == Change::Done));
                new = draws.drawn;
            }
            state.trace.rollback(program);
            if change != Change::Unchanged {
                break;
            }
        }
    }
    let Some((old, new)) = new else {
        return Err(Fault::new("one-value", format!("the choice `{}` drew no other value", paths[choice]))
            .with_help("explain a choice that can have more than one")
            .into());
    };
    let activations = merged(before, after);
    let place: HashMap<u128, usize> = activations.iter().enumerate().map(|(i, a)| (a.key, i)).collect();
    let at = |key: &u128| place.get(key).copied();
    Ok(Explained {
        home: home.and_then(|key| at(&key)).unwrap_or(0),
        path: paths[choice].clone(),
        old,
        new,
        runs: runs
            .into_iter()
            .map(|(strategy, steps, is_complete)| Run {
                strategy,
                steps: steps.iter().filter_map(|(event, key)| Some((*event, at(key)?))).collect(),
                is_complete,
            })
            .collect(),
        activations,
    })
}

/// The machine's steps by key. An activation is unwound into where one that it called has just returned, or where the
/// run began inside it.
fn named(state: &State, task: &Task, noted: &[Step]) -> Keyed {
    let (trace, program) = (&state.trace, &*task.program);
    let mut steps: Keyed = Vec::new();
    let mut returned = None;
    for (i, step) in noted.iter().enumerate() {
        let (event, node) = match step {
            Step::Created(node) => (Event::Created, *node),
            Step::Entered(node) => {
                let from_below = returned.is_some_and(|below| trace.is_below(below, *node));
                let at_start = i == 0 && *node != niwaki_vm::machine::state::NodeId(0);
                (if from_below || at_start { Event::Unwound } else { Event::Invoked }, *node)
            }
            Step::Skipped(node) => (Event::Skipped, *node),
            Step::Removed(node) => (Event::Removed, *node),
            Step::Unwound(node) => {
                returned = Some(*node);
                continue;
            }
        };
        if !matches!(step, Step::Skipped(_) | Step::Removed(_)) {
            returned = None;
        }
        let Some(key) = trace.key_of(program, node) else { continue };
        // A created activation is entered at once.
        if !(event == Event::Invoked && steps.last() == Some(&(Event::Created, key))) {
            steps.push((event, key));
        }
    }
    steps
}

/// The activations of two outlines, in the order of the first. An activation of the second alone comes after its
/// predecessor there.
fn merged(before: Vec<Activation>, after: Vec<Activation>) -> Vec<Activation> {
    let mut children: HashMap<u128, Vec<Activation>> = HashMap::new();
    let mut seen = std::collections::HashSet::new();
    let Some(root) = before.first().cloned() else { return after };
    for activation in before.into_iter().chain(after) {
        if seen.insert(activation.key) && activation.key != root.key {
            children.entry(activation.parent).or_default().push(activation);
        }
    }
    let (mut all, mut work) = (Vec::new(), vec![root]);
    while let Some(next) = work.pop() {
        work.extend(children.remove(&next.key).unwrap_or_default().into_iter().rev());
        all.push(next);
    }
    all
}
