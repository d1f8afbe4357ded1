//! What a search needs to go on after it was killed: texts, one for each part that runs by itself.
//!
//! A part (a chain, a search of several) comes to *borders*, between two proposals or two rounds, where it can be stored in
//! little: the values of its choices, what it has learnt, its counters. Random streams are counted and not followed, so it
//! goes on with the same bits wherever the border was. Therefore a clock may say when a part is stored, and it says so to
//! every part at its own next border: nothing waits.
//!
//! Who keeps the file [asks](Checkpoint::ask) now and then, and [collects](Checkpoint::collect) what was stored since.

use crate::Failure;
use niwaki_vm::fault::Fault;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The parts of a search.
#[derive(Debug, Default)]
pub struct Checkpoint {
    /// How often was asked.
    asked: AtomicU64,
    parts: Mutex<Parts>,
}

#[derive(Debug, Default)]
struct Parts {
    /// What an earlier process left of each part.
    left: HashMap<u64, String>,
    /// At which question each part was stored last.
    stored: HashMap<u64, u64>,
    /// What was stored since the last collection.
    fresh: HashMap<u64, String>,
    /// The time that storing it took.
    cost: Duration,
}

impl Checkpoint {
    /// A search that goes on from these parts; from none, one that begins.
    pub fn of(left: HashMap<u64, String>) -> Checkpoint {
        Checkpoint { asked: AtomicU64::new(0), parts: Mutex::new(Parts { left, ..Parts::default() }) }
    }

    fn lock(&self) -> MutexGuard<'_, Parts> {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What an earlier process left of a part; `None` where it left nothing.
    ///
    /// # Errors
    /// A text that is not of such a part.
    pub fn left<T: DeserializeOwned>(&self, part: u64) -> Result<Option<T>, Failure> {
        let text = self.lock().left.get(&part).cloned();
        let read = |text: String| serde_json::from_str(&text).map_err(|error| unfit(&error.to_string()));
        Ok(text.map(read).transpose()?.flatten())
    }

    /// From now on each part is stored at its next border.
    pub fn ask(&self) {
        self.asked.fetch_add(1, Ordering::Relaxed);
    }

    /// Stores a part that is at a border, if it was asked for and has not answered.
    pub fn at_border<T: Serialize>(&self, part: u64, content: impl FnOnce() -> T) {
        let asked = self.asked.load(Ordering::Relaxed);
        let answered = self.lock().stored.get(&part).copied().unwrap_or(0);
        if answered < asked {
            self.store(part, content);
        }
    }

    /// Stores a part.
    pub fn store<T: Serialize>(&self, part: u64, content: impl FnOnce() -> T) {
        let began = Instant::now();
        let asked = self.asked.load(Ordering::Relaxed);
        // Every content is plain data.
        let Ok(text) = serde_json::to_string(&content()) else { return };
        let mut parts = self.lock();
        parts.stored.insert(part, asked);
        parts.fresh.insert(part, text);
        parts.cost += began.elapsed();
    }

    /// What was stored since the last call, and the time that it took.
    pub fn collect(&self) -> (HashMap<u64, String>, Duration) {
        let mut parts = self.lock();
        (std::mem::take(&mut parts.fresh), std::mem::take(&mut parts.cost))
    }
}

/// The failure of a search that cannot go on from what is stored.
pub fn unfit(reason: &str) -> Failure {
    Fault::new("bad-checkpoint", reason)
        .with_help("begin the search anew: without the checkpoint, or in another file")
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_stored_once_for_each_question() {
        let own = Checkpoint::default();
        own.at_border(0, || 1);
        assert!(own.collect().0.is_empty());
        own.ask();
        own.at_border(0, || 2);
        own.at_border(0, || 3);
        own.at_border(1, || 4);
        let found = own.collect().0;
        assert_eq!((found[&0].as_str(), found[&1].as_str()), ("2", "4"));
        own.at_border(0, || 5);
        assert!(own.collect().0.is_empty());
        own.store(0, || 6);
        assert_eq!(own.collect().0[&0], "6");
    }

    #[test]
    fn what_is_no_part_is_refused() {
        let own = Checkpoint::of(HashMap::from([(0, "[1, 2".to_string()), (1, "7".to_string())]));
        assert!(own.left::<Vec<u64>>(0).is_err());
        assert_eq!(own.left::<u64>(1).ok().flatten(), Some(7));
        assert_eq!(own.left::<u64>(2).ok().flatten(), None);
    }
}
