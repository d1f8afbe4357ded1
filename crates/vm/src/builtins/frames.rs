//! Places to look from: the word `look`.
//!
//! A frame is a position and two unit directions at right angles. Points and directions in the plane are pairs:
//! their z is 0.

use super::answer::{Answer, unfit};
use super::vectors::{length, parts};
use crate::fault::Fault;
use crate::value::{Scalar, Value, Vector};

/// The cosine above which a direction is too close to the y axis for that axis to be up.
const STEEP: f64 = 0.9;

/// The sine below which two directions are parallel.
const PARALLEL: f64 = 1e-9;

/// A point or direction, and whether it is in the plane.
#[inline]
fn triple<S: Scalar>(value: &Value<S>) -> Result<([S; 3], bool), Fault> {
    // The pairs of flat models need no copy.
    if let Value::Tuple(pair) = value
        && let [Value::Real(x), Value::Real(y)] = pair.items()
    {
        return Ok(([*x, *y, S::from_f64(0.0)], true));
    }
    match parts("look", value).as_ref().map(Vector::components) {
        Ok(&[x, y]) => Ok(([x, y, S::from_f64(0.0)], true)),
        Ok(&[x, y, z]) => Ok(([x, y, z], false)),
        _ => Err(unfit("look", "points and directions of 2 or 3 numbers", value)),
    }
}

fn unit<S: Scalar>(v: [S; 3]) -> Result<[S; 3], Fault> {
    let length = length(&v);
    if length.value() == 0.0 {
        return Err(Fault::bad_argument("`look`: a direction has the length 0"));
    }
    Ok(v.map(|x| x / length))
}

/// `look(position, forward, up)`: the position and the two directions of the frame, as vectors of three
/// components.
pub fn look<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let vectors = frame(args)?.map(|v| Value::vector(&v));
    Ok(Value::tuple(vectors.into()))
}

/// Raises the faults of [`look`], for calls whose frame nobody reads.
pub fn check<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    frame(args).map(|_| Value::None)
}

fn frame<S: Scalar>(args: &[Value<S>]) -> Result<[[S; 3]; 3], Fault> {
    let (center, _) = triple(&args[0])?;
    let (forward, flat) = triple(&args[1])?;
    let forward = unit(forward)?;
    let axis = |at: usize| [0, 1, 2].map(|k| S::from_f64(if k == at { 1.0 } else { 0.0 }));
    let up = match args.get(2).filter(|up| !matches!(up, Value::None)) {
        Some(up) => unit(triple(up)?.0)?,
        None if flat || forward[1].abs() > S::from_f64(STEEP) => axis(2),
        None => axis(1),
    };
    let along = up[0] * forward[0] + up[1] * forward[1] + up[2] * forward[2];
    let across = [0, 1, 2].map(|k| up[k] - along * forward[k]);
    if length(&across).value() < PARALLEL {
        return Err(Fault::bad_argument("`look`: `up` lies along `forward`"));
    }
    Ok([center, forward, unit(across)?])
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code, reals};

    fn frame(args: &[V]) -> Vec<Vec<f64>> {
        let Ok(V::Tuple(parts)) = call("look", args) else { panic!("no frame") };
        let numbers = |part: &V| match part {
            V::Vector(v) => v.components().to_vec(),
            other => panic!("{other:?}"),
        };
        parts.items().iter().map(numbers).collect()
    }

    #[test]
    fn up_has_a_default_and_is_perpendicular() {
        let (plane, space) = (reals([1.0, 2.0]), reals([1.0, 2.0, 3.0]));
        let flat = frame(&[plane.clone(), reals([0.0, 2.0])]);
        assert_eq!(flat, [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let level = frame(&[space.clone(), reals([3.0, 0.0, 0.0])]);
        assert_eq!(level, [[1.0, 2.0, 3.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let steep = frame(&[space.clone(), reals([0.0, -2.0, 0.0]), V::None]);
        assert_eq!(steep, [[1.0, 2.0, 3.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
        let leaning = frame(&[space.clone(), reals([0.0, 0.0, 5.0]), reals([0.0, 7.0, 7.0])]);
        assert!((leaning[2][1] - 1.0).abs() < 1e-15 && leaning[2][2].abs() < 1e-15, "{leaning:?}");
        assert_eq!(code("look", &[plane.clone(), reals([0.0, 0.0])]), "bad-argument");
        assert_eq!(code("look", &[space.clone(), plane.clone(), reals([2.0, 4.0, 0.0])]), "bad-argument");
        assert_eq!(code("look", &[space, reals([1.0, 0.0, 0.0, 0.0])]), "type-mismatch");
        assert_eq!(code("look", &[V::real(1.0), plane]), "type-mismatch");
    }
}
