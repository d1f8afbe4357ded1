//! Leapfrog steps in machine code equal, to the bit, those of an integrator that calls the tape for one gradient after
//! another. They stop before a step that leads outside the guards or to a slope that is not finite.

use niwaki_grad::scalar::with_sheet;
use niwaki_grad::{Density, Native, Rolling, Tape, Var};
use niwaki_math::Scalar;

fn recorded(x: &[f64], f: impl FnOnce(&[Var]) -> Var) -> Density {
    let (value, sheet) = with_sheet(|| f(&x.iter().map(|x| Var::input(*x)).collect::<Vec<_>>()));
    let mut graph = sheet.graph;
    let id = value.id(&mut graph);
    Density::new(graph, id, &sheet.guards)
}

/// Position, momentum, gradient.
type Phase = [Vec<f64>; 3];

/// The number of possible steps (at most `n`) and the phase after them, by an integrator with the tape.
fn by_tape(
    density: &Density,
    [x, p, g]: &Phase,
    variance: &[f64],
    sizes: (f64, f64),
    n: u32,
) -> (u32, Phase) {
    let tape = Tape::new(density);
    let mut lanes = tape.lanes::<1>();
    let (mut x, mut p, mut g, mut kick) = (x.clone(), p.clone(), g.clone(), sizes.0);
    for count in 0..n {
        let before = [x.clone(), p.clone(), g.clone()];
        for k in 0..x.len() {
            p[k] += kick * g[k];
            x[k] += (sizes.1 * variance[k]) * p[k];
        }
        let inside = lanes.inside(&tape, &x, &mut g).is_some();
        if !inside || g.iter().any(|slope| !slope.is_finite()) {
            return (count, before);
        }
        kick = sizes.1;
    }
    (n, [x, p, g])
}

/// Compares steps in machine code with those by tape, and returns their number.
fn compared(density: &Density, x: &[f64], p: &[f64], sizes: (f64, f64), n: u32) -> u32 {
    let variance: Vec<f64> = (0..x.len()).map(|k| 0.7 + 0.4 * k as f64).collect();
    let mut g = vec![0.0; x.len()];
    let mut native = Native::compile(density).expect("machine code for this processor");
    assert!(native.gradient(x, &mut g));
    let start = [x.to_vec(), p.to_vec(), g];
    let (count, expected) = by_tape(density, &start, &variance, sizes, n);
    let [mut x, mut p, mut g] = start;
    let at = Rolling { x: &mut x, p: &mut p, g: &mut g, variance: &variance };
    assert_eq!(native.roll(at, sizes.0, sizes.1, n), count);
    let bits = |phase: &Phase| -> Vec<u64> { phase.iter().flatten().map(|x| x.to_bits()).collect() };
    assert_eq!(bits(&[x, p, g]), bits(&expected));
    count
}

fn c(x: f64) -> Var {
    Var::from_f64(x)
}

#[test]
fn steps_in_a_loop_are_steps_one_by_one() {
    for dim in 1..=4 {
        let x: Vec<f64> = (0..dim).map(|k| 0.4 - 0.3 * f64::from(k)).collect();
        let p: Vec<f64> = (0..dim).map(|k| 1.0 - 0.6 * f64::from(k)).collect();
        // Bends, a quotient, a root, a corner, and neighbours that hold each other.
        let density = recorded(&x, |x| {
            let mut sum = c(0.0);
            for (k, a) in x.iter().enumerate() {
                let b = x[(k + 1) % x.len()];
                let bend = *a * *a - b;
                sum = sum - c(2.0) * bend * bend - *a * *a * *a * *a / (c(1.0) + b * b);
                sum = sum - (c(1.0) + *a * *a).sqrt() - (*a - b).abs().max(*a * c(0.5));
            }
            sum
        });
        for n in [1, 2, 7, 500] {
            assert_eq!(compared(&density, &x, &p, (0.01, 0.02), n), n);
            assert_eq!(compared(&density, &x, &p, (-0.02, -0.02), n), n);
        }
    }
}

#[test]
fn steps_stop_before_guards_and_before_numbers_not_finite() {
    let walled = recorded(&[0.2, 0.1], |x| {
        let far = x[0] > c(1.5);
        let rest = c(-0.5) * (x[0] * x[0] + x[1] * x[1]);
        if far { rest * c(2.0) } else { rest }
    });
    let count = compared(&walled, &[0.2, 0.1], &[3.0, 0.0], (0.025, 0.05), 1000);
    assert!((2..40).contains(&count), "{count}");
    // Steps that are far too long: the numbers overflow.
    let steep = recorded(&[3.0], |x| c(-0.25) * x[0] * x[0] * x[0] * x[0]);
    let count = compared(&steep, &[3.0], &[1.0], (1.0, 2.0), 1000);
    assert!((1..20).contains(&count), "{count}");
    // Not even one step: nothing moves.
    assert_eq!(compared(&steep, &[3.0], &[1e308], (1.0, 1e10), 5), 0);
}

#[test]
fn a_density_that_needs_calls_or_is_large_takes_no_steps_by_itself() {
    for dim in [1_usize, 5] {
        let x = vec![0.3; dim];
        let density = recorded(&x, |x| {
            let sum = x.iter().fold(c(0.0), |sum, x| sum - *x * *x);
            if dim == 1 { sum - x[0].exp() } else { sum }
        });
        let mut native = Native::compile(&density).expect("machine code for this processor");
        let (mut p, mut g, mut here) = (vec![1.0; dim], vec![0.0; dim], x.clone());
        let variance = vec![1.0; dim];
        let at = Rolling { x: &mut here, p: &mut p, g: &mut g, variance: &variance };
        assert_eq!((native.roll(at, 0.1, 0.2, 10), here), (0, x));
    }
}
