//! Invalid runs: runs outside of the model's support, which have probability zero in a search.
//!
//! A run is *invalid* if a call has no result for its arguments, although they are of the right kinds. Such
//! calls are:
//!
//! * a distribution, for parameters out of range;
//! * a shape that cannot exist: a size that is negative or not a number, an empty mesh, a solid without an
//!   inside;
//! * a host function that raises an exception.
//!
//! The code that raises such a fault marks it with the call ([`Fault::of_call`](crate::fault::Fault::of_call)),
//! and [`RunFault::is_invalid`] reads the mark. Any other fault belongs to the program and ends a search: a
//! value of another kind, a division by zero, a limit of steps or memory.
//!
//! Invalid runs are counted by *place*: the file and line of the call, and the name of the called function. A
//! run ends at its first such call in program order, so it counts once. The example of a place is the shortest
//! call, and among calls of the same length the first in alphabetical order. So it does not depend on the order
//! in which threads meet the calls.

use super::stack::RunFault;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// A place with calls that make runs invalid.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// The number of the source file.
    pub file: u32,
    /// The first line of the call.
    pub line: u32,
    /// The name of the called distribution family, shape or host function.
    pub name: String,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "`{}` at line {}", self.name, self.line)
    }
}

/// Invalid runs at one place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Count {
    /// The number of runs.
    pub runs: u64,
    /// The call of one of the runs, with its arguments.
    pub call: String,
    /// The reason why that call has no result.
    pub reason: String,
}

impl Count {
    fn add(&mut self, other: Count) {
        self.runs += other.runs;
        let rank = |count: &Count| (count.call.len(), count.call.clone(), count.reason.clone());
        if rank(&other) < rank(self) {
            (self.call, self.reason) = (other.call, other.reason);
        }
    }
}

/// Invalid runs by place, in the order of files and lines.
pub type Counts = Vec<(Place, Count)>;

/// Counts of invalid runs by place. All threads that share a table count together.
#[derive(Debug, Default)]
pub struct Invalid(Mutex<BTreeMap<Place, Count>>);

impl Invalid {
    /// Counts the run if the fault makes it invalid, and returns the place. Returns `None` for any other fault.
    #[cold]
    pub fn count(&self, met: &RunFault) -> Option<Place> {
        let place = met.invalid_place()?;
        let call = met.fault.invalid.as_ref().map(|call| call.text.clone())?;
        let count = Count { runs: 1, call, reason: met.fault.message.clone() };
        self.add([(place.clone(), count)]);
        Some(place)
    }

    /// Counts runs of another search, or of an earlier part of this one.
    pub fn add(&self, counts: impl IntoIterator<Item = (Place, Count)>) {
        let mut places = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for (place, count) in counts {
            match places.entry(place) {
                std::collections::btree_map::Entry::Vacant(entry) => drop(entry.insert(count)),
                std::collections::btree_map::Entry::Occupied(mut entry) => entry.get_mut().add(count),
            }
        }
    }

    /// The number of invalid runs by place.
    pub fn counts(&self) -> Counts {
        let counts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        counts.iter().map(|(place, count)| (place.clone(), count.clone())).collect()
    }
}

impl RunFault {
    /// Whether the run is invalid. Otherwise the program is at fault.
    pub fn is_invalid(&self) -> bool {
        self.fault.invalid.is_some()
    }

    /// The call that makes the run invalid; `None` for any other fault.
    pub fn invalid_place(&self) -> Option<Place> {
        let call = self.fault.invalid.as_ref()?;
        let (file, line) = self.stack.last().map_or((0, 0), |call| (call.file, call.span.line));
        Some(Place { file, line, name: call.name.clone() })
    }
}

#[cfg(test)]
mod tests {
    //! The claim: runs are counted by place, and the example does not depend on the order in which runs are
    //! met.
    use super::*;
    use crate::fault::Fault;
    use crate::value::Value;

    #[test]
    fn the_example_of_a_place_is_the_same_in_any_order() {
        let met = |x: f64| {
            let fault = Fault::bad_parameter(format!("it is {x}")).of_call("gaussian", &[Value::Real(x)]);
            RunFault { fault, stack: vec![], omitted: 0, path: String::new() }
        };
        let numbers = [-1.25, -3.5, -2.5, -10.0];
        let counted = |order: &[usize]| {
            let invalid = Invalid::default();
            for at in order {
                assert!(invalid.count(&met(numbers[*at])).is_some());
            }
            invalid.counts()
        };
        let first = counted(&[0, 1, 2, 3]);
        let (place, count) = &first[0];
        assert_eq!((first.len(), place.to_string().as_str()), (1, "`gaussian` at line 0"));
        assert_eq!(
            (count.runs, count.call.as_str(), count.reason.as_str()),
            (4, "gaussian(-2.5)", "it is -2.5")
        );
        for order in [[3, 2, 1, 0], [1, 3, 0, 2], [2, 0, 3, 1]] {
            assert_eq!(counted(&order), first);
        }
        let other =
            RunFault { fault: Fault::list_index("none"), stack: vec![], omitted: 0, path: String::new() };
        assert!(Invalid::default().count(&other).is_none() && !other.is_invalid());
    }
}
