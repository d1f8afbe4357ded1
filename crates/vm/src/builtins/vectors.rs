//! Points, directions and rotations. Coordinates are right-handed, angles are in radians.
//!
//! A tuple or list of two to four numbers is accepted as a vector. The rotation about a unit axis (x, y, z) by
//! an angle with cosine c and sine s is Rodrigues' formula, expanded: `(1 - c) a a^T + c I + s [a]_x`.

use std::sync::Arc;

use super::answer::{Answer, unfit};
use super::arithmetic::real;
use crate::fault::Fault;
use crate::value::index::{iter_get, iter_len};
use crate::value::{Scalar, Value, Vector};

/// Reads a vector from a vector, tuple or list of two to four numbers.
pub(super) fn parts<S: Scalar>(name: &str, value: &Value<S>) -> Result<Vector<S>, Fault> {
    if let Value::Vector(v) = value {
        return Ok(**v);
    }
    let sequence = matches!(value, Value::Tuple(_) | Value::List(_) | Value::Record(_));
    let count = if sequence { iter_len(value)? } else { 0 };
    if !(2..=4).contains(&count) {
        return Err(unfit(name, "a vector or 2 to 4 numbers in a tuple or list", value));
    }
    let mut components = [S::from_f64(0.0); 4];
    for (at, part) in components.iter_mut().enumerate().take(count) {
        *part = real(name, &iter_get(value, at))?;
    }
    Ok(Vector::new(&components[..count]))
}

/// Reads the three components of a vector.
pub(super) fn three<S: Scalar>(name: &str, value: &Value<S>) -> Result<[S; 3], Fault> {
    components(name, value)
}

/// Reads the two components of a vector.
pub(super) fn two<S: Scalar>(name: &str, value: &Value<S>) -> Result<[S; 2], Fault> {
    components(name, value)
}

fn components<S: Scalar, const N: usize>(name: &str, value: &Value<S>) -> Result<[S; N], Fault> {
    let v = parts(name, value)?;
    v.components().try_into().map_err(|_| {
        let count = v.components().len();
        Fault::type_mismatch(format!("`{name}` takes vectors of {N} components, found {count}"))
    })
}

fn product<S: Scalar>(name: &str, v: &[S], w: &[S]) -> Result<S, Fault> {
    if v.len() != w.len() {
        let (v, w) = (v.len(), w.len());
        return Err(Fault::type_mismatch(format!("`{name}` of vectors of {v} and {w} components")));
    }
    Ok(v.iter().zip(w).fold(S::from_f64(0.0), |sum, (x, y)| sum + *x * *y))
}

/// `vec(x, y)`, `vec(x, y, z)`, `vec(x, y, z, w)`; a `None` omits a component.
pub fn vec<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let numbers = args.iter().filter(|arg| !matches!(arg, Value::None));
    let (mut parts, mut count) = ([S::from_f64(0.0); 4], 0);
    for (part, arg) in parts.iter_mut().zip(numbers) {
        (*part, count) = (real("vec", arg)?, count + 1);
    }
    if count < 2 {
        return Err(Fault::bad_argument("`vec` takes 2 to 4 numbers"));
    }
    Ok(Value::vector(&parts[..count]))
}

/// The scalar product.
pub fn dot<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (v, w) = (parts("dot", &args[0])?, parts("dot", &args[1])?);
    product("dot", v.components(), w.components()).map(Value::Real)
}

/// The vector product.
pub fn cross<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let ([ax, ay, az], [bx, by, bz]) = (three("cross", &args[0])?, three("cross", &args[1])?);
    Ok(Value::vector(&[ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]))
}

pub(super) fn length<S: Scalar>(v: &[S]) -> S {
    v.iter().fold(S::from_f64(0.0), |sum, x| sum + *x * *x).sqrt()
}

/// The length of a vector.
pub fn norm<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Real(length(parts("norm", &args[0])?.components())))
}

fn unit<S: Scalar>(name: &str, v: &Vector<S>) -> Result<Vector<S>, Fault> {
    let length = length(v.components());
    if length.value() == 0.0 {
        return Err(Fault::division_by_zero(format!("`{name}`: a vector of length 0 has no direction")));
    }
    Ok(v.map(|x| x / length))
}

/// The vector of length one in the direction of a vector.
pub fn normalize<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let v = unit("normalize", &parts("normalize", &args[0])?)?;
    Ok(Value::Vector(Arc::new(v)))
}

/// The distance between two points.
pub fn distance<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let (v, w) = (parts("distance", &args[0])?, parts("distance", &args[1])?);
    let (v, w) = (v.components(), w.components());
    if v.len() != w.len() {
        let (v, w) = (v.len(), w.len());
        return Err(Fault::type_mismatch(format!("`distance` of points of {v} and {w} components")));
    }
    let squares = v.iter().zip(w).fold(S::from_f64(0.0), |sum, (x, y)| sum + (*x - *y) * (*x - *y));
    Ok(Value::Real(squares.sqrt()))
}

/// The rotation about an axis, row by row.
fn about<S: Scalar>(name: &str, axis: &Value<S>, angle: &Value<S>) -> Result<[S; 9], Fault> {
    three(name, axis)?;
    let axis = unit(name, &parts(name, axis)?)?;
    let &[x, y, z] = axis.components() else { return Err(unfit(name, "an axis", angle)) };
    let angle = real(name, angle)?;
    let (c, s) = (angle.cos(), angle.sin());
    let t = S::from_f64(1.0) - c;
    Ok([
        t * x * x + c,
        t * x * y - s * z,
        t * x * z + s * y,
        t * x * y + s * z,
        t * y * y + c,
        t * y * z - s * x,
        t * x * z - s * y,
        t * y * z + s * x,
        t * z * z + c,
    ])
}

/// `rotation(axis, angle)`.
pub fn rotation<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Rotation(Arc::new(about("rotation", &args[0], &args[1])?)))
}

/// `rotate(v, axis, angle)`.
pub fn rotate<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let v = three("rotate", &args[0])?;
    let r = about("rotate", &args[1], &args[2])?;
    let row = |at: usize| product("rotate", &r[at..at + 3], &v);
    Ok(Value::vector(&[row(0)?, row(3)?, row(6)?]))
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code};
    use crate::value::ops;

    fn v3(x: f64, y: f64, z: f64) -> V {
        V::vector(&[x, y, z])
    }

    fn near(a: &V, b: [f64; 3]) -> bool {
        let V::Vector(a) = a else { return false };
        a.components().iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15)
    }

    #[test]
    fn products_and_lengths_agree_with_their_definitions() {
        let (x, y) = (v3(1.0, 0.0, 0.0), V::tuple(vec![V::Int(0), V::Int(1), V::Int(0)]));
        assert_eq!(call("cross", &[x.clone(), y.clone()]), Ok(v3(0.0, 0.0, 1.0)));
        assert_eq!(call("dot", &[x.clone(), y.clone()]), Ok(V::real(0.0)));
        assert_eq!(call("distance", &[x.clone(), y]), Ok(V::real(2.0_f64.sqrt())));
        assert_eq!(call("norm", &[V::vector(&[3.0, 4.0])]), Ok(V::real(5.0)));
        assert_eq!(call("normalize", &[v3(0.0, 0.0, 2.0)]), Ok(v3(0.0, 0.0, 1.0)));
        assert_eq!(code("normalize", &[v3(0.0, 0.0, 0.0)]), "division-by-zero");
        assert_eq!(code("dot", &[x, V::vector(&[1.0, 2.0])]), "type-mismatch");
        assert_eq!(call("vec", &[V::Int(1), V::Int(2), V::None]), Ok(V::vector(&[1.0, 2.0])));
    }

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let quarter = V::real(std::f64::consts::FRAC_PI_2);
        let (x, z) = (v3(1.0, 0.0, 0.0), v3(0.0, 0.0, 5.0));
        assert!(near(&call("rotate", &[x.clone(), z.clone(), quarter.clone()]).unwrap(), [0.0, 1.0, 0.0]));
        let turn = call("rotation", &[z, quarter]).unwrap();
        assert!(near(&ops::mul(&turn, &x).unwrap(), [0.0, 1.0, 0.0]));
        let half = ops::mul(&turn, &turn).unwrap();
        assert!(near(&ops::mul(&half, &x).unwrap(), [-1.0, 0.0, 0.0]));
    }
}
