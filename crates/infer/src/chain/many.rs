//! Several chains of one seed, side by side on as many threads as there are; each is the same on any number of them.

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
        let chains =
            (0..count as u64).into_par_iter().map(|number| Ladder::start(task, settings, number, known));
        Ok(Chains { chains: chains.collect::<Result<Vec<_>, _>>()? })
    }

    /// Makes `steps` proposals in each. `watch` is told how many all of them have made, and the best score; when it
    /// answers false, they stop. Answers whether they were stopped.
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
        let told = Mutex::new((each, false));
        self.chains
            .par_iter_mut()
            .enumerate()
            .map(|(i, chain)| {
                chain.advance(task, steps, &mut |visit, best| {
                    let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
                    told.0[i] = (visit, best);
                    let done = told.0.iter().map(|c| c.0).sum();
                    let best = told.0.iter().map(|c| c.1).fold(f64::NEG_INFINITY, f64::max);
                    let go_on = watch(done, best);
                    told.1 |= !go_on;
                    go_on
                })
            })
            .collect::<Vec<_>>()
            .into_iter()
            .collect::<Result<(), Failure>>()?;
        Ok(told.into_inner().unwrap_or_else(PoisonError::into_inner).1)
    }
}
