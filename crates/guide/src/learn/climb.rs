//! Steps on rows that count by signed weights: what the gradient of a bound is made of (Mnih & Rezende 2016).
//!
//! A score-function gradient is a sum over choices, each with the weight `a` of the run that made it:
//!
//! ```text
//! slope = sum over rows of a grad ln q(row)
//! ```
//!
//! A step of Adam goes along it. The rows of each step are others, drawn by the present network; means and deviations of
//! inputs are those of the rows that the state was begun with.

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
    /// Before the first step. Inputs are standardised by the rows; a network that was trained before keeps its answers.
    pub fn new(net: Net<T>, rows: &Rows) -> Climb<T> {
        Climb { state: State::new(net, rows), chunks: Vec::new() }
    }

    /// Steps done.
    pub fn step(&self) -> u64 {
        self.state.step()
    }

    /// The present network.
    pub fn net(&self) -> Net<T> {
        self.state.folded(self.state.net.weights.clone())
    }

    /// The network with averaged weights; before the first step, the present one.
    pub fn averaged(&self, averaging: f64) -> Net<T> {
        self.state.folded(self.state.averaged(averaging))
    }

    /// The best network so far, its loss and its step.
    pub fn best(&self) -> (Net<T>, f64, u64) {
        let (loss, step, weights) = &self.state.best;
        (self.state.folded(weights.clone()), *loss, *step)
    }

    /// Keeps the averaged weights, which have this loss, where none before had less.
    pub fn judge(&mut self, loss: f64, averaging: f64) {
        if loss < self.state.best.0 {
            self.state.best = (loss, self.step(), self.state.averaged(averaging));
        }
    }

    /// The sum over rows of `weights` times the slope of `ln q`, by each weight of the network.
    ///
    /// # Errors
    /// The site of the first row whose loss or slope is not finite; `None` where only the sum is not.
    pub fn slope(&mut self, rows: &Rows, weights: &[f64], share: f64) -> Result<Vec<T>, Option<usize>> {
        let picks: Vec<usize> = (0..rows.len()).filter(|row| weights[*row] != 0.0).collect();
        if picks.is_empty() {
            return Ok(vec![T::ZERO; self.state.net.weights.len()]);
        }
        self.state.room(picks.len(), &mut self.chunks);
        // A loss is minus `ln q`, but for a constant.
        let times = |row: usize| -weights[row];
        match self.state.slope(rows, &picks, &times, share, &mut self.chunks) {
            Ok(_) => Ok(self.chunks[0].slope.clone()),
            Err((site, _)) => Err(site),
        }
    }

    /// A step along such a sum.
    ///
    /// # Errors
    /// As for [`Climb::slope`]; the weights stay those before.
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

    /// As data.
    pub fn stored(&self, history: &[Progress]) -> Stored {
        let State { net, adam, best, .. } = &self.state;
        Stored::of(&net.weights, adam, best, (0.0, 0.0), history)
    }

    /// Goes on from the data of a climb that began so.
    ///
    /// # Errors
    /// The data is not of this climb.
    pub fn go_on(&mut self, left: &Stored) -> Result<Vec<Progress>, Unfit> {
        let (mut history, mut sums) = (Vec::new(), (0.0, 0.0));
        let State { net, adam, best, .. } = &mut self.state;
        let weights = &mut net.weights;
        let moving = Moving { weights, adam, best, sums: &mut sums, history: &mut history };
        if left.put(moving) { Ok(history) } else { Err(Unfit) }
    }
}
