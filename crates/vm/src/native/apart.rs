//! The thread that writes machine code while runs go on. It starts with the first code of a process, and then it waits for more.

use std::process;
use std::sync::Mutex;
use std::sync::mpsc::{Sender, channel};
use std::thread;

type Work = Box<dyn FnOnce() + Send>;

/// Of which process it is, and where it gets its work from.
static THREAD: Mutex<Option<(u32, Sender<Work>)>> = Mutex::new(None);

/// Has the thread do something later; false where it cannot be had now.
///
/// A process that was forked has none of its parent's threads: it starts its own. It may also have a lock that no thread
/// will ever release, so nobody waits for one here.
pub(super) fn later(work: Work) -> bool {
    let Ok(mut thread) = THREAD.try_lock() else { return false };
    let own = process::id();
    if !matches!(&*thread, Some((process, _)) if *process == own) {
        let (to, all) = channel::<Work>();
        let run = move || all.into_iter().for_each(|work| work());
        if thread::Builder::new().name("machine code".into()).spawn(run).is_err() {
            return false;
        }
        std::mem::forget(thread.replace((own, to)));
    }
    matches!(&*thread, Some((_, to)) if to.send(work).is_ok())
}
