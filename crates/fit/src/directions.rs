//! The directions in which the features of good points vary, and the features along them.
//!
//! Features have thousands of entries and few directions that matter. These are the leading right singular vectors of the
//! features, weighted so that points near the target count most. They are not centred: the target is at 0, and what
//! matters is how far from it a point is.
//!
//! Everything comes from the dot products `G` of the features. With weights `W` and `W G W = U S^2 U^T`, the features along
//! the directions are `Z V = G W U S^-1`.

use crate::archive::Archive;
use crate::linear::{Matrix, dot, eigen, low_rank};
use niwaki_math::portable;

/// The most directions.
pub const MOST: usize = 40;

/// Columns of the Cholesky factor from which the directions are computed.
const RANK: usize = 56;

/// Features of the rows along the directions, a row of the matrix for each direction.
pub fn along(archive: &Archive, rows: &[usize]) -> Matrix {
    if !archive.has_features() {
        return shortfall(archive, rows);
    }
    let n = rows.len();
    let squares: Vec<f64> = rows.iter().map(|row| archive.square(*row)).collect();
    let least = squares.iter().copied().fold(f64::INFINITY, f64::min);
    let mut sorted = squares.clone();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[n / 2].max(1e-9);
    let weights: Vec<f64> =
        squares.iter().map(|square| portable::exp(-0.5 * (square - least) / median)).collect();

    let (mut products, mut weighted) = (Matrix::zeros(n, n), Matrix::zeros(n, n));
    for i in 0..n {
        for j in 0..n {
            products.row_mut(i)[j] = archive.product(rows[i], rows[j]);
            weighted.row_mut(i)[j] = weights[i] * weights[j] * products.row(i)[j];
        }
    }
    let factor = low_rank(&weighted, RANK.min(n)).transposed();
    let rank = factor.rows;
    let mut small = Matrix::zeros(rank, rank);
    for i in 0..rank {
        for j in 0..rank {
            small.row_mut(i)[j] = dot(factor.row(i), factor.row(j));
        }
    }
    let (values, vectors) = eigen(&small);
    let count = values.iter().take(MOST).filter(|value| **value > 1e-10 * values[0]).count();
    if count == 0 {
        // All features are zero.
        return Matrix::zeros(1, n);
    }
    let mut out = Matrix::zeros(count, n);
    for (c, value) in values.iter().enumerate().take(count) {
        // W U S^-1, with U = factor vectors S^-1.
        let mut combination = vec![0.0; n];
        for k in 0..rank {
            crate::linear::add_scaled(&mut combination, vectors.row(c)[k] / value, factor.row(k));
        }
        combination.iter_mut().zip(&weights).for_each(|(x, w)| *x *= w);
        for i in 0..n {
            out.row_mut(c)[i] = dot(products.row(i), &combination);
        }
    }
    out
}

/// The one direction of goals without features: the root of twice what a score lacks to a little above the best.
fn shortfall(archive: &Archive, rows: &[usize]) -> Matrix {
    let finite: Vec<f64> =
        rows.iter().map(|row| archive.score(*row)).filter(|score| score.is_finite()).collect();
    let best = finite.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let worst = finite.iter().copied().fold(f64::INFINITY, f64::min);
    let mut out = Matrix::zeros(1, rows.len());
    for (value, row) in out.row_mut(0).iter_mut().zip(rows) {
        let score = archive.score(*row);
        let lack = if score.is_finite() { best - score } else { (best - worst).max(1.0) };
        *value = (2.0 * if lack.is_finite() { lack + 0.5 } else { 1.0 }).sqrt();
    }
    out
}

#[cfg(test)]
mod tests {
    //! The features along the directions keep the lengths of good points, and no more than there is.
    use super::*;
    use crate::archive::Evaluation;
    use crate::dice::{Dice, Purpose};
    use crate::space::Point;

    #[test]
    fn features_of_low_rank_keep_their_products() {
        let mut dice = Dice::new(2, Purpose::Design, 0);
        let basis: Vec<Vec<f64>> = (0..5).map(|_| (0..300).map(|_| dice.normal()).collect()).collect();
        let mut archive = Archive::default();
        for _ in 0..60 {
            let mut features = vec![0.0; 300];
            basis.iter().for_each(|b| crate::linear::add_scaled(&mut features, dice.normal(), b));
            let point = Point { row: vec![dice.uniform()], used: vec![true] };
            archive.push(point, Evaluation { score: 0.0, features: Some(features) });
        }
        let rows: Vec<usize> = (0..60).collect();
        let features = along(&archive, &rows).transposed();
        assert_eq!(features.columns, 5);
        for i in 0..60 {
            for j in 0..60 {
                let (plain, kept) = (archive.product(i, j), dot(features.row(i), features.row(j)));
                assert!((plain - kept).abs() < 1e-6 * archive.square(i).max(archive.square(j)));
            }
        }
    }
}
