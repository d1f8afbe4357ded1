//! The no-U-turn sampler: a trajectory is doubled, forwards or backwards at random, until it turns back.
//!
//! A point of the trajectory is kept with probability proportional to `exp(-H)` (Betancourt 2017, appendix A.3.1:
//! multinomial, with progressive sampling biased towards the newer half at the doublings). A stretch whose momenta
//! sum to `rho` has turned when `v_first . rho <= 0` or `v_last . rho <= 0` (appendix A.4.2), asked of every subtree
//! and, as in Stan since 2.21, of each half together with the nearest end of the other.

use super::leapfrog::{Phase, add, dot, leapfrog};
use super::metric::Metric;
use super::potential::Potential;
use super::transition::{Divergence, Transition, acceptance};
use niwaki_math::Stream;

/// A length that the trajectory finds.
#[derive(Clone, Debug)]
pub struct Nuts {
    /// Most doublings: a trajectory has at most `2^max_depth - 1` steps.
    pub max_depth: u32,
    /// An energy error above this many nats is a divergence.
    pub max_energy_error: f64,
    /// Vectors to be used again.
    spare: Vec<Vec<f64>>,
}

/// A stretch of a trajectory, in the direction in which it was grown.
struct Stretch {
    /// Momentum and velocity at its oldest point.
    first: End,
    /// Momentum and velocity at its newest point.
    last: End,
    /// The sum of its momenta.
    rho: Vec<f64>,
    /// Log of the sum of `exp(H_start - H)` over its points.
    log_weight: f64,
    /// The point drawn from it.
    chosen: Point,
}

/// Momentum and velocity.
struct End {
    p: Vec<f64>,
    v: Vec<f64>,
}

/// A position with what is known of the target there.
struct Point {
    x: Vec<f64>,
    gradient: Vec<f64>,
    log_density: f64,
    energy: f64,
}

/// What a trajectory carries along while it grows.
struct Growth<'a, P: ?Sized> {
    target: &'a mut P,
    metric: &'a Metric,
    stream: &'a mut Stream,
    spare: &'a mut Vec<Vec<f64>>,
    max_energy_error: f64,
    start_energy: f64,
    steps: u32,
    accepts: f64,
    broken: Option<(f64, Option<super::potential::Stop>, Vec<f64>)>,
}

impl Nuts {
    /// At most `max_depth` doublings, at least one.
    pub fn new(max_depth: u32, max_energy_error: f64) -> Nuts {
        Nuts { max_depth: max_depth.clamp(1, 30), max_energy_error, spare: Vec::new() }
    }

    /// One transition of `phase`.
    pub fn step(
        &mut self,
        target: &mut (impl Potential + ?Sized),
        metric: &Metric,
        step: f64,
        phase: &mut Phase,
        stream: &mut Stream,
    ) -> Transition {
        phase.refresh(metric, stream);
        let start_energy = phase.energy();
        let mut growth = Growth {
            target,
            metric,
            stream,
            spare: &mut self.spare,
            max_energy_error: self.max_energy_error,
            start_energy,
            steps: 0,
            accepts: 0.0,
            broken: None,
        };

        // The two ends of the trajectory, and the whole of it, `last` in front.
        let (mut front, mut back) = (phase.clone(), phase.clone());
        let mut whole = growth.leaf(phase, 0.0);
        let (mut depth, mut moved) = (0, false);
        while depth < self.max_depth {
            let forwards = growth.stream.uniform() < 0.5;
            let (edge, signed) = if forwards { (&mut front, step) } else { (&mut back, -step) };
            depth += 1;
            let Some(newer) = growth.grow(edge, signed, depth - 1) else { break };
            if !forwards {
                std::mem::swap(&mut whole.first, &mut whole.last);
            }
            // Biased towards the newer half: min(1, w_new / w_old).
            let take = growth.stream.uniform() < acceptance(newer.log_weight - whole.log_weight);
            moved |= take;
            let turned = growth.join(&mut whole, newer, take);
            if !forwards {
                std::mem::swap(&mut whole.first, &mut whole.last);
            }
            if turned {
                break;
            }
        }

        let Growth { steps, accepts, broken, .. } = growth;
        let divergence = broken.map(|(energy_error, stop, end)| Divergence {
            start: phase.x.clone(),
            end,
            energy_error,
            stop,
        });
        phase.x.copy_from_slice(&whole.chosen.x);
        phase.gradient.copy_from_slice(&whole.chosen.gradient);
        phase.log_density = whole.chosen.log_density;
        let energy = whole.chosen.energy;
        whole.give_back(&mut self.spare);
        let accept = if steps > 0 { accepts / f64::from(steps) } else { 0.0 };
        Transition { accept, moved, steps, depth, start_energy, energy, divergence }
    }
}

impl<P: Potential + ?Sized> Growth<'_, P> {
    /// A copy of a vector, in memory that was used before where there is some.
    fn copy(&mut self, of: &[f64]) -> Vec<f64> {
        let mut made = self.spare.pop().unwrap_or_default();
        made.clear();
        made.extend_from_slice(of);
        made
    }

    /// The stretch of one point.
    fn leaf(&mut self, at: &Phase, log_weight: f64) -> Stretch {
        Stretch {
            first: End { p: self.copy(&at.p), v: self.copy(&at.v) },
            last: End { p: self.copy(&at.p), v: self.copy(&at.v) },
            rho: self.copy(&at.p),
            log_weight,
            chosen: Point {
                x: self.copy(&at.x),
                gradient: self.copy(&at.gradient),
                log_density: at.log_density,
                energy: at.energy(),
            },
        }
    }

    /// `2^depth` more points beyond `edge`; None when the target refused one, the energy drifted too far, or a
    /// subtree turned back: then none of them may be chosen.
    fn grow(&mut self, edge: &mut Phase, step: f64, depth: u32) -> Option<Stretch> {
        if depth == 0 {
            let refused = leapfrog(self.target, self.metric, edge, step, 1).err();
            self.steps += 1;
            let energy_error = if refused.is_some() { f64::NAN } else { edge.energy() - self.start_energy };
            self.accepts += acceptance(-energy_error);
            // Written so that a NaN is a divergence.
            if !(energy_error <= self.max_energy_error) {
                self.broken = Some((energy_error, refused, edge.x.clone()));
                return None;
            }
            return Some(self.leaf(edge, -energy_error));
        }
        let mut older = self.grow(edge, step, depth - 1)?;
        let Some(newer) = self.grow(edge, step, depth - 1) else {
            older.give_back(self.spare);
            return None;
        };
        // Within a subtree every point has its own weight: w_new / (w_old + w_new).
        let total = log_add(older.log_weight, newer.log_weight);
        let take = self.stream.uniform() < acceptance(newer.log_weight - total);
        if self.join(&mut older, newer, take) {
            older.give_back(self.spare);
            return None;
        }
        Some(older)
    }

    /// Lengthens `older` by the `newer` stretch that follows it, whose chosen point it takes if told to; true when
    /// the two together have turned.
    fn join(&mut self, older: &mut Stretch, newer: Stretch, take: bool) -> bool {
        // Each half with the nearest end of the other: catches a turn that the halves are symmetric about.
        let (first, middle, second, last) = (&older.first, &older.last, &newer.first, &newer.last);
        let across = dot(&first.v, &second.p) + dot(&first.v, &older.rho) <= 0.0
            || dot(&second.v, &second.p) + dot(&second.v, &older.rho) <= 0.0
            || dot(&middle.v, &middle.p) + dot(&middle.v, &newer.rho) <= 0.0
            || dot(&last.v, &middle.p) + dot(&last.v, &newer.rho) <= 0.0;
        add(&mut older.rho, 1.0, &newer.rho);
        let turned = dot(&older.first.v, &older.rho) <= 0.0 || dot(&newer.last.v, &older.rho) <= 0.0;
        older.log_weight = log_add(older.log_weight, newer.log_weight);
        let Stretch { first, last, rho, chosen, .. } = newer;
        let End { p, v } = std::mem::replace(&mut older.last, last);
        let left = if take { std::mem::replace(&mut older.chosen, chosen) } else { chosen };
        self.spare.extend([first.p, first.v, rho, p, v, left.x, left.gradient]);
        turned || across
    }
}

impl Stretch {
    /// Leaves its vectors to be used again.
    fn give_back(self, spare: &mut Vec<Vec<f64>>) {
        let Stretch { first, last, rho, chosen, .. } = self;
        spare.extend([first.p, first.v, last.p, last.v, rho, chosen.x, chosen.gradient]);
    }
}

/// `ln(exp(a) + exp(b))`.
fn log_add(a: f64, b: f64) -> f64 {
    let (large, small) = if a > b { (a, b) } else { (b, a) };
    if large == f64::NEG_INFINITY { large } else { large + (small - large).exp().ln_1p() }
}

#[cfg(test)]
mod tests {
    //! A trajectory stops as it turns; a refusal ends it; the depth bounds its steps.
    use super::*;
    use crate::hamiltonian::potential::tests::{By, normals};
    use crate::hamiltonian::potential::{Cause, Stop};

    fn transition(target: &mut impl Potential, x: &[f64], step: f64, depth: u32, seed: u64) -> Transition {
        let mut phase = Phase::at(target, x).expect("a point of the target");
        let metric = Metric::unit(x.len());
        Nuts::new(depth, 1000.0).step(target, &metric, step, &mut phase, &mut Stream::new(seed, 0, 0, 0))
    }

    #[test]
    fn it_goes_half_way_round_a_normal() {
        // A period is 2 pi: half of it is some 31 steps of 0.1. Doublings overshoot by at most a factor of 2 or so.
        for seed in 0..20 {
            let made = transition(&mut normals(vec![1.0; 5]), &[0.5, -0.5, 1.0, 0.1, 0.7], 0.1, 10, seed);
            assert!((15..=63).contains(&made.steps), "{made:?}");
            assert!(made.divergence.is_none() && made.accept > 0.9);
        }
    }

    #[test]
    fn it_never_turns_on_a_slope_and_stops_at_its_depth() {
        let mut slope = By(2, |x: &[f64], g: &mut [f64]| {
            g.copy_from_slice(&[1e-6, 0.0]);
            Ok(1e-6 * x[0])
        });
        let made = transition(&mut slope, &[0.0, 0.0], 0.01, 6, 4);
        assert_eq!((made.steps, made.depth), (63, 6));
    }

    #[test]
    fn a_refusal_ends_it_and_keeps_what_was_valid() {
        let guard = Stop { cause: Cause::Guard, place: 3 };
        let mut walled = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = 0.0;
            if x[0].abs() < 2.0 { Ok(0.0) } else { Err(guard) }
        });
        for seed in 0..50 {
            let mut phase = Phase::at(&mut walled, &[0.1]).expect("a point of the target");
            let mut stream = Stream::new(seed, 0, 0, 0);
            let made =
                Nuts::new(20, 1000.0).step(&mut walled, &Metric::unit(1), 0.3, &mut phase, &mut stream);
            assert_eq!(made.divergence.as_ref().and_then(|d| d.stop), Some(guard));
            assert!(phase.x[0].abs() < 2.0);
        }
    }
}
