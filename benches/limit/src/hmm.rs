//! The bootstrap filter on a hidden Markov chain: a state and an observation at each step.
//!
//! Weight of step n: `emission[state][observation[n]]`. Evidence: the product of the mean weights.
use crate::Run;
use crate::population::{Random, cumulative, draw, resample};

/// A chain with its observations; the first two tables hold running sums, ready to draw from.
pub struct Hmm {
    first: Vec<f64>,
    next: Vec<Vec<f64>>,
    emission: Vec<Vec<f64>>,
    observations: Vec<usize>,
}

impl Hmm {
    /// Reads the file that `../data.py` writes.
    pub fn read(path: &str) -> Self {
        let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let data: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let list = |value: &serde_json::Value| value.as_array().cloned().expect("a list");
        let row = |value: &serde_json::Value| -> Vec<f64> {
            list(value).iter().filter_map(|p| p.as_f64()).collect()
        };
        Self {
            first: cumulative(&row(&data["initial"])),
            next: list(&data["transition"]).iter().map(|value| cumulative(&row(value))).collect(),
            emission: list(&data["emission"]).iter().map(row).collect(),
            observations: row(&data["observations"]).iter().map(|&index| index as usize).collect(),
        }
    }

    /// One run of the filter, resampling at every observation.
    pub fn filter(&self, particles: usize, random: &mut Random) -> Run {
        let mut states: Vec<u8> = (0..particles).map(|_| draw(random, &self.first) as u8).collect();
        let mut survivors = states.clone();
        let (mut weights, mut parents) = (vec![0.0; particles], vec![0u32; particles]);
        let mut log_evidence = 0.0;
        for (n, &seen) in self.observations.iter().enumerate() {
            let mut total = 0.0;
            for (state, weight) in states.iter_mut().zip(&mut weights) {
                if n > 0 {
                    *state = draw(random, &self.next[usize::from(*state)]) as u8;
                }
                *weight = self.emission[usize::from(*state)][seen];
                total += *weight;
            }
            log_evidence += (total / particles as f64).ln();
            resample(&weights, total, random, &mut parents);
            for (survivor, &parent) in survivors.iter_mut().zip(&parents) {
                *survivor = states[parent as usize];
            }
            std::mem::swap(&mut states, &mut survivors);
        }
        Run { steps: (particles * self.observations.len()) as u64, log_evidence }
    }
}
