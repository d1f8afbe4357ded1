//! The parameters of a normal that an ascent of the bound moves, and the gradient of the bound.
//!
//! ```text
//! x = m0 + S0 (mu + L z)
//! ```
//!
//! `m0, S0` are those of the start, so that steps of one size suit every coordinate. `L` is the diagonal `exp(omega)`, or
//! a lower triangle whose diagonal is that. The gradient of `log p(x) - log q(x)` goes through `x` alone; the
//! parameters within `log q` stand still ("sticking the landing": Roeder, Wu & Duvenaud 2017, eq. 6). What is left out
//! has mean zero. So the gradient has no noise at all where `q` is the target.
//!
//! ```text
//! h = S0^T grad log p(x) + L^-T z,   d mu = h,   d L = h z^T (lower part),   d omega_i = h_i L_ii z_i
//! ```
//!
//! The `z` of an angle stands in `h` for the slope of its density on the circle ([`super::turns`]), and `S0` has its rows in
//! that order. What is left out has mean zero there too: given the coordinates before an angle and the angle itself, the
//! shares of its turns sum to one.

use super::LANES;
use super::batch::{Row, add};
use super::normal::{Normal, Scale};
use super::turns::Turns;

/// A family of normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// `L` is a diagonal.
    MeanField,
    /// `L` is a lower triangle.
    FullRank,
}

/// A normal in its parameters.
#[derive(Clone, Debug)]
pub struct Member {
    family: Family,
    base: Normal,
    /// The coordinates that are angles.
    angles: Vec<usize>,
    /// `mu`, then `L` by rows up to its diagonal, which is there as `omega`; of a diagonal, `omega` alone.
    pub parameters: Vec<f64>,
}

/// The memory of a gradient.
#[derive(Clone, Debug)]
pub struct Memory {
    y: Vec<Row>,
    h: Vec<Row>,
}

impl Member {
    /// The start itself; of a family of diagonals, the diagonal that is nearest to it. `angles` are the coordinates that
    /// are angles.
    pub fn new(family: Family, start: &Normal, angles: &[usize]) -> Member {
        let dim = start.dim();
        let (base, size) = match family {
            Family::MeanField => (start.nearest_diagonal(), dim),
            Family::FullRank => {
                let diagonal = || start.nearest_diagonal().in_order(angles);
                let ordered = start.in_order(angles).or_else(diagonal);
                (ordered.unwrap_or_else(|| start.clone()), dim * (dim + 1) / 2)
            }
        };
        Member { family, base, angles: angles.to_vec(), parameters: vec![0.0; dim + size] }
    }

    /// The angles with their deviations: products of the diagonals of `S0` and `L`.
    fn turns(&self) -> Turns {
        let shape = &self.parameters[self.dim()..];
        let mut turns = self.base.turns(&self.angles);
        turns.0.iter_mut().for_each(|(at, deviation)| {
            *deviation *= match self.family {
                Family::MeanField => shape[*at].exp(),
                Family::FullRank => shape[*at * (*at + 3) / 2].exp(),
            };
        });
        turns
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.base.dim()
    }

    /// Memory for gradients.
    pub fn memory(&self) -> Memory {
        let none = vec![[0.0; LANES]; self.dim()];
        Memory { y: none.clone(), h: none }
    }

    /// `log |S0 L|`, nats.
    fn log_det(&self) -> f64 {
        let (dim, shape) = (self.dim(), &self.parameters[self.dim()..]);
        self.base.log_det
            + match self.family {
                Family::MeanField => shape.iter().sum::<f64>(),
                Family::FullRank => (0..dim).map(|i| shape[i * (i + 3) / 2]).sum(),
            }
    }

    /// The positions of draws, and their log densities, nats.
    pub fn place(&self, z: &[Row], x: &mut [Row], memory: &mut Memory) -> Row {
        let (mu, shape) = self.parameters.split_at(self.dim());
        let y = &mut memory.y;
        match self.family {
            Family::MeanField => {
                for (((y, z), mu), omega) in y.iter_mut().zip(z).zip(mu).zip(shape) {
                    let deviation = omega.exp();
                    *y = z.map(|z| mu + deviation * z);
                }
            }
            Family::FullRank => {
                for (i, (y, mu)) in y.iter_mut().zip(mu).enumerate() {
                    let row = &shape[i * (i + 1) / 2..][..=i];
                    let mut sum = [*mu; LANES];
                    row[..i].iter().zip(z).for_each(|(l, z)| add(&mut sum, *l, z));
                    add(&mut sum, row[i].exp(), &z[i]);
                    *y = sum;
                }
            }
        }
        self.base.place(y, x);
        let standard =
            Normal { mean: vec![0.0; self.dim()], log_det: self.log_det(), scale: Scale::Diagonal(vec![]) };
        let mut log_q = standard.log_density(z);
        self.turns().add(z, &mut log_q);
        log_q
    }

    /// Adds to `slope` the gradient of the bound, summed over the first `count` draws. `g` has the gradients of the log
    /// density, `is_sound` says which draws count.
    pub fn add_gradient(
        &self,
        z: &[Row],
        g: &[Row],
        is_sound: &[bool; LANES],
        slope: &mut [f64],
        memory: &mut Memory,
    ) {
        let (dim, shape) = (self.dim(), &self.parameters[self.dim()..]);
        let (h, w) = (&mut memory.h, &mut memory.y);
        self.base.pull(g, h);
        w.copy_from_slice(z);
        self.turns().slopes(w);
        match self.family {
            Family::MeanField => {
                for ((h, z), omega) in h.iter_mut().zip(&*w).zip(shape) {
                    add(h, (-omega).exp(), z);
                }
            }
            Family::FullRank => {
                // L^T w = z, from the last row up; h += w.
                for i in (0..dim).rev() {
                    let row = &shape[i * (i + 1) / 2..][..=i];
                    let scale = (-row[i]).exp();
                    let (before, rest) = w.split_at_mut(i);
                    rest[0].iter_mut().for_each(|w| *w *= scale);
                    before.iter_mut().zip(row).for_each(|(w, l)| add(w, -l, &rest[0]));
                    add(&mut h[i], 1.0, &rest[0]);
                }
            }
        }
        let sound: Row = is_sound.map(|sound| f64::from(u8::from(sound)));
        h.iter_mut().for_each(|h| h.iter_mut().zip(&sound).for_each(|(h, s)| *h *= s));
        let (d_mu, d_shape) = slope.split_at_mut(dim);
        d_mu.iter_mut().zip(&*h).for_each(|(d, h)| *d += h.iter().sum::<f64>());
        match self.family {
            Family::MeanField => {
                for (((d, h), z), omega) in d_shape.iter_mut().zip(&*h).zip(z).zip(shape) {
                    *d += along(h, z) * omega.exp();
                }
            }
            Family::FullRank => {
                for (i, h) in h.iter().enumerate() {
                    let first = i * (i + 1) / 2;
                    let row = &mut d_shape[first..=first + i];
                    row[..i].iter_mut().zip(z).for_each(|(d, z)| *d += along(h, z));
                    row[i] += along(h, &z[i]) * shape[first + i].exp();
                }
            }
        }
    }

    /// The normal of these parameters.
    pub fn normal(&self) -> Normal {
        let dim = self.dim();
        let (mu, shape) = self.parameters.split_at(dim);
        let mut mean = vec![[0.0; LANES]; dim];
        self.base.place(&mu.iter().map(|mu| [*mu; LANES]).collect::<Vec<_>>(), &mut mean);
        let mean: Vec<f64> = mean.iter().map(|row| row[0]).collect();
        match (self.family, &self.base.scale) {
            (Family::MeanField, Scale::Diagonal(base)) => {
                Normal::diagonal(mean, base.iter().zip(shape).map(|(d, omega)| d * omega.exp()).collect())
            }
            _ => {
                let base = self.base.matrix();
                let mut product = vec![0.0; dim * dim];
                for k in 0..dim {
                    let row = &shape[k * (k + 1) / 2..][..=k];
                    for i in 0..dim {
                        let s = base[i * dim + k];
                        let (product_row, triangle_row) = (&mut product[i * dim..], &row[..k]);
                        product_row.iter_mut().zip(triangle_row).for_each(|(x, l)| *x += s * l);
                        product_row[k] += s * row[k].exp();
                    }
                }
                Normal { mean, scale: Scale::Dense(product), log_det: self.log_det() }
            }
        }
    }
}

/// The sum over draws of the products of two numbers of each.
#[inline(always)]
fn along(a: &Row, b: &Row) -> f64 {
    let mut parts = [0.0; 4];
    for l in 0..LANES {
        parts[l % 4] += a[l] * b[l];
    }
    parts[0] + parts[1] + parts[2] + parts[3]
}

#[cfg(test)]
mod tests {
    //! The gradient is that of the bound by finite differences, less the score's part, which has mean zero; and it is
    //! zero for each draw where the normal is the target.
    use super::*;
    use niwaki_math::Stream;

    fn base() -> Normal {
        let columns = vec![vec![1.0, 0.5, -0.3]];
        Normal::low_rank(vec![0.3, -1.0, 2.0], vec![0.5, 1.0, 2.0], &columns, &[0.8])
            .expect("positive definite")
    }

    fn member(family: Family) -> Member {
        let mut member = Member::new(family, &base(), &[]);
        let mut stream = Stream::new(3, 0, 0, 0);
        member.parameters.iter_mut().for_each(|p| *p = 0.3 * stream.normal());
        member
    }

    fn draws() -> Vec<Row> {
        let (mut z, mut stream) = (vec![[0.0; LANES]; 3], Stream::new(5, 0, 0, 0));
        z.iter_mut().flatten().for_each(|z| *z = stream.normal());
        z
    }

    /// A log density that is no normal, and its gradient.
    fn target(x: &[f64]) -> (f64, Vec<f64>) {
        let value = -0.25 * x[0].powi(4) - 0.5 * (x[1] - x[0]).powi(2) - x[2].cosh().ln();
        (value, vec![-x[0].powi(3) + x[1] - x[0], x[0] - x[1], -x[2].tanh()])
    }

    /// `sum_l log p(x_l) - log q(x_l)`, with the density of `of` at the positions of `by`.
    fn ratio(by: &Member, of: &Member) -> f64 {
        let (z, mut x) = (draws(), vec![[0.0; LANES]; 3]);
        by.place(&z, &mut x, &mut by.memory());
        let q = of.normal();
        let matrix = match &q.scale {
            Scale::Diagonal(d) => (0..9).map(|k| if k % 4 == 0 { d[k / 4] } else { 0.0 }).collect(),
            _ => q.matrix(),
        };
        (0..LANES)
            .map(|l| {
                let at: Vec<f64> = x.iter().map(|row| row[l]).collect();
                let mut rest: Vec<f64> = at.iter().zip(&q.mean).map(|(x, m)| x - m).collect();
                let mut rows = matrix.clone();
                for k in 0..3 {
                    for i in (0..3).filter(|i| *i != k) {
                        let f = rows[i * 3 + k] / rows[k * 4];
                        (0..3).for_each(|j| rows[i * 3 + j] -= f * rows[k * 3 + j]);
                        rest[i] -= f * rest[k];
                    }
                }
                let square: f64 = (0..3).map(|i| (rest[i] / rows[i * 4]).powi(2)).sum();
                target(&at).0 + 0.5 * square + q.log_det
            })
            .sum()
    }

    #[test]
    fn the_gradient_is_the_one_through_the_position() {
        for family in [Family::MeanField, Family::FullRank] {
            let member = member(family);
            let (z, mut x, mut memory) = (draws(), vec![[0.0; LANES]; 3], member.memory());
            member.place(&z, &mut x, &mut memory);
            let mut g = vec![[0.0; LANES]; 3];
            for l in 0..LANES {
                let slope = target(&x.iter().map(|row| row[l]).collect::<Vec<_>>()).1;
                (0..3).for_each(|k| g[k][l] = slope[k]);
            }
            let mut slope = vec![0.0; member.parameters.len()];
            member.add_gradient(&z, &g, &[true; LANES], &mut slope, &mut memory);
            for (k, derivative) in slope.iter().enumerate() {
                let at = |h: f64| {
                    let mut moved = member.clone();
                    moved.parameters[k] += h;
                    ratio(&moved, &member)
                };
                let expected = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!(
                    (derivative - expected).abs() < 1e-6 * (1.0 + expected.abs()),
                    "{k} {derivative} {expected}"
                );
            }
        }
    }

    #[test]
    fn draws_of_a_member_are_those_of_its_normal() {
        for family in [Family::MeanField, Family::FullRank] {
            let (member, z) = (member(family), draws());
            let (mut x, mut y) = (z.clone(), z.clone());
            let member_log = member.place(&z, &mut x, &mut member.memory());
            let normal = member.normal();
            normal.place(&z, &mut y);
            assert!(x.iter().flatten().zip(y.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-12));
            assert!(member_log.iter().zip(normal.log_density(&z)).all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }

    #[test]
    fn where_the_normal_is_the_target_every_draw_has_no_slope() {
        let (member, z) = (Member::new(Family::FullRank, &base(), &[]), draws());
        let (mut x, mut memory) = (z.clone(), member.memory());
        member.place(&z, &mut x, &mut memory);
        // grad log p = -S^-T z; pulled back by S^T that is -z.
        let dim = 3;
        let matrix = base().matrix();
        let mut g = vec![[0.0; LANES]; dim];
        for l in 0..LANES {
            let (mut rows, mut w) = (matrix.clone(), z.iter().map(|row| -row[l]).collect::<Vec<_>>());
            // Solve S^T w = -z.
            for i in 0..dim {
                for j in 0..i {
                    rows.swap(i * dim + j, j * dim + i);
                }
            }
            for k in 0..dim {
                for i in (0..dim).filter(|i| *i != k) {
                    let f = rows[i * dim + k] / rows[k * (dim + 1)];
                    (0..dim).for_each(|j| rows[i * dim + j] -= f * rows[k * dim + j]);
                    w[i] -= f * w[k];
                }
            }
            (0..dim).for_each(|i| g[i][l] = w[i] / rows[i * (dim + 1)]);
        }
        let mut slope = vec![0.0; member.parameters.len()];
        member.add_gradient(&z, &g, &[true; LANES], &mut slope, &mut memory);
        assert!(slope.iter().all(|s| s.abs() < 1e-10), "{slope:?}");
    }
}
