//! Distributions of any parameters: draws are in the support, scores are numbers, scores and draws of whole numbers fit.

use crate::numbers::{below, byte, ordinary, real, size, whole};
use arbitrary::Unstructured;
use niwaki_math::{Dist, Draw, Family, Param, Stream, Support};

/// Scores are below plus infinity with parameters of these sizes; beyond, densities themselves may overflow.
const ORDINARY: std::ops::Range<f64> = 1e-120..1e120;
/// Draws from each distribution.
const DRAWS: u64 = 4;
/// Values that are listed one by one.
const MOST_LISTED: i64 = 1000;

/// Makes a distribution, draws from it and scores the draws, and other values.
///
/// # Panics
/// When a draw is impossible, a score is not a number, or two ways to the same answer differ.
pub fn check(bytes: &[u8]) {
    let u = &mut Unstructured::new(bytes);
    let Some(dist) = dist(u, 3) else { return };
    let bounded = dist.params().iter().all(is_ordinary);
    let score = |x: &Draw| {
        let log = dist.log_density(x);
        assert!(!log.is_nan() && (!bounded || log < f64::INFINITY), "{dist:?} scores {x:?} with {log}");
        log
    };
    for k in 0..DRAWS {
        let stream = || Stream::new(u64::from(byte(&mut Unstructured::new(bytes))), 1, 7, k);
        let draw = dist.sample(&mut stream());
        let log = score(&draw);
        assert!(log > f64::NEG_INFINITY, "{dist:?} drew {draw:?}, which is impossible");
        assert!(in_support(&draw, &dist.support()), "{dist:?} drew {draw:?}");
        let (again, scored) = dist.sample_and_score(&mut stream());
        assert_eq!(
            (format!("{again:?}"), scored.to_bits()),
            (format!("{draw:?}"), log.to_bits()),
            "{dist:?}"
        );
        let z = ordinary(u);
        if let Some((moved, there, back)) = dist.support().moved(&draw, || z) {
            assert!(!there.is_nan() && !back.is_nan(), "{dist:?}: {draw:?} moved to {moved:?}");
            score(&moved);
        }
    }
    for _ in 0..4 {
        score(&Draw::Real(real(u)));
        score(&Draw::Int(whole(u)));
        score(&Draw::Vector((0..below(u, 4)).map(|_| real(u)).collect()));
    }
    let again = Dist::new(dist.family(), &dist.params()).unwrap_or_else(|error| panic!("{dist:?}: {error}"));
    assert_eq!(format!("{again:?}"), format!("{dist:?}"), "from its own parameters");
    ranks(u, &dist);
    listed(&dist);
}

/// Normal scores of whole numbers never fall, and are inverted.
fn ranks(u: &mut Unstructured<'_>, dist: &Dist) {
    let (mut k, z) = (whole(u), ordinary(u) * 4.0);
    if let Some(at) = dist.at_normal_score(z) {
        let score = |k: i64| dist.normal_score(k).expect("a family of whole numbers");
        assert!(score(at) >= z, "{dist:?}: {z} at {at}, which has {}", score(at));
        let before = at.checked_sub(1).map_or(f64::NEG_INFINITY, score);
        assert!(before < z, "{dist:?}: {z} at {at}, the one before has {before}");
        for _ in 0..4 {
            let (low, next) = (score(k), score(k.saturating_add(1)));
            assert!(low <= next, "{dist:?} falls from {low} to {next} after {k}");
            k = at.saturating_add(whole(u) % 8);
        }
    }
}

/// The values of a finite distribution have a probability each.
fn listed(dist: &Dist) {
    let few = match dist.support().in_bounds() {
        Support::Integers { lo, hi: Some(hi) } => hi.checked_sub(lo).is_some_and(|n| n < MOST_LISTED),
        _ => true,
    };
    if let Some(values) = few.then(|| dist.enumerate()).flatten() {
        assert!(values.iter().all(|value| dist.log_density(value) > f64::NEG_INFINITY), "{dist:?}");
    }
}

fn is_ordinary(param: &Param) -> bool {
    let fits = |x: &f64| *x == 0.0 || ORDINARY.contains(&x.abs());
    match param {
        Param::Bool(_) | Param::Int(_) | Param::Draw(_) => true,
        Param::Real(x) => fits(x),
        Param::Vector(row) => row.iter().all(fits),
        Param::Matrix(rows) => rows.iter().flatten().all(fits),
        Param::Dists(dists) => dists.iter().flat_map(Dist::params).all(|param| is_ordinary(&param)),
    }
}

fn in_support(draw: &Draw, support: &Support) -> bool {
    match (support, draw) {
        (Support::Booleans, Draw::Bool(_)) => true,
        (Support::Categories(n), Draw::Int(k)) => usize::try_from(*k).is_ok_and(|k| k < *n),
        (Support::Integers { lo, hi }, Draw::Int(k)) => lo <= k && hi.is_none_or(|hi| *k <= hi),
        (Support::Reals(interval), Draw::Real(x)) => {
            interval.lo.is_none_or(|lo| lo <= *x) && interval.hi.is_none_or(|hi| *x <= hi) && x.is_finite()
        }
        (Support::Circle, Draw::Real(x)) => x.abs() <= std::f64::consts::PI,
        (Support::Simplex(n) | Support::Vectors(n), Draw::Vector(v)) => v.len() == *n,
        (Support::Counts(n), Draw::Counts(v)) => v.len() == *n,
        (Support::Truths(n), Draw::Truths(v)) => v.len() == *n,
        (Support::Points { .. } | Support::VectorPoints(_), _) => true,
        _ => false,
    }
}

/// A distribution, where its parameters make one; its parts are nested at most so deep.
pub fn dist(u: &mut Unstructured<'_>, deep: usize) -> Option<Dist> {
    let family = Family::ALL[below(u, Family::ALL.len())];
    let params: Vec<Param> = match family {
        Family::Categorical | Family::Dirichlet => vec![Param::Vector(row(u, 4))],
        Family::Multinomial => vec![Param::Int(below(u, 40) as i64), Param::Vector(row(u, 4))],
        Family::MultivariateBernoulli => vec![Param::Vector(row(u, 4))],
        Family::DiagonalGaussian => vec![Param::Vector(row(u, 4)), Param::Vector(row(u, 4))],
        Family::MultivariateGaussian => {
            let n = 1 + below(u, 3);
            let mean = (0..n).map(|_| real(u)).collect();
            let sides: Vec<f64> = (0..n).map(|_| size(u)).collect();
            let share = if below(u, 2) == 0 { 0.0 } else { ordinary(u) };
            let entry = |i: usize, j: usize| if i == j { sides[i] } else { share };
            vec![
                Param::Vector(mean),
                Param::Matrix((0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()),
            ]
        }
        Family::Mixture if deep == 0 => return None,
        Family::Mixture => {
            let parts: Vec<Dist> = (0..1 + below(u, 3)).filter_map(|_| dist(u, deep - 1)).collect();
            let weights = (0..parts.len()).map(|_| size(u)).collect();
            vec![Param::Vector(weights), Param::Dists(parts)]
        }
        Family::Delta => vec![Param::Draw(Draw::Real(real(u)))],
        _ => family.parameters().iter().map(|_| number(u)).collect(),
    };
    Dist::new(family, &params).ok()
}

/// A parameter: positive as a rule, so that most distributions can be.
fn number(u: &mut Unstructured<'_>) -> Param {
    match below(u, 8) {
        0 => Param::Int(whole(u)),
        1 => Param::Real(real(u)),
        2 => Param::Real(ordinary(u)),
        3 => Param::Real(ordinary(u).abs().fract()),
        4 => Param::Bool(byte(u) & 1 == 1),
        _ => Param::Real(size(u)),
    }
}

fn row(u: &mut Unstructured<'_>, most: usize) -> Vec<f64> {
    let strange = below(u, 4) == 0;
    (0..below(u, most + 1)).map(|_| if strange { real(u) } else { size(u) }).collect()
}
