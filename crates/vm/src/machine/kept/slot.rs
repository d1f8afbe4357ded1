//! Slots: the memory that a kept activation has of each of its sites.
//!
//! | site | `held` | `mark` | `log` |
//! | --- | --- | --- | --- |
//! | choice | its number among the choices (or among the births) | its family | log density, nats |
//! | held choice | its number among the held choices | `HELD` | log density, nats |
//! | factor, observation | 0 | | nats |
//! | call, future | the callee's node | | |
//! | loop | the loop's node | | |
//! | emit | number of its primitive | | |
//! | query, force | 0 | | |
//! | cell | the list of its readers | | (append: address of the list before, as bits) |
//! | read | the list of readers that contains it (or `UNWATCHED`) | its place there | |
//!
//! The value of a choice, the result of a call and the value of a query are in registers.

/// The slot of a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slot {
    pub held: u32,
    pub mark: u32,
    pub log: f64,
}

impl Slot {
    /// The `held` of a slot whose site has not run, or is not on the path taken.
    pub const NOTHING: u32 = u32::MAX;

    /// The `held` of a read whose element is not a cell; every list of readers has a smaller number.
    pub const UNWATCHED: u32 = u32::MAX - 1;

    /// The slot of a site that is not on the path.
    pub const EMPTY: Slot = Slot { held: Slot::NOTHING, mark: 0, log: 0.0 };

    /// The mark in the `held` of a choice that the open transaction added: its number is a number among the
    /// births.
    pub const BORN: u32 = 1 << 31;

    /// The part of a choice's `mark` that is its family.
    pub const FAMILY: u32 = 0xFF;

    /// The bit in the `mark` of a choice that the open transaction changes.
    pub const CHANGED: u32 = 1 << 8;

    /// The `mark` of a held choice, which has no family to compare.
    pub const HELD: u32 = 1 << 9 | Slot::FAMILY;

    /// The bit in the `mark` of a read that the open transaction has given another element: the list of the old
    /// element still contains the read.
    pub const MOVING: u32 = 1 << 31;

    /// Whether the choice of the slot is held.
    #[inline(always)]
    pub fn is_held(&self) -> bool {
        self.mark & Slot::HELD == Slot::HELD
    }

    /// Whether the site is on the path taken.
    #[inline(always)]
    pub fn is_filled(&self) -> bool {
        self.held != Slot::NOTHING
    }
}
