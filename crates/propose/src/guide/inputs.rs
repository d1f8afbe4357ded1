//! Values of variables as numbers for the network. How a variable becomes numbers is found from its values in traces, and
//! kept in the guide's file.
//!
//! | values | numbers |
//! | --- | --- |
//! | numbers, truth values | themselves |
//! | angles | sine and cosine |
//! | two or three numbers | themselves, and as a position (of unit length: a direction) in the local frame |
//! | tuples, records | those of their parts |
//! | lists | their length, and the numbers of the last element |
//! | texts, up to eight | one number for each, 1 for the present one |

use niwaki_geom::{Place, Vec3, vec3};
use niwaki_vm::value::{Record, Value};
use serde::{Deserialize, Serialize};

/// Most different texts of a variable.
const TEXTS: usize = 8;
/// Numbers beyond say no more, and must not become infinite in single precision.
const LARGEST: f64 = 1e6;

/// How the values of a variable become numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A number or a truth value.
    Number,
    /// A number that flows into an angle.
    Angle,
    /// Two or three numbers; all of unit length, so a direction, or a position.
    Point {
        /// How many.
        numbers: usize,
        /// Whether all were of unit length.
        unit: bool,
    },
    /// A tuple or a record: names and kinds of its parts.
    Parts(Vec<(String, Kind)>),
    /// A list: the kind of its last element.
    List(Box<Kind>),
    /// One of these texts.
    Texts(Vec<String>),
    /// Nothing that a network can read.
    Nothing,
}

/// Two or three numbers.
fn point(value: &Value) -> Option<(Vec3, usize)> {
    let of = |all: &[f64]| match all {
        [x, y] => Some((vec3(*x, *y, 0.0), 2)),
        [x, y, z] => Some((vec3(*x, *y, *z), 3)),
        _ => None,
    };
    match value {
        Value::Vector(vector) => of(vector.components()),
        Value::Tuple(tuple) if matches!(tuple.items().len(), 2 | 3) => {
            let all: Option<Vec<f64>> = tuple.items().iter().map(number).collect();
            of(&all?)
        }
        _ => None,
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Real(x) => Some(*x),
        Value::Int(n) => Some(*n as f64),
        _ => None,
    }
}

/// The place of a `Frame`.
pub fn place(frame: &Record) -> Option<Place> {
    let part = |name| frame.field(name).and_then(point).map(|(point, _)| point);
    Place::new(part("center")?, part("forward")?, part("up"))
}

impl Kind {
    /// The kind of one value.
    pub fn of(value: &Value, is_angle: bool) -> Kind {
        match value {
            Value::Real(_) | Value::Int(_) if is_angle => Kind::Angle,
            Value::Real(_) | Value::Int(_) | Value::Bool(_) => Kind::Number,
            Value::Str(text) => Kind::Texts(vec![text.to_string()]),
            Value::List(list) => {
                let last = list.len().checked_sub(1).and_then(|at| list.get(at));
                Kind::List(Box::new(last.map_or(Kind::Nothing, |value| Kind::of(value, false))))
            }
            Value::Record(record) => {
                let parts = record.class.fields.iter().zip(&record.fields);
                // The third direction of a frame says little beside the other two.
                let parts = parts.filter(|(name, _)| !(record.class.is_frame() && *name == "up"));
                Kind::Parts(parts.map(|(name, value)| (name.to_string(), Kind::of(value, false))).collect())
            }
            Value::Tuple(_) | Value::Vector(_) if let Some((at, numbers)) = point(value) => {
                Kind::Point { numbers, unit: (at.norm() - 1.0).abs() < 1e-6 }
            }
            Value::Tuple(tuple) => {
                let part = |(i, value): (usize, &Value)| (i.to_string(), Kind::of(value, false));
                Kind::Parts(tuple.items().iter().enumerate().map(part).collect())
            }
            _ => Kind::Nothing,
        }
    }

    /// The kind that two values have in common.
    pub fn join(self, other: Kind) -> Kind {
        match (self, other) {
            (Kind::Point { numbers: a, unit }, Kind::Point { numbers: b, unit: other }) if a == b => {
                Kind::Point { numbers: a, unit: unit && other }
            }
            (Kind::Parts(a), Kind::Parts(b))
                if a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a.0 == b.0) =>
            {
                Kind::Parts(a.into_iter().zip(b).map(|(a, b)| (a.0, a.1.join(b.1))).collect())
            }
            // The last element of an empty list is unknown.
            (Kind::List(a), Kind::List(b)) => Kind::List(Box::new(match (*a, *b) {
                (Kind::Nothing, kind) | (kind, Kind::Nothing) => kind,
                (a, b) => a.join(b),
            })),
            (Kind::Texts(mut a), Kind::Texts(b)) => {
                for text in b {
                    if !a.contains(&text) {
                        a.push(text);
                    }
                }
                a.sort();
                if a.len() > TEXTS { Kind::Nothing } else { Kind::Texts(a) }
            }
            (a, b) if a == b => a,
            _ => Kind::Nothing,
        }
    }

    /// How many numbers.
    #[expect(clippy::len_without_is_empty, reason = "the size of a description, not a collection")]
    pub fn len(&self) -> usize {
        match self {
            Kind::Number => 1,
            Kind::Angle => 2,
            Kind::Point { numbers, .. } => 2 * numbers,
            Kind::Parts(parts) => parts.iter().map(|(_, kind)| kind.len()).sum(),
            Kind::List(last) => 1 + last.len(),
            Kind::Texts(all) => all.len(),
            Kind::Nothing => 0,
        }
    }

    /// Names of the numbers.
    pub fn names(&self, name: &str, to: &mut Vec<String>) {
        match self {
            Kind::Number => to.push(name.to_string()),
            Kind::Angle => to.extend([format!("sin {name}"), format!("cos {name}")]),
            Kind::Point { numbers, .. } => {
                to.extend(["x", "y", "z"][..*numbers].iter().map(|axis| format!("{name}.{axis}")));
                let local = ["ahead", "aside", "above"];
                to.extend(local[..*numbers].iter().map(|axis| format!("{name} {axis}")));
            }
            Kind::Parts(parts) => {
                parts.iter().for_each(|(part, kind)| kind.names(&format!("{name}.{part}"), to));
            }
            Kind::List(last) => {
                to.push(format!("length of {name}"));
                last.names(&format!("{name}[-1]"), to);
            }
            Kind::Texts(all) => to.extend(all.iter().map(|text| format!("{name} == {text:?}"))),
            Kind::Nothing => {}
        }
    }

    /// Adds the numbers of a value, from input `first` on; none where it is of another kind.
    /// `element` says what an element of a list is.
    pub fn write<'v>(
        &self,
        value: &'v Value,
        place: &Place,
        first: u32,
        element: &impl Fn(&'v Value) -> &'v Value,
        to: &mut Vec<(u32, f32)>,
    ) {
        let mut put = |i: u32, x: f64| {
            if x.is_finite() {
                to.push((first + i, x.clamp(-LARGEST, LARGEST) as f32));
            }
        };
        match (self, value) {
            (Kind::Number, Value::Bool(truth)) => put(0, f64::from(u8::from(*truth))),
            (Kind::Number, _) => {
                if let Some(x) = number(value) {
                    put(0, x);
                }
            }
            (Kind::Angle, _) => {
                if let Some(x) = number(value) {
                    put(0, x.sin());
                    put(1, x.cos());
                }
            }
            (Kind::Point { numbers, unit }, _) => {
                let Some((at, components)) = point(value) else { return };
                if components != *numbers {
                    return;
                }
                let from = if *unit { at } else { at - place.position };
                let local = [from.dot(place.forward), from.dot(place.left()), from.dot(place.up)];
                for (i, x) in [at.x, at.y, at.z][..*numbers].iter().chain(&local[..*numbers]).enumerate() {
                    put(i as u32, *x);
                }
            }
            (Kind::Parts(parts), Value::Record(record)) => {
                let mut first = first;
                for (name, kind) in parts {
                    if let Some(value) = record.field(name) {
                        kind.write(value, place, first, element, to);
                    }
                    first += kind.len() as u32;
                }
            }
            (Kind::Parts(parts), Value::Tuple(tuple)) if tuple.items().len() == parts.len() => {
                let mut first = first;
                for ((_, kind), value) in parts.iter().zip(tuple.items()) {
                    kind.write(value, place, first, element, to);
                    first += kind.len() as u32;
                }
            }
            (Kind::List(last), Value::List(list)) => {
                put(0, list.len() as f64);
                if let Some(value) = list.len().checked_sub(1).and_then(|at| list.get(at)) {
                    last.write(element(value), place, first + 1, element, to);
                }
            }
            (Kind::Texts(all), Value::Str(text)) => {
                for (i, choice) in all.iter().enumerate() {
                    put(i as u32, f64::from(u8::from(choice.as_str() == &**text)));
                }
            }
            _ => {}
        }
    }
}
