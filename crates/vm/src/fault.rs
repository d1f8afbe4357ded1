//! A fault: why a run stopped, as data.
//!
//! The code is the key of the message table on the Python side; the message is complete and uses the model's
//! terms ("list index 5 is out of range: the list has 3 elements"). The machine adds the model's own call
//! stack, which says where the fault happened.
//!
//! A fault is one pointer wide, so that `Result<Value, Fault>` is no larger than a value: every arithmetic
//! instruction returns one.

use crate::refusal::{Expected, Refusal};
use std::fmt;
use std::ops::Deref;

/// Why a run stopped. Its fields are read through [`Details`].
#[derive(Clone, PartialEq)]
pub struct Fault(Box<Details>);

/// The fields of a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Details {
    /// Kebab-case key of the kind of fault (`list-index`, `division-by-zero`, ...).
    pub code: &'static str,
    /// One sentence, lower case, with the actual and the expected value.
    pub message: String,
    /// The name that the message is about, if the message table looks it up: an address, a pattern.
    pub subject: Option<String>,
    /// A hint for a correction, if there is one.
    pub help: Option<String>,
    /// The call that has no result for its arguments and so makes the run *invalid*: see
    /// [`crate::machine::invalid`]. `None` for faults that do not make a run invalid.
    pub invalid: Option<InvalidCall>,
    /// The value of the setting `subject` that is refused, where that is the fault.
    pub refusal: Option<Refusal>,
}

/// A call of a distribution, a shape or a host function that has no result, although its arguments are of the
/// right kinds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidCall {
    /// The name of the distribution's family, of the shape or of the function.
    pub name: String,
    /// The call as text, its arguments shortened where they are long.
    pub text: String,
}

impl Deref for Fault {
    type Target = Details;
    fn deref(&self) -> &Details {
        &self.0
    }
}

impl fmt::Debug for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.code, self.message)
    }
}

impl std::error::Error for Fault {}

macro_rules! kinds {
    ($($(#[$doc:meta])* $name:ident = $code:literal;)*) => {
        impl Fault {
            $($(#[$doc])*
            #[cold]
            pub fn $name(message: impl Into<String>) -> Fault { Fault::new($code, message) })*

            /// All codes that a pure operation can raise.
            pub const CODES: &'static [&'static str] = &[$($code),*];
        }
    };
}

kinds! {
    /// An operation has an operand of a kind that it does not accept.
    type_mismatch = "type-mismatch";
    /// An operation reads a future that was not forced.
    not_forced = "future-not-forced";
    /// A position outside a list, tuple, string, range or vector.
    list_index = "list-index";
    /// `/`, `//`, `%` or a negative power of zero.
    division_by_zero = "division-by-zero";
    /// A whole number does not fit into 64 bits.
    integer_overflow = "integer-overflow";
    /// A real number is outside the range of floats where Python raises `OverflowError`.
    float_overflow = "float-overflow";
    /// A value of the right kind that the operation refuses.
    bad_argument = "bad-argument";
    /// More or fewer arguments than the operation takes.
    argument_count = "argument-count";
    /// `a, b = xs` with another number of elements.
    unpack_length = "unpack-length";
    /// A distribution has a parameter outside of its range.
    bad_parameter = "bad-parameter";
    /// A shape has a measure outside of its range.
    bad_shape = "bad-shape";
    /// A value is larger than a run may hold.
    memory_budget = "memory-budget";
    /// A comparison visits more elements than a run may spend on one step.
    step_budget = "step-budget";
    /// A dictionary has no such key.
    missing_key = "missing-key";
    /// A record or vector has no such field.
    missing_field = "missing-field";
    /// A built-in value has no such method.
    missing_method = "missing-method";
    /// A call of something that is not a function.
    not_callable = "not-callable";
    /// A mathematical function outside its domain.
    math_domain = "math-domain";
    /// Text that is not a number, or that a method did not find.
    bad_text = "bad-text";
    /// A format specification that does not parse or does not fit the value.
    bad_format = "bad-format";
    /// A list method looked for an element that does not exist.
    missing_element = "missing-element";
}

impl Fault {
    /// A fault of any kind.
    #[cold]
    pub fn new(code: &'static str, message: impl Into<String>) -> Fault {
        let message = message.into();
        Fault(Box::new(Details { code, message, subject: None, help: None, invalid: None, refusal: None }))
    }

    /// A value, as JSON, that a setting cannot have.
    #[cold]
    pub fn refused(setting: &str, value: String, expected: Expected) -> Fault {
        let mut fault = Fault::new("bad-setting", format!("`{setting}` cannot be {value}")).about(setting);
        fault.0.refusal = Some(Refusal { value, expected });
        fault
    }

    /// An operation without a derivative gets a number that varies with the continuous choices.
    #[cold]
    pub fn no_derivative(operation: &str) -> Fault {
        Fault::new(
            "no-derivative",
            format!("{operation} has no derivative, and the number depends on the continuous choices"),
        )
        .with_help(
            "keep it out of what the score depends on, or use `mh()` or particles, which need no derivative",
        )
    }

    /// Marks the run as invalid because of a call.
    #[cold]
    pub fn invalid_by(mut self, call: InvalidCall) -> Fault {
        self.0.invalid = Some(call);
        self
    }

    /// Marks the run as invalid by the same call as another fault, which is the cause of this one.
    #[cold]
    pub fn caused_by(mut self, cause: &Fault) -> Fault {
        self.0.invalid.clone_from(&cause.invalid);
        self
    }

    /// Names the subject of the fault: see [`Details::subject`].
    #[cold]
    pub fn about(mut self, subject: impl Into<String>) -> Fault {
        self.0.subject = Some(subject.into());
        self
    }

    /// Adds a hint for a correction.
    #[cold]
    pub fn with_help(mut self, help: impl Into<String>) -> Fault {
        self.0.help = Some(help.into());
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_is_one_pointer_and_its_fields_are_in_reach() {
        assert_eq!(std::mem::size_of::<Fault>(), 8);
        let fault = Fault::list_index("list index 5 is out of range").with_help("use a smaller index");
        assert_eq!(fault.code, "list-index");
        assert_eq!(fault.help.as_deref(), Some("use a smaller index"));
        assert_eq!(fault.to_string(), "list-index: list index 5 is out of range");
    }
}
