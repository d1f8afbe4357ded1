//! The place where an activation is entered.

/// The place where an activation is entered, by the inputs that have changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Entry {
    /// No input has changed: the activation need not be entered.
    Unchanged,
    /// One input has changed: the start of its slice.
    Slice(u32),
    /// Several inputs have changed: the start of the whole code.
    Whole,
}

impl Entry {
    /// Adds a changed input, by the start of its slice.
    #[inline(always)]
    pub fn add(&mut self, slice: u32) {
        *self = if *self == Entry::Unchanged { Entry::Slice(slice) } else { Entry::Whole };
    }
}
