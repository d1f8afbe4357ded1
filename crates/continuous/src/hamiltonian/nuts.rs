//! The no-U-turn sampler: a trajectory is doubled, forwards or backwards at random, until it turns back.
//!
//! A point of the trajectory is kept with probability proportional to `exp(-H)` (Betancourt 2017, appendix A.3.1:
//! multinomial, with progressive sampling biased towards the newer half at the doublings). A stretch whose momenta
//! sum to `rho` has turned when `v_first . rho <= 0` or `v_last . rho <= 0` (appendix A.4.2), checked for every subtree
//! and, as in Stan since 2.21, of each half together with the nearest end of the other.

use super::leapfrog::{Phase, add, dot, leapfrog};
use super::metric::Metric;
use super::potential::Potential;
use super::transition::{Divergence, Transition, acceptance};
use niwaki_math::Stream;
use niwaki_math::log_sums::log_add_exp;

/// A trajectory that ends where it turns back.
#[derive(Clone, Debug)]
pub struct Nuts {
    /// Most doublings: a trajectory has at most `2^max_depth - 1` steps.
    pub max_depth: u32,
    /// An energy error above this many nats is a divergence.
    pub max_energy_error: f64,
    /// Stretches to be used again.
    spare: Vec<Vec<f64>>,
}

/// A stretch of a trajectory, in the direction in which it was grown.
struct Stretch {
    /// Seven vectors, one after the other: see [`Part`]. In one piece, so that a stretch is made and dropped quickly.
    vectors: Vec<f64>,
    /// Log of the sum of `exp(H_start - H)` over its points.
    log_weight: f64,
    /// Log density at the chosen point.
    log_density: f64,
    /// The Hamiltonian at the chosen point.
    energy: f64,
}

/// The vectors of a stretch.
#[derive(Clone, Copy)]
enum Part {
    /// Momentum at its oldest point.
    FirstP,
    /// Velocity at its oldest point.
    FirstV,
    /// Momentum at its newest point.
    LastP,
    /// Velocity at its newest point.
    LastV,
    /// The sum of its momenta.
    Rho,
    /// The point drawn from it.
    X,
    /// The gradient there.
    Gradient,
}

impl Stretch {
    /// One of its vectors.
    #[inline]
    fn part(&self, part: Part) -> &[f64] {
        let dim = self.vectors.len() / 7;
        &self.vectors[part as usize * dim..(part as usize + 1) * dim]
    }

    /// The places of a run of vectors.
    #[inline]
    fn places(&self, from: Part, to: Part) -> std::ops::Range<usize> {
        let dim = self.vectors.len() / 7;
        from as usize * dim..(to as usize + 1) * dim
    }

    /// Reverses its direction.
    fn turn_around(&mut self) {
        let half = self.places(Part::FirstP, Part::FirstV).end;
        let (first, rest) = self.vectors.split_at_mut(half);
        first.swap_with_slice(&mut rest[..half]);
    }
}

/// The state of a trajectory while it grows.
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
        let mut whole = growth.leaf(phase, start_energy);
        let (mut depth, mut moved) = (0, false);
        while depth < self.max_depth {
            let forwards = growth.stream.uniform() < 0.5;
            let (edge, signed) = if forwards { (&mut front, step) } else { (&mut back, -step) };
            depth += 1;
            let Some(newer) = growth.grow(edge, signed, depth - 1) else { break };
            if !forwards {
                whole.turn_around();
            }
            // Biased towards the newer half: min(1, w_new / w_old).
            let take = growth.stream.uniform() < acceptance(newer.log_weight - whole.log_weight);
            moved |= take;
            let turned = growth.join(&mut whole, newer, take);
            if !forwards {
                whole.turn_around();
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
        phase.x.copy_from_slice(whole.part(Part::X));
        phase.gradient.copy_from_slice(whole.part(Part::Gradient));
        phase.log_density = whole.log_density;
        let energy = whole.energy;
        self.spare.push(whole.vectors);
        let accept = if steps > 0 { accepts / f64::from(steps) } else { 0.0 };
        Transition { accept, moved, steps, depth, start_energy, energy, divergence }
    }
}

impl<P: Potential + ?Sized> Growth<'_, P> {
    /// The stretch of one point, in memory that was used before where there is some.
    fn leaf(&mut self, at: &Phase, energy: f64) -> Stretch {
        let mut vectors = self.spare.pop().unwrap_or_default();
        vectors.clear();
        for part in [&at.p, &at.v, &at.p, &at.v, &at.p, &at.x, &at.gradient] {
            vectors.extend_from_slice(part);
        }
        Stretch { vectors, log_weight: self.start_energy - energy, log_density: at.log_density, energy }
    }

    /// `2^depth` more points beyond `edge`; None when the target refused one, the energy drifted too far, or a
    /// subtree turned back: then none of them may be chosen.
    fn grow(&mut self, edge: &mut Phase, step: f64, depth: u32) -> Option<Stretch> {
        if depth == 0 {
            let refused = leapfrog(self.target, self.metric, edge, step, 1).err();
            self.steps += 1;
            let energy = if refused.is_some() { f64::NAN } else { edge.energy() };
            let energy_error = energy - self.start_energy;
            self.accepts += acceptance(-energy_error);
            if energy_error.is_nan() || energy_error > self.max_energy_error {
                self.broken = Some((energy_error, refused, edge.x.clone()));
                return None;
            }
            return Some(self.leaf(edge, energy));
        }
        let mut older = self.grow(edge, step, depth - 1)?;
        let Some(newer) = self.grow(edge, step, depth - 1) else {
            self.spare.push(older.vectors);
            return None;
        };
        // Within a subtree every point has its own weight: w_new / (w_old + w_new).
        let total = log_add_exp(older.log_weight, newer.log_weight);
        let take = self.stream.uniform() < acceptance(newer.log_weight - total);
        if self.join(&mut older, newer, take) {
            self.spare.push(older.vectors);
            return None;
        }
        Some(older)
    }

    /// Lengthens `older` by the `newer` stretch that follows it; with `take` it takes the chosen point of `newer`. True when
    /// the two together have turned back.
    fn join(&mut self, older: &mut Stretch, newer: Stretch, take: bool) -> bool {
        use Part::{FirstP, FirstV, Gradient, LastP, LastV, Rho, X};
        let turns = |v: &[f64], p: &[f64], rho: &[f64]| dot(v, p) + dot(v, rho) <= 0.0;
        // Each half with the nearest end of the other: catches a turn that the halves are symmetric about.
        let across = turns(older.part(FirstV), newer.part(FirstP), older.part(Rho))
            || turns(newer.part(FirstV), newer.part(FirstP), older.part(Rho))
            || turns(older.part(LastV), older.part(LastP), newer.part(Rho))
            || turns(newer.part(LastV), older.part(LastP), newer.part(Rho));
        let sum = older.places(Rho, Rho);
        add(&mut older.vectors[sum], 1.0, newer.part(Rho));
        let end = older.places(LastP, LastV);
        older.vectors[end.clone()].copy_from_slice(&newer.vectors[end]);
        let turned =
            dot(older.part(FirstV), older.part(Rho)) <= 0.0 || dot(older.part(LastV), older.part(Rho)) <= 0.0;
        older.log_weight = log_add_exp(older.log_weight, newer.log_weight);
        if take {
            let point = older.places(X, Gradient);
            older.vectors[point.clone()].copy_from_slice(&newer.vectors[point]);
            (older.log_density, older.energy) = (newer.log_density, newer.energy);
        }
        self.spare.push(newer.vectors);
        turned || across
    }
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
            let result = transition(&mut normals(vec![1.0; 5]), &[0.5, -0.5, 1.0, 0.1, 0.7], 0.1, 10, seed);
            assert!((15..=63).contains(&result.steps), "{result:?}");
            assert!(result.divergence.is_none() && result.accept > 0.9);
        }
    }

    #[test]
    fn trajectories_are_as_long_as_an_independent_samplers() {
        // BlackJAX 1.7.1's NUTS on the same normals (deviations 1 + i / dim, unit metric), 20 000 transitions: mean steps
        // and acceptance. Both means have a standard error of about 0.3 %; we check the two halves as well, and BlackJAX
        // takes half of the end momenta off the sum, which makes some 3 % at 50 coordinates.
        for (dim, step, steps, accept, within) in
            [(1, 0.9, 2.8635, 0.9386, 0.01), (10, 0.5, 12.528, 0.9672, 0.01), (50, 0.3, 20.514, 0.9755, 0.04)]
        {
            let mut target = normals((0..dim).map(|i| 1.0 + f64::from(i) / f64::from(dim)).collect());
            let mut phase = Phase::at(&mut target, &vec![0.5; dim as usize]).expect("a point of the target");
            let (metric, mut nuts) = (Metric::unit(dim as usize), Nuts::new(10, 1000.0));
            let (mut total, mut accepts, n) = (0.0, 0.0, 20_000);
            for visit in 0..n {
                let mut stream = Stream::new(5, 0, 0, visit);
                let result = nuts.step(&mut target, &metric, step, &mut phase, &mut stream);
                total += f64::from(result.steps) / n as f64;
                accepts += result.accept / n as f64;
            }
            assert!((total / steps - 1.0).abs() < within, "{dim}: {total}");
            assert!((accepts - accept).abs() < 0.002, "{dim}: {accepts}");
        }
    }

    #[test]
    fn it_never_turns_on_a_slope_and_stops_at_its_depth() {
        let mut slope = By(2, |x: &[f64], g: &mut [f64]| {
            g.copy_from_slice(&[1e-6, 0.0]);
            Ok(1e-6 * x[0])
        });
        let result = transition(&mut slope, &[0.0, 0.0], 0.01, 6, 4);
        assert_eq!((result.steps, result.depth), (63, 6));
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
            let result =
                Nuts::new(20, 1000.0).step(&mut walled, &Metric::unit(1), 0.3, &mut phase, &mut stream);
            assert_eq!(result.divergence.as_ref().and_then(|d| d.stop), Some(guard));
            assert!(phase.x[0].abs() < 2.0);
        }
    }
}
