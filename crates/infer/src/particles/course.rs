//! The way of a particle that still runs, from its start to the barrier where it is paused, and the same way again with
//! other values.
//!
//! What may not change is the *skeleton*: which futures could run at each pick, at which address each barrier stands,
//! and where every future stands at the end. Under one skeleton the order policy gives equal order choices equal
//! probability (one over the number of futures that can run, pick by pick), so it cancels in a ratio.

use crate::Failure;
use crate::chooser::{Chooser, Prior};
use crate::log::{Entry, Log};
use crate::record::{check_factor, log_density};
use crate::task::{Hosts, Task};
use niwaki_geom::{Primitive, Shape};
use niwaki_math::{Dist, Family, StreamKey, Total, grid};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::address::join;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::kept::{Proposed, fits};
use niwaki_vm::machine::state::State;
use niwaki_vm::value::Value;

/// A choice on the way.
#[derive(Clone, Debug)]
pub(super) struct Choice {
    pub address: u128,
    pub value: Value,
    pub family: Family,
    /// Log density, nats, on its grid.
    pub log: f64,
    /// The key of its site.
    pub site: u128,
    /// Its weight for each leaf of the kernel that does not take all choices alike.
    pub weights: Box<[u64]>,
}

/// One thing on the way.
#[derive(Clone, Debug)]
enum Step {
    Chose(Choice),
    /// A future was picked: its path, its place among those that could run, and a hash of their paths.
    Ran {
        path: u128,
        which: usize,
        among: u128,
    },
    /// A barrier: its address, the primitive of an `emit`, and whether that is another than on the way before.
    Met {
        address: u128,
        primitive: Option<Primitive>,
        changed: bool,
    },
}

/// The way of a particle that still runs.
pub(super) struct Course {
    steps: Vec<Step>,
    barriers: usize,
    choices: usize,
    pub log_prior: Total,
    pub log_factors: Total,
    /// Where it has led.
    pub state: State,
}

/// Weighs a choice that is new, for each leaf that asks.
pub(super) type Weigh<'a> = dyn Fn(&At<'_, f64>) -> Box<[u64]> + 'a;

/// Proposes a value for a choice, or leaves it: where it stands, its number on the way before, the choice, its distribution now.
pub(super) type Ask<'a> =
    dyn FnMut(&At<'_, f64>, usize, &Choice, &Dist) -> Result<Option<Proposed<f64>>, Fault> + 'a;

/// Log densities that a move counts, nats.
#[derive(Clone, Debug, Default)]
pub(super) struct Densities {
    pub fresh: Total,
    pub stale: Total,
    pub forward: f64,
    pub backward: f64,
}

enum Source<'a> {
    /// The particle's own log; the next entry.
    Log(&'a [Entry], usize),
    /// The way before, with changes.
    Before { course: &'a Course, at: usize, mark: usize, number: usize, ask: &'a mut Ask<'a>, fresh: Prior },
}

struct Walk<'a> {
    source: Source<'a>,
    hosts: &'a dyn Hosts,
    weigh: &'a Weigh<'a>,
    made: Course,
    densities: Densities,
    /// Old log densities of the choices that were met again.
    met: Total,
    /// Whether the skeleton changed, or the run became impossible.
    lost: bool,
    /// Whether any skeleton will do: an error, for the tests.
    careless: bool,
}

impl Walk<'_> {
    /// Compares a mark of the skeleton with the next one of the way before; the primitive that stood there.
    fn next_mark(&mut self, fits: impl Fn(&Step) -> bool) -> Option<Option<Primitive>> {
        let Source::Before { course, mark, .. } = &mut self.source else { return Some(None) };
        let found = course.steps.iter().skip(*mark).position(|s| !matches!(s, Step::Chose(_)))?;
        let step = &course.steps[*mark + found];
        *mark += found + 1;
        if !fits(step) {
            return None;
        }
        match step {
            Step::Met { primitive, .. } => Some(primitive.clone()),
            _ => Some(None),
        }
    }

    fn barrier(&mut self, address: u128, shapes: Option<&[Shape]>) -> Answer<()> {
        let known = self.next_mark(|step| matches!(step, Step::Met { address: a, .. } if *a == address));
        if known.is_none() && !self.careless {
            self.lost = true;
            return Answer::Pause;
        }
        let old = known.flatten();
        let same = matches!((&old, shapes), (Some(old), Some(new)) if old.shapes() == new);
        let primitive = if same { old } else { shapes.map(Primitive::new) };
        self.made.steps.push(Step::Met { address, primitive, changed: !same && shapes.is_some() });
        self.made.barriers += 1;
        Answer::Pause
    }
}

impl Answers<f64> for Walk<'_> {
    fn choice(&mut self, at: &At<'_, f64>, dist: &Dist) -> Result<Answer<Value>, Fault> {
        let address = at.address();
        let mut known = None;
        let (value, log) = match &mut self.source {
            Source::Log(entries, next) => {
                let own = entries.get(*next).filter(|e| !e.is_order() && e.address() == address);
                let Some(entry) = own else {
                    return Err(Fault::new(
                        "missing-choice",
                        "a particle's log does not lead to where it is",
                    ));
                };
                *next += 1;
                (entry.value.clone(), log_density(dist, &entry.value)?)
            }
            Source::Before { course, at: place, number, ask, fresh, .. } => {
                known = course.find(address, place, number);
                let usable = known.filter(|(_, c)| c.family == dist.family() && fits(dist, &c.value));
                match usable {
                    Some((n, choice)) => {
                        self.met.add(choice.log);
                        let value = match ask(at, n, choice, dist)? {
                            None => choice.value.clone(),
                            Some(proposed) => {
                                self.densities.forward += proposed.forward;
                                self.densities.backward += proposed.backward;
                                proposed.value
                            }
                        };
                        let log = log_density(dist, &value)?;
                        (value, log)
                    }
                    None => {
                        let chosen = fresh.choose(at, dist)?;
                        self.densities.fresh.add(grid(chosen.log_prior));
                        (chosen.value, chosen.log_prior)
                    }
                }
            }
        };
        if log == f64::NEG_INFINITY {
            self.lost = true;
            return Ok(Answer::Pause);
        }
        let weights = known.map_or_else(|| (self.weigh)(at), |(_, choice)| choice.weights.clone());
        let (family, site, log) = (dist.family(), at.site.key, grid(log));
        self.made.steps.push(Step::Chose(Choice {
            address,
            value: value.clone(),
            family,
            log,
            site,
            weights,
        }));
        self.made.choices += 1;
        self.made.log_prior.add(log);
        Ok(Answer::Go(value))
    }

    fn score(&mut self, at: &At<'_, f64>, _: Factor, log: f64) -> Result<Answer<()>, Fault> {
        self.made.log_factors.add(check_factor(log)?);
        self.lost |= log == f64::NEG_INFINITY;
        Ok(self.barrier(at.address(), None))
    }

    fn emit(&mut self, at: &At<'_, f64>, shapes: &[Shape]) -> Result<Answer<()>, Fault> {
        Ok(self.barrier(at.address(), Some(shapes)))
    }

    fn query(&mut self, _: &At<'_, f64>, _: &Value, _: &Value) -> Result<(), Fault> {
        Ok(())
    }

    fn host(&mut self, constant: u16, args: &[Value]) -> Result<Value, Fault> {
        self.hosts.call(constant, args)
    }
}

/// What a way is made with.
#[derive(Clone, Copy)]
pub(super) struct With<'a> {
    pub task: &'a Task,
    pub depth_first: bool,
    /// Whether addresses are to be readable from the root.
    pub origins: bool,
    pub weigh: &'a Weigh<'a>,
    pub careless: bool,
}

impl Course {
    /// The way of a particle with this log, paused at its `barriers`-th barrier.
    pub fn of(
        with: With<'_>,
        machine: &mut Machine<'_>,
        entries: &[Entry],
        barriers: usize,
    ) -> Result<Course, Failure> {
        let source = Source::Log(entries, 0);
        let made = Course::walk(with, machine, source, barriers)?;
        made.map(|(course, _)| course).ok_or_else(|| {
            Fault::new("missing-choice", "a particle's log does not lead to where it is").into()
        })
    }

    /// The same way with what `ask` proposes; choices that were not there before are drawn from `fresh`. `None` where
    /// it leads to another skeleton, or is impossible.
    pub fn again<'a>(
        &'a self,
        with: With<'a>,
        machine: &mut Machine<'_>,
        ask: &'a mut Ask<'a>,
        fresh: StreamKey,
    ) -> Result<Option<(Course, Densities)>, Failure> {
        let source = Source::Before { course: self, at: 0, mark: 0, number: 0, ask, fresh: Prior(fresh) };
        let Some((made, mut densities)) = Course::walk(with, machine, source, self.barriers)? else {
            return Ok(None);
        };
        if made.state.stands() != self.state.stands() && !with.careless {
            return Ok(None);
        }
        densities.stale.add_total(&self.log_prior);
        Ok(Some((made, densities)))
    }

    fn walk<'a>(
        with: With<'a>,
        machine: &mut Machine<'_>,
        source: Source<'a>,
        barriers: usize,
    ) -> Result<Option<(Course, Densities)>, Failure> {
        let mut state = with.task.start(machine, with.depth_first)?;
        if with.origins {
            state.remember_origins();
        }
        let empty = State::of_result(Value::None);
        let (log_prior, log_factors) = (Total::default(), Total::default());
        let made = Course { steps: vec![], barriers: 0, choices: 0, log_prior, log_factors, state: empty };
        let mut walk = Walk {
            source,
            hosts: &*with.task.hosts,
            weigh: with.weigh,
            made,
            densities: Densities::default(),
            met: Total::default(),
            lost: false,
            careless: with.careless,
        };
        while walk.made.barriers < barriers {
            let runnable = state.runnable();
            let future = match runnable.len() {
                // It has ended, or its futures wait for each other: not where the particle is.
                0 => return Ok(None),
                1 => runnable[0],
                n => {
                    let among = runnable.iter().fold(n as u128, |hash, f| join(hash, state.path_of(*f)));
                    let Some(which) = walk.picked(among) else { return Ok(None) };
                    let which = if walk.careless { which % n } else { which };
                    let path = state.path_of(runnable[which]);
                    walk.made.steps.push(Step::Ran { path, which, among });
                    runnable[which]
                }
            };
            if let Err(met) = machine.resume(&mut state, future, &mut walk) {
                return if with.task.invalid.count(&met).is_some() { Ok(None) } else { Err(met.into()) };
            }
            if walk.lost {
                return Ok(None);
            }
        }
        let mut densities = walk.densities;
        densities.stale.remove_total(&walk.met);
        walk.made.state = state;
        Ok(Some((walk.made, densities)))
    }

    /// The choice at an address and its number: as a rule the next one. `at` is where to look, `number` how many
    /// choices come before.
    fn find(&self, address: u128, at: &mut usize, number: &mut usize) -> Option<(usize, &Choice)> {
        let mut n = *number;
        for (i, step) in self.steps.iter().enumerate().skip(*at) {
            if let Step::Chose(choice) = step {
                if choice.address == address {
                    (*at, *number) = (i + 1, n + 1);
                    return Some((n, choice));
                }
                n += 1;
            }
        }
        let before = self.steps[..*at].iter().filter_map(Step::choice).enumerate();
        before.into_iter().find(|(_, choice)| choice.address == address)
    }

    /// Its choices, in order.
    pub fn choices(&self) -> impl Iterator<Item = &Choice> {
        self.steps.iter().filter_map(Step::choice)
    }

    /// How many choices it has.
    pub fn len(&self) -> usize {
        self.choices
    }

    /// Primitives that it does not share with the way before it: what stood there, and what stands there now.
    pub fn exchanged<'a>(&'a self, before: &'a Course) -> (Vec<&'a Primitive>, Vec<&'a Primitive>) {
        let met = |course: &'a Course| {
            course.steps.iter().filter_map(|step| match step {
                Step::Met { primitive, changed, .. } => Some((primitive.as_ref(), *changed)),
                _ => None,
            })
        };
        let (mut gone, mut come) = (vec![], vec![]);
        for ((old, _), (new, changed)) in met(before).zip(met(self)) {
            if changed || old.is_some() != new.is_some() {
                gone.extend(old);
                come.extend(new);
            }
        }
        (gone, come)
    }

    /// Its choices and picks as a log.
    pub fn log(&self) -> Log {
        let mut log = Log::default();
        for step in &self.steps {
            match step {
                Step::Chose(choice) => log.push(choice.address, choice.value.clone()),
                Step::Ran { path, which, .. } => log.push_order(*path, *which),
                Step::Met { .. } => {}
            }
        }
        log
    }
}

impl Step {
    fn choice(&self) -> Option<&Choice> {
        match self {
            Step::Chose(choice) => Some(choice),
            _ => None,
        }
    }
}

impl Walk<'_> {
    /// The place of the future that was picked here; `None` where others could run.
    fn picked(&mut self, now: u128) -> Option<usize> {
        let careless = self.careless;
        match &mut self.source {
            Source::Log(entries, next) => {
                let which = entries.get(*next)?.which()?;
                *next += 1;
                Some(which)
            }
            Source::Before { course, mark, .. } => {
                let found = course.steps.iter().skip(*mark).position(|s| !matches!(s, Step::Chose(_)))?;
                *mark += found + 1;
                match course.steps[*mark - 1] {
                    Step::Ran { which, among, .. } if among == now || careless => Some(which),
                    _ => None,
                }
            }
        }
    }
}
