//! Training between two steps, as data: weights, the state of the optimiser, the progress.

use super::{Adam, Progress};
use crate::net::Real;
use serde::{Deserialize, Serialize};

/// Training between two steps. Reals are stored as the bits of the equal `f64`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stored {
    weights: Vec<u64>,
    moments: [Vec<u64>; 2],
    average: Vec<u64>,
    step: u64,
    /// The smallest loss so far, its step and its weights.
    best: (u64, u64, Vec<u64>),
    /// Sum of the losses since the last look, and their number.
    sums: (u64, u64),
    history: Vec<Progress>,
}

/// The parts of training that change from step to step.
pub(crate) struct Moving<'a, T: Real> {
    pub weights: &'a mut Vec<T>,
    pub adam: &'a mut Adam<T>,
    pub best: &'a mut (f64, u64, Vec<T>),
    pub sums: &'a mut (f64, f64),
    pub history: &'a mut Vec<Progress>,
}

fn bits<T: Real>(numbers: &[T]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_f64().to_bits()).collect()
}

fn numbers<T: Real>(bits: &[u64]) -> Vec<T> {
    bits.iter().map(|x| T::from_f64(f64::from_bits(*x))).collect()
}

impl Stored {
    /// The progress at the looks so far.
    pub fn history(&self) -> &[Progress] {
        &self.history
    }

    /// The parts of training as data.
    pub(crate) fn of<T: Real>(
        weights: &[T],
        adam: &Adam<T>,
        best: &(f64, u64, Vec<T>),
        sums: (f64, f64),
        history: &[Progress],
    ) -> Stored {
        let (moments, average, step) = adam.parts();
        Stored {
            weights: bits(weights),
            moments: [bits(&moments[0]), bits(&moments[1])],
            average: bits(average),
            step,
            best: (best.0.to_bits(), best.1, bits(&best.2)),
            sums: (sums.0.to_bits(), sums.1.to_bits()),
            history: history.to_vec(),
        }
    }

    /// Sets the parts of training from the data. If the data is of a network of another size, returns false and changes nothing.
    pub(crate) fn put<T: Real>(&self, to: Moving<'_, T>) -> bool {
        let size = to.weights.len();
        let all = [&self.weights, &self.moments[0], &self.moments[1], &self.average];
        if all.iter().any(|weights| weights.len() != size) || ![0, size].contains(&self.best.2.len()) {
            return false;
        }
        *to.weights = numbers(&self.weights);
        let moments = [numbers(&self.moments[0]), numbers(&self.moments[1])];
        to.adam.put(moments, numbers(&self.average), self.step);
        *to.best = (f64::from_bits(self.best.0), self.best.1, numbers(&self.best.2));
        *to.sums = (f64::from_bits(self.sums.0), f64::from_bits(self.sums.1));
        to.history.clone_from(&self.history);
        true
    }
}

/// The start of a training, and its observer at the borders between two steps.
pub struct Way<'a> {
    /// Data from which training resumes.
    pub left: Option<Stored>,
    /// Called between two steps.
    pub border: &'a mut dyn FnMut(&dyn Fn() -> Stored),
}

/// The error that data belongs to another training.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unfit;
