//! The properties of registers that machine code knows: the register's name, and the kind of its value.

use crate::value::Value;
use niwaki_math::Scalar;

/// A register, as seen from the activation where the code begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Reg {
    /// A register of the activation.
    Node(u16),
    /// A register of the loop node above the activation.
    Outer(u16),
    /// A register of the machine, counted from the first register of the function where the code begins.
    Scratch(u32),
}

/// The kind of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// `None`.
    None,
    /// A variable that is not assigned yet.
    Unset,
    /// A truth value: one or zero in a register of the processor.
    Bool,
    /// A whole number.
    Int,
    /// A real number.
    Real,
    /// A range: its address, its first number and its step.
    Range,
    /// Any other shared value: the address of the register, or of the element, that holds it. The code reads
    /// the value and never changes it.
    Object(Form),
    /// A vector, tuple or range that the code made: one number for each part, without an object in memory so
    /// far. Registers with the same number hold the same value.
    Fresh { form: FreshForm, parts: Parts, number: u16 },
    /// Any other value that machine code never reads.
    Opaque,
}

/// The form of a value that the code made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum FreshForm {
    Vector,
    Tuple,
    /// A range: its first number, its end and its step.
    Range,
}

/// The kind of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Part {
    Bool,
    Int,
    Real,
}

/// The kinds of up to four parts.
pub(crate) type Parts = [Option<Part>; 4];

/// The form of a shared value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum Form {
    List = 32,
    Tuple,
    Record,
    Vector2,
    Vector3,
    Vector4,
    Other,
}

impl Form {
    /// The number of components of a vector; `None` for other forms.
    pub fn components(self) -> Option<u8> {
        match self {
            Form::Vector2 => Some(2),
            Form::Vector3 => Some(3),
            Form::Vector4 => Some(4),
            Form::List | Form::Tuple | Form::Record | Form::Other => None,
        }
    }
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
            Value::Vector(v) => Kind::Object(match v.components().len() {
                2 => Form::Vector2,
                3 => Form::Vector3,
                _ => Form::Vector4,
            }),
            Value::Str(_) | Value::Returned(_) | Value::Dict(_) => Kind::Object(Form::Other),
            Value::Rotation(_) | Value::Shape(_) => Kind::Object(Form::Other),
            Value::Dist(_) | Value::Function(_) => Kind::Object(Form::Other),
        }
    }

    /// Whether a value of this kind holds no shared data.
    pub fn is_plain(self) -> bool {
        !matches!(self, Kind::Range | Kind::Object(_) | Kind::Fresh { .. })
    }

    /// The number of the kind in results of functions that the code calls. For a plain value and a range it is the tag.
    pub fn mark(self) -> u64 {
        match self {
            Kind::None => 0,
            Kind::Bool => 1,
            Kind::Int => 2,
            Kind::Real => 3,
            Kind::Opaque => 4,
            Kind::Unset => 5,
            Kind::Range => 13,
            Kind::Fresh { .. } => 63,
            Kind::Object(form) => form as u64,
        }
    }

    /// The tags of values of this kind, a bit for each: see [`Value`].
    pub fn tags(self) -> u64 {
        match self {
            Kind::Opaque => 1 << 4 | 1 << 6,
            Kind::Object(Form::Tuple) => 1 << 9,
            Kind::Object(Form::List) => 1 << 10,
            Kind::Object(Form::Record) => 1 << 12,
            Kind::Object(Form::Vector2 | Form::Vector3 | Form::Vector4) => 1 << 14,
            Kind::Object(Form::Other) => 1 << 7 | 1 << 8 | 1 << 11 | 0b1111 << 15,
            tagged => 1 << tagged.mark(),
        }
    }

    /// Whether a value of this kind in the register may count as memory of the run.
    pub fn is_counted(self, reg: Reg) -> bool {
        let in_scratch = matches!(reg, Reg::Scratch(_));
        match self {
            Kind::Fresh { .. } => !in_scratch,
            Kind::Range => !in_scratch,
            Kind::Object(form) if form.components().is_some() => !in_scratch,
            other => !other.is_plain(),
        }
    }
}

/// The bits of the tags of values without shared data, and of numbers one larger.
pub(crate) const PLAIN_TAGS: i64 = 7;

/// Whether the value of a register counts as memory of the run: see [`Value::is_small`].
pub(crate) fn is_counted<S: Scalar>(reg: Reg, value: &Value<S>) -> bool {
    !(value.is_plain() || matches!(reg, Reg::Scratch(_)) && value.is_small())
}
