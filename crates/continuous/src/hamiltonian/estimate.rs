//! A metric from the draws and gradients of a window of warm-up.
//!
//! Diagonal and dense metrics take the draws' covariance. The low-rank one looks at the gradients too, whose
//! covariance is the inverse of the draws' on a normal target: `D_i = (var x_i / var g_i)^(1/4)` makes both agree.
//! In the directions in which either is still far from the identity, the metric is the geometric mean of the draws'
//! covariance and the inverse of the gradients'. (It minimises the Fisher divergence, as in nutpie's engine.) So a
//! direction along which a constraint is tight is seen after fewer draws than there are coordinates.

use super::leapfrog::{add, dot};
use super::metric::{Metric, Shape};
use niwaki_math::Stream;

/// How many draws a covariance's own diagonal counts for (as many as the identity does in Stan).
const PRIOR_DRAWS: f64 = 5.0;
/// How many draws a direction of the low-rank metric needs.
const ENOUGH: usize = 3;
/// Added to the covariances within a basis, in units of the scales: so that a direction without any movement stays finite.
const RIDGE: f64 = 1e-8;
/// Most directions looked at, for the draws and for the gradients each.
const MOST_DIRECTIONS: usize = 16;
/// A direction whose variance lies within this factor of 1 is left at 1.
const ROUND: f64 = 2.0;
/// Rounds of subspace iteration.
const ROUNDS: usize = 12;

/// Draws and gradients of a window, by rows.
#[derive(Clone, Debug, Default)]
pub struct Window {
    dim: usize,
    draws: Vec<f64>,
    gradients: Vec<f64>,
}

impl Window {
    /// An empty window.
    pub fn new(dim: usize) -> Window {
        Window { dim, draws: Vec::new(), gradients: Vec::new() }
    }

    /// How many draws it holds.
    pub fn len(&self) -> usize {
        self.draws.len() / self.dim.max(1)
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.draws.is_empty()
    }

    /// Forgets them.
    pub fn clear(&mut self) {
        self.draws.clear();
        self.gradients.clear();
    }

    /// Adds a draw and the gradient there.
    pub fn push(&mut self, x: &[f64], gradient: &[f64]) {
        self.draws.extend_from_slice(x);
        self.gradients.extend_from_slice(gradient);
    }

    /// The metric of this shape; `None` when the window has too few draws.
    pub fn metric(&self, shape: Shape) -> Option<Metric> {
        if self.len() < 3 || self.dim == 0 {
            return None;
        }
        match shape {
            Shape::Unit => None,
            Shape::Diagonal => {
                Some(Metric::diagonal(positive(variances(&centred(&self.draws, self.dim), self.dim))))
            }
            Shape::Dense => self.dense(),
            Shape::LowRank => Some(self.low_rank()),
        }
    }

    /// The draws' covariance, shrunk to its diagonal: positive definite however few draws there are, and in any
    /// units. The tightest directions lose some of their scale. Without this the covariance of an early window, in which
    /// the chain moved along one arm of a bent target, would keep the chain in that arm.
    fn dense(&self) -> Option<Metric> {
        let (n, dim) = (self.len() as f64, self.dim);
        let rows = centred(&self.draws, dim);
        let diagonal = positive(variances(&rows, dim));
        let mut covariance = vec![0.0; dim * dim];
        let share = n / (n + PRIOR_DRAWS);
        for row in rows.chunks_exact(dim) {
            for (i, x) in row.iter().enumerate() {
                add(&mut covariance[i * dim..i * dim + i], share / (n - 1.0) * x, &row[..i]);
            }
        }
        for i in 0..dim {
            for j in 0..i {
                covariance[j * dim + i] = covariance[i * dim + j];
            }
            covariance[i * dim + i] = diagonal[i];
        }
        Metric::dense(covariance)
    }

    fn low_rank(&self) -> Metric {
        let dim = self.dim;
        let (mut draws, mut gradients) = (centred(&self.draws, dim), centred(&self.gradients, dim));
        let (var_x, var_g) = (positive(variances(&draws, dim)), positive(variances(&gradients, dim)));
        let deviation: Vec<f64> = var_x.iter().zip(&var_g).map(|(x, g)| (x / g).powf(0.25)).collect();
        for (x, g) in draws.chunks_exact_mut(dim).zip(gradients.chunks_exact_mut(dim)) {
            for ((x, g), s) in x.iter_mut().zip(g).zip(&deviation) {
                *x /= s;
                *g *= s;
            }
        }

        // A basis of the directions in which draws or gradients spread most.
        let most = MOST_DIRECTIONS.min(dim).min(self.len() / (2 * ENOUGH));
        let mut basis = principal(&draws, dim, most);
        basis.extend(principal(&gradients, dim, most));
        orthonormalise(&mut basis);

        // Draws and gradients in that basis; their covariances A and B.
        let m = basis.len();
        let (a, b) = (projected(&draws, dim, &basis), projected(&gradients, dim, &basis));
        let mean = geometric_mean(&a, &b, m);
        let (values, vectors) = eigen(&mean, m);
        let directions =
            values.iter().zip(&vectors).filter(|(value, _)| **value > ROUND || **value < 1.0 / ROUND).map(
                |(value, weights)| {
                    let mut u = vec![0.0; dim];
                    weights.iter().zip(&basis).for_each(|(w, q)| add(&mut u, *w, q));
                    (u, *value)
                },
            );
        Metric::low_rank(deviation.clone(), directions.collect())
    }
}

/// The rows less their mean.
fn centred(rows: &[f64], dim: usize) -> Vec<f64> {
    let n = (rows.len() / dim) as f64;
    let mut mean = vec![0.0; dim];
    rows.chunks_exact(dim).for_each(|row| add(&mut mean, 1.0 / n, row));
    let mut result = rows.to_vec();
    result.chunks_exact_mut(dim).for_each(|row| add(row, -1.0, &mean));
    result
}

/// The variance of each column of centred rows.
fn variances(rows: &[f64], dim: usize) -> Vec<f64> {
    let mut result = vec![0.0; dim];
    for row in rows.chunks_exact(dim) {
        result.iter_mut().zip(row).for_each(|(v, x)| *v += x * x);
    }
    let n = (rows.len() / dim) as f64;
    result.iter().map(|v| v / (n - 1.0)).collect()
}

/// Variances that may be divided by: a coordinate that did not move, or moved out of all bounds, counts as 1.
fn positive(mut variances: Vec<f64>) -> Vec<f64> {
    for v in &mut variances {
        if !(*v > 1e-300 && *v < 1e300) {
            *v = 1.0;
        }
    }
    variances
}

/// Orthonormal vectors that span the directions of largest spread of centred rows, by subspace iteration from fixed
/// starting vectors.
fn principal(rows: &[f64], dim: usize, count: usize) -> Vec<Vec<f64>> {
    let mut stream = Stream::new(0, 0, 0, 0);
    let mut basis: Vec<Vec<f64>> = (0..count).map(|_| (0..dim).map(|_| stream.normal()).collect()).collect();
    orthonormalise(&mut basis);
    for _ in 0..ROUNDS {
        for q in &mut basis {
            let mut image = vec![0.0; dim];
            rows.chunks_exact(dim).for_each(|row| add(&mut image, dot(row, q), row));
            *q = image;
        }
        orthonormalise(&mut basis);
    }
    basis
}

/// Gram-Schmidt, twice for rounding; vectors that depend on those before them are left out.
fn orthonormalise(vectors: &mut Vec<Vec<f64>>) {
    let mut result: Vec<Vec<f64>> = Vec::new();
    for mut v in vectors.drain(..) {
        let before = dot(&v, &v).sqrt();
        for _ in 0..2 {
            for q in &result {
                let along = dot(q, &v);
                add(&mut v, -along, q);
            }
        }
        let norm = dot(&v, &v).sqrt();
        if norm > 1e-8 * before && norm.is_finite() {
            v.iter_mut().for_each(|x| *x /= norm);
            result.push(v);
        }
    }
    *vectors = result;
}

/// The covariance of centred rows in a basis, `(m, m)` by rows.
fn projected(rows: &[f64], dim: usize, basis: &[Vec<f64>]) -> Vec<f64> {
    let m = basis.len();
    let n = (rows.len() / dim) as f64;
    let mut result = vec![0.0; m * m];
    for row in rows.chunks_exact(dim) {
        let seen: Vec<f64> = basis.iter().map(|q| dot(q, row)).collect();
        (0..m).for_each(|i| add(&mut result[i * m..(i + 1) * m], seen[i] / (n - 1.0), &seen));
    }
    (0..m).for_each(|i| result[i * m + i] += RIDGE);
    result
}

/// The symmetric `S` with `S B S = A`: `B^(-1/2) (B^(1/2) A B^(1/2))^(1/2) B^(-1/2)`.
fn geometric_mean(a: &[f64], b: &[f64], m: usize) -> Vec<f64> {
    let root = power(b, m, 0.5);
    let inverse = power(b, m, -0.5);
    let middle = power(&product(&product(&root, a, m), &root, m), m, 0.5);
    product(&product(&inverse, &middle, m), &inverse, m)
}

fn product(a: &[f64], b: &[f64], m: usize) -> Vec<f64> {
    let mut result = vec![0.0; m * m];
    for i in 0..m {
        for k in 0..m {
            add(&mut result[i * m..(i + 1) * m], a[i * m + k], &b[k * m..(k + 1) * m]);
        }
    }
    result
}

/// A power of a symmetric positive matrix.
fn power(a: &[f64], m: usize, exponent: f64) -> Vec<f64> {
    let (values, vectors) = eigen(a, m);
    let mut result = vec![0.0; m * m];
    for (value, u) in values.iter().zip(&vectors) {
        let scale = value.max(1e-300).powf(exponent);
        (0..m).for_each(|i| add(&mut result[i * m..(i + 1) * m], scale * u[i], u));
    }
    result
}

/// Eigenvalues and orthonormal eigenvectors of a symmetric matrix by rows: cyclic Jacobi rotations (Golub & Van Loan
/// 2013, algorithm 8.5.3). Meant for matrices of a few dozen rows.
fn eigen(a: &[f64], m: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut a = a.to_vec();
    let mut v: Vec<Vec<f64>> =
        (0..m).map(|i| (0..m).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for _ in 0..60 {
        let size: f64 = a.iter().map(|x| x * x).sum();
        let off: f64 = (0..m * m).filter(|k| k / m != k % m).map(|k| a[k] * a[k]).sum();
        if off.is_nan() || off <= 1e-30 * size {
            break;
        }
        for p in 0..m {
            for q in p + 1..m {
                let apq = a[p * m + q];
                if apq == 0.0 {
                    continue;
                }
                let tau = (a[q * m + q] - a[p * m + p]) / (2.0 * apq);
                let t = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
                let c = 1.0 / (1.0 + t * t).sqrt();
                let s = t * c;
                for k in 0..m {
                    let (x, y) = (a[k * m + p], a[k * m + q]);
                    a[k * m + p] = c * x - s * y;
                    a[k * m + q] = s * x + c * y;
                }
                for k in 0..m {
                    let (x, y) = (a[p * m + k], a[q * m + k]);
                    a[p * m + k] = c * x - s * y;
                    a[q * m + k] = s * x + c * y;
                }
                // Row p of `v` is the vector of eigenvalue p.
                let (low, high) = v.split_at_mut(q);
                for (x, y) in low[p].iter_mut().zip(&mut high[0]) {
                    (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                }
            }
        }
    }
    ((0..m).map(|i| a[i * m + i]).collect(), v)
}

#[cfg(test)]
mod tests {
    //! Each shape finds the covariance of a normal, as far as its shape allows.
    use super::*;
    use crate::hamiltonian::metric::Direction;

    /// A normal with standard deviations 10^-3 to 10^3 and one tight and one loose direction across them.
    fn window(n: usize, dim: usize) -> (Window, Vec<f64>, Vec<Direction>) {
        let scales: Vec<f64> =
            (0..dim).map(|i| 10f64.powf(6.0 * i as f64 / (dim - 1) as f64 - 3.0)).collect();
        let unit = |sign: f64| -> Vec<f64> {
            (0..dim).map(|i| if i % 2 == 0 { 1.0 } else { sign } / (dim as f64).sqrt()).collect()
        };
        let directions: Vec<Direction> = vec![(unit(1.0), 1e-4), (unit(-1.0), 1e4)];
        let mut window = Window::new(dim);
        for k in 0..n {
            let mut stream = Stream::new(1, 0, k as u128, 0);
            let z: Vec<f64> = (0..dim).map(|_| stream.normal()).collect();
            let (mut x, mut g) = (z.clone(), z.clone());
            for (u, value) in &directions {
                add(&mut x, (value.sqrt() - 1.0) * dot(u, &z), u);
                add(&mut g, (1.0 / value.sqrt() - 1.0) * dot(u, &z), u);
            }
            x.iter_mut().zip(&scales).for_each(|(x, s)| *x *= s);
            g.iter_mut().zip(&scales).for_each(|(g, s)| *g = -*g / s);
            window.push(&x, &g);
        }
        (window, scales, directions)
    }

    /// Ratio of the largest to the smallest variance that a metric leaves to be integrated: the eigenvalues of
    /// `M C`, over the random directions and the two that matter.
    fn spread(metric: &Metric, scales: &[f64], directions: &[Direction]) -> f64 {
        // q^T M^-1 q against q^T C q for the covectors q = D^-1 u.
        let dim = scales.len();
        let mut stream = Stream::new(2, 0, 0, 0);
        let mut probes: Vec<Vec<f64>> =
            (0..20).map(|_| (0..dim).map(|_| stream.normal()).collect()).collect();
        probes.extend(directions.iter().map(|(u, _)| u.clone()));
        let mut ratios = Vec::new();
        for z in probes {
            let mut cz = z.clone();
            directions.iter().for_each(|(u, value)| add(&mut cz, (value - 1.0) * dot(u, &z), u));
            let q: Vec<f64> = z.iter().zip(scales).map(|(z, s)| z / s).collect();
            let mut v = vec![0.0; dim];
            metric.velocity(&q, &mut v);
            ratios.push(dot(&q, &v) / dot(&z, &cz));
        }
        let (low, high) = ratios.iter().fold((f64::MAX, 0f64), |(l, h), r| (l.min(*r), h.max(*r)));
        high / low
    }

    #[test]
    fn low_rank_sees_tight_directions_dense_some_diagonal_none() {
        // The target's condition is 1e20 with the scales, 1e8 without them.
        let (window, scales, directions) = window(2000, 10);
        let left = |shape| spread(&window.metric(shape).expect("enough draws"), &scales, &directions);
        assert!(left(Shape::Diagonal) > 1e6, "{}", left(Shape::Diagonal));
        // The mixed-in diagonal (weight 5 of 2005, variances around 1e3) hides the direction of variance 1e-4.
        assert!(left(Shape::Dense) < 1e-2 * left(Shape::Diagonal), "{}", left(Shape::Dense));
        assert!(left(Shape::LowRank) < 30.0, "{}", left(Shape::LowRank));
    }

    #[test]
    fn a_low_rank_metric_needs_fewer_draws_than_there_are_coordinates() {
        let (window, scales, directions) = window(60, 120);
        let left = spread(&window.metric(Shape::LowRank).expect("enough draws"), &scales, &directions);
        assert!(left < 100.0, "{left}");
    }

    #[test]
    fn a_dense_metric_is_made_of_few_draws() {
        let (window, ..) = window(5, 12);
        assert!(matches!(window.metric(Shape::Dense), Some(Metric::Dense { .. })));
        assert_eq!(Window::new(4).metric(Shape::Dense), None);
    }

    #[test]
    fn coordinates_that_do_not_move_are_left_alone() {
        let mut still = Window::new(2);
        (0..10).for_each(|k| still.push(&[3.0, f64::from(k)], &[0.0, 0.0]));
        let Some(Metric::Diagonal { variance, .. }) = still.metric(Shape::Diagonal) else {
            panic!("diagonal")
        };
        assert_eq!(variance[0], 1.0);
        assert!((variance[1] - 55.0 / 6.0).abs() < 1e-12);
    }

    #[test]
    fn eigenvectors_diagonalise() {
        let a = [4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 5.0];
        let (values, vectors) = eigen(&a, 3);
        for (value, u) in values.iter().zip(&vectors) {
            for i in 0..3 {
                assert!((dot(&a[3 * i..3 * i + 3], u) - value * u[i]).abs() < 1e-12);
            }
        }
        let (b, m) = ([2.0, 0.3, 0.3, 1.0], [1.0, 0.4, 0.4, 3.0]);
        let s = geometric_mean(&m, &b, 2);
        let back = product(&product(&s, &b, 2), &s, 2);
        assert!(back.iter().zip(&m).all(|(x, y)| (x - y).abs() < 1e-12));
    }
}
