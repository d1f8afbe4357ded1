//! The spaces that the values of families lie in.

/// The space of a family's values, for all parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Truth values.
    Booleans,
    /// Whole numbers without order, from zero.
    Categories,
    /// Whole numbers.
    Integers,
    /// All real numbers; the family has a scale.
    Line,
    /// Real numbers above zero.
    Positive,
    /// Real numbers from zero to one.
    Unit,
    /// Real numbers with bounds that are parameters.
    Bounded,
    /// Angles.
    Circle,
    /// Vectors of positive numbers that sum to one.
    Simplex,
    /// Vectors; the family has a scale.
    Vectors,
    /// Lists of counts.
    Counts,
    /// Lists of truth values.
    Truths,
    /// The space of the components' values.
    Components,
    /// A constant value.
    Fixed,
}

impl Space {
    /// Whether values are real numbers or vectors, and not constants.
    pub const fn is_continuous(self) -> bool {
        match self {
            Space::Booleans | Space::Categories | Space::Integers | Space::Fixed => false,
            Space::Counts | Space::Truths => false,
            Space::Line | Space::Positive | Space::Unit | Space::Bounded | Space::Circle => true,
            Space::Simplex | Space::Vectors | Space::Components => true,
        }
    }
}
