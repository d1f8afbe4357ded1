//! Helpers for tests: the density and the sampler of a family must agree.
//!
//! Fixed seeds. Each call of [`continuous_agrees`], [`follows`] or [`discrete_agrees`] raises a false alarm with
//! probability at most 1e-6; there are about a hundred of them.

use super::draw::Draw;
use super::family::Dist;
use super::family::Family;
use super::param::Param;
use crate::streams::Stream;
use std::ops::RangeInclusive;

/// Draws in each test.
pub(super) const DRAWS: usize = 20_000;

/// A distribution of a family whose parameters are numbers.
pub(super) fn dist(family: Family, numbers: &[f64]) -> Dist {
    let params: Vec<Param> = numbers.iter().map(|x| Param::Real(*x)).collect();
    Dist::new(family, &params).expect("good parameters")
}

/// The bits of the `k`-th draw.
pub(super) fn stream(k: u64) -> Stream {
    Stream::new(2026, 1, u128::from(k), 0)
}

/// Entry `k` of a drawn vector.
pub(super) fn entry(x: &Draw, k: usize) -> f64 {
    match x {
        Draw::Vector(v) => v[k],
        _ => panic!("not a vector: {x:?}"),
    }
}

/// An example of each family.
pub(super) fn example(family: Family) -> Dist {
    let real = |x: &[f64]| x.iter().map(|x| Param::Real(*x)).collect::<Vec<_>>();
    let params = match family {
        Family::Categorical => vec![Param::Vector(vec![1.0, 2.0])],
        Family::DiscreteUniform => vec![Param::Int(2), Param::Int(5)],
        Family::Binomial => vec![Param::Int(4), Param::Real(0.3)],
        Family::Dirichlet => vec![Param::Vector(vec![1.0, 2.0, 3.0])],
        Family::Multinomial => vec![Param::Int(3), Param::Vector(vec![1.0, 2.0])],
        Family::MultivariateBernoulli => vec![Param::Vector(vec![0.2, 0.7])],
        Family::DiagonalGaussian => vec![Param::Vector(vec![0.0, 1.0]), Param::Vector(vec![2.0, 0.5])],
        Family::MultivariateGaussian => {
            vec![Param::Vector(vec![0.0, 1.0]), Param::Matrix(vec![vec![2.0, 0.3], vec![0.3, 1.0]])]
        }
        Family::Mixture => {
            let parts = vec![dist(Family::Gaussian, &[0.0, 1.0]), dist(Family::Uniform, &[0.0, 1.0])];
            vec![Param::Vector(vec![1.0, 1.0]), Param::Dists(parts)]
        }
        Family::TruncatedGaussian => real(&[0.5, 0.4, 0.3, 0.9]),
        Family::StudentT => real(&[3.0, 0.1, 0.7]),
        Family::Uniform => real(&[0.25, 0.75]),
        _ => real(&[0.5, 0.7])[..family.parameters().len()].to_vec(),
    };
    Dist::new(family, &params).expect("good parameters")
}

/// Asserts that the density integrates to one over `[lo, hi]`, and that draws follow its distribution function.
pub(super) fn continuous_agrees(d: &Dist, lo: f64, hi: f64) {
    let draws = (0..DRAWS as u64).map(|k| match d.sample(&mut stream(k)) {
        Draw::Real(x) => x,
        other => panic!("not a number: {other:?}"),
    });
    follows(d, lo, hi, draws.collect());
}

/// Asserts that `draws` follow the distribution function of `d`, whose mass (but 1e-9) is in `[lo, hi]`.
pub(super) fn follows(d: &Dist, lo: f64, hi: f64, mut draws: Vec<f64>) {
    // The midpoint rule on a grid of cells; its error is checked by the total mass.
    const CELLS: usize = 400_000;
    let step = (hi - lo) / CELLS as f64;
    let mut mass = Vec::with_capacity(CELLS + 1);
    mass.push(0.0);
    for k in 0..CELLS {
        let density = d.log_density(&Draw::Real(lo + (k as f64 + 0.5) * step)).exp();
        mass.push(mass[k] + density * step);
    }
    assert!((mass[CELLS] - 1.0).abs() < 2e-6, "{d:?} has mass {}", mass[CELLS]);
    // Kolmogorov-Smirnov; P(D > t) <= 2 exp(-2 n t^2) (Massart 1990) = 1e-6 at t = sqrt(ln(2e6) / (2 n)).
    draws.sort_by(f64::total_cmp);
    let n = draws.len() as f64;
    let threshold = ((2e6_f64).ln() / (2.0 * n)).sqrt() + 4e-6;
    for (k, x) in draws.iter().enumerate() {
        assert!(d.log_density(&Draw::Real(*x)).is_finite(), "{d:?} drew {x}");
        let place = ((x - lo) / step).clamp(0.0, CELLS as f64);
        let cell = (place as usize).min(CELLS - 1);
        let below = mass[cell] + (mass[cell + 1] - mass[cell]) * (place - cell as f64);
        let gap = (below - k as f64 / n).abs().max((below - (k as f64 + 1.0) / n).abs());
        assert!(gap < threshold, "{d:?}: at {x} {gap} > {threshold}");
    }
}

/// Asserts that probabilities over `range` sum to one, and that draws follow them.
pub(super) fn discrete_agrees(d: &Dist, range: RangeInclusive<i64>) {
    let lo = *range.start();
    let probability: Vec<f64> = range.map(|k| d.log_density(&Draw::Int(k)).exp()).collect();
    let total: f64 = probability.iter().sum();
    assert!((total - 1.0).abs() < 1e-9, "{d:?} sums to {total}");
    let mut count = vec![0.0; probability.len()];
    for k in 0..DRAWS as u64 {
        let x = d.sample(&mut stream(k)).as_int().expect("a count");
        assert!(probability[(x - lo) as usize] > 0.0, "{d:?} drew {x}");
        count[(x - lo) as usize] += 1.0;
    }
    // Running sums in place of chi-square: the same bound as above holds for distribution functions with steps.
    let threshold = ((2e6_f64).ln() / (2.0 * DRAWS as f64)).sqrt();
    let (mut below, mut seen) = (0.0, 0.0);
    for (p, c) in probability.iter().zip(&count) {
        below += p;
        seen += c / DRAWS as f64;
        assert!((below - seen).abs() < threshold, "{d:?}: {below} against {seen}");
    }
}
