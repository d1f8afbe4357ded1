//! The graph, the tape at every width and the machine code agree with each other and with known values.

mod peers;

use niwaki_grad::{Density, Native, Tape};
use peers::{Known, drawing, known, peers, plain_choose, recorded, ring, stack, stack_start};

/// Largest difference of two gradients over the largest component.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(1e-300, |m: f64, x| m.max(x.abs()));
    a.iter().zip(b).fold(0.0, |m: f64, (a, b)| if (a - b).is_nan() { f64::NAN } else { m.max((a - b).abs()) })
        / size
}

fn lanes<const L: usize>(tape: &Tape, x: &[f64]) -> (f64, Vec<f64>) {
    let mut memory = tape.lanes::<L>();
    // Other lanes hold other points: no lane may affect another.
    let points: Vec<[f64; L]> = x
        .iter()
        .map(|x| std::array::from_fn(|l| if l == L - 1 { *x } else { x + 0.01 * l as f64 }))
        .collect();
    let mut g = vec![[0.0; L]; x.len()];
    let value = memory.value_and_gradient(tape, &points, &mut g);
    (value[L - 1], g.iter().map(|g| g[L - 1]).collect())
}

fn every_evaluator(density: &Density, x: &[f64]) -> Vec<(&'static str, f64, Vec<f64>)> {
    let mut all = Vec::new();
    let mut g = vec![0.0; x.len()];
    let value = density.interpret(x, &mut g);
    all.push(("interpreter", value, g.clone()));
    let tape = Tape::new(density);
    for (name, (value, g)) in [
        ("tape of 1", lanes::<1>(&tape, x)),
        ("tape of 16", lanes::<16>(&tape, x)),
        ("tape of 64", lanes::<64>(&tape, x)),
    ] {
        all.push((name, value, g));
    }
    let mut native = Native::compile(density).expect("machine code for this processor");
    let value = native.value_and_gradient(x, &mut g);
    all.push(("machine code", value, g.clone()));
    g.fill(0.0);
    assert!(native.gradient(x, &mut g));
    all.push(("machine code, gradient only", value, g));
    all
}

#[test]
fn densities_of_peers_equal_known_values() {
    let densities = peers();
    for Known { name, x, value, gradient } in known() {
        let density = &densities.iter().find(|(n, _)| *n == name).expect("a density of that name").1;
        assert_eq!(density.dim(), x.len());
        for (evaluator, actual, g) in every_evaluator(density, &x) {
            assert!((actual / value - 1.0).abs() < 1e-11, "{name} by {evaluator}: {actual} {value}");
            let apart = apart(&g, &gradient);
            assert!(apart < 1e-10, "{name} by {evaluator}: gradients differ by {apart}");
        }
        let plain = match name.as_str() {
            "ring" => ring(&x),
            "coloring" => peers::coloring(&drawing(), &x, plain_choose),
            _ => stack(6, &x),
        };
        assert!((plain / value - 1.0).abs() < 1e-11, "{name} without recording: {plain} {value}");
    }
}

#[test]
fn a_large_density_is_cut_into_functions_and_stays_the_same() {
    let x = stack_start(28);
    let density = recorded(&x, |x| stack(28, x));
    let all = every_evaluator(&density, &x);
    let (_, value, gradient) = &all[0];
    assert!((value / stack(28, &x) - 1.0).abs() < 1e-10);
    for (evaluator, actual, g) in &all[1..] {
        assert!((actual / value - 1.0).abs() < 1e-10, "{evaluator}: {actual} {value}");
        assert!(apart(g, gradient) < 1e-10, "{evaluator}");
    }
}
