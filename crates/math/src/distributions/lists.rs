//! Lists of independent or divided values: multinomial, multivariate_bernoulli, diagonal_gaussian.

use super::{bell, counts, whole};
use crate::scalar::Scalar;
use crate::streams::RngCore;

/// The division of `n` trials among categories.
#[derive(Clone, Debug, PartialEq)]
pub struct Multinomial<S: Scalar = f64> {
    /// The number of trials.
    pub n: i64,
    /// Weights of the categories, as the model passed them.
    pub(super) weights: Vec<S>,
    /// For each category, its weight relative to the sum of its weight and the weights after it.
    pub(super) shares: Vec<S>,
}

impl<S: Scalar> Multinomial<S> {
    /// The number of categories.
    pub fn len(&self) -> usize {
        self.weights.len()
    }

    /// Always false: there is at least one category.
    pub fn is_empty(&self) -> bool {
        self.weights.is_empty()
    }

    /// A sum of binomials: of the first category among all trials, of the second among the rest, and so on.
    #[inline(never)]
    pub(super) fn log_density(&self, counts: &[i64]) -> S {
        let never = S::from_f64(f64::NEG_INFINITY);
        if counts.len() != self.len() || counts.iter().any(|k| *k < 0) {
            return never;
        }
        let total = counts.iter().try_fold(0_i64, |sum, k| sum.checked_add(*k));
        if total != Some(self.n) {
            return never;
        }
        let (mut rest, mut log) = (self.n, S::from_f64(0.0));
        for (at, (share, k)) in self.shares.iter().zip(counts).enumerate() {
            // Without trials there is nothing to divide, and the logarithm of a zero share would spoil the sum.
            if rest > 0 {
                let after = &self.weights[at + 1..];
                let is_sure = share.value() >= 1.0 && after.iter().any(|w| w.value() > 0.0);
                let is_tiny = share.value() < TINY && self.weights[at].value() > 0.0;
                log = log
                    + if is_sure || is_tiny {
                        by_logs(rest, self.weights[at], after, *k)
                    } else {
                        counts::binomial_log_density(rest, *share, *k)
                    };
            }
            if log.value() == f64::NEG_INFINITY {
                return never;
            }
            rest -= k;
        }
        log
    }

    /// Draws of the binomials, in order.
    #[inline(never)]
    pub(super) fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> Vec<i64> {
        let mut rest = self.n;
        let mut take = |share: &S| {
            let k = if rest > 0 { counts::binomial_sample(rest, share.value(), rng) } else { 0 };
            rest -= k;
            k
        };
        self.shares.iter().map(&mut take).collect()
    }

    /// All lists of counts, in order; `None` if there are more than `longest`.
    pub(super) fn enumerate(&self, longest: u64) -> Option<Vec<Vec<i64>>> {
        // The number of lists is a binomial coefficient.
        let (n, mut number) = (u64::try_from(self.n).ok()?, 1_u64);
        for j in 1..self.len() as u64 {
            number = number.checked_mul(n.checked_add(j)?)? / j;
            if number > longest {
                return None;
            }
        }
        let mut lists = vec![];
        let mut list = vec![0; self.len()];
        let last = self.len() - 1;
        loop {
            list[last] = self.n - list[..last].iter().sum::<i64>();
            lists.push(list.clone());
            // The next list: one more in the last category that allows it, zero in those after it.
            let mut at = last;
            let mut after = list[last];
            while at > 0 && after == 0 {
                at -= 1;
                after += std::mem::take(&mut list[at]);
                // The category before can take all of `list[at]`.
            }
            if at == 0 {
                return Some(lists);
            }
            list[at..].fill(0);
            list[at - 1] += 1;
        }
    }
}

/// Bound of precision: a product of a smaller share and the number of trials may be subnormal.
const TINY: f64 = 1e-290;

/// The log probability of `k` of `n` in a category, by logarithms: a small share is lost beside the larger ones.
#[cold]
fn by_logs<S: Scalar>(n: i64, weight: S, after: &[S], k: i64) -> S {
    if k > n {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let rest = after.iter().rev().fold(S::from_f64(0.0), |sum, w| sum + *w);
    let total = (weight + rest).ln();
    let power = |k: i64, w: S| {
        let is_none = k == 0;
        if is_none { S::from_f64(0.0) } else { S::from_f64(k as f64) * (w.ln() - total) }
    };
    let ways = |k: i64| libm::lgamma(k as f64 + 1.0);
    S::from_f64(ways(n) - ways(k) - ways(n - k)) + power(k, weight) + power(n - k, rest)
}

/// The sum of the log probabilities of independent truth values.
#[inline(never)]
pub(super) fn bernoullis_log_density<S: Scalar>(ps: &[S], truths: &[bool]) -> S {
    if truths.len() != ps.len() {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let log = |(p, x): (&S, &bool)| whole::bernoulli_log_density(*p, *x);
    ps.iter().zip(truths).map(log).fold(S::from_f64(0.0), |sum, log| sum + log)
}

/// A draw of a truth value for each probability.
pub(super) fn bernoullis_sample<S: Scalar>(ps: &[S], rng: &mut (impl RngCore + ?Sized)) -> Vec<bool> {
    ps.iter().map(|p| whole::bernoulli_sample(p.value(), rng)).collect()
}

/// All lists of `count` truth values, in order; `None` if there are more than `longest`.
pub(super) fn truths(count: usize, longest: u64) -> Option<Vec<Vec<bool>>> {
    let number = 1_u64.checked_shl(u32::try_from(count).ok()?).filter(|number| *number <= longest)?;
    Some((0..number).map(|bits| (0..count).rev().map(|i| bits >> i & 1 != 0).collect()).collect())
}

/// A vector of independent Gaussians.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagonalGaussian<S: Scalar = f64> {
    /// Centre, shape (n,).
    pub mean: Vec<S>,
    /// Standard deviations, shape (n,).
    pub sd: Vec<S>,
}

impl<S: Scalar> DiagonalGaussian<S> {
    /// The root of the mean variance: a typical distance between values.
    pub(super) fn scale(&self) -> S {
        let sum = self.sd.iter().fold(S::from_f64(0.0), |sum, sd| sum + *sd * *sd);
        (sum / S::from_f64(self.sd.len() as f64)).sqrt()
    }

    /// The sum of the Gaussians' log densities.
    #[inline(never)]
    pub(super) fn log_density(&self, x: &[S]) -> S {
        if x.len() != self.mean.len() || !x.iter().all(|x| x.is_finite()) {
            return S::from_f64(f64::NEG_INFINITY);
        }
        let parts = self.mean.iter().zip(&self.sd).zip(x);
        let log = |((mean, sd), x): ((&S, &S), &S)| bell::gaussian_log_density(*mean, *sd, *x);
        parts.map(log).fold(S::from_f64(0.0), |sum, log| sum + log)
    }

    /// A draw of each Gaussian.
    #[inline(never)]
    pub(super) fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> Vec<f64> {
        let draw = |(mean, sd): (&S, &S)| bell::gaussian_sample(mean.value(), sd.value(), rng);
        self.mean.iter().zip(&self.sd).map(draw).collect()
    }
}

#[cfg(test)]
mod tests {
    //! Probabilities of all lists sum to one, and the entries of lists agree with families of a single value.
    use super::super::testing::*;
    use crate::{Dist, Draw, Family, Param};

    fn multinomial(n: i64, weights: &[f64]) -> Dist {
        Dist::new(Family::Multinomial, &[Param::Int(n), Param::Vector(weights.to_vec())]).unwrap()
    }

    fn counts(k: &[i64]) -> Draw {
        Draw::Counts(k.into())
    }

    #[test]
    fn a_multinomial_of_two_is_a_binomial() {
        let (d, two) = (multinomial(9, &[1.0, 3.0]), Dist::Binomial { n: 9, p: 0.25 });
        for k in 0..=9 {
            let (actual, expected) = (d.log_density(&counts(&[k, 9 - k])), two.log_density(&Draw::Int(k)));
            assert!((actual - expected).abs() < 1e-12);
        }
        // By hand: 6! / (1! 2! 3!) / 3^6.
        let expected = (60.0_f64 / 729.0).ln();
        assert!((multinomial(6, &[2.0; 3]).log_density(&counts(&[1, 2, 3])) - expected).abs() < 1e-12);
        let reals = Draw::Vector([1.0, 2.0, 3.0].into());
        assert!((multinomial(6, &[2.0; 3]).log_density(&reals) - expected).abs() < 1e-12);
    }

    #[test]
    fn probabilities_of_all_lists_of_counts_sum_to_one() {
        for (d, number) in [
            (multinomial(0, &[1.0, 2.0]), 1),
            (multinomial(4, &[5.0]), 1),
            (multinomial(4, &[1.0, 2.0, 0.5]), 15),
            (multinomial(3, &[1.0, 0.0, 2.0, 1.0]), 10),
            (multinomial(3, &[1.0, 2.0, 0.0]), 4),
        ] {
            let values = d.enumerate().unwrap();
            assert_eq!(values.len(), number, "{d:?}");
            let total: f64 = values.iter().map(|x| d.log_density(x).exp()).sum();
            assert!((total - 1.0).abs() < 1e-12, "{d:?}: {total}");
            assert!(values.windows(2).all(|pair| pair[0] != pair[1]));
        }
        assert_eq!(multinomial(1000, &[1.0; 20]).enumerate(), None);
    }

    #[test]
    fn tiny_weights_keep_their_probability() {
        // 5 ln of the first share, ln 5 and ln of the second, by logarithms of the weights.
        let expected = 5.0_f64.ln() + 1e-320_f64.ln();
        for weights in [[1.0, 1e-320], [1e-320, 1.0]] {
            let k = if weights[0] == 1.0 { [4, 1] } else { [1, 4] };
            let log = multinomial(5, &weights).log_density(&counts(&k));
            assert!((log - expected).abs() < 1e-9, "{weights:?}: {log}");
        }
        let log = multinomial(2, &[1e300, 1e-20, 1e-10]).log_density(&counts(&[0, 1, 1]));
        assert!(
            (log - (2.0_f64.ln() + (1e-20_f64).ln() + (1e-10_f64).ln() - 2.0 * (1e300_f64).ln())).abs()
                < 1e-9
        );
    }

    #[test]
    fn impossible_counts_have_no_probability() {
        let d = multinomial(4, &[1.0, 0.0, 1.0]);
        for k in [&[1, 1, 2][..], &[2, 0, 1], &[5, 0, -1], &[4, 0], &[i64::MAX, 0, i64::MAX]] {
            assert_eq!(d.log_density(&counts(k)), f64::NEG_INFINITY, "{k:?}");
        }
        assert_eq!(d.log_density(&Draw::Vector([1.5, 0.0, 2.5].into())), f64::NEG_INFINITY);
    }

    #[test]
    fn truths_are_independent() {
        let ps = [0.2, 0.7, 1.0];
        let d = Dist::new(Family::MultivariateBernoulli, &[Param::Vector(ps.to_vec())]).unwrap();
        let values = d.enumerate().unwrap();
        assert_eq!(values.len(), 4);
        let total: f64 = values.iter().map(|x| d.log_density(x).exp()).sum();
        assert!((total - 1.0).abs() < 1e-12);
        let log = d.log_density(&Draw::Truths([true, false, true].into()));
        assert!((log - (0.2_f64 * 0.3).ln()).abs() < 1e-12);
        assert_eq!(d.log_density(&Draw::Vector([1.0, 0.5, 1.0].into())), f64::NEG_INFINITY);
        assert_eq!(d.log_density(&Draw::Truths([true].into())), f64::NEG_INFINITY);
    }

    #[test]
    fn a_diagonal_gaussian_is_a_gaussian_with_a_diagonal_covariance() {
        let (mean, sd) = (vec![1.0, -2.0], vec![0.5, 3.0]);
        let d =
            Dist::new(Family::DiagonalGaussian, &[Param::Vector(mean.clone()), Param::Vector(sd)]).unwrap();
        let covariance = Param::Matrix(vec![vec![0.25, 0.0], vec![0.0, 9.0]]);
        let full = Dist::new(Family::MultivariateGaussian, &[Param::Vector(mean), covariance]).unwrap();
        for x in [[0.0, 0.0], [1.0, -2.0], [9.0, 4.0]] {
            let x = Draw::Vector(x.into());
            assert!((d.log_density(&x) - full.log_density(&x)).abs() < 1e-12);
        }
        let draws: Vec<Draw> = (0..DRAWS as u64).map(|k| d.sample(&mut stream(k))).collect();
        follows(&dist(Family::Gaussian, &[1.0, 0.5]), -5.0, 7.0, draws.iter().map(|x| entry(x, 0)).collect());
        follows(
            &dist(Family::Gaussian, &[-2.0, 3.0]),
            -35.0,
            31.0,
            draws.iter().map(|x| entry(x, 1)).collect(),
        );
    }
}
