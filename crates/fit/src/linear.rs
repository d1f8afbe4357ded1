//! Linear algebra with sums in a fixed order: the same bits on every machine, and fast enough in vector instructions.
//!
//! A dot product has eight partial sums, whatever the machine has; each is a sum of every eighth product, and they are
//! added pairwise. The compiler may compute several of them at once, which changes no bit.

#![expect(clippy::needless_range_loop, reason = "indices are those of the books")]

/// The number of partial sums.
const LANES: usize = 8;

/// The dot product of two vectors of equal length.
#[inline]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let (left, right) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let mut rest = 0.0;
    for (x, y) in left.remainder().iter().zip(right.remainder()) {
        rest += x * y;
    }
    for (x, y) in left.zip(right) {
        for k in 0..LANES {
            sums[k] += x[k] * y[k];
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    (((a + b) + (c + d)) + ((e + f) + (g + h))) + rest
}

/// Adds `factor` times a vector to another.
#[inline]
pub fn add_scaled(to: &mut [f64], factor: f64, from: &[f64]) {
    for (x, y) in to.iter_mut().zip(from) {
        *x += factor * y;
    }
}

/// A matrix, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    values: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Matrix {
        Matrix { rows, columns, values: vec![0.0; rows * columns] }
    }

    /// A row.
    #[inline]
    pub fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.columns..(i + 1) * self.columns]
    }

    /// A row, to change.
    #[inline]
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.values[i * self.columns..(i + 1) * self.columns]
    }

    /// All values, row by row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The matrix with rows for columns.
    pub fn transposed(&self) -> Matrix {
        let mut out = Matrix::zeros(self.columns, self.rows);
        for i in 0..self.rows {
            for (j, value) in self.row(i).iter().enumerate() {
                out.values[j * self.rows + i] = *value;
            }
        }
        out
    }
}

/// The Cholesky factor of a symmetric positive matrix: `matrix = L L^T` with `L` lower triangular.
#[derive(Clone, Debug)]
pub struct Cholesky(Matrix);

impl Cholesky {
    /// Factors a matrix, of which only the lower triangle is read; None if it is not positive.
    pub fn of(mut matrix: Matrix) -> Option<Cholesky> {
        let n = matrix.rows;
        for i in 0..n {
            let (above, from) = matrix.values.split_at_mut(i * n);
            let row = &mut from[..n];
            for j in 0..i {
                let other = &above[j * n..j * n + j + 1];
                row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
            }
            let pivot = row[i] - dot(&row[..i], &row[..i]);
            if pivot.is_nan() || pivot <= 0.0 {
                return None;
            }
            row[i] = pivot.sqrt();
            row[i + 1..].fill(0.0);
        }
        Some(Cholesky(matrix))
    }

    /// Solves `L x = b` in place.
    pub fn solve_lower(&self, b: &mut [f64]) {
        for i in 0..b.len() {
            let row = self.0.row(i);
            b[i] = (b[i] - dot(&row[..i], &b[..i])) / row[i];
        }
    }

    /// Solves `L^T x = b` in place.
    pub fn solve_upper(&self, b: &mut [f64]) {
        for i in (0..b.len()).rev() {
            let row = self.0.row(i);
            b[i] /= row[i];
            let (before, at) = b.split_at_mut(i);
            add_scaled(before, -at[0], &row[..i]);
        }
    }

    /// The inverse of the matrix; only its lower triangle is computed.
    pub fn inverse(&self) -> Matrix {
        let n = self.0.rows;
        // Rows of the inverse of `L^T`: row `i` solves `L x = unit i`, which is 0 before `i`.
        let mut half = Matrix::zeros(n, n);
        for i in 0..n {
            let x = half.row_mut(i);
            x[i] = 1.0 / self.0.row(i)[i];
            for k in i + 1..n {
                let row = self.0.row(k);
                x[k] = -dot(&row[i..k], &x[i..k]) / row[k];
            }
        }
        let mut out = Matrix::zeros(n, n);
        for i in 0..n {
            for j in 0..=i {
                out.row_mut(i)[j] = dot(&half.row(i)[i..], &half.row(j)[i..]);
            }
        }
        out
    }

    /// The diagonal of `L`.
    pub fn diagonal(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.0.rows).map(|i| self.0.row(i)[i])
    }
}

/// A matrix `R` with few columns such that `R R^T` is near a symmetric matrix without negative eigenvalues.
///
/// The Cholesky factor with pivots: each column takes the largest of what is left on the diagonal. It ends after `rank`
/// columns, or when what is left is below a share of 1e-12.
pub fn low_rank(matrix: &Matrix, rank: usize) -> Matrix {
    let n = matrix.rows;
    let mut left: Vec<f64> = (0..n).map(|i| matrix.row(i)[i]).collect();
    let all: f64 = left.iter().sum();
    // Rows of the factor, as long as they are known.
    let mut rows = Matrix::zeros(n, rank);
    let mut count = 0;
    while count < rank {
        let mut pivot = 0;
        for i in 1..n {
            if left[i] > left[pivot] {
                pivot = i;
            }
        }
        let rest: f64 = left.iter().sum();
        if left[pivot].is_nan() || left[pivot] <= 0.0 || rest <= 1e-12 * all {
            break;
        }
        let root = left[pivot].sqrt();
        let chosen = rows.row(pivot)[..count].to_vec();
        for i in 0..n {
            let value = (matrix.row(pivot)[i] - dot(&rows.row(i)[..count], &chosen)) / root;
            rows.row_mut(i)[count] = value;
            left[i] = (left[i] - value * value).max(0.0);
        }
        left[pivot] = 0.0;
        count += 1;
    }
    let mut out = Matrix::zeros(n, count);
    for i in 0..n {
        out.row_mut(i).copy_from_slice(&rows.row(i)[..count]);
    }
    out
}

/// The eigenvalues of a symmetric matrix, falling, and its eigenvectors as rows.
///
/// Householder's reduction to three diagonals, then the implicit QL method (Wilkinson & Reinsch 1971, contributions II/2
/// and II/4; tred2 and tql2 of EISPACK).
pub fn eigen(matrix: &Matrix) -> (Vec<f64>, Matrix) {
    let n = matrix.rows;
    if n == 0 {
        return (vec![], Matrix::zeros(0, 0));
    }
    // `v[j]` holds the transformation's j-th column, so that the rotations of QL run along memory.
    let mut v: Vec<Vec<f64>> = (0..n).map(|j| matrix.row(j).to_vec()).collect();
    let (mut d, mut e) = (vec![0.0; n], vec![0.0; n]);
    reduce(&mut v, &mut d, &mut e);
    rotate(&mut v, &mut d, &mut e);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| d[*b].total_cmp(&d[*a]));
    let mut vectors = Matrix::zeros(n, n);
    for (place, from) in order.iter().enumerate() {
        vectors.row_mut(place).copy_from_slice(&v[*from]);
    }
    (order.iter().map(|k| d[*k]).collect(), vectors)
}

/// Householder's reduction: diagonal `d`, below it `e` (from 1), columns of the transformation in `v`.
fn reduce(v: &mut [Vec<f64>], d: &mut [f64], e: &mut [f64]) {
    let n = d.len();
    for j in 0..n {
        d[j] = v[j][n - 1];
    }
    for i in (1..n).rev() {
        let scale: f64 = d[..i].iter().map(|x| x.abs()).sum();
        let mut h = 0.0;
        if scale == 0.0 {
            e[i] = d[i - 1];
            for j in 0..i {
                d[j] = v[j][i - 1];
                v[j][i] = 0.0;
                v[i][j] = 0.0;
            }
        } else {
            for x in &mut d[..i] {
                *x /= scale;
                h += *x * *x;
            }
            let f = d[i - 1];
            let g = if f > 0.0 { -h.sqrt() } else { h.sqrt() };
            e[i] = scale * g;
            h -= f * g;
            d[i - 1] = f - g;
            e[..i].fill(0.0);
            for j in 0..i {
                let f = d[j];
                v[i][j] = f;
                let mut g = e[j] + v[j][j] * f;
                for k in j + 1..i {
                    g += v[j][k] * d[k];
                    e[k] += v[j][k] * f;
                }
                e[j] = g;
            }
            let mut f = 0.0;
            for j in 0..i {
                e[j] /= h;
                f += e[j] * d[j];
            }
            let hh = f / (h + h);
            for j in 0..i {
                e[j] -= hh * d[j];
            }
            for j in 0..i {
                let (f, g) = (d[j], e[j]);
                for k in j..i {
                    v[j][k] -= f * e[k] + g * d[k];
                }
                d[j] = v[j][i - 1];
                v[j][i] = 0.0;
            }
        }
        d[i] = h;
    }
    for i in 0..n - 1 {
        v[i][n - 1] = v[i][i];
        v[i][i] = 1.0;
        let h = d[i + 1];
        if h != 0.0 {
            let column = v[i + 1][..=i].to_vec();
            for k in 0..=i {
                d[k] = column[k] / h;
            }
            for j in 0..=i {
                let g = dot(&column, &v[j][..=i]);
                add_scaled(&mut v[j][..=i], -g, &d[..=i]);
            }
        }
        v[i + 1][..=i].fill(0.0);
    }
    for j in 0..n {
        d[j] = v[j][n - 1];
        v[j][n - 1] = 0.0;
    }
    v[n - 1][n - 1] = 1.0;
    e[0] = 0.0;
}

/// The QL method with implicit shifts: eigenvalues into `d`, eigenvectors into `v`.
fn rotate(v: &mut [Vec<f64>], d: &mut [f64], e: &mut [f64]) {
    let n = d.len();
    e.copy_within(1.., 0);
    e[n - 1] = 0.0;
    let (mut f, mut largest) = (0.0_f64, 0.0_f64);
    for l in 0..n {
        largest = largest.max(d[l].abs() + e[l].abs());
        let small = |x: f64| x.abs() <= f64::EPSILON * largest;
        let m = (l..n).find(|&m| small(e[m])).unwrap_or(n - 1);
        // Fifty rounds are more than any matrix needs; a matrix with NaN ends here, too.
        for _ in 0..50 {
            if m == l {
                break;
            }
            let mut g = d[l];
            let mut p = (d[l + 1] - g) / (2.0 * e[l]);
            let mut r = (p * p + 1.0).sqrt();
            if p < 0.0 {
                r = -r;
            }
            d[l] = e[l] / (p + r);
            d[l + 1] = e[l] * (p + r);
            let next = d[l + 1];
            let h = g - d[l];
            for x in &mut d[l + 2..] {
                *x -= h;
            }
            f += h;
            p = d[m];
            let (mut c, mut c2, mut c3) = (1.0, 1.0, 1.0);
            let below = e[l + 1];
            let (mut s, mut s2) = (0.0, 0.0);
            for i in (l..m).rev() {
                c3 = c2;
                c2 = c;
                s2 = s;
                g = c * e[i];
                let h = c * p;
                r = (p * p + e[i] * e[i]).sqrt();
                e[i + 1] = s * r;
                s = e[i] / r;
                c = p / r;
                p = c * d[i] - s * g;
                d[i + 1] = h + s * (c * g + s * d[i]);
                let (left, right) = v.split_at_mut(i + 1);
                for (x, y) in left[i].iter_mut().zip(&mut right[0]) {
                    let (a, b) = (*x, *y);
                    *y = s * a + c * b;
                    *x = c * a - s * b;
                }
            }
            p = -s * s2 * c3 * below * e[l] / next;
            e[l] = s * p;
            d[l] = c * p;
            if small(e[l]) {
                break;
            }
        }
        d[l] += f;
        e[l] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    //! Each routine solves what it says, on matrices of many sizes.
    use super::*;
    use crate::dice::{Dice, Purpose};

    fn random(rows: usize, columns: usize, seed: u64) -> Matrix {
        let mut dice = Dice::new(seed, Purpose::Design, 0);
        let mut out = Matrix::zeros(rows, columns);
        out.values.iter_mut().for_each(|x| *x = dice.normal());
        out
    }

    fn gram(m: &Matrix) -> Matrix {
        let mut out = Matrix::zeros(m.rows, m.rows);
        for i in 0..m.rows {
            for j in 0..m.rows {
                out.row_mut(i)[j] = dot(m.row(i), m.row(j));
            }
        }
        out
    }

    #[test]
    fn a_dot_product_is_the_sum_of_products() {
        for n in [0, 1, 7, 8, 9, 40] {
            let (a, b) = (random(1, n, 1), random(1, n, 2));
            let plain: f64 = a.values().iter().zip(b.values()).map(|(x, y)| x * y).sum();
            assert!((dot(a.values(), b.values()) - plain).abs() < 1e-12);
        }
    }

    #[test]
    fn a_factor_solves_its_matrix() {
        for n in [1, 2, 5, 33, 90] {
            let mut a = gram(&random(n, n + 3, 5));
            (0..n).for_each(|i| a.row_mut(i)[i] += 0.1);
            let factor = Cholesky::of(a.clone()).unwrap();
            let want = random(1, n, 9);
            let mut b: Vec<f64> = (0..n).map(|i| dot(a.row(i), want.values())).collect();
            factor.solve_lower(&mut b);
            factor.solve_upper(&mut b);
            let off = b.iter().zip(want.values()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(off < 1e-7, "{n}: {off}");
            let inverse = factor.inverse();
            for i in 0..n {
                let mut unit: Vec<f64> = (0..n).map(|j| f64::from(u8::from(i == j))).collect();
                factor.solve_lower(&mut unit);
                factor.solve_upper(&mut unit);
                for j in 0..=i {
                    assert!((unit[j] - inverse.row(i)[j]).abs() < 1e-9 * inverse.row(i)[i].max(1.0), "{n}");
                }
            }
        }
        let mut bad = Matrix::zeros(2, 2);
        bad.row_mut(0).copy_from_slice(&[1.0, 2.0]);
        bad.row_mut(1).copy_from_slice(&[2.0, 1.0]);
        assert!(Cholesky::of(bad).is_none());
    }

    #[test]
    fn eigenvectors_are_orthonormal_and_restore_their_matrix() {
        for n in [1, 2, 3, 10, 57] {
            let a = gram(&random(n, n.div_ceil(2), 11));
            let (values, vectors) = eigen(&a);
            let scale = values[0].max(1.0);
            assert!(values.windows(2).all(|w| w[0] >= w[1]));
            for i in 0..n {
                for j in 0..n {
                    let unit = dot(vectors.row(i), vectors.row(j));
                    assert!((unit - f64::from(u8::from(i == j))).abs() < 1e-12, "{n}");
                    let sum: f64 = (0..n).map(|k| values[k] * vectors.row(k)[i] * vectors.row(k)[j]).sum();
                    assert!((sum - a.row(i)[j]).abs() < 1e-11 * scale, "{n}");
                }
            }
        }
    }

    #[test]
    fn a_matrix_of_low_rank_is_restored_by_few_columns() {
        let a = gram(&random(30, 6, 13));
        let factor = low_rank(&a, 20);
        assert_eq!(factor.columns, 6);
        let again = gram(&factor);
        let off = a.values().iter().zip(again.values()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{off}");
    }
}
