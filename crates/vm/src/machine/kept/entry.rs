//! Where an activation is entered.

/// Where an activation is entered, depending on which inputs have changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Entry {
    /// Nothing: it need not be entered.
    Unchanged,
    /// One input, of which this is the slice.
    One(u32),
    /// More than one.
    Whole,
}

impl Entry {
    /// An input has changed whose slice begins there.
    #[inline(always)]
    pub fn add(&mut self, slice: u32) {
        *self = if *self == Entry::Unchanged { Entry::One(slice) } else { Entry::Whole };
    }
}
