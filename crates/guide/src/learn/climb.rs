//! Steps on rows with signed weights, which make up the gradient of a bound (Mnih & Rezende 2016).
//!
//! A score-function gradient is a sum over choices, each with the weight `a` of the run that made it:
//!
//! ```text
//! slope = sum over rows of a grad ln q(row)
//! ```
//!
//! Adam steps along this slope. The present network draws new rows for each step; means and deviations of inputs
//! are those of the rows at the start of the state.

use super::rows::Rows;
use super::stored::{Moving, Stored, Unfit};
use super::train::{Chunk, Progress, State, Training};
use crate::net::{Net, Real};

/// A climb: a [`State`] whose steps follow signed weights.
pub struct Climb<T: Real = f32> {
    state: State<T>,
    chunks: Vec<Chunk<T>>,
}

impl<T: Real> Climb<T> {
    /// A climb before its first step. The rows standardise the inputs; a network that was trained before keeps its answers.
    pub fn new(net: Net<T>, rows: &Rows) -> Climb<T> {
        Climb { state: State::new(net, rows), chunks: Vec::new() }
    }

    /// The number of steps so far.
    pub fn step(&self) -> u64 {
        self.state.step()
    }

    /// The present network.
    pub fn net(&self) -> Net<T> {
        self.state.folded(self.state.net.weights.clone())
    }

    /// The network with averaged weights; before the first step, the present network.
    pub fn averaged(&self, averaging: f64) -> Net<T> {
        self.state.folded(self.state.averaged(averaging))
    }

    /// The best network so far, its loss and its step.
    pub fn best(&self) -> (Net<T>, f64, u64) {
        let (loss, step, weights) = &self.state.best;
        (self.state.folded(weights.clone()), *loss, *step)
    }

    /// Stores the averaged weights as the best if their loss is the smallest so far.
    pub fn judge(&mut self, loss: f64, averaging: f64) {
        if loss < self.state.best.0 {
            self.state.best = (loss, self.step(), self.state.averaged(averaging));
        }
    }

    /// The sum over rows of `weights` times the slope of `ln q`, by each weight of the network.
    ///
    /// # Errors
    /// The site of the first row whose loss or slope is not finite; `None` if only the sum is not finite.
    pub fn slope(&mut self, rows: &Rows, weights: &[f64], share: f64) -> Result<Vec<T>, Option<usize>> {
        let picks: Vec<usize> = (0..rows.len()).filter(|row| weights[*row] != 0.0).collect();
        if picks.is_empty() {
            return Ok(vec![T::ZERO; self.state.net.weights.len()]);
        }
        self.state.room(picks.len(), &mut self.chunks);
        // A loss is minus `ln q`, up to a constant.
        let times = |row: usize| -weights[row];
        match self.state.slope(rows, &picks, &times, share, &mut self.chunks) {
            Ok(_) => Ok(self.chunks[0].slope.clone()),
            Err((site, _)) => Err(site),
        }
    }

    /// A step along the sum of [`Climb::slope`].
    ///
    /// # Errors
    /// See [`Climb::slope`]; the weights then stay unchanged.
    pub fn advance(&mut self, rows: &Rows, weights: &[f64], with: &Training) -> Result<(), Option<usize>> {
        let slope = self.slope(rows, weights, with.share)?;
        let (adam, mut moved) = (&mut self.state.adam, self.state.net.weights.clone());
        adam.advance(&mut moved, &slope, -1.0, with.rate, with.averaging);
        if moved.iter().any(|w| !w.to_f64().is_finite()) {
            return Err(None);
        }
        self.state.net.weights = moved;
        Ok(())
    }

    /// The state as data.
    pub fn stored(&self, history: &[Progress]) -> Stored {
        let State { net, adam, best, .. } = &self.state;
        Stored::of(&net.weights, adam, best, (0.0, 0.0), history)
    }

    /// Resumes from the data of a climb with the same start.
    ///
    /// # Errors
    /// The data belongs to another climb.
    pub fn resume(&mut self, stored: &Stored) -> Result<Vec<Progress>, Unfit> {
        let (mut history, mut sums) = (Vec::new(), (0.0, 0.0));
        let State { net, adam, best, .. } = &mut self.state;
        let weights = &mut net.weights;
        let moving = Moving { weights, adam, best, sums: &mut sums, history: &mut history };
        if stored.put(moving) { Ok(history) } else { Err(Unfit) }
    }
}
