//! Choices, factors, emits and queries of kept activations, reached for the first time or again.

use super::super::Machine;
use super::super::address::join;
use super::super::answers::{Answer, Answers, At};
use super::super::budget;
use super::super::buffers::make_room;
use super::super::memo::memoised;
use super::super::outcome::Continuation;
use super::super::outcome::Halt;
use super::super::question::as_real;
use super::super::registers::Registers;
use super::super::state::{NodeId, State};
use super::journal::Birth;
use super::readers::Reader;
use super::slot::Slot;
use super::trace::{ChoiceAt, Kept};
use crate::code::{Operand, Site, SiteId, SiteKind, Source};
use crate::fault::Fault;
use crate::value::{Value, identical, log_density, ops};
use niwaki_geom::{Primitive, Shape};
use niwaki_math::{Dist, Family, Scalar, grid};

/// Whether a kept value is possible under a distribution: vectors have the right number of components and
/// counts the right sum. The value of a delta is always drawn again.
#[inline]
pub fn fits<S: Scalar>(dist: &Dist<S>, value: &Value<S>) -> bool {
    match value {
        Value::Real(_) | Value::Int(_) | Value::Bool(_) => !matches!(dist, Dist::Delta(_)),
        // Counts with another number of trials are impossible: if they were kept, they would keep that number
        // for ever.
        other => match dist {
            Dist::Multinomial(m) => {
                let counts = other.draw().and_then(|draw| draw.as_counts());
                counts.is_some_and(|all| all.len() == m.len() && all.iter().sum::<i64>() == m.n)
            }
            _ => dist.dimension().is_none_or(|n| crate::value::iter_len(other).is_ok_and(|len| len == n)),
        },
    }
}

/// Checks that a log density or factor is a number below plus infinity (a density may be infinite at a point).
#[inline(always)]
fn check(log: f64, quantity: &str) -> Result<f64, Fault> {
    if log < f64::INFINITY { Ok(grid(log)) } else { Err(no_score(log, quantity)) }
}

#[cold]
#[inline(never)]
fn no_score(log: f64, quantity: &str) -> Fault {
    Fault::new("non-finite-score", format!("{quantity} of {log} nats"))
        .with_help("a log factor is a finite number, or minus infinity for an impossible run")
}

/// The log density of a number under a family with two parameters, without building the distribution. `None` if
/// the operands are not numbers, or if the distribution must be built.
#[inline(always)]
fn number_log_density<S: Scalar>(
    machine: &mut Machine<'_, S>,
    state: &State<S>,
    r: Registers<'_, S>,
    family: Family,
    (a, b): (Operand, Operand),
    x: S,
) -> Option<f64> {
    let Value::Real(a) = *r.get(state, &machine.scratch, a) else { return None };
    let Value::Real(b) = *r.get(state, &machine.scratch, b) else { return None };
    Some(Dist::log_density_of_reals(family, a, b, x, &mut machine.logs)?.value())
}

/// [`number_log_density`] for an observation whose value is not read.
#[inline(always)]
fn observed_number<S: Scalar>(
    machine: &mut Machine<'_, S>,
    state: &State<S>,
    r: Registers<'_, S>,
    site: &Site,
) -> Option<f64> {
    let (SiteKind::Observe(Source::Family(family)), false, [a, b, x]) =
        (&site.kind, site.is_read, &r.f.operands[site.args.range()])
    else {
        return None;
    };
    let Value::Real(x) = *r.get(state, &machine.scratch, *x) else { return None };
    number_log_density(machine, state, r, *family, (*a, *b), x)
}

/// Bytes of an added choice: its place in the table, and its record in the journal.
const CHOICE_BYTES: usize = 2 * size_of::<ChoiceAt>() + size_of::<Birth>();

impl<S: Scalar> Kept<S> {
    /// Sets the log of a filled slot and updates the sums.
    #[inline(always)]
    pub(super) fn set_log(&mut self, node_is_new: bool, at: usize, log: f64, prior: bool) {
        let old = self.slots[at];
        if !node_is_new {
            self.journal.slots.push((at as u32, old));
        }
        self.slots[at].log = log;
        let total = if prior { &mut self.change.log_prior } else { &mut self.change.log_factors };
        total.replace(old.log, log);
    }

    /// Runs a site that is neither a choice nor a factor.
    #[inline(always)]
    pub(super) fn run_site(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
    ) -> Result<Continuation, Halt> {
        let site = &r.f.sites[number.0 as usize];
        match &site.kind {
            SiteKind::Call { function } | SiteKind::Future { function, .. } => {
                self.call_known(machine, state, r, node, number, site, *function)
            }
            SiteKind::Apply | SiteKind::FutureApply { .. } => {
                self.apply(machine, state, r, node, number, site)
            }
            SiteKind::Loop(l) => Ok(self.begin_loop(machine, state, r, node, number, site, l)?),
            SiteKind::Query => {
                let key = r.get(state, &machine.scratch, r.f.operands[site.args.start as usize]);
                key.refuse_futures("the key of a query")?;
                key.refuse_as_key()?;
                let at = Kept::slot_at(state, node, number.0 as usize);
                if !self.slots[at].is_filled() {
                    self.write_slot(self.quiet, at, Slot { held: 0, mark: 0, log: 0.0 });
                }
                Ok(Continuation::Next)
            }
            SiteKind::Memoise { of } => {
                let function = r.get(state, &machine.scratch, r.f.operands[site.args.start as usize]);
                let value = memoised(state, machine.program, node, site, *of, function)?;
                self.write_to(state, self.quiet, r.base + site.to.index(), value);
                Ok(Continuation::Next)
            }
            SiteKind::Cell { content } => {
                let at = Kept::slot_at(state, node, number.0 as usize);
                self.cell(state, &machine.scratch, r, at, site, *content);
                Ok(Continuation::Next)
            }
            SiteKind::Append { content } => {
                let at = Kept::slot_at(state, node, number.0 as usize);
                self.append(state, &machine.scratch, r, at, site, *content)?;
                Ok(Continuation::Next)
            }
            SiteKind::Read => {
                self.read(state, &machine.scratch, r, node, number.0, site)?;
                Ok(Continuation::Next)
            }
            SiteKind::Force => {
                let value = match r.get(state, &machine.scratch, r.f.operands[site.args.start as usize]) {
                    Value::Returned(value) => value.items()[0].clone(),
                    other => other.clone(),
                };
                self.write_to(state, self.quiet, r.base + site.to.index(), value);
                Ok(Continuation::Next)
            }
            SiteKind::Emit => {
                machine.collect_shapes(state, r, site)?;
                let at = Kept::slot_at(state, node, number.0 as usize);
                state.charged += 64 + machine.shapes.len() * size_of::<Shape>();
                self.emit(at, &machine.shapes);
                Ok(Continuation::Next)
            }
            SiteKind::Sample(_) | SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                unreachable!("choices and factors have functions of their own")
            }
        }
    }

    /// Runs a choice. It keeps its value if family and dimension are unchanged, and is scored again. Otherwise
    /// it is drawn, and the result is `true`.
    #[allow(clippy::too_many_arguments)] // the registers of the loop in `interpret`, by value
    #[inline(always)]
    pub(super) fn choose_again<A: Answers<S>>(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        answers: &mut A,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
    ) -> Result<bool, Halt> {
        let (place, at) = (r.base + site.to.index(), Kept::slot_at(state, node, number.0 as usize));
        let program = machine.program;
        let slot = self.slots[at];
        if let SiteKind::Sample(Source::Family(family)) = site.kind
            && slot.is_filled()
            && slot.mark & Slot::FAMILY == family as u32
            && let Value::Real(x) = state.registers[place]
            && let [a, b] = &r.f.operands[site.args.range()]
            && let Some(log) = number_log_density(machine, state, r, family, (*a, *b), x)
            && let log = check(log, "a log density")?
            && log > f64::NEG_INFINITY
        {
            if log.to_bits() != slot.log.to_bits() {
                self.set_log(self.quiet, at, log, true);
            }
            return Ok(false);
        }
        if let SiteKind::Sample(Source::Family(family)) = site.kind {
            machine.charge_rows(state, self, r, site.parameters(), family)?;
        }
        let mut built = None;
        let held = machine.held;
        let dist = machine.dist(state, r, site, site.parameters(), &mut built)?;
        if let Some(held) = held
            && (!slot.is_filled() || slot.is_held())
            && let Some((number, value)) = held.find(join(state.nodes[node.0 as usize].path, site.key))
        {
            let value = At { site, function: r.f, node, state, program }.own_value(value)?.into_owned();
            let log = check(log_density(dist, &value)?.value(), "a log density")?;
            // A held word has another number where the options have another order.
            let is_moved = slot.is_filled() && !identical(&value, &state.registers[place]);
            let is_new = !slot.is_filled();
            if is_new {
                self.journal.more().met.push((number, 1));
                self.count_held(number, 1);
                self.change.factors += 1;
                self.change.log_factors.add(log);
                self.write_slot(self.quiet, at, Slot { held: number, mark: Slot::HELD, log });
            } else if log.to_bits() != slot.log.to_bits() {
                self.set_log(self.quiet, at, log, false);
            }
            if is_new || is_moved {
                self.write_to(state, self.quiet, place, value);
            }
            return if log == f64::NEG_INFINITY { Err(Halt::Impossible) } else { Ok(is_new || is_moved) };
        }
        let family = dist.family() as u32;
        if slot.is_filled() && slot.mark & Slot::FAMILY == family && fits(dist, &state.registers[place]) {
            let log = check(log_density(dist, &state.registers[place])?.value(), "a log density")?;
            if log.to_bits() != slot.log.to_bits() {
                self.set_log(self.quiet, at, log, true);
            }
            return if log > f64::NEG_INFINITY { Ok(false) } else { Err(Halt::Impossible) };
        }
        self.leaves_its_activation();
        let question = At { site, function: r.f, node, state, program };
        let address = question.address();
        let Answer::Go(value) = answers.choice(&question, dist)? else { return Err(Halt::Paused) };
        let log = check(log_density(dist, &value)?.value(), "a log density")?;
        let held = if slot.is_filled() {
            // The choice is drawn again: the old value counts as removed, the new value as added at the same
            // place in the table.
            self.stale.add(slot.log);
            self.forget_change(at);
            self.change.log_prior.remove(slot.log);
            self.journal.more().anew.push((address, state.registers[place].clone()));
            slot.held
        } else {
            make_room(&mut self.journal.more().births, 1, || state.ceiling.saturating_sub(state.bytes()));
            self.journal.more().births.push(Birth { address, node, site: number.0 });
            Slot::BORN | (self.journal.more.births.len() as u32 - 1)
        };
        let is_plain = value.is_plain();
        state.charged += CHOICE_BYTES + budget::of_result(&value);
        self.fresh.add(log);
        self.change.log_prior.add(log);
        self.write_slot(self.quiet, at, Slot { held, mark: family, log });
        self.write_to(state, self.quiet, place, value);
        if !is_plain {
            machine.afford(state, self)?;
        }
        if log == f64::NEG_INFINITY { Err(Halt::Impossible) } else { Ok(true) }
    }

    /// Runs a factor.
    #[inline(always)]
    pub(super) fn score_again(
        &mut self,
        machine: &mut Machine<'_, S>,
        state: &mut State<S>,
        r: Registers<'_, S>,
        node: NodeId,
        number: SiteId,
        site: &Site,
    ) -> Result<(), Halt> {
        let last = site.args.len as usize - 1;
        let operand = r.f.operands[site.args.start as usize + last];
        let log = match site.kind {
            SiteKind::Factor => as_real(r.get(state, &machine.scratch, operand))?.value(),
            SiteKind::Condition => {
                if ops::truth(r.get(state, &machine.scratch, operand))? {
                    0.0
                } else {
                    f64::NEG_INFINITY
                }
            }
            _ => match observed_number(machine, state, r, site) {
                Some(log) => log,
                None => {
                    let mut built = None;
                    let args = site.parameters();
                    let value = r.get(state, &machine.scratch, operand).clone();
                    if let SiteKind::Observe(Source::Family(family)) = site.kind {
                        machine.charge_rows(state, self, r, args, family)?;
                    }
                    let dist = machine.dist(state, r, site, args, &mut built)?;
                    let log = log_density(dist, &value)?.value();
                    if site.is_read {
                        self.write_to(state, self.quiet, r.base + site.to.index(), value);
                    }
                    log
                }
            },
        };
        let log = check(log, "a factor")?;
        let at = Kept::slot_at(state, node, number.0 as usize);
        let slot = self.slots[at];
        if !slot.is_filled() {
            self.change.factors += 1;
            self.change.log_factors.add(log);
            self.write_slot(self.quiet, at, Slot { held: 0, mark: 0, log });
        } else if log.to_bits() != slot.log.to_bits() {
            self.set_log(self.quiet, at, log, false);
        }
        if log == f64::NEG_INFINITY { Err(Halt::Impossible) } else { Ok(()) }
    }

    fn emit(&mut self, at: usize, shapes: &[Shape]) {
        let slot = self.slots[at];
        if slot.is_filled() {
            let unchanged = self.emits[slot.held as usize].as_ref().is_some_and(|p| {
                p.shapes().len() == shapes.len()
                    && p.shapes()
                        .iter()
                        .zip(shapes)
                        .all(|(a, b)| identical::<S>(&Value::Shape(a.clone()), &Value::Shape(b.clone())))
            });
            if unchanged {
                return;
            }
            self.journal.more().retracted.push(slot.held);
        }
        let primitive = Some(Primitive::new(shapes));
        let number = match self.free_emits.pop() {
            Some(number) => {
                self.emits[number as usize] = primitive;
                number
            }
            None => {
                self.emits.push(primitive);
                self.emits.len() as u32 - 1
            }
        };
        self.journal.more().emitted.push(number);
        self.write_slot(self.quiet, at, Slot { held: number, mark: 0, log: 0.0 });
    }

    /// Removes a changed choice that is no longer reached from the proposal: its change does not count in the
    /// move.
    fn forget_change(&mut self, at: usize) {
        if self.slots[at].mark & Slot::CHANGED != 0
            && let Some(change) = self.changed.iter_mut().find(|c| c.0 as usize == at)
        {
            (change.1, change.2) = (0.0, 0.0);
        }
    }

    /// Removes the contents of a question's slot.
    pub(super) fn withdraw(&mut self, kind: &SiteKind, at: usize, node: NodeId, site: u16) {
        let slot = self.slots[at];
        self.leaves_its_activation();
        match kind {
            SiteKind::Sample(_) if slot.is_held() => {
                self.journal.more().met.push((slot.held, -1));
                self.count_held(slot.held, -1);
                self.change.factors -= 1;
                self.change.log_factors.remove(slot.log);
            }
            SiteKind::Sample(_) => {
                debug_assert!(slot.held & Slot::BORN == 0, "a site runs once in a transaction");
                self.stale.add(slot.log);
                self.forget_change(at);
                self.change.log_prior.remove(slot.log);
                self.journal.more().deaths.push(slot.held);
            }
            SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                self.change.factors -= 1;
                self.change.log_factors.remove(slot.log);
            }
            SiteKind::Emit => self.journal.more().retracted.push(slot.held),
            SiteKind::Cell { .. } | SiteKind::Append { .. } => self.journal.more().dead_cells.push(slot.held),
            SiteKind::Read => {
                self.move_readers();
                let reader = Reader { node, site, slot: at as u32 };
                self.journal.reads.push((reader, slot.held));
                self.subscribe(reader, Slot::NOTHING);
            }
            _ => {}
        }
    }
}
