//! Partial runs: the choices and barriers of a run up to a barrier or to its end. A partial run can be rerun by another particle or
//! with other values.
//!
//! Other values must not change the *skeleton*: which futures could run at each pick, the address of each
//! barrier, and where each future is suspended at the end. Under one skeleton the order policy gives equal order choices
//! equal probability: one over the number of futures that can run, or the probability of a learned policy, pick by pick.
//! So the probability cancels in a ratio. A learned policy whose weights of the futures at a pick differ to the bit has
//! another skeleton there.

use niwaki_geom::{Primitive, Shape};
use niwaki_math::{Dist, Family, StreamKey, Total, grid};
use niwaki_propose::guide::bound::Sight;
use niwaki_propose::look_ahead::LookAhead;
use niwaki_propose::particle::{Particle, Turn};
use niwaki_propose::proposal::{Proposal, as_if_drawn};
use niwaki_run::chooser::{Chooser, Chosen, Context, Known, Prior, Refuse};
use niwaki_run::log::{Entry, Log};
use niwaki_run::order::{Order, Past};
use niwaki_run::record::check_factor;
use niwaki_run::replay::{by_address, picks, place};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::address::join;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::kept::{Proposed, fits};
use niwaki_vm::machine::state::{FutureId, State};
use niwaki_vm::machine::{Machine, Stop};
use niwaki_vm::value::{Value, identical};
use std::collections::HashMap;

/// A choice.
#[derive(Clone, Debug)]
pub(crate) struct Choice {
    pub address: u128,
    pub value: Value,
    pub family: Family,
    /// Log density, nats, on its grid.
    pub log: f64,
    /// The key of its site.
    pub site: u128,
    /// Its selection weight for each leaf of the kernel that does not take all choices alike.
    pub weights: Box<[u64]>,
}

/// A step of a run.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// A future ran: its path; where several could, its place among them and a hash of their paths.
    Ran {
        path: u128,
        pick: Option<(usize, u128)>,
    },
    Chose(Choice),
    /// A barrier: its address, the primitive of an `emit`, and whether it differs from the run before.
    Met {
        address: u128,
        primitive: Option<Primitive>,
        changed: bool,
    },
}

/// A run up to a barrier, or to its end.
pub(super) struct PartialRun {
    steps: Vec<Step>,
    pub log_prior: Total,
    pub log_factors: Total,
    /// The state of the machine.
    pub state: State,
}

/// The settings of a rerun.
#[derive(Clone, Copy)]
pub(super) struct FollowSettings<'a> {
    pub task: &'a Task,
    pub order: &'a Order,
    /// Whether addresses are to be readable from the root.
    pub origins: bool,
    /// The selection weights of a choice.
    pub weigh: &'a dyn Fn(&At<'_, f64>) -> Box<[u64]>,
}

/// Log densities that a move counts, nats.
pub(super) struct Densities {
    pub fresh: Total,
    pub stale: Total,
    pub forward: f64,
    pub backward: f64,
}

impl PartialRun {
    /// Rerun the choices of a log, to the `barriers`-th barrier or to the end. Futures run in the order of the log's
    /// order choices; where one is missing, the order policy picks one by a number between 0 and 1 from `draw`. `None` where
    /// the run is impossible.
    ///
    /// # Errors
    /// Choices of another model, a fault of the program.
    pub fn of(
        with: FollowSettings<'_>,
        machine: &mut Machine<'_>,
        entries: &[Entry],
        barriers: usize,
        draw: &mut dyn FnMut() -> f64,
    ) -> Result<Option<PartialRun>, Failure> {
        let values = by_address(entries);
        let fallback = Refuse("start from a run of the same model with the same arguments");
        let mut chooser = Known { values: Some(&values), fallback };
        let mut next = picks(entries);
        let mut pick = |state: &State, past: &Past| next(state).unwrap_or_else(|| past.pick(state, draw()));
        PartialRun::run(with, machine, &mut chooser, None, &mut pick, barriers)
    }

    /// Rerun with the values that `propose` gives; new choices are drawn from `fresh`. `None` if the rerun has a different skeleton or is
    /// impossible.
    ///
    /// # Errors
    /// A fault of the program or of `propose`.
    pub fn again(
        &self,
        with: FollowSettings<'_>,
        machine: &mut Machine<'_>,
        propose: impl FnMut(&At<'_, f64>, &Choice, &Dist) -> Result<Option<Proposed<f64>>, Fault>,
        fresh: StreamKey,
    ) -> Result<Option<(PartialRun, Densities)>, Failure> {
        let (fresh_sum, stale) = (Total::default(), self.log_prior.clone());
        let densities = Densities { fresh: fresh_sum, stale, forward: 0.0, backward: 0.0 };
        let mut chooser = Changed { before: self, at: 0, propose, fresh: Prior(fresh), densities };
        let barriers = self.steps.iter().filter(|step| step.is_barrier()).count();
        match PartialRun::run(with, machine, &mut chooser, Some(self), &mut |_, _| 0, barriers) {
            Ok(next) => {
                let next = next.filter(|next| next.state.suspension_hash() == self.state.suspension_hash());
                Ok(next.map(|next| (next, chooser.densities)))
            }
            Err(Failure::Run(met)) if with.task.invalid.count(&met).is_some() => Ok(None),
            Err(other) => Err(other),
        }
    }

    /// Run from the start to the `barriers`-th barrier or to the end. With `before`, the run must have the skeleton of `before`.
    fn run(
        with: FollowSettings<'_>,
        machine: &mut Machine<'_>,
        chooser: &mut impl Chooser,
        before: Option<&PartialRun>,
        pick: &mut dyn FnMut(&State, &Past) -> usize,
        barriers: usize,
    ) -> Result<Option<PartialRun>, Failure> {
        let mut state = with.task.start(machine, *with.order == Order::DepthFirst)?;
        let mut past = Past::start(with.order);
        if with.origins {
            state.remember_origins();
        }
        let (log_prior, log_factors, steps) = (Total::default(), Total::default(), vec![]);
        let skeleton = before.map(|before| before.steps.iter());
        let mut recorder = Recorder { chooser, with, skeleton, steps, log_prior, log_factors, lost: false };
        let (program, mut met) = (machine.program(), 0);
        machine.drive(&mut state, &mut recorder, |recorder, state, last| {
            if let Some((future, stop)) = last {
                met += usize::from(stop == Stop::Paused);
                past.ran(future, state);
            }
            if met == barriers || recorder.lost {
                return None;
            }
            past.look(program, state);
            recorder.next(state, &past, pick)
        })?;
        if recorder.lost {
            return Ok(None);
        }
        let Recorder { steps, log_prior, log_factors, .. } = recorder;
        Ok(Some(PartialRun { steps, log_prior, log_factors, state }))
    }

    /// The choices in order, without order choices.
    pub fn choices(&self) -> impl Iterator<Item = &Choice> {
        self.steps.iter().filter_map(Step::choice)
    }

    /// The steps up to each barrier, and from the last one to the end.
    pub fn segments(&self) -> Vec<&[Step]> {
        self.steps.split(Step::is_barrier).collect()
    }

    /// The share of its choices that `old` did not make.
    pub fn renewed(&self, old: &PartialRun) -> f64 {
        let before: HashMap<u128, &Value> = old.choices().map(|c| (c.address, &c.value)).collect();
        let is_new = |c: &&Choice| !before.get(&c.address).is_some_and(|value| identical(&c.value, value));
        let all = self.choices().count();
        if all == 0 { 0.0 } else { self.choices().filter(is_new).count() as f64 / all as f64 }
    }

    /// The primitives that differ from the run before: the old ones, and the new ones.
    pub fn exchanged<'a>(&'a self, before: &'a PartialRun) -> (Vec<&'a Primitive>, Vec<&'a Primitive>) {
        fn met(run: &PartialRun) -> impl Iterator<Item = (Option<&Primitive>, bool)> {
            run.steps.iter().filter_map(|step| match step {
                Step::Met { primitive, changed, .. } => Some((primitive.as_ref(), *changed)),
                _ => None,
            })
        }
        let (mut removed, mut added) = (vec![], vec![]);
        for ((old, _), (new, changed)) in met(before).zip(met(self)) {
            if changed || old.is_some() != new.is_some() {
                removed.extend(old);
                added.extend(new);
            }
        }
        (removed, added)
    }

    /// The choices and order choices as a log.
    pub fn log(&self) -> Log {
        let mut log = Log::default();
        for step in &self.steps {
            match step {
                Step::Chose(choice) => log.push(choice.address, choice.value.clone()),
                Step::Ran { path, pick: Some((pick, _)) } => log.push_order(*path, *pick),
                _ => {}
            }
        }
        log
    }

    /// The choice at an address: usually the first one from `at` on. Then `at` moves behind it.
    fn find(&self, address: u128, at: &mut usize) -> Option<&Choice> {
        let is_it = |choice: &&Choice| choice.address == address;
        let (passed, ahead) = self.steps.split_at(*at);
        for (i, step) in ahead.iter().enumerate() {
            if let Some(choice) = step.choice().filter(is_it) {
                *at += i + 1;
                return Some(choice);
            }
        }
        passed.iter().filter_map(Step::choice).find(is_it)
    }
}

impl Step {
    fn choice(&self) -> Option<&Choice> {
        if let Step::Chose(choice) = self { Some(choice) } else { None }
    }

    fn is_barrier(&self) -> bool {
        matches!(self, Step::Met { .. })
    }
}

/// Answers that record the steps of a run.
struct Recorder<'a, C> {
    chooser: &'a mut C,
    with: FollowSettings<'a>,
    /// The remaining steps of the run whose skeleton is to be kept.
    skeleton: Option<std::slice::Iter<'a, Step>>,
    steps: Vec<Step>,
    log_prior: Total,
    log_factors: Total,
    /// Whether the skeleton changed, or the run became impossible.
    lost: bool,
}

impl<C> Recorder<'_, C> {
    /// The next pick or barrier of the skeleton that is to be kept, where one is.
    fn next_mark(&mut self) -> Option<Option<&Step>> {
        let is_mark = |step: &&Step| matches!(step, Step::Ran { pick: Some(_), .. } | Step::Met { .. });
        self.skeleton.as_mut().map(|steps| steps.find(is_mark))
    }

    /// The place of the future that runs next: of a kept skeleton, else by `pick`.
    fn next(
        &mut self,
        state: &State,
        past: &Past,
        pick: &mut dyn FnMut(&State, &Past) -> usize,
    ) -> Option<usize> {
        let runnable = state.runnable();
        let mut picked = None;
        if runnable.len() > 1 {
            let hash = |hash, future: FutureId| join(hash, state.path_of(future));
            let among = runnable.iter().fold(runnable.len() as u128, hash);
            let logs = past.logs(state).unwrap_or_default();
            let among = logs.iter().fold(among, |hash, log| join(hash, u128::from(log.to_bits())));
            let place = match self.next_mark() {
                None => pick(state, past),
                Some(Some(Step::Ran { pick: Some((place, then)), .. })) if *then == among => *place,
                Some(_) => {
                    self.lost = true;
                    return None;
                }
            };
            picked = Some((place, among));
        }
        let place = picked.map_or(0, |(place, _)| place);
        if let Some(future) = runnable.get(place) {
            self.steps.push(Step::Ran { path: state.path_of(future), pick: picked });
        }
        Some(place)
    }

    fn barrier(&mut self, address: u128, shapes: Option<&[Shape]>) -> Answer<()> {
        let old = match self.next_mark() {
            None => None,
            Some(Some(Step::Met { address: then, primitive, .. })) if *then == address => primitive.clone(),
            Some(_) => {
                self.lost = true;
                None
            }
        };
        let is_unchanged = matches!((&old, shapes), (Some(old), Some(new)) if old.shapes() == new);
        let primitive = if is_unchanged { old } else { shapes.map(Primitive::new) };
        self.steps.push(Step::Met { address, primitive, changed: !is_unchanged && shapes.is_some() });
        Answer::Pause
    }
}

impl<C: Chooser> Answers<f64> for Recorder<'_, C> {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let seen = Context::of(at);
        let chosen = self.chooser.choose(at, dist, seen)?;
        let Some(Chosen { value, log_prior, .. }) = chosen.filter(|c| c.log_prior > f64::NEG_INFINITY) else {
            self.lost = true;
            return Ok(Answer::Pause);
        };
        let (address, family, site, log) = (seen.address, dist.family(), at.site.key, grid(log_prior));
        let weights = (self.with.weigh)(at);
        self.log_prior.add(log);
        self.steps.push(Step::Chose(Choice { address, value: value.clone(), family, log, site, weights }));
        Ok(Answer::Go(value))
    }

    fn score(&mut self, at: &At<'_, f64>, _: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.log_factors.add(check_factor(log)?);
        self.lost |= log == f64::NEG_INFINITY;
        Ok(self.barrier(at.address(), None))
    }

    fn emit(&mut self, at: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        Ok(self.barrier(at.address(), Some(shapes)))
    }

    fn unmet(&mut self, _: &str) {
        self.lost = true;
    }

    fn host(&mut self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        self.with.task.hosts.call(constant, args, steps)
    }
}

/// Chooser of a rerun: previous or proposed values; new choices are drawn.
struct Changed<'a, P> {
    before: &'a PartialRun,
    at: usize,
    propose: P,
    fresh: Prior,
    densities: Densities,
}

impl<P> Chooser for Changed<'_, P>
where
    P: FnMut(&At<'_, f64>, &Choice, &Dist) -> Result<Option<Proposed<f64>>, Fault>,
{
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let known = self.before.find(seen.address, &mut self.at);
        let Some(choice) = known.filter(|c| c.family == dist.family() && fits(dist, &c.value)) else {
            let chosen = self.fresh.choose(at, dist, seen)?;
            chosen.iter().for_each(|chosen| self.densities.fresh.add(grid(chosen.log_prior)));
            return Ok(chosen);
        };
        self.densities.stale.remove(choice.log);
        let value = match (self.propose)(at, choice, dist)? {
            None => choice.value.clone(),
            Some(proposed) => {
                self.densities.forward += proposed.forward;
                self.densities.backward += proposed.backward;
                proposed.value
            }
        };
        Chosen::given(value, dist).map(Some)
    }
}

/// Chooser of the values of a segment, in order; it pauses at any other choice.
struct Follow<'a> {
    steps: std::slice::Iter<'a, Step>,
    /// The proposal that would have drawn them, where their weights count.
    proposal: Option<&'a Proposal>,
    sight: Sight,
    lost: bool,
}

impl Chooser for Follow<'_> {
    #[inline]
    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        let next = self.steps.next().and_then(Step::choice);
        let Some(choice) = next.filter(|c| c.address == seen.address && c.family == dist.family()) else {
            self.lost = true;
            return Ok(None);
        };
        as_if_drawn(self.proposal, at, dist, &choice.value, seen, &mut self.sight).map(Some)
    }
}

/// Follows a segment of another run from the present state of a particle: to its next barrier, or to the end where the segment is
/// the run's `last`. Returns the log probability of its order choices. `None` where the segment cannot be followed or
/// has density zero; the particle must then not be used again. With a `proposal` its choices count as drawn by it; with a
/// `look_ahead` it has its twist.
pub(crate) fn follow(
    particle: &mut Particle,
    machine: &mut Machine<'_>,
    task: &Task,
    segment: &[Step],
    last: bool,
    proposal: Option<&Proposal>,
    look_ahead: Option<&LookAhead>,
) -> Result<Option<f64>, Failure> {
    let mut follow = Follow { steps: segment.iter(), proposal, sight: Sight::default(), lost: false };
    let mut log_order = 0.0;
    let pick = |follow: &mut &mut Follow<'_>, Turn { state, past, .. }: Turn<'_>| {
        let place_of_future = match follow.steps.next() {
            Some(Step::Ran { path, .. }) => place(state, *path),
            _ => None,
        };
        follow.lost |= place_of_future.is_none();
        if state.runnable().len() > 1 {
            log_order += past.log_probability(state, place_of_future?);
        }
        place_of_future
    };
    let paused = particle.advance_by(machine, task, pick, &mut follow)?;
    if follow.lost {
        return Ok(None);
    }
    particle.foresee(look_ahead, task, machine, &mut follow.sight);
    let arrived = if last { particle.state.has_ended() } else { paused && particle.record.cause.is_none() };
    Ok((arrived && follow.steps.len() == 0).then_some(log_order))
}
