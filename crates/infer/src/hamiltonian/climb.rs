//! Steps uphill before a chain: from a run of the prior, which tight constraints leave thousands of nats below all that
//! is likely, to where trajectories start well.
//!
//! Each coordinate moves by the size of its own slopes (Kingma & Ba 2015, algorithm 1), a step shorter each time by the
//! same ratio. Coarse steps pass over small summits, which a line search would stop at. Where it ends is a start and no
//! draw: the warm-up that follows makes it one, and chains from different runs end on different summits.

use super::potential::{Potential, evaluate};

/// Length of the first step and of the last, in unconstrained coordinates.
const FIRST: f64 = 0.2;
const LAST: f64 = 0.01;
/// How much of the mean slope, and of the mean squared slope, is remembered from one step to the next.
const SLOPE_MEMORY: f64 = 0.9;
const SIZE_MEMORY: f64 = 0.99;
/// Keeps a coordinate without any slope where it is.
const TINY: f64 = 1e-9;

/// Moves `x` uphill, to the highest point of `steps` steps; gives the number of gradients taken. A point that the target
/// refuses ends the way before it.
pub fn climb(target: &mut (impl Potential + ?Sized), x: &mut [f64], steps: u32) -> u32 {
    let dim = x.len();
    let (mut at, mut gradient) = (x.to_vec(), vec![0.0; dim]);
    let (mut slope, mut size) = (vec![0.0; dim], vec![0.0; dim]);
    let (mut slope_share, mut size_share) = (1.0, 1.0);
    let mut best = f64::NEG_INFINITY;
    for k in 0..steps {
        let Ok(value) = evaluate(target, &at, &mut gradient) else { return k + 1 };
        if value > best {
            best = value;
            x.copy_from_slice(&at);
        }
        slope_share *= SLOPE_MEMORY;
        size_share *= SIZE_MEMORY;
        let step = FIRST * (LAST / FIRST).powf(f64::from(k) / f64::from(steps));
        for (((at, slope), size), g) in at.iter_mut().zip(&mut slope).zip(&mut size).zip(&gradient) {
            *slope = SLOPE_MEMORY * *slope + (1.0 - SLOPE_MEMORY) * g;
            *size = SIZE_MEMORY * *size + (1.0 - SIZE_MEMORY) * g * g;
            let mean = *slope / (1.0 - slope_share);
            *at += step * mean / ((*size / (1.0 - size_share)).sqrt() + TINY);
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    //! It finds the top of what is steep in some coordinates and flat in others, stays where it may, and never ends lower.
    use super::*;
    use crate::hamiltonian::potential::tests::{By, normals};
    use crate::hamiltonian::potential::{Cause, Stop};

    #[test]
    fn it_comes_near_the_top_whatever_the_scales() {
        let mut x = vec![2.0, -3.0, 1.5, -0.5];
        let mut target = normals(vec![1e-3, 0.1, 1.0, 1e3]);
        let mut gradient = vec![0.0; 4];
        let low = evaluate(&mut target, &x, &mut gradient).expect("a point of the target");
        assert_eq!(climb(&mut target, &mut x, 100), 100);
        let high = evaluate(&mut target, &x, &mut gradient).expect("a point of the target");
        assert!(low < -1e6 && high > -200.0, "{low} {high}");
    }

    #[test]
    fn it_never_ends_lower_and_no_step_is_no_move() {
        let mut target = normals(vec![1e-6]);
        let mut x = vec![1e-7];
        climb(&mut target, &mut x, 20);
        assert_eq!(x, [1e-7]);
        let mut x = vec![0.7];
        assert_eq!(climb(&mut target, &mut x, 0), 0);
        assert_eq!(x, [0.7]);
    }

    #[test]
    fn a_refusal_ends_the_way() {
        let mut walled = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 1.0;
            if x[0] < 1.0 { Ok(x[0]) } else { Err(Stop { cause: Cause::Guard, place: 0 }) }
        });
        let mut x = vec![0.0];
        let taken = climb(&mut walled, &mut x, 100);
        assert!(taken < 100 && (0.5..1.0).contains(&x[0]), "{taken} {}", x[0]);
    }
}
