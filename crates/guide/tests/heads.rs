//! A head's density is a density, its draws follow it, and it is never far below the prior's.
//!
//! Densities are integrated over the values themselves, by maps that have nothing to do with the head's coordinates. Each
//! case of draws raises a false alarm with probability at most 1e-6; there are about a hundred.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

use niwaki_guide::{Head, Lesson};
use niwaki_math::{Dist, Draw, Family, Param, Stream};
use std::f64::consts::PI;

/// Draws of each case.
const DRAWS: usize = 20_000;
/// The prior's share.
const SHARE: f64 = 0.02;

fn dist(family: Family, numbers: &[f64]) -> Dist {
    let params: Vec<Param> = numbers.iter().map(|x| Param::Real(*x)).collect();
    Dist::new(family, &params).expect("good parameters")
}

fn categorical(weights: &[f64]) -> Dist {
    Dist::new(Family::Categorical, &[Param::Vector(weights.to_vec())]).expect("good weights")
}

/// Outputs of a network: moderate ones, so that a grid resolves the density.
fn outputs(head: &Head, k: u64) -> Vec<f32> {
    let mut stream = Stream::new(14, 2, u128::from(k), 0);
    let count = head.outputs();
    let number = |at: usize| match head {
        Head::Normal { .. } | Head::Count { .. } if at >= 2 * count / 3 => -0.5 + 0.7 * stream.normal(),
        _ => 1.3 * stream.normal(),
    };
    (0..count).map(number).map(|x| x.clamp(-2.5, 2.5) as f32).collect()
}

/// Another coordinate `t` of the real numbers of a family: x of t, dx/dt, and t of x.
enum Map {
    Line(f64, f64),
    Positive,
    Between(f64, f64),
}

impl Map {
    fn of(d: &Dist) -> Map {
        match *d {
            Dist::Uniform { lo, hi } | Dist::TruncatedGaussian { lo, hi, .. } => Map::Between(lo, hi),
            Dist::Beta { .. } => Map::Between(0.0, 1.0),
            _ => d.center().zip(d.scale()).map_or(Map::Positive, |(center, unit)| Map::Line(center, unit)),
        }
    }

    fn number(&self, t: f64) -> (f64, f64) {
        match self {
            Map::Line(center, unit) => (center + unit * t.sinh(), unit * t.cosh()),
            Map::Positive => (t.exp(), t.exp()),
            Map::Between(lo, hi) => {
                let (up, down) = (1.0 / (1.0 + (-t).exp()), 1.0 / (1.0 + t.exp()));
                let x = if t < 0.0 { lo + (hi - lo) * up } else { hi - (hi - lo) * down };
                (x, (hi - lo) * up * down)
            }
        }
    }

    fn back(&self, x: f64) -> f64 {
        match self {
            Map::Line(center, unit) => ((x - center) / unit).asinh(),
            Map::Positive => x.ln(),
            Map::Between(lo, hi) => ((x - lo) / (hi - x)).ln(),
        }
    }
}

/// The largest gap that the statistic of Kolmogorov and Smirnov exceeds with probability 1e-6 at most, for this number of draws
/// (Massart 1990).
fn threshold() -> f64 {
    (2e6_f64.ln() / (2.0 * DRAWS as f64)).sqrt()
}

/// A draw; asserts that its log densities equal those of its value.
fn draw(head: &Head, outputs: &[f32], d: &Dist, k: u64) -> Draw {
    let drawn = head.draw(outputs, d, SHARE, &mut Stream::new(7, 7, u128::from(k), 0));
    let again = head.log_drawn(outputs, d, SHARE, &drawn.value);
    assert_eq!(drawn.log_drawn.to_bits(), again.to_bits(), "{d:?} drew {:?}", drawn.value);
    assert_eq!(drawn.log_prior.to_bits(), d.log_density(&drawn.value).to_bits());
    drawn.value
}

/// Asserts that the density integrates to one within `near`, and that draws follow the integral.
fn real_agrees(d: &Dist, outputs: &[f32], near: f64) {
    const CELLS: usize = 40_000;
    let head = Head::of(d, outputs.len() / 3).expect("a head");
    let map = Map::of(d);
    let (from, to) = if let Map::Between(..) = map { (-36.0, 36.0) } else { (-60.0, 60.0) };
    let step = (to - from) / CELLS as f64;
    let mut mass = vec![0.0];
    for k in 0..CELLS {
        let (x, slope) = map.number(from + (k as f64 + 0.5) * step);
        let log = head.log_drawn(outputs, d, SHARE, &Draw::Real(x));
        assert!(!log.is_nan(), "{d:?} at {x}");
        mass.push(mass[k] + log.exp() * slope * step);
    }
    let all = mass[CELLS];
    assert!((all - 1.0).abs() < near, "{d:?} with {outputs:?} has mass {all}");
    let mut draws: Vec<f64> =
        (0..DRAWS as u64).map(|k| map.back(draw(&head, outputs, d, k).as_real().unwrap())).collect();
    draws.sort_by(f64::total_cmp);
    let n = draws.len() as f64;
    for (k, t) in draws.iter().enumerate() {
        let place = ((t - from) / step).clamp(0.0, CELLS as f64 - 1.0);
        let cell = place as usize;
        let below = mass[cell] + (mass[cell + 1] - mass[cell]) * (place - cell as f64);
        let gap = (below - k as f64 / n).abs().max((below - (k as f64 + 1.0) / n).abs());
        assert!(gap < threshold() + near, "{d:?} with {outputs:?}: {gap} at {:?}", map.number(*t));
    }
}

fn reals() -> Vec<Dist> {
    vec![
        dist(Family::Gaussian, &[3.0, 0.2]),
        dist(Family::LogNormal, &[0.5, 0.4]),
        dist(Family::Uniform, &[-PI, PI]),
        dist(Family::Uniform, &[100.0, 100.5]),
        dist(Family::Exponential, &[2.0]),
        dist(Family::Laplace, &[1.0, 0.5]),
        dist(Family::Cauchy, &[-1.0, 2.0]),
        dist(Family::StudentT, &[1.0, 0.0, 1.0]),
        dist(Family::StudentT, &[4.0, 2.0, 0.3]),
        dist(Family::StudentT, &[1e9, 2.0, 0.3]),
        dist(Family::Gamma, &[0.7, 3.0]),
        dist(Family::Gamma, &[2.0, 0.1]),
        dist(Family::Gamma, &[200.0, 1.0]),
        dist(Family::InverseGamma, &[3.0, 2.0]),
        dist(Family::Beta, &[1.0, 1.0]),
        dist(Family::Beta, &[0.8, 3.0]),
        dist(Family::Beta, &[50.0, 20.0]),
        dist(Family::TruncatedGaussian, &[0.0, 1.0, -1.0, 2.0]),
        dist(Family::TruncatedGaussian, &[1.0, 0.5, 1.0, 9.0]),
        dist(Family::TruncatedGaussian, &[1.0, 0.5, -2.0, 0.7]),
        dist(Family::TruncatedGaussian, &[0.0, 1.0, 2.0, 2.01]),
        dist(Family::TruncatedGaussian, &[0.0, 1.0, -0.001, 0.002]),
        dist(Family::TruncatedGaussian, &[0.0, 1.0, 40.0, 60.0]),
        dist(Family::TruncatedGaussian, &[0.0, 1.0, -60.0, -40.0]),
    ]
}

#[test]
fn densities_of_real_numbers_integrate_to_one_and_draws_follow_them() {
    for (k, d) in reals().iter().enumerate() {
        let head = Head::of(d, 4).unwrap();
        for j in 0..2 {
            real_agrees(d, &outputs(&head, (2 * k + j) as u64), 1e-4);
        }
    }
}

/// A network may put its mass outside the coordinate's limits, where the prior draws. The density jumps at the limits,
/// so the grid is less exact.
#[test]
fn mass_beyond_the_coordinate_goes_to_the_prior() {
    for d in reals() {
        real_agrees(&d, &[0.0, 0.0, 7.4, -12.0, 0.0, -2.0], 2e-3);
    }
}

fn counts() -> Vec<(Dist, i64, i64)> {
    vec![
        (dist(Family::Poisson, &[0.3]), 0, 60),
        (dist(Family::Poisson, &[12.0]), 0, 200),
        (dist(Family::Poisson, &[400.0]), 0, 1500),
        (Dist::Binomial { n: 9, p: 0.3 }, 0, 9),
        (Dist::Binomial { n: 900, p: 0.5 }, 0, 900),
        (dist(Family::Geometric, &[0.2]), 0, 3000),
        (dist(Family::Geometric, &[1.0]), 0, 3),
        (Dist::DiscreteUniform { lo: -50, hi: 49 }, -50, 49),
        (dist(Family::Bernoulli, &[0.3]), 0, 1),
        (dist(Family::Bernoulli, &[1.0]), 0, 1),
        (categorical(&[0.0, 3.0, 0.0, 1.0, 2.0, 0.0]), 0, 5),
        (Dist::DiscreteUniform { lo: 3, hi: 9 }, 3, 9),
    ]
}

#[test]
fn densities_of_whole_numbers_sum_to_one_and_draws_follow_them() {
    for (case, (d, lo, hi)) in counts().into_iter().enumerate() {
        let head = Head::of(&d, 4).unwrap();
        for j in 0..3 {
            let outputs = outputs(&head, (100 + 3 * case + j) as u64);
            let log = |k: i64| head.log_drawn(&outputs, &d, SHARE, &Draw::Int(k));
            let probability: Vec<f64> = (lo..=hi).map(|k| log(k).exp()).collect();
            let all: f64 = probability.iter().sum();
            assert!((all - 1.0).abs() < 1e-9, "{d:?} with {outputs:?} sums to {all}");
            let mut seen = vec![0.0; probability.len()];
            for k in 0..DRAWS as u64 {
                let value = draw(&head, &outputs, &d, k).as_int().unwrap();
                assert!(d.log_density_of_int(value) > f64::NEG_INFINITY, "{d:?} drew {value}");
                seen[(value - lo) as usize] += 1.0 / DRAWS as f64;
            }
            let (mut below, mut drawn) = (0.0, 0.0);
            for (p, s) in probability.iter().zip(&seen) {
                (below, drawn) = (below + p, drawn + s);
                assert!((below - drawn).abs() < threshold(), "{d:?}: {below} against {drawn}");
            }
        }
    }
}

/// For any outputs and parameters, no density is NaN, and the prior's density is at most the guide's divided by
/// the share.
#[test]
fn weights_are_at_most_one_over_the_share() {
    let sizes = [1e-100, 1e-8, 0.3, 1.0, 7.0, 1e5, 1e12, 1e100];
    let mut dists: Vec<Dist> = reals().into_iter().chain(counts().into_iter().map(|(d, _, _)| d)).collect();
    let two = [Family::Gaussian, Family::LogNormal, Family::Gamma, Family::InverseGamma, Family::Beta]
        .into_iter()
        .chain([Family::Laplace, Family::Cauchy, Family::Uniform]);
    for family in two {
        for a in sizes {
            let b = if family == Family::Uniform { 1.0 } else { 0.0 };
            dists.extend(
                sizes
                    .iter()
                    .filter_map(|x| Dist::new(family, &[Param::Real(a), Param::Real(b * a + x)]).ok()),
            );
        }
    }
    for a in sizes {
        dists.push(dist(Family::Exponential, &[a]));
        dists.push(dist(Family::StudentT, &[a, 1.0, 2.0]));
        dists.push(dist(Family::Poisson, &[a.min(1e15)]));
        for b in sizes {
            dists.extend(Dist::new(
                Family::TruncatedGaussian,
                &[1.0, a, 1.0 - b, 1.0 + 3.0 * b].map(Param::Real),
            ));
            dists.extend(Dist::new(Family::TruncatedGaussian, &[0.0, a, b, 2.0 * b].map(Param::Real)));
        }
    }
    let mut stream = Stream::new(3, 0, 0, 0);
    for (case, d) in dists.iter().enumerate() {
        let head = Head::of(d, 4).unwrap();
        for k in 0..40 {
            let size = [0.1, 3.0, 30.0, 1e30][k % 4];
            let outputs: Vec<f32> = (0..head.outputs()).map(|_| (size * stream.normal()) as f32).collect();
            let drawn = head.draw(&outputs, d, SHARE, &mut Stream::new(1, 1, case as u128, k as u64));
            let value = d.sample(&mut stream);
            for (value, log_drawn) in [
                (drawn.value.clone(), drawn.log_drawn),
                (value.clone(), head.log_drawn(&outputs, d, SHARE, &value)),
            ] {
                let log_prior = d.log_density(&value);
                if log_prior == f64::NEG_INFINITY {
                    assert_eq!(log_drawn, log_prior, "{d:?} at {value:?}");
                    continue;
                }
                let weight = log_prior - log_drawn;
                assert!(
                    log_drawn.is_finite() && weight <= -SHARE.ln() + 1e-9,
                    "{d:?} with {outputs:?} at {value:?}: {log_drawn}, weight {weight}"
                );
            }
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let mut lessons = Vec::new();
    for d in reals().iter().chain(counts().iter().map(|(d, _, _)| d)) {
        let head = Head::of(d, 4).unwrap();
        for k in 0..3 {
            lessons.push((head, head.lesson(d, &d.sample(&mut Stream::new(5, 0, k, 0))).unwrap()));
        }
    }
    lessons.push((
        Head::Normal { components: 4 },
        Lesson::Normal { z: 2.0, log_prior: -3.0, limits: (-2.5, 2.2) },
    ));
    for (k, (head, lesson)) in lessons.iter().enumerate() {
        for share in [0.02, 0.5] {
            let at: Vec<f64> = outputs(head, k as u64).iter().map(|x| f64::from(*x)).collect();
            let mut slope = vec![0.0; at.len()];
            lesson.log_quotient(&at, share, Some(&mut slope));
            for j in 0..at.len() {
                let moved = |step: f64| {
                    let mut at = at.clone();
                    at[j] += step;
                    lesson.log_quotient(&at, share, None)
                };
                // The differences are of fourth order: the error has the size of the step to the fourth.
                let h = 1e-3;
                let numeric =
                    (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
                assert!(
                    (numeric - slope[j]).abs() < 1e-6 * slope[j].abs().max(1e-3),
                    "{lesson:?} {j}: {numeric} {}",
                    slope[j]
                );
            }
        }
    }
}

#[test]
fn sites_have_the_heads_of_their_families() {
    let of = |d: &Dist| Head::of(d, 4);
    assert_eq!(of(&dist(Family::Gaussian, &[0.0, 1.0])), Some(Head::Normal { components: 4 }));
    assert_eq!(of(&categorical(&[1.0; 5])), Some(Head::Finite { values: 5 }));
    assert_eq!(of(&categorical(&[1.0; 65])), None);
    assert_eq!(of(&Dist::DiscreteUniform { lo: 0, hi: 63 }), Some(Head::Finite { values: 64 }));
    assert_eq!(of(&Dist::DiscreteUniform { lo: 0, hi: 64 }), Some(Head::Count { components: 4 }));
    assert_eq!(
        of(&Dist::DiscreteUniform { lo: i64::MIN, hi: i64::MAX }),
        Some(Head::Count { components: 4 })
    );
    assert_eq!(of(&dist(Family::VonMises, &[0.0, 1.0])), None);
    assert_eq!(of(&Dist::Delta(Draw::Real(1.0))), None);
    let die = Head::Finite { values: 6 };
    assert!(
        die.fits(&Dist::DiscreteUniform { lo: 1, hi: 6 })
            && !die.fits(&Dist::DiscreteUniform { lo: 1, hi: 5 })
    );
    assert!(die.fits(&categorical(&[1.0; 4])) && !die.fits(&categorical(&[1.0; 7])));
    assert_eq!(die.widen(&categorical(&[1.0; 7]), 4), Some(Head::Finite { values: 7 }));
    assert_eq!(die.widen(&Dist::DiscreteUniform { lo: 1, hi: 5 }, 4), Some(Head::Count { components: 4 }));
    assert_eq!(die.widen(&dist(Family::Gaussian, &[0.0, 1.0]), 4), None);
}

/// If the head does not fit, the prior draws.
#[test]
fn a_head_that_does_not_fit_leaves_the_choice_to_the_prior() {
    let d = dist(Family::Gaussian, &[0.0, 1.0]);
    let drawn = Head::Finite { values: 2 }.draw(&[5.0, -5.0], &d, SHARE, &mut Stream::new(1, 2, 3, 4));
    assert_eq!(drawn.value, d.sample(&mut Stream::new(1, 2, 3, 4)));
    assert_eq!(drawn.log_drawn, drawn.log_prior);
    assert_eq!(Head::Finite { values: 2 }.lesson(&d, &Draw::Real(0.0)), None);
}
