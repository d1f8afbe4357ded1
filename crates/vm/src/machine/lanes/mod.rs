//! Many runs at once, in lanes: each instruction runs once for all runs at the same place.
//!
//! Particles that have asked the same questions are at the same place: they have the same activations, the same
//! addresses and the same steps so far. Only values differ. So one [`State`] stands for all of them, and a
//! register whose values differ has a [`Column`] beside it, with a value for each lane. Instructions on
//! registers that all lanes share run on that state, as for a single run; instructions on columns are loops
//! over the lanes.
//!
//! Lanes do exactly what a single run does, to the bit, or nothing. They return a [`Divergence`] where their
//! paths part (at a jump that some take) and where a run would meet a fault or comes near a limit. They also
//! return it at sites that only single runs support. The caller then continues from the last pause of the lanes,
//! with a state for each ([`Lanes::state_of`]), and the machine for single runs reports what happens. Random bits
//! depend on addresses alone, so repeated choices are the same.
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

/// The lanes cannot continue together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divergence;

impl From<crate::fault::Fault> for Divergence {
    #[cold]
    fn from(_: crate::fault::Fault) -> Divergence {
        Divergence
    }
}

/// Runs at the same place.
#[derive(Clone, Debug)]
pub struct Lanes {
    /// The place of the runs, and the values that they share.
    pub(super) state: State,
    /// For each register of the state, its values if they differ. The register then contains `None`.
    pub(super) columns: Vec<Option<Column>>,
    /// The results of the runs, if they differ.
    pub(super) result: Option<Column>,
    /// The number of lanes.
    count: usize,
    /// The difference between the state's account and the account of each lane; empty if all accounts are
    /// equal.
    behind: Vec<Account>,
}

/// The account of a run: steps, bytes of values, bytes of logged choices.
type Account = [u64; 3];

fn account(state: &State) -> Account {
    [state.steps, state.charged as u64, state.logged as u64]
}

/// The activations that a run's only future is in, from the innermost on. `None` if there are other futures, or
/// data that lanes do not copy.
fn activations(state: &State) -> Option<Vec<NodeId>> {
    let Some(Status::Runnable(node)) = state.futures.first().map(|root| &root.status) else { return None };
    if state.futures.len() != 1
        || state.origins.is_some()
        || state.memos.bytes() > 0
        || state.parts.is_recording()
    {
        return None;
    }
    let above =
        |node: &NodeId| Some(state.nodes[node.0 as usize].parent).filter(|above| *above != NodeId::NONE);
    Some(std::iter::successors(Some(*node), above).collect())
}

impl Lanes {
    /// Combines paused runs, if they are at the same place.
    pub fn line_up<'s>(states: impl Iterator<Item = &'s State>) -> Option<Lanes> {
        let states: Vec<&State> = states.collect();
        let first = *states.first()?;
        let nodes = activations(first)?;
        let are_alike = |state: &&State| {
            state.nodes.len() == first.nodes.len()
                && state.registers.len() == first.registers.len()
                && activations(state).is_some_and(|path| path == nodes)
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
        // The registers of a node end where the registers of the next node begin.
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
            states.iter().map(|state| account(state)).fold([0; 3], |a, b| [0, 1, 2].map(|i| a[i].max(b[i])));
        (state.steps, state.charged, state.logged) = (most[0], most[1] as usize, most[2] as usize);
        let less = |state: &&State| [0, 1, 2].map(|i| most[i] - account(state)[i]);
        let behind: Vec<Account> = states.iter().map(less).collect();
        let behind = if behind.iter().all(|less| *less == [0; 3]) { vec![] } else { behind };
        Some(Lanes { state, columns, result: None, count: states.len(), behind })
    }

    /// The place of the runs: the state that all of them share.
    pub fn shared(&self) -> &State {
        &self.state
    }

    /// The state of the run in a lane.
    pub fn state_of(&self, lane: usize) -> State {
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

    /// Replaces lane `i` by the earlier lane `from[i]`.
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
    /// Runs the only future of all lanes until an answer pauses it or it returns. After a [`Divergence`] the
    /// lanes cannot be used.
    ///
    /// # Errors
    /// The lanes cannot continue together.
    pub fn resume_lanes<A: LaneAnswers>(
        &mut self,
        lanes: &mut Lanes,
        answers: &mut A,
    ) -> Result<super::Stop, Divergence> {
        if self.held.is_some() || self.together.is_some() || lanes.state.runnable().len() != 1 {
            return Err(Divergence);
        }
        self.empty_scratch();
        self.set_ceiling(&mut lanes.state);
        let future = lanes.state.runnable().first().unwrap_or(FutureId::NONE);
        let Some(Status::Runnable(node)) = lanes.state.futures.get(future.0 as usize).map(|f| &f.status)
        else {
            return Err(Divergence);
        };
        let node = *node;
        self.in_lanes = true;
        let stop = interpret::Run::new(self, lanes, future, node).run(answers);
        self.in_lanes = false;
        stop
    }
}
