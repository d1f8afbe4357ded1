//! The Gaussian process from parameters to features along their directions.
//!
//! One kernel serves all directions, so one Cholesky factor does. With the kernel matrix `K` of the rows and their features
//! `T` (one direction at a time, less their mean `m`):
//!
//! ```text
//! mean(x) = m + k(x)^T K^-1 (T - m)        variance(x) = s^2 (1 - k(x)^T K^-1 k(x)),    s^2 = mean of (T - m) K^-1 (T - m)
//! ```
//!
//! Length scales are changed at random, and a change is kept if the likelihood times the prior rises. By the likelihood
//! alone, scales collapse while there are few points.

use crate::archive::Archive;
use crate::dice::Dice;
use crate::directions;
use crate::kernel::{Columns, Scales};
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

/// What is computed from length scales, for given rows.
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
    /// * `tries`: random changes of the length scales
    pub fn train(
        space: &Space,
        archive: &Archive,
        ranked: &[usize],
        scales: &Scales,
        tries: usize,
        dice: &mut Dice,
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

        let mut scales = scales.clone();
        let mut best = trial(space, &columns, &features, &shares, &scales)?;
        for _ in 0..tries {
            let changed = vary(space, &scales, dice);
            if let Some(found) = trial(space, &columns, &features, &shares, &changed)
                && found.log_posterior > best.log_posterior
            {
                (best, scales) = (found, changed);
            }
        }
        let mut weights = best.half;
        for c in 0..weights.rows {
            best.factor.solve_upper(weights.row_mut(c));
        }
        let failures: Vec<usize> =
            (0..archive.len()).filter(|row| !archive.is_seen(*row) || archive.score(*row).is_infinite()).collect();
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

/// Length scales with some of them changed.
fn vary(space: &Space, scales: &Scales, dice: &mut Dice) -> Scales {
    let mut out = scales.clone();
    let share = (2.0 / space.len() as f64).max(0.25);
    let together = 0.15 * dice.normal();
    for scale in out.along.iter_mut().chain(&mut out.apart) {
        let alone = if dice.chance(share) { 0.35 * dice.normal() } else { 0.0 };
        *scale *= portable::exp(alone + together);
    }
    out.clamp();
    out
}

/// The likelihood of length scales times their prior, with what was computed for it; None if the matrix is not positive.
fn trial(
    space: &Space,
    columns: &Columns,
    features: &Matrix,
    shares: &[f64],
    scales: &Scales,
) -> Option<Trial> {
    let n = columns.count;
    let mut matrix = Matrix::zeros(n, n);
    let mut row = vec![0.0; space.len()];
    for i in 0..n {
        columns.row(i, &mut row);
        let out = &mut matrix.row_mut(i)[..=i];
        columns.kernel(space, scales, &row, out);
        out[i] = 1.0 + NUGGET;
    }
    let factor = Cholesky::of(matrix)?;
    let mut half = features.clone();
    let mut variances = vec![];
    for c in 0..half.rows {
        factor.solve_lower(half.row_mut(c));
        variances.push((dot(half.row(c), half.row(c)) / n as f64).max(1e-12));
    }
    let fit: f64 = shares.iter().zip(&variances).map(|(share, v)| share * portable::ln(*v)).sum();
    let volume: f64 = factor.diagonal().map(portable::ln).sum();
    let log_posterior = -0.5 * n as f64 * fit - volume + scales.log_prior(space);
    Some(Trial { log_posterior, factor, half, variances })
}
