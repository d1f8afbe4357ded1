//! The mass matrix `M`, kept as its inverse: an estimate of the target's covariance.
//!
//! Momentum is drawn from `N(0, M)`, velocity is `M^-1 p`. Where `M^-1` is the target's covariance, every direction
//! of a normal target takes equally long (Neal 2011, section 4.1).

use super::leapfrog::{add, dot};
use niwaki_math::Stream;
use serde::Deserialize;

/// The shape of the metric that a warm-up fits.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// The identity: no coordinate is scaled (the dissertation's setting).
    Unit,
    /// A scale for each coordinate.
    Diagonal,
    /// The whole covariance: `dim^2` numbers, and as many operations for each step. It suits nearly normal targets: in a bent target,
    /// the covariance of an arm can hold a chain there (R-hat shows it).
    Dense,
    /// A scale for each coordinate and a few directions that are stretched or squeezed.
    LowRank,
}

/// A unit vector, and the variance along it.
pub type Direction = (Vec<f64>, f64);

/// An inverse mass matrix.
#[derive(Clone, Debug, PartialEq)]
pub enum Metric {
    /// `M^-1 = diag(variance)`.
    Diagonal {
        /// Variance of each coordinate.
        variance: Vec<f64>,
        /// Its square root.
        deviation: Vec<f64>,
    },
    /// `M^-1 = C = L L^T`, both by rows, `(dim, dim)`.
    Dense {
        /// The covariance `C`.
        covariance: Vec<f64>,
        /// Its Cholesky factor `L`; what is above the diagonal is not read.
        factor: Vec<f64>,
    },
    /// `M^-1 = D (I + sum_k (value_k - 1) u_k u_k^T) D`, `D` diagonal, `u_k` orthonormal.
    LowRank {
        /// The diagonal of `D`.
        deviation: Vec<f64>,
        /// The directions `u_k`, each with the variance along it in units of `D`.
        directions: Vec<Direction>,
    },
}

impl Metric {
    /// The identity.
    pub fn unit(dim: usize) -> Metric {
        Metric::diagonal(vec![1.0; dim])
    }

    /// A diagonal metric from the variance of each coordinate, all positive.
    pub fn diagonal(variance: Vec<f64>) -> Metric {
        let deviation = variance.iter().map(|v| v.sqrt()).collect();
        Metric::Diagonal { variance, deviation }
    }

    /// A dense metric from a covariance by rows; None where that is not positive definite.
    pub fn dense(covariance: Vec<f64>) -> Option<Metric> {
        let factor = cholesky(&covariance)?;
        Some(Metric::Dense { covariance, factor })
    }

    /// A low-rank metric: scales, and orthonormal directions with the variance along each.
    pub fn low_rank(deviation: Vec<f64>, directions: Vec<Direction>) -> Metric {
        Metric::LowRank { deviation, directions }
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        match self {
            Metric::Diagonal { variance, .. } => variance.len(),
            Metric::Dense { covariance, .. } => covariance.len().isqrt(),
            Metric::LowRank { deviation, .. } => deviation.len(),
        }
    }

    /// Write `M^-1 p` to `v`.
    #[inline]
    pub fn velocity(&self, p: &[f64], v: &mut [f64]) {
        match self {
            Metric::Diagonal { variance, .. } => {
                for ((v, p), s) in v.iter_mut().zip(p).zip(variance) {
                    *v = p * s;
                }
            }
            Metric::Dense { covariance, .. } => {
                for (v, row) in v.iter_mut().zip(covariance.chunks_exact(p.len())) {
                    *v = dot(row, p);
                }
            }
            Metric::LowRank { deviation, directions } => {
                for ((v, p), s) in v.iter_mut().zip(p).zip(deviation) {
                    *v = p * s;
                }
                for (u, value) in directions {
                    // The directions are orthonormal, so the terms are independent.
                    add(v, (value - 1.0) * dot(u, v), u);
                }
                for (v, s) in v.iter_mut().zip(deviation) {
                    *v *= s;
                }
            }
        }
    }

    /// Write a draw of `N(0, M)` to `p`.
    pub fn momentum(&self, stream: &mut Stream, p: &mut [f64]) {
        p.iter_mut().for_each(|z| *z = stream.normal());
        match self {
            Metric::Diagonal { deviation, .. } => {
                for (p, s) in p.iter_mut().zip(deviation) {
                    *p /= s;
                }
            }
            Metric::Dense { factor, .. } => {
                // L^T p = z, from the last row up: then p has covariance (L L^T)^-1.
                let n = p.len();
                for i in (0..n).rev() {
                    p[i] /= factor[i * n + i];
                    let known = p[i];
                    add(&mut p[..i], -known, &factor[i * n..i * n + i]);
                }
            }
            Metric::LowRank { deviation, directions } => {
                for (u, value) in directions {
                    let along = dot(u, p);
                    add(p, (1.0 / value.sqrt() - 1.0) * along, u);
                }
                for (p, s) in p.iter_mut().zip(deviation) {
                    *p /= s;
                }
            }
        }
    }
}

/// The lower Cholesky factor of a symmetric matrix by rows; None where it is not positive definite.
pub fn cholesky(matrix: &[f64]) -> Option<Vec<f64>> {
    let n = matrix.len().isqrt();
    let mut l = matrix.to_vec();
    // Sums of the products of earlier columns. Column by column, a step of the processor serves several of them.
    let mut known = vec![-0.0; n * n];
    let mut column = vec![0.0; n];
    for j in 0..n {
        for i in j..n {
            let left = l[i * n + j] - known[i * n + j];
            column[i] = if i != j {
                left / column[j]
            } else if left > 0.0 && left.is_finite() {
                left.sqrt()
            } else {
                return None;
            };
            l[i * n + j] = column[i];
        }
        for i in j + 1..n {
            add(&mut known[i * n..=i * n + i][j + 1..], column[i], &column[j + 1..=i]);
        }
    }
    Some(l)
}

/// `x` with `L L^T x = b`, for the lower triangle `L` by rows.
pub fn solve(l: &[f64], b: &[f64]) -> Vec<f64> {
    let n = b.len();
    let mut x = b.to_vec();
    for i in 0..n {
        let sum: f64 = (0..i).map(|j| l[i * n + j] * x[j]).sum();
        x[i] = (x[i] - sum) / l[i * n + i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|j| l[j * n + i] * x[j]).sum();
        x[i] = (x[i] - sum) / l[i * n + i];
    }
    x
}

#[cfg(test)]
mod tests {
    //! Momentum and velocity belong to the same matrix: `E[v v^T] = M^-1`.
    use super::*;

    #[test]
    fn velocity_of_a_random_momentum_has_the_metrics_covariance() {
        // 40 000 draws: each of the 27 moments has a standard error below 0.005 sqrt(c_ii c_jj + c_ij^2) <= 0.036;
        // five of them is a false alarm in 1e-5.
        let s = 0.5_f64.sqrt();
        let metrics = [
            Metric::diagonal(vec![0.25, 1.0, 4.0]),
            Metric::dense(vec![2.0, 0.9, 0.3, 0.9, 1.0, -0.2, 0.3, -0.2, 0.5]).expect("positive definite"),
            Metric::low_rank(vec![0.5, 1.0, 2.0], vec![(vec![s, -s, 0.0], 4.0), (vec![s, s, 0.0], 0.1)]),
        ];
        for metric in metrics {
            let (mut p, mut v, mut unit) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            let mut sums = [[0.0; 3]; 3];
            let n = 40_000;
            let mut stream = Stream::new(11, 0, 0, 0);
            for _ in 0..n {
                metric.momentum(&mut stream, &mut p);
                metric.velocity(&p, &mut v);
                for i in 0..3 {
                    (0..3).for_each(|j| sums[i][j] += v[i] * v[j] / f64::from(n));
                }
            }
            let mut columns = [[0.0; 3]; 3];
            for (j, column) in columns.iter_mut().enumerate() {
                unit.fill(0.0);
                unit[j] = 1.0;
                metric.velocity(&unit, column);
            }
            for i in 0..3 {
                for j in 0..3 {
                    let c = columns[j][i];
                    let size = (columns[i][i] * columns[j][j] + c * c).sqrt();
                    assert!((sums[i][j] - c).abs() < 5.0 * 0.005 * size, "{i} {j} {metric:?}");
                }
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_is_no_metric() {
        assert_eq!(Metric::dense(vec![1.0, 2.0, 2.0, 1.0]), None);
        assert_eq!(Metric::dense(vec![1.0, 0.0, 0.0, f64::NAN]), None);
        assert_eq!(cholesky(&[4.0, 2.0, 2.0, 5.0]).map(|l| (l[0], l[2], l[3])), Some((2.0, 1.0, 2.0)));
    }
}
