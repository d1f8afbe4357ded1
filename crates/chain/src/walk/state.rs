//! The state of a chain: a kept run and the sketches of its scene. A proposal opens a transaction on both.

use crate::walk::streams::Streams;
use niwaki_geom::sketch::product::Sketches;
use niwaki_math::{StreamKey, Total};
use niwaki_run::checkpoint::unfit;
use niwaki_run::fresh::Fresh;
use niwaki_run::record::{AllInvalid, score_of};
use niwaki_run::run::Run;
use niwaki_run::task::Task;
use niwaki_run::{Failure, forward};
use niwaki_vm::code::{Program, SiteKind};
use niwaki_vm::machine::answers::Factor;
use niwaki_vm::machine::kept::inspect::Item;
use niwaki_vm::machine::kept::{Change, Trace};
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::sync::Arc;

/// The state of a chain.
pub struct State {
    /// The run.
    pub trace: Trace,
    /// The sketches of its scene.
    pub sketches: Sketches,
    /// Their log score, nats; minus infinity when they forbid the scene.
    pub log_sketches: Total,
    /// The number of primitives of the scene.
    pub primitives: usize,
    /// The number of shapes that proposals have removed from the scene or added to it.
    pub moved: u64,
    /// The number of primitives before the open transaction.
    primitives_before: usize,
    /// The sketches before the open transaction and their log score, if the transaction changed the scene. The copy shares
    /// unchanged data.
    before: Option<(Sketches, Total)>,
}

impl State {
    /// Find a first state by at most `tries` forward runs, with the spreads of the distributions of its sites. `known` has values of
    /// choices.
    ///
    /// # Errors
    /// No run was possible ([`Failure::NoStart`]); a fault of the program, also where all runs are invalid.
    pub fn start(
        task: &Task,
        streams: Streams,
        tries: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<(State, HashMap<u128, f64>), Failure> {
        State::tried(task, streams, tries, known).map(|(state, spreads, _)| (state, spreads))
    }

    /// Like [`State::start`], and also return the number of runs.
    ///
    /// # Errors
    /// The errors of [`State::start`].
    pub fn tried(
        task: &Task,
        streams: Streams,
        tries: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<(State, HashMap<u128, f64>, u64), Failure> {
        State::tried_after(task, streams, 0, tries.max(1), known)
    }

    /// Like [`State::tried`], after a number of runs that failed otherwise, which `tries` includes.
    ///
    /// # Errors
    /// The errors of [`State::start`].
    pub fn tried_after(
        task: &Task,
        streams: Streams,
        first: u64,
        tries: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<(State, HashMap<u128, f64>, u64), Failure> {
        let mut machine = task.machine();
        let (mut causes, mut all): (HashMap<String, usize>, _) = (HashMap::new(), AllInvalid::default());
        for attempt in first..tries {
            // Visits count down from the last number, so that no proposal has the same visit.
            let (key, mut spreads) = (streams.fresh(u64::MAX - attempt), HashMap::new());
            let mut answers = Fresh { spreads: Some(&mut spreads), ..Fresh::of(key, known, &*task.hosts) };
            let (trace, change) = match task.begin(&mut machine, &mut answers) {
                Ok(start) => start,
                Err(met) => {
                    let Some(place) = task.invalid.count(&met) else { return Err(met.into()) };
                    *causes.entry(place.to_string()).or_default() += 1;
                    all.note(Some(&Arc::new(*met)));
                    continue;
                }
            };
            all.note(None);
            let mut state = State {
                trace,
                sketches: Sketches::start(&task.sketches),
                log_sketches: Total::default(),
                primitives: 0,
                moved: 0,
                primitives_before: 0,
                before: None,
            };
            let cause = if change == Change::Impossible {
                Some(impossible(&state.trace, task))
            } else {
                state.sketches.expect_removals();
                state.update_sketches()?;
                state.sketches.forbidden_by().map(str::to_string)
            };
            match cause {
                None => {
                    state.trace.commit(&task.program);
                    return Ok((state, spreads, attempt + 1));
                }
                Some(cause) => *causes.entry(cause).or_default() += 1,
            }
        }
        all.check()?;
        let mut causes: Vec<_> = causes.into_iter().collect();
        causes.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
        Err(Failure::NoStart { tries, causes })
    }

    /// Create the state of a run with these values. The sketches already hold the scene of the run.
    ///
    /// # Errors
    /// A fault of the program; values that make the run impossible.
    pub fn of_run(
        task: &Task,
        known: &HashMap<u128, Value>,
        mut sketches: Sketches,
        primitives: usize,
    ) -> Result<State, Failure> {
        let key = StreamKey::new(0, 0, 0);
        let mut answers = Fresh::of(key, Some(known), &*task.hosts);
        let (mut trace, change) = task.begin(&mut task.machine(), &mut answers)?;
        if change == Change::Impossible {
            let cause = impossible(&trace, task);
            return Err(Failure::NoStart { tries: 1, causes: vec![(cause, 1)] });
        }
        trace.commit(&task.program);
        sketches.expect_removals();
        let log_sketches = sketches.total();
        let primitives_before = primitives;
        Ok(State { trace, sketches, log_sketches, primitives, moved: 0, primitives_before, before: None })
    }

    /// Create a state with these choices, numbered in this order.
    ///
    /// # Errors
    /// A fault of the program; values that make the run impossible, or that do not belong to a run.
    pub(crate) fn of_choices(task: &Task, choices: &[(u128, Value)]) -> Result<State, Failure> {
        let known = choices.iter().cloned().collect();
        let (mut state, _) = State::start(task, Streams::new(0, 0), 1, Some(&known))?;
        let order: Vec<u128> = choices.iter().map(|choice| choice.0).collect();
        if !state.trace.arrange(&task.program, &order) {
            return Err(unfit("its choices are not those of a run of this model"));
        }
        Ok(state)
    }

    /// The choices of the state.
    pub fn choices<'a>(&'a self, program: &'a Program) -> impl Iterator<Item = (u128, Value)> + 'a {
        choices(&self.trace, program)
    }

    /// The value of a real choice; `None` for any other.
    pub(crate) fn real(&self, program: &Program, choice: usize) -> Option<f64> {
        match self.trace.choice(program, choice).0 {
            Value::Real(x) => Some(*x),
            _ => None,
        }
    }

    /// The number of its real choices.
    pub fn reals(&self, program: &Program) -> usize {
        self.trace.numbers().filter(|n| self.real(program, *n).is_some()).count()
    }

    /// Convert the state after `visit` proposals to a finished run.
    pub fn run(&self, program: &Program, visit: u64) -> Run {
        Run { log: self.choices(program).collect(), value: self.trace.result(), ..self.scores(visit) }
    }

    /// Like [`State::run`], without choices and value, which are slow to copy.
    pub(super) fn scores(&self, visit: u64) -> Run {
        Run {
            log_prior: self.trace.totals().log_prior.value(),
            log_score: self.log_score(),
            primitives: self.primitives,
            similarity: self.sketches.similarity(),
            has_ended: true,
            visit,
            ..Run::default()
        }
    }

    /// The log score, nats: factors, observations and sketches.
    #[inline]
    pub fn log_score(&self) -> f64 {
        self.score().value()
    }

    /// The log score as an exact sum.
    #[inline]
    pub fn score(&self) -> Total {
        self.trace.totals().log_factors.plus(&self.log_sketches)
    }

    /// Apply the changes of the scene by the open transaction to the sketches, once.
    ///
    /// # Errors
    /// A sketch scores NaN.
    #[inline]
    pub fn update_sketches(&mut self) -> Result<(), Failure> {
        (self.primitives_before, self.before) = (self.primitives, None);
        let (removed, added) = (self.trace.retracted().count(), self.trace.emitted().count());
        if removed + added == 0 && self.primitives > 0 {
            return Ok(());
        }
        self.primitives = self.primitives + added - removed;
        self.moved += (removed + added) as u64;
        if self.sketches.is_empty() {
            return Ok(());
        }
        self.before = Some((self.sketches.fork(), self.log_sketches.clone()));
        let kept = self.sketches.exchange(self.trace.retracted(), self.trace.emitted());
        debug_assert!(kept, "the sketches and the trace hold the same scene");
        self.log_sketches = score_of(&self.sketches)?;
        Ok(())
    }

    /// The change of the sketches' log score by the open transaction; `None` if the scene did not change.
    #[inline]
    pub fn sketch_change(&self) -> Option<Total> {
        self.before.as_ref().map(|(_, log_before)| self.log_sketches.less(log_before))
    }

    /// Undo [`State::update_sketches`]. The caller rolls back the trace.
    #[inline]
    pub fn restore_sketches(&mut self) {
        if let Some(before) = self.before.take() {
            (self.sketches, self.log_sketches) = before;
        }
        self.primitives = self.primitives_before;
    }
}

/// The choices of a trace, in order.
pub(crate) fn choices<'a>(
    trace: &'a Trace,
    program: &'a Program,
) -> impl Iterator<Item = (u128, Value)> + 'a {
    trace.numbers().map(|n| (trace.address(program, n), trace.choice(program, n).0.clone()))
}

/// The name of the factor or choice that makes a run impossible.
fn impossible(trace: &Trace, task: &Task) -> String {
    let mut cause = None;
    trace.visit(&task.program, |place, item| {
        let line = place.site.span.line;
        match item {
            Item::Factor(f64::NEG_INFINITY) => {
                let factor = match place.site.kind {
                    SiteKind::Factor => Factor::Factor,
                    SiteKind::Condition => Factor::Condition,
                    _ => Factor::Observe,
                };
                cause = Some(forward::named(factor, line));
            }
            Item::Held(_, f64::NEG_INFINITY) => cause = Some(forward::held_name(&place.path(), line)),
            Item::Choice(_, f64::NEG_INFINITY) => {
                cause = Some(format!("the choice `{}` at line {line}", place.path()));
            }
            _ => {}
        }
    });
    let held = task.held.as_deref().zip(trace.unmet());
    let unmet = || held.map(|(held, number)| forward::unmet_name(held.name(number)));
    cause.or_else(unmet).unwrap_or_else(|| "a factor".into())
}
