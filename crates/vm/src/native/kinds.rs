//! What machine code knows of a register: its name, and the kind of value that it holds.

use crate::value::Value;
use niwaki_math::Scalar;

/// A register, as seen from the activation where the code begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Reg {
    /// Of the activation.
    Node(u16),
    /// Of the loop node above it.
    Outer(u16),
    /// Of the machine, counted from the first one of the function where the code begins.
    Scratch(u32),
}

/// The kind of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// `None`.
    None,
    /// Not assigned yet.
    Unset,
    /// A truth value: one or zero in a register of the processor.
    Bool,
    /// A whole number.
    Int,
    /// A real number.
    Real,
    /// A range: its address, its first number and its step.
    Range,
    /// Anything shared: the address of the register, or of the element, that holds it. The code reads it and never
    /// changes it.
    Object(Form),
    /// Something else that machine code never looks at.
    Opaque,
}

/// The form of what is shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum Form {
    List = 16,
    Tuple,
    Record,
    Vector,
    Other,
}

impl Kind {
    /// The kind of a value.
    #[inline]
    pub fn of<S: Scalar>(value: &Value<S>) -> Kind {
        match value {
            Value::Real(_) => Kind::Real,
            Value::Int(_) => Kind::Int,
            Value::Bool(_) => Kind::Bool,
            Value::None => Kind::None,
            Value::Unset => Kind::Unset,
            Value::Future(_) | Value::Cell(_) => Kind::Opaque,
            Value::Range(_) => Kind::Range,
            Value::List(_) => Kind::Object(Form::List),
            Value::Tuple(_) => Kind::Object(Form::Tuple),
            Value::Record(_) => Kind::Object(Form::Record),
            Value::Vector(_) => Kind::Object(Form::Vector),
            Value::Str(_) | Value::Returned(_) | Value::Dict(_) => Kind::Object(Form::Other),
            Value::Rotation(_) | Value::Shape(_) => Kind::Object(Form::Other),
            Value::Dist(_) | Value::Function(_) => Kind::Object(Form::Other),
        }
    }

    /// Whether such a value holds nothing that is shared.
    pub fn is_plain(self) -> bool {
        !matches!(self, Kind::Range | Kind::Object(_))
    }

    /// How a function called by the code names the kind of what it gives.
    pub fn mark(self) -> u64 {
        match self {
            Kind::None => 0,
            Kind::Bool => 1,
            Kind::Int => 2,
            Kind::Real => 3,
            Kind::Unset => 4,
            Kind::Range => 5,
            Kind::Opaque => 6,
            Kind::Object(form) => form as u64,
        }
    }

    /// How many words it has where code and machine exchange values.
    pub fn words(self) -> usize {
        match self {
            Kind::None | Kind::Unset | Kind::Opaque => 0,
            Kind::Bool | Kind::Int | Kind::Real | Kind::Object(_) => 1,
            Kind::Range => 3,
        }
    }
}
