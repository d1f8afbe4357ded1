//! How similar two points are: the Matern 5/2 kernel of a distance with a length scale for each parameter.
//!
//! `distance^2 = sum (du / l)^2` over real and whole numbers, plus `1 / l'^2` for each whole number, switch and choice
//! that differs.

use crate::linear::dot;
use crate::space::{Kind, Space};
use niwaki_math::portable;

/// Length scales.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales {
    /// For the place on each axis; unused for choices.
    pub along: Vec<f64>,
    /// For a difference of levels; unused for real numbers.
    pub apart: Vec<f64>,
}

/// The median of length scales along ranges beforehand; their logarithm has the standard deviation [`SPREAD`].
const ALONG: f64 = 1.0;
/// The median for whole numbers that differ.
const APART: f64 = 2.0;
/// The median for choices that differ.
const CHOICE: f64 = 1.5;
/// The standard deviation of the logarithm.
const SPREAD: f64 = 0.5;
/// The range of a length scale.
const RANGE: [f64; 2] = [0.2, 8.0];

impl Scales {
    /// The scales before anything is known.
    pub fn start(space: &Space) -> Scales {
        let apart = space.axes().iter().map(|axis| if axis.kind == Kind::Choice { CHOICE } else { APART });
        Scales { along: vec![ALONG; space.len()], apart: apart.collect() }
    }

    /// How many standard deviations the logarithm of each scale is off, in the order of the fields; 0 for unused ones.
    fn deviations(&self, space: &Space) -> Vec<f64> {
        let start = Scales::start(space);
        let z = |(l, l0): (&f64, f64)| portable::ln(l / l0) / SPREAD;
        let mut out: Vec<f64> =
            self.along.iter().zip(start.along).chain(self.apart.iter().zip(start.apart)).map(z).collect();
        for (axis, about) in space.axes().iter().enumerate() {
            if about.kind == Kind::Choice {
                out[axis] = 0.0;
            }
            if about.kind == Kind::Real {
                out[space.len() + axis] = 0.0;
            }
        }
        out
    }

    /// Log prior density, up to a constant.
    pub fn log_prior(&self, space: &Space) -> f64 {
        -0.5 * self.deviations(space).iter().map(|z| z * z).sum::<f64>()
    }

    /// The slope of the log prior density by the logarithm of each scale, in the order of the fields.
    pub fn log_prior_slope(&self, space: &Space) -> Vec<f64> {
        self.deviations(space).iter().map(|z| -z / SPREAD).collect()
    }

    /// Keeps every scale within its range.
    pub fn clamp(&mut self) {
        for scale in self.along.iter_mut().chain(&mut self.apart) {
            *scale = scale.clamp(RANGE[0], RANGE[1]);
        }
    }
}

/// Points, axis by axis, so that a loop runs over points.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The number of points.
    pub count: usize,
    columns: Vec<Vec<f64>>,
}

impl Columns {
    /// The columns of some rows.
    pub fn of<'a>(axes: usize, rows: impl Iterator<Item = &'a [f64]>) -> Columns {
        let mut columns = vec![vec![]; axes];
        let mut count = 0;
        for row in rows {
            columns.iter_mut().zip(row).for_each(|(column, x)| column.push(*x));
            count += 1;
        }
        Columns { count, columns }
    }

    /// Writes a point's row.
    pub fn row(&self, point: usize, out: &mut [f64]) {
        out.iter_mut().zip(&self.columns).for_each(|(x, column)| *x = column[point]);
    }

    /// Squared distances of a row from the first points, as many as `out` has.
    pub fn distances(&self, space: &Space, scales: &Scales, row: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (axis, about) in space.axes().iter().enumerate() {
            let (x, column) = (row[axis], &self.columns[axis][..out.len()]);
            let along = if about.kind == Kind::Choice { 0.0 } else { 1.0 / scales.along[axis] };
            let (along, apart) = (along * along, 1.0 / (scales.apart[axis] * scales.apart[axis]));
            if about.kind == Kind::Real {
                for (sum, y) in out.iter_mut().zip(column) {
                    *sum += (x - y) * (x - y) * along;
                }
            } else {
                for (sum, y) in out.iter_mut().zip(column) {
                    let differs = if x == *y { 0.0 } else { apart };
                    *sum += (x - y) * (x - y) * along + differs;
                }
            }
        }
    }

    /// Adds to the slope by the logarithm of each scale, `along` then `apart`, what the distances of a row from the first points
    /// contribute: a distance falls by twice its part when the scale grows, and the kernel rises by `fall` for each of that.
    pub fn add_slopes(&self, space: &Space, scales: &Scales, row: &[f64], fall: &[f64], slope: &mut [f64]) {
        let mut parts = vec![0.0; fall.len()];
        for (axis, about) in space.axes().iter().enumerate() {
            let (x, column) = (row[axis], &self.columns[axis][..fall.len()]);
            if about.kind != Kind::Choice {
                parts.iter_mut().zip(column).for_each(|(part, y)| *part = (x - y) * (x - y));
                slope[axis] += 2.0 * dot(fall, &parts) / (scales.along[axis] * scales.along[axis]);
            }
            if about.kind != Kind::Real {
                parts.iter_mut().zip(column).for_each(|(part, y)| *part = if x == *y { 0.0 } else { 1.0 });
                let apart = scales.apart[axis];
                slope[space.len() + axis] += 2.0 * dot(fall, &parts) / (apart * apart);
            }
        }
    }

    /// The kernel of a row with the first points, as many as `out` has.
    pub fn kernel(&self, space: &Space, scales: &Scales, row: &[f64], out: &mut [f64]) {
        self.distances(space, scales, row, out);
        for value in out {
            *value = matern(*value);
        }
    }
}

/// Matern 5/2 of a squared distance: 1 at 0.
#[inline(always)]
pub fn matern(square: f64) -> f64 {
    let root = (5.0 * square).sqrt();
    (1.0 + root + 5.0 / 3.0 * square) * portable::exp_falling(-root)
}

/// How fast Matern 5/2 falls with the squared distance.
#[inline(always)]
pub fn matern_fall(square: f64) -> f64 {
    let root = (5.0 * square).sqrt();
    5.0 / 6.0 * (1.0 + root) * portable::exp_falling(-root)
}

/// The squared distance of two rows.
pub fn distance(space: &Space, scales: &Scales, a: &[f64], b: &[f64]) -> f64 {
    let mut out = [0.0];
    Columns::of(space.len(), std::iter::once(b)).distances(space, scales, a, &mut out);
    out[0]
}
