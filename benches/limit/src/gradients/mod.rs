//! Hamiltonian Monte Carlo with gradients differentiated by hand: what a general system is measured against.
//!
//! A fixed number of leapfrog steps at a unit metric; the value is worked out at the end of a trajectory only.
mod coloring;
mod ring;

use crate::cpu_seconds;
use crate::population::{Random, SeedableRng, uniform};
use rand_distr::{Distribution, StandardNormal};
use serde_json::{Value, json};
use std::time::Instant;

/// A log density over `D` real coordinates.
trait Density<const D: usize> {
    /// Writes the gradient; gives the log density, nats, where `VALUE` asks for it.
    fn gradient<const VALUE: bool>(&mut self, x: &[f64; D], g: &mut [f64; D]) -> f64;
}

fn numbers(path: &str) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What a chain is told, in words.
struct Plan<'a> {
    point: &'a str,
    step: f64,
    length: u32,
    draws: u32,
    seed: u64,
}

fn chain<const D: usize>(mut density: impl Density<D>, plan: &Plan) -> Value {
    let mut x = [0.0; D];
    for (x, word) in x.iter_mut().zip(numbers(plan.point).split_whitespace()) {
        *x = word.parse().expect("a number");
    }
    let random = &mut Random::seed_from_u64(plan.seed);
    let (mut p, mut g) = ([0.0; D], [0.0; D]);
    let mut value = density.gradient::<true>(&x, &mut g);
    let (clock, busy, mut accepted) = (Instant::now(), cpu_seconds(), 0);
    let mut sums = [0.0; D];
    for _ in 0..plan.draws {
        p.iter_mut().for_each(|p| *p = StandardNormal.sample(random));
        let before = (x, g, value);
        let kinetic = |p: &[f64; D]| 0.5 * p.iter().map(|p| p * p).sum::<f64>();
        let energy = kinetic(&p) - value;
        let mut kick = 0.5 * plan.step;
        for left in (0..plan.length).rev() {
            for k in 0..D {
                p[k] += kick * g[k];
                x[k] += plan.step * p[k];
            }
            if left == 0 {
                value = density.gradient::<true>(&x, &mut g);
            } else {
                density.gradient::<false>(&x, &mut g);
            }
            kick = plan.step;
        }
        for k in 0..D {
            p[k] += 0.5 * plan.step * g[k];
        }
        let change = kinetic(&p) - value - energy;
        // Written so that a NaN is refused.
        if change <= 0.0 || uniform(random) < (-change).exp() {
            accepted += 1;
        } else {
            (x, g, value) = before;
        }
        sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
    }
    let (seconds, cpu) = (clock.elapsed().as_secs_f64(), cpu_seconds() - busy);
    json!({
        "gradients": u64::from(plan.draws) * u64::from(plan.length), "seconds": seconds, "cpu_seconds": cpu,
        "accept": f64::from(accepted) / f64::from(plan.draws), "mean": sums[0] / f64::from(plan.draws),
    })
}

/// Worst relative errors against the known values and gradients of a file.
fn check<const D: usize>(mut density: impl Density<D>, program: &str, path: &str) -> Value {
    let (mut value_off, mut slope_off, mut points) = (0.0f64, 0.0f64, 0);
    for line in numbers(path).lines().filter(|line| line.split_whitespace().next() == Some(program)) {
        let all: Vec<f64> =
            line.split_whitespace().skip(2).map(|word| word.parse().expect("a number")).collect();
        let x: [f64; D] = all[1..=D].try_into().expect("a number for each coordinate");
        let (known, mut g) = (&all[1 + D..], [0.0; D]);
        value_off = value_off.max((density.gradient::<true>(&x, &mut g) / all[0] - 1.0).abs());
        let size = known.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let mut without = [0.0; D];
        density.gradient::<false>(&x, &mut without);
        let off = |g: &[f64; D]| g.iter().zip(known).fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / size;
        slope_off = slope_off.max(off(&g)).max(off(&without));
        points += 1;
    }
    json!({"points": points, "value": value_off, "gradient": slope_off})
}

/// `hmc PROGRAM COLORING POINT STEP LENGTH DRAWS SEED`, or `gradients PROGRAM COLORING REFERENCE`.
pub fn run(args: &[&str]) -> Option<Value> {
    let [what @ ("hmc" | "gradients"), program, drawing, path, rest @ ..] = args else { return None };
    let coloring = || coloring::Coloring::read(&numbers(drawing));
    if *what == "gradients" {
        return match *program {
            "ring" => Some(check(ring::Ring, program, path)),
            "coloring" => Some(check(coloring(), program, path)),
            _ => None,
        };
    }
    let [step, length, draws, seed] = rest else { return None };
    let plan = Plan {
        point: path,
        step: step.parse().ok()?,
        length: length.parse().ok()?,
        draws: draws.parse().ok()?,
        seed: seed.parse().ok()?,
    };
    match *program {
        "ring" => Some(chain(ring::Ring, &plan)),
        "coloring" => Some(chain(coloring(), &plan)),
        _ => None,
    }
}
