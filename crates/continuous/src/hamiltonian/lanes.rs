//! Chains in lanes: trajectories of a fixed length, side by side in the lanes of one vector.
//!
//! Chains that move over one density differ in position, step size and scales. A group of them takes
//! each leapfrog step together, with one evaluation for all; momentum, acceptance and adaptation are each chain's own.
//! The operations on a lane are those of the leapfrog integrator, in its order. So a lane gives the bits that its chain
//! gives alone, if the wide density gives the bits of the chain's own target.
//!
//! Where the wide density does not cover a point, the chain's own target evaluates it.

#![allow(unsafe_code)] // Calls of functions compiled for AVX2 or AVX-512, after a check that the processor has it.

use super::chains::{Chain, Draws, Ongoing, Purpose, Settings};
use super::hmc::Start;
use super::leapfrog::Phase;
use super::metric::{Metric, Shape};
use super::potential::{Potential, Stop, evaluate, evaluate_gradient};
use super::transition::{Kernel, Transition};
use niwaki_grad::kernels::Vectors;
use niwaki_math::Stream;

/// A log density at several points at once. Coordinate `k` of lane `l` is `x[k][l]`, shapes are `(dim, L)`.
pub trait Wide<const L: usize> {
    /// The log densities, nats, with the gradients in `gradient`, and which lanes are covered. The values of
    /// other lanes have no meaning; their own target evaluates those points.
    fn value_and_gradient(&mut self, x: &[[f64; L]], gradient: &mut [[f64; L]]) -> ([f64; L], [bool; L]);

    /// The gradients alone.
    fn gradient(&mut self, x: &[[f64; L]], gradient: &mut [[f64; L]]) -> [bool; L];
}

/// Whether chains of these settings can go in lanes: trajectories of a fixed length, a scale for each coordinate.
pub fn suits(settings: &Settings) -> bool {
    matches!(settings.kernel(), Kernel::Hmc(_))
        && matches!(settings.shape, Shape::Unit | Shape::Diagonal)
        && matches!(settings.metric, None | Some(Metric::Diagonal { .. }))
}

/// With more than this share of points outside of the wide density, its chains go on alone.
const SHARE_OUTSIDE: f64 = 0.25;

/// Warms chains up, then draws, in lanes; `watch` is called with (chain, transitions so far). At most `L` chains, whose settings
/// [`suits`] accepts.
///
/// # Panics
/// For more than `L` chains.
pub fn run_in_lanes<P: Potential, const L: usize>(
    chains: Vec<Chain<P>>,
    wide: &mut impl Wide<L>,
    settings: &Settings,
    watch: &dyn Fn(usize, u32) -> bool,
) -> Vec<Draws> {
    assert!(chains.len() <= L, "a lane for each chain");
    let mut all: Vec<_> = chains.into_iter().map(|chain| Ongoing::new(chain, settings)).collect();
    let Some(first) = all.first() else { return vec![] };
    let mut lanes = Lanes::<L>::new(first.chain.phase.x.len());
    while !all.iter().all(Ongoing::is_over) {
        let going: Vec<usize> = (0..all.len()).filter(|&l| !all[l].is_over()).collect();
        let transitions = if lanes.outside > SHARE_OUTSIDE || going.len() * 4 < all.len() {
            going.iter().map(|&l| all[l].chain.advance()).collect()
        } else {
            let mut group: Vec<_> =
                all.iter_mut().filter(|c| !c.is_over()).map(|ongoing| &mut ongoing.chain).collect();
            lanes.advance(&mut group, wide)
        };
        for (&l, transition) in going.iter().zip(&transitions) {
            all[l].take(transition);
            all[l].check(&|done| watch(l, done));
        }
    }
    all.into_iter().map(Ongoing::finish).collect()
}

/// The memory of the chains of one group.
struct Lanes<const L: usize> {
    x: Vec<[f64; L]>,
    p: Vec<[f64; L]>,
    gradient: Vec<[f64; L]>,
    variance: Vec<[f64; L]>,
    /// One point of one lane.
    point: (Vec<f64>, Vec<f64>),
    /// The share of the last transitions' points that the wide density did not cover.
    outside: f64,
}

/// Coordinates of all lanes.
struct Rows<'a, const L: usize> {
    x: &'a mut [[f64; L]],
    p: &'a mut [[f64; L]],
    gradient: &'a [[f64; L]],
    variance: &'a [[f64; L]],
}

impl<const L: usize> Rows<'_, L> {
    #[inline(always)]
    fn drift(self, kick: &[f64; L], step: &[f64; L]) {
        let rows = self.x.iter_mut().zip(self.p).zip(self.variance).zip(self.gradient);
        for (((x, p), s), g) in rows {
            for l in 0..L {
                p[l] += kick[l] * g[l];
                x[l] += (step[l] * s[l]) * p[l];
            }
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn drift_avx2(self, kick: &[f64; L], step: &[f64; L]) {
        self.drift(kick, step);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
    fn drift_avx512(self, kick: &[f64; L], step: &[f64; L]) {
        self.drift(kick, step);
    }
}

/// For each lane, whether all its numbers are finite.
pub(crate) fn finite<const L: usize>(rows: &[[f64; L]]) -> [bool; L] {
    match Vectors::here() {
        // SAFETY: the processor has AVX-512.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { finite_avx512(rows) },
        // SAFETY: the processor has AVX2.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { finite_avx2(rows) },
        _ => finite_any(rows),
    }
}

/// A sum of zeros is zero only where every term was finite.
#[inline(always)]
fn finite_any<const L: usize>(rows: &[[f64; L]]) -> [bool; L] {
    let mut sums = [0.0; L];
    for row in rows {
        for (sum, x) in sums.iter_mut().zip(row) {
            *sum += x * 0.0;
        }
    }
    sums.map(|sum| sum == 0.0)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn finite_avx2<const L: usize>(rows: &[[f64; L]]) -> [bool; L] {
    finite_any(rows)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn finite_avx512<const L: usize>(rows: &[[f64; L]]) -> [bool; L] {
    finite_any(rows)
}

/// The kick and the step of each lane that still moves, after `done` steps; zeros for the others.
fn sizes<const L: usize>(lanes: &[Lane], done: u32) -> ([f64; L], [f64; L]) {
    let (mut kick, mut step) = ([0.0; L], [0.0; L]);
    for (l, lane) in lanes.iter().enumerate() {
        if lane.refused.is_none() && done < lane.start.steps {
            step[l] = lane.step;
            kick[l] = if done == 0 { 0.5 * lane.step } else { lane.step };
        }
    }
    (kick, step)
}

/// A lane's trajectory.
struct Lane {
    stream: Stream,
    start: Start,
    step: f64,
    refused: Option<Stop>,
}

impl<const L: usize> Lanes<L> {
    fn new(dim: usize) -> Self {
        let rows = || vec![[0.0; L]; dim];
        Lanes {
            x: rows(),
            p: rows(),
            gradient: rows(),
            variance: rows(),
            point: (vec![0.0; dim], vec![0.0; dim]),
            outside: 0.0,
        }
    }

    /// One transition of each chain.
    fn advance<P: Potential>(
        &mut self,
        chains: &mut [&mut Chain<P>],
        wide: &mut impl Wide<L>,
    ) -> Vec<Transition> {
        let mut lanes: Vec<Lane> =
            chains.iter_mut().enumerate().map(|(l, chain)| self.begin(l, chain)).collect();
        // Lanes without a chain copy the first lane.
        for l in chains.len()..L {
            for rows in [&mut self.x, &mut self.p, &mut self.gradient, &mut self.variance] {
                rows.iter_mut().for_each(|row| row[l] = row[0]);
            }
        }
        let longest = lanes.iter().map(|lane| lane.start.steps).max().unwrap_or(0);
        let (mut evaluated, mut outside, mut done) = (0_u64, 0_u64, 0);
        let mut refused: Vec<usize> = vec![];
        let (mut kick, mut step, mut arrival) = ([0.0; L], [0.0; L], 0);
        while done < longest {
            if done == arrival {
                (kick, step) = sizes(&lanes, done);
                let next = lanes.iter().map(|lane| lane.start.steps).filter(|steps| *steps > done).min();
                arrival = next.unwrap_or(longest);
            }
            self.drift(&kick, &step);
            if done == 0 {
                // The first kick is half of the others.
                kick = step;
            }
            done += 1;
            evaluated += lanes.len() as u64;
            let ends = done == arrival;
            let (values, covered) = if ends {
                wide.value_and_gradient(&self.x, &mut self.gradient)
            } else {
                ([0.0; L], wide.gradient(&self.x, &mut self.gradient))
            };
            let finite = finite(&self.gradient);
            if !ends && covered == [true; L] && finite == [true; L] {
                continue;
            }
            for l in (0..lanes.len()).filter(|&l| ends || !covered[l] || !finite[l]) {
                let lane = &mut lanes[l];
                if lane.refused.is_some() || done > lane.start.steps {
                    continue;
                }
                let last = lane.start.steps == done;
                let value = if covered[l] && finite[l] && (!last || values[l].is_finite()) {
                    Ok(values[l])
                } else {
                    outside += u64::from(!covered[l]);
                    self.alone(l, chains[l], last)
                };
                match value {
                    // At once: later steps of the other lanes overwrite the numbers of this lane.
                    Ok(value) if last => self.arrive(l, &mut chains[l].phase, lane.step, value),
                    Ok(_) => {}
                    Err(stop) => {
                        let Phase { x, p, .. } = &mut chains[l].phase;
                        x.copy_from_slice(&self.point.0);
                        p.iter_mut().zip(&self.p).for_each(|(p, row)| *p = row[l]);
                        lane.refused = Some(stop);
                        refused.push(l);
                    }
                }
            }
            // A refused lane copies another one: numbers that are not finite would slow down each later step.
            if let Some(sound) = (0..L).find(|&l| covered[l] && finite[l]) {
                for l in refused.drain(..) {
                    self.x.iter_mut().for_each(|row| row[l] = row[sound]);
                    self.p.iter_mut().for_each(|row| row[l] = 0.0);
                    self.gradient.iter_mut().for_each(|row| row[l] = row[sound]);
                    (kick[l], step[l]) = (0.0, 0.0);
                }
            }
        }
        self.outside = outside as f64 / evaluated.max(1) as f64;
        chains.iter_mut().zip(lanes).map(|(chain, lane)| lane.end(chain)).collect()
    }

    /// Starts a chain's trajectory in its lane.
    fn begin<P: Potential>(&mut self, l: usize, chain: &mut Chain<P>) -> Lane {
        let (mut stream, mut lengths) = (chain.stream(Purpose::Transition), chain.lengths());
        chain.visit += 1;
        let Chain { kernel: Kernel::Hmc(hmc), metric: metric @ Metric::Diagonal { .. }, phase, .. } = chain
        else {
            unreachable!("`suits` accepts fixed lengths and diagonal metrics only");
        };
        phase.refresh(metric, &mut stream);
        let steps = hmc.length(&mut lengths);
        let start = hmc.begin(phase, steps);
        let Metric::Diagonal { variance, .. } = metric else { unreachable!("as above") };
        for (rows, from) in [
            (&mut self.x, &phase.x),
            (&mut self.p, &phase.p),
            (&mut self.gradient, &phase.gradient),
            (&mut self.variance, &*variance),
        ] {
            rows.iter_mut().zip(from).for_each(|(row, x)| row[l] = *x);
        }
        Lane { stream, start, step: chain.step_size, refused: None }
    }

    /// A kick and a drift of every lane.
    fn drift(&mut self, kick: &[f64; L], step: &[f64; L]) {
        let Lanes { x, p, gradient, variance, .. } = self;
        let rows = Rows { x, p, gradient, variance };
        match Vectors::here() {
            // SAFETY: the processor has AVX-512.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx512 => unsafe { rows.drift_avx512(kick, step) },
            // SAFETY: the processor has AVX2.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 => unsafe { rows.drift_avx2(kick, step) },
            _ => rows.drift(kick, step),
        }
    }

    /// Evaluates the point of a lane by the chain's own target.
    #[cold]
    fn alone<P: Potential>(&mut self, l: usize, chain: &mut Chain<P>, last: bool) -> Result<f64, Stop> {
        let (x, g) = &mut self.point;
        x.iter_mut().zip(&self.x).for_each(|(x, row)| *x = row[l]);
        let value = if last {
            evaluate(&mut chain.target, x, g)?
        } else {
            evaluate_gradient(&mut chain.target, x, g)?;
            0.0
        };
        self.gradient.iter_mut().zip(g).for_each(|(row, g)| row[l] = *g);
        Ok(value)
    }

    /// Makes the last half kick of a lane's trajectory and writes its end to the chain's phase.
    fn arrive(&self, l: usize, phase: &mut Phase, step: f64, log_density: f64) {
        for k in 0..phase.x.len() {
            phase.x[k] = self.x[k][l];
            phase.gradient[k] = self.gradient[k][l];
            phase.p[k] = self.p[k][l] + 0.5 * step * self.gradient[k][l];
        }
        phase.log_density = log_density;
    }
}

impl Lane {
    /// Accepts the end of the trajectory, or goes back to its start.
    fn end<P: Potential>(self, chain: &mut Chain<P>) -> Transition {
        let Lane { mut stream, start, refused, .. } = self;
        let Chain { kernel: Kernel::Hmc(hmc), metric, phase, .. } = chain else {
            unreachable!("`suits` accepts fixed lengths only");
        };
        metric.velocity(&phase.p, &mut phase.v);
        hmc.end(start, refused, phase, &mut stream)
    }
}
