//! The memoised calls of a run, and their addresses.

use super::address::{ROOT, join, site_key};
use super::ids::FutureId;
use crate::code::{FunctionId, Program};
use crate::core::Name;
use niwaki_math::Scalar;

/// The memoised calls of a run, by their addresses.
#[derive(Debug, Default)]
pub(crate) struct Memos(Vec<Call>);

/// A memoised call.
#[derive(Clone, Debug)]
struct Call {
    path: u128,
    /// Its number among the futures: this future says whether the call has returned, its value, and who waits.
    future: FutureId,
    /// Its readable address.
    name: Name,
}

impl Clone for Memos {
    fn clone(&self) -> Self {
        Memos(self.0.clone())
    }

    #[inline]
    fn clone_from(&mut self, source: &Self) {
        if !(self.0.is_empty() && source.0.is_empty()) {
            self.0.clone_from(&source.0);
        }
    }
}

impl Memos {
    fn place(&self, path: u128) -> Result<usize, usize> {
        self.0.binary_search_by_key(&path, |call| call.path)
    }

    pub(super) fn find(&self, path: u128) -> Option<FutureId> {
        self.place(path).ok().map(|at| self.0[at].future)
    }

    pub(super) fn add(&mut self, path: u128, future: FutureId, name: &str) {
        if let Err(at) = self.place(path) {
            self.0.insert(at, Call { path, future, name: Name::from(name) });
        }
    }

    /// The readable address of a call.
    pub fn name(&self, path: u128) -> Option<&str> {
        self.place(path).ok().map(|at| &*self.0[at].name)
    }

    /// Records the readable address of a call in a trace, where the call has another number.
    pub fn note(&mut self, path: u128, name: &str) {
        self.add(path, FutureId::NONE, name);
    }

    /// Forgets a call.
    pub fn forget(&mut self, path: u128) {
        if let Ok(at) = self.place(path) {
            self.0.remove(at);
        }
    }

    /// A hash of the calls of the run.
    pub fn hash(&self, start: u128) -> u128 {
        self.0.iter().fold(start, |hash, call| join(join(hash, call.path), u128::from(call.future.0)))
    }

    /// Bytes of the table.
    pub fn bytes(&self) -> usize {
        self.0.len() * (size_of::<Call>() + 32)
    }
}

/// The identity of a memoised function, from the place where it was made and the function: one place may
/// memoise different functions, as a choice decides.
pub(crate) fn identity<S: Scalar>(place: u128, program: &Program<S>, called: FunctionId) -> u128 {
    join(place, site_key(&program.function(called).name, 0))
}

/// The address of a call, from the identity of the function and the text of the arguments in parentheses.
pub(crate) fn path_of(function: u128, text: &str) -> u128 {
    join(join(ROOT, function), site_key(text, 0))
}
