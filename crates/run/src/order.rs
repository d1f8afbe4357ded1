//! Which future runs next: the order policies of particles.
//!
//! A learned policy picks the future `f` of those that can run with probability
//!
//! ```text
//! pi(f) = exp(l(f)) / sum over all that can run of exp(l)
//! l(f) = function(f) + depth ln(1 + depth(f)) + turns ln(1 + turns(f)) + waited ln(1 + waited(f)) + stay [f ran last]
//! ```
//!
//! `depth` is how many futures are around it, `turns` how often it has run, `waited` how often others have run since it ran
//! last or was created. It sees only what has happened, so the law of the choices is the same under any policy, and its
//! probability never enters a weight (dissertation 5.3.1 and appendix C). It counts in one place: particle Gibbs draws
//! ancestors for a held run, whose order is then less likely after some prefixes than after others.

use crate::setting::{Range, Ranges};
use niwaki_vm::code::Program;
use niwaki_vm::machine::state::{FutureId, State};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Which future runs next.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Futures run where they are created: ordinary SMC.
    DepthFirst,
    /// A uniform draw among all runnable futures after each barrier (SOSMC, dissertation 5.3).
    Stochastic,
    /// A draw by a policy.
    Learned(Arc<Policy>),
}

impl Order {
    /// The policy, where it is a learned one.
    pub fn policy(&self) -> Option<&Arc<Policy>> {
        match self {
            Order::Learned(policy) => Some(policy),
            Order::DepthFirst | Order::Stochastic => None,
        }
    }
}

/// As data: a word, or the numbers of a policy.
#[derive(Deserialize)]
#[serde(untagged)]
enum OrderForm {
    Word(Word),
    Learned(Policy),
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Word {
    DepthFirst,
    Stochastic,
}

impl<'de> Deserialize<'de> for Order {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Order, D::Error> {
        Ok(match OrderForm::deserialize(from)? {
            OrderForm::Word(Word::DepthFirst) => Order::DepthFirst,
            OrderForm::Word(Word::Stochastic) => Order::Stochastic,
            OrderForm::Learned(policy) => Order::Learned(Arc::new(policy)),
        })
    }
}

/// The numbers of a learned policy, nats.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct Policy {
    /// For futures that call the function of this qualified name; 0 for others.
    pub functions: BTreeMap<String, f64>,
    /// Times the log of one more than the number of futures around it.
    pub depth: f64,
    /// Times the log of one more than how often it has run.
    pub turns: f64,
    /// Times the log of one more than how often others have run since it did.
    pub waited: f64,
    /// For the future that ran last.
    pub stay: f64,
}

/// Numbers of a policy. Beyond them the other futures have no chance that a search could see.
const NUMBER: Range = Range::Real { low: -50.0, high: 50.0, ends: "[]" };

impl Policy {
    /// Ranges of its numbers.
    pub const RANGES: Ranges = &[
        ("depth", NUMBER),
        ("turns", NUMBER),
        ("waited", NUMBER),
        ("stay", NUMBER),
        ("functions", Range::Table(Some(&NUMBER))),
    ];
}

/// What a policy has seen of a future.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// The part of `l` that does not change.
    fixed: f64,
    depth: u32,
    turns: u32,
    /// The turn of the run at which it was created or ran last.
    since: u32,
}

/// What a policy has seen of a run. Without a policy it sees nothing, and costs nothing.
#[derive(Debug, Default)]
pub struct Past {
    policy: Option<Arc<Policy>>,
    /// By the number of the future.
    futures: Vec<Option<Seen>>,
    /// The future that ran last.
    last: Option<FutureId>,
    /// Its depth.
    last_depth: u32,
    /// How many turns the run has had.
    turn: u32,
}

impl Clone for Past {
    fn clone(&self) -> Past {
        let mut copy = Past::default();
        copy.clone_from(self);
        copy
    }

    #[inline]
    fn clone_from(&mut self, source: &Past) {
        if source.policy.is_none() && self.policy.is_none() {
            return;
        }
        self.policy.clone_from(&source.policy);
        self.futures.clone_from(&source.futures);
        (self.last, self.last_depth, self.turn) = (source.last, source.last_depth, source.turn);
    }
}

impl Past {
    /// That of a run that has not begun.
    pub fn start(order: &Order) -> Past {
        Past { policy: order.policy().cloned(), ..Past::default() }
    }

    /// Before a future runs: looks at those that can run now, of which the last one that ran has created the new ones.
    pub fn look(&mut self, program: &Program, state: &State) {
        let Some(policy) = &self.policy else { return };
        let depth = self.last.map_or(0, |_| self.last_depth + 1);
        for id in state.runnable().iter() {
            let at = id.0 as usize;
            if self.futures.len() <= at {
                self.futures.resize(at + 1, None);
            }
            if self.futures[at].is_none() {
                let name = state.function_of(id).map(|own| &program.function(own).name);
                let function = name.and_then(|name| policy.functions.get(&**name)).copied().unwrap_or(0.0);
                let fixed = function + policy.depth * f64::from(depth).ln_1p();
                self.futures[at] = Some(Seen { fixed, depth, turns: 0, since: self.turn });
            }
        }
    }

    /// After a future ran.
    pub fn ran(&mut self, future: FutureId, state: &State) {
        if self.policy.is_none() {
            return;
        }
        self.turn += 1;
        self.last = Some(future);
        let Some(own) = self.futures.get_mut(future.0 as usize) else { return };
        if let Some(seen) = own {
            self.last_depth = seen.depth;
            seen.turns += 1;
            seen.since = self.turn;
        }
        if state.has_returned(future) {
            *own = None;
        }
    }

    /// The logs of the weights of the futures that can run, in their order; nothing where all are alike.
    pub fn logs(&self, state: &State) -> Option<Vec<f64>> {
        let policy = self.policy.as_ref()?;
        let log = |id: FutureId| {
            let Some(Some(seen)) = self.futures.get(id.0 as usize) else { return 0.0 };
            let stays = if self.last == Some(id) { policy.stay } else { 0.0 };
            let waited = f64::from(self.turn - seen.since).ln_1p();
            seen.fixed + policy.turns * f64::from(seen.turns).ln_1p() + policy.waited * waited + stays
        };
        Some(state.runnable().iter().map(log).collect())
    }

    /// The place among the futures that can run into whose share of all `u`, between 0 and 1, falls.
    pub fn pick(&self, state: &State, u: f64) -> usize {
        match self.logs(state) {
            None => {
                let n = state.runnable().len();
                ((u * n as f64) as usize).min(n - 1)
            }
            Some(logs) => crate::weights::index(&relative(&logs), u),
        }
    }

    /// The log probability of running the future at that place.
    pub fn log_probability(&self, state: &State, which: usize) -> f64 {
        match self.logs(state) {
            None => -(state.runnable().len() as f64).ln(),
            Some(logs) => {
                let all = relative(&logs);
                (all[which] / all.iter().sum::<f64>()).ln()
            }
        }
    }
}

/// Weights relative to the largest.
fn relative(logs: &[f64]) -> Vec<f64> {
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    logs.iter().map(|log| (log - most).exp()).collect()
}
