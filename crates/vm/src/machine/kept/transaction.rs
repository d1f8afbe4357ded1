//! Transactions: choices change, the dependent parts run again, and everything is committed or undone.

use super::super::answers::{Answers, At};
use super::super::stack::RunFault;
use super::super::state::NodeId;
use super::super::workspace::Here;
use super::super::{Machine, Stop};
use super::slot::Slot;
use super::strategy::{Change, Step, Strategy, Totals};
use super::trace::{ChoiceAt, Kept, Trace};
use crate::code::Program;
use crate::fault::Fault;
use crate::value::{Value, identical, log_density};
use niwaki_geom::Primitive;
use niwaki_math::{Dist, Scalar, Total, grid};

/// A new value for a choice.
#[derive(Clone, Debug)]
pub struct Proposed<S: Scalar> {
    /// The value.
    pub value: Value<S>,
    /// The log density of proposing it from the old value, in nats.
    pub forward: f64,
    /// The log density of proposing the old value from it, in nats.
    pub backward: f64,
}

/// The proposer of a new value for a choice.
pub trait Propose<S: Scalar> {
    /// Whether the new value is drawn from the choice's own distribution: then its forward log density is its
    /// log density.
    const FROM_PRIOR: bool = false;

    /// Proposes a new value for a choice, from its distribution, its value and the log density of the value.
    ///
    /// # Errors
    /// A fault ends the run.
    fn propose(
        &mut self,
        at: &At<'_, S>,
        dist: &Dist<S>,
        old: &Value<S>,
        log_density: f64,
    ) -> Result<Proposed<S>, Fault>;
}

/// A changed choice: its number, and its new value.
#[derive(Clone, Debug)]
pub struct Changed<S: Scalar> {
    /// The number of the choice.
    pub choice: usize,
    /// Its new value.
    pub proposed: Proposed<S>,
}

impl<S: Scalar> Kept<S> {
    /// Opens a transaction.
    pub(super) fn open(&mut self) {
        debug_assert!(!self.open, "one transaction at a time");
        self.open = true;
        self.now = self.now.wrapping_add(1);
        self.outside = false;
    }

    /// Sets the switches of a run.
    pub(super) fn prepare(&mut self, strategy: Strategy) {
        self.early = strategy == Strategy::C3;
        self.reuse = strategy.reuses();
        self.depth = 0;
        self.returns.clear();
        self.active.clear();
        self.marking = false;
        self.woken.clear();
        self.woken_done = 0;
        (self.confined, self.tangled) = (false, false);
        self.memos.prepare();
    }

    /// The log densities of the proposal itself: of the changes, and of their reverse.
    fn proposal(&self) -> (f64, f64) {
        let sum = |of: fn(&(u32, f64, f64)) -> f64| self.changed.iter().map(of).sum::<f64>();
        (sum(|c| c.1), sum(|c| c.2))
    }

    /// Forgets the changes of the sums by the open transaction.
    #[inline(always)]
    fn clear_sums(&mut self) {
        self.change.log_prior.clear();
        self.change.log_factors.clear();
        self.change.factors = 0;
        self.fresh.clear();
        self.stale.clear();
    }

    /// Whether the open transaction may have changed the activations, the set of choices, or the scene.
    #[inline(always)]
    fn has_more(&self) -> bool {
        self.journal.has_more() || self.memos.has_changed()
    }

    /// Ends the transaction, committed or undone.
    #[inline(always)]
    fn close(&mut self) {
        for (at, ..) in self.changed.drain(..) {
            self.slots[at as usize].mark &= !Slot::CHANGED;
        }
        self.journal.clear();
        if self.result_before.is_some() {
            self.result_before = None;
        }
        self.open = false;
    }
}

impl<S: Scalar> Trace<S> {
    /// The changes of [`Trace::totals`] by the open transaction.
    #[inline(always)]
    pub fn change(&self) -> &Totals {
        &self.kept.change
    }

    /// The number of choices, with the open transaction.
    pub fn len_after(&self) -> usize {
        let more = &self.kept.journal.more;
        self.kept.choices.len() + more.births.len() - more.deaths.len()
    }

    /// The log densities of the choices that the open transaction drew, and of those that it removed, in nats.
    pub fn fresh_and_stale(&self) -> (&Total, &Total) {
        (&self.kept.fresh, &self.kept.stale)
    }

    /// The log densities of the open transaction's proposals, forward and reverse, in nats.
    pub fn forward_and_backward(&self) -> (f64, f64) {
        self.kept.proposal()
    }

    /// Replaces the log density of the reverse of the open transaction's only change, in nats: for proposals
    /// that know it only after the run.
    pub fn set_backward(&mut self, backward: f64) {
        if let [change] = &mut self.kept.changed[..] {
            change.2 = backward;
        }
    }

    /// Whether the value that was proposed last for a single choice is outside of the support of its
    /// distribution.
    pub fn left_support(&self) -> bool {
        self.kept.outside
    }

    /// The primitives that the open transaction added to the scene.
    pub fn emitted(&self) -> impl Iterator<Item = &Primitive> + Clone {
        self.kept.journal.more.emitted.iter().filter_map(|number| self.kept.emits[*number as usize].as_ref())
    }

    /// The primitives that the open transaction removed from the scene.
    pub fn retracted(&self) -> impl Iterator<Item = &Primitive> + Clone {
        self.kept
            .journal
            .more
            .retracted
            .iter()
            .filter_map(|number| self.kept.emits[*number as usize].as_ref())
    }

    /// Commits the open transaction. Removed choices leave the table last first, and added choices enter it in
    /// the order of their addresses, so that the table does not depend on the strategy.
    pub fn commit(&mut self, program: &Program<S>) {
        let kept = &mut self.kept;
        kept.totals.add(&kept.change);
        kept.clear_sums();
        if !kept.journal.moves.is_empty() {
            kept.move_readers();
        }
        if kept.has_more() {
            self.commit_more(program);
        }
        self.kept.close();
    }

    /// Commits changes of the activations, of the set of choices, or of the scene.
    #[inline(never)]
    fn commit_more(&mut self, program: &Program<S>) {
        let (state, kept) = (&mut self.state, &mut self.kept);
        kept.journal.more.deaths.sort_unstable();
        while let Some(dead) = kept.journal.more.deaths.pop() {
            kept.choices.swap_remove(dead as usize);
            if let Some(moved) = kept.choices.get(dead as usize).copied() {
                let at = Kept::slot_at(state, moved.node, moved.site as usize);
                kept.slots[at].held = dead;
            }
        }
        kept.journal.more.births.sort_unstable_by_key(|birth| birth.address);
        for i in 0..kept.journal.more.births.len() {
            let birth = kept.journal.more.births[i];
            let at = Kept::slot_at(state, birth.node, birth.site as usize);
            kept.slots[at].held = kept.choices.len() as u32;
            kept.choices.push(ChoiceAt { node: birth.node, site: birth.site });
        }
        while let Some(id) = kept.journal.more.removed.pop() {
            kept.release(program, state, id);
        }
        kept.memos.commit();
        while let Some(number) = kept.journal.more.retracted.pop() {
            kept.emits[number as usize] = None;
            kept.free_emits.push(number);
        }
        while let Some(id) = kept.journal.more.dead_cells.pop() {
            debug_assert!(kept.readers[id as usize].all.is_empty(), "a removed cell has no readers");
            kept.free_readers.push(id);
        }
    }

    /// Undoes the open transaction: the trace is as before, bit for bit.
    pub fn rollback(&mut self, program: &Program<S>) {
        self.undo(program);
        self.kept.close();
    }

    /// Undoes the changes, and leaves the transaction open.
    fn undo(&mut self, program: &Program<S>) {
        let (state, kept) = (&mut self.state, &mut self.kept);
        while let Some((reader, held)) = kept.journal.moves.pop() {
            let slot = &mut kept.slots[reader.slot as usize];
            (slot.held, slot.mark) = (held, slot.mark & !Slot::MOVING);
        }
        while let Some((reader, held)) = kept.journal.reads.pop() {
            kept.subscribe(reader, held);
        }
        while let Some((place, old)) = kept.journal.registers.pop() {
            state.registers[place as usize].store(old);
        }
        while let Some((at, old)) = kept.journal.slots.pop() {
            kept.slots[at as usize] = old;
        }
        if kept.has_more() {
            self.undo_more(program);
        }
        let kept = &mut self.kept;
        kept.clear_sums();
        if let Some(result) = kept.result_before.take() {
            kept.result = result;
        }
        kept.journal.clear();
    }

    /// Undoes changes of the activations, of the set of choices, or of the scene.
    #[inline(never)]
    fn undo_more(&mut self, program: &Program<S>) {
        let (state, kept) = (&mut self.state, &mut self.kept);
        while let Some((id, end)) = kept.journal.more.ends.pop() {
            state.nodes[id.0 as usize].pc = end;
        }
        while let Some(cut) = kept.journal.more.loops.pop() {
            let children = &mut kept.loops[cut.number as usize];
            children.truncate(cut.len as usize);
            children.extend(cut.removed);
        }
        kept.memos.undo(state);
        while let Some(id) = kept.journal.more.created.pop() {
            kept.release(program, state, id);
        }
        while let Some(number) = kept.journal.more.emitted.pop() {
            kept.emits[number as usize] = None;
            kept.free_emits.push(number);
        }
        while let Some(id) = kept.journal.more.cells.pop() {
            kept.free_readers.push(id);
        }
        while let Some((number, change)) = kept.journal.more.met.pop() {
            kept.count_held(number, -change);
        }
    }
}

impl<S: Scalar> Machine<'_, S> {
    /// Changes a choice to its proposed value, and runs. The transaction is open afterwards.
    ///
    /// # Errors
    /// A fault of the program or of the proposer.
    pub fn propose<A: Answers<S>, P: Propose<S>>(
        &mut self,
        trace: &mut Trace<S>,
        choice: usize,
        strategy: Strategy,
        proposer: &mut P,
        answers: &mut A,
    ) -> Result<Change, Box<RunFault>> {
        let ChoiceAt { node, site: number } = trace.kept.choices[choice];
        let (state, kept) = (&mut trace.state, &mut trace.kept);
        kept.open();
        let program = self.program;
        let f = program.function(state.nodes[node.0 as usize].function);
        let site = &f.sites[number as usize];
        let at = Kept::slot_at(state, node, number as usize);
        let (base, outer) = self.bases(state, f, node);
        let place = base + site.to.index();
        let r = super::Registers { f, base, outer, scratch: 0 };
        let mut built = None;
        let proposal = self.dist(state, r, site, site.parameters(), &mut built).and_then(|dist| {
            let (question, old) = (At { site, function: f, node, state, program }, &state.registers[place]);
            let proposed = proposer.propose(&question, dist, old, kept.slots[at].log)?;
            let log = if P::FROM_PRIOR {
                proposed.forward
            } else {
                grid(log_density(dist, &proposed.value)?.value())
            };
            Ok((proposed, log))
        });
        let (proposed, log) = match proposal {
            Ok(pair) => pair,
            Err(fault) => {
                self.here = Here {
                    node,
                    function: state.nodes[node.0 as usize].function,
                    pc: site.next as usize - 1,
                    scratch: 0,
                };
                return Err(Box::new(self.report(state, fault)));
            }
        };
        if identical(&proposed.value, &state.registers[place]) {
            return Ok(Change::Unchanged);
        }
        let at_choice = strategy.starts_at_choice() && !kept.is_memoised(state, node);
        kept.prepare(match strategy {
            _ if at_choice => strategy,
            _ if strategy.reuses() => Strategy::Cache,
            _ => Strategy::Rerun,
        });
        kept.changed.push((at as u32, proposed.forward, proposed.backward));
        kept.slots[at].mark |= Slot::CHANGED;
        let value = proposed.value;
        kept.write_to(state, false, place, value.clone());
        kept.outside = log == f64::NEG_INFINITY;
        if kept.outside {
            return Ok(Change::Impossible);
        }
        if at_choice {
            kept.set_log(false, at, log, true);
            let next = if strategy == Strategy::C3 { site.again } else { site.next } as usize;
            let change = self.run_kept(trace, node, next, answers);
            if trace.kept.woken.is_empty() {
                return Ok(trace.kept.with_all_held(change?));
            }
            if let (Ok(Change::Done), false) = (&change, trace.kept.tangled)
                && let Some(change) = self.run_readers(trace, answers)?
            {
                return Ok(trace.kept.with_all_held(change));
            }
            // The run is repeated in program order: out of that order, a fault or a score of minus infinity may
            // not be real.
            trace.undo(program);
            trace.kept.prepare(Strategy::Cache);
            trace.kept.slots[at].mark |= Slot::CHANGED;
            trace.kept.write_to(&mut trace.state, false, place, value);
        }
        trace.kept.mark_above(&trace.state, node);
        self.run_to_end(trace, answers)
    }

    /// Changes many choices at once, and runs from the root. The run reaches the changed choices in program
    /// order, and skips calls without them if the strategy skips calls.
    ///
    /// # Errors
    /// A fault of the program.
    pub fn change<A: Answers<S>>(
        &mut self,
        trace: &mut Trace<S>,
        changes: Vec<Changed<S>>,
        strategy: Strategy,
        answers: &mut A,
    ) -> Result<Change, Box<RunFault>> {
        let (state, kept) = (&mut trace.state, &mut trace.kept);
        kept.open();
        kept.prepare(if strategy.reuses() { Strategy::Cache } else { Strategy::Rerun });
        let mut has_changed = false;
        for Changed { choice, proposed } in changes {
            let ChoiceAt { node, site } = kept.choices[choice];
            let n = &state.nodes[node.0 as usize];
            let to = self.program.function(n.function).sites[site as usize].to;
            let (place, at) = (n.registers as usize + to.index(), n.slots as usize + site as usize);
            kept.changed.push((at as u32, proposed.forward, proposed.backward));
            if kept.write_to(state, false, place, proposed.value) {
                has_changed = true;
                kept.slots[at].mark |= Slot::CHANGED;
                kept.mark_above(state, node);
            }
        }
        if !has_changed {
            return Ok(Change::Unchanged);
        }
        self.run_to_end(trace, answers)
    }

    /// Runs from the root to the end.
    pub(super) fn run_to_end<A: Answers<S>>(
        &mut self,
        trace: &mut Trace<S>,
        answers: &mut A,
    ) -> Result<Change, Box<RunFault>> {
        let change = self.run_kept(trace, NodeId(0), 0, answers)?;
        Ok(trace.kept.with_all_held(change))
    }

    /// Continues from an instruction of a node.
    pub(super) fn run_kept<A: Answers<S>>(
        &mut self,
        trace: &mut Trace<S>,
        node: NodeId,
        pc: usize,
        answers: &mut A,
    ) -> Result<Change, Box<RunFault>> {
        self.empty_scratch();
        let (state, kept) = (&mut trace.state, &mut trace.kept);
        state.steps = 0;
        self.set_ceiling(state);
        self.set_alarm(state);
        if state.bytes() > state.ceiling {
            state.alarm = 0;
        }
        kept.counters.entered += 1;
        kept.note(Step::Entered(node));
        let stop = self.interpret(state, kept, super::super::state::FutureId(0), (node, pc), answers);
        match stop.and_then(|stop| self.take_steps(state.steps).map(|()| stop)) {
            Ok(Stop::Impossible) => Ok(Change::Impossible),
            Ok(_) => {
                if !trace.kept.tangled {
                    trace.kept.remove_unread(self.program, &mut trace.state);
                }
                Ok(Change::Done)
            }
            Err(fault) => Err(Box::new(self.report(state, fault))),
        }
    }
}

impl<S: Scalar> Kept<S> {
    /// Marks a node and the nodes above it, which a run from the root must enter. All readers of a memoised
    /// call are above it.
    pub(super) fn mark_above(&mut self, state: &super::super::state::State<S>, node: NodeId) {
        self.marking = true;
        if self.marks.len() < state.nodes.len() {
            self.marks.resize(state.nodes.len(), 0);
        }
        let (mut work, mut next) = (Vec::new(), Some(node));
        while let Some(mut at) = next {
            while at != NodeId::NONE && self.marks[at.0 as usize] != self.now {
                self.marks[at.0 as usize] = self.now;
                let n = &state.nodes[at.0 as usize];
                if let Some(number) = n.memo() {
                    work.extend(self.memos.readers(number));
                    break;
                }
                at = n.parent;
            }
            next = work.pop();
        }
    }
}
