//! A block of cells of a grid.

/// Cells from `low` to `high`, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellBox {
    /// Smallest indices.
    pub low: [usize; 3],
    /// Largest indices.
    pub high: [usize; 3],
}
