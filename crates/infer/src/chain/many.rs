//! Several chains of one seed, in parallel. Each chain is the same on any number of threads.

use super::Settings;
use super::accept::{MetropolisHastings, Rules};
use super::ladder::Ladder;

use crate::{Failure, Task};
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Mutex;
use std::sync::PoisonError;

/// Several chains.
pub struct Chains<R: Rules = MetropolisHastings> {
    /// The chains.
    pub chains: Vec<Ladder<R>>,
}

impl<R: Rules> Chains<R> {
    /// `count` chains in their first states.
    ///
    /// # Errors
    /// As for [`Ladder::start`].
    pub fn start(
        task: &Task,
        settings: &Settings,
        count: usize,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Chains<R>, Failure> {
        let task = &task.shared_by(count);
        let chains =
            (0..count as u64).into_par_iter().map(|number| Ladder::start(task, settings, number, known));
        Ok(Chains { chains: chains.collect::<Result<Vec<_>, _>>()? })
    }

    /// Makes `steps` proposals in each. `watch` is called with the proposals of all chains so far and the best score;
    /// when it returns false, the chains stop. Returns whether they were stopped.
    ///
    /// # Errors
    /// As for [`Ladder::advance`]: the failure of the first chain that failed.
    pub fn advance(
        &mut self,
        task: &Task,
        steps: u64,
        watch: &(dyn Fn(u64, f64) -> bool + Sync),
    ) -> Result<bool, Failure> {
        let each: Vec<(u64, f64)> = self.chains.iter().map(|c| (c.visit(), c.best_score())).collect();
        let progress = Mutex::new((each, false));
        let task = &task.shared_by(self.chains.len());
        self.chains
            .par_iter_mut()
            .enumerate()
            .map(|(i, chain)| {
                chain.advance(task, steps, &mut |visit, best| {
                    let mut progress = progress.lock().unwrap_or_else(PoisonError::into_inner);
                    progress.0[i] = (visit, best);
                    let done = progress.0.iter().map(|c| c.0).sum();
                    let best = progress.0.iter().map(|c| c.1).fold(f64::NEG_INFINITY, f64::max);
                    let go_on = watch(done, best);
                    progress.1 |= !go_on;
                    go_on
                })
            })
            .collect::<Vec<_>>()
            .into_iter()
            .collect::<Result<(), Failure>>()?;
        Ok(progress.into_inner().unwrap_or_else(PoisonError::into_inner).1)
    }
}
