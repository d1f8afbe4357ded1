//! Pathfinder: an ascent of the log density, and the best of the normals along it (Zhang, Carpenter, Gelman & Vehtari
//! 2022, algorithm 1).
//!
//! At each point of the ascent there is a normal whose covariance is the inverse Hessian that the ascent has seen. Its
//! evidence bound is estimated by a few draws, and the normal of the highest bound is the result. So the ascent may run
//! on to a maximum far outside of the typical set: the best normal is met on the way.
//!
//! Differs: the diagonal of the inverse Hessian also guides the ascent; the draws of all normals are the same standard
//! normals, so that bounds are compared and not noise.

use super::batch::{Batch, Elsewhere, Row};
use super::curvature::Curvature;
use super::normal::Normal;
use super::{LANES, Purpose};
use crate::hamiltonian::lanes::Wide;
use crate::hamiltonian::leapfrog::dot;
use crate::hamiltonian::potential::evaluate;
use crate::hamiltonian::{Phase, Potential, Stop};
use niwaki_math::Stream;

/// Steps of an ascent at most.
const MOST: u32 = 1000;
/// An ascent ends after as many steps that each gain less than a share of the height, or little in nats.
const STILL: u32 = 5;
const SHARE: f64 = 1e-9;
const LITTLE: f64 = 1e-4;
/// A step gains this share of what its slope promises (Armijo), and the slope falls to that share of it (Wolfe).
const GAIN: f64 = 1e-4;
const SLOPE: f64 = 0.9;
/// Trials of one line search.
const TRIALS: u32 = 30;

/// The result of an ascent.
#[derive(Clone, Debug)]
pub struct Path {
    /// The normal of the highest bound.
    pub normal: Normal,
    /// Estimates of the bounds along the path, nats; minus infinity where there was no normal.
    pub bounds: Vec<f64>,
    /// The step of the best.
    pub best: usize,
    /// Whether it was stopped before its end.
    pub interrupted: bool,
}

/// Why there is no path.
#[derive(Clone, Debug, PartialEq)]
pub enum NoPath {
    /// The target refuses the start.
    Start(Stop),
    /// A draw makes other choices.
    Elsewhere,
}

impl From<Elsewhere> for NoPath {
    fn from(_: Elsewhere) -> Self {
        NoPath::Elsewhere
    }
}

/// Ascends from `start`, and gives the best normal on the way. `number` keys the random bits; `watch` is called
/// with the steps so far, and ends the ascent when it returns false.
///
/// # Errors
/// A start that the target refuses; draws that make other choices.
pub fn pathfinder<P: Potential, W: Wide<LANES>>(
    batch: &mut Batch<'_, P, W>,
    start: &[f64],
    seed: u64,
    number: u64,
    watch: &dyn Fn(u32) -> bool,
) -> Result<Path, NoPath> {
    let dim = start.len();
    let mut at = Phase::at(batch.target, start).map_err(NoPath::Start)?;
    let mut draws = Draws::new(dim, Stream::new(seed, number, Purpose::Path as u128, 0));
    let mut curvature = Curvature::new(dim);
    // Before the first step nothing is known: a narrow normal around the start.
    let mut path = Path {
        normal: Normal::diagonal(start.to_vec(), vec![1.0; dim]),
        bounds: vec![],
        best: 0,
        interrupted: false,
    };
    path.bounds.push(draws.bound(batch, &path.normal)?);
    let mut still = 0;
    for step in 1..=MOST {
        if !watch(step) {
            path.interrupted = true;
            break;
        }
        let (direction, reach) = heading(&curvature, &at);
        let Some(next) = search(batch, &at, &direction, reach) else { break };
        let moved = next.x.iter().zip(&at.x).map(|(b, a)| b - a).collect();
        let change = next.gradient.iter().zip(&at.gradient).map(|(b, a)| a - b).collect();
        curvature.learn(moved, change);
        let gain = next.log_density - at.log_density;
        at = next;
        let normal = curvature.normal(&at.x, &at.gradient).filter(|_| !curvature.is_empty());
        let bound = match &normal {
            Some(normal) => draws.bound(batch, normal)?,
            None => f64::NEG_INFINITY,
        };
        path.bounds.push(bound);
        if let Some(normal) = normal.filter(|_| bound > path.bounds[path.best]) {
            (path.normal, path.best) = (normal, step as usize);
        }
        still = if gain < LITTLE.max(SHARE * at.log_density.abs()) { still + 1 } else { 0 };
        if still == STILL {
            break;
        }
    }
    Ok(path)
}

/// Where to step: to the mean of the normal here, or along the gradient; and how far at first.
fn heading(curvature: &Curvature, at: &Phase) -> (Vec<f64>, f64) {
    let newton = curvature.normal(&at.x, &at.gradient).filter(|_| !curvature.is_empty());
    if let Some(normal) = newton {
        let direction: Vec<f64> = normal.mean.iter().zip(&at.x).map(|(m, x)| m - x).collect();
        if dot(&direction, &at.gradient) > 0.0 {
            return (direction, 1.0);
        }
    }
    (at.gradient.clone(), 1.0 / dot(&at.gradient, &at.gradient).sqrt().max(1.0))
}

/// A point along a direction that is high enough and where the slope has fallen enough (weak Wolfe conditions, by
/// bisection: Lewis & Overton 2013, algorithm 2.6). Kinks do no harm. `None` where nothing is higher.
fn search<P: Potential, W>(
    batch: &mut Batch<'_, P, W>,
    at: &Phase,
    direction: &[f64],
    reach: f64,
) -> Option<Phase> {
    let slope = dot(direction, &at.gradient);
    let (mut low, mut high, mut t) = (0.0, f64::INFINITY, reach);
    let mut next = at.clone();
    let mut higher = None;
    for _ in 0..TRIALS {
        next.x.iter_mut().zip(&at.x).zip(direction).for_each(|((y, x), d)| *y = x + t * d);
        batch.gradients += 1;
        match evaluate(batch.target, &next.x, &mut next.gradient) {
            Ok(value) if value >= at.log_density + GAIN * t * slope => {
                next.log_density = value;
                if dot(direction, &next.gradient) <= SLOPE * slope {
                    return Some(next);
                }
                (low, higher) = (t, Some(next.clone()));
            }
            _ => high = t,
        }
        t = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * t };
    }
    higher
}

/// The standard normals by which bounds are compared.
struct Draws {
    z: Vec<Row>,
    x: Vec<Row>,
    g: Vec<Row>,
}

impl Draws {
    fn new(dim: usize, mut stream: Stream) -> Draws {
        let mut z = vec![[0.0; LANES]; dim];
        z.iter_mut().flatten().for_each(|z| *z = stream.normal());
        Draws { x: z.clone(), g: z.clone(), z }
    }

    /// The bound of a normal, nats; minus infinity where a draw is refused.
    fn bound<P: Potential, W: Wide<LANES>>(
        &mut self,
        batch: &mut Batch<'_, P, W>,
        normal: &Normal,
    ) -> Result<f64, Elsewhere> {
        let Some(normal) = normal.in_order(&batch.angles) else { return Ok(f64::NEG_INFINITY) };
        normal.place(&self.z, &mut self.x);
        let values = batch.evaluate(&self.x, &mut self.g, LANES)?;
        let normal_log = normal.log_density_around(&self.z, &batch.angles);
        let mean = values.iter().zip(normal_log).map(|(p, q)| p - q).sum::<f64>() / LANES as f64;
        Ok(if mean.is_nan() { f64::NEG_INFINITY } else { mean })
    }
}

#[cfg(test)]
mod tests {
    //! A normal target is found exactly, from far away; a wall is met and not crossed; the best bound is kept.
    use super::*;
    use crate::hamiltonian::Cause;
    use crate::hamiltonian::potential::tests::{By, normals};
    use crate::variational::batch::tests::Uncovered;

    #[test]
    fn a_normal_target_is_found() {
        let deviations = [1e-2, 1.0, 3.0, 40.0];
        let (mut target, mut wide) = (normals(deviations.to_vec()), Uncovered);
        let mut batch = Batch::new(&mut target, &mut wide);
        let path = pathfinder(&mut batch, &[3.0, -7.0, 20.0, 90.0], 1, 0, &|_| true).expect("a path");
        let covariance = path.normal.covariance();
        // `log Z` of this density is the sum of the logs of the deviations and of `log sqrt(2 pi)`.
        let evidence: f64 = deviations.iter().map(|d: &f64| d.ln() + 0.918_938_533_204_672_8).sum();
        assert!((path.bounds[path.best] - evidence).abs() < 0.2, "{} {evidence}", path.bounds[path.best]);
        for (i, d) in deviations.iter().enumerate() {
            assert!((path.normal.mean[i] / d).abs() < 0.1, "{:?}", path.normal.mean);
            assert!((covariance[i * 5].sqrt() / d - 1.0).abs() < 0.2, "{covariance:?}");
        }
    }

    #[test]
    fn the_best_normal_is_met_on_the_way() {
        // A funnel: the ascent runs down its neck, where a normal has nearly none of the mass.
        let mut target = By(9, |x: &[f64], g: &mut [f64]| {
            let v = x[0];
            let squares: f64 = x[1..].iter().map(|x| x * x).sum();
            g[0] = -v / 9.0 - 4.0 + 0.5 * squares * (-v).exp();
            g[1..].iter_mut().zip(&x[1..]).for_each(|(g, x)| *g = -x * (-v).exp());
            Ok(-v * v / 18.0 - 4.0 * v - 0.5 * squares * (-v).exp())
        });
        let (mut wide, mut start) = (Uncovered, [0.7; 9]);
        start[0] = 1.0;
        let path = pathfinder(&mut Batch::new(&mut target, &mut wide), &start, 4, 0, &|_| true);
        let path = path.expect("a path");
        let (best, last) = (path.bounds[path.best], path.bounds[path.bounds.len() - 1]);
        assert!(path.bounds.iter().all(|bound| *bound <= best));
        assert!(last < best - 3.0, "{:?}", path.bounds);
        // The evidence is `log 3` and nine times `log sqrt(2 pi)`; the bound is not far below.
        assert!(best < 9.4 && best > 2.0, "{:?}", path.bounds);
    }

    #[test]
    fn a_bad_start_and_a_draw_elsewhere_are_errors_and_a_stop_keeps_the_best() {
        let stop = Stop { cause: Cause::Impossible, place: 0 };
        let mut nowhere = By(1, |_: &[f64], _: &mut [f64]| Err(stop));
        let mut wide = Uncovered;
        let outcome = pathfinder(&mut Batch::new(&mut nowhere, &mut wide), &[0.0], 1, 0, &|_| true);
        assert_eq!(outcome.err(), Some(NoPath::Start(stop)));
        let mut half = By(1, |x: &[f64], g: &mut [f64]| {
            g[0] = -x[0];
            if x[0] > 0.0 { Ok(-0.5 * x[0] * x[0]) } else { Err(Stop { cause: Cause::Guard, place: 0 }) }
        });
        let outcome = pathfinder(&mut Batch::new(&mut half, &mut wide), &[0.1], 1, 0, &|_| true);
        assert_eq!(outcome.err(), Some(NoPath::Elsewhere));
        let mut target = normals(vec![1.0]);
        let path = pathfinder(&mut Batch::new(&mut target, &mut wide), &[9.0], 1, 0, &|step| step < 2);
        assert!(path.is_ok_and(|path| path.interrupted && path.bounds.len() == 2));
    }
}
