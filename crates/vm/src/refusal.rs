//! Refusals of settings, as data. Python words them.

/// The values that a setting can have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// A whole number between two, both included.
    Whole {
        /// The least.
        least: u64,
        /// The greatest.
        most: u64,
    },
    /// A finite number between two.
    Real {
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
        /// Whether the ends are included: `[]` for both, `()` for none.
        ends: &'static str,
    },
    /// One of these words.
    Words(&'static [&'static str]),
    /// A list of at least one value.
    List(&'static Range),
    /// A table whose values are in this range, if it is known.
    Table(Option<&'static Range>),
    /// Nothing, or a value.
    Optional(&'static Range),
    /// A value in either range.
    Either(&'static [Range; 2]),
}

/// The condition that a refused setting does not fulfil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// A range.
    Range(Range),
    /// A rule about several settings, by its name in Python's table of rules (`niwaki/errors/texts/rules.py`).
    Rule(&'static str),
}

/// A value that a setting cannot have; the fault's subject is the name of the setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The value, as JSON.
    pub value: String,
    /// The condition.
    pub expected: Expected,
}
