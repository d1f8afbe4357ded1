//! Values that several threads of Python use, one thread at a time, and that may be in use at a fork.
//!
//! A thread waits without the interpreter's lock, so the user of the value can take the lock for a host function.
//! In a child of a fork, a value that a thread of the parent was using is only half changed, and its user does not exist:
//! its use is an error, and not an endless wait.

use crate::faults;
use niwaki_vm::fault::Fault;
use pyo3::prelude::*;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Time between two looks at a value in use.
const PAUSE: Duration = Duration::from_millis(1);

/// Mark of a value without a user.
const FREE: u64 = 0;

/// A value with its user: a process in the upper half, one of its threads in the lower one.
pub struct Shared<T> {
    user: AtomicU64,
    /// Only the user takes this lock, so no thread waits for it.
    value: Mutex<T>,
}

/// Value in the hands of its user.
pub struct Using<'a, T> {
    value: MutexGuard<'a, T>,
    _then: Leaving<'a>,
}

/// This field is dropped after the value.
struct Leaving<'a>(&'a AtomicU64);

impl Drop for Leaving<'_> {
    fn drop(&mut self) {
        self.0.store(FREE, Ordering::Release);
    }
}

impl<T> Shared<T> {
    /// Makes a value without a user.
    pub fn new(value: T) -> Shared<T> {
        Shared { user: AtomicU64::new(FREE), value: Mutex::new(value) }
    }

    /// Refuses an endless wait: a thread of the parent process was using the value at a fork, or this
    /// thread is using it (in the callback of a search).
    ///
    /// # Errors
    /// The two cases above.
    pub fn check(&self, py: Python<'_>) -> PyResult<()> {
        let (user, me) = (self.user.load(Ordering::Relaxed), this_thread());
        let reason = match user {
            FREE => return Ok(()),
            _ if user == me => "it is at work, and this is its own `progress`",
            _ if user >> 32 != me >> 32 => "it was at work in another thread when this process was forked",
            _ => return Ok(()),
        };
        Err(faults::setting(py, &Fault::new("in-use", reason)))
    }

    /// Waits until no other thread uses the value, and takes it.
    ///
    /// # Errors
    /// As for [`Shared::check`]; Ctrl-C.
    pub fn lock(&self, py: Python<'_>) -> PyResult<Using<'_, T>> {
        let me = this_thread();
        while self.user.compare_exchange(FREE, me, Ordering::Acquire, Ordering::Relaxed).is_err() {
            self.check(py)?;
            py.check_signals()?;
            py.detach(|| std::thread::sleep(PAUSE));
        }
        let _then = Leaving(&self.user);
        Ok(Using { value: self.value.lock().unwrap_or_else(PoisonError::into_inner), _then })
    }
}

impl<T> Deref for Using<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> DerefMut for Using<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.value
    }
}

/// This process and this thread.
fn this_thread() -> u64 {
    static NEXT: AtomicU32 = AtomicU32::new(1);
    thread_local! {
        static NUMBER: u32 = NEXT.fetch_add(1, Ordering::Relaxed);
    }
    u64::from(std::process::id()) << 32 | NUMBER.with(|number| u64::from(*number))
}
