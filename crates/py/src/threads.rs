//! Pools of threads for the parallel parts of the engine, also after a fork.
//!
//! A fork copies the memory of a process, but only the thread that calls it. A pool of the parent has no thread
//! in the child, so its work would never be done. Here a pool knows the process that made it: a child builds
//! its own. Everything in this crate that can run in parallel is inside of [`Pool::inside`]; the pool that Rayon would
//! make for the whole process has no such memory, and is never used.
//!
//! A search borrows a pool for as long as it runs. So searches side by side, and a search that a host function of another
//! one calls, never wait for each other's threads.

use crate::hosts::lend;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::{Mutex, PoisonError};

/// Pools that wait for work, the last used at the end.
///
/// This lock is taken only with the interpreter's lock, which is not given away meanwhile. A fork of Python has the
/// interpreter's lock, too, so no child finds this one taken.
static IDLE: Mutex<Vec<Pool>> = Mutex::new(Vec::new());

/// The most pools that wait.
const KEPT: usize = 4;

/// Pool of threads of one process.
pub struct Pool {
    threads: ThreadPool,
    /// The requested number of threads; `None` for all threads of the machine.
    requested: Option<usize>,
    process: u32,
}

impl Pool {
    /// Borrows a pool for one search: a waiting pool, or else a new one. `RAYON_NUM_THREADS` is the default number of threads.
    ///
    /// # Errors
    /// The variable is no number of threads; the system has no more threads.
    pub fn borrow(py: Python<'_>, requested: Option<usize>) -> PyResult<Pool> {
        let process = std::process::id();
        let requested = match requested {
            Some(requested) => Some(requested),
            None => py.import("niwaki.errors.settings")?.call_method0("usual_threads")?.extract()?,
        };
        let mut idle = waiting(py);
        // The drop of a pool of the parent would signal threads that do not exist here.
        for foreign in idle.extract_if(.., |pool| pool.process != process) {
            std::mem::forget(foreign);
        }
        if let Some(at) = idle.iter().rposition(|pool| pool.requested == requested) {
            return Ok(idle.remove(at));
        }
        let builder = ThreadPoolBuilder::new().thread_name(|number| format!("niwaki {number}"));
        // Rayon's word for "as many as the machine has" is 0.
        let builder = builder.num_threads(requested.map_or(0, |n| n.max(1)));
        let threads = match builder.build() {
            Ok(threads) => threads,
            Err(error) => {
                let settings = py.import("niwaki.errors.settings")?;
                settings.call_method1("refuse_threads", (requested, error.to_string()))?;
                return Err(PyRuntimeError::new_err(error.to_string()));
            }
        };
        // Each thread has worked before the interpreter's lock is given away, and a fork is possible: what threads set up for
        // the whole process (the allocator's list of them, the collector of their queues) is then complete.
        apart(|| threads.broadcast(|_| ()));
        Ok(Pool { threads, requested, process })
    }

    /// The number of its threads.
    pub fn count(&self) -> usize {
        self.threads.current_num_threads()
    }

    /// Gives the pool back, for the next search.
    pub fn give_back(self, py: Python<'_>) {
        let mut idle = waiting(py);
        if idle.len() == KEPT {
            idle.remove(0);
        }
        idle.push(self);
    }

    /// Runs `work` on a thread of this pool, where its parallel parts find the others, and waits for it.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        lend(|| apart(|| self.threads.install(work)))
    }

    /// Starts `work` on a thread of this pool, and runs `meanwhile` beside it; gives the result of `work`, once both have
    /// ended.
    pub fn beside<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
        meanwhile: impl FnOnce() + Send,
    ) -> Option<T> {
        let mut done = None;
        let place = &mut done;
        let both = || {
            self.threads.in_place_scope(|scope| {
                scope.spawn(move |_| *place = Some(work()));
                meanwhile();
            });
        };
        lend(|| apart(both));
        done
    }

    /// Runs `work` without the interpreter's lock, its parallel parts on all threads.
    ///
    /// # Errors
    /// As for [`Pool::borrow`].
    pub fn inside<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
        let pool = Pool::borrow(py, None)?;
        let result = py.detach(|| pool.run(work));
        pool.give_back(py);
        Ok(result)
    }
}

/// The pools that wait; the caller has the interpreter's lock.
fn waiting(_: Python<'_>) -> std::sync::MutexGuard<'static, Vec<Pool>> {
    IDLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs `work` here; if this is a thread of a pool (a host function searches), on a thread of its own. A thread of a pool
/// that waits for another pool takes up other work of its own meanwhile, and would come back only after that.
fn apart<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    if rayon::current_thread_index().is_none() {
        return work();
    }
    std::thread::scope(|scope| {
        scope.spawn(work).join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}
