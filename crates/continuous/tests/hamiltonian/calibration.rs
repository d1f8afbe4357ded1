//! Simulation-based calibration of whole chains, warm-up and adaptation included (Talts et al. 2018, algorithm 1).
//!
//! Parameters and data are drawn together; the rank of the drawn parameters among thinned draws given the data is
//! uniform, as far as the thinned draws are independent and the warm-up has arrived. Each statistic raises a false
//! alarm in 1e-6.

use crate::densities::{MODELS, Model};
use crate::ranks::{LIMIT, RANKS, chi_square, rank};
use niwaki_continuous::hamiltonian::chains::Length;
use niwaki_continuous::hamiltonian::{Settings, Shape, sample};
use niwaki_math::Stream;

const DATA_SETS: u64 = 600;

fn statistic(model: &Model, settings: &Settings, jacobian: bool) -> f64 {
    let mut drawn = Vec::new();
    let mut data = Vec::new();
    for k in 0..DATA_SETS {
        let (x, y) = (model.draw)(&mut Stream::new(23, k, 0, 0));
        drawn.push((model.watched)(&x));
        data.push((x.len(), y));
    }
    let starts: Vec<Vec<f64>> = data
        .iter()
        .enumerate()
        .map(|(k, (dim, _))| {
            let mut stream = Stream::new(29, k as u64, 0, 0);
            (0..*dim).map(|_| stream.normal()).collect()
        })
        .collect();
    let make = |k: usize| (model.posterior)(data[k].1.clone(), jacobian);
    let chains = sample(make, &starts, settings, 31, &|_, _| true).expect("starts");
    let mut counts = vec![[0.0; RANKS]; drawn[0].len()];
    for (k, chain) in chains.iter().enumerate() {
        let states: Vec<Vec<f64>> = chain.rows().map(model.watched).collect();
        let mut stream = Stream::new(37, k as u64, 0, 0);
        for (i, value) in drawn[k].iter().enumerate() {
            counts[i][rank(*value, states.iter().map(|state| state[i]), &mut stream)] += 1.0;
        }
    }
    counts.iter().map(|counts| chi_square(counts)).fold(0.0, f64::max)
}

fn settings(length: Length, shape: Shape, target_accept: f64) -> Settings {
    // A high acceptance for the hierarchical model's narrow end; thinned so that nine draws are nearly independent.
    let draws = RANKS as u32 - 1;
    Settings { length, shape, warmup: 300, draws, thin: 20, target_accept, ..Settings::nuts() }
}

#[test]
fn nuts_is_calibrated_with_every_metric() {
    for model in &MODELS {
        for shape in [Shape::Diagonal, Shape::Dense, Shape::LowRank] {
            let settings = settings(Length::NoUTurn { max_depth: 8 }, shape, 0.9);
            let largest = statistic(model, &settings, true);
            assert!(largest < LIMIT, "{} {shape:?}: {largest}", model.name);
        }
    }
}

#[test]
fn hmc_is_calibrated() {
    for model in &MODELS {
        let settings = settings(Length::Fixed { steps: 20, jitter: 0.5 }, Shape::Diagonal, 0.9);
        let largest = statistic(model, &settings, true);
        assert!(largest < LIMIT, "{}: {largest}", model.name);
    }
}

#[test]
fn a_dropped_jacobian_is_found() {
    for model in &MODELS {
        let settings = settings(Length::NoUTurn { max_depth: 8 }, Shape::Diagonal, 0.9);
        let largest = statistic(model, &settings, false);
        assert!(largest > LIMIT, "{}: {largest}", model.name);
    }
}
