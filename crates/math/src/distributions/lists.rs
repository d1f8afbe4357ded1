//! Lists of independent or shared-out values: multinomial, multivariate_bernoulli, diagonal_gaussian.

use super::{bell, counts, whole};
use crate::scalar::Scalar;
use crate::streams::RngCore;

/// How `n` trials are shared out over categories.
#[derive(Clone, Debug, PartialEq)]
pub struct Multinomial<S: Scalar = f64> {
    /// The number of trials.
    pub n: i64,
    /// Weights of the categories, as given.
    pub(super) weights: Vec<S>,
    /// Of each category: its share of what it and those after it have.
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

    /// One binomial after another: what the first category takes, what the second takes of the rest, ...
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
            // Without trials there is nothing to share out; the logarithm of a share of zero would spoil the sum.
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

    /// The binomials' draws, one after the other.
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

    /// All lists of counts, in order, where they are at most so many.
    pub(super) fn enumerate(&self, longest: u64) -> Option<Vec<Vec<i64>>> {
        // Their number is a binomial coefficient.
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
            // The next one: the last category that can have one more, those after it nothing.
            let mut at = last;
            let mut after = list[last];
            while at > 0 && after == 0 {
                at -= 1;
                after += std::mem::take(&mut list[at]);
                // `list[at]` itself is what can be given to the category before.
            }
            if at == 0 {
                return Some(lists);
            }
            list[at..].fill(0);
            list[at - 1] += 1;
        }
    }
}

/// Products of smaller shares and numbers of trials may be no normal numbers.
const TINY: f64 = 1e-290;

/// The log probability of `k` of `n` for a category beside others, one of which has a share that is lost beside the rest's.
#[cold]
fn by_logs<S: Scalar>(n: i64, weight: S, after: &[S], k: i64) -> S {
    if k > n {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let others = after.iter().rev().fold(S::from_f64(0.0), |sum, w| sum + *w);
    let total = (weight + others).ln();
    let power = |k: i64, w: S| {
        let is_none = k == 0;
        if is_none { S::from_f64(0.0) } else { S::from_f64(k as f64) * (w.ln() - total) }
    };
    let ways = |k: i64| libm::lgamma(k as f64 + 1.0);
    S::from_f64(ways(n) - ways(k) - ways(n - k)) + power(k, weight) + power(n - k, others)
}

/// The sum over truth values that are independent.
#[inline(never)]
pub(super) fn bernoullis_log_density<S: Scalar>(ps: &[S], truths: &[bool]) -> S {
    if truths.len() != ps.len() {
        return S::from_f64(f64::NEG_INFINITY);
    }
    let log = |(p, x): (&S, &bool)| whole::bernoulli_log_density(*p, *x);
    ps.iter().zip(truths).map(log).fold(S::from_f64(0.0), |sum, log| sum + log)
}

/// One truth value for each probability.
pub(super) fn bernoullis_sample<S: Scalar>(ps: &[S], rng: &mut (impl RngCore + ?Sized)) -> Vec<bool> {
    ps.iter().map(|p| whole::bernoulli_sample(p.value(), rng)).collect()
}

/// All lists of so many truth values, in order, where they are at most so many.
pub(super) fn truths(count: usize, longest: u64) -> Option<Vec<Vec<bool>>> {
    let number = 1_u64.checked_shl(u32::try_from(count).ok()?).filter(|number| *number <= longest)?;
    Some((0..number).map(|bits| (0..count).rev().map(|i| bits >> i & 1 != 0).collect()).collect())
}

/// Gaussians that are independent.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagonalGaussian<S: Scalar = f64> {
    /// Centre, shape (n,).
    pub mean: Vec<S>,
    /// Standard deviations, shape (n,).
    pub sd: Vec<S>,
}

impl<S: Scalar> DiagonalGaussian<S> {
    /// The root of the mean variance: a typical distance between its values.
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

    /// One draw of each.
    #[inline(never)]
    pub(super) fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> Vec<f64> {
        let draw = |(mean, sd): (&S, &S)| bell::gaussian_sample(mean.value(), sd.value(), rng);
        self.mean.iter().zip(&self.sd).map(draw).collect()
    }
}

#[cfg(test)]
mod tests {
    //! Lists have all the probability, and their parts are the families of one value.
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
            let (one, other) = (d.log_density(&counts(&[k, 9 - k])), two.log_density(&Draw::Int(k)));
            assert!((one - other).abs() < 1e-12);
        }
        // By hand: 6! / (1! 2! 3!) / 3^6.
        let expected = (60.0_f64 / 729.0).ln();
        assert!((multinomial(6, &[2.0; 3]).log_density(&counts(&[1, 2, 3])) - expected).abs() < 1e-12);
        let reals = Draw::Vector([1.0, 2.0, 3.0].into());
        assert!((multinomial(6, &[2.0; 3]).log_density(&reals) - expected).abs() < 1e-12);
    }

    #[test]
    fn lists_of_counts_have_all_the_probability() {
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
    fn a_weight_that_is_lost_beside_the_others_has_its_probability() {
        // 5 ln of the first, ln 5 and ln of the second: by logarithms of the weights.
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
        let one = d.log_density(&Draw::Truths([true, false, true].into()));
        assert!((one - (0.2_f64 * 0.3).ln()).abs() < 1e-12);
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
