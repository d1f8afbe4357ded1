//! The questions that machine code asks: choices and factors without an [`At`](super::answers::At), a value for the
//! distribution, and an instruction of the interpreter; and calls. What they do is what `question` does for the same site.

#![allow(unsafe_code)] // Machine code passes addresses.

use super::address::join;
use super::answers::{Answer, Answers};
use super::state::{NodeId, State};
use crate::code::FunctionId;
use crate::code::register::Kind;
use crate::code::routine::{Dropping, Exchange, NO_ANSWER, Questions};
use crate::native::kind_of_draws;
use crate::value::Value;
use niwaki_math::{Dist, Family, LastLogs, Scalar};
use std::marker::PhantomData;
use std::mem::ManuallyDrop;

/// The logarithms of each question for choices: most sites have the same parameters again.
pub(super) type LogsOfQuestions<S> = [LastLogs<S>; 4];

/// The questions for one kind of answers.
pub(super) struct QuestionsOf<S, A>(PhantomData<(S, A)>);

impl<S: Scalar, A: Answers<S>> QuestionsOf<S, A> {
    pub const ALL: &'static Questions = &Questions {
        gaussian: reals::<S, A, 0>,
        uniform: reals::<S, A, 1>,
        bernoulli: bernoulli::<S, A>,
        held: held::<S, A>,
        score: score::<S, A>,
        call: call::<S>,
    };
}

/// A key or a path from its halves.
#[inline(always)]
fn whole([lo, hi]: [u64; 2]) -> u128 {
    u128::from(lo) | u128::from(hi) << 64
}

/// Answers a choice from a distribution whose draws are single numbers, with logarithms by the number of the question.
///
/// # Safety
/// `exchange` with its answers of this type, and its [`LogsOfQuestions`], is lent to the code that asks.
#[inline(always)]
unsafe fn ask<S: Scalar, A: Answers<S>>(
    exchange: *mut Exchange,
    (lo, hi): (u64, u64),
    question: usize,
    dist: &Dist<S>,
) -> u64 {
    // SAFETY: as above.
    let exchange = unsafe { &mut *exchange };
    // SAFETY: as above.
    let answers = unsafe { &mut *exchange.answers.cast::<A>() };
    // SAFETY: as above.
    let logs = unsafe { &mut *exchange.logs.cast::<LogsOfQuestions<S>>() };
    let address = join(whole(exchange.path), whole([lo, hi]));
    let Some(value) = answers.drawn(address, dist, &mut logs[question]) else { return NO_ANSWER };
    exchange.choices += 1;
    let (word, kind) = match value {
        Value::Real(x) => (x.value().to_bits(), Kind::Real),
        Value::Int(n) => (n.cast_unsigned(), Kind::Int),
        Value::Bool(b) => (u64::from(b), Kind::Bool),
        _ => unreachable!("a draw is a number"),
    };
    exchange.answer = word;
    kind.mark()
}

/// The families of two real parameters that have a question, by its number.
const OF_REALS: [Family; 2] = [Family::Gaussian, Family::Uniform];

/// # Safety
/// As for [`ask`].
unsafe extern "C" fn reals<S: Scalar, A: Answers<S>, const QUESTION: usize>(
    exchange: *mut Exchange,
    lo: u64,
    hi: u64,
    a: f64,
    b: f64,
) -> u64 {
    let Some(dist) = Dist::of_reals(OF_REALS[QUESTION], S::from_f64(a), S::from_f64(b)) else {
        return NO_ANSWER;
    };
    // It holds numbers alone.
    let dist = ManuallyDrop::new(dist);
    // SAFETY: as above.
    unsafe { ask::<S, A>(exchange, (lo, hi), QUESTION, &dist) }
}

/// # Safety
/// As for [`ask`].
unsafe extern "C" fn bernoulli<S: Scalar, A: Answers<S>>(
    exchange: *mut Exchange,
    lo: u64,
    hi: u64,
    p: f64,
    _: f64,
) -> u64 {
    if !(0.0..=1.0).contains(&p) {
        return NO_ANSWER;
    }
    let dist = ManuallyDrop::new(Dist::Bernoulli { p: S::from_f64(p) });
    // SAFETY: as above.
    unsafe { ask::<S, A>(exchange, (lo, hi), 2, &dist) }
}

/// # Safety
/// As for [`ask`]; `value` points to a value that nobody changes meanwhile.
unsafe extern "C" fn held<S: Scalar, A: Answers<S>>(
    exchange: *mut Exchange,
    lo: u64,
    hi: u64,
    value: *const Value,
    mark: u64,
) -> u64 {
    // SAFETY: as above. Code is written for programs of `f64` alone, whose values are those of `S` then.
    let value = unsafe { &*value.cast::<Value<S>>() };
    match value {
        Value::Dist(dist) if kind_of_draws(dist.family()).is_some_and(|kind| kind.mark() == mark) => {
            // SAFETY: as above.
            unsafe { ask::<S, A>(exchange, (lo, hi), 3, dist) }
        }
        _ => NO_ANSWER,
    }
}

/// # Safety
/// As for [`ask`].
unsafe extern "C" fn score<S: Scalar, A: Answers<S>>(exchange: *mut Exchange, log: f64) {
    // SAFETY: as above.
    let exchange = unsafe { &mut *exchange };
    // SAFETY: as above.
    let answers = unsafe { &mut *exchange.answers.cast::<A>() };
    exchange.answer = u64::from(answers.scored(S::from_f64(log)) == Answer::Pause);
}

/// # Safety
/// As for [`ask`], with the state of the run; nobody holds a reference to its registers.
unsafe extern "C" fn call<S: Scalar>(
    exchange: *mut Exchange,
    lo: u64,
    hi: u64,
    to: u64,
    dropping: u64,
) -> *mut Value {
    // SAFETY: as above.
    let exchange = unsafe { &mut *exchange };
    // SAFETY: as above.
    let state = unsafe { &mut *exchange.state.cast::<State<S>>() };
    let (caller, dropping) = (NodeId(exchange.node), Dropping::of(dropping));
    if dropping.may_hand_over && state.is_deep() {
        return std::ptr::null_mut();
    }
    let path = join(whole(exchange.path), whole([lo, hi]));
    let Some(created) = state.reuse_node(FunctionId((to >> 32) as u32), caller, to as u32, path) else {
        return std::ptr::null_mut();
    };
    if dropping.registers > 0 {
        state.drop_before_return(caller, dropping.registers.into());
    }
    exchange.called = created.0;
    let at = state.nodes[created.0 as usize].registers as usize;
    state.registers.as_mut_ptr().wrapping_add(at).cast()
}
