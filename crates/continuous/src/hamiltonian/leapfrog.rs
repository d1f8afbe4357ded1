//! The leapfrog integrator: half a kick, a drift, half a kick.
//!
//! ```text
//! p(t + e/2) = p(t) + e/2 grad(x(t))
//! x(t + e)   = x(t) + e M^-1 p(t + e/2)
//! p(t + e)   = p(t + e/2) + e/2 grad(x(t + e))
//! ```
//!
//! (dissertation 4.3; Neal 2011, eq. 5.18 to 5.20.) It keeps volume, and runs backwards when the step is negated; its
//! energy error shrinks with the square of the step.

use super::metric::Metric;
use super::potential::{Potential, Stop, evaluate, evaluate_gradient};
use niwaki_grad::Rolling;
use niwaki_math::Stream;

/// A point in phase space, with the target's value and gradient there.
#[derive(Clone, Debug)]
pub struct Phase {
    /// Position, `dim` unconstrained coordinates.
    pub x: Vec<f64>,
    /// Momentum.
    pub p: Vec<f64>,
    /// Velocity, `M^-1 p`: up to date between two steps.
    pub v: Vec<f64>,
    /// Gradient of the log density at `x`.
    pub gradient: Vec<f64>,
    /// Log density at `x`, nats.
    pub log_density: f64,
}

impl Phase {
    /// The target at `x`, at rest.
    ///
    /// # Errors
    /// The target's refusal of `x`.
    pub fn at(target: &mut (impl Potential + ?Sized), x: &[f64]) -> Result<Phase, Stop> {
        let still = vec![0.0; x.len()];
        let mut phase =
            Phase { x: x.to_vec(), p: still.clone(), v: still.clone(), gradient: still, log_density: 0.0 };
        phase.log_density = evaluate(target, x, &mut phase.gradient)?;
        Ok(phase)
    }

    /// Draws a fresh momentum from `N(0, M)`.
    pub fn refresh(&mut self, metric: &Metric, stream: &mut Stream) {
        metric.momentum(stream, &mut self.p);
        metric.velocity(&self.p, &mut self.v);
    }

    /// The Hamiltonian, nats: kinetic energy less the log density.
    #[inline]
    pub fn energy(&self) -> f64 {
        self.kinetic() - self.log_density
    }

    /// Its kinetic part, nats.
    #[inline]
    pub fn kinetic(&self) -> f64 {
        0.5 * dot(&self.p, &self.v)
    }

    /// Becomes a copy of `other`, in place; it may have had another number of coordinates.
    pub fn copy_from(&mut self, other: &Phase) {
        self.x.clone_from(&other.x);
        self.p.clone_from(&other.p);
        self.v.clone_from(&other.v);
        self.gradient.clone_from(&other.gradient);
        self.log_density = other.log_density;
    }
}

/// The inner product of two vectors of equal length.
#[inline]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `y += a x`, element by element.
#[inline]
pub fn add(y: &mut [f64], a: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}

/// `steps` leapfrog steps of size `step` (negative: backwards in time). Between two steps the two half kicks are one, and
/// only the gradient is evaluated.
///
/// # Errors
/// The target's refusal of a position; the phase is then at that position, its gradient unspecified.
pub fn leapfrog(
    target: &mut (impl Potential + ?Sized),
    metric: &Metric,
    phase: &mut Phase,
    step: f64,
    steps: u32,
) -> Result<(), Stop> {
    let (mut kick, mut left) = (0.5 * step, steps);
    while left > 0 {
        // The target's own fast steps. A step that it stops before is taken here, to find the reason.
        if left > 1
            && let Metric::Diagonal { variance, .. } = metric
        {
            let Phase { x, p, gradient: g, .. } = phase;
            let rolled = target.roll(Rolling { x, p, g, variance }, kick, step, left - 1);
            left -= rolled;
            kick = if rolled > 0 { step } else { kick };
        }
        drift(metric, phase, kick, step);
        left -= 1;
        if left == 0 {
            phase.log_density = evaluate(target, &phase.x, &mut phase.gradient)?;
        } else {
            evaluate_gradient(target, &phase.x, &mut phase.gradient)?;
        }
        kick = step;
    }
    if steps > 0 {
        add(&mut phase.p, 0.5 * step, &phase.gradient);
        metric.velocity(&phase.p, &mut phase.v);
    }
    Ok(())
}

/// A kick, and a drift with the velocity that it gives. The velocity of a unit or diagonal metric is not written down.
#[inline]
fn drift(metric: &Metric, phase: &mut Phase, kick: f64, step: f64) {
    let Phase { x, p, v, gradient, .. } = phase;
    if let Metric::Diagonal { variance, .. } = metric {
        for (((x, p), s), g) in x.iter_mut().zip(p).zip(variance).zip(gradient) {
            *p += kick * *g;
            *x += (step * s) * *p;
        }
        return;
    }
    add(p, kick, gradient);
    metric.velocity(p, v);
    add(x, step, v);
}

#[cfg(test)]
mod tests {
    //! Second order, reversible to rounding, and many steps are one step many times.
    use super::*;
    use crate::hamiltonian::potential::tests::By;

    /// A banana in two dimensions, and two normals coupled to it.
    fn target() -> impl Potential {
        By(4, |x: &[f64], g: &mut [f64]| {
            let bend = x[1] - x[0] * x[0];
            let near = x[3] - x[2];
            g[0] = -x[0] + 8.0 * bend * x[0];
            g[1] = -4.0 * bend - x[1].powi(3);
            g[2] = near - x[2] + x[1].cos();
            g[1] += -x[2] * x[1].sin();
            g[3] = -near;
            Ok(-0.5 * x[0] * x[0]
                - 2.0 * bend * bend
                - 0.25 * x[1].powi(4)
                - 0.5 * near * near
                - 0.5 * x[2] * x[2]
                + x[2] * x[1].cos())
        })
    }

    fn metrics() -> Vec<Metric> {
        let s = 0.5_f64.sqrt();
        vec![
            Metric::unit(4),
            Metric::diagonal(vec![0.5, 2.0, 1.0, 3.0]),
            Metric::dense(vec![
                2.0, 0.3, 0.0, 0.1, 0.3, 1.0, 0.2, 0.0, 0.0, 0.2, 1.5, -0.4, 0.1, 0.0, -0.4, 0.7,
            ])
            .expect("positive definite"),
            Metric::low_rank(vec![1.0, 0.7, 1.2, 0.9], vec![(vec![s, 0.0, s, 0.0], 3.0)]),
        ]
    }

    fn start(metric: &Metric, seed: u64) -> Phase {
        let mut phase = Phase::at(&mut target(), &[0.3, -0.2, 0.5, 0.1]).expect("a point of the target");
        phase.refresh(metric, &mut Stream::new(seed, 0, 0, 0));
        phase
    }

    #[test]
    fn the_energy_error_shrinks_with_the_square_of_the_step() {
        // Over a fixed time the error is c e^2 + O(e^4): halving the step divides it by 4 (within 2 % here).
        for metric in metrics() {
            for seed in 0..3 {
                let before = start(&metric, seed);
                let error = |steps: u32| {
                    let mut phase = before.clone();
                    leapfrog(&mut target(), &metric, &mut phase, 1.0 / f64::from(steps), steps)
                        .expect("runs");
                    phase.energy() - before.energy()
                };
                let ratio = error(200) / error(400);
                assert!((ratio - 4.0).abs() < 0.08, "{ratio} {metric:?}");
            }
        }
    }

    #[test]
    fn a_step_that_ignores_the_metric_has_another_order() {
        // The mutant drifts along p where the energy has M^-1 p: its error does not shrink with the step at all.
        let metric = Metric::diagonal(vec![0.5, 2.0, 1.0, 3.0]);
        let before = start(&metric, 1);
        let error = |steps: u32| {
            let mut phase = before.clone();
            leapfrog(&mut target(), &Metric::unit(4), &mut phase, 1.0 / f64::from(steps), steps)
                .expect("runs");
            metric.velocity(&phase.p.clone(), &mut phase.v);
            phase.energy() - before.energy()
        };
        assert!((error(200) / error(400) - 1.0).abs() < 0.1);
    }

    #[test]
    fn it_runs_backwards_to_rounding() {
        for metric in metrics() {
            let before = start(&metric, 5);
            let mut phase = before.clone();
            leapfrog(&mut target(), &metric, &mut phase, 0.05, 200).expect("runs");
            assert!((phase.x[0] - before.x[0]).abs() > 1e-2);
            leapfrog(&mut target(), &metric, &mut phase, -0.05, 200).expect("runs");
            for (there, back) in before.x.iter().chain(&before.p).zip(phase.x.iter().chain(&phase.p)) {
                assert!((there - back).abs() < 1e-10, "{there} {back} {metric:?}");
            }
        }
    }

    #[test]
    fn it_keeps_volume() {
        // The Jacobian of ten steps, by central differences, has determinant 1.
        let metric = Metric::unit(2);
        let mut bent = By(2, |x: &[f64], g: &mut [f64]| {
            let bend = x[1] - x[0] * x[0];
            g[0] = -x[0] + 8.0 * bend * x[0];
            g[1] = -4.0 * bend;
            Ok(-0.5 * x[0] * x[0] - 2.0 * bend * bend)
        });
        let mut run = |s: [f64; 4]| {
            let mut phase = Phase::at(&mut bent, &s[..2]).expect("a point of the target");
            phase.p.copy_from_slice(&s[2..]);
            leapfrog(&mut bent, &metric, &mut phase, 0.1, 10).expect("runs");
            [phase.x[0], phase.x[1], phase.p[0], phase.p[1]]
        };
        let (at, h) = ([0.4, -0.3, 0.8, 0.2], 1e-5);
        let mut m = [[0.0; 4]; 4];
        for (j, column) in m.iter_mut().enumerate() {
            let (mut up, mut down) = (at, at);
            (up[j], down[j]) = (at[j] + h, at[j] - h);
            let (up, down) = (run(up), run(down));
            *column = std::array::from_fn(|i| (up[i] - down[i]) / (2.0 * h));
        }
        let mut determinant = 1.0;
        for k in 0..4 {
            let pivot = m[k];
            determinant *= pivot[k];
            for row in m.iter_mut().skip(k + 1) {
                let f = row[k] / pivot[k];
                (0..4).for_each(|j| row[j] -= f * pivot[j]);
            }
        }
        assert!((determinant - 1.0).abs() < 1e-7, "{determinant}");
    }

    #[test]
    fn many_steps_are_one_step_many_times() {
        for metric in metrics() {
            let before = start(&metric, 9);
            let (mut once, mut often) = (before.clone(), before);
            leapfrog(&mut target(), &metric, &mut once, 0.1, 30).expect("runs");
            for _ in 0..30 {
                leapfrog(&mut target(), &metric, &mut often, 0.1, 1).expect("runs");
            }
            assert!(once.x.iter().zip(&often.x).all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }
}
