//! The Gaussian process from parameters to features along their directions.
//!
//! One kernel serves all directions, so one Cholesky factor does. With the kernel matrix `K` of the rows and their features
//! `T` (one direction at a time, less their mean `m`):
//!
//! ```text
//! mean(x) = m + k(x)^T K^-1 (T - m)        variance(x) = s^2 (1 - k(x)^T K^-1 k(x)),    s^2 = mean of (T - m) K^-1 (T - m)
//! ```
//!
//! Length scales climb the likelihood times their prior, by the signs of its slope (Riedmiller & Braun 1993). By the
//! likelihood alone, scales collapse while there are few points. With `a = K^-1 (T - m)` for each direction, and the share
//! `w` of the direction in the variance of the features,
//!
//! ```text
//! log likelihood = -n/2 sum of w log s^2 - 1/2 log det K
//! slope          = 1/2 sum over i, j of M_ij dK_ij,          M = sum of w / s^2 a a^T - K^-1
//! ```

use crate::archive::Archive;
use crate::directions;
use crate::kernel::{Columns, Scales, matern_fall};
use crate::linear::{Cholesky, Matrix, dot};
use crate::space::Space;
use niwaki_math::portable;

/// Added to the diagonal of the kernel matrix: what the rows vary beyond the kernel.
pub const NUGGET: f64 = 0.002;

/// The most rows that are learnt from; half are the best, half the nearest to the three best.
pub const MOST_ROWS: usize = 220;

/// A Gaussian process, trained on rows of an archive.
#[derive(Clone, Debug)]
pub struct Emulator {
    space: Space,
    scales: Scales,
    columns: Columns,
    factor: Cholesky,
    /// For each direction, the weights of the kernel with the rows.
    weights: Matrix,
    /// For each direction: the mean, and the variance of the process.
    means: Vec<f64>,
    variances: Vec<f64>,
    /// Whether the only direction is a shortfall, of which less than nothing is better still.
    is_shortfall: bool,
    /// Median length of the rows' features.
    typical: f64,
    /// Numbers of failed evaluations in the archive, as columns.
    failed: Option<Columns>,
}

/// The results of length scales, for some rows.
struct Trial {
    log_posterior: f64,
    factor: Cholesky,
    half: Matrix,
    variances: Vec<f64>,
}

impl Emulator {
    /// Learns from an archive.
    ///
    /// * `ranked`: the evaluations that may be learnt from, best first; at least two
    /// * `scales`: length scales from before
    /// * `steps`: steps of the length scales
    pub fn train(
        space: &Space,
        archive: &Archive,
        ranked: &[usize],
        scales: &Scales,
        steps: usize,
    ) -> Option<Emulator> {
        let rows = select(space, archive, ranked, scales);
        let columns = Columns::of(space.len(), rows.iter().map(|row| &archive.point(*row).row[..]));
        let mut features = directions::along(archive, &rows);
        let n = rows.len();
        let lengths = {
            let across = features.transposed();
            let mut lengths: Vec<f64> = (0..n).map(|i| dot(across.row(i), across.row(i)).sqrt()).collect();
            lengths.sort_by(f64::total_cmp);
            lengths
        };
        let means: Vec<f64> =
            (0..features.rows).map(|c| features.row(c).iter().sum::<f64>() / n as f64).collect();
        for (c, mean) in means.iter().enumerate() {
            features.row_mut(c).iter_mut().for_each(|x| *x -= mean);
        }
        let squares: Vec<f64> =
            (0..features.rows).map(|c| dot(features.row(c), features.row(c)).max(1e-300)).collect();
        let total: f64 = squares.iter().sum();
        let shares: Vec<f64> = squares.iter().map(|square| square / total).collect();

        let count = effective(&shares);
        let learnt = Learnt { space, columns: &columns, features: &features, shares: &shares, count };
        let (scales, best) = learnt.climb(scales, steps)?;
        let mut weights = best.half;
        for c in 0..weights.rows {
            best.factor.solve_upper(weights.row_mut(c));
        }
        let failures: Vec<usize> = (0..archive.len())
            .filter(|row| !archive.is_seen(*row) || archive.score(*row).is_infinite())
            .collect();
        let failed = (!failures.is_empty())
            .then(|| Columns::of(space.len(), failures.iter().map(|row| &archive.point(*row).row[..])));
        Some(Emulator {
            space: space.clone(),
            scales,
            columns,
            factor: best.factor,
            weights,
            means,
            variances: best.variances,
            is_shortfall: !archive.has_features(),
            typical: lengths[n / 2],
            failed,
        })
    }

    /// The length scales.
    pub fn scales(&self) -> &Scales {
        &self.scales
    }

    /// The number of directions.
    pub fn directions(&self) -> usize {
        self.means.len()
    }

    /// The variance of the process along each direction.
    pub fn variances(&self) -> &[f64] {
        &self.variances
    }

    /// The kernel of a row with the rows that were learnt from.
    pub fn kernel(&self, row: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.columns.count];
        self.columns.kernel(&self.space, &self.scales, row, &mut out);
        out
    }

    /// The mean along each direction, from the kernel.
    pub fn mean(&self, kernel: &[f64]) -> Vec<f64> {
        (0..self.means.len()).map(|c| self.means[c] + dot(self.weights.row(c), kernel)).collect()
    }

    /// The share of the process's variance that is left, from the kernel: 1 far from all rows.
    pub fn left(&self, mut kernel: Vec<f64>) -> f64 {
        self.factor.solve_lower(&mut kernel);
        (1.0 - dot(&kernel, &kernel)).max(1e-9)
    }

    /// The predicted length of the features from the kernel, longer where evaluations failed.
    pub fn length(&self, row: &[f64], kernel: &[f64]) -> f64 {
        let mean = self.mean(kernel);
        let length = if self.is_shortfall { mean[0] } else { dot(&mean, &mean).sqrt() };
        length + self.typical * self.risk(row, kernel)
    }

    /// How much longer or shorter the features may be: the root of all variance that is left.
    pub fn doubt(&self, kernel: Vec<f64>) -> f64 {
        (self.left(kernel) * self.variances.iter().sum::<f64>()).sqrt()
    }

    /// The share of failed evaluations among those near a row, by the kernel.
    fn risk(&self, row: &[f64], kernel: &[f64]) -> f64 {
        let Some(failed) = &self.failed else { return 0.0 };
        let mut near = vec![0.0; failed.count];
        failed.kernel(&self.space, &self.scales, row, &mut near);
        let bad: f64 = near.iter().sum();
        let good: f64 = kernel.iter().sum();
        bad / (bad + good + 0.2)
    }
}

/// The rows to learn from: all, or the best and those near the three best.
fn select(space: &Space, archive: &Archive, ranked: &[usize], scales: &Scales) -> Vec<usize> {
    let mut all: Vec<usize> = (0..archive.len()).filter(|row| archive.is_seen(*row)).collect();
    if all.len() <= MOST_ROWS {
        return all;
    }
    let columns = Columns::of(space.len(), all.iter().map(|row| &archive.point(*row).row[..]));
    let mut nearest = vec![f64::INFINITY; all.len()];
    let mut distances = vec![0.0; all.len()];
    for row in &ranked[..3.min(ranked.len())] {
        columns.distances(space, scales, &archive.point(*row).row, &mut distances);
        nearest.iter_mut().zip(&distances).for_each(|(least, d)| *least = least.min(*d));
    }
    let mut by_distance: Vec<usize> = (0..all.len()).collect();
    by_distance.sort_by(|a, b| nearest[*a].total_cmp(&nearest[*b]).then(a.cmp(b)));
    let half = MOST_ROWS / 2;
    let mut chosen: Vec<usize> = ranked.iter().take(half).copied().collect();
    chosen.extend(by_distance.iter().take(half).map(|place| all[*place]));
    chosen.sort_unstable();
    chosen.dedup();
    all.clear();
    chosen
}

/// The number of directions that a likelihood counts for: the root of the number of directions of equal variance that would be
/// as uneven as these shares, which sum to 1. Directions of one geometry are not independent, nor are they all one.
fn effective(shares: &[f64]) -> f64 {
    (1.0 / shares.iter().map(|share| share * share).sum::<f64>()).sqrt()
}

/// Rows, and their features along the directions, less their means.
struct Learnt<'a> {
    space: &'a Space,
    columns: &'a Columns,
    features: &'a Matrix,
    /// The share of each direction in the variance of the features.
    shares: &'a [f64],
    /// The number of directions that the likelihood counts for.
    count: f64,
}

/// The first step of the logarithm of a length scale, its range, and its change when the slope keeps its sign or does not.
const STEP: f64 = 0.15;
const STEPS: [f64; 2] = [0.01, 0.5];
const LONGER: f64 = 1.3;
const SHORTER: f64 = 0.5;

impl Learnt<'_> {
    /// The best of the length scales on a climb, with what was computed for them.
    fn climb(&self, scales: &Scales, steps: usize) -> Option<(Scales, Trial)> {
        let mut now = scales.clone();
        let mut trial = self.trial(&now)?;
        let mut best = None;
        let count = 2 * self.space.len();
        let (mut sizes, mut before) = (vec![STEP; count], vec![0.0; count]);
        for _ in 0..steps {
            let slope = self.slope(&now, &trial);
            let mut next = now.clone();
            for (k, scale) in next.along.iter_mut().chain(&mut next.apart).enumerate() {
                let turn = slope[k] * before[k];
                if turn > 0.0 {
                    sizes[k] = (sizes[k] * LONGER).min(STEPS[1]);
                } else if turn < 0.0 {
                    sizes[k] = (sizes[k] * SHORTER).max(STEPS[0]);
                }
                if slope[k] != 0.0 {
                    *scale *= portable::exp(sizes[k] * slope[k].signum());
                }
            }
            next.clamp();
            before = slope;
            let Some(other) = self.trial(&next) else { break };
            let last = (std::mem::replace(&mut now, next), std::mem::replace(&mut trial, other));
            let is_best =
                best.as_ref().is_none_or(|(_, t): &(Scales, Trial)| last.1.log_posterior > t.log_posterior);
            if is_best {
                best = Some(last);
            }
        }
        match best {
            Some((scales, other)) if other.log_posterior >= trial.log_posterior => Some((scales, other)),
            _ => Some((now, trial)),
        }
    }

    /// The slope of the log posterior by the logarithm of each length scale: those along ranges, then those between levels.
    fn slope(&self, scales: &Scales, trial: &Trial) -> Vec<f64> {
        let (n, axes) = (self.columns.count, self.space.len());
        let mut weights = trial.half.clone();
        for c in 0..weights.rows {
            trial.factor.solve_upper(weights.row_mut(c));
            let factor = (self.shares[c] / trial.variances[c]).sqrt();
            weights.row_mut(c).iter_mut().for_each(|x| *x *= factor);
        }
        let across = weights.transposed();
        let inverse = trial.factor.inverse();
        let mut slope = vec![0.0; 2 * axes];
        let (mut row, mut fall) = (vec![0.0; axes], vec![0.0; n]);
        for i in 1..n {
            self.columns.row(i, &mut row);
            let fall = &mut fall[..i];
            self.columns.distances(self.space, scales, &row, fall);
            for (j, value) in fall.iter_mut().enumerate() {
                *value = matern_fall(*value) * (dot(across.row(i), across.row(j)) - inverse.row(i)[j]);
            }
            self.columns.add_slopes(self.space, scales, &row, fall, &mut slope);
        }
        let prior = scales.log_prior_slope(self.space);
        slope.iter().zip(prior).map(|(likelihood, prior)| self.count * likelihood + prior).collect()
    }

    /// The likelihood of length scales times their prior, with what was computed for it; None if the matrix is not
    /// positive.
    fn trial(&self, scales: &Scales) -> Option<Trial> {
        let (n, columns) = (self.columns.count, self.columns);
        let mut matrix = Matrix::zeros(n, n);
        let mut row = vec![0.0; self.space.len()];
        for i in 0..n {
            columns.row(i, &mut row);
            let out = &mut matrix.row_mut(i)[..=i];
            columns.kernel(self.space, scales, &row, out);
            out[i] = 1.0 + NUGGET;
        }
        let factor = Cholesky::of(matrix)?;
        let mut half = self.features.clone();
        let mut variances = vec![];
        for c in 0..half.rows {
            factor.solve_lower(half.row_mut(c));
            variances.push((dot(half.row(c), half.row(c)) / n as f64).max(1e-12));
        }
        let fit: f64 = self.shares.iter().zip(&variances).map(|(share, v)| share * portable::ln(*v)).sum();
        let volume: f64 = factor.diagonal().map(portable::ln).sum();
        let log_likelihood = self.count * (-0.5 * n as f64 * fit - volume);
        let log_posterior = log_likelihood + scales.log_prior(self.space);
        Some(Trial { log_posterior, factor, half, variances })
    }
}

#[cfg(test)]
mod tests {
    //! The slope of the likelihood agrees with differences; a climb never ends lower than it began.
    use super::*;
    use crate::archive::Evaluation;
    use crate::dice::{Dice, Purpose};
    use crate::space::tests::example;

    fn archive(space: &Space, count: usize) -> Archive {
        let mut dice = Dice::new(5, Purpose::Design, 0);
        let mut out = Archive::default();
        for _ in 0..count {
            let point = space.draw_point(&mut dice);
            let [a, b, c] = [point.row[0], point.row[3], point.row[5]];
            let features =
                (0..12).map(|k| (a * f64::from(k)).sin() + b * c * f64::from(k % 3) - 0.2).collect();
            out.push(point, Evaluation { score: 0.0, features: Some(features) });
        }
        out
    }

    #[test]
    fn the_slope_of_the_likelihood_agrees_with_differences() {
        let space = example();
        let archive = archive(&space, 25);
        let columns = Columns::of(space.len(), (0..25).map(|k| &archive.point(k).row[..]));
        let mut features = directions::along(&archive, &(0..25).collect::<Vec<_>>());
        for c in 0..features.rows {
            let mean = features.row(c).iter().sum::<f64>() / 25.0;
            features.row_mut(c).iter_mut().for_each(|x| *x -= mean);
        }
        let shares = vec![1.0 / features.rows as f64; features.rows];
        let learnt =
            Learnt { space: &space, columns: &columns, features: &features, shares: &shares, count: 3.0 };
        let mut scales = Scales::start(&space);
        scales.along.iter_mut().enumerate().for_each(|(k, l)| *l *= 0.7 + 0.1 * k as f64);
        let slope = learnt.slope(&scales, &learnt.trial(&scales).unwrap());
        for (k, slope) in slope.into_iter().enumerate() {
            let at = |step: f64| {
                let mut moved = scales.clone();
                *moved.along.iter_mut().chain(&mut moved.apart).nth(k).unwrap() *= step.exp();
                learnt.trial(&moved).unwrap().log_posterior
            };
            let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
            assert!(
                (difference - slope).abs() < 1e-4 * (1.0 + difference.abs()),
                "{k} {difference} {}",
                slope
            );
        }
        let (_, climbed) = learnt.climb(&scales, 15).unwrap();
        assert!(climbed.log_posterior > learnt.trial(&scales).unwrap().log_posterior + 1.0);
    }
}
