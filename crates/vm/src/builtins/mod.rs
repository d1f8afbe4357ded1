//! The built-in functions of the language, by number. There is one table, in the order of the files in this
//! folder; the words for shapes come last, from the table of solids.
//!
//! - [`arithmetic`]: conversions, rounding, small functions of numbers
//! - [`mathematics`]: Python's `math`
//! - [`soft`]: soft constraints and smooth bends
//! - [`sequences`]: making, ordering and folding sequences
//! - [`strings`]: text, formatting and methods of built-in values
//! - [`vectors`], [`frames`], [`shapes`]: points, directions, rotations, places to look from, solids
//! - [`mod@placed`]: frames in which calls are placed, and shapes in them
//! - [`colors`], [`polygons`]: colours and polygons of the plane
//! - [`dist`]: distributions from values
//!
//! The table also contains the operators (`add`, `lt`, `index`, ...), so that each of them can be a function
//! value.
//! All mathematics uses [`Scalar`], so that a recording scalar can record it.

pub mod answer;
pub mod arithmetic;
pub mod colors;
mod css;
pub mod dist;
pub mod frames;
pub mod mathematics;
pub mod placed;
pub mod polygons;
pub mod sequences;
pub mod shapes;
pub mod soft;
pub mod strings;
pub mod vectors;

use std::sync::Arc;

use niwaki_geom::TriMesh;

use crate::fault::Fault;
use crate::value::{Scalar, Value, index, ops};

pub use answer::Answer;
pub use dist::{make_dist, quick_dist};

/// A built-in function.
pub struct Builtin<S: Scalar = f64> {
    /// Its name in core form.
    pub name: &'static str,
    /// The minimum number of arguments.
    pub min_args: usize,
    /// The maximum number of arguments; `usize::MAX` for any number.
    pub max_args: usize,
    /// The implementation. It does not check the number of arguments: see [`Builtin::call`].
    pub run: fn(&[Value<S>]) -> Answer<S>,
}

impl<S: Scalar> Builtin<S> {
    /// Checks the number of arguments and runs the implementation.
    #[inline]
    pub fn call(&self, args: &[Value<S>]) -> Answer<S> {
        if (self.min_args..=self.max_args).contains(&args.len()) {
            return (self.run)(args);
        }
        Err(self.wrong_count(args.len()))
    }

    #[cold]
    fn wrong_count(&self, count: usize) -> Fault {
        let expected = match (self.min_args, self.max_args) {
            (least, usize::MAX) => format!("at least {least}"),
            (least, most) if least == most => least.to_string(),
            (least, most) => format!("{least} to {most}"),
        };
        let name = self.name;
        Fault::argument_count(format!("`{name}` takes {expected} arguments, found {count}"))
    }
}

/// The number of a built-in function.
pub fn builtin_id(name: &str) -> Option<u16> {
    Table::<f64>::ALL.iter().position(|builtin| builtin.name == name).map(|at| at as u16)
}

/// The built-in function with a number that [`builtin_id`] returned.
///
/// # Panics
/// The number does not belong to a function.
#[inline]
pub fn builtin<S: Scalar>(id: u16) -> &'static Builtin<S> {
    &Table::<S>::ALL[usize::from(id)]
}

/// Every built-in function, by number.
pub fn builtins<S: Scalar>() -> &'static [Builtin<S>] {
    Table::<S>::ALL
}

/// The word `mesh` for a mesh that was read before; the first two arguments are ignored.
pub fn placed_mesh<S: Scalar>(mesh: &Arc<TriMesh>, args: &[Value<S>]) -> Answer<S> {
    shapes::build::<S, niwaki_geom::solids::mesh::MeshWord<S>>(args, Some(mesh))
}

/// The type that carries the table of each scalar.
struct Table<S>(std::marker::PhantomData<S>);

const ANY: usize = usize::MAX;

macro_rules! table {
    ([$($file:ident $word:ident)*] $($name:literal $min:tt $max:tt $run:expr;)*) => {
        impl<S: Scalar> Table<S> {
            const ALL: &'static [Builtin<S>] = &[
                $(Builtin { name: $name, min_args: $min, max_args: $max, run: $run },)*
                $(shapes::builtin::<S, niwaki_geom::solids::$file::$word<S>>(),)*
            ];
        }
    };
}

/// The elements of the only argument, or the arguments themselves if there are several.
fn elements_or_arguments<S: Scalar>(args: &[Value<S>]) -> Result<Vec<Value<S>>, Fault> {
    match args {
        [sequence] => index::iter_all(sequence),
        many => Ok(many.to_vec()),
    }
}

niwaki_geom::words_of_solids! {
    table
    "add" 2 2 |a| ops::add(&a[0], &a[1]);
    "sub" 2 2 |a| ops::sub(&a[0], &a[1]);
    "mul" 2 2 |a| ops::mul(&a[0], &a[1]);
    "div" 2 2 |a| ops::div(&a[0], &a[1]);
    "floordiv" 2 2 |a| ops::floordiv(&a[0], &a[1]);
    "mod" 2 2 |a| ops::mod_(&a[0], &a[1]);
    "pow" 2 2 |a| ops::pow(&a[0], &a[1]);
    "neg" 1 1 |a| ops::neg(&a[0]);
    "pos" 1 1 |a| ops::pos(&a[0]);
    "not" 1 1 |a| ops::not_(&a[0]);
    "eq" 2 2 |a| ops::eq(&a[0], &a[1]);
    "ne" 2 2 |a| ops::ne(&a[0], &a[1]);
    "lt" 2 2 |a| ops::lt(&a[0], &a[1]);
    "le" 2 2 |a| ops::le(&a[0], &a[1]);
    "gt" 2 2 |a| ops::gt(&a[0], &a[1]);
    "ge" 2 2 |a| ops::ge(&a[0], &a[1]);
    "is_none" 1 1 |a| Ok(Value::Bool(matches!(a[0], Value::None)));
    "in" 2 2 |a| index::contains(&a[1], &a[0]).map(Value::Bool);
    "band" 2 2 |a| ops::band(&a[0], &a[1]);
    "bor" 2 2 |a| ops::bor(&a[0], &a[1]);
    "bxor" 2 2 |a| ops::bxor(&a[0], &a[1]);
    "invert" 1 1 |a| ops::invert(&a[0]);
    "shl" 2 2 |a| ops::shl(&a[0], &a[1]);
    "shr" 2 2 |a| ops::shr(&a[0], &a[1]);
    "index" 2 2 |a| index::index(&a[0], &a[1]);
    "slice" 4 4 |a| index::slice(&a[0], &a[1], &a[2], &a[3]);
    "append" 2 2 |a| ops::append(a[0].clone(), a[1].clone());
    "len" 1 1 |a| index::len(&a[0]).map(|len| Value::Int(len as i64));

    "int" 0 1 arithmetic::int;
    "float" 0 1 arithmetic::float;
    "bool" 0 1 |a| Ok(Value::Bool(a.first().map_or(Ok(false), ops::truth)?));
    "abs" 1 1 arithmetic::abs;
    "round" 1 2 arithmetic::round;
    "divmod" 2 2 |a| Ok(Value::tuple(vec![ops::floordiv(&a[0], &a[1])?, ops::mod_(&a[0], &a[1])?]));
    "clip" 3 3 arithmetic::clip;
    "lerp" 3 3 |a| ops::add(&a[0], &ops::mul(&ops::sub(&a[1], &a[0])?, &a[2])?);
    "sign" 1 1 arithmetic::sign;
    "smoothstep" 3 3 arithmetic::smoothstep;

    "sqrt" 1 1 mathematics::sqrt;
    "exp" 1 1 mathematics::exp;
    "log" 1 2 mathematics::log;
    "log2" 1 1 mathematics::log2;
    "log10" 1 1 mathematics::log10;
    "log1p" 1 1 mathematics::log1p;
    "expm1" 1 1 mathematics::expm1;
    "sin" 1 1 mathematics::sin;
    "cos" 1 1 mathematics::cos;
    "tan" 1 1 mathematics::tan;
    "asin" 1 1 mathematics::asin;
    "acos" 1 1 mathematics::acos;
    "atan" 1 1 mathematics::atan;
    "atan2" 2 2 mathematics::atan2;
    "sinh" 1 1 mathematics::sinh;
    "cosh" 1 1 mathematics::cosh;
    "tanh" 1 1 mathematics::tanh;
    "hypot" 1 ANY mathematics::hypot;
    "floor" 1 1 mathematics::floor;
    "ceil" 1 1 mathematics::ceil;
    "trunc" 1 1 mathematics::trunc;
    "fabs" 1 1 mathematics::fabs;
    "degrees" 1 1 mathematics::degrees;
    "radians" 1 1 mathematics::radians;
    "copysign" 2 2 mathematics::copysign;
    "fmod" 2 2 mathematics::fmod;
    "math_pow" 2 2 mathematics::math_pow;
    "isfinite" 1 1 mathematics::isfinite;
    "isnan" 1 1 mathematics::isnan;
    "isinf" 1 1 mathematics::isinf;
    "gcd" 0 ANY mathematics::gcd;
    "factorial" 1 1 mathematics::factorial;
    "comb" 2 2 mathematics::comb;
    "lgamma" 1 1 mathematics::lgamma;
    "erf" 1 1 mathematics::erf;

    "softeq" 3 3 soft::softeq;
    "soft_at_least" 3 3 soft::soft_at_least;
    "soft_at_most" 3 3 soft::soft_at_most;
    "smooth_max" 3 3 soft::smooth_max;
    "smooth_min" 3 3 soft::smooth_min;
    "smooth_abs" 2 2 soft::smooth_abs;

    "sum" 1 2 sequences::sum;
    "min" 1 ANY |a| sequences::extreme("min", &elements_or_arguments(a)?, None);
    "max" 1 ANY |a| sequences::extreme("max", &elements_or_arguments(a)?, None);
    "argmin_by" 2 2 |a| sequences::extreme("min", &index::iter_all(&a[0])?, Some(&index::iter_all(&a[1])?));
    "argmax_by" 2 2 |a| sequences::extreme("max", &index::iter_all(&a[0])?, Some(&index::iter_all(&a[1])?));
    "sorted" 1 2 sequences::sorted;
    "sorted_by" 2 3 sequences::sorted_by;
    "reversed" 1 1 sequences::reversed;
    "any" 1 1 |a| sequences::has(&a[0], true).map(Value::Bool);
    "all" 1 1 |a| Ok(Value::Bool(!sequences::has(&a[0], false)?));
    "enumerate" 1 2 sequences::enumerate;
    "zip" 0 ANY sequences::zip;
    "zip_strict" 0 ANY sequences::zip_strict;
    "range" 1 3 sequences::range;
    "linspace" 3 3 sequences::linspace;
    "to_list" 0 1 sequences::to_list;
    "to_tuple" 0 1 sequences::to_tuple;
    "options" 1 1 sequences::options;

    "str" 0 1 strings::str;
    "repr" 1 1 strings::repr;
    "format" 1 3 strings::format;
    "fstr" 0 ANY strings::fstr;
    "method" 2 ANY strings::method;

    "vec" 2 4 vectors::vec;
    "dot" 2 2 vectors::dot;
    "cross" 2 2 vectors::cross;
    "norm" 1 1 vectors::norm;
    "normalize" 1 1 vectors::normalize;
    "distance" 2 2 vectors::distance;
    "rotation" 2 2 vectors::rotation;
    "rotate" 3 3 vectors::rotate;
    "look" 2 3 frames::look;
    "check_look" 2 3 frames::check;
    "frame_in" 2 2 placed::frame_in;
    "placed" 2 2 placed::placed;
    "reflection" 1 1 placed::reflection;

    "rgb" 1 1 colors::parts;
    "worn" 5 5 shapes::worn;
    "hsv" 3 3 colors::hsv;
    "lab" 3 3 colors::lab;
    "to_hsv" 1 1 colors::to_hsv;
    "to_lab" 1 1 colors::to_lab;
    "color_difference" 2 2 colors::difference;

    "polygon_area" 1 1 polygons::area;
    "polygon_contains" 2 2 polygons::contains;
    "polygon_distance" 2 2 polygons::distance;
    "polygon_disc_area" 3 3 polygons::disc_area;
    "polygon_inset" 2 2 polygons::inset;
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub type V = Value<f64>;

    /// Calls a built-in function by name.
    pub fn call(name: &str, args: &[V]) -> Answer<f64> {
        let id = builtin_id(name).unwrap_or_else(|| panic!("`{name}` is in the table"));
        builtin::<f64>(id).call(args)
    }

    /// The code of the fault that a call raises.
    pub fn code(name: &str, args: &[V]) -> &'static str {
        call(name, args).map_or_else(|fault| fault.code, |value| panic!("`{name}` answers {value:?}"))
    }

    pub fn ints(items: impl IntoIterator<Item = i64>) -> V {
        V::list(items.into_iter().map(V::Int).collect())
    }

    pub fn reals(items: impl IntoIterator<Item = f64>) -> V {
        V::list(items.into_iter().map(V::Real).collect())
    }

    #[test]
    fn names_are_unique() {
        let all = builtins::<f64>();
        for (at, builtin) in all.iter().enumerate() {
            assert_eq!(builtin_id(builtin.name), Some(at as u16), "{}", builtin.name);
            assert!(builtin.min_args <= builtin.max_args);
        }
        assert_eq!(builtin_id("no-such"), None);
        assert_eq!(code("sqrt", &[]), "argument-count");
    }

    /// No function accepts a future that is not forced, except for the few that read no element.
    #[test]
    fn functions_refuse_futures() {
        let accepting = [
            "is_none",
            "append",
            "reversed",
            "to_list",
            "to_tuple",
            "options",
            "enumerate",
            "zip",
            "zip_strict",
            "method",
            "len",
        ];
        for future in [V::Future(1), V::returned(V::Int(1))] {
            let plain = [V::Int(1), V::real(0.5), V::str("x"), ints([3, 1]), V::vector(&[1.0, 0.0, 0.0])];
            for builtin in builtins::<f64>().iter().filter(|b| !accepting.contains(&b.name)) {
                for (count, other) in
                    (1..=builtin.max_args.min(4)).flat_map(|n| plain.iter().map(move |p| (n, p)))
                {
                    for at in 0..count {
                        let mut args = vec![other.clone(); count];
                        args[at] = future.clone();
                        let answer = builtin.call(&args);
                        assert!(answer.is_err(), "{}: {answer:?}", builtin.name);
                    }
                }
            }
        }
    }

    /// The claim: no arguments make a function panic. All functions are tried with arguments of all kinds, up
    /// to four.
    #[test]
    fn any_arguments_give_an_answer_or_a_fault() {
        let samples = [
            V::None,
            V::Bool(true),
            V::Int(-3),
            V::Int(i64::MIN),
            V::real(0.5),
            V::real(f64::NAN),
            V::real(f64::INFINITY),
            V::real(-1e300),
            V::str("x\u{e9}"),
            V::tuple(vec![V::real(1.0), V::Int(2), V::Int(3)]),
            ints([3, 1]),
            V::list(vec![]),
            V::vector(&[1.0, 0.0, 0.0]),
            V::Rotation(std::sync::Arc::new([1.0; 9])),
        ];
        let mut dice: u64 = 1;
        for builtin in builtins::<f64>() {
            for count in builtin.min_args..=builtin.max_args.min(4) {
                for _ in 0..400 {
                    let args: Vec<V> = (0..count)
                        .map(|_| {
                            dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                            samples[(dice >> 33) as usize % samples.len()].clone()
                        })
                        .collect();
                    if let Err(fault) = builtin.call(&args) {
                        assert!(Fault::CODES.contains(&fault.code), "{fault:?}");
                        assert!(!fault.message.is_empty());
                    }
                }
            }
        }
    }
}
