//! Parallel tempering: chains at falling powers of the score that exchange their states (Geyer 1991).
//!
//! Rung i follows prior * exp(beta_i log score); neighbours exchange states with probability
//! min(1, exp((beta_i - beta_j)(log score_j - log score_i))). The prior is not tempered. A search without tempering is a
//! ladder of one rung.

use super::accept::{MetropolisHastings, Rules};
use super::streams::Streams;
use super::{Chain, Settings};
use crate::{Failure, Task};
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;

/// Rungs have chain numbers this far apart.
const APART: u64 = 1 << 40;

/// Chains at falling powers of the score; the first follows the posterior.
pub struct Ladder<R: Rules = MetropolisHastings> {
    /// The rungs, coldest first.
    pub rungs: Vec<Chain<R>>,
    every: u64,
    streams: Streams,
    /// Exchanges tried and made between each rung and the next.
    pub exchanges: Vec<(u64, u64)>,
}

impl<R: Rules> Ladder<R> {
    /// The `number`-th ladder of a seed.
    ///
    /// # Errors
    /// As for [`Chain::start`].
    pub fn start(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Ladder<R>, Failure> {
        Ladder::start_at(task, settings, number, |_| known)
    }

    /// As [`Ladder::start`], each rung with first values of its own.
    ///
    /// # Errors
    /// As for [`Chain::start`].
    pub fn start_at<'a>(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: impl Fn(usize) -> Option<&'a HashMap<u128, Value>>,
    ) -> Result<Ladder<R>, Failure> {
        let mut rungs = Vec::new();
        for (rung, power) in settings.powers.iter().enumerate() {
            let mut own = settings.clone();
            if rung > 0 {
                own.thin = 0;
            }
            let mut chain = Chain::start(task, &own, number + rung as u64 * APART, known(rung))?;
            chain.beta = *power;
            rungs.push(chain);
        }
        let exchanges = vec![(0, 0); rungs.len().saturating_sub(1)];
        let streams = Streams::new(settings.seed, number + APART * (APART >> 20));
        Ok(Ladder { rungs, every: settings.every.max(1), streams, exchanges })
    }

    /// Makes `steps` proposals on each rung; as for [`Chain::advance`].
    ///
    /// # Errors
    /// As for [`Chain::advance`].
    pub fn advance(
        &mut self,
        task: &Task,
        steps: u64,
        watch: &mut dyn FnMut(u64, f64) -> bool,
    ) -> Result<(), Failure> {
        if let [only] = &mut self.rungs[..] {
            return only.advance(task, steps, watch);
        }
        let end = self.visit() + steps;
        while self.visit() < end {
            let block = (self.every - self.visit() % self.every).min(end - self.visit());
            self.rungs
                .par_iter_mut()
                .map(|rung| rung.advance(task, block, &mut |_, _| true))
                .collect::<Result<Vec<()>, Failure>>()?;
            self.exchange_if_due();
            if !watch(self.visit(), self.best_score()) {
                break;
            }
        }
        Ok(())
    }

    /// Every other pair of neighbours, by turns, may exchange states, if this is the time.
    pub(super) fn exchange_if_due(&mut self) {
        if !self.visit().is_multiple_of(self.every) {
            return;
        }
        let round = self.visit() / self.every;
        let mut rng = self.streams.decisions(round);
        for low in ((round % 2) as usize..self.exchanges.len()).step_by(2) {
            let (below, above) = self.rungs.split_at_mut(low + 1);
            let (cold, hot) = (&mut below[low], &mut above[0]);
            let gain = hot.state.score().less(&cold.state.score()).value();
            let log_ratio = R::log_exchange((cold.beta, hot.beta), gain);
            self.exchanges[low].0 += 1;
            if rng.uniform().ln() < log_ratio {
                self.exchanges[low].1 += 1;
                cold.exchange_with(hot);
            }
        }
    }

    /// The proposals made on each rung.
    pub fn visit(&self) -> u64 {
        self.rungs.first().map_or(0, Chain::visit)
    }

    /// The best log score of any rung, nats.
    pub fn best_score(&self) -> f64 {
        self.rungs.iter().map(|rung| rung.best.score()).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The rung with the best state.
    pub fn best(&self) -> Option<&Chain<R>> {
        self.rungs.iter().max_by(|a, b| a.best.score().total_cmp(&b.best.score()))
    }
}
