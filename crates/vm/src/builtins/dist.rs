//! Distributions from values.

use crate::fault::Fault;
use crate::value::draw::{elements, reals};
use crate::value::{Dist, Family, Param, Scalar, Value, iter_get};

/// The most components of one mixture after nested mixtures are flattened.
const MAX_COMPONENTS: usize = 1 << 16;

/// A distribution of a family, from its parameters in order.
#[inline]
pub fn make_dist<S: Scalar>(family: Family, args: &[Value<S>]) -> Result<Dist<S>, Fault> {
    let param = |at: usize| to_param(family, at, &args[at]);
    let result = match (family, args.len()) {
        (Family::Mixture, 2) => Dist::new(family, &flattened([param(0)?, param(1)?])?),
        // One or two parameters, the usual cases, need no allocation.
        (_, 1) => Dist::new(family, &[param(0)?]),
        (_, 2) => Dist::new(family, &[param(0)?, param(1)?]),
        (_, count) => Dist::new(family, &(0..count).map(param).collect::<Result<Vec<_>, _>>()?),
    };
    result.map_err(|error| {
        let fault = Fault::bad_parameter(error.to_string());
        if error.out_of_range { fault.of_call(family.name(), args) } else { fault }
    })
}

/// The distribution of two numbers in order, for the most frequent families. `None` for any other family, for
/// values that are not numbers, and for numbers that do not fit: [`make_dist`] then raises the fault.
#[inline(always)]
pub fn quick_dist<S: Scalar>(family: Family, a: &Value<S>, b: &Value<S>) -> Option<Dist<S>> {
    let number = |value: &Value<S>| match value {
        Value::Real(x) => Some(*x),
        Value::Int(n) => Some(S::from_f64(*n as f64)),
        _ => None,
    };
    Dist::of_reals(family, number(a)?, number(b)?)
}

/// Converts a parameter to the form that families read: numbers, rows of numbers, distributions.
#[inline]
fn to_param<S: Scalar>(family: Family, at: usize, value: &Value<S>) -> Result<Param<S>, Fault> {
    if family == Family::Delta {
        return value.draw().map(Param::Draw).ok_or_else(|| unusable(family, at, value));
    }
    match value {
        Value::Real(x) => Ok(Param::Real(*x)),
        Value::Int(n) => Ok(Param::Int(*n)),
        Value::Bool(b) => Ok(Param::Bool(*b)),
        Value::Vector(v) => Ok(Param::Vector(v.components().to_vec())),
        Value::Rotation(r) => Ok(Param::Matrix(r.chunks(3).map(<[S]>::to_vec).collect())),
        Value::Tuple(_) | Value::List(_) | Value::Record(_) => {
            to_sequence_param(value).ok_or_else(|| unusable(family, at, value))
        }
        _ => Err(unusable(family, at, value)),
    }
}

#[cold]
fn unusable<S: Scalar>(family: Family, at: usize, value: &Value<S>) -> Fault {
    let name = family.parameters().get(at).unwrap_or(&"a parameter");
    let mut message = format!("`{name}` of {} cannot be {}", family.name(), value.described());
    if let Value::Tuple(_) | Value::List(_) = value {
        message.push_str(" of such elements");
    }
    Fault::bad_parameter(message)
}

fn to_sequence_param<S: Scalar>(value: &Value<S>) -> Option<Param<S>> {
    match iter_get(value, 0) {
        Value::Dist(_) => {
            let dist = |item| if let Value::Dist(dist) = item { Some((*dist).clone()) } else { None };
            elements(value)?.map(dist).collect::<Option<_>>().map(Param::Dists)
        }
        Value::Tuple(_) | Value::List(_) | Value::Vector(_) => {
            elements(value)?.map(|row| reals(&row)).collect::<Option<_>>().map(Param::Matrix)
        }
        _ => reals(value).map(Param::Vector),
    }
}

/// Flattens mixtures inside of a mixture, with the product of the weights. The distribution stays the same, but
/// it is never nested, so that scoring and dropping it need no host stack.
fn flattened<S: Scalar>(params: [Param<S>; 2]) -> Result<[Param<S>; 2], Fault> {
    let [Param::Vector(weights), Param::Dists(dists)] = &params else { return Ok(params) };
    if weights.len() != dists.len() || !dists.iter().any(|dist| matches!(dist, Dist::Mixture(_))) {
        return Ok(params);
    }
    let (mut flat_weights, mut flat) = (Vec::new(), Vec::new());
    for (weight, dist) in weights.iter().zip(dists) {
        match dist {
            Dist::Mixture(inner) => {
                let inner_weights = inner.weights.unscaled();
                let total = inner_weights.iter().fold(S::from_f64(0.0), |total, w| total + *w);
                flat_weights.extend(inner_weights.iter().map(|w| *weight * *w / total));
                flat.extend(inner.components.iter().cloned());
            }
            other => {
                flat_weights.push(*weight);
                flat.push(other.clone());
            }
        }
        if flat.len() > MAX_COMPONENTS {
            return Err(Fault::memory_budget(format!(
                "a mixture of more than {MAX_COMPONENTS} distributions"
            )));
        }
    }
    Ok([Param::Vector(flat_weights), Param::Dists(flat)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtins::tests::{V, ints, reals};
    use crate::value::Draw;
    use std::sync::Arc;

    fn fault(family: Family, args: &[V]) -> (&'static str, String) {
        let fault = make_dist(family, args).expect_err("a parameter is wrong");
        (fault.code, fault.message.clone())
    }

    #[test]
    fn parameters_are_read_from_any_sequence() {
        assert_eq!(
            make_dist(Family::Gaussian, &[V::Int(0), V::real(2.0)]),
            Ok(Dist::Gaussian { mean: 0.0, sd: 2.0 })
        );
        let weights = make_dist(Family::Categorical, &[ints([1, 3])]).expect("two weights");
        assert!((weights.log_density(&Draw::Int(1)) - 0.75_f64.ln()).abs() < 1e-15);
        let square = V::list(vec![reals([1.0, 0.0]), V::tuple(vec![V::Int(0), V::Int(1)])]);
        assert!(make_dist(Family::MultivariateGaussian, &[V::vector(&[0.0, 0.0]), square]).is_ok());
        let delta = make_dist(Family::Delta, &[reals([1.0])]).expect("a vector");
        assert_eq!(delta, Dist::Delta(Draw::Vector([1.0].into())));
    }

    #[test]
    fn quick_dist_and_make_dist_agree() {
        let numbers = [-1.0, 0.0, 0.5, 2.0, f64::MAX, f64::MIN, f64::INFINITY, f64::NAN];
        for family in [Family::Gaussian, Family::LogNormal, Family::Uniform, Family::Gamma, Family::Beta] {
            for (a, b) in numbers.iter().flat_map(|a| numbers.iter().map(move |b| (*a, *b))) {
                let (a, b) = (V::Real(a), V::Real(b));
                let quick = quick_dist(family, &a, &b);
                assert_eq!(quick, make_dist(family, &[a, b]).ok());
            }
        }
        let whole = quick_dist(Family::Gaussian, &V::Int(1), &V::Int(2));
        assert_eq!(whole, make_dist(Family::Gaussian, &[V::Int(1), V::Int(2)]).ok());
        assert_eq!(quick_dist::<f64>(Family::Gaussian, &V::None, &V::Int(2)), None);
    }

    #[test]
    fn messages_name_the_wrong_parameter() {
        let (code, message) = fault(Family::Gaussian, &[V::Int(0), V::real(-1.0)]);
        assert_eq!(code, "bad-parameter");
        assert_eq!(message, "`sd` of gaussian is -1.0, expected a finite number above zero");
        assert_eq!(fault(Family::Gaussian, &[V::Int(0), V::None]).1, "`sd` of gaussian cannot be None");
        let words = V::list(vec![V::str("a")]);
        assert_eq!(
            fault(Family::Categorical, &[words]).1,
            "`weights` of categorical cannot be a list of such elements"
        );
        assert_eq!(fault(Family::Gaussian, &[]).0, "bad-parameter");
    }

    #[test]
    fn mixtures_of_mixtures_are_flat_and_bounded() {
        let gaussian = |mean: f64| V::Dist(Arc::new(Dist::Gaussian { mean, sd: 1.0 }));
        let mix = |a: V, b: V| make_dist(Family::Mixture, &[ints([1, 3]), V::list(vec![a, b])]);
        let inner = mix(gaussian(0.0), gaussian(1.0)).expect("two components");
        let outer = mix(V::Dist(Arc::new(inner.clone())), gaussian(2.0)).expect("three components");
        let x = Draw::Real(0.3);
        let by_hand = 0.25 * inner.log_density(&x).exp()
            + 0.75 * Dist::Gaussian { mean: 2.0, sd: 1.0 }.log_density(&x).exp();
        assert!((outer.log_density(&x).exp() - by_hand).abs() < 1e-15);
        let mut doubled = inner;
        for _ in 0..40 {
            let twice = V::Dist(Arc::new(doubled.clone()));
            match mix(twice.clone(), twice) {
                Ok(dist) => doubled = dist,
                Err(fault) => return assert_eq!(fault.code, "memory-budget"),
            }
        }
        panic!("a mixture of 2^41 components was accepted");
    }
}
