//! A hidden Markov chain: a new state changes its own emission and the transition to the next state.
use super::{Model, SAME, Step, indices, numbers};
use crate::population::{Random, cumulative, uniform};
use serde_json::Value;

pub struct Hmm {
    states: usize,
    symbols: usize,
    initial: Vec<f64>,
    /// `[from * states + to]`.
    transition: Vec<f64>,
    /// `[state * symbols + symbol]`.
    emission: Vec<f64>,
    initial_sums: Vec<f64>,
    transition_sums: Vec<f64>,
    seen: Vec<u32>,
    z: Vec<u8>,
}

impl Hmm {
    pub fn new(data: &Value, random: &mut Random) -> Self {
        let rows = |name: &str| -> Vec<Vec<f64>> {
            data[name].as_array().expect("rows").iter().map(numbers).collect()
        };
        let (initial, transition, emission) =
            (numbers(&data["initial"]), rows("transition"), rows("emission"));
        let mut made = Self {
            states: initial.len(),
            symbols: emission[0].len(),
            initial_sums: cumulative(&initial),
            transition_sums: transition.iter().flat_map(|row| cumulative(row)).collect(),
            transition: transition.concat(),
            emission: emission.concat(),
            seen: indices(&data["observations"]),
            z: vec![],
            initial,
        };
        for i in 0..made.seen.len() {
            let state = made.draw(i, random) as u8;
            made.z.push(state);
        }
        made
    }

    /// A state of step `i` from the prior.
    #[inline]
    fn draw(&self, i: usize, random: &mut Random) -> usize {
        if i == 0 {
            return crate::population::draw(random, &self.initial_sums);
        }
        let row = usize::from(self.z[i - 1]) * self.states;
        crate::population::draw(random, &self.transition_sums[row..row + self.states])
    }

    fn prior(&self, i: usize, state: usize) -> f64 {
        if i == 0 {
            self.initial[state]
        } else {
            self.transition[usize::from(self.z[i - 1]) * self.states + state]
        }
    }
}

impl Model for Hmm {
    fn choices(&self) -> usize {
        self.z.len()
    }

    fn globals(&self) -> std::ops::Range<usize> {
        0..0
    }

    fn readers(&self, _: usize) -> usize {
        0
    }

    #[inline]
    fn propose<const CHECKED: bool>(&mut self, i: usize, random: &mut Random, forced: bool) -> Step {
        let (old, new) = (usize::from(self.z[i]), self.draw(i, random));
        if new == old {
            return SAME;
        }
        let symbol = self.seen[i] as usize;
        let mut there = self.emission[new * self.symbols + symbol];
        let mut here = self.emission[old * self.symbols + symbol];
        if let Some(&next) = self.z.get(i + 1) {
            there *= self.transition[new * self.states + usize::from(next)];
            here *= self.transition[old * self.states + usize::from(next)];
        }
        let accepted = forced || uniform(random) * here < there;
        if accepted {
            self.z[i] = new as u8;
        }
        if !CHECKED {
            return Step { accepted, ..Step::default() };
        }
        let own_prior = (self.prior(i, new) / self.prior(i, old)).ln();
        Step { accepted, log_ratio: (there / here).ln(), own_prior }
    }

    fn log_joint(&self) -> f64 {
        let term = |i: usize| {
            let state = usize::from(self.z[i]);
            self.prior(i, state) * self.emission[state * self.symbols + self.seen[i] as usize]
        };
        (0..self.z.len()).map(|i| term(i).ln()).sum()
    }

    /// How often each state was met, step after step.
    fn moments(&self) -> Vec<f64> {
        let mut all = vec![0.0; self.z.len() * self.states];
        for (i, &state) in self.z.iter().enumerate() {
            all[i * self.states + usize::from(state)] = 1.0;
        }
        all
    }
}
