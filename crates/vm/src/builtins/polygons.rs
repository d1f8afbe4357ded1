//! Polygons of the plane: sequences of three or more points.

use super::answer::{Answer, unfit};
use super::vectors::parts;
use crate::builtins::arithmetic::real;
use crate::fault::Fault;
use crate::value::index::{iter_get, iter_len};
use crate::value::{Scalar, Value};
use niwaki_math::polygon::{self, Point};

/// Reads a point of two numbers.
fn point<S: Scalar>(name: &str, value: &Value<S>) -> Result<Point<S>, Fault> {
    let v = parts(name, value)?;
    v.components().try_into().map_err(|_| {
        let count = v.components().len();
        Fault::type_mismatch(format!("`{name}` takes points of 2 numbers, found {count}"))
    })
}

/// Reads the corners of a polygon.
fn corners<S: Scalar>(name: &str, value: &Value<S>) -> Result<Vec<Point<S>>, Fault> {
    if !matches!(value, Value::Tuple(_) | Value::List(_)) {
        return Err(unfit(name, "a polygon: a list or tuple of points", value));
    }
    let count = iter_len(value)?;
    if count < 3 {
        return Err(Fault::bad_argument(format!(
            "a polygon for `{name}` has {count} corners, expected at least 3"
        )));
    }
    (0..count).map(|at| point(name, &iter_get(value, at))).collect()
}

/// `polygon_area(polygon)`.
pub fn area<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::Real(polygon::area(&corners("polygon_area", &args[0])?)))
}

/// `polygon_contains(polygon, point)`.
pub fn contains<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let name = "polygon_contains";
    Ok(Value::Bool(polygon::contains(&corners(name, &args[0])?, point(name, &args[1])?)))
}

/// `polygon_distance(polygon, point)`: the distance to the boundary.
pub fn distance<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let name = "polygon_distance";
    Ok(Value::Real(polygon::boundary_distance(&corners(name, &args[0])?, point(name, &args[1])?)))
}

/// `polygon_disc_area(polygon, center, radius)`.
pub fn disc_area<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let name = "polygon_disc_area";
    let (corners, center) = (corners(name, &args[0])?, point(name, &args[1])?);
    Ok(Value::Real(polygon::disc_area(&corners, center, real(name, &args[2])?)))
}

/// `polygon_inset(polygon, by)`.
pub fn inset<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let name = "polygon_inset";
    let (corners, by) = (corners(name, &args[0])?, real(name, &args[1])?);
    match polygon::inset(&corners, by) {
        Some(inset) => Ok(Value::list(inset.iter().map(|corner| Value::vector(corner)).collect())),
        None => Err(Fault::bad_argument(format!(
            "moved inwards by {}, an edge of the polygon vanishes",
            by.value()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code};

    fn square() -> V {
        let corner = |x: i64, y: i64| V::tuple(vec![V::Int(x), V::Int(y)]);
        V::list(vec![corner(0, 0), corner(2, 0), corner(2, 2), corner(0, 2)])
    }

    #[test]
    fn polygons_are_lists_of_points() {
        assert_eq!(call("polygon_area", &[square()]), Ok(V::real(4.0)));
        assert_eq!(call("polygon_contains", &[square(), V::vector(&[1.0, 1.0])]), Ok(V::Bool(true)));
        assert_eq!(call("polygon_distance", &[square(), V::vector(&[1.0, 5.0])]), Ok(V::real(3.0)));
        let inner = call("polygon_inset", &[square(), V::real(0.5)]).unwrap();
        assert_eq!(call("polygon_area", &[inner]), Ok(V::real(1.0)));
        assert_eq!(code("polygon_inset", &[square(), V::Int(1)]), "bad-argument");
        assert_eq!(code("polygon_area", &[V::list(vec![])]), "bad-argument");
        assert_eq!(code("polygon_area", &[V::Int(1)]), "type-mismatch");
        assert_eq!(code("polygon_distance", &[square(), V::vector(&[1.0, 1.0, 1.0])]), "type-mismatch");
    }
}
