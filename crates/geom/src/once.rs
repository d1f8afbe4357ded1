//! Values that are computed at the first use.

use std::sync::OnceLock;

/// Cells whose value is computed at the first use.
pub trait Once<T> {
    /// The value, computed at the first use. Of several threads at once, the first to end decides.
    ///
    /// The cell is locked only while the value is put into it. `OnceLock::get_or_init` alone keeps it locked while it
    /// computes: a process forked at that time would wait for ever at the first use, because it has no thread that computes.
    fn once(&self, compute: impl FnOnce() -> T) -> &T;
}

impl<T> Once<T> for OnceLock<T> {
    #[inline]
    fn once(&self, compute: impl FnOnce() -> T) -> &T {
        match self.get() {
            Some(known) => known,
            None => {
                let value = compute();
                self.get_or_init(|| value)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! The claim: a cell is free while its value is computed, and keeps one value.

    use super::*;

    #[test]
    fn a_cell_is_free_while_its_value_is_computed() {
        let cell = OnceLock::new();
        // With `get_or_init` alone the inner call would wait for the outer one.
        assert_eq!(*cell.once(|| *cell.once(|| 1) + 1), 1);
        assert_eq!(*cell.once(|| 3), 1);
    }
}
