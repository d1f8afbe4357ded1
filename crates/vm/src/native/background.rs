//! The thread that writes machine code while runs continue. It starts with the first code of a process, and
//! then waits for more work.

use std::process;
use std::sync::Mutex;
use std::sync::mpsc::{Sender, channel};
use std::thread;

type Work = Box<dyn FnOnce() + Send>;

/// The process that the thread belongs to, and the channel that brings its work.
static THREAD: Mutex<Option<(u32, Sender<Work>)>> = Mutex::new(None);

/// Lets the thread run some work later; `false` if that is not possible now.
///
/// A forked process has none of its parent's threads, so it starts its own. It may also hold a lock that no
/// thread will ever release, so this function never waits for a lock.
pub(super) fn run_in_background(work: Work) -> bool {
    let Ok(mut thread) = THREAD.try_lock() else { return false };
    let id = process::id();
    if !matches!(&*thread, Some((process, _)) if *process == id) {
        let (to, all) = channel::<Work>();
        let run = move || all.into_iter().for_each(|work| work());
        if thread::Builder::new().name("machine code".into()).spawn(run).is_err() {
            return false;
        }
        std::mem::forget(thread.replace((id, to)));
    }
    matches!(&*thread, Some((_, to)) if to.send(work).is_ok())
}
