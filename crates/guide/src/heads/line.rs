//! Coordinates in which the priors of real numbers are alike.
//!
//! Each family has a rising map from its values `x` to a coordinate `z` in which the prior is near the standard
//! Gaussian, or equal to it. `Phi` is the Gaussian's distribution function, `F` that of the family.
//!
//! | family | `z` | prior density of `z` |
//! | --- | --- | --- |
//! | gaussian | `(x - mean) / sd` | standard Gaussian |
//! | log_normal | `(ln x - mean) / sd` | standard Gaussian |
//! | uniform, exponential, laplace, cauchy | `Phi^-1(F(x))` | standard Gaussian |
//! | truncated_gaussian, most | `Phi^-1(F(x))` | standard Gaussian |
//! | truncated_gaussian, narrow or far in a tail | `Phi^-1` of an exponential's `F` between the bounds | `p(x) dx/dz` |
//! | student_t | `c sgn(t) sqrt(df ln(1 + t^2 / df))`, `c = (8 df + 1) / (8 df + 3)` (Wallace 1959) | `p(x) dx/dz` |
//! | gamma, inverse_gamma | `(ln x - mean of ln x) / sd of ln x` | `p(x) dx/dz` |
//! | beta | `(logit x - mean of logit x) / sd of logit x` | `p(x) dx/dz` |
//!
//! Any other family has the coordinate of its space, `p(x) dx/dz`: `(x - center) / scale` on the line, `ln x` above zero, `logit x`
//! from zero to one.
//!
//! (The moments of logarithms are approximate, which changes the coordinate and not the density.)
//!
//! A coordinate holds between two limits, within 7.2 of zero, since beyond them the last digits of a uniform would decide. The
//! prior keeps the values outside.

use super::bells::HALF_LN_TAU;
use niwaki_math::special::{normal_quantile, normal_tail};
use niwaki_math::{Dist, Space};
use std::f64::consts::{LN_2, PI};

/// Largest distance of a coordinate from zero.
const FARTHEST: f64 = 7.2;
/// The Gaussian's tail at this distance.
const FARTHEST_TAIL: f64 = 3e-13;
/// Distance of limits from the bounds, in last digits of the bounds.
const DIGITS: f64 = 1e3;
/// Largest distance of a logit from zero: there the distance from one of a number below one still has three digits.
const FARTHEST_LOGIT: f64 = 29.0;
/// Largest distance of a logarithm from zero, so that numbers keep all their digits.
const FARTHEST_LOG: f64 = 690.0;

/// The place of a value in its prior.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The coordinate; NaN for a value that the prior excludes.
    pub z: f64,
    /// Log of the prior's density of `z`, nats.
    pub log_prior: f64,
    /// The coordinate holds between these limits.
    pub limits: (f64, f64),
}

/// A family with the constants of its coordinate.
pub(super) struct Line<'d> {
    dist: &'d Dist,
    form: Form,
}

/// The formula of the coordinate.
enum Form {
    /// `(x - center) / unit`; `exact` if the prior is the standard Gaussian.
    Straight { center: f64, unit: f64, exact: bool },
    /// `(ln x - center) / unit`; `exact` if the prior is the standard Gaussian.
    Log { center: f64, unit: f64, exact: bool },
    /// `(logit x - center) / unit`.
    Logit { center: f64, unit: f64 },
    /// A coordinate from the two tails of the prior.
    Ranked,
    /// A truncated Gaussian: in units `u = sign (x - mean) / sd`, the tails of `u` and of the bounds.
    Cut { sign: f64, below: f64, above: f64, mass: f64 },
    /// A truncated Gaussian as an exponential of this rate, by the distance from the bound that is nearer to the mean.
    Slope { from_lo: bool, rate: f64, width: f64 },
    /// Student's t.
    Root { stretch: f64 },
}

/// The coordinate `z` of two probabilities that sum to one, from the smaller.
fn score(below: f64, above: f64) -> f64 {
    if below <= above { normal_quantile(below) } else { -normal_quantile(above) }
}

/// Mean and deviation of the logarithm of a gamma of scale 1: one step of the recurrences of digamma and trigamma, then
/// three terms of their asymptotic series.
fn log_gamma_moments(shape: f64) -> (f64, f64) {
    let r = 1.0 / (shape + 1.0);
    let digamma = (shape + 1.0).ln() - r * (0.5 + r * (1.0 / 12.0 - r * r / 120.0)) - 1.0 / shape;
    let trigamma = r * (1.0 + r * (0.5 + r * (1.0 / 6.0 - r * r / 30.0))) + 1.0 / (shape * shape);
    (digamma, trigamma.sqrt())
}

impl<'d> Line<'d> {
    /// The coordinate of a family of real numbers; `None` for other families.
    pub(super) fn new(dist: &'d Dist) -> Option<Line<'d>> {
        let form = match *dist {
            Dist::Gaussian { mean, sd } => Form::Straight { center: mean, unit: sd, exact: true },
            Dist::LogNormal { mean, sd } => Form::Log { center: mean, unit: sd, exact: true },
            Dist::Uniform { .. } | Dist::Exponential { .. } | Dist::Laplace { .. } | Dist::Cauchy { .. } => {
                Form::Ranked
            }
            Dist::TruncatedGaussian { mean, sd, lo, hi } => cut(mean, sd, lo, hi),
            Dist::StudentT { df, .. } => Form::Root { stretch: (8.0 * df + 1.0) / (8.0 * df + 3.0) },
            Dist::Gamma { shape, scale } => {
                let (mean, unit) = log_gamma_moments(shape);
                Form::Log { center: mean + scale.ln(), unit, exact: false }
            }
            Dist::InverseGamma { shape, scale } => {
                let (mean, unit) = log_gamma_moments(shape);
                Form::Log { center: scale.ln() - mean, unit, exact: false }
            }
            Dist::Beta { a, b } => {
                let ((mean_a, sd_a), (mean_b, sd_b)) = (log_gamma_moments(a), log_gamma_moments(b));
                Form::Logit { center: mean_a - mean_b, unit: sd_a.hypot(sd_b) }
            }
            _ => of_space(dist)?,
        };
        Some(Line { dist, form })
    }

    /// The coordinates between which values are distinct.
    fn limits(&self) -> (f64, f64) {
        let within = |center: f64, unit: f64, size: f64| {
            (((-size - center) / unit).max(-FARTHEST), ((size - center) / unit).min(FARTHEST))
        };
        match self.form {
            Form::Log { center, unit, .. } => within(center, unit, FARTHEST_LOG),
            Form::Logit { center, unit } => within(center, unit, FARTHEST_LOGIT),
            Form::Root { stretch } => {
                let Dist::StudentT { df, .. } = *self.dist else { return (0.0, 0.0) };
                let size = (stretch * (df * FARTHEST_LOG).sqrt()).min(FARTHEST);
                (-size, size)
            }
            Form::Ranked | Form::Cut { .. } | Form::Slope { .. } => match *self.dist {
                Dist::Uniform { lo, hi } | Dist::TruncatedGaussian { lo, hi, .. } => {
                    let tail = DIGITS * f64::EPSILON * lo.abs().max(hi.abs()) / (hi - lo);
                    let size = if tail > FARTHEST_TAIL { -normal_quantile(tail.min(0.5)) } else { FARTHEST };
                    (-size, size)
                }
                _ => (-FARTHEST, FARTHEST),
            },
            Form::Straight { .. } => (-FARTHEST, FARTHEST),
        }
    }

    /// The place of a value, which depends on the value alone: the call that drew a value and the call that scores it agree.
    pub(super) fn place(&self, x: f64, log_density: f64) -> Place {
        let (z, log_prior) = self.coordinate(x, log_density);
        Place { z, log_prior, limits: self.limits() }
    }

    /// The coordinate of a value, and the log of its density under the prior.
    fn coordinate(&self, x: f64, log_density: f64) -> (f64, f64) {
        let gaussian = |z: f64| (z, -0.5 * z * z - HALF_LN_TAU);
        match self.form {
            Form::Straight { center, unit, exact } => {
                let z = (x - center) / unit;
                if exact { gaussian(z) } else { (z, log_density + unit.ln()) }
            }
            Form::Log { center, unit, exact } => {
                let log = x.ln();
                let z = (log - center) / unit;
                if exact { gaussian(z) } else { (z, log_density + log + unit.ln()) }
            }
            Form::Logit { center, unit } => {
                let (log, log_rest) = (x.ln(), (-x).ln_1p());
                ((log - log_rest - center) / unit, log_density + log + log_rest + unit.ln())
            }
            Form::Ranked => {
                let (below, above) = self.tails(x);
                gaussian(score(below, above))
            }
            Form::Cut { sign, below, above, mass } => {
                let Dist::TruncatedGaussian { mean, sd, .. } = *self.dist else { return (f64::NAN, 0.0) };
                let u = sign * (x - mean) / sd;
                gaussian(sign * score((normal_tail(-u) - below) / mass, (normal_tail(u) - above) / mass))
            }
            Form::Slope { from_lo, rate, width } => {
                let Dist::TruncatedGaussian { sd, lo, hi, .. } = *self.dist else { return (f64::NAN, 0.0) };
                let t = if from_lo { (x - lo) / sd } else { (hi - x) / sd };
                // Probabilities of less than t and of more, and the log of the density of t.
                let (near, far, log_slope) = if rate * width < 1e-9 {
                    (t / width, (width - t) / width, -width.ln())
                } else {
                    let all = -(-rate * width).exp_m1();
                    let far = (-rate * t).exp() * -(-rate * (width - t)).exp_m1() / all;
                    (-(-rate * t).exp_m1() / all, far, rate.ln() - rate * t - all.ln())
                };
                let z = if from_lo { score(near, far) } else { score(far, near) };
                (z, log_density + sd.ln() - 0.5 * z * z - HALF_LN_TAU - log_slope)
            }
            Form::Root { stretch } => {
                let Dist::StudentT { df, loc, scale } = *self.dist else { return (f64::NAN, 0.0) };
                let t = (x - loc) / scale;
                let square = t * t / df;
                let log = if t.abs() < 1e100 { square.ln_1p() } else { 2.0 * t.abs().ln() - df.ln() };
                let root = (df * log).sqrt();
                // dz/dt is `stretch t / (root (1 + t^2 / df))`, and `stretch` at zero.
                let log_slope = if root > 0.0 { (t.abs() / root).ln() - log } else { 0.0 };
                ((stretch * root).copysign(t), log_density + scale.ln() - stretch.ln() - log_slope)
            }
        }
    }

    /// The probabilities of less than `x` and of more.
    fn tails(&self, x: f64) -> (f64, f64) {
        match *self.dist {
            Dist::Uniform { lo, hi } => ((x - lo) / (hi - lo), (hi - x) / (hi - lo)),
            Dist::Exponential { rate } => (-(-rate * x).exp_m1(), (-rate * x).exp()),
            Dist::Laplace { loc, scale } => {
                let tail = 0.5 * (-((x - loc) / scale).abs()).exp();
                if x < loc { (tail, 1.0 - tail) } else { (1.0 - tail, tail) }
            }
            Dist::Cauchy { loc, scale } => {
                let tail = (scale / (x - loc).abs()).atan() / PI;
                if x < loc { (tail, 1.0 - tail) } else { (1.0 - tail, tail) }
            }
            _ => (f64::NAN, f64::NAN),
        }
    }

    /// The value of a coordinate within the limits; `None` outside.
    pub(super) fn value(&self, z: f64) -> Option<f64> {
        let (least, most) = self.limits();
        if !(z > least && z < most) {
            return None;
        }
        // The smaller tail of z, and whether it is the upper tail.
        let tail = || (normal_tail(z.abs()), z > 0.0);
        Some(match (&self.form, self.dist) {
            (Form::Straight { center, unit, .. }, _) => center + unit * z,
            (Form::Log { center, unit, .. }, _) => (center + unit * z).exp(),
            (Form::Logit { center, unit }, _) => {
                let logit = center + unit * z;
                if logit < 0.0 { logit.exp() / (1.0 + logit.exp()) } else { 1.0 / (1.0 + (-logit).exp()) }
            }
            (Form::Ranked, Dist::Uniform { lo, hi }) => {
                let (p, upper) = tail();
                if upper { hi - (hi - lo) * p } else { lo + (hi - lo) * p }
            }
            (Form::Ranked, Dist::Exponential { rate }) => {
                let (p, upper) = tail();
                -(if upper { p.ln() } else { (-p).ln_1p() }) / rate
            }
            (Form::Ranked, Dist::Laplace { loc, scale }) => {
                let (p, upper) = tail();
                let distance = -(p.ln() + LN_2) * scale;
                if upper { loc + distance } else { loc - distance }
            }
            (Form::Ranked, Dist::Cauchy { loc, scale }) => {
                let (p, upper) = tail();
                let distance = scale / (PI * p).tan();
                if upper { loc + distance } else { loc - distance }
            }
            (Form::Cut { sign, below, above, mass }, Dist::TruncatedGaussian { mean, sd, lo, hi }) => {
                let z = sign * z;
                let (under, over) = (below + mass * normal_tail(-z), above + mass * normal_tail(z));
                (mean + sign * sd * score(under, over)).clamp(*lo, *hi)
            }
            (Form::Slope { from_lo, rate, width }, Dist::TruncatedGaussian { sd, lo, hi, .. }) => {
                let near = if *from_lo { normal_tail(-z) } else { normal_tail(z) };
                let t = if rate * width < 1e-9 {
                    near * width
                } else {
                    -(near * (-rate * width).exp_m1()).ln_1p() / rate
                };
                (if *from_lo { lo + sd * t } else { hi - sd * t }).clamp(*lo, *hi)
            }
            (Form::Root { stretch }, Dist::StudentT { df, loc, scale }) => {
                let root = z / stretch;
                loc + scale * (df * (root * root / df).exp_m1()).sqrt().copysign(z)
            }
            (Form::Ranked | Form::Cut { .. } | Form::Slope { .. } | Form::Root { .. }, _) => return None,
        })
    }
}

/// The coordinate of a family without one of its own: that of its space.
fn of_space(dist: &Dist) -> Option<Form> {
    match dist.family().space() {
        Space::Line => Some(Form::Straight { center: dist.center()?, unit: dist.scale()?, exact: false }),
        Space::Positive => Some(Form::Log { center: 0.0, unit: 1.0, exact: false }),
        Space::Unit => Some(Form::Logit { center: 0.0, unit: 1.0 }),
        Space::Bounded | Space::Circle | Space::Simplex | Space::Vectors => None,
        Space::Booleans | Space::Categories | Space::Integers | Space::Counts => None,
        Space::Truths | Space::Components | Space::Fixed => None,
    }
}

/// The coordinate of a truncated Gaussian. Tails are computed on the side of the mean where most of the interval lies, so
/// that their differences lose few digits; if they would lose many, an exponential is used.
fn cut(mean: f64, sd: f64, lo: f64, hi: f64) -> Form {
    let (a, b) = ((lo - mean) / sd, (hi - mean) / sd);
    let sign = if a + b > 0.0 { -1.0 } else { 1.0 };
    let (a, b) = if sign < 0.0 { (-b, -a) } else { (a, b) };
    let (below, above) = (normal_tail(-a), normal_tail(b));
    let reach = normal_tail(-b);
    let mass = if b <= 0.0 { reach - below } else { 1.0 - above - below };
    if b > -30.0 && mass > 0.02 * reach {
        Form::Cut { sign, below, above, mass }
    } else {
        Form::Slope { from_lo: sign < 0.0, rate: (-b).max(0.0), width: (hi - lo) / sd }
    }
}

#[cfg(test)]
mod tests {
    //! The coordinate of a space leads back to the value, and its prior agrees with that of the value.
    use super::*;

    #[test]
    fn coordinates_of_spaces_have_the_density_of_their_values() {
        let dists: [Dist; 4] = [
            Dist::Laplace { loc: 1.0, scale: 0.5 },
            Dist::Gamma { shape: 2.0, scale: 0.7 },
            Dist::Exponential { rate: 3.0 },
            Dist::Beta { a: 2.0, b: 3.0 },
        ];
        for dist in &dists {
            let line = Line { dist, form: of_space(dist).expect("a space of real numbers") };
            for x in [0.03, 0.2, 0.6, 0.97] {
                let place = |x: f64| line.place(x, dist.log_density_of_real(x));
                let back = line.value(place(x).z).expect("within the limits");
                assert!((back - x).abs() < 1e-12, "{dist:?} at {x}: {back}");
                let slope = (place(x + 1e-6).z - place(x - 1e-6).z) / 2e-6;
                let expected = dist.log_density_of_real(x) - slope.ln();
                assert!((place(x).log_prior - expected).abs() < 1e-6, "{dist:?} at {x}");
            }
        }
        assert!(of_space(&Dist::Uniform { lo: 0.0, hi: 1.0 }).is_none());
    }
}
