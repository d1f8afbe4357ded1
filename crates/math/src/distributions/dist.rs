//! Operations of the families: building (with checks), scoring, drawing.
//!
//! Expensive families are not inlined (`inline(never)`), since their use of registers would slow down every choice.

use super::check::{BadParameter, Reader};
use super::draw::Draw;
use super::param::Param;

use super::family::{Dist, Family};
use super::lists::{DiagonalGaussian, Multinomial};
use super::mixture::Mixture;
use super::vectors::MultivariateGaussian;
use super::weights::Weights;
use super::{bell, circle, counts, interval, lists, tails, truncated, vectors, waiting, whole};
use crate::scalar::{EachLog, LastLog, Logs, Scalar};
use crate::streams::RngCore;
use std::sync::Arc;

impl<S: Scalar> Dist<S> {
    /// The distribution of two real parameters, for the families that models build at every choice; `None`
    /// if [`Dist::new`] would refuse the parameters, and for other families.
    #[inline]
    pub fn of_reals(family: Family, a: S, b: S) -> Option<Dist<S>> {
        let positive = |x: S| x > S::from_f64(0.0) && x.is_finite();
        let dist = match family {
            Family::Gaussian if a.is_finite() && positive(b) => Dist::Gaussian { mean: a, sd: b },
            Family::LogNormal if a.is_finite() && positive(b) && bell::log_normal_has_scores(a, b) => {
                Dist::LogNormal { mean: a, sd: b }
            }
            // Ends that are not finite have no finite distance.
            Family::Uniform if a < b && (b - a).is_finite() => Dist::Uniform { lo: a, hi: b },
            Family::Gamma if positive(a) && positive(b) => Dist::Gamma { shape: a, scale: b },
            Family::Beta if positive(a) && positive(b) => Dist::Beta { a, b },
            _ => return None,
        };
        Some(dist)
    }

    /// The log density at `x` of a distribution with these parameters, without building it; for the families that are
    /// observed most often.
    #[inline(always)]
    pub fn log_density_of_reals(family: Family, a: S, b: S, x: S, logs: &mut LastLog<S>) -> Option<S> {
        let zero = S::from_f64(0.0);
        match family {
            Family::Gaussian if a.is_finite() && b > zero && b.is_finite() => {
                Some(bell::gaussian_log_density_with(a, b, logs.of(b), x))
            }
            _ => None,
        }
    }

    /// The distribution of this family with these parameters, or the error of a bad parameter.
    pub fn new(family: Family, params: &[Param<S>]) -> Result<Dist<S>, BadParameter> {
        let r = Reader::new(family, params)?;
        Ok(match family {
            Family::Bernoulli => Dist::Bernoulli { p: r.probability(0)? },
            Family::Categorical => Dist::Categorical(Arc::new(Weights::read(&r, 0)?)),
            Family::DiscreteUniform => {
                let (lo, hi) = (r.whole(0)?, r.whole(1)?);
                if lo > hi {
                    return r.refuse(1, "a whole number no less than `lo`");
                }
                Dist::DiscreteUniform { lo, hi }
            }
            Family::Poisson => {
                const EXPECTED: &str = "a number from 0 to 1e15";
                Dist::Poisson {
                    rate: r.real_where(0, EXPECTED, |x| {
                        x >= S::from_f64(0.0) && x <= S::from_f64(counts::LARGEST_RATE)
                    })?,
                }
            }
            Family::Binomial => {
                let n = r.whole(0)?;
                if n < 0 {
                    return r.refuse(0, "a whole number, not negative");
                }
                Dist::Binomial { n, p: r.probability(1)? }
            }
            Family::Geometric => {
                let p = r.real_where(0, "a number above 0 and up to 1", |x| {
                    x > S::from_f64(0.0) && x <= S::from_f64(1.0)
                })?;
                Dist::Geometric { p }
            }
            Family::Uniform => {
                let (lo, hi) = interval(&r, 0)?;
                Dist::Uniform { lo, hi }
            }
            Family::Gaussian => Dist::Gaussian { mean: r.finite(0)?, sd: r.positive(1)? },
            Family::LogNormal => {
                let (mean, sd) = (r.finite(0)?, r.positive(1)?);
                if !bell::log_normal_has_scores(mean, sd) {
                    return r
                        .refuse(0, "a number at most 1e150 times `sd` away from 0, and `sd` above 1e-147");
                }
                Dist::LogNormal { mean, sd }
            }
            Family::Gamma => Dist::Gamma { shape: r.positive(0)?, scale: r.positive(1)? },
            Family::InverseGamma => Dist::InverseGamma { shape: r.positive(0)?, scale: r.positive(1)? },
            Family::Beta => Dist::Beta { a: r.positive(0)?, b: r.positive(1)? },
            Family::Exponential => Dist::Exponential { rate: r.positive(0)? },
            Family::Laplace => Dist::Laplace { loc: r.finite(0)?, scale: r.positive(1)? },
            Family::Cauchy => Dist::Cauchy { loc: r.finite(0)?, scale: r.positive(1)? },
            Family::StudentT => {
                Dist::StudentT { df: r.positive(0)?, loc: r.finite(1)?, scale: r.positive(2)? }
            }
            Family::VonMises => {
                const EXPECTED: &str = "a finite number, not negative";
                let concentration = r.real_where(1, EXPECTED, |x| x >= S::from_f64(0.0) && x.is_finite())?;
                Dist::VonMises { mean: r.finite(0)?, concentration }
            }
            Family::TruncatedGaussian => {
                let (mean, sd) = (r.finite(0)?, r.positive(1)?);
                let (lo, hi) = interval(&r, 2)?;
                if !truncated::is_in_reach(mean, sd, lo, hi) {
                    return r.refuse(
                        1,
                        "a number that is no less than 1e-307 times the distance to `lo` and `hi`",
                    );
                }
                Dist::TruncatedGaussian { mean, sd, lo, hi }
            }
            Family::Dirichlet => {
                const EXPECTED: &str = "finite numbers above zero, at least one";
                let concentrations = r.vector_where(0, EXPECTED, |x| x > S::from_f64(0.0))?;
                // Beyond, the logarithm of the gamma function overflows, and so the density.
                if concentrations.iter().map(|a| a.value()).sum::<f64>() > vectors::MOST_CONCENTRATED {
                    return r.refuse(0, "numbers above zero, whose sum is at most 1e300");
                }
                Dist::Dirichlet(concentrations.into())
            }
            Family::MultivariateGaussian => {
                Dist::MultivariateGaussian(Arc::new(MultivariateGaussian::read(&r)?))
            }
            Family::DiagonalGaussian => Dist::DiagonalGaussian(Arc::new(DiagonalGaussian::read(&r)?)),
            Family::Multinomial => Dist::Multinomial(Arc::new(Multinomial::read(&r)?)),
            Family::MultivariateBernoulli => {
                let unity = S::from_f64(1.0);
                let expected = "numbers from 0 to 1, at least one";
                let ps = r.vector_where(0, expected, |p| p >= S::from_f64(0.0) && p <= unity)?;
                Dist::MultivariateBernoulli(ps.into())
            }
            Family::Mixture => Dist::Mixture(Arc::new(Mixture::read(&r)?)),
            Family::Delta => Dist::Delta(r.value(0)?),
        })
    }

    /// Bytes of the parameters outside the enum itself. Shared parameters count for each distribution.
    pub fn bytes(&self) -> usize {
        let real = size_of::<S>();
        let weights = |w: &Weights<S>| 64 + w.len() * (2 * real + size_of::<f64>());
        match self {
            Dist::Categorical(w) => weights(w),
            Dist::Dirichlet(a) | Dist::MultivariateBernoulli(a) => 16 + a.len() * real,
            Dist::DiagonalGaussian(g) => 64 + 2 * g.mean.len() * real,
            Dist::Multinomial(m) => 72 + 2 * m.len() * real,
            Dist::MultivariateGaussian(g) => {
                let n = g.mean.len();
                128 + n * (2 * size_of::<Vec<S>>() + real) + (n * n + n * (n + 1) / 2) * real
            }
            // Mixtures are flat: no component is a mixture.
            Dist::Mixture(m) => {
                let component = |dist: &Dist<S>| size_of::<Dist<S>>() + dist.bytes();
                32 + weights(&m.weights) + m.components.iter().map(component).sum::<usize>()
            }
            Dist::Delta(Draw::Vector(x)) => 16 + x.len() * real,
            Dist::Delta(Draw::Counts(x)) => 16 + size_of_val(&**x),
            Dist::Delta(Draw::Truths(x)) => 16 + x.len(),
            _ => 0,
        }
    }

    /// Log density of `x`, nats; minus infinity outside the support and for values of another kind.
    ///
    /// Kinds count as in Python: 1 is accepted for 1.0 or true, and 3.0 for 3.
    #[inline]
    pub fn log_density(&self, x: &Draw<S>) -> S {
        let never = S::from_f64(f64::NEG_INFINITY);
        let real = |density: &dyn Fn(S) -> S| match x.as_real() {
            Some(x) if x.is_finite() => density(x),
            _ => never,
        };
        let whole = |density: &dyn Fn(i64) -> S| x.as_int().map_or(never, density);
        match self {
            Dist::Bernoulli { p } => x.as_bool().map_or(never, |x| self::whole::bernoulli_log_density(*p, x)),
            Dist::Categorical(w) => whole(&|k| w.log_probability(k)),
            Dist::DiscreteUniform { lo, hi } => {
                whole(&|k| S::from_f64(self::whole::discrete_uniform_log_density(*lo, *hi, k)))
            }
            Dist::Poisson { rate } => whole(&|k| counts::poisson_log_density(*rate, k)),
            Dist::Binomial { n, p } => whole(&|k| counts::binomial_log_density(*n, *p, k)),
            Dist::Geometric { p } => whole(&|k| self::whole::geometric_log_density(*p, k)),
            Dist::Uniform { lo, hi } => real(&|x| interval::uniform_log_density(*lo, *hi, x)),
            Dist::Gaussian { mean, sd } => real(&|x| bell::gaussian_log_density(*mean, *sd, x)),
            Dist::LogNormal { mean, sd } => real(&|x| bell::log_normal_log_density(*mean, *sd, x)),
            Dist::Gamma { shape, scale } => real(&|x| waiting::gamma_log_density(*shape, *scale, x)),
            Dist::InverseGamma { shape, scale } => {
                real(&|x| waiting::inverse_gamma_log_density(*shape, *scale, x))
            }
            Dist::Beta { a, b } => real(&|x| interval::beta_log_density(*a, *b, x)),
            Dist::Exponential { rate } => real(&|x| waiting::exponential_log_density(*rate, x)),
            Dist::Laplace { loc, scale } => real(&|x| tails::laplace_log_density(*loc, *scale, x)),
            Dist::Cauchy { loc, scale } => real(&|x| tails::cauchy_log_density(*loc, *scale, x)),
            Dist::StudentT { df, loc, scale } => {
                real(&|x| tails::student_t_log_density(*df, *loc, *scale, x))
            }
            Dist::VonMises { mean, concentration } => {
                real(&|x| circle::log_density(*mean, *concentration, x))
            }
            Dist::TruncatedGaussian { mean, sd, lo, hi } => {
                real(&|x| truncated::log_density(*mean, *sd, *lo, *hi, x))
            }
            Dist::Dirichlet(a) => x.as_vector().map_or(never, |x| vectors::dirichlet_log_density(a, x)),
            Dist::MultivariateGaussian(g) => x.as_vector().map_or(never, |x| g.log_density(x)),
            Dist::DiagonalGaussian(g) => x.as_vector().map_or(never, |x| g.log_density(x)),
            Dist::Multinomial(m) => x.as_counts().map_or(never, |x| m.log_density(&x)),
            Dist::MultivariateBernoulli(ps) => {
                x.as_truths().map_or(never, |x| lists::bernoullis_log_density(ps, &x))
            }
            Dist::Mixture(m) => m.log_density(x),
            Dist::Delta(value) => {
                if are_equal(value, x) {
                    S::from_f64(0.0)
                } else {
                    never
                }
            }
        }
    }

    /// [`Dist::log_density`] at a real number, without a [`Draw`] for the frequent families.
    #[inline(always)]
    pub fn log_density_of_real(&self, x: S) -> S {
        match self {
            Dist::Gaussian { mean, sd } => bell::gaussian_log_density(*mean, *sd, x),
            Dist::Uniform { lo, hi } => interval::uniform_log_density(*lo, *hi, x),
            _ => self.log_density(&Draw::Real(x)),
        }
    }

    /// [`Dist::log_density`] at a whole number, without a [`Draw`] for the most frequent family.
    #[inline(always)]
    pub fn log_density_of_int(&self, k: i64) -> S {
        match self {
            Dist::Categorical(w) => w.log_probability(k),
            _ => self.log_density(&Draw::Int(k)),
        }
    }

    /// A draw and its log density: [`Dist::sample`], then [`Dist::log_density`].
    #[inline(always)]
    pub fn sample_and_score(&self, rng: &mut (impl RngCore + ?Sized)) -> (Draw<S>, S) {
        self.sample_and_score_with(rng, &mut EachLog)
    }

    /// [`Dist::sample_and_score`] with logarithms from elsewhere.
    #[inline(always)]
    pub fn sample_and_score_with(
        &self,
        rng: &mut (impl RngCore + ?Sized),
        logs: &mut impl Logs<S>,
    ) -> (Draw<S>, S) {
        match self {
            Dist::Categorical(w) => {
                let k = w.sample(rng) as i64;
                (Draw::Int(k), w.log_probability(k))
            }
            Dist::Bernoulli { p } => {
                let b = whole::bernoulli_sample(p.value(), rng);
                (Draw::Bool(b), whole::bernoulli_log_density_with(*p, b, logs))
            }
            Dist::Uniform { lo, hi } => {
                let x = S::from_f64(interval::uniform_sample(lo.value(), hi.value(), rng));
                (Draw::Real(x), interval::uniform_log_density_with(*lo, *hi, x, logs))
            }
            Dist::Gaussian { mean, sd } => {
                let x = S::from_f64(bell::gaussian_sample(mean.value(), sd.value(), rng));
                (Draw::Real(x), bell::gaussian_log_density_with(*mean, *sd, logs.ln(*sd), x))
            }
            _ => self.sample_then_score(rng),
        }
    }

    #[inline(never)]
    fn sample_then_score(&self, rng: &mut (impl RngCore + ?Sized)) -> (Draw<S>, S) {
        let draw = self.sample(rng);
        let log = self.log_density(&draw);
        (draw, log)
    }

    /// A draw, from bits of `rng` only.
    #[inline]
    pub fn sample(&self, rng: &mut (impl RngCore + ?Sized)) -> Draw<S> {
        let real = |x: f64| Draw::Real(S::from_f64(x));
        let vector = |x: Vec<f64>| Draw::Vector(x.into_iter().map(S::from_f64).collect());
        match self {
            Dist::Bernoulli { p } => Draw::Bool(whole::bernoulli_sample(p.value(), rng)),
            Dist::Categorical(w) => Draw::Int(w.sample(rng) as i64),
            Dist::DiscreteUniform { lo, hi } => Draw::Int(whole::discrete_uniform_sample(*lo, *hi, rng)),
            Dist::Poisson { rate } => Draw::Int(counts::poisson_sample(rate.value(), rng)),
            Dist::Binomial { n, p } => Draw::Int(counts::binomial_sample(*n, p.value(), rng)),
            Dist::Geometric { p } => Draw::Int(whole::geometric_sample(p.value(), rng)),
            Dist::Uniform { lo, hi } => real(interval::uniform_sample(lo.value(), hi.value(), rng)),
            Dist::Gaussian { mean, sd } => real(bell::gaussian_sample(mean.value(), sd.value(), rng)),
            Dist::LogNormal { mean, sd } => real(bell::log_normal_sample(mean.value(), sd.value(), rng)),
            Dist::Gamma { shape, scale } => real(waiting::gamma_sample(shape.value(), scale.value(), rng)),
            Dist::InverseGamma { shape, scale } => {
                real(waiting::inverse_gamma_sample(shape.value(), scale.value(), rng))
            }
            Dist::Beta { a, b } => real(interval::beta_sample(a.value(), b.value(), rng)),
            Dist::Exponential { rate } => real(waiting::exponential_sample(rate.value(), rng)),
            Dist::Laplace { loc, scale } => real(tails::laplace_sample(loc.value(), scale.value(), rng)),
            Dist::Cauchy { loc, scale } => real(tails::cauchy_sample(loc.value(), scale.value(), rng)),
            Dist::StudentT { df, loc, scale } => {
                real(tails::student_t_sample(df.value(), loc.value(), scale.value(), rng))
            }
            Dist::VonMises { mean, concentration } => {
                real(circle::sample(mean.value(), concentration.value(), rng))
            }
            Dist::TruncatedGaussian { mean, sd, lo, hi } => {
                real(truncated::sample(mean.value(), sd.value(), lo.value(), hi.value(), rng))
            }
            Dist::Dirichlet(a) => vector(vectors::dirichlet_sample(a, rng)),
            Dist::MultivariateGaussian(g) => vector(g.sample(rng)),
            Dist::DiagonalGaussian(g) => vector(g.sample(rng)),
            Dist::Multinomial(m) => Draw::Counts(m.sample(rng).into()),
            Dist::MultivariateBernoulli(ps) => Draw::Truths(lists::bernoullis_sample(ps, rng).into()),
            Dist::Mixture(m) => m.sample(rng),
            Dist::Delta(value) => value.clone(),
        }
    }
}

/// Parameters `k` and `k + 1` as the ends of an interval of finite length.
fn interval<S: Scalar>(r: &Reader<'_, S>, k: usize) -> Result<(S, S), BadParameter> {
    let (lo, hi) = (r.finite(k)?, r.finite(k + 1)?);
    if !(lo < hi && (hi - lo).is_finite()) {
        return r.refuse(k + 1, "a number above `lo`, at a finite distance");
    }
    Ok((lo, hi))
}

/// Equality as in Python: 1 equals 1.0 and true.
fn are_equal<S: Scalar>(a: &Draw<S>, b: &Draw<S>) -> bool {
    match (a, b) {
        (Draw::Vector(a), Draw::Vector(b)) => a == b,
        (Draw::Int(a), Draw::Int(b)) => a == b,
        _ => matches!((a.as_real(), b.as_real()), (Some(a), Some(b)) if a == b),
    }
}

#[cfg(test)]
mod tests {
    //! Refusals have the right messages, and the parameters of a distribution build it again.
    use super::*;

    fn refusal(family: Family, params: &[Param]) -> String {
        Dist::new(family, params).unwrap_err().to_string()
    }

    #[test]
    fn refusals_name_the_parameter_with_the_actual_and_expected_value() {
        let real = Param::Real;
        assert_eq!(
            refusal(Family::Gaussian, &[real(0.0), real(-1.5)]),
            "`sd` of gaussian is -1.5, expected a finite number above zero"
        );
        assert_eq!(
            refusal(Family::Uniform, &[real(2.0), Param::Int(1)]),
            "`hi` of uniform is 1, expected a number above `lo`, at a finite distance"
        );
        assert_eq!(refusal(Family::Beta, &[real(1.0)]), "`b` of beta is missing, expected a value");
        assert_eq!(
            refusal(Family::Bernoulli, &[real(0.5), real(1.0)]),
            "`p` of bernoulli is followed by 1 more, expected no more parameters"
        );
        assert_eq!(
            refusal(Family::Binomial, &[real(3.0), real(0.5)]),
            "`n` of binomial is 3.0, expected a whole number"
        );
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused_everywhere() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for &family in Family::ALL {
                for k in 0..family.parameters().len() {
                    let mut params = super::super::testing::example(family).params();
                    params[k] = match &params[k] {
                        Param::Vector(v) => Param::Vector(vec![bad; v.len()]),
                        Param::Matrix(m) => Param::Matrix(vec![vec![bad; m.len()]; m.len()]),
                        Param::Dists(_) => continue,
                        _ => Param::Real(bad),
                    };
                    let error = Dist::new(family, &params).unwrap_err();
                    assert_eq!((error.family, error.parameter), (family, family.parameters()[k]));
                }
            }
        }
    }

    #[test]
    fn parameters_build_the_distribution_again() {
        for &family in Family::ALL {
            let d = super::super::testing::example(family);
            assert_eq!(d.family(), family);
            assert_eq!(Dist::new(family, &d.params()), Ok(d));
        }
    }

    #[test]
    fn densities_from_reals_equal_densities_of_distributions() {
        let mut rng = super::super::testing::stream(98);
        let mut logs = LastLog::default();
        for round in 0..1000 {
            let (a, x) = (rng.normal(), rng.normal());
            // Equal deviations follow each other, as in many observations; the last ones are invalid.
            let sd = [1.0, 0.3, 0.3, rng.uniform(), 0.0, -1.0, f64::NAN, f64::INFINITY][round % 8];
            let built = Dist::of_reals(Family::Gaussian, a, sd).map(|d| d.log_density_of_real(x).to_bits());
            let quick = Dist::log_density_of_reals(Family::Gaussian, a, sd, x, &mut logs).map(f64::to_bits);
            assert_eq!(quick, built);
        }
        assert_eq!(Dist::log_density_of_reals(Family::Gaussian, f64::NAN, 1.0, 0.0, &mut logs), None);
    }

    #[test]
    fn draws_have_a_density_for_parameters_of_any_size() {
        let mut rng = super::super::testing::stream(99);
        let families = Family::ALL.iter().filter(|f| {
            !matches!(
                f,
                Family::Categorical
                    | Family::DiscreteUniform
                    | Family::Dirichlet
                    | Family::MultivariateGaussian
                    | Family::Mixture
                    | Family::Delta
            )
        });
        for &family in families {
            let mut built = 0;
            while built < 2000 {
                let params: Vec<Param> = family
                    .parameters()
                    .iter()
                    .map(|name| {
                        let size = 10.0_f64.powf(240.0 * (rng.uniform() - 0.5));
                        match *name {
                            "n" => Param::Int(10.0_f64.powf(18.0 * rng.uniform()) as i64),
                            "p" => Param::Real(size.min(1.0 / size)),
                            "mean" | "loc" | "lo" | "hi" => {
                                Param::Real(if rng.uniform() < 0.5 { size } else { -size })
                            }
                            _ => Param::Real(size),
                        }
                    })
                    .collect();
                if let Ok(d) = Dist::new(family, &params) {
                    built += 1;
                    let x = d.sample(&mut rng);
                    let log = d.log_density(&x);
                    // The largest float may be so far from the exact draw that even the logarithm of its density is out of range.
                    let last = |x: f64| x.abs() >= f64::MAX || x.abs() <= f64::MIN_POSITIVE;
                    let lost = log == f64::NEG_INFINITY && matches!(x, Draw::Real(x) if last(x));
                    assert!(log.is_finite() || lost, "{d:?} drew {x:?}: {log}");
                } else {
                    built += usize::from(rng.uniform() < 0.01);
                }
            }
        }
    }

    #[test]
    fn values_of_another_kind_have_no_density() {
        let vector = Draw::Vector([0.5, 0.5].into());
        for &family in Family::ALL {
            let d = super::super::testing::example(family);
            let wrong = if matches!(d.sample(&mut super::super::testing::stream(0)), Draw::Vector(_)) {
                Draw::Real(0.5)
            } else {
                vector.clone()
            };
            assert_eq!(d.log_density(&wrong), f64::NEG_INFINITY, "{family}");
            if !matches!(wrong, Draw::Real(_)) {
                assert_eq!(d.log_density(&Draw::Real(f64::NAN)), f64::NEG_INFINITY, "{family}");
            }
        }
    }

    #[test]
    fn numbers_count_as_in_python() {
        let coin = Dist::Bernoulli { p: 0.25 };
        assert_eq!(coin.log_density(&Draw::Int(1)), 0.25_f64.ln());
        assert_eq!(coin.log_density(&Draw::Int(2)), f64::NEG_INFINITY);
        let gaussian = Dist::Gaussian { mean: 0.0, sd: 1.0 };
        assert_eq!(gaussian.log_density(&Draw::Int(1)), gaussian.log_density(&Draw::Real(1.0)));
        assert_eq!(Dist::Poisson { rate: 2.0 }.log_density(&Draw::Real(1.5)), f64::NEG_INFINITY);
        assert_eq!(Dist::Delta(Draw::Real(1.0)).log_density(&Draw::Int(1)), 0.0);
    }
}
