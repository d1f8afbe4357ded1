//! What blocks of memory take.

/// Bytes of the two counters in front of what is shared.
const COUNTERS: usize = 16;

/// Bytes of a page.
const PAGE: usize = 4096;

/// Bytes that an allocation of a size takes: allocators round up, large blocks by a sixteenth on average.
#[inline]
pub(super) const fn block(size: usize) -> usize {
    match size {
        0..=128 => size.next_multiple_of(16),
        // Four sizes for each power of two; the rest of a page that is not written takes no memory.
        129..=PAGE => size.next_multiple_of(1 << ((size - 1).ilog2() - 2)),
        _ => size.next_multiple_of(PAGE),
    }
}

/// Bytes of a shared object of a type.
#[inline]
pub(super) const fn shared<T>() -> usize {
    block(COUNTERS + size_of::<T>())
}
