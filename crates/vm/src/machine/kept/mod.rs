//! Kept activations: a trace that runs again only where a choice changed.
//!
//! Every activation that can suspend stays as a node after it has returned, with one slot for each of its
//! sites. A *transaction* changes choices and runs on from them: [`Machine::begin`], [`Machine::propose`] or
//! [`Machine::change`], then [`Trace::commit`] or [`Trace::rollback`]. Two switches make four strategies
//! ([`Strategy`]), which differ only in what they skip.
//!
//! * `trace`: the parts of a trace; `strategy`: the strategies, and the outcomes of a run;
//! * `begin`: the first run; `slot`, `journal`: the memory of each site, and the changes that can be undone;
//! * `questions`: choices, factors, emits and queries that are reached again;
//! * `calls`, `loops`: activations that are entered, skipped, created and removed; `adapt`: calls where reuse
//!   does not pay;
//! * `memo`: memoised calls, which have several callers;
//! * `slices`: activations that are entered for one change only, and run only the instructions that depend on
//!   it;
//! * `cells`: elements of collections, and their readers;
//! * `transaction`: changes of choices, and their commit or rollback; `changes`: their effects on the choices;
//! * `ahead`: memory that the next proposal will need; `arrange`: the restoration of the choices' numbers;
//! * [`inspect`]: the contents of a trace, in program order; [`part`]: parts that can run separately; `scene`:
//!   the primitives of a part.
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
mod entry;
pub mod inspect;
mod journal;
pub mod levels;
mod loops;
mod memo;
pub mod part;
mod questions;
mod readers;
mod scene;
mod slices;
mod slot;
mod strategy;
mod trace;
mod transaction;

pub use adapt::Adaptation;
pub use questions::fits;
pub use strategy::{Change, Counters, Step, Strategy, Totals};
pub use trace::Trace;
pub use transaction::{Changed, Propose, Proposed};

pub(crate) use trace::Kept;

use super::Machine;
use super::answers::Answers;
use super::keep::{Keep, Target};
use super::outcome::{Continuation, Halt};
use super::registers::Registers;
use super::state::{NodeId, State};
use crate::code::{Args, SiteId};
use crate::fault::Fault;
use crate::value::{Census, Value};
use niwaki_math::Scalar;

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
            Continuation::Goto(next) => Ok(next as usize),
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
    ) -> Result<Continuation, Halt> {
        let after = self.run_site(machine, state, r, node, number)?;
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
    ) -> Target {
        let next = self.return_to_caller(machine.program, state, node, value);
        if self.tangled { Target::END } else { next }
    }

    fn end_iteration(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        exit: i64,
        carried: Args,
    ) -> Result<Target, Fault> {
        let next = self.end_of_iteration(machine, state, r, node, exit, carried)?;
        Ok(if self.tangled { Target::END } else { next })
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
    ) -> Continuation {
        self.pass_argument(machine, state, r, node, number, arg)
    }

    fn done(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        node: NodeId,
    ) -> Result<Target, Fault> {
        let next = self.leave_unchanged(machine, state, node)?;
        Ok(if self.tangled { Target::END } else { next })
    }

    fn count(&mut self, instructions: u64) {
        self.counters.instructions += instructions;
    }
}

impl<S: Scalar> Trace<S> {
    /// The sums over the trace, without the open transaction.
    #[inline(always)]
    pub fn totals(&self) -> &Totals {
        &self.kept.totals
    }

    /// The work done since the trace began.
    pub fn counters(&self) -> Counters {
        self.kept.counters
    }

    /// The value that the program returned.
    pub fn result(&self) -> Value<S> {
        self.kept.resolved(&self.state, &self.kept.result)
    }

    /// The number of choices.
    pub fn len(&self) -> usize {
        self.kept.choices.len()
    }

    /// The first held choice that the trace does not have, with the open transaction.
    pub fn unmet(&self) -> Option<u32> {
        (0..).zip(&self.kept.met).find(|(_, met)| **met == 0).map(|(number, _)| number)
    }

    /// Whether the trace has no choice.
    pub fn is_empty(&self) -> bool {
        self.kept.choices.is_empty()
    }

    /// Bytes of the trace, without values.
    pub fn bytes(&self) -> usize {
        self.state.own_bytes() + self.kept.own_bytes()
    }

    /// Lets the trace record the steps of each run.
    pub fn note_steps(&mut self) {
        self.kept.steps = Some(Vec::new());
    }

    /// The steps recorded since the last call.
    pub fn take_steps(&mut self) -> Vec<Step> {
        self.kept.steps.replace(Vec::new()).unwrap_or_default()
    }
}
