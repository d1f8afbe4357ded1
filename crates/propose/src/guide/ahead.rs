//! The line of a guide that looks ahead: what its network sees at the next choices says how much the score will still rise.
//!
//! A run that is paused at a barrier has drawn nothing yet of what follows, but where it goes on is known: each future that can
//! run is run, in a copy, up to its next choice, and the guide looks from there at the scene so far. With
//!
//! ```text
//! g = root(log score now)      root(x) = sign(x) sqrt|x|,    square(x) = x |x|
//! h = the second hidden layers at these choices, added up
//! n = how many they are,       m = how many futures come to any other stop
//! ```
//!
//! what a guide has learned is a line for the root of the log score in the end, and the rise that it says follows:
//!
//! ```text
//! root(log score in the end) = a + line in (n  m  g  g^2  g n  g m  h  g h)
//! rise = square(a + line) - log score now
//! ```
//!
//! A root, because log scores fall off with the square of a distance (of similarities from 1, say): a line in distances
//! is fitted as well to runs that match nearly as to those that miss by far. The line is held within what its lessons had.
//!
//! The copies draw nothing, so the forecast is a function of the run ([`foresight`](crate::foresight)). `niwaki-search` fits the line.

use serde::{Deserialize, Serialize};

/// Inputs beside the hidden layer.
pub(crate) const BESIDE: usize = 6;
/// Those that the score alone decides.
pub const OF_SCORE: std::ops::Range<usize> = 2..4;

/// The line of a guide that looks ahead.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AheadForm {
    /// The root of the log score in the end where all inputs are zero.
    pub constant: f64,
    /// The slope of each input.
    pub weights: Vec<f64>,
    /// The lowest and the highest root that it says: those of its lessons.
    pub range: (f64, f64),
}

impl AheadForm {
    /// Whether it is a line for networks with so many units in the second hidden layer.
    pub fn fits(&self, hidden: usize) -> bool {
        let numbers = self.weights.iter().chain([&self.constant, &self.range.0, &self.range.1]);
        self.weights.len() == inputs(hidden)
            && numbers.into_iter().all(|x| x.is_finite())
            && self.range.0 <= self.range.1
    }

    /// Whether it sees more than the score.
    pub(crate) fn looks(&self) -> bool {
        let mut weights = self.weights.iter().enumerate();
        weights.any(|(k, weight)| *weight != 0.0 && !OF_SCORE.contains(&k))
    }

    /// The rise that it says of a run with these inputs and this log score, nats.
    pub fn rise(&self, inputs: &[f64], log_score: f64) -> f64 {
        let sum: f64 = self.weights.iter().zip(inputs).map(|(weight, x)| weight * x).sum();
        let end = (self.constant + sum).clamp(self.range.0, self.range.1);
        end * end.abs() - log_score
    }
}

/// The root of a log score, with its sign.
pub fn root(log_score: f64) -> f64 {
    log_score.abs().sqrt().copysign(log_score)
}

/// How many inputs a line has, for networks with so many units in the second hidden layer.
pub fn inputs(hidden: usize) -> usize {
    BESIDE + 2 * hidden
}
