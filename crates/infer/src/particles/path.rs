//! A whole run as a path that can be held: what it chose between one barrier and the next, order choices included,
//! so that a particle can take the same way, from its own past or from that of another.

use super::advance::Particle;
use super::settings::{Order, Settings};
use crate::Failure;
use crate::chooser::Proposal;
use crate::forward::factor_name;
use crate::log::Entry;
use crate::record::{Record, check_factor, log_density};
use crate::replay::by_address;
use crate::task::{Hosts, Task};
use niwaki_geom::Shape;
use niwaki_math::{Dist, Family, Stream};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::{Machine, Stop};
use niwaki_vm::value::{Value, same};
use std::collections::HashMap;

/// One thing that happened on the way.
#[derive(Clone, Debug)]
pub(super) enum Event {
    /// The future whose activation has this path ran.
    Ran(u128),
    /// A choice.
    Chose { address: u128, family: Family, value: Value },
}

/// What happened up to a barrier, or to the end of the run.
type Segment = Vec<Event>;

/// A run, cut at its barriers; the last segment goes to the end.
pub(super) struct Path {
    pub segments: Vec<Segment>,
}

/// Answers choices with what the path says, and notes or checks what happens.
struct Walk<'a> {
    record: &'a mut Record,
    hosts: &'a dyn Hosts,
    way: Way<'a>,
    /// Who would have drawn the choices, where their weights count.
    proposal: Option<&'a Proposal>,
    /// Log of prior over proposal of the choices, nats.
    log_ratio: f64,
}

enum Way<'a> {
    /// By the values of a whole run; what happens is noted.
    Note { values: &'a HashMap<u128, Value>, events: &'a mut Segment },
    /// By the events of a segment; `lost` once something else is asked, or has density zero.
    Follow { events: &'a [Event], next: usize, lost: bool },
}

impl Answers<f64> for Walk<'_> {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let asked = at.address();
        let (value, log) = match &mut self.way {
            Way::Note { values, events } => {
                let Some(value) = values.get(&asked).cloned() else {
                    let what = format!("there is no value for the choice `{}`", at.path());
                    return Err(Fault::new("missing-choice", what)
                        .with_help("start from a run of the same model with the same arguments"));
                };
                let log = log_density(dist, &value)?;
                events.push(Event::Chose { address: asked, family: dist.family(), value: value.clone() });
                (value, log)
            }
            Way::Follow { events, next, lost } => {
                let Some(Event::Chose { address, family, value }) = events.get(*next) else {
                    *lost = true;
                    return Ok(Answer::Pause);
                };
                let same = *address == asked && *family == dist.family();
                let log = if same { log_density(dist, value)? } else { f64::NEG_INFINITY };
                if log == f64::NEG_INFINITY {
                    *lost = true;
                    return Ok(Answer::Pause);
                }
                *next += 1;
                (value.clone(), log)
            }
        };
        if let Some(proposal) = self.proposal {
            self.log_ratio += proposal.log_drawn(at, dist, &value)?.map_or(0.0, |drawn| log - drawn);
        }
        self.record.choose(asked, &value, log);
        Ok(Answer::Go(value))
    }

    fn score(&mut self, at: &At<'_, f64>, factor: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.record.factor(check_factor(log)?, || factor_name(at, factor));
        Ok(Answer::Pause)
    }

    fn emit(&mut self, _: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        self.record.emit(shapes);
        Ok(Answer::Pause)
    }

    fn query(&mut self, _: &At<'_, f64>, _: &Value, _: &Value) -> Result<(), Fault> {
        Ok(())
    }

    fn host(&mut self, constant: u16, args: &[Value]) -> Result<Value, Fault> {
        self.hosts.call(constant, args)
    }
}

impl Path {
    /// The path of a run with these choices. Futures run in the order of its order choices; where there are none, in
    /// one drawn from `random` by the order policy.
    ///
    /// # Errors
    /// Choices of another model, a fault of the program.
    pub fn of(
        task: &Task,
        settings: &Settings,
        entries: &[Entry],
        random: &mut Stream,
    ) -> Result<Path, Failure> {
        let values = by_address(entries);
        let mut ran = entries.iter().filter(|e| e.is_order()).map(Entry::address);
        let mut machine = task.machine();
        let mut state = task.start(&machine, settings.order == Order::DepthFirst)?;
        let mut record = Record::start(&task.sketches);
        let mut segments: Vec<Segment> = vec![Vec::new()];
        while !state.has_ended() {
            let runnable = state.runnable();
            let future = match runnable.len() {
                0 => return Err(Box::new(machine.waiting_cycle(&state)).into()),
                1 => runnable[0],
                n => {
                    let known = ran.next().and_then(|path| find(&state, path));
                    known.unwrap_or_else(|| runnable[((random.uniform() * n as f64) as usize).min(n - 1)])
                }
            };
            let path = state.path_of(future);
            let Some(events) = segments.last_mut() else { unreachable!("there is a first segment") };
            events.push(Event::Ran(path));
            let way = Way::Note { values: &values, events };
            let hosts = &*task.hosts;
            let mut answers = Walk { record: &mut record, hosts, way, proposal: None, log_ratio: 0.0 };
            if machine.resume(&mut state, future, &mut answers)? == Stop::Paused {
                segments.push(Vec::new());
            }
        }
        Ok(Path { segments })
    }

    /// Its choices without order.
    fn choices(&self) -> impl Iterator<Item = (u128, &Value)> {
        self.segments.iter().flatten().filter_map(|event| match event {
            Event::Chose { address, value, .. } => Some((*address, value)),
            Event::Ran(_) => None,
        })
    }

    /// The share of its choices that `old` did not make.
    pub fn renewed(&self, old: &Path) -> f64 {
        let before: HashMap<u128, &Value> = old.choices().collect();
        let (mut all, mut new) = (0usize, 0usize);
        for (address, value) in self.choices() {
            all += 1;
            new += usize::from(!before.get(&address).is_some_and(|b| same(value, b)));
        }
        if all == 0 { 0.0 } else { new as f64 / all as f64 }
    }
}

fn find(state: &niwaki_vm::machine::state::State, path: u128) -> Option<niwaki_vm::machine::state::FutureId> {
    state.runnable().iter().copied().find(|future| state.path_of(*future) == path)
}

impl Particle {
    /// Takes the way of a segment, from wherever it is: to its next barrier, or to the end where the segment is the
    /// path's `last`. The log probability of its order choices; `None` where it cannot go that way, or not with
    /// density above zero (it is then of no further use). With a `proposal` its choices count as drawn by it.
    pub fn follow(
        &mut self,
        machine: &mut Machine<'_>,
        task: &Task,
        segment: &[Event],
        last: bool,
        proposal: Option<&Proposal>,
    ) -> Result<Option<f64>, Failure> {
        let (mut next, mut log_order) = (0, 0.0);
        while self.is_running() {
            let Some(Event::Ran(path)) = segment.get(next) else { return Ok(None) };
            let Some(future) = find(&self.state, *path) else { return Ok(None) };
            let n = self.state.runnable().len();
            if n > 1 {
                let which = self.state.runnable().iter().position(|f| *f == future).unwrap_or(0);
                self.record.log.push_order(*path, which);
                self.picks += 1;
                log_order -= (n as f64).ln();
            }
            let way = Way::Follow { events: segment, next: next + 1, lost: false };
            let (record, hosts) = (&mut self.record, &*task.hosts);
            let mut answers = Walk { record, hosts, way, proposal, log_ratio: self.pending };
            let stop = machine.resume(&mut self.state, future, &mut answers);
            self.pending = answers.log_ratio;
            let stop = match stop {
                Ok(stop) => stop,
                Err(met) => {
                    self.record.forgive(task, met)?;
                    return Ok(None);
                }
            };
            let Way::Follow { next: at, lost, .. } = answers.way else { unreachable!("it follows") };
            if lost {
                return Ok(None);
            }
            next = at;
            if stop == Stop::Paused {
                let arrived = next == segment.len() && !last && self.record.cause.is_none();
                return Ok(arrived.then_some(log_order));
            }
        }
        Ok((last && next == segment.len() && self.state.has_ended()).then_some(log_order))
    }
}
