//! Hierarchical linear regression: a line of its own for each sequence, a new intercept visits its five measurements,
//! a new mean of the population all intercepts.
use super::{Model, Step, decide, log_normal, normal, numbers};
use crate::population::{Random, uniform};
use serde_json::Value;

/// Bounds of the deviations.
const LOW: f64 = 0.05;
const HIGH: f64 = 3.0;
/// Steps of the means of the population, and of a sequence's intercept and slope.
const DRIFT: [f64; 2] = [0.2, 0.1];
const OWN_DRIFT: [f64; 2] = [0.3, 0.2];
/// Measurements of each sequence.
const LENGTH: usize = 5;

pub struct Hlr {
    times: [f64; LENGTH],
    measured: Vec<[f64; LENGTH]>,
    /// Mean intercept and mean slope.
    means: [f64; 2],
    /// Their deviations.
    spreads: [f64; 2],
    noise: f64,
    /// Intercepts and slopes.
    own: [Vec<f64>; 2],
}

fn drawn_deviation(random: &mut Random) -> f64 {
    LOW + (HIGH - LOW) * uniform(random)
}

/// Log ratio of a Gaussian's densities at `values` when its mean moves; the mean's own prior too.
fn moved(values: &[f64], old: f64, new: f64, sd: f64) -> f64 {
    let sum: f64 = values.iter().map(|x| (x - old) * (x - old) - (x - new) * (x - new)).sum();
    0.5 * sum / (sd * sd) + (old * old - new * new) / 200.0
}

/// The same when its deviation changes; `squares` is the sum of squared distances from the mean.
fn spread(squares: f64, count: usize, old: f64, new: f64) -> f64 {
    0.5 * squares * (1.0 / (old * old) - 1.0 / (new * new)) + count as f64 * (old / new).ln()
}

impl Hlr {
    pub fn new(data: &Value, random: &mut Random) -> Self {
        let five = |row: &Value| -> [f64; LENGTH] { numbers(row).try_into().expect("five measurements") };
        let measured: Vec<_> = data["measured"].as_array().expect("sequences").iter().map(five).collect();
        let spreads = [drawn_deviation(random), drawn_deviation(random)];
        let noise = drawn_deviation(random);
        let means = [10.0 * normal(random), 10.0 * normal(random)];
        let own = [0, 1].map(|w| measured.iter().map(|_| means[w] + spreads[w] * normal(random)).collect());
        Self { times: five(&data["times"]), measured, means, spreads, noise, own }
    }

    /// Sum of squared errors of all measurements.
    fn squares(&self) -> f64 {
        let mut sum = 0.0;
        for (i, row) in self.measured.iter().enumerate() {
            for (y, x) in row.iter().zip(self.times) {
                let error = y - self.own[0][i] - self.own[1][i] * x;
                sum += error * error;
            }
        }
        sum
    }
}

impl Model for Hlr {
    fn choices(&self) -> usize {
        5 + 2 * self.measured.len()
    }

    fn globals(&self) -> std::ops::Range<usize> {
        0..2
    }

    fn readers(&self, _: usize) -> usize {
        self.measured.len()
    }

    #[inline]
    fn propose<const CHECKED: bool>(&mut self, choice: usize, random: &mut Random, forced: bool) -> Step {
        if choice >= 5 {
            let (i, which) = ((choice - 5) / 2, (choice - 5) % 2);
            let old = [self.own[0][i], self.own[1][i]];
            let mut new = old;
            new[which] += OWN_DRIFT[which] * normal(random);
            let (mean, sd) = (self.means[which], self.spreads[which]);
            let (before, after) = (old[which] - mean, new[which] - mean);
            let mut sum = 0.0;
            for (y, x) in self.measured[i].iter().zip(self.times) {
                let (here, there) = (y - old[0] - old[1] * x, y - new[0] - new[1] * x);
                sum += here * here - there * there;
            }
            let prior = (before * before - after * after) / (sd * sd);
            let log_ratio = 0.5 * (prior + sum / (self.noise * self.noise));
            let accepted = decide(random, log_ratio, forced);
            if accepted {
                self.own[which][i] = new[which];
            }
            return Step { accepted, log_ratio, own_prior: 0.0 };
        }
        let (log_ratio, accepted);
        if choice < 2 {
            let old = self.means[choice];
            let new = old + DRIFT[choice] * normal(random);
            log_ratio = moved(&self.own[choice], old, new, self.spreads[choice]);
            accepted = decide(random, log_ratio, forced);
            if accepted {
                self.means[choice] = new;
            }
        } else {
            let new = drawn_deviation(random);
            let (old, squares, count) = match choice {
                4 => (self.noise, self.squares(), LENGTH * self.measured.len()),
                _ => {
                    let (values, mean) = (&self.own[choice - 2], self.means[choice - 2]);
                    let squares = values.iter().map(|x| (x - mean) * (x - mean)).sum();
                    (self.spreads[choice - 2], squares, values.len())
                }
            };
            log_ratio = spread(squares, count, old, new);
            accepted = decide(random, log_ratio, forced);
            if accepted {
                match choice {
                    4 => self.noise = new,
                    _ => self.spreads[choice - 2] = new,
                }
            }
        }
        Step { accepted, log_ratio, own_prior: 0.0 }
    }

    fn log_joint(&self) -> f64 {
        let mut sum = self.means.iter().map(|&mean| log_normal(mean, 0.0, 10.0)).sum::<f64>();
        for which in [0, 1] {
            sum += self.own[which]
                .iter()
                .map(|&x| log_normal(x, self.means[which], self.spreads[which]))
                .sum::<f64>();
        }
        sum - 0.5 * self.squares() / (self.noise * self.noise)
            - (LENGTH * self.measured.len()) as f64 * self.noise.ln()
    }

    /// The five global choices.
    fn moments(&self) -> Vec<f64> {
        vec![self.means[0], self.means[1], self.spreads[0], self.spreads[1], self.noise]
    }
}
