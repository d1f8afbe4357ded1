//! The memory that blocks take.

/// Bytes of the two counters in front of shared data.
const COUNTERS: usize = 16;

/// Bytes of a page.
const PAGE: usize = 4096;

/// The bytes that an allocation takes: allocators round up, large blocks by a sixteenth on average.
#[inline]
pub(super) const fn block(size: usize) -> usize {
    match size {
        0..=128 => size.next_multiple_of(16),
        // There are four sizes for each power of two. The rest of a page that is not written takes no memory.
        129..=PAGE => size.next_multiple_of(1 << ((size - 1).ilog2() - 2)),
        _ => size.next_multiple_of(PAGE),
    }
}

/// The bytes of a shared object of a type.
#[inline]
pub(super) const fn shared<T>() -> usize {
    block(COUNTERS + size_of::<T>())
}
