//! Runs outside of a model's support: the parameters of a distribution are out of range.
//!
//! The number of such runs is counted by *site*: the family, and the line at which the distribution is made. A run ends
//! at its first invalid distribution in program order, so it counts once.

use super::stack::RunFault;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Counts of invalid runs by site. All threads that share it count together.
#[derive(Debug, Default)]
pub struct Invalid(Mutex<BTreeMap<String, u64>>);

impl Invalid {
    /// Counts the run if the fault makes it invalid, and gives the site's readable name. `None` for any other fault.
    #[cold]
    pub fn count(&self, met: &RunFault) -> Option<String> {
        let site = met.invalid_site()?;
        *self.0.lock().unwrap_or_else(PoisonError::into_inner).entry(site.clone()).or_insert(0) += 1;
        Some(site)
    }

    /// Counts runs of another search, or of an earlier part of this one.
    pub fn add(&self, counts: impl IntoIterator<Item = (String, u64)>) {
        let mut own = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        counts.into_iter().for_each(|(site, n)| *own.entry(site).or_insert(0) += n);
    }

    /// The number of invalid runs by site, in the order of the sites' names.
    pub fn counts(&self) -> Vec<(String, u64)> {
        let counts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        counts.iter().map(|(site, n)| (site.clone(), *n)).collect()
    }
}

impl RunFault {
    /// The readable name of the distribution whose parameters are out of range; `None` for any other fault.
    pub fn invalid_site(&self) -> Option<String> {
        let line = self.stack.last().map_or(0, |call| call.span.line);
        self.fault.out_of_range.map(|family| format!("`{}` at line {line}", family.name()))
    }
}
