//! Checkpoints: the texts from which a killed search resumes, one text for each independent part.
//!
//! A part (a chain, or a search among several) reaches *borders* between two proposals or two rounds. At a border its state is
//! small: the values of its choices, its learned settings, its counters. Random streams are keyed by counters, so a part resumes
//! with the same bits from any border. Therefore a clock may decide when parts are stored; each part is stored at its next
//! border, and no part waits.
//!
//! The owner of the file calls [`Checkpoint::ask`] at intervals, and [`Checkpoint::collect`] to get the stored parts.

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
    /// The number of requests to store all parts.
    requests: AtomicU64,
    parts: Mutex<Parts>,
}

#[derive(Debug, Default)]
struct Parts {
    /// The text of each part from an earlier process.
    left: HashMap<u64, String>,
    /// The request at which each part was stored last.
    stored: HashMap<u64, u64>,
    /// The parts that were stored since the last collection.
    fresh: HashMap<u64, String>,
    /// The time that storing them took.
    cost: Duration,
}

impl Checkpoint {
    /// Resume from these parts; without parts, start a search.
    pub fn of(left: HashMap<u64, String>) -> Checkpoint {
        Checkpoint { requests: AtomicU64::new(0), parts: Mutex::new(Parts { left, ..Parts::default() }) }
    }

    fn lock(&self) -> MutexGuard<'_, Parts> {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Read a part of an earlier process; `None` where it stored no such part.
    ///
    /// # Errors
    /// A text that is not a part of this type.
    pub fn left<T: DeserializeOwned>(&self, part: u64) -> Result<Option<T>, Failure> {
        let text = self.lock().left.get(&part).cloned();
        let read = |text: String| serde_json::from_str(&text).map_err(|error| unfit(&error.to_string()));
        Ok(text.map(read).transpose()?.flatten())
    }

    /// Request that each part is stored at its next border.
    pub fn ask(&self) {
        self.requests.fetch_add(1, Ordering::Relaxed);
    }

    /// Store a part that is at a border, if a request is open for it.
    pub fn at_border<T: Serialize>(&self, part: u64, content: impl FnOnce() -> T) {
        let requests = self.requests.load(Ordering::Relaxed);
        let answered = self.lock().stored.get(&part).copied().unwrap_or(0);
        if answered < requests {
            self.store(part, content);
        }
    }

    /// Store a part.
    pub fn store<T: Serialize>(&self, part: u64, content: impl FnOnce() -> T) {
        let began = Instant::now();
        let requests = self.requests.load(Ordering::Relaxed);
        // Every content is plain data.
        let Ok(text) = serde_json::to_string(&content()) else { return };
        let mut parts = self.lock();
        parts.stored.insert(part, requests);
        parts.fresh.insert(part, text);
        parts.cost += began.elapsed();
    }

    /// Take the parts that were stored since the last call, and the time that storing them took.
    pub fn collect(&self) -> (HashMap<u64, String>, Duration) {
        let mut parts = self.lock();
        (std::mem::take(&mut parts.fresh), std::mem::take(&mut parts.cost))
    }
}

/// The failure of a search that cannot resume from its checkpoint.
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
        let checkpoint = Checkpoint::default();
        checkpoint.at_border(0, || 1);
        assert!(checkpoint.collect().0.is_empty());
        checkpoint.ask();
        checkpoint.at_border(0, || 2);
        checkpoint.at_border(0, || 3);
        checkpoint.at_border(1, || 4);
        let parts = checkpoint.collect().0;
        assert_eq!((parts[&0].as_str(), parts[&1].as_str()), ("2", "4"));
        checkpoint.at_border(0, || 5);
        assert!(checkpoint.collect().0.is_empty());
        checkpoint.store(0, || 6);
        assert_eq!(checkpoint.collect().0[&0], "6");
    }

    #[test]
    fn text_of_another_type_is_refused() {
        let checkpoint = Checkpoint::of(HashMap::from([(0, "[1, 2".to_string()), (1, "7".to_string())]));
        assert!(checkpoint.left::<Vec<u64>>(0).is_err());
        assert_eq!(checkpoint.left::<u64>(1).ok().flatten(), Some(7));
        assert_eq!(checkpoint.left::<u64>(2).ok().flatten(), None);
    }
}
