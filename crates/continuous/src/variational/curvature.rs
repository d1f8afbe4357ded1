//! An inverse Hessian from the steps of an ascent, as the normal that has it for a covariance.
//!
//! ```text
//! Sigma = diag(alpha) + B G B^T,  B = [diag(alpha) Z, S],
//! G = [ 0, -R^-1 ; -R^-T, R^-T (E + Z^T diag(alpha) Z) R^-1 ]
//! ```
//!
//! with the last steps `S`, the changes `Z` of the slope of minus the log density, `R` the upper triangle of `S^T Z` and
//! `E` its diagonal (Byrd, Nocedal & Schnabel 1994; Zhang et al. 2022, eq. 3.1 and algorithm 3). The mean is where a
//! Newton step goes: `x + Sigma g`.

use super::normal::Normal;
use crate::hamiltonian::leapfrog::dot;
use std::collections::VecDeque;

/// Steps that are remembered (Zhang et al. 2022, section 3.1).
const MEMORY: usize = 6;
/// A step along which the slope changes less than this share of its change's square says nothing about curvature.
const FLAT: f64 = 1e-12;

/// The curvature of a target, estimated from the steps of an ascent.
#[derive(Clone, Debug)]
pub struct Curvature {
    /// The diagonal to start from: variances.
    alpha: Vec<f64>,
    steps: VecDeque<Vec<f64>>,
    /// Changes of the slope of minus the log density.
    changes: VecDeque<Vec<f64>>,
}

impl Curvature {
    /// Before the first step.
    pub fn new(dim: usize) -> Curvature {
        Curvature { alpha: vec![1.0; dim], steps: VecDeque::new(), changes: VecDeque::new() }
    }

    /// Whether no step was learnt from.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Learns from a step and the change of the slope of minus the log density along it.
    pub fn learn(&mut self, step: Vec<f64>, change: Vec<f64>) {
        let b = dot(&step, &change);
        if !b.is_finite() || b <= FLAT * dot(&change, &change) {
            return;
        }
        // Gilbert & Lemarechal 1989, eq. 4.9.
        let a: f64 = self.alpha.iter().zip(&change).map(|(d, z)| d * z * z).sum();
        let c: f64 = self.alpha.iter().zip(&step).map(|(d, s)| s * s / d).sum();
        for ((d, s), z) in self.alpha.iter_mut().zip(&step).zip(&change) {
            let precision = a / (b * *d) + z * z / b - a * s * s / (b * c * *d * *d);
            if precision.is_finite() && precision > 0.0 {
                *d = precision.recip();
            }
        }
        if self.steps.len() == MEMORY {
            self.steps.pop_front();
            self.changes.pop_front();
        }
        self.steps.push_back(step);
        self.changes.push_back(change);
    }

    /// The normal of the inverse Hessian at `x`, where the log density has this gradient.
    pub fn normal(&self, x: &[f64], gradient: &[f64]) -> Option<Normal> {
        let (dim, m) = (x.len(), self.steps.len());
        let deviation: Vec<f64> = self.alpha.iter().map(|d| d.sqrt()).collect();
        let mut columns: Vec<Vec<f64>> = Vec::with_capacity(2 * m);
        columns.extend(self.changes.iter().map(|z| z.iter().zip(&deviation).map(|(z, d)| z * d).collect()));
        columns.extend(self.steps.iter().map(|s| s.iter().zip(&deviation).map(|(s, d)| s / d).collect()));
        let inverse = self.inverse_triangle();
        // The middle of the lower right block, `E + Z^T diag(alpha) Z`; the first columns are `diag(alpha)^(1/2) Z`.
        let mut middle = vec![0.0; m * m];
        for i in 0..m {
            for j in 0..m {
                middle[i * m + j] = dot(&columns[i], &columns[j]);
            }
            middle[i * m + i] += dot(&self.steps[i], &self.changes[i]);
        }
        let mut g = vec![0.0; 4 * m * m];
        for i in 0..m {
            for j in 0..m {
                let (right, lower) = (i * 2 * m + m + j, (m + j) * 2 * m + i);
                (g[right], g[lower]) = (-inverse[i * m + j], -inverse[i * m + j]);
                let mut sum = 0.0;
                for k in 0..=i {
                    (0..=j).for_each(|l| sum += inverse[k * m + i] * middle[k * m + l] * inverse[l * m + j]);
                }
                g[(m + i) * 2 * m + m + j] = sum;
            }
        }
        // Sigma g in units of the deviations: v + B G B^T v.
        let v: Vec<f64> = gradient.iter().zip(&deviation).map(|(g, d)| g * d).collect();
        let along: Vec<f64> = columns.iter().map(|column| dot(column, &v)).collect();
        let mut step = v;
        for (i, column) in columns.iter().enumerate() {
            let share = dot(&g[i * 2 * m..(i + 1) * 2 * m], &along);
            step.iter_mut().zip(column).for_each(|(y, b)| *y += share * b);
        }
        let mean = (0..dim).map(|i| x[i] + deviation[i] * step[i]).collect();
        Normal::low_rank(mean, deviation, &columns, &g)
    }

    /// `R^-1` by rows.
    fn inverse_triangle(&self) -> Vec<f64> {
        let m = self.steps.len();
        let r = |i: usize, j: usize| dot(&self.steps[i], &self.changes[j]);
        let mut inverse = vec![0.0; m * m];
        for j in 0..m {
            for i in (0..=j).rev() {
                let known: f64 = (i + 1..=j).map(|k| r(i, k) * inverse[k * m + j]).sum();
                inverse[i * m + j] = (f64::from(u8::from(i == j)) - known) / r(i, i);
            }
        }
        inverse
    }
}

#[cfg(test)]
mod tests {
    //! On a normal target, steps along conjugate directions give its covariance and its mean.
    use super::*;

    #[test]
    fn steps_in_every_direction_give_the_covariance_and_the_mean() {
        let precision = [2.0, 0.6, 0.0, 0.6, 1.0, -0.2, 0.0, -0.2, 0.5];
        let times = |x: &[f64]| -> Vec<f64> { precision.chunks(3).map(|row| dot(row, x)).collect() };
        let mut curvature = Curvature::new(3);
        let mut directions: Vec<Vec<f64>> = vec![];
        for i in 0..3 {
            // Conjugate to the directions before.
            let mut d = vec![0.0; 3];
            d[i] = 1.0;
            for e in &directions {
                let share = dot(&d, &times(e)) / dot(e, &times(e));
                d.iter_mut().zip(e).for_each(|(d, e)| *d -= share * e);
            }
            curvature.learn(d.clone(), times(&d));
            directions.push(d);
        }
        let x = [0.7, -0.3, 2.0];
        let gradient: Vec<f64> = times(&x).iter().map(|g| -g).collect();
        let normal = curvature.normal(&x, &gradient).expect("positive definite");
        assert!(normal.mean.iter().all(|m| m.abs() < 1e-10), "{:?}", normal.mean);
        let covariance = normal.covariance();
        for (i, row) in precision.chunks(3).enumerate() {
            for j in 0..3 {
                let product: f64 = (0..3).map(|k| row[k] * covariance[k * 3 + j]).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-10, "{i} {j} {product}");
            }
        }
    }

    #[test]
    fn a_step_without_curvature_is_not_learnt_from() {
        let mut curvature = Curvature::new(1);
        curvature.learn(vec![1.0], vec![-1.0]);
        curvature.learn(vec![1.0], vec![f64::NAN]);
        assert!(curvature.is_empty());
    }
}
