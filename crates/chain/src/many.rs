//! Several chains of a seed, in parallel. Each chain is the same on any number of threads.

use crate::Settings;
use crate::ladder::Ladder;
use niwaki_run::checkpoint::Checkpoint;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::invalid::{Count, Counts, Place};
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::sync::Mutex;
use std::sync::PoisonError;

/// The increase of counts by place.
fn more(counts: Counts, before: &Counts) -> Counts {
    let before: BTreeMap<&Place, u64> = before.iter().map(|(place, count)| (place, count.runs)).collect();
    let grown = |(place, count): (Place, Count)| {
        let runs = count.runs - before.get(&place).unwrap_or(&0);
        (place, Count { runs, ..count })
    };
    counts.into_iter().map(grown).filter(|(_, count)| count.runs > 0).collect()
}

/// A set of chains.
pub struct Chains {
    /// The chains.
    pub chains: Vec<Ladder>,
}

impl Chains {
    /// Start `count` chains in first states.
    ///
    /// # Errors
    /// The errors of [`Ladder::start`].
    pub fn start(
        task: &Task,
        settings: &Settings,
        count: usize,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Chains, Failure> {
        Chains::start_from(task, settings, count, known, None)
    }

    /// Like [`Chains::start`], but restore the chains that the checkpoint holds.
    ///
    /// # Errors
    /// The errors of [`Chains::start`]; data of another search.
    pub fn start_from(
        task: &Task,
        settings: &Settings,
        count: usize,
        known: Option<&HashMap<u128, Value>>,
        checkpoint: Option<&Checkpoint>,
    ) -> Result<Chains, Failure> {
        let task = &task.shared_by(count);
        let chains = (0..count as u64).into_par_iter().map(|number| {
            if let Some(stored) = checkpoint.map_or(Ok(None), |checkpoint| checkpoint.left(number))? {
                return Ladder::restored(task, settings, number, stored);
            }
            // Counted apart, so that a chain is stored with its own count.
            let uncounted = task.uncounted();
            let mut ladder = Ladder::start(&uncounted, settings, number, known)?;
            ladder.invalid = uncounted.invalid.counts();
            Ok(ladder)
        });
        let chains: Vec<Ladder> = chains.collect::<Result<_, _>>()?;
        for chain in &chains {
            task.invalid.add(chain.invalid.iter().cloned());
        }
        Ok(Chains { chains })
    }

    /// Make `steps` proposals in each chain. `watch` is called with the number of proposals of all chains and the best score; when it
    /// returns false, the chains stop. Returns whether `watch` stopped the chains.
    ///
    /// # Errors
    /// The errors of [`Ladder::advance`], of the first chain that fails.
    pub fn advance(
        &mut self,
        task: &Task,
        steps: u64,
        watch: &(dyn Fn(u64, f64) -> bool + Sync),
    ) -> Result<bool, Failure> {
        self.aim(steps);
        self.go_on(task, watch, None)
    }

    /// Increase the goal of each chain by a number of proposals.
    pub fn aim(&mut self, steps: u64) {
        self.chains.iter_mut().for_each(|chain| chain.end = chain.visit() + steps);
    }

    /// Increase the goal of chains without proposals.
    pub fn aim_anew(&mut self, steps: u64) {
        self.chains.iter_mut().filter(|chain| chain.visit() == 0).for_each(|chain| chain.end = steps);
    }

    /// Make the remaining proposals of each chain, like [`Chains::advance`]. Each chain is a part of the checkpoint. A chain is stored
    /// before its first new proposal if it has proposals, at borders on request, and at the end.
    ///
    /// # Errors
    /// The errors of [`Chains::advance`].
    pub fn go_on(
        &mut self,
        task: &Task,
        watch: &(dyn Fn(u64, f64) -> bool + Sync),
        checkpoint: Option<&Checkpoint>,
    ) -> Result<bool, Failure> {
        let store = |number: usize, chain: &Ladder| {
            let content = || chain.stored(&task.program, chain.invalid.clone());
            checkpoint.inspect(|storage| storage.store(number as u64, content));
        };
        let started = self.chains.iter().enumerate().filter(|(_, chain)| chain.visit() > 0);
        started.for_each(|(number, chain)| store(number, chain));
        let each: Vec<(u64, f64)> = self.chains.iter().map(|c| (c.visit(), c.best_score())).collect();
        let progress = Mutex::new((each, false));
        let task = &task.shared_by(self.chains.len());
        self.chains
            .par_iter_mut()
            .enumerate()
            .map(|(i, chain)| {
                let (uncounted, before) = (task.uncounted(), std::mem::take(&mut chain.invalid));
                uncounted.invalid.add(before.iter().cloned());
                let done = chain.go_on(&uncounted, &mut |chain| {
                    if let Some(checkpoint) = checkpoint {
                        let content = || chain.stored(&task.program, uncounted.invalid.counts());
                        checkpoint.at_border(i as u64, content);
                    }
                    let mut progress = progress.lock().unwrap_or_else(PoisonError::into_inner);
                    progress.0[i] = (chain.visit(), chain.best_score());
                    let done = progress.0.iter().map(|c| c.0).sum();
                    let best = progress.0.iter().map(|c| c.1).fold(f64::NEG_INFINITY, f64::max);
                    let go_on = watch(done, best);
                    progress.1 |= !go_on;
                    go_on
                });
                chain.invalid = uncounted.invalid.counts();
                task.invalid.add(more(chain.invalid.clone(), &before));
                done.inspect(|()| store(i, chain))
            })
            .collect::<Vec<_>>()
            .into_iter()
            .collect::<Result<(), Failure>>()?;
        Ok(progress.into_inner().unwrap_or_else(PoisonError::into_inner).1)
    }
}
