//! Values in the processor.

use crate::code::register::{Form, FreshForm, Kind, Part};
use crate::value::Value as Model;
use niwaki_native::codegen::ir::Value;

/// A value in the processor.
#[derive(Clone, Copy, Debug)]
pub(super) enum Typed {
    None,
    Unset,
    Opaque,
    Bool(Value),
    Int(Value),
    Real(Value),
    Range { object: Value, first: Value, step: Value },
    Object(Value, Form),
    Fresh { form: FreshForm, parts: [Option<Number>; 4], number: u16 },
}

/// A number in the processor.
#[derive(Clone, Copy, Debug)]
pub(super) enum Number {
    Bool(Value),
    Int(Value),
    Real(Value),
}

impl Number {
    pub(super) fn part(self) -> Part {
        match self {
            Number::Bool(_) => Part::Bool,
            Number::Int(_) => Part::Int,
            Number::Real(_) => Part::Real,
        }
    }

    pub(super) fn value(self) -> Value {
        match self {
            Number::Bool(x) | Number::Int(x) | Number::Real(x) => x,
        }
    }
}

impl From<Number> for Typed {
    fn from(number: Number) -> Typed {
        match number {
            Number::Bool(x) => Typed::Bool(x),
            Number::Int(x) => Typed::Int(x),
            Number::Real(x) => Typed::Real(x),
        }
    }
}

impl Typed {
    pub(super) fn number(self) -> Option<Number> {
        match self {
            Typed::Bool(x) => Some(Number::Bool(x)),
            Typed::Int(x) => Some(Number::Int(x)),
            Typed::Real(x) => Some(Number::Real(x)),
            _ => None,
        }
    }

    pub(super) fn kind(&self) -> Kind {
        match self {
            Typed::None => Kind::None,
            Typed::Unset => Kind::Unset,
            Typed::Opaque => Kind::Opaque,
            Typed::Bool(_) => Kind::Bool,
            Typed::Int(_) => Kind::Int,
            Typed::Real(_) => Kind::Real,
            Typed::Range { .. } => Kind::Range,
            Typed::Object(_, form) => Kind::Object(*form),
            Typed::Fresh { form, parts, number } => {
                Kind::Fresh { form: *form, parts: parts.map(|part| part.map(Number::part)), number: *number }
            }
        }
    }
}

/// An operand, with a value that it had when the code was written: this sample predicts the kinds of elements.
#[derive(Clone, Copy)]
pub(super) struct TypedOperand<'v> {
    pub typed: Typed,
    pub sample: Option<&'v Model>,
}
