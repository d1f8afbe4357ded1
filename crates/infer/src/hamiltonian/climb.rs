//! Steps uphill before a chain: from a run of the prior, which tight constraints leave thousands of nats below all that
//! is likely, to where trajectories start well.
//!
//! Each coordinate moves by the size of its own slopes (Kingma & Ba 2015, algorithm 1), a step shorter each time by the
//! same ratio. Coarse steps pass over small summits, which a line search would stop at. Where it ends is a start and no
//! draw: the warm-up that follows makes it one, and chains from different runs end on different summits.

use super::lanes::Wide;
use super::potential::{Potential, evaluate};

/// Length of the first step and of the last, in unconstrained coordinates.
const FIRST: f64 = 0.2;
const LAST: f64 = 0.01;
/// How much of the mean slope, and of the mean squared slope, is remembered from one step to the next.
const SLOPE_MEMORY: f64 = 0.9;
const SIZE_MEMORY: f64 = 0.99;
/// Keeps a coordinate without any slope where it is.
const TINY: f64 = 1e-9;

/// A way uphill.
struct Way {
    /// Where the next gradient is taken.
    at: Vec<f64>,
    /// The highest point so far, and how high it is, nats.
    top: Vec<f64>,
    height: f64,
    slope: Vec<f64>,
    size: Vec<f64>,
    slope_share: f64,
    size_share: f64,
    taken: u32,
    /// Whether the target refused a point.
    is_over: bool,
}

impl Way {
    fn from(x: &[f64]) -> Way {
        let none = vec![0.0; x.len()];
        Way {
            at: x.to_vec(),
            top: x.to_vec(),
            height: f64::NEG_INFINITY,
            slope: none.clone(),
            size: none,
            slope_share: 1.0,
            size_share: 1.0,
            taken: 0,
            is_over: false,
        }
    }

    /// One of `steps` steps, by the value and the gradient here.
    fn step(&mut self, value: f64, gradient: impl Iterator<Item = f64>, steps: u32) {
        if value > self.height {
            self.height = value;
            self.top.copy_from_slice(&self.at);
        }
        self.slope_share *= SLOPE_MEMORY;
        self.size_share *= SIZE_MEMORY;
        let step = FIRST * (LAST / FIRST).powf(f64::from(self.taken) / f64::from(steps));
        let rows = self.at.iter_mut().zip(&mut self.slope).zip(&mut self.size).zip(gradient);
        for (((at, slope), size), g) in rows {
            *slope = SLOPE_MEMORY * *slope + (1.0 - SLOPE_MEMORY) * g;
            *size = SIZE_MEMORY * *size + (1.0 - SIZE_MEMORY) * g * g;
            let mean = *slope / (1.0 - self.slope_share);
            *at += step * mean / ((*size / (1.0 - self.size_share)).sqrt() + TINY);
        }
        self.taken += 1;
    }

    /// The same, by what its own target says.
    fn step_alone(&mut self, target: &mut (impl Potential + ?Sized), gradient: &mut [f64], steps: u32) {
        match evaluate(target, &self.at, gradient) {
            Ok(value) => self.step(value, gradient.iter().copied(), steps),
            Err(_) => (self.taken, self.is_over) = (self.taken + 1, true),
        }
    }
}

/// Moves `x` uphill, to the highest point of `steps` steps; gives the number of gradients taken. A point that the target
/// refuses ends the way before it.
pub fn climb(target: &mut (impl Potential + ?Sized), x: &mut [f64], steps: u32) -> u32 {
    let (mut way, mut gradient) = (Way::from(x), vec![0.0; x.len()]);
    while way.taken < steps && !way.is_over {
        way.step_alone(target, &mut gradient, steps);
    }
    x.copy_from_slice(&way.top);
    way.taken
}

/// The same from several points side by side, at most `L`, each with a target of its own for where the wide density does
/// not cover it.
///
/// # Panics
/// For more than `L` points.
pub fn climb_in_lanes<const L: usize>(
    targets: &mut [&mut impl Potential],
    starts: &mut [&mut Vec<f64>],
    wide: &mut impl Wide<L>,
    steps: u32,
) -> Vec<u32> {
    assert!(starts.len() <= L, "a lane for each point");
    let dim = starts.first().map_or(0, |start| start.len());
    let mut ways: Vec<Way> = starts.iter().map(|start| Way::from(start)).collect();
    let (mut x, mut g, mut one) = (vec![[0.0; L]; dim], vec![[0.0; L]; dim], vec![0.0; dim]);
    for _ in 0..steps {
        if ways.iter().all(|way| way.is_over) {
            break;
        }
        for l in 0..L {
            // Lanes without a point stand where the first one does.
            let way = ways.get(l).unwrap_or(&ways[0]);
            x.iter_mut().zip(&way.at).for_each(|(row, x)| row[l] = *x);
        }
        let (values, covered) = wide.value_and_gradient(&x, &mut g);
        for (l, (way, target)) in ways.iter_mut().zip(targets.iter_mut()).enumerate() {
            if way.is_over {
                continue;
            }
            if covered[l] && values[l].is_finite() && g.iter().all(|row| row[l].is_finite()) {
                way.step(values[l], g.iter().map(|row| row[l]), steps);
            } else {
                way.step_alone(&mut **target, &mut one, steps);
            }
        }
    }
    starts.iter_mut().zip(&ways).for_each(|(start, way)| start.copy_from_slice(&way.top));
    ways.iter().map(|way| way.taken).collect()
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
