//! Many runs at once, in lanes: an instruction is carried out once for all runs that stand at it.
//!
//! Particles that have asked the same questions are at the same place: the same activations, the same addresses, the
//! same steps so far. What differs is values. So one [`State`] stands for all of them, and a register whose values differ has a
//! [`Column`] beside it, with a value for each lane. Instructions on registers that all share are carried out on that state,
//! as for a single run; those on columns are loops over the lanes.
//!
//! Lanes do what a single run does, to the bit, or nothing: where their ways part (a jump that some take), where a run
//! would meet a fault, where it comes near a limit, and at sites that only single runs carry out, the answer is [`Apart`].
//! The caller then goes on from where the lanes last paused, with a state for each ([`Lanes::apart`]), and what happens is reported by
//! the machine for single runs. As random bits depend on addresses alone, the choices that are made again are the same.
//!
//! * `column`: the values of a register; `interpret`: the loop over instructions; `operate`: instructions on columns;
//! * `questions`: choices and factors; `calls`: calls, loops and returns.

mod calls;
mod column;
mod interpret;
mod operate;
mod questions;

pub use column::Column;
pub use questions::{Dists, LaneAnswers, Logs};

use super::Machine;
use super::state::{FutureId, Node, NodeId, State, Status};
use crate::value::{Value, identical};

/// The lanes cannot go on together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Apart;

impl From<crate::fault::Fault> for Apart {
    #[cold]
    fn from(_: crate::fault::Fault) -> Apart {
        Apart
    }
}

/// Runs at the same place.
#[derive(Clone, Debug)]
pub struct Lanes {
    /// Where they are, and the values that they share.
    pub(super) state: State,
    /// Of each register of the state: its values, where they differ. The register then holds `None`.
    pub(super) columns: Vec<Option<Column>>,
    /// What they returned, where it differs.
    pub(super) result: Option<Column>,
    /// How many they are.
    count: usize,
    /// By how much less each has spent than the state says; nothing where all have spent the same.
    behind: Vec<Spent>,
}

/// Steps, bytes of values, bytes of logged choices.
type Spent = [u64; 3];

fn spent(state: &State) -> Spent {
    [state.steps, state.charged as u64, state.logged as u64]
}

/// The activations that a run's one future is in, from the innermost; `None` where there are other futures, or what lanes do not
/// copy.
fn activations(state: &State) -> Option<Vec<NodeId>> {
    let Some(Status::Runnable(node)) = state.futures.first().map(|root| &root.status) else { return None };
    if state.futures.len() != 1
        || state.origins.is_some()
        || state.memos.bytes() > 0
        || state.parts.are_noted()
    {
        return None;
    }
    let above =
        |node: &NodeId| Some(state.nodes[node.0 as usize].parent).filter(|above| *above != NodeId::NONE);
    Some(std::iter::successors(Some(*node), above).collect())
}

impl Lanes {
    /// Runs that are paused, where they are at the same place.
    pub fn line_up<'s>(states: impl Iterator<Item = &'s State>) -> Option<Lanes> {
        let states: Vec<&State> = states.collect();
        let first = *states.first()?;
        let nodes = activations(first)?;
        let are_alike = |state: &&State| {
            state.nodes.len() == first.nodes.len()
                && state.registers.len() == first.registers.len()
                && activations(state).is_some_and(|own| own == nodes)
                && nodes.iter().all(|node| {
                    let [a, b] = [first, *state].map(|of| &of.nodes[node.0 as usize]);
                    let places = |n: &Node| (n.parent, n.site, n.registers, n.iteration, n.pc);
                    a.path == b.path && a.function == b.function && places(a) == places(b)
                })
        };
        if !states[1..].iter().all(are_alike) {
            return None;
        }
        let mut state = first.clone();
        let mut columns = vec![None; state.registers.len()];
        let mut is_live = vec![false; state.registers.len()];
        // The registers of a node end where those of the next one begin.
        let mut ends: Vec<usize> = state.nodes.iter().map(|n| n.registers as usize).collect();
        ends.sort_unstable();
        for node in &nodes {
            let from = state.nodes[node.0 as usize].registers as usize;
            let end = ends[ends.partition_point(|end| *end <= from)..].first().copied();
            is_live[from..end.unwrap_or(columns.len())].fill(true);
        }
        for (at, column) in columns.iter_mut().enumerate() {
            let value = &first.registers[at];
            if is_live[at] && states[1..].iter().all(|other| identical(&other.registers[at], value)) {
                continue;
            }
            state.registers[at] = Value::None;
            if is_live[at] {
                *column = Column::of(states.len(), |lane| Ok(states[lane].registers[at].clone())).ok();
            }
        }
        let most =
            states.iter().map(|state| spent(state)).fold([0; 3], |a, b| [0, 1, 2].map(|i| a[i].max(b[i])));
        (state.steps, state.charged, state.logged) = (most[0], most[1] as usize, most[2] as usize);
        let less = |state: &&State| [0, 1, 2].map(|i| most[i] - spent(state)[i]);
        let behind: Vec<Spent> = states.iter().map(less).collect();
        let behind = if behind.iter().all(|less| *less == [0; 3]) { vec![] } else { behind };
        Some(Lanes { state, columns, result: None, count: states.len(), behind })
    }

    /// Where they are: what is the same for all of them.
    pub fn shared(&self) -> &State {
        &self.state
    }

    /// The state of the run in one lane.
    pub fn apart(&self, lane: usize) -> State {
        let mut state = self.state.clone();
        for (register, column) in state.registers.iter_mut().zip(&self.columns) {
            if let Some(column) = column {
                *register = column.get(lane);
            }
        }
        if let Some(result) = &self.result {
            state.futures[0].status = Status::Returned(result.get(lane));
        }
        if let Some([steps, charged, logged]) = self.behind.get(lane) {
            state.steps -= steps;
            state.charged -= *charged as usize;
            state.logged -= *logged as usize;
        }
        state
    }

    /// Lane `i` becomes what lane `from[i]` was.
    pub fn pick(&mut self, from: &[u32]) {
        self.count = from.len();
        for column in self.columns.iter_mut().chain([&mut self.result]).flatten() {
            *column = column.picked(from);
        }
        if !self.behind.is_empty() {
            self.behind = from.iter().map(|lane| self.behind[*lane as usize]).collect();
        }
    }
}

impl Machine<'_> {
    /// Runs the one future of all lanes until an answer pauses it or it returns. After [`Apart`] the lanes cannot be used.
    ///
    /// # Errors
    /// They cannot go on together.
    pub fn resume_lanes<A: LaneAnswers>(
        &mut self,
        lanes: &mut Lanes,
        answers: &mut A,
    ) -> Result<super::Stop, Apart> {
        if self.held.is_some() || self.together.is_some() || lanes.state.runnable().len() != 1 {
            return Err(Apart);
        }
        self.empty_scratch();
        self.set_ceiling(&mut lanes.state);
        let future = lanes.state.runnable().first().unwrap_or(FutureId::NONE);
        let Some(Status::Runnable(node)) = lanes.state.futures.get(future.0 as usize).map(|f| &f.status)
        else {
            return Err(Apart);
        };
        let node = *node;
        self.in_lanes = true;
        let stop = interpret::Run::of(self, lanes, future, node).go(answers);
        self.in_lanes = false;
        stop
    }
}
