//! Vectors: dirichlet, multivariate_gaussian.

use super::waiting::{gamma_draw, log_gamma_draw};
use crate::scalar::Scalar;
use crate::streams::{RngCore, open_unit};
use rand_distr::{Distribution, StandardNormal};

/// Largest distance of a simplex's sum from one: the rounding of a million additions.
const SUM_TOLERANCE: f64 = 1e-9;

/// The largest sum of a Dirichlet's concentrations.
pub(super) const MOST_CONCENTRATED: f64 = 1e300;

/// `sum (a_i - 1) ln x_i + ln gamma(sum a_i) - sum ln gamma(a_i)`, with respect to the first n - 1 entries.
#[inline(never)]
pub(super) fn dirichlet_log_density<S: Scalar>(concentrations: &[S], x: &[S]) -> S {
    let never = S::from_f64(f64::NEG_INFINITY);
    let sum: f64 = x.iter().map(|x| x.value()).sum();
    let (zero, unity) = (S::from_f64(0.0), S::from_f64(1.0));
    // At a corner the density is its limit if that is finite: an entry with concentration one adds no factor.
    let has_limit = |(x, a): (&S, &S)| *x > zero || *x == zero && *a == unity;
    let inside = x.len() == concentrations.len() && x.iter().zip(concentrations).all(has_limit);
    // The condition is written so that NaN is outside.
    if !(inside && (sum - 1.0).abs() <= SUM_TOLERANCE) {
        return never;
    }
    let (mut total, mut log) = (S::from_f64(0.0), S::from_f64(0.0));
    for (a, x) in concentrations.iter().zip(x) {
        total = total + *a;
        // For the frequent concentration of one both terms are zero.
        if (a.varies() || a.value() != 1.0) && x.value() != 0.0 {
            log = log + (*a - S::from_f64(1.0)) * x.ln() - a.ln_gamma();
        }
    }
    log + total.ln_gamma()
}

/// Gamma draws divided by their sum; by logarithms if a concentration is below one, since such draws underflow.
#[inline(never)]
pub(super) fn dirichlet_sample<S: Scalar>(
    concentrations: &[S],
    rng: &mut (impl RngCore + ?Sized),
) -> Vec<f64> {
    if concentrations.iter().all(|a| a.value() >= 1.0) {
        let mut draws: Vec<f64> = concentrations.iter().map(|a| gamma_draw(a.value(), rng)).collect();
        let total: f64 = draws.iter().sum();
        if total.is_finite() {
            draws.iter_mut().for_each(|x| *x = (*x / total).max(f64::MIN_POSITIVE));
            return draws;
        }
    }
    let logs: Vec<f64> = concentrations.iter().map(|a| log_gamma_draw(a.value(), rng)).collect();
    let largest = logs.iter().fold(f64::NEG_INFINITY, |m, l| m.max(*l));
    if largest == f64::NEG_INFINITY {
        return vertex(concentrations, rng);
    }
    let total: f64 = logs.iter().map(|l| (l - largest).exp()).sum();
    logs.iter().map(|l| ((l - largest).exp() / total).max(f64::MIN_POSITIVE)).collect()
}

/// A draw for concentrations below 1e-300, at which even the logarithms of gamma draws are out of range. A single entry has all
/// of the mass; its probability is proportional to its concentration.
#[cold]
fn vertex<S: Scalar>(concentrations: &[S], rng: &mut (impl RngCore + ?Sized)) -> Vec<f64> {
    let most = concentrations.iter().fold(0.0, |m: f64, a| m.max(a.value()));
    let shares: Vec<f64> = concentrations.iter().map(|a| a.value() / most).collect();
    let mut rest = open_unit(rng) * shares.iter().sum::<f64>();
    let reached = shares.iter().position(|share| {
        rest -= share;
        rest < 0.0
    });
    let at = reached.unwrap_or(shares.len() - 1);
    (0..shares.len()).map(|k| if k == at { 1.0 } else { f64::MIN_POSITIVE }).collect()
}

/// Parameters of a Gaussian vector, with the Cholesky factor that drawing and scoring both need.
#[derive(Clone, Debug, PartialEq)]
pub struct MultivariateGaussian<S: Scalar = f64> {
    /// Mean, shape (n,).
    pub mean: Vec<S>,
    /// Covariance, shape (n, n).
    pub covariance: Vec<Vec<S>>,
    /// Lower triangle with `factor factor' = covariance`; row i has i + 1 entries.
    pub(super) factor: Vec<Vec<S>>,
    /// `-(n / 2) ln(2 pi) - sum ln factor_ii`.
    pub(super) log_peak: S,
}

impl<S: Scalar> MultivariateGaussian<S> {
    /// The root of the mean variance: a typical distance between values.
    pub(super) fn scale(&self) -> S {
        let sum = (0..self.mean.len()).fold(S::from_f64(0.0), |sum, i| sum + self.covariance[i][i]);
        (sum / S::from_f64(self.mean.len() as f64)).sqrt()
    }

    /// `log_peak - |y|^2 / 2`, where `factor y = x - mean`.
    #[inline(never)]
    pub fn log_density(&self, x: &[S]) -> S {
        if x.len() != self.mean.len() || !x.iter().all(|x| x.is_finite()) {
            return S::from_f64(f64::NEG_INFINITY);
        }
        let mut y: Vec<S> = Vec::with_capacity(x.len());
        let mut square = S::from_f64(0.0);
        for (i, row) in self.factor.iter().enumerate() {
            let rest = row.iter().zip(&y).fold(x[i] - self.mean[i], |rest, (l, y)| rest - *l * *y);
            let entry = rest / row[i];
            square = square + entry * entry;
            y.push(entry);
        }
        self.log_peak - S::from_f64(0.5) * square
    }

    /// `mean + factor z` with independent standard Gaussians `z`.
    #[inline(never)]
    pub fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> Vec<f64> {
        let z: Vec<f64> = self.mean.iter().map(|_| StandardNormal.sample(rng)).collect();
        let entry = |(mean, row): (&S, &Vec<S>)| {
            let x = row.iter().zip(&z).fold(mean.value(), |sum, (l, z)| sum + l.value() * z);
            x.clamp(f64::MIN, f64::MAX)
        };
        self.mean.iter().zip(&self.factor).map(entry).collect()
    }
}

/// Lower triangular factor of a symmetric matrix; `None` if the matrix is not positive definite.
pub(super) fn cholesky<S: Scalar>(matrix: &[Vec<S>]) -> Option<Vec<Vec<S>>> {
    let mut factor: Vec<Vec<S>> = Vec::with_capacity(matrix.len());
    for (i, entries) in matrix.iter().enumerate() {
        let mut row: Vec<S> = Vec::with_capacity(i + 1);
        for j in 0..=i {
            let above: &[S] = if j < i { &factor[j] } else { &row };
            let rest = row.iter().zip(above).take(j).fold(entries[j], |rest, (a, b)| rest - *a * *b);
            if j < i {
                row.push(rest / factor[j][j]);
            } else if rest.value() > 1e-14 * entries[i].value() && rest.value() > 0.0 {
                row.push(rest.sqrt());
            } else {
                // The pivot is lost in rounding: the matrix is singular up to rounding.
                return None;
            }
        }
        factor.push(row);
    }
    Some(factor)
}

#[cfg(test)]
mod tests {
    //! In two dimensions the results are checked against one-dimensional families.
    use super::super::testing::*;
    use crate::{Dist, Draw, Family, Param};

    fn vector(x: &[f64]) -> Draw {
        Draw::Vector(x.into())
    }

    #[test]
    fn a_dirichlet_of_two_is_a_beta() {
        let d = Dist::new(Family::Dirichlet, &[Param::Vector(vec![2.0, 5.0])]).unwrap();
        let beta = dist(Family::Beta, &[2.0, 5.0]);
        for x in [0.01, 0.3, 0.9] {
            assert!((d.log_density(&vector(&[x, 1.0 - x])) - beta.log_density(&Draw::Real(x))).abs() < 1e-12);
        }
        assert_eq!(d.log_density(&vector(&[0.4, 0.4])), f64::NEG_INFINITY);
        assert_eq!(d.log_density(&vector(&[0.0, 1.0])), f64::NEG_INFINITY);
        // A corner has the limit of the density if that is a number.
        let of = |a: &[f64]| Dist::new(Family::Dirichlet, &[Param::Vector(a.to_vec())]).unwrap();
        assert!((of(&[1.0; 3]).log_density(&vector(&[0.0, 0.0, 1.0])) - 2.0_f64.ln()).abs() < 1e-12);
        let edge = of(&[1.0, 2.0, 3.0]).log_density(&vector(&[0.0, 0.25, 0.75]));
        let near = of(&[1.0, 2.0, 3.0]).log_density(&vector(&[1e-300, 0.25, 0.75]));
        assert_eq!((edge, of(&[1.0, 0.5]).log_density(&vector(&[1.0, 0.0]))), (near, f64::NEG_INFINITY));
        assert_eq!(d.log_density(&vector(&[0.2, 0.3, 0.5])), f64::NEG_INFINITY);
        assert_eq!(d.log_density(&vector(&[f64::NAN, 0.5])), f64::NEG_INFINITY);
        let firsts: Vec<f64> = (0..DRAWS as u64).map(|k| entry(&d.sample(&mut stream(k)), 0)).collect();
        follows(&beta, 0.0, 1.0, firsts);
    }

    #[test]
    fn a_flat_dirichlet_has_betas_for_margins() {
        let d = Dist::new(Family::Dirichlet, &[Param::Vector(vec![1.0; 5])]).unwrap();
        for k in 0..100 {
            // With concentrations of one the density is `gamma(5)` everywhere.
            assert!((d.log_density(&d.sample(&mut stream(k))) - 24.0_f64.ln()).abs() < 1e-12);
        }
        let lasts: Vec<f64> = (0..DRAWS as u64).map(|k| entry(&d.sample(&mut stream(k)), 4)).collect();
        follows(&dist(Family::Beta, &[1.0, 4.0]), 0.0, 1.0, lasts);
    }

    #[test]
    fn huge_concentrations_draw_points_with_a_density() {
        let of = |a: &[f64]| Dist::new(Family::Dirichlet, &[Param::Vector(a.to_vec())]);
        let d = of(&[4e299, 4e299, 1.0]).unwrap();
        for k in 0..100 {
            let x = d.sample(&mut stream(k));
            assert!((entry(&x, 0) - 0.5).abs() < 1e-6 && entry(&x, 2) > 0.0);
            assert!(d.log_density(&x).is_finite());
        }
        let corner = vector(&[1.0, f64::MIN_POSITIVE]);
        assert!(of(&[1e300, 1.0]).unwrap().log_density(&corner).is_finite());
        assert!(of(&[f64::MAX, 3.28]).is_err());
    }

    #[test]
    fn tiny_concentrations_draw_corners_with_a_density() {
        let d = Dist::new(Family::Dirichlet, &[Param::Vector(vec![1e-4; 3])]).unwrap();
        for k in 0..100 {
            assert!(d.log_density(&d.sample(&mut stream(k))).is_finite());
        }
    }

    #[test]
    fn subnormal_concentrations_draw_corners_by_their_shares() {
        let d = Dist::new(Family::Dirichlet, &[Param::Vector(vec![3e-320, 0.5e-320, 0.5e-320])]).unwrap();
        let mut first = 0;
        for k in 0..400 {
            let x = d.sample(&mut stream(k));
            assert!(d.log_density(&x) > f64::NEG_INFINITY, "{x:?}");
            first += usize::from(entry(&x, 0) == 1.0);
        }
        // 400 draws of probability 3/4 stay within 300 +- 60, except with probability 5e-12.
        assert!((240..=360).contains(&first), "{first}");
    }

    #[test]
    fn gaussian_vectors_agree_with_margin_and_conditional() {
        let (mean, cov) = (vec![1.0, -2.0], vec![vec![4.0, 1.2], vec![1.2, 1.0]]);
        let d = Dist::new(Family::MultivariateGaussian, &[Param::Vector(mean), Param::Matrix(cov)]).unwrap();
        // x1 given x0 has mean -2 + 0.3 (x0 - 1) and variance 1 - 0.36.
        let margin = dist(Family::Gaussian, &[1.0, 2.0]);
        for (x, y) in [(0.0, 0.0), (5.0, -3.0), (1.0, -2.0)] {
            let conditional = dist(Family::Gaussian, &[-2.0 + 0.3 * (x - 1.0), 0.8]);
            let product = margin.log_density(&Draw::Real(x)) + conditional.log_density(&Draw::Real(y));
            assert!((d.log_density(&vector(&[x, y])) - product).abs() < 1e-12);
        }
        let draws: Vec<Draw> = (0..DRAWS as u64).map(|k| d.sample(&mut stream(k))).collect();
        follows(&margin, -23.0, 25.0, draws.iter().map(|x| entry(x, 0)).collect());
        let residual = dist(Family::Gaussian, &[-2.3, 0.8]);
        follows(&residual, -12.0, 8.0, draws.iter().map(|x| entry(x, 1) - 0.3 * entry(x, 0)).collect());
    }

    #[test]
    fn invalid_covariances_are_refused() {
        let build = |cov: Vec<Vec<f64>>| {
            Dist::new(Family::MultivariateGaussian, &[Param::Vector(vec![0.0, 0.0]), Param::Matrix(cov)])
        };
        let expected = |cov| build(cov).unwrap_err().expected;
        assert!(expected(vec![vec![1.0]]).contains("rows and columns"));
        assert!(expected(vec![vec![1.0, f64::NAN], vec![0.0, 1.0]]).contains("finite"));
        assert_eq!(expected(vec![vec![1.0, 0.5], vec![0.2, 1.0]]), "a symmetric matrix");
        assert_eq!(expected(vec![vec![1.0, 2.0], vec![2.0, 1.0]]), "a positive definite matrix");
        assert_eq!(expected(vec![vec![1.0, 1.0], vec![1.0, 1.0]]), "a positive definite matrix");
    }
}
