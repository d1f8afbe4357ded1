//! Kept activations: a trace that is run again only where a choice changed.
//!
//! Every activation that can suspend stays as a node after it has returned, with one slot for each of its sites. A
//! *transaction* changes choices and runs on from them: [`Machine::begin`], [`Machine::propose`] or
//! [`Machine::change`], then [`Trace::commit`] or [`Trace::rollback`]. Two switches make four strategies
//! ([`Strategy`]); they differ in what they skip and in nothing else.
//!
//! * `begin`: the first run; `slot`, `journal`: what is remembered, and what can be undone;
//! * `questions`: choices, factors, emits and queries that are reached again;
//! * `calls`, `loops`: activations that are entered, skipped, created and removed; `adapt`: calls where reuse does not
//!   pay;
//! * `memo`: memoised calls, which have several callers;
//! * `slices`: activations that are entered for one change only, and run no more than what depends on it;
//! * `cells`: elements of collections, and their readers;
//! * `transaction`: changing choices, keeping or undoing it; `changes`: what that did to the choices;
//! * `ahead`: memory that the next proposal will need; `arrange`: numbers of choices, given back;
//! * [`inspect`]: what a trace holds, in program order; [`part`]: parts of it that can be run apart; `scene`: which
//!   primitives belong to a part.
//!
//! Futures run where they are created, so every future has returned when its value is read.
//!
//! Source: C3, dissertation chapter 3: its cache is the slots, its continuations are (node, program counter).

mod adapt;
mod ahead;
mod arrange;
mod begin;
mod calls;
mod cells;
mod changes;
pub mod inspect;
mod journal;
mod loops;
mod memo;
pub mod part;
mod questions;
mod scene;
mod slices;
mod slot;
mod transaction;

pub use adapt::Adaptation;
pub use questions::fits;
pub use transaction::{Change, Changed, Propose, Proposed};

use super::Machine;
use super::answers::Answers;
use super::keep::{Keep, Onward};
use super::question::Halt;
use super::registers::Registers;
use super::state::{NodeId, State, make_room};
use super::suspend::After;
use crate::code::{Args, Mode, Program, SiteId};
use crate::fault::Fault;
use crate::value::{Census, Value, same};
use adapt::Sites;
use cells::{Reader, Readers};
use journal::{Journal, MOVING};
use memo::Memos;
use niwaki_geom::Primitive;
use niwaki_math::{Scalar, Total};
use slices::Entry;
use slot::Slot;

/// How much of a run is done again when a choice changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// All of it, from the start: Lightweight MH.
    Rerun,
    /// Everything after the choice.
    Resume,
    /// From the start, but calls whose inputs are unchanged are skipped.
    Cache,
    /// From the choice on, skipping, until nothing that changed is left.
    #[default]
    C3,
}

impl Strategy {
    /// All of them, with their names.
    pub const NAMED: [(&str, Strategy); 4] = [
        ("rerun", Strategy::Rerun),
        ("resume", Strategy::Resume),
        ("cache", Strategy::Cache),
        ("c3", Strategy::C3),
    ];

    /// The strategy of a name.
    pub fn from_name(name: &str) -> Option<Strategy> {
        Strategy::NAMED.into_iter().find(|(own, _)| *own == name).map(|(_, strategy)| strategy)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Strategy::NAMED.into_iter().find(|(_, own)| *own == self).map_or("", |(name, _)| name)
    }

    /// Whether a run starts at the changed choice.
    pub fn starts_at_choice(self) -> bool {
        matches!(self, Strategy::Resume | Strategy::C3)
    }

    /// Whether calls with unchanged inputs are skipped.
    pub fn reuses(self) -> bool {
        matches!(self, Strategy::Cache | Strategy::C3)
    }
}

/// Work done, for reports and tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Activations that were entered, from above or from inside.
    pub entered: u64,
    /// Calls and iterations that were skipped.
    pub skipped: u64,
    /// Instructions.
    pub instructions: u64,
}

/// What happened to an activation in a run, for reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Instructions of it were carried out.
    Entered(NodeId),
    /// It was skipped: its inputs were unchanged.
    Skipped(NodeId),
    /// It was created.
    Created(NodeId),
    /// It was removed.
    Removed(NodeId),
    /// It returned to its caller.
    Unwound(NodeId),
}

/// A choice's place in the trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChoiceAt {
    pub node: NodeId,
    pub site: u16,
}

/// A loop that was entered from above in the run in progress.
#[derive(Clone, Copy, Debug)]
struct Active {
    header: NodeId,
    /// What its iterations capture has changed.
    captures: Entry,
    /// What it runs over has changed.
    over: bool,
}

/// Sums over a trace, or what a transaction adds to them; exact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// Log densities of the choices, nats.
    pub log_prior: Total,
    /// Factors and observations, nats.
    pub log_factors: Total,
    /// The number of factors and observations.
    pub factors: i64,
}

impl Totals {
    /// Adds other sums.
    #[inline(always)]
    pub fn add(&mut self, other: &Totals) {
        self.log_prior.add_total(&other.log_prior);
        self.log_factors.add_total(&other.log_factors);
        self.factors += other.factors;
    }

    /// Whether a choice or a factor is minus infinity.
    #[inline(always)]
    pub fn is_impossible(&self) -> bool {
        self.log_prior.is_impossible() || self.log_factors.is_impossible()
    }
}

/// The kept part of a trace.
#[derive(Debug)]
pub(crate) struct Kept<S: Scalar> {
    pub slots: Vec<Slot>,
    /// Iterations of each loop node.
    pub loops: Vec<Vec<NodeId>>,
    pub choices: Vec<ChoiceAt>,
    pub emits: Vec<Option<Primitive>>,
    pub free_emits: Vec<u32>,
    /// The readers of each cell.
    pub readers: Vec<Readers>,
    pub free_readers: Vec<u32>,
    pub memos: Memos<S>,
    pub sites: Sites,
    pub result: Value<S>,
    /// How often each held choice is in the trace, and how many of them are not.
    pub met: Vec<i32>,
    pub unmet: usize,
    /// Sums over the trace before the open transaction.
    pub totals: Totals,
    pub counters: Counters,
    pub steps: Option<Vec<Step>>,
    // The open transaction.
    pub journal: Journal<S>,
    pub open: bool,
    /// What it adds to the sums.
    pub change: Totals,
    pub result_before: Option<Value<S>>,
    /// Log densities of choices that were drawn, and of those that were removed.
    pub fresh: Total,
    pub stale: Total,
    /// The new value of the changed choice is outside its support.
    pub outside: bool,
    /// The changed choices: slot, and the log densities of the change and of its reverse.
    pub changed: Vec<(u32, f64, f64)>,
    pub now: u32,
    // The run in progress.
    depth: u32,
    /// The current instruction, and where each activation entered from above continues when it is left.
    pc: u32,
    returns: Vec<u32>,
    /// The current activation was created in this transaction: the journal need not record it.
    quiet: bool,
    early: bool,
    reuse: bool,
    active: Vec<Active>,
    /// Transaction in which a node was marked as being above a changed choice.
    marks: Vec<u32>,
    marking: bool,
    /// Readers of changed cells, and how many of them have run.
    woken: Vec<Reader>,
    taken: usize,
    /// The run must not leave the current activation; and whether it did.
    confined: bool,
    tangled: bool,
}

/// A run whose activations are kept.
#[derive(Debug)]
pub struct Trace<S: Scalar = f64> {
    pub(crate) state: State<S>,
    pub(crate) kept: Kept<S>,
}

impl<S: Scalar> Kept<S> {
    fn new(program: &Program<S>) -> Self {
        Kept {
            slots: vec![],
            loops: vec![],
            choices: vec![],
            emits: vec![],
            free_emits: vec![],
            readers: vec![],
            free_readers: vec![],
            memos: Memos::default(),
            sites: Sites::new(program, Some(Adaptation::default())),
            result: Value::None,
            met: vec![],
            unmet: 0,
            totals: Totals::default(),
            counters: Counters::default(),
            steps: None,
            journal: Journal::default(),
            open: false,
            change: Totals::default(),
            result_before: None,
            fresh: Total::default(),
            stale: Total::default(),
            outside: false,
            changed: vec![],
            now: 0,
            depth: 0,
            pc: 0,
            returns: vec![],
            quiet: false,
            early: false,
            reuse: false,
            active: vec![],
            marks: vec![],
            marking: false,
            woken: vec![],
            taken: 0,
            confined: false,
            tangled: false,
        }
    }

    #[inline(always)]
    fn slot_at(state: &State<S>, node: NodeId, site: usize) -> usize {
        state.nodes[node.0 as usize].slots as usize + site
    }

    #[inline]
    fn is_new(&self, state: &State<S>, node: NodeId) -> bool {
        state.nodes[node.0 as usize].created == self.now
    }

    #[inline(always)]
    fn note(&mut self, step: Step) {
        if let Some(steps) = &mut self.steps {
            steps.push(step);
        }
    }

    /// Puts a value into a register of a node; false when it holds that already.
    #[inline]
    fn write_to(&mut self, state: &mut State<S>, node_is_new: bool, place: usize, value: Value<S>) -> bool {
        let register = &mut state.registers[place];
        if same(register, &value) {
            return false;
        }
        if node_is_new {
            register.store(value);
        } else {
            self.journal.set(register, place, value);
        }
        true
    }

    /// Writes a slot.
    #[inline]
    fn write_slot(&mut self, node_is_new: bool, at: usize, slot: Slot) {
        if !node_is_new {
            self.journal.slots.push((at as u32, self.slots[at]));
        }
        self.slots[at] = slot;
    }

    /// A node with empty slots.
    fn new_node(
        &mut self,
        program: &Program<S>,
        state: &mut State<S>,
        function: crate::code::FunctionId,
        parent: NodeId,
        site: u32,
        path: u128,
    ) -> NodeId {
        let count = state.nodes.len();
        let created = state.new_node(program, function, parent, site, path);
        let node = &mut state.nodes[created.0 as usize];
        node.created = self.now;
        // A new iteration has an exit code that no iteration ends with.
        node.pc = u32::MAX;
        if created.0 as usize == count {
            let f = program.function(function);
            if f.mode == Mode::Loop {
                node.slots = self.loops.len() as u32;
                self.loops.push(Vec::new());
            } else {
                node.slots = self.slots.len() as u32;
                make_room(&mut self.slots, f.sites.len(), || state.ceiling.saturating_sub(state.bytes()));
                self.slots.resize(self.slots.len() + f.sites.len(), Slot::EMPTY);
            }
            state.charged += (f.sites.len() + 1) * size_of::<Slot>();
        }
        state.charged += size_of::<NodeId>() + MOVING;
        self.journal.more().created.push(created);
        self.note(Step::Created(created));
        created
    }

    /// Bytes of what is kept, without values and the journal.
    fn own_bytes(&self) -> usize {
        self.slots.len() * size_of::<Slot>()
            + self.choices.len() * size_of::<ChoiceAt>()
            + self.loops.iter().map(|l| size_of_val(l) + l.capacity() * size_of::<NodeId>()).sum::<usize>()
            + self.emits.len() * (size_of::<Option<Primitive>>() + 16)
            + self.readers.iter().map(Readers::bytes).sum::<usize>()
            + self.marks.len() * size_of::<u32>()
            + self.memos.bytes()
    }

    /// Releases a node, its slots empty.
    fn release(&mut self, program: &Program<S>, state: &mut State<S>, id: NodeId) {
        let node = state.nodes[id.0 as usize];
        let f = program.function(node.function);
        if f.mode == Mode::Loop {
            self.loops[node.slots as usize].clear();
        } else {
            let at = node.slots as usize;
            self.slots[at..at + f.sites.len()].fill(Slot::EMPTY);
        }
        state.release(program, id);
    }

    /// A held choice comes into the trace (1) or leaves it (-1).
    fn count_held(&mut self, number: u32, change: i32) {
        let met = &mut self.met[number as usize];
        self.unmet -= usize::from(*met == 0);
        *met += change;
        self.unmet += usize::from(*met == 0);
    }

    /// The outcome of a run that came to its end with these choices: without all of the held ones it is impossible.
    fn with_all_held(&self, change: Change) -> Change {
        if change == Change::Done && self.unmet > 0 { Change::Impossible } else { change }
    }

    /// Whether the node is above a changed choice, in a run that starts at the root.
    #[inline(always)]
    fn is_marked(&self, node: NodeId) -> bool {
        self.marking && self.marks.get(node.0 as usize).is_some_and(|mark| *mark == self.now)
    }
}

impl<S: Scalar> Keep<S> for Kept<S> {
    const KEEPS: bool = true;

    fn count_bytes<'v>(&'v self, census: &mut Census<'v, S>) {
        let journal = &self.journal;
        census.add(&self.result);
        self.result_before.iter().for_each(|value| census.add(value));
        journal.registers.iter().for_each(|(_, value)| census.add(value));
        journal.more.anew.iter().for_each(|(_, value)| census.add(value));
        self.memos.values().for_each(|value| census.add(value));
        let primitives = self.emits.iter().flatten();
        primitives.flat_map(|primitive| primitive.shapes()).for_each(|shape| census.add_shape(shape));
        census.add_bytes(self.own_bytes() + journal.bytes());
    }

    #[inline(always)]
    fn enter(&mut self, state: &State<S>, node: NodeId) {
        self.quiet = state.nodes[node.0 as usize].created == self.now;
    }

    #[inline(always)]
    fn at(&mut self, pc: usize) {
        self.pc = pc as u32;
    }

    #[inline(always)]
    fn writes_plainly(&self) -> bool {
        self.quiet
    }

    #[inline(always)]
    fn write(&mut self, state: &mut State<S>, place: usize, value: Value<S>) {
        let register = &mut state.registers[place];
        if self.quiet {
            register.store(value);
            return;
        }
        let unchanged = match (&*register, &value) {
            (Value::Real(a), Value::Real(b)) => a.value().to_bits() == b.value().to_bits(),
            (Value::Int(a), Value::Int(b)) => a == b,
            _ => false,
        };
        if !unchanged {
            self.journal.set(register, place, value);
        }
    }

    #[inline(never)]
    fn choose<A: Answers<S>>(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        answers: &mut A,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<usize, Halt> {
        let site = &r.f.sites[number.0 as usize];
        let drawn = self.choose_again(machine, state, answers, r, node, number, site)?;
        match self.after(r.f, site, drawn) {
            _ if self.tangled => Err(Halt::Impossible),
            After::Goto(next) => Ok(next as usize),
            _ => Ok(self.pc as usize + 1),
        }
    }

    #[inline(never)]
    fn factor(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<(), Halt> {
        self.score_again(machine, state, r, node, number, &r.f.sites[number.0 as usize])
    }

    #[inline(never)]
    fn suspend(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<After, Halt> {
        let after = self.carry_out(machine, state, r, node, number)?;
        if self.tangled { Err(Halt::Impossible) } else { Ok(after) }
    }

    fn clear(&mut self, machine: &Machine<'_, S>, state: &mut State<S>, node: NodeId, from: u16, to: u16) {
        for site in from..to {
            self.vacate(machine.program, state, node, site);
        }
    }

    fn give_back(
        &mut self,
        machine: &Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
        value: Value<S>,
    ) -> Onward {
        let next = self.return_to_caller(machine.program, state, node, value);
        if self.tangled { Onward::END } else { next }
    }

    fn end_iteration(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        exit: i64,
        carried: Args,
    ) -> Result<Onward, Fault> {
        let next = self.end_of_iteration(machine, state, r, node, exit, carried)?;
        Ok(if self.tangled { Onward::END } else { next })
    }

    #[inline]
    fn pass(
        &mut self,
        machine: &Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        arg: u16,
    ) -> After {
        self.pass_one(machine, state, r, node, number, arg)
    }

    fn done(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
    ) -> Result<Onward, Fault> {
        let next = self.leave_unchanged(machine, state, node)?;
        Ok(if self.tangled { Onward::END } else { next })
    }

    fn count(&mut self, instructions: u64) {
        self.counters.instructions += instructions;
    }
}

impl<S: Scalar> Trace<S> {
    /// Sums over the trace, without the open transaction.
    #[inline(always)]
    pub fn totals(&self) -> &Totals {
        &self.kept.totals
    }

    /// Work done since the trace began.
    pub fn counters(&self) -> Counters {
        self.kept.counters
    }

    /// What the program returned.
    pub fn result(&self) -> Value<S> {
        self.kept.resolved(&self.state, &self.kept.result)
    }

    /// The number of choices.
    pub fn len(&self) -> usize {
        self.kept.choices.len()
    }

    /// The first of the held choices that it does not have, with the open transaction.
    pub fn unmet(&self) -> Option<u32> {
        (0..).zip(&self.kept.met).find(|(_, met)| **met == 0).map(|(number, _)| number)
    }

    /// Whether it has no choice.
    pub fn is_empty(&self) -> bool {
        self.kept.choices.is_empty()
    }

    /// Bytes that the trace holds, without values.
    pub fn bytes(&self) -> usize {
        self.state.own_bytes() + self.kept.own_bytes()
    }

    /// From now on the steps of each run are noted.
    pub fn note_steps(&mut self) {
        self.kept.steps = Some(Vec::new());
    }

    /// The steps noted since the last call.
    pub fn take_steps(&mut self) -> Vec<Step> {
        self.kept.steps.replace(Vec::new()).unwrap_or_default()
    }
}
