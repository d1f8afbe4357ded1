//! One transition leaves its target as it is: the exact rank test of Gandy & Scott 2020 (algorithm 2).
//!
//! Parameters and data are drawn together; the drawn parameters get a random place in a chain whose other states come
//! from transitions forwards and, the kernels being reversible, backwards. The rank of the drawn state among all of
//! them is then exactly uniform, however badly the chain mixes. Each statistic raises a false alarm in 1e-6; there
//! are 72 of them.

use crate::densities::{MODELS, Model, Negated};
use crate::ranks::{LIMIT, RANKS, chi_square, rank};
use niwaki_continuous::hamiltonian::hmc::Hmc;
use niwaki_continuous::hamiltonian::nuts::Nuts;
use niwaki_continuous::hamiltonian::{Kernel, Metric, Phase, Potential};
use niwaki_math::Stream;

/// The largest chi-square statistic over a model's statistics, from this many chains.
fn statistic<P: Potential>(
    model: &Model,
    make: impl Fn(Vec<f64>) -> P,
    kernel: &Kernel,
    metric: &dyn Fn(usize) -> Metric,
    step: f64,
    chains: u64,
) -> f64 {
    let mut counts: Vec<[f64; RANKS]> = Vec::new();
    let mut kernel = kernel.clone();
    for chain in 0..chains {
        let mut stream = Stream::new(17, chain, 0, 0);
        let (x, y) = (model.draw)(&mut stream);
        let mut target = make(y);
        let metric = metric(x.len());
        let place = (stream.uniform() * RANKS as f64) as usize;
        let mut states: Vec<Vec<f64>> = Vec::new();
        for steps in [place, RANKS - 1 - place] {
            let mut phase = Phase::at(&mut target, &x).expect("a point of the model");
            for _ in 0..steps {
                kernel.step(&mut target, &metric, step, &mut phase, &mut stream);
                states.push((model.watched)(&phase.x));
            }
        }
        let drawn = (model.watched)(&x);
        counts.resize(drawn.len(), [0.0; RANKS]);
        for (k, value) in drawn.iter().enumerate() {
            let watched = states.iter().map(|state| state[k]);
            counts[k][rank(*value, watched, &mut stream)] += 1.0;
        }
    }
    counts.iter().map(|counts| chi_square(counts)).fold(0.0, f64::max)
}

fn kernels() -> [(&'static str, Kernel); 3] {
    [
        ("hmc", Kernel::Hmc(Hmc::new(8, 0.0, 1000.0))),
        ("hmc, jittered", Kernel::Hmc(Hmc::new(6, 0.6, 1000.0))),
        ("nuts", Kernel::Nuts(Nuts::new(6, 1000.0))),
    ]
}

type Make = fn(usize) -> Metric;

fn metrics() -> [(&'static str, Make); 4] {
    [
        ("unit", Metric::unit),
        ("diagonal", |dim| Metric::diagonal((0..dim).map(|i| 0.3 + 0.5 * i as f64).collect())),
        ("dense", |dim| {
            let at = |k: usize| if k / dim == k % dim { 1.0 } else { 0.4 };
            Metric::dense((0..dim * dim).map(at).collect()).expect("positive definite")
        }),
        ("low rank", |dim| {
            let u = vec![1.0 / (dim as f64).sqrt(); dim];
            Metric::low_rank(vec![0.8; dim], vec![(u, 2.5)])
        }),
    ]
}

/// A step that is rejected now and then in every model: the acceptance must matter.
const STEP: f64 = 0.5;
/// Chains for a mutant: it may mix badly, and must be rejected nevertheless.
const MUTANT_CHAINS: u64 = 16_000;

#[test]
fn every_kernel_leaves_every_model_as_it_is_in_every_metric() {
    for model in &MODELS {
        for (kernel_name, kernel) in kernels() {
            for (metric_name, metric) in metrics() {
                let largest = statistic(model, |y| (model.posterior)(y, true), &kernel, &metric, STEP, 4000);
                assert!(largest < LIMIT, "{} {kernel_name} {metric_name}: {largest}", model.name);
            }
        }
    }
}

#[test]
fn a_dropped_jacobian_is_found() {
    for model in &MODELS {
        for (name, kernel) in kernels() {
            let largest = statistic(
                model,
                |y| (model.posterior)(y, false),
                &kernel,
                &Metric::unit,
                STEP,
                MUTANT_CHAINS,
            );
            assert!(largest > LIMIT, "{} {name}: {largest}", model.name);
        }
    }
}

#[test]
fn a_wrong_sign_in_the_acceptance_is_found() {
    for model in &MODELS {
        for (name, kernel) in kernels() {
            let make = |y| Negated((model.posterior)(y, true));
            let largest = statistic(model, make, &kernel, &Metric::unit, STEP, MUTANT_CHAINS);
            assert!(largest > LIMIT, "{} {name}: {largest}", model.name);
        }
    }
}

#[test]
fn a_momentum_of_another_metric_is_found() {
    // The mutant steps and accepts by the identity, and draws its momentum from a metric four times as wide. (One that
    // draws and accepts by a metric but steps without it is slow and yet correct: the map keeps volume and is
    // reversible. Its energy error shows it: see `leapfrog`.)
    let mutant = |dim: usize| Metric::Diagonal { variance: vec![1.0; dim], deviation: vec![4.0; dim] };
    for model in &MODELS {
        for (name, kernel) in kernels() {
            let largest =
                statistic(model, |y| (model.posterior)(y, true), &kernel, &mutant, STEP, MUTANT_CHAINS);
            assert!(largest > LIMIT, "{} {name}: {largest}", model.name);
        }
    }
}
