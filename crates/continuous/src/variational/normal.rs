//! A normal over unconstrained coordinates, `x = mean + S z` with `z` standard normal.
//!
//! `log q(x) = -z.z / 2 - dim/2 log(2 pi) - log |S|`: with `z` at hand no matrix is inverted.

use super::LANES;
use super::batch::{Row, add, dot};
use super::turns::Turns;
use crate::hamiltonian::metric::cholesky;
use niwaki_math::Stream;

/// `log(2 pi)`.
const LOG_TWO_PI: f64 = 1.837_877_066_409_345_5;

/// The matrix `S`.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// A deviation for each coordinate.
    Diagonal(Vec<f64>),
    /// `S = D (I + Q (C - I) Q^T)`: `D` diagonal, the columns of `Q` orthonormal, `C` a lower triangle.
    LowRank {
        /// The diagonal of `D`.
        deviation: Vec<f64>,
        /// The columns of `Q`.
        basis: Vec<Vec<f64>>,
        /// `C` by rows, (columns, columns).
        core: Vec<f64>,
    },
    /// Any matrix by rows, (dim, dim).
    Dense(Vec<f64>),
}

/// A normal distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Normal {
    /// Its mean.
    pub mean: Vec<f64>,
    /// Its matrix `S`.
    pub scale: Scale,
    /// `log |S|`, nats.
    pub log_det: f64,
}

impl Normal {
    /// Independent coordinates with these deviations.
    pub fn diagonal(mean: Vec<f64>, deviation: Vec<f64>) -> Normal {
        let log_det = deviation.iter().map(|d| d.ln()).sum();
        Normal { mean, scale: Scale::Diagonal(deviation), log_det }
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.mean.len()
    }

    /// Draws: their `z` and their positions `x`, both (dim, lanes).
    pub fn draw(&self, stream: &mut Stream, z: &mut [Row], x: &mut [Row]) {
        z.iter_mut().flatten().for_each(|z| *z = stream.normal());
        self.place(z, x);
    }

    /// The positions of draws: `x = mean + S z`.
    pub fn place(&self, z: &[Row], x: &mut [Row]) {
        self.spread(z, x);
        x.iter_mut().zip(&self.mean).for_each(|(x, m)| x.iter_mut().for_each(|x| *x += m));
    }

    /// `y = S z`.
    pub fn spread(&self, z: &[Row], y: &mut [Row]) {
        match &self.scale {
            Scale::Diagonal(deviation) => scaled(deviation, z, y),
            Scale::LowRank { deviation, basis, core } => {
                y.copy_from_slice(z);
                let along: Vec<Row> = basis.iter().map(|column| dot(column, z)).collect();
                for (i, column) in basis.iter().enumerate() {
                    let mut change = along[i].map(|a| -a);
                    let row = &core[i * basis.len()..i * basis.len() + i + 1];
                    row.iter().zip(&along).for_each(|(c, a)| add(&mut change, *c, a));
                    y.iter_mut().zip(column).for_each(|(y, q)| add(y, *q, &change));
                }
                scale(deviation, y);
            }
            Scale::Dense(matrix) => {
                for (y, row) in y.iter_mut().zip(matrix.chunks_exact(z.len())) {
                    *y = dot(row, z);
                }
            }
        }
    }

    /// `y = S^T g`.
    pub fn pull(&self, g: &[Row], y: &mut [Row]) {
        match &self.scale {
            Scale::Diagonal(deviation) => scaled(deviation, g, y),
            Scale::LowRank { deviation, basis, core } => {
                scaled(deviation, g, y);
                let along: Vec<Row> = basis.iter().map(|column| dot(column, y)).collect();
                for (j, column) in basis.iter().enumerate() {
                    let mut change = along[j].map(|a| -a);
                    for (i, a) in along.iter().enumerate().skip(j) {
                        add(&mut change, core[i * basis.len() + j], a);
                    }
                    y.iter_mut().zip(column).for_each(|(y, q)| add(y, *q, &change));
                }
            }
            Scale::Dense(matrix) => {
                y.fill([0.0; LANES]);
                for (g, row) in g.iter().zip(matrix.chunks_exact(g.len())) {
                    y.iter_mut().zip(row).for_each(|(y, s)| add(y, *s, g));
                }
            }
        }
    }

    /// The log density of draws, nats, by their `z`.
    pub fn log_density(&self, z: &[Row]) -> Row {
        let mut squares = [0.0; LANES];
        for row in z {
            squares.iter_mut().zip(row).for_each(|(sum, z)| *sum += z * z);
        }
        let constant = 0.5 * self.dim() as f64 * LOG_TWO_PI + self.log_det;
        squares.map(|square| -0.5 * square - constant)
    }

    /// The log density of draws on the circles of the angles, nats, by their `z`; see [`super::turns`]. The matrix is a
    /// diagonal, or that of [`Normal::in_order`].
    pub fn log_density_around(&self, z: &[Row], angles: &[usize]) -> Row {
        let mut log = self.log_density(z);
        self.turns(angles).add(z, &mut log);
        log
    }

    /// The angles with their deviations, given the coordinates before them.
    pub fn turns(&self, angles: &[usize]) -> Turns {
        let (dim, first) = (self.dim(), self.dim() - angles.len());
        let of = |(k, angle): (usize, &usize)| match &self.scale {
            Scale::Diagonal(deviation) => (*angle, deviation[*angle]),
            Scale::Dense(matrix) => (first + k, matrix[angle * dim + first + k]),
            Scale::LowRank { .. } => unreachable!("angles are in order first"),
        };
        Turns(angles.iter().enumerate().map(of).collect())
    }

    /// The normal in sequential form: each number `z` belongs to a coordinate given those before it, angles last. Its matrix
    /// is a lower triangle but for the order of its rows ([`order`]). Without angles the normal stays as it is. `None` where
    /// rounding leaves no triangle.
    pub fn in_order(&self, angles: &[usize]) -> Option<Normal> {
        if angles.is_empty() {
            return Some(self.clone());
        }
        let (dim, covariance) = (self.dim(), self.covariance());
        let order = order(dim, angles);
        let entry = |i: usize, j: usize| match self.scale {
            Scale::Diagonal(_) if i == j => covariance[i],
            Scale::Diagonal(_) => 0.0,
            _ => covariance[i * dim + j],
        };
        let moved: Vec<f64> = order.iter().flat_map(|i| order.iter().map(|j| entry(*i, *j))).collect();
        let triangle = cholesky(&moved)?;
        let mut matrix = vec![0.0; dim * dim];
        for (k, i) in order.iter().enumerate() {
            matrix[i * dim..i * dim + k + 1].copy_from_slice(&triangle[k * dim..k * dim + k + 1]);
        }
        let log_det = (0..dim).map(|k| triangle[k * dim + k].ln()).sum();
        Some(Normal { mean: self.mean.clone(), scale: Scale::Dense(matrix), log_det })
    }

    /// The `z` of positions: the inverse of [`Normal::place`]. A dense matrix is that of [`Normal::in_order`].
    pub fn whiten(&self, x: &[Row], angles: &[usize], z: &mut [Row]) {
        let dim = self.dim();
        let away = |i: usize| x[i].map(|x| x - self.mean[i]);
        match &self.scale {
            Scale::Diagonal(deviation) => {
                z.iter_mut().enumerate().for_each(|(i, z)| *z = away(i).map(|x| x / deviation[i]));
            }
            Scale::LowRank { deviation, basis, core } => {
                z.iter_mut().enumerate().for_each(|(i, z)| *z = away(i).map(|x| x / deviation[i]));
                let along: Vec<Row> = basis.iter().map(|column| dot(column, z)).collect();
                let mut solved: Vec<Row> = Vec::with_capacity(along.len());
                for (i, row) in along.iter().enumerate() {
                    let (mut left, c) = (*row, &core[i * basis.len()..]);
                    solved.iter().zip(c).for_each(|(known, c)| add(&mut left, -c, known));
                    solved.push(left.map(|x| x / c[i]));
                }
                for ((column, solved), along) in basis.iter().zip(&mut solved).zip(&along) {
                    add(solved, -1.0, along);
                    z.iter_mut().zip(column).for_each(|(z, q)| add(z, *q, solved));
                }
            }
            Scale::Dense(matrix) => {
                for (k, i) in order(dim, angles).into_iter().enumerate() {
                    let (mut left, row) = (away(i), &matrix[i * dim..]);
                    z[..k].iter().zip(row).for_each(|(known, s)| add(&mut left, -s, known));
                    z[k] = left.map(|x| x / row[k]);
                }
            }
        }
    }

    /// The normal of independent coordinates that is nearest: its deviations are the roots of the inverse of the
    /// precision's diagonal. (Of a dense one, with the deviations of the coordinates alone.)
    #[must_use]
    pub fn nearest_diagonal(&self) -> Normal {
        let deviation = match &self.scale {
            Scale::Diagonal(deviation) => deviation.clone(),
            Scale::LowRank { deviation, basis, core } => {
                let solved = solve_columns(core, basis);
                let marginal = |i: usize| {
                    let (before, after) = basis
                        .iter()
                        .zip(&solved)
                        .fold((0.0, 0.0), |(b, a), (q, s)| (b + q[i] * q[i], a + s[i] * s[i]));
                    deviation[i] / (1.0 - before + after).max(f64::MIN_POSITIVE).sqrt()
                };
                (0..self.dim()).map(marginal).collect()
            }
            Scale::Dense(matrix) => matrix
                .chunks_exact(self.dim().max(1))
                .map(|row| row.iter().map(|s| s * s).sum::<f64>().sqrt())
                .collect(),
        };
        Normal::diagonal(self.mean.clone(), deviation)
    }

    /// Variances, (dim,), where coordinates are independent; else the covariance by rows, (dim, dim).
    pub fn covariance(&self) -> Vec<f64> {
        let dim = self.dim();
        if let Scale::Diagonal(deviation) = &self.scale {
            return deviation.iter().map(|d| d * d).collect();
        }
        let matrix = self.matrix();
        let mut product = vec![0.0; dim * dim];
        for i in 0..dim {
            for j in 0..=i {
                let sum = (0..dim).map(|k| matrix[i * dim + k] * matrix[j * dim + k]).sum();
                (product[i * dim + j], product[j * dim + i]) = (sum, sum);
            }
        }
        product
    }

    /// `S` by rows, (dim, dim).
    pub fn matrix(&self) -> Vec<f64> {
        let dim = self.dim();
        let (mut matrix, mut y) = (vec![0.0; dim * dim], vec![[0.0; LANES]; dim]);
        for first in (0..dim).step_by(LANES) {
            let mut units = vec![[0.0; LANES]; dim];
            let count = LANES.min(dim - first);
            (0..count).for_each(|l| units[first + l][l] = 1.0);
            self.spread(&units, &mut y);
            for (i, row) in y.iter().enumerate() {
                matrix[i * dim + first..i * dim + first + count].copy_from_slice(&row[..count]);
            }
        }
        matrix
    }

    /// The low-rank normal with `S S^T = D (I + B M B^T) D`; `B` has the columns `columns`, `M` is symmetric, by rows.
    /// `None` where that is not positive definite.
    pub fn low_rank(mean: Vec<f64>, deviation: Vec<f64>, columns: &[Vec<f64>], m: &[f64]) -> Option<Normal> {
        let (basis, shares) = orthonormal(columns);
        let (rank, count) = (basis.len(), columns.len());
        let mut inner = vec![0.0; rank * rank];
        for i in 0..rank {
            let left: Vec<f64> =
                (0..count).map(|k| (0..count).map(|j| shares[j][i] * m[j * count + k]).sum()).collect();
            for j in 0..rank {
                inner[i * rank + j] = (0..count).map(|k| left[k] * shares[k][j]).sum::<f64>();
            }
        }
        for i in 0..rank {
            for j in 0..i {
                let mean = 0.5 * (inner[i * rank + j] + inner[j * rank + i]);
                (inner[i * rank + j], inner[j * rank + i]) = (mean, mean);
            }
            inner[i * rank + i] += 1.0;
        }
        let core = cholesky(&inner)?;
        let log_det = deviation.iter().map(|d| d.ln()).sum::<f64>()
            + (0..rank).map(|i| core[i * rank + i].ln()).sum::<f64>();
        let is_sound = log_det.is_finite() && mean.iter().all(|x| x.is_finite());
        is_sound.then_some(Normal { mean, scale: Scale::LowRank { deviation, basis, core }, log_det })
    }
}

/// The coordinates in the order of [`Normal::in_order`]: angles last.
pub fn order(dim: usize, angles: &[usize]) -> Vec<usize> {
    (0..dim).filter(|i| !angles.contains(i)).chain(angles.iter().copied()).collect()
}

/// `y = D z`.
fn scaled(deviation: &[f64], z: &[Row], y: &mut [Row]) {
    y.copy_from_slice(z);
    scale(deviation, y);
}

fn scale(deviation: &[f64], y: &mut [Row]) {
    y.iter_mut().zip(deviation).for_each(|(y, d)| y.iter_mut().for_each(|y| *y *= d));
}

/// `C^-1 Q^T`, by rows of `dim` numbers, for the lower triangle `C` and the columns of `Q`.
fn solve_columns(core: &[f64], basis: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut solved: Vec<Vec<f64>> = vec![];
    for (i, column) in basis.iter().enumerate() {
        let mut row = column.clone();
        for (j, known) in solved.iter().enumerate() {
            let c = core[i * basis.len() + j];
            row.iter_mut().zip(known).for_each(|(x, k)| *x -= c * k);
        }
        let pivot = core[i * basis.len() + i];
        row.iter_mut().for_each(|x| *x /= pivot);
        solved.push(row);
    }
    solved
}

/// A column whose part outside of the others is less than this share of it adds nothing.
const DEPENDENT: f64 = 1e-10;

/// An orthonormal basis of columns (Gram-Schmidt, twice), and each column in it.
fn orthonormal(columns: &[Vec<f64>]) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let inner = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (mut basis, mut shares): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (vec![], vec![]);
    for column in columns {
        let (mut rest, mut coefficients) = (column.clone(), vec![0.0; basis.len()]);
        for _ in 0..2 {
            for (q, coefficient) in basis.iter().zip(&mut coefficients) {
                let along = inner(q, &rest);
                rest.iter_mut().zip(q).for_each(|(x, q)| *x -= along * q);
                *coefficient += along;
            }
        }
        let length = inner(&rest, &rest).sqrt();
        if length > DEPENDENT * inner(column, column).sqrt() {
            basis.push(rest.iter().map(|x| x / length).collect());
            coefficients.push(length);
        }
        shares.push(coefficients);
    }
    let rank = basis.len();
    shares.iter_mut().for_each(|coefficients| coefficients.resize(rank, 0.0));
    (basis, shares)
}

#[cfg(test)]
mod tests {
    //! Matrices and their products, densities and the nearest diagonal agree with plain sums.
    use super::*;

    fn low_rank() -> Normal {
        let columns = vec![vec![1.0, 0.5, 0.0, -0.3], vec![0.2, -1.0, 0.4, 0.1], vec![2.0, 1.0, 0.0, -0.6]];
        let m = [0.9, 0.1, 0.0, 0.1, -0.2, 0.05, 0.0, 0.05, 0.3];
        Normal::low_rank(vec![1.0, 2.0, 3.0, 4.0], vec![0.5, 1.0, 2.0, 1.5], &columns, &m)
            .expect("positive definite")
    }

    /// `D (I + B M B^T) D` of the same numbers.
    fn expected() -> Vec<f64> {
        let columns = [[1.0, 0.5, 0.0, -0.3], [0.2, -1.0, 0.4, 0.1], [2.0, 1.0, 0.0, -0.6]];
        let (m, d) = ([0.9, 0.1, 0.0, 0.1, -0.2, 0.05, 0.0, 0.05, 0.3], [0.5, 1.0, 2.0, 1.5]);
        let mut c = vec![0.0; 16];
        for i in 0..4 {
            for j in 0..4 {
                let mut sum = f64::from(u8::from(i == j));
                for k in 0..3 {
                    (0..3).for_each(|l| sum += columns[k][i] * m[k * 3 + l] * columns[l][j]);
                }
                c[i * 4 + j] = d[i] * sum * d[j];
            }
        }
        c
    }

    #[test]
    fn positions_lead_back_to_their_draws_and_the_order_keeps_the_covariance() {
        let normal = low_rank();
        let ordered = normal.in_order(&[1, 2]).expect("positive definite");
        for (a, b) in ordered.covariance().iter().zip(normal.covariance()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        assert!((ordered.log_det - normal.log_det).abs() < 1e-12);
        assert!((ordered.turns(&[1, 2]).0[1].1.powi(-2) - inverse_of(&expected(), 2)).abs() < 1e-9);
        let mut z = vec![[0.0; LANES]; 4];
        let mut stream = Stream::new(2, 0, 0, 0);
        for form in [&normal, &ordered, &normal.nearest_diagonal()] {
            let (mut x, mut back) = (z.clone(), z.clone());
            form.draw(&mut stream, &mut z, &mut x);
            form.whiten(&x, &[1, 2], &mut back);
            assert!(z.iter().flatten().zip(back.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-10));
        }
    }

    /// An entry of the diagonal of the inverse: one over the variance given all other coordinates.
    fn inverse_of(covariance: &[f64], at: usize) -> f64 {
        let order: Vec<usize> = (0..4).filter(|i| *i != at).chain([at]).collect();
        let entry = |i: &usize| order.iter().map(|j| covariance[i * 4 + j]).collect::<Vec<_>>();
        cholesky(&order.iter().flat_map(entry).collect::<Vec<_>>()).expect("positive definite")[15].powi(-2)
    }

    #[test]
    fn a_low_rank_normal_has_its_covariance_and_determinant() {
        let (normal, expected) = (low_rank(), expected());
        for (a, b) in normal.covariance().iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let l = cholesky(&expected).expect("positive definite");
        let log_det: f64 = (0..4).map(|i| l[i * 5].ln()).sum();
        assert!((normal.log_det - log_det).abs() < 1e-12);
    }

    #[test]
    fn the_transpose_and_the_nearest_diagonal_are_those_of_the_matrix() {
        let normal = low_rank();
        let matrix = normal.matrix();
        let mut g = vec![[0.0; LANES]; 4];
        let mut stream = Stream::new(1, 0, 0, 0);
        g.iter_mut().flatten().for_each(|g| *g = stream.normal());
        let dense = Normal { scale: Scale::Dense(matrix.clone()), ..normal.clone() };
        let (mut a, mut b) = (g.clone(), g.clone());
        normal.pull(&g, &mut a);
        dense.pull(&g, &mut b);
        assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-12));
        // The precision's diagonal by the columns of the inverse of `S`.
        let inverse = |column: usize| {
            let (mut rows, mut unit) = (matrix.clone(), vec![0.0; 4]);
            unit[column] = 1.0;
            for k in 0..4 {
                for i in (0..4).filter(|i| *i != k) {
                    let f = rows[i * 4 + k] / rows[k * 5];
                    (0..4).for_each(|j| rows[i * 4 + j] -= f * rows[k * 4 + j]);
                    unit[i] -= f * unit[k];
                }
            }
            (0..4).map(|i| (unit[i] / rows[i * 5]).powi(2)).sum::<f64>()
        };
        let Scale::Diagonal(deviation) = normal.nearest_diagonal().scale else { panic!("a diagonal") };
        for (i, d) in deviation.iter().enumerate() {
            assert!((d - 1.0 / inverse(i).sqrt()).abs() < 1e-10, "{i}");
        }
    }
}
