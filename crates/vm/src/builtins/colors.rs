//! Colours: vectors of three sRGB components, converted from and to HSV and CIELAB.

use super::answer::{Answer, unfit};
use super::arithmetic::real;
use super::css;
use super::vectors::three;
use crate::fault::Fault;
use crate::value::{Scalar, Value};
use niwaki_math::color;

fn numbers<S: Scalar>(name: &str, args: &[Value<S>]) -> Result<[S; 3], Fault> {
    Ok([real(name, &args[0])?, real(name, &args[1])?, real(name, &args[2])?])
}

/// Reads a colour: three numbers, or a name of CSS.
pub(super) fn rgb<S: Scalar>(name: &str, value: &Value<S>) -> Result<[S; 3], Fault> {
    let Value::Str(text) = value else { return three(name, value) };
    match css::named(text) {
        Some(parts) => Ok(parts.map(S::from_f64)),
        None if text.starts_with('#') => {
            Err(unfit(name, "a colour of 3 or 6 digits such as \"#c83c1e\"", value))
        }
        None => {
            let (text, near) = (&**text, css::nearest(text));
            Err(Fault::type_mismatch(format!(
                "`{name}`: no colour is called \"{text}\"; did you mean \"{near}\"?"
            )))
        }
    }
}

/// `rgb(color)`: the three parts of a colour.
pub fn parts<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::vector(&rgb("rgb", &args[0])?))
}

/// `hsv(h, s, v)`: a colour from hue in turns, saturation and value.
pub fn hsv<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::vector(&color::srgb_from_hsv(numbers("hsv", args)?)))
}

/// `lab(l, a, b)`: a colour from its CIELAB coordinates.
pub fn lab<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::vector(&color::srgb_from_lab(numbers("lab", args)?)))
}

/// `to_hsv(color)`: hue in turns, saturation and value.
pub fn to_hsv<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::vector(&color::hsv_from_srgb(rgb("to_hsv", &args[0])?)))
}

/// `to_lab(color)`: CIELAB coordinates.
pub fn to_lab<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    Ok(Value::vector(&color::lab_from_srgb(rgb("to_lab", &args[0])?)))
}

/// `color_difference(a, b)`: CIEDE2000.
pub fn difference<S: Scalar>(args: &[Value<S>]) -> Answer<S> {
    let side = |at: usize| rgb("color_difference", &args[at]).map(color::lab_from_srgb);
    Ok(Value::Real(color::difference(side(0)?, side(1)?)))
}

#[cfg(test)]
mod tests {
    use crate::builtins::tests::{V, call, code};

    #[test]
    fn colours_are_vectors() {
        let red = call("hsv", &[V::Int(0), V::Int(1), V::Int(1)]).unwrap();
        assert_eq!(red, V::vector(&[1.0, 0.0, 0.0]));
        assert_eq!(call("to_hsv", std::slice::from_ref(&red)), Ok(V::vector(&[0.0, 1.0, 1.0])));
        assert_eq!(call("color_difference", &[red.clone(), red.clone()]), Ok(V::real(0.0)));
        assert_eq!(call("rgb", &[V::str("red")]), Ok(red.clone()));
        assert_eq!(call("to_hsv", &[V::str("#F00")]), Ok(V::vector(&[0.0, 1.0, 1.0])));
        assert_eq!(code("rgb", &[V::str("oak")]), "type-mismatch");
        assert_eq!(code("to_lab", &[V::vector(&[1.0, 0.0])]), "type-mismatch");
        assert_eq!(code("hsv", &[red, V::Int(1), V::Int(1)]), "type-mismatch");
    }
}
