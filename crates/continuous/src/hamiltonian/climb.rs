//! Steps uphill before a chain. With tight constraints a run of the prior is thousands of nats below the likely runs;
//! the ascent goes to a point where trajectories start well.
//!
//! Each coordinate moves by the size of its own slopes (Kingma & Ba 2015, algorithm 1). Coarse steps pass over small
//! maxima, where a line search would stop. Steps become finer where the height fluctuates more than it grows. The ascent
//! ends where both are smaller than the fluctuation of draws. Its end is a start and not a draw; the warm-up follows.
//! Chains from different runs may end at different maxima.

use super::lanes::{Wide, finite};
use super::potential::{Potential, evaluate};

/// Length of the first step, in unconstrained coordinates, and of one that is too short to go on with.
const FIRST: f64 = 0.2;
const LAST: f64 = 0.002;
/// The share of a step that is left where the height fluctuates.
const FINER: f64 = 0.7;
/// How much of the mean slope, and of the mean squared slope, is remembered from one step to the next.
const MEMORY: f64 = 0.95;
/// Steps between two checks of the height: this many, or a tenth of the steps so far.
const LOOK: u32 = 20;
/// Heights of draws fluctuate by the root of half the dimension, if the density is nearly normal. A gain between two
/// checks below a few times this is no gain.
const LITTLE: f64 = 3.0;
/// Keeps a coordinate without any slope where it is.
const TINY: f64 = 1e-9;

/// An ascent uphill.
struct Ascent {
    /// Where the next gradient is taken.
    at: Vec<f64>,
    /// The highest point so far, and how high it is, nats.
    top: Vec<f64>,
    height: f64,
    slope: Vec<f64>,
    size: Vec<f64>,
    /// The share of the initial zeros in the means of slopes and sizes.
    share: f64,
    step: f64,
    heights: Vec<f64>,
    /// Mean height of the steps before the last check.
    before: f64,
    steps_done: u32,
    is_over: bool,
}

impl Ascent {
    fn from(x: &[f64], steps: u32) -> Ascent {
        let none = vec![0.0; x.len()];
        Ascent {
            at: x.to_vec(),
            top: x.to_vec(),
            height: f64::NEG_INFINITY,
            slope: none.clone(),
            size: none,
            share: 1.0,
            step: FIRST,
            heights: vec![],
            before: f64::NEG_INFINITY,
            steps_done: 0,
            is_over: steps == 0,
        }
    }

    /// One of at most `steps` steps, by the value and the gradient here.
    fn step(&mut self, value: f64, gradient: impl Iterator<Item = f64>, steps: u32) {
        if value > self.height {
            self.height = value;
            self.top.copy_from_slice(&self.at);
        }
        self.steps_done += 1;
        self.check(value);
        self.is_over |= self.steps_done == steps;
        self.share *= MEMORY;
        let rows = self.at.iter_mut().zip(&mut self.slope).zip(&mut self.size).zip(gradient);
        for (((at, slope), size), g) in rows {
            *slope = MEMORY * *slope + (1.0 - MEMORY) * g;
            *size = MEMORY * *size + (1.0 - MEMORY) * g * g;
            let unbiased = 1.0 / (1.0 - self.share);
            *at += self.step * (*slope * unbiased) / ((*size * unbiased).sqrt() + TINY);
        }
    }

    /// Checks regularly whether steps are too long, or bring no gain.
    fn check(&mut self, value: f64) {
        self.heights.push(value);
        if self.heights.len() < LOOK.max(self.steps_done / 10) as usize {
            return;
        }
        let count = self.heights.len() as f64;
        let mean = self.heights.iter().sum::<f64>() / count;
        let wavers = (self.heights.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / count).sqrt();
        let gain = mean - self.before;
        if gain < wavers {
            self.step *= FINER;
        }
        let little = LITTLE * (0.5 * self.at.len() as f64).sqrt();
        self.is_over = self.step < LAST || gain.abs() + wavers < little;
        self.before = mean;
        self.heights.clear();
    }

    /// Take a step with the ascent's own target.
    fn step_alone(&mut self, target: &mut (impl Potential + ?Sized), gradient: &mut [f64], steps: u32) {
        match evaluate(target, &self.at, gradient) {
            Ok(value) => self.step(value, gradient.iter().copied(), steps),
            Err(_) => (self.steps_done, self.is_over) = (self.steps_done + 1, true),
        }
    }
}

/// Moves `x` uphill, to the highest point of at most `steps` steps; returns the number of gradients. A point that the
/// target refuses ends the ascent before it.
pub fn climb(target: &mut (impl Potential + ?Sized), x: &mut [f64], steps: u32) -> u32 {
    let (mut ascent, mut gradient) = (Ascent::from(x, steps), vec![0.0; x.len()]);
    while !ascent.is_over {
        ascent.step_alone(target, &mut gradient, steps);
    }
    x.copy_from_slice(&ascent.top);
    ascent.steps_done
}

/// Climb from several points, `L` of them in parallel. Each has its own target for points that the wide density does
/// not cover. Where an ascent ends, the next point takes its lane.
pub fn climb_in_lanes<const L: usize>(
    targets: &mut [&mut impl Potential],
    starts: &mut [&mut Vec<f64>],
    wide: &mut impl Wide<L>,
    steps: u32,
) -> Vec<u32> {
    let dim = starts.first().map_or(0, |start| start.len());
    let mut ascents: Vec<Ascent> = starts.iter().map(|start| Ascent::from(start, steps)).collect();
    let (mut x, mut g, mut gradient) = (vec![[0.0; L]; dim], vec![[0.0; L]; dim], vec![0.0; dim]);
    let mut waiting = (0..ascents.len()).take_while(|_| steps > 0);
    let mut lanes: [Option<usize>; L] = [(); L].map(|()| waiting.next());
    while let Some(first) = lanes.iter().flatten().next().copied() {
        for (l, lane) in lanes.iter().enumerate() {
            // Lanes without a point copy the first lane.
            let ascent = &ascents[lane.unwrap_or(first)];
            x.iter_mut().zip(&ascent.at).for_each(|(row, x)| row[l] = *x);
        }
        let (values, covered) = wide.value_and_gradient(&x, &mut g);
        let finite = finite(&g);
        for (l, lane) in lanes.iter_mut().enumerate() {
            let Some(number) = *lane else { continue };
            let ascent = &mut ascents[number];
            if covered[l] && values[l].is_finite() && finite[l] {
                ascent.step(values[l], g.iter().map(|row| row[l]), steps);
            } else {
                ascent.step_alone(&mut *targets[number], &mut gradient, steps);
            }
            if ascent.is_over {
                *lane = waiting.next();
            }
        }
    }
    starts.iter_mut().zip(&ascents).for_each(|(start, ascent)| start.copy_from_slice(&ascent.top));
    ascents.iter().map(|ascent| ascent.steps_done).collect()
}

#[cfg(test)]
mod tests {
    //! The ascent finds the maximum when some coordinates are steep and others flat, stays inside the support, and never
    //! ends lower.
    use super::*;
    use crate::hamiltonian::potential::tests::{By, normals};
    use crate::hamiltonian::potential::{Cause, Stop};

    #[test]
    fn it_comes_near_the_top_whatever_the_scales() {
        let mut x = vec![2.0, -3.0, 1.5, -0.5];
        let mut target = normals(vec![1e-3, 0.1, 1.0, 1e3]);
        let mut gradient = vec![0.0; 4];
        let low = evaluate(&mut target, &x, &mut gradient).expect("a point of the target");
        let steps = climb(&mut target, &mut x, 1000);
        let high = evaluate(&mut target, &x, &mut gradient).expect("a point of the target");
        assert!(low < -1e6 && high > -3.0, "{low} {high}");
        assert!(steps > 100 && steps < 1000, "ends by itself, after {steps}");
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
    fn a_refusal_ends_the_ascent() {
        let mut walled = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 1.0;
            if x[0] < 1.0 { Ok(x[0]) } else { Err(Stop { cause: Cause::Guard, place: 0 }) }
        });
        let mut x = vec![0.0];
        let steps = climb(&mut walled, &mut x, 100);
        assert!(steps < 100 && (0.5..1.0).contains(&x[0]), "{steps} {}", x[0]);
    }
}
