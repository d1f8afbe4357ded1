//! Adam (Kingma & Ba 2015, alg. 1), with averaged weights.
//!
//! With the slope `g` of the loss at step `t`, from 1 on:
//!
//! ```text
//! m = .9 m + .1 g        v = .999 v + .001 g^2
//! w = w - rate (m / (1 - .9^t)) / (sqrt(v / (1 - .999^t)) + 1e-8)
//! a = d a + (1 - d) w
//! ```
//!
//! The averaged weights are `a / (1 - d^t)`. They make a schedule of rates unnecessary.

use crate::net::Real;

/// The usual decays of the mean slope and of the mean square.
const DECAYS: [f64; 2] = [0.9, 0.999];
/// Addend that keeps the quotient finite.
const LEAST: f64 = 1e-8;

/// The state of the optimiser.
#[derive(Clone, Debug, PartialEq)]
pub struct Adam<T: Real = f32> {
    /// `m` and `v`.
    moments: [Vec<T>; 2],
    /// `a`.
    average: Vec<T>,
    /// Decays of the mean slope and of the mean square.
    decays: [f64; 2],
    /// The number of steps so far.
    step: u64,
}

impl<T: Real> Adam<T> {
    /// The state before the first step, for this number of weights.
    pub fn new(weights: usize) -> Adam<T> {
        Adam::with_decays(weights, DECAYS)
    }

    /// The state before the first step, with unusual decays.
    pub fn with_decays(weights: usize, decays: [f64; 2]) -> Adam<T> {
        let zeros = vec![T::ZERO; weights];
        Adam { moments: [zeros.clone(), zeros.clone()], average: zeros, decays, step: 0 }
    }

    /// Moments, average and number of steps.
    pub(crate) fn parts(&self) -> (&[Vec<T>; 2], &[T], u64) {
        (&self.moments, &self.average, self.step)
    }

    /// Sets moments, average and number of steps.
    pub(crate) fn put(&mut self, moments: [Vec<T>; 2], average: Vec<T>, step: u64) {
        (self.moments, self.average, self.step) = (moments, average, step);
    }

    /// The number of steps so far.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Makes a step against `scale` times the slope; `averaging` is `d`.
    pub fn advance(&mut self, weights: &mut [T], slope: &[T], scale: f64, rate: f64, averaging: f64) {
        self.step += 1;
        let number = T::from_f64;
        let t = self.step as f64;
        let [keep_mean, keep_square] = self.decays;
        let rate = number(rate / (1.0 - keep_mean.powf(t)));
        let correction = number(1.0 / (1.0 - keep_square.powf(t)));
        let (keep_mean, add_mean) = (number(keep_mean), number(1.0 - keep_mean));
        let (keep_square, add_square) = (number(keep_square), number(1.0 - keep_square));
        let (keep, add) = (number(averaging), number(1.0 - averaging));
        let (scale, least) = (number(scale), number(LEAST));
        let [means, squares] = &mut self.moments;
        let moments = means.iter_mut().zip(squares.iter_mut());
        let weights = weights.iter_mut().zip(&mut self.average);
        for (((w, average), (mean, square)), g) in weights.zip(moments).zip(slope) {
            let g = *g * scale;
            *mean = keep_mean * *mean + add_mean * g;
            *square = keep_square * *square + add_square * g * g;
            *w += -(rate * *mean) / ((*square * correction).sqrt() + least);
            *average = keep * *average + add * *w;
        }
    }

    /// The averaged weights; before the first step, zeros.
    pub fn averaged(&self, averaging: f64) -> Vec<T> {
        let correction = T::from_f64(1.0 / (1.0 - averaging.powf(self.step.max(1) as f64)));
        self.average.iter().map(|x| *x * correction).collect()
    }
}

#[cfg(test)]
mod tests {
    //! The first step has the size of the rate, and the average of equal weights equals them.
    use super::*;

    #[test]
    fn the_first_step_has_the_size_of_the_rate() {
        let mut adam: Adam<f64> = Adam::new(2);
        let mut weights = [1.0, 1.0];
        adam.advance(&mut weights, &[300.0, -0.02], 0.5, 1e-3, 0.998);
        assert!((weights[0] - 0.999).abs() < 1e-9 && (weights[1] - 1.001).abs() < 1e-8);
        let averaged = adam.averaged(0.998);
        assert!((averaged[0] - weights[0]).abs() < 1e-12);
    }
}
