//! Work shared among the threads of the pool: each thread does its own items first, then takes items of others.
//!
//! A particle is in the cache of the thread that ran it last, and was allocated there. If the same thread runs it again,
//! nothing moves between processors.

use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// Processes every item of `lists`, one list for each thread of the pool. `worker` creates the function of a thread from
/// the thread's number.
pub(super) fn share<T: Send, W: FnMut(T)>(lists: Vec<VecDeque<T>>, worker: impl Fn(usize) -> W + Sync) {
    let lists: Vec<Mutex<VecDeque<T>>> = lists.into_iter().map(Mutex::new).collect();
    let work = || {
        let thread = rayon::current_thread_index().unwrap_or(0) % lists.len();
        let mut next = next(&lists, thread);
        if next.is_none() {
            return;
        }
        let mut work = worker(thread);
        while let Some(item) = next {
            work(item);
            next = self::next(&lists, thread);
        }
    };
    rayon::scope(|scope| {
        (1..lists.len()).for_each(|_| scope.spawn(|_| work()));
        work();
    });
}

/// The first item of the thread's list, or the last of another list.
fn next<T>(lists: &[Mutex<VecDeque<T>>], thread: usize) -> Option<T> {
    // One lock at a time, so that two threads with each other's lists do not wait for each other.
    (0..lists.len()).find_map(|more| {
        let list = &lists[(thread + more) % lists.len()];
        let mut list = list.lock().unwrap_or_else(PoisonError::into_inner);
        if more == 0 { list.pop_front() } else { list.pop_back() }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU64, Ordering};

    /// Every item is processed once, whichever list has it.
    #[test]
    fn everything_is_done_once() {
        for threads in [1, 2, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            // Many rounds, so that a deadlock would occur.
            for round in 0..2000 {
                let lopsided = round % 2 == 0;
                let mut lists: Vec<VecDeque<u32>> = vec![VecDeque::new(); threads];
                for item in 0..50 {
                    lists[if lopsided { 0 } else { item as usize % threads }].push_back(item);
                }
                let done = AtomicU64::new(0);
                pool.install(|| {
                    share(lists, |_| {
                        |item| {
                            assert_eq!(done.fetch_or(1 << item, Ordering::Relaxed) & 1 << item, 0);
                        }
                    });
                });
                assert_eq!(done.into_inner(), (1 << 50) - 1);
            }
        }
    }
}
