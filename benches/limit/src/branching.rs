//! The recursive branching program, with an explicit stack of pending segments in each particle.
//!
//! A segment draws an angle, a length and whether it forks; its weight says how near its end lies to the
//! circle of radius depth + 1. A particle that has no pending segment has ended and weighs one.
use crate::Run;
use crate::population::{Random, resample, uniform};
use rand_distr::{Distribution, StandardNormal};

/// Segments end at depth 5, counted from 0, so no path is longer than six.
const DEEPEST: u32 = 5;
/// Added to each segment's log weight; it keeps trees at about a hundred choices under resampling.
const BONUS: f64 = 0.35;

/// A segment to grow: where from, in which direction (radians), how deep.
#[derive(Clone, Copy, Default)]
struct Pending {
    x: f64,
    y: f64,
    heading: f64,
    depth: u32,
}

/// A particle: its stack. Depth first, so at most one sibling waits at each depth.
#[derive(Clone, Copy)]
struct Particle {
    stack: [Pending; 8],
    pending: usize,
}

impl Particle {
    fn push(&mut self, segment: Pending) {
        self.stack[self.pending] = segment;
        self.pending += 1;
    }

    /// Grows the next segment and returns its weight; none when the particle has ended.
    fn step(&mut self, random: &mut Random) -> Option<f64> {
        self.pending = self.pending.checked_sub(1)?;
        let from = self.stack[self.pending];
        let normal: f64 = StandardNormal.sample(random);
        let angle = from.heading + 0.3 * normal;
        let length = 0.5 + uniform(random);
        let (sin, cos) = angle.sin_cos();
        let (x, y) = (from.x + length * cos, from.y + length * sin);
        let error = ((x * x + y * y).sqrt() - f64::from(from.depth + 1)) / 1.5;
        if from.depth < DEEPEST {
            let depth = from.depth + 1;
            if uniform(random) < 0.7 {
                self.push(Pending { x, y, heading: angle - 0.5, depth });
                self.push(Pending { x, y, heading: angle + 0.5, depth });
            } else {
                self.push(Pending { x, y, heading: angle, depth });
            }
        }
        Some((BONUS - 0.5 * error * error).exp())
    }
}

/// One run of the filter: every particle grows one segment, then all are resampled, until all have ended.
pub fn filter(particles: usize, random: &mut Random) -> Run {
    let mut rows = vec![Particle { stack: [Pending::default(); 8], pending: 1 }; particles];
    let mut survivors = rows.clone();
    let (mut weights, mut parents) = (vec![0.0; particles], vec![0u32; particles]);
    let (mut steps, mut log_evidence) = (0, 0.0);
    loop {
        let (mut total, mut alive) = (0.0, 0);
        for (row, weight) in rows.iter_mut().zip(&mut weights) {
            *weight = match row.step(random) {
                Some(weight) => {
                    alive += 1;
                    weight
                }
                None => 1.0,
            };
            total += *weight;
        }
        if alive == 0 {
            return Run { steps, log_evidence };
        }
        steps += alive;
        log_evidence += (total / particles as f64).ln();
        resample(&weights, total, random, &mut parents);
        for (survivor, &parent) in survivors.iter_mut().zip(&parents) {
            *survivor = rows[parent as usize];
        }
        std::mem::swap(&mut rows, &mut survivors);
    }
}
