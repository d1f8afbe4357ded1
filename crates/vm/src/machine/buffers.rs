//! Copies of short vectors, and the growth of long ones.

/// Does `clone_from` for short slices: an inlined loop without calls.
#[inline(always)]
pub(super) fn copy<T: Clone>(to: &mut Vec<T>, from: &[T]) {
    if to.len() != from.len() {
        to.truncate(from.len());
        to.extend_from_slice(&from[to.len()..]);
        return to.clone_from_slice(from);
    }
    for (to, from) in to.iter_mut().zip(from) {
        to.clone_from(from);
    }
}

/// The least room in bytes that a growing vector gets: doubled from the start, most would move again and again.
const SMALL: usize = 512;

/// The size in bytes from which a growing vector gets all the room that it may need.
const LARGE: usize = 1 << 20;

/// Makes room for more elements. A large vector gets room for `spare` bytes at once. Pages that are not written
/// take no memory, while a vector that doubles is in memory twice when it moves.
#[inline]
pub(super) fn make_room<T>(vector: &mut Vec<T>, more: usize, spare: impl FnOnce() -> usize) {
    if vector.capacity() - vector.len() < more {
        if vector.len() * size_of::<T>() < LARGE {
            return vector.reserve(more.max(SMALL / size_of::<T>()));
        }
        let room = (spare() / size_of::<T>()).max(more);
        // If so much room is not available, the vector grows as usual.
        let _ = vector.try_reserve_exact(room);
    }
}
