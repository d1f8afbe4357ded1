//! Mixtures of Gaussians over a coordinate.
//!
//! For `n` components a network gives `3 n` outputs: logits of the weights, then means, then logs of deviations.

use super::Number;
use niwaki_math::special::normal_tail;

/// `ln(2 pi) / 2`.
pub(super) const HALF_LN_TAU: f64 = 0.918_938_533_204_672_7;
/// The most components that a head can have.
pub(super) const MOST: usize = 8;
/// Bounds of the logs of deviations: from a thousandth of the prior's deviation to about five times it.
const LOG_SD: (f64, f64) = (-7.0, 1.6);
/// Distance in deviations at which a component has no mass (1e-12).
const NO_MASS: f64 = 7.0;
/// Variance of the means at the start, of the total variance 1.
const SPREAD: f64 = 0.3;

/// Outputs at the start of training: equal weights, slightly spread means, and deviations so that the variance is 1.
pub(super) fn start(components: usize) -> Vec<f64> {
    let n = components as f64;
    let (spacing, variance) =
        if components > 1 { ((12.0 * SPREAD / (n * n - 1.0)).sqrt(), 1.0 - SPREAD) } else { (0.0, 1.0) };
    let means = (0..components).map(|k| spacing * (k as f64 - 0.5 * (n - 1.0)));
    let log_sds = std::iter::repeat_n(0.5 * variance.ln(), components);
    std::iter::repeat_n(0.0, components).chain(means).chain(log_sds).collect()
}

/// A density on the line.
pub(super) struct Bells {
    count: usize,
    weight: [f64; MOST],
    mean: [f64; MOST],
    /// One over the deviation.
    sharpness: [f64; MOST],
    /// Whether the output of a deviation is within its bounds.
    bends: [bool; MOST],
}

/// The standard Gaussian's density; zero at infinity.
fn bell(t: f64) -> f64 {
    (-0.5 * t * t - HALF_LN_TAU).exp()
}

/// `bell(t) t`; zero at infinity.
fn moment(t: f64) -> f64 {
    if t.abs() < 40.0 { bell(t) * t } else { 0.0 }
}

/// The standard Gaussian's mass from `a` to `b`.
fn mass(a: f64, b: f64) -> f64 {
    if b - a < 1e-2 {
        // Three-point Gauss-Legendre: the difference of two tails would lose its digits.
        const NODE: f64 = 0.774_596_669_241_483_4;
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        return half * (8.0 * bell(middle) + 5.0 * (bell(middle - NODE * half) + bell(middle + NODE * half)))
            / 9.0;
    }
    if a > 0.0 {
        normal_tail(a) - normal_tail(b)
    } else if b < 0.0 {
        normal_tail(-b) - normal_tail(-a)
    } else {
        1.0 - normal_tail(b) - normal_tail(-a)
    }
}

impl Bells {
    /// The density from a network's outputs.
    #[inline]
    pub(super) fn new<N: Number>(outputs: &[N]) -> Bells {
        let count = (outputs.len() / 3).min(MOST);
        let (logits, rest) = outputs.split_at(count);
        let (means, log_sds) = rest.split_at(count);
        let largest = logits.iter().fold(f64::NEG_INFINITY, |m: f64, x| m.max((*x).into()));
        let (mut weight, mut mean, mut sharpness) = ([0.0; MOST], [0.0; MOST], [1.0; MOST]);
        let mut bends = [false; MOST];
        let mut sum = 0.0;
        for k in 0..count {
            weight[k] = (logits[k].into() - largest).exp();
            sum += weight[k];
            mean[k] = means[k].into();
            let output = log_sds[k].into();
            let log_sd = output.clamp(LOG_SD.0, LOG_SD.1);
            bends[k] = log_sd == output;
            sharpness[k] = (-log_sd).exp();
        }
        weight[..count].iter_mut().for_each(|w| *w /= sum);
        Bells { count, weight, mean, sharpness, bends }
    }

    /// A number: `u` chooses the component, `normal` is a standard Gaussian draw.
    pub(super) fn number(&self, u: f64, normal: f64) -> f64 {
        let mut k = 0;
        let mut sum = self.weight[0];
        while u >= sum && k + 1 < self.count {
            k += 1;
            sum += self.weight[k];
        }
        self.mean[k] + normal / self.sharpness[k]
    }

    /// The density at `z`. With `slope`, `scale` times its derivative by each output over the density is added to it.
    pub(super) fn density(&self, z: f64, scale: f64, slope: Option<&mut [f64]>) -> f64 {
        let part = |k: usize| {
            let t = (z - self.mean[k]) * self.sharpness[k];
            (t, self.weight[k] * self.sharpness[k] * bell(t))
        };
        let density: f64 = (0..self.count).map(|k| part(k).1).sum();
        if let (Some(slope), true) = (slope, density > 0.0) {
            for k in 0..self.count {
                let (t, p) = part(k);
                let share = p / density;
                slope[k] += scale * (share - self.weight[k]);
                slope[self.count + k] += scale * share * t * self.sharpness[k];
                if self.bends[k] {
                    slope[2 * self.count + k] += scale * share * (t * t - 1.0);
                }
            }
        }
        density
    }

    /// The mass from `a` to `b`. With `slope`, `scale` times its derivative by each output is added to it.
    pub(super) fn mass(&self, a: f64, b: f64, scale: f64, slope: Option<&mut [f64]>) -> f64 {
        let ends =
            |k: usize| ((a - self.mean[k]) * self.sharpness[k], (b - self.mean[k]) * self.sharpness[k]);
        let mut parts = [0.0; MOST];
        for (k, part) in parts[..self.count].iter_mut().enumerate() {
            let (a, b) = ends(k);
            *part = mass(a, b);
        }
        let total: f64 = (0..self.count).map(|k| self.weight[k] * parts[k]).sum();
        if let Some(slope) = slope {
            for k in 0..self.count {
                let ((a, b), scale) = (ends(k), scale * self.weight[k]);
                slope[k] += scale * (parts[k] - total);
                slope[self.count + k] += scale * (bell(a) - bell(b)) * self.sharpness[k];
                if self.bends[k] {
                    slope[2 * self.count + k] += scale * (moment(a) - moment(b));
                }
            }
        }
        total
    }

    /// The mass outside `(lo, hi)`, and `scale` times its derivatives, as in [`Bells::mass`].
    pub(super) fn mass_outside(
        &self,
        (lo, hi): (f64, f64),
        scale: f64,
        mut slope: Option<&mut [f64]>,
    ) -> f64 {
        let inside = |k: usize| {
            (hi - self.mean[k]) * self.sharpness[k] > NO_MASS
                && (self.mean[k] - lo) * self.sharpness[k] > NO_MASS
        };
        if (0..self.count).all(inside) {
            return 0.0;
        }
        self.mass(f64::NEG_INFINITY, lo, scale, slope.as_deref_mut())
            + self.mass(hi, f64::INFINITY, scale, slope)
    }
}
