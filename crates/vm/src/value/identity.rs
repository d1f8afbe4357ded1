//! Identity of bits: the test that lets a run skip a call or stop.
//!
//! Two values are identical if they have the same tag and bits: NaN is identical to itself, but -0.0 is not to
//! 0.0, nor 1 to 1.0 or True. Aggregates are compared by pointer, then element by element on a stack of our
//! own, skipping the nodes that two lists share. "Different" is always a legal answer (the run then does more
//! work). So the test has a budget, and shapes and distributions may give up early. Python's `==` is another
//! test: see [`compare`](super::compare).

use std::ops::ControlFlow;
use std::sync::Arc;

use niwaki_geom::{Shape, Solid};

use super::{Dist, Draw, List, Param, Scalar, Value};

/// The most elements that one test of identity may visit before it returns "different".
pub const BUDGET: usize = 4096;

/// True when the two values have the same bits.
#[inline(always)]
pub fn identical<S: Scalar>(a: &Value<S>, b: &Value<S>) -> bool {
    match (a, b) {
        (Value::Int(a), Value::Int(b)) => a == b,
        (Value::Real(a), Value::Real(b)) => identical_scalar(*a, *b),
        _ => identical_slow(a, b),
    }
}

#[inline(never)]
fn identical_slow<S: Scalar>(a: &Value<S>, b: &Value<S>) -> bool {
    match glance(a, b) {
        Glance::Identical => true,
        Glance::Different => false,
        Glance::Look => identical_within(a, b, BUDGET),
    }
}

/// The result of a comparison without a visit to the parts.
#[derive(PartialEq)]
enum Glance {
    Identical,
    Different,
    Look,
}

impl From<bool> for Glance {
    fn from(identical: bool) -> Glance {
        if identical { Glance::Identical } else { Glance::Different }
    }
}

/// True when both scalars have the same bits.
#[inline]
fn identical_scalar<S: Scalar>(a: S, b: S) -> bool {
    a.value().to_bits() == b.value().to_bits()
}

fn identical_scalars<S: Scalar>(a: &[S], b: &[S]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| identical_scalar(*a, *b))
}

/// Shapes are small and hold no values; only a mesh is large enough to give up.
fn identical_shapes(a: &Shape, b: &Shape) -> bool {
    let is_another_mesh = |(a, b): (&Shape, &Shape)| match (a.solid(), b.solid()) {
        (Solid::Mesh(m), Solid::Mesh(n)) => !Arc::ptr_eq(m, n),
        _ => false,
    };
    !a.leaves().iter().zip(b.leaves()).any(is_another_mesh) && a == b
}

/// Distributions hold numbers and, in a mixture, further distributions (one level: mixtures are flat).
fn identical_dists<S: Scalar>(a: &Dist<S>, b: &Dist<S>) -> bool {
    let identical_draws = |a: &Draw<S>, b: &Draw<S>| match (a, b) {
        (Draw::Real(a), Draw::Real(b)) => identical_scalar(*a, *b),
        (Draw::Vector(a), Draw::Vector(b)) => identical_scalars(a, b),
        _ => a == b,
    };
    let identical_params = |(a, b): (&Param<S>, &Param<S>)| match (a, b) {
        (Param::Real(a), Param::Real(b)) => identical_scalar(*a, *b),
        (Param::Vector(a), Param::Vector(b)) => identical_scalars(a, b),
        (Param::Matrix(a), Param::Matrix(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| identical_scalars(a, b))
        }
        (Param::Dists(a), Param::Dists(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| identical_dists(a, b))
        }
        (Param::Draw(a), Param::Draw(b)) => identical_draws(a, b),
        _ => a == b,
    };
    if a.family() != b.family() {
        return false;
    }
    let (a, b) = (a.params(), b.params());
    a.len() == b.len() && a.iter().zip(&b).all(identical_params)
}

#[inline]
fn glance<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Glance {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => identical_scalar(*a, *b).into(),
        (Value::Int(a), Value::Int(b)) => (a == b).into(),
        (Value::Bool(a), Value::Bool(b)) => (a == b).into(),
        (Value::None, Value::None) | (Value::Unset, Value::Unset) => Glance::Identical,
        (Value::Future(a), Value::Future(b)) => (a == b).into(),
        (Value::Cell(a), Value::Cell(b)) => (a == b).into(),
        _ => glance_behind(a, b),
    }
}

/// Compares shared data without a visit to the parts.
fn glance_behind<S: Scalar>(a: &Value<S>, b: &Value<S>) -> Glance {
    let look_if = |same_pointer: bool, look: bool| match (same_pointer, look) {
        (true, _) => Glance::Identical,
        (false, true) => Glance::Look,
        (false, false) => Glance::Different,
    };
    match (a, b) {
        (Value::Str(a), Value::Str(b)) => (a == b).into(),
        (Value::Vector(a), Value::Vector(b)) => identical_scalars(a.components(), b.components()).into(),
        (Value::Rotation(a), Value::Rotation(b)) => identical_scalars(&a[..], &b[..]).into(),
        (Value::Range(a), Value::Range(b)) => ((a.start, a.stop, a.step) == (b.start, b.stop, b.step)).into(),
        (Value::Shape(a), Value::Shape(b)) => identical_shapes(a, b).into(),
        (Value::Dist(a), Value::Dist(b)) => (Arc::ptr_eq(a, b) || identical_dists(a, b)).into(),
        (Value::Tuple(a), Value::Tuple(b)) | (Value::Returned(a), Value::Returned(b)) => {
            look_if(a.ptr_eq(b), may_be_identical(a.items(), b.items()))
        }
        (Value::List(a), Value::List(b)) => look_if(
            a.ptr_eq(b),
            a.len() == b.len() && !a.get(0).zip(b.get(0)).is_some_and(|(a, b)| are_different_numbers(a, b)),
        ),
        (Value::Dict(a), Value::Dict(b)) => look_if(Arc::ptr_eq(a, b), a.len() == b.len()),
        (Value::Record(a), Value::Record(b)) => {
            look_if(Arc::ptr_eq(a, b), a.class.id == b.class.id && a.fields.len() == b.fields.len())
        }
        (Value::Function(a), Value::Function(b)) => {
            let memo = |f: &super::Closure<S>| f.memo.as_ref().map(|memo| memo.path);
            let alike = a.function == b.function && a.captures.len() == b.captures.len();
            look_if(Arc::ptr_eq(a, b), alike && memo(a) == memo(b))
        }
        _ => Glance::Different,
    }
}

/// Whether two values are different numbers: most lists and tuples that differ do so in the first element.
#[inline]
fn are_different_numbers<S: Scalar>(a: &Value<S>, b: &Value<S>) -> bool {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => !identical_scalar(*a, *b),
        (Value::Int(a), Value::Int(b)) => a != b,
        _ => false,
    }
}

/// Whether a quick look finds no difference between two tuples.
#[inline]
fn may_be_identical<S: Scalar>(a: &[Value<S>], b: &[Value<S>]) -> bool {
    a.len() == b.len() && !a.iter().zip(b).take(4).any(|(a, b)| are_different_numbers(a, b))
}

/// [`identical`] with a budget of elements.
#[cold]
pub fn identical_within<'a, S: Scalar>(a: &'a Value<S>, b: &'a Value<S>, mut budget: usize) -> bool {
    let mut work = vec![(a, b)];
    while let Some((a, b)) = work.pop() {
        // Only pairs that need a visit are on the stack.
        let mut meet = |a: &'a Value<S>, b: &'a Value<S>| -> ControlFlow<()> {
            if budget == 0 {
                return ControlFlow::Break(());
            }
            budget -= 1;
            match glance(a, b) {
                Glance::Identical => {}
                Glance::Different => return ControlFlow::Break(()),
                Glance::Look => work.push((a, b)),
            }
            ControlFlow::Continue(())
        };
        let mut meet_all =
            |a: &'a [Value<S>], b: &'a [Value<S>]| a.iter().zip(b).try_for_each(|(a, b)| meet(a, b));
        let outcome = match (a, b) {
            (Value::Tuple(a), Value::Tuple(b)) | (Value::Returned(a), Value::Returned(b)) => {
                meet_all(a.items(), b.items())
            }
            (Value::List(a), Value::List(b)) => List::visit_unshared(a, b, &mut |_, a, b| meet(a, b)),
            (Value::Record(a), Value::Record(b)) => meet_all(&a.fields, &b.fields),
            (Value::Function(a), Value::Function(b)) => meet_all(&a.captures, &b.captures),
            (Value::Dict(a), Value::Dict(b)) => match meet_all(a.keys(), b.keys()) {
                ControlFlow::Continue(()) => meet_all(a.values(), b.values()),
                stop => stop,
            },
            _ if glance(a, b) == Glance::Identical => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        if outcome.is_break() {
            return false;
        }
    }
    true
}

impl<S: Scalar> List<S> {
    /// The positions where two versions are not [`identical`], ascending: first those in the common length,
    /// then all positions that only the longer one has. The cost grows with the nodes that the versions do not
    /// share.
    pub fn diff(old: &List<S>, new: &List<S>) -> Vec<usize> {
        let mut changed = Vec::new();
        let _ = List::visit_unshared(old, new, &mut |at, a, b| {
            if !identical(a, b) {
                changed.push(at);
            }
            ControlFlow::<()>::Continue(())
        });
        changed.extend(old.len().min(new.len())..old.len().max(new.len()));
        changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::{Closure, Text};

    #[test]
    fn bits_decide_and_not_equality() {
        let identical = |a: Value, b: Value| identical(&a, &b);
        assert!(identical(Value::real(f64::NAN), Value::real(f64::NAN)));
        assert!(!identical(Value::real(-0.0), Value::real(0.0)));
        assert!(!identical(Value::Int(1), Value::real(1.0)));
        assert!(!identical(Value::Int(1), Value::Bool(true)));
        assert!(identical(Value::str("a"), Value::Str(Text::from("a"))));
        assert!(identical(Value::None, Value::None));
        assert!(!identical(Value::tuple(vec![]), Value::list(vec![])));
        assert!(identical(Value::tuple(vec![]), Value::tuple(vec![])));
    }

    #[test]
    fn aggregates_are_compared_inside() {
        let deep = |x: f64| {
            let list = Value::list((0..100).map(|i| Value::real(i as f64 * x)).collect());
            let closure = Closure { function: 3, memo: None, captures: vec![list, Value::str("k")] };
            Value::<f64>::tuple(vec![Value::Int(1), Value::Function(Arc::new(closure))])
        };
        assert!(identical(&deep(1.0), &deep(1.0)));
        assert!(!identical(&deep(1.0), &deep(-1.0)));
    }

    #[test]
    fn values_beyond_the_budget_differ_unless_shared() {
        let long = Value::<f64>::list((0..100_000).map(Value::Int).collect());
        let again = Value::list((0..100_000).map(Value::Int).collect());
        assert!(!identical(&long, &again));
        assert!(identical_within(&long, &again, usize::MAX));
        let Value::List(mut touched) = long.clone() else { unreachable!() };
        touched.set(5, Value::Int(5));
        assert!(identical(&long, &Value::List(touched)), "all but one leaf is shared");
    }

    #[test]
    fn a_chain_of_a_million_needs_no_host_stack() {
        let chain = || (0..1_000_000).fold(Value::<f64>::Int(1), |inner, _| Value::tuple(vec![inner]));
        let (a, b) = (chain(), chain());
        assert!(identical_within(&a, &b, usize::MAX));
        assert!(!identical(&a, &b));
    }
}
