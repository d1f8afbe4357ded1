//! An `infer` by enumeration in a recorded run: its probabilities are functions of the choices outside.
//!
//! Run `r` of the inner model has the log probability `l_r`, the log densities of its choices and its scores together. A value
//! `v` then has the probability
//!
//! ```text
//! p_v = exp(L_v - Z)      L_v = ln sum of exp(l_r) over the runs with the value v      Z = ln sum of exp(l_r) over all runs
//! ```
//!
//! Both sums are finite, and each `l_r` is recorded as the run is, so the derivative is exact. At the recorded point the
//! probabilities are those of the plain run to the bit ([`niwaki_run::enumeration`]), whose log densities are rounded to a grid.
//!
//! Which runs there are, which of them have equal values, and the order of the values may change with the choices outside.
//! Each is a comparison, so the run is recorded again where one turns out differently. One comparison is loose: two values keep
//! their order until their log probabilities differ by more than [`TIE`] the other way. Ties of a symmetric model are exact
//! in the plain run and only nearly so in a recording.

use super::hosted::Hosted;
use niwaki_grad::Var;
use niwaki_math::log_sums::{log_sum_exp, log_sum_exp_of};
use niwaki_math::{Dist, Scalar, Total, grid};
use niwaki_run::Failure;
use niwaki_run::enumeration::{not_enumerable, too_many};
use niwaki_run::forward::named;
use niwaki_run::inside::{fault_of, limits_inside, too_long};
use niwaki_run::record::{AllInvalid, check_factor};
use niwaki_vm::code::FunctionId;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::{Answer, Answers, At, Factor};
use niwaki_vm::machine::invalid::Invalid;
use niwaki_vm::machine::state::State;
use niwaki_vm::machine::{Machine, SharedSteps, Stop};
use niwaki_vm::value::{Closure, Value, repr};
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

/// Log probabilities that differ by less count as equal where values are ranked, nats: far above the errors of sums on the
/// grid, far below what a program could mean by a difference.
const TIE: f64 = 1e-6;
/// Probabilities whose logs are above this, nats, are equal only where the logs differ by less than [`TIE`]: from here on down
/// the numbers of a machine lie further apart.
const SMALL: f64 = -730.0;
/// Most inner runs that are recorded: their operations stay in memory.
const MOST: usize = 1 << 17;

/// The log probability of a run so far.
#[derive(Clone)]
struct Joint {
    /// As recorded.
    log: Var,
    /// As the plain run has it.
    plain: Total,
}

impl Joint {
    fn add(&mut self, log: Var, plain: f64) {
        self.log = self.log + log;
        self.plain.add(plain);
    }
}

/// A run up to an open choice, and the value with which it goes on.
struct Branch {
    state: State<Var>,
    joint: Joint,
    next: Option<Value<Var>>,
}

/// Gives the next choice its value. At the choice after it the run pauses, with all values of that choice.
struct Branching<'a> {
    hosted: &'a Hosted,
    joint: Joint,
    next: Option<Value<Var>>,
    open: Vec<(Value<Var>, Var)>,
    /// The name of what made the run impossible.
    cause: Option<String>,
}

/// Whether a log density is minus infinity: a comparison, so that a recording holds only where it turns out the same.
fn is_never(log: Var) -> bool {
    log == Var::from_f64(f64::NEG_INFINITY)
}

impl Answers<Var> for Branching<'_> {
    fn choice(&mut self, at: &At<'_, Var>, dist: &Dist<Var>) -> Result<Answer<Value<Var>>, Fault> {
        if let Some(value) = self.next.take() {
            return Ok(Answer::Go(value));
        }
        let Some(draws) = dist.enumerate() else { return Err(not_enumerable(&at.path())) };
        for draw in draws {
            let log = dist.log_density(&draw);
            if !is_never(log) {
                self.open.push((draw.into(), log));
            }
        }
        Ok(Answer::Pause)
    }

    fn score(&mut self, at: &At<'_, Var>, factor: Factor, log: Var) -> Result<Answer<()>, Fault> {
        let plain = check_factor(log.value())?;
        if is_never(log) {
            self.cause = Some(named(factor, at.site.span.line));
            return Ok(Answer::Pause);
        }
        self.joint.add(log, plain);
        Ok(Answer::Go(()))
    }

    fn host(&mut self, constant: u16, args: &[Value<Var>], steps: &mut u64) -> Result<Value<Var>, Fault> {
        self.hosted.call(constant, args, steps)
    }
}

/// A value of the inner model.
struct Outcome {
    value: Value<Var>,
    /// Its runs.
    runs: Vec<Joint>,
}

/// The values of the inner model with their probabilities, as [`niwaki_search::nested::Inner::value`] gives them. `args` are those of
/// `infer`: the model, its arguments and a seed, which nothing uses.
///
/// # Errors
/// A fault of the inner model, more runs than `max_runs`, runs that are all impossible.
pub(super) fn enumerated(
    around: &Hosted,
    args: &[Value<Var>],
    max_runs: usize,
    steps: &mut u64,
) -> Result<Value<Var>, Fault> {
    let [Value::Function(model), args @ .., _] = args else {
        return Err(Fault::not_callable("`infer` runs a model"));
    };
    Value::Function(Arc::clone(model)).refuse_memoised()?;
    args.iter().try_for_each(Value::refuse_memoised)?;
    let name = &around.program.function(FunctionId(model.function)).name;
    let together = SharedSteps::new(around.limits.steps.saturating_sub(*steps));
    let limits = limits_inside(around.limits, around.depth)?;
    let inside = Hosted { limits, depth: around.depth + 1, ..around.clone() };
    let ranking = runs(&inside, model, args, max_runs, &together).and_then(ranked).map_err(|failure| {
        if together.is_spent() { too_long(name, limits.steps) } else { fault_of(name, failure) }
    });
    *steps = steps.saturating_add(together.used());
    ranking
}

/// The values of all runs, in the order of their first appearance.
fn runs(
    inside: &Hosted,
    model: &Arc<Closure<Var>>,
    args: &[Value<Var>],
    max_runs: usize,
    together: &SharedSteps,
) -> Result<Vec<Outcome>, Failure> {
    let mut machine = Machine::new(&inside.program, inside.limits).within(Some(together));
    let joint = Joint { log: Var::from_f64(0.0), plain: Total::default() };
    let mut open = vec![Branch { state: machine.start_closure(model, args, true)?, joint, next: None }];
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut index: HashMap<String, usize> = HashMap::new();
    let (mut met, mut all, invalid) = (0, AllInvalid::default(), Invalid::default());
    let mut causes: HashMap<String, usize> = HashMap::new();
    while let Some(Branch { mut state, joint, next }) = open.pop() {
        let mut answers = Branching { hosted: inside, joint, next, open: vec![], cause: None };
        let mut fault = None;
        let driven = machine.drive(&mut state, &mut answers, |answers, _, last| {
            let has_paused = matches!(last, Some((_, Stop::Paused)));
            (!has_paused && answers.cause.is_none()).then_some(0)
        });
        if let Err(met) = driven {
            let Some(place) = invalid.count(&met) else { return Err(met.into()) };
            answers.cause = Some(place.to_string());
            fault = Some(Arc::new(*met));
        }
        let Branching { joint, open: values, cause, .. } = answers;
        if cause.is_none() && !state.has_ended() {
            // Reversed, so that values appear in their order.
            for (value, log) in values.into_iter().rev() {
                let mut joint = joint.clone();
                joint.add(log, grid(log.value()));
                open.push(Branch { state: state.clone(), joint, next: Some(value) });
            }
            continue;
        }
        met += 1;
        if met > max_runs {
            return Err(too_many(max_runs).into());
        }
        if met > MOST {
            return Err(too_many_to_record().into());
        }
        all.note(fault.as_ref());
        match cause {
            Some(cause) => *causes.entry(cause).or_insert(0) += 1,
            None => {
                let value = state.result();
                let key = repr(&value.convert(&Var::value))?;
                let at = *index.entry(key).or_insert(outcomes.len());
                match outcomes.get_mut(at) {
                    Some(outcome) => {
                        stay_equal(&outcome.value, &value);
                        outcome.runs.push(joint);
                    }
                    None => outcomes.push(Outcome { value, runs: vec![joint] }),
                }
            }
        }
    }
    if outcomes.is_empty() {
        all.check()?;
        return Err(Failure::impossible(0, causes.iter().map(|(cause, n)| (cause.as_str(), *n))));
    }
    stay_apart(&outcomes)?;
    Ok(outcomes)
}

#[cold]
fn too_many_to_record() -> Fault {
    Fault::new("too-many-runs", format!("a gradient records at most {MOST} runs of the model inside"))
        .with_help("make the model inside smaller, or search by `mh()` or particles, which need no gradient")
}

/// The list of values with their probabilities, the most probable first.
fn ranked(outcomes: Vec<Outcome>) -> Result<Value<Var>, Failure> {
    let sums = |outcome: &Outcome| {
        let plain = log_sum_exp(outcome.runs.iter().map(|run| run.plain.value()));
        log_sum_exp_of(outcome.runs.iter().map(|run| run.log)).at(plain)
    };
    let logs: Vec<Var> = outcomes.iter().map(sums).collect();
    let evidence = log_sum_exp_of(logs.iter().copied()).at(log_sum_exp(logs.iter().map(|log| log.value())));
    let mut all: Vec<(Value<Var>, Var)> =
        outcomes.into_iter().zip(logs).map(|(outcome, log)| (outcome.value, log - evidence)).collect();
    // As in a plain run: stable, by the probabilities themselves.
    all.sort_by(|a, b| b.1.value().exp().total_cmp(&a.1.value().exp()));
    for pair in all.windows(2) {
        // Guards: where they do not hold, the order may be another one.
        let is_ranked = pair[1].1 - pair[0].1 <= Var::from_f64(TIE);
        if !is_ranked {
            // Both probabilities are the same small number, by rounding.
            let _ = pair[1].1 <= Var::from_f64(SMALL);
        }
    }
    let pair = |(value, log): (Value<Var>, Var)| Value::tuple(vec![value, Value::Real(log.exp())]);
    Ok(Value::list(all.into_iter().map(pair).collect()))
}

/// The real numbers of a value, in order.
fn numbers(value: &Value<Var>) -> Vec<Var> {
    let numbers = RefCell::new(Vec::new());
    value.convert(&|x: Var| {
        numbers.borrow_mut().push(x);
        x
    });
    numbers.into_inner()
}

/// Guards that two values, which are equal here, are equal.
fn stay_equal(a: &Value<Var>, b: &Value<Var>) {
    if a.varies() || b.varies() {
        numbers(a).into_iter().zip(numbers(b)).for_each(|(a, b)| _ = a == b);
    }
}

/// Guards that values that are different here and of one form are different: one of their numbers is.
///
/// # Errors
/// A value that is too long to print.
fn stay_apart(outcomes: &[Outcome]) -> Result<(), Failure> {
    if !outcomes.iter().any(|outcome| outcome.value.varies()) {
        return Ok(());
    }
    // What two values can only be equal in where this is the same: everything but their real numbers.
    let mut forms: HashMap<String, Vec<Vec<Var>>> = HashMap::new();
    for outcome in outcomes {
        let form = repr(&outcome.value.convert(&|_: Var| 0.0))?;
        let alike = forms.entry(form).or_default();
        let reals = numbers(&outcome.value);
        for other in alike.iter() {
            let pairs = || reals.iter().zip(other).filter(|(a, b)| a.value() != b.value());
            let fixed = pairs().any(|(a, b)| !a.varies() && !b.varies());
            if let (false, Some((a, b))) = (fixed, pairs().next()) {
                let _ = a == b;
            }
        }
        alike.push(reals);
    }
    Ok(())
}
