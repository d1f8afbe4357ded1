//! Parallel tempering: chains at falling powers of the score that exchange their states (Geyer 1991).
//!
//! Rung i follows prior * exp(beta_i log score); neighbours exchange states with probability
//! min(1, exp((beta_i - beta_j)(log score_j - log score_i))). The prior is not tempered. A search without tempering is a
//! ladder with a single rung.

use crate::walk::accept::log_exchange;
use crate::walk::streams::Streams;
use crate::{Chain, Settings};
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::invalid::Counts;
use niwaki_vm::value::Value;
use rayon::prelude::*;
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// The distance between the chain numbers of neighbouring rungs.
const APART: u64 = 1 << 40;

/// The most proposals between two borders of a chain.
const BLOCK: u64 = 1024;
/// The approximate time between two borders if proposals are slow.
const TIME: Duration = Duration::from_millis(20);

/// The number of proposals between two borders.
struct Pace(u64);

impl Default for Pace {
    fn default() -> Pace {
        Pace(BLOCK)
    }
}

impl Pace {
    /// Run up to that number of proposals, and reduce the number if they took long.
    fn keep<T>(&mut self, make: impl FnOnce(u64) -> T) -> T {
        let began = Instant::now();
        let answer = make(self.0);
        let time = began.elapsed();
        self.0 = if time > TIME { (self.0 / 2).max(1) } else { (2 * self.0).min(BLOCK) };
        answer
    }
}

/// Chains at falling powers of the score; the first follows the posterior.
pub struct Ladder {
    /// The rungs, coldest first.
    pub rungs: Vec<Chain>,
    number: u64,
    every: u64,
    streams: Streams,
    /// The number of tried and of accepted exchanges between each rung and the next.
    pub exchanges: Vec<(u64, u64)>,
    /// The goal: the number of proposals after which the ladder stops.
    pub(super) end: u64,
    /// Invalid runs, by place.
    pub(super) invalid: Counts,
}

impl Ladder {
    /// Start the `number`-th ladder of a seed.
    ///
    /// # Errors
    /// The errors of [`Chain::start`].
    pub fn start(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: Option<&HashMap<u128, Value>>,
    ) -> Result<Ladder, Failure> {
        Ladder::start_at(task, settings, number, |_| known)
    }

    /// Like [`Ladder::start`], with first values for each rung.
    ///
    /// # Errors
    /// The errors of [`Chain::start`].
    pub fn start_at<'a>(
        task: &Task,
        settings: &Settings,
        number: u64,
        known: impl Fn(usize) -> Option<&'a HashMap<u128, Value>>,
    ) -> Result<Ladder, Failure> {
        let mut ladder = Ladder::without_rungs(settings, number);
        for rung in 0..settings.powers.len() {
            ladder.add(rung, settings, |rung_settings, number| {
                Chain::start(task, rung_settings, number, known(rung))
            })?;
        }
        Ok(ladder)
    }

    /// Create the `number`-th ladder of a seed without chains.
    pub(super) fn without_rungs(settings: &Settings, number: u64) -> Ladder {
        Ladder {
            rungs: vec![],
            number,
            every: settings.every.max(1),
            streams: Streams::new(settings.seed, number + APART * (APART >> 20)),
            exchanges: vec![(0, 0); settings.powers.len().saturating_sub(1)],
            end: 0,
            invalid: vec![],
        }
    }

    /// Add the next rung. `make` creates its chain from settings and a number.
    ///
    /// # Errors
    /// The errors of `make`.
    pub(super) fn add(
        &mut self,
        rung: usize,
        settings: &Settings,
        make: impl FnOnce(&Settings, u64) -> Result<Chain, Failure>,
    ) -> Result<(), Failure> {
        let mut rung_settings = settings.clone();
        if rung > 0 {
            rung_settings.thin = 0;
        }
        let mut chain = make(&rung_settings, self.number + rung as u64 * APART)?;
        chain.beta = settings.powers[rung];
        self.rungs.push(chain);
        Ok(())
    }

    /// Make `steps` proposals on each rung, like [`Chain::advance`].
    ///
    /// # Errors
    /// The errors of [`Chain::advance`].
    pub fn advance(
        &mut self,
        task: &Task,
        steps: u64,
        watch: &mut dyn FnMut(u64, f64) -> bool,
    ) -> Result<(), Failure> {
        self.end = self.visit() + steps;
        self.go_on(task, &mut |ladder| watch(ladder.visit(), ladder.best_score()))
    }

    /// Makes the proposals that are left. `watch` is called at borders, between two proposals; when it returns false, the
    /// ladder stops.
    ///
    /// # Errors
    /// The errors of [`Chain::advance`].
    pub(super) fn go_on(&mut self, task: &Task, watch: &mut dyn FnMut(&Self) -> bool) -> Result<(), Failure> {
        let mut pace = Pace::default();
        while self.visit() < self.end {
            let left = self.end - self.visit();
            if let [only] = &mut self.rungs[..] {
                pace.keep(|steps| only.advance(task, steps.min(left), &mut |_, _| true))?;
            } else {
                let block = (self.every - self.visit() % self.every).min(left);
                self.rungs
                    .par_iter_mut()
                    .map(|rung| rung.advance(task, block, &mut |_, _| true))
                    .collect::<Result<Vec<()>, Failure>>()?;
                self.exchange_if_due();
            }
            if !watch(self) {
                break;
            }
        }
        Ok(())
    }

    /// Tries to exchange states between every other pair of neighbours, alternating, where an exchange is due.
    pub fn exchange_if_due(&mut self) {
        if !self.visit().is_multiple_of(self.every) {
            return;
        }
        let round = self.visit() / self.every;
        let mut rng = self.streams.decisions(round);
        for low in ((round % 2) as usize..self.exchanges.len()).step_by(2) {
            let (below, above) = self.rungs.split_at_mut(low + 1);
            let (cold, hot) = (&mut below[low], &mut above[0]);
            let gain = hot.state.score().less(&cold.state.score()).value();
            let log_ratio = log_exchange((cold.beta, hot.beta), gain);
            self.exchanges[low].0 += 1;
            if rng.uniform().ln() < log_ratio {
                self.exchanges[low].1 += 1;
                cold.exchange_with(hot);
            }
        }
    }

    /// The proposals made on each rung.
    pub fn visit(&self) -> u64 {
        self.rungs.first().map_or(0, |chain| chain.visit())
    }

    /// The best log score of any rung, nats.
    pub fn best_score(&self) -> f64 {
        self.rungs.iter().map(|rung| rung.best.score()).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The rung with the best state.
    pub fn best(&self) -> Option<&Chain> {
        self.rungs.iter().max_by(|a, b| a.best.score().total_cmp(&b.best.score()))
    }
}
