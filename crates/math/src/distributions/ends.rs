//! Ends of intervals, where the numbers of 64 bits end before the interval does.
//!
//! A value is the nearest number of 64 bits inside its interval, and the last such number at each end stands for everything
//! beyond it. The mass beyond may be large: half of the mass of `gamma(0.001, 1000)` is below 1e-305, and one part in eighty of
//! the mass of `beta(0.1, 0.1)` is above `1 - 1e-16`. So a density at the last number says nothing about its probability.
//! Coordinates without bounds ([`super::coordinates`]) do not end there, and every kernel uses the density of the coordinate:
//!
//! * forward runs draw a coordinate and round its number;
//! * gradient methods move the coordinate; the program sees its number ([`Dist::log_density_of_coordinate`]);
//! * a small move ([`Dist::moved`]) knows the number alone. From a last number it starts at a coordinate drawn from those that
//!   this number stands for, with their density. Beyond the last number the program sees one value, so that density is
//!   the distribution's alone, and it falls by a constant `rate` for each unit of the coordinate:
//!
//! | family | below | above |
//! | --- | --- | --- |
//! | beta | `a` | `b` |
//! | gamma | `shape` | |
//! | inverse_gamma | | `shape` |
//! | log_normal | a normal | a normal |
//! | others | 1 | 1 |
//!
//! The empty table cells fall faster than that, and have no mass. Intervals whose bounds are parameters (uniform,
//! truncated_gaussian) have the bounds as last numbers: their densities are finite there.

use super::coordinates::Interval;
use super::draw::Draw;
use super::family::Dist;
use super::space::Space;
use super::support::Support;
use super::truncated;
use crate::log_sums::log_sum_exp_of;
use crate::scalar::Scalar;
use crate::streams::{RngCore, open_unit};
use rand_distr::{Distribution, Exp1, StandardNormal};
use std::f64::consts::FRAC_1_SQRT_2;

/// Least and greatest coordinate whose `exp` is a normal number.
pub const COORDINATES: (f64, f64) = (-708.0, 709.0);
/// Least and greatest positive number: each stands for all numbers beyond it. They are e to the power of [`COORDINATES`], up
/// to rounding.
const LAST: (f64, f64) = (LEAST, 8.218e307);
/// The least share or positive number; it stands for all smaller numbers.
pub const LEAST: f64 = 3.307_554e-308;

impl Interval {
    /// The least and the greatest number inside the interval.
    pub fn inside(&self) -> (f64, f64) {
        let least = |lo: f64| if lo == 0.0 { LAST.0 } else { lo.next_up() };
        let most = |hi: f64| if hi == 0.0 { -LAST.0 } else { hi.next_down() };
        (self.lo.map_or(-LAST.1, least), self.hi.map_or(LAST.1, most))
    }

    /// The coordinate at which the last number below or above begins.
    fn begin(&self, (least, most): (f64, f64), above: bool) -> f64 {
        let (at, half) = match above {
            false => (least, 0.5 * (least.next_up() - least)),
            true => (most, 0.5 * (most.next_down() - most)),
        };
        match (self.lo, self.hi, above) {
            (Some(lo), Some(hi), false) => ((at - lo) + half).ln() - (hi - at).ln(),
            (Some(lo), Some(hi), true) => (at - lo).ln() - ((hi - at) - half).ln(),
            (Some(lo), None, _) => (at - lo).ln(),
            (None, Some(hi), _) => (hi - at).ln(),
            (None, None, _) => at,
        }
    }

    /// The nearest number of a coordinate, clamped to the last numbers.
    fn nearest(&self, v: f64, (least, most): (f64, f64)) -> f64 {
        let share = |v: f64| 1.0 / (1.0 + (-v).exp());
        let x = match (self.lo, self.hi) {
            (Some(lo), Some(hi)) if v < 0.0 => lo + (hi - lo) * share(v),
            (Some(lo), Some(hi)) => hi - (hi - lo) * share(-v),
            _ => self.value(v).value,
        };
        x.clamp(least, most)
    }

    /// `ln(dx/dv)` at a number.
    fn log_slope(&self, x: f64) -> f64 {
        match (self.lo, self.hi) {
            (None, None) => 0.0,
            (Some(lo), None) => (x - lo).ln(),
            (None, Some(hi)) => (hi - x).ln(),
            (Some(lo), Some(hi)) => ((x - lo) * (hi - x)).ln() - (hi - lo).ln(),
        }
    }
}

impl Support {
    /// Whether a real value, or each share, is strictly between the last numbers.
    pub fn has_inside(&self, value: &Draw) -> bool {
        match (self, value) {
            (Support::Reals(interval), Draw::Real(x)) if *interval != Interval::LINE => {
                let (least, most) = interval.inside();
                *x > least && *x < most
            }
            (Support::Simplex(_), Draw::Vector(x)) => x.iter().all(|x| *x > LEAST && x.is_finite()),
            _ => true,
        }
    }
}

/// `ln(1 / (1 + exp(-v)))`, for any `v`.
fn log_logistic(v: f64) -> f64 {
    v.min(0.0) - (-v.abs()).exp().ln_1p()
}

impl<S: Scalar> Dist<S> {
    /// The space of the values if it is an open interval with constant ends: the ends are not values, and may have much mass
    /// near them.
    pub fn open_space(&self) -> Option<Space> {
        match (self, self.family().space()) {
            (_, space @ (Space::Positive | Space::Unit)) => Some(space),
            (Dist::Mixture(m), _) => {
                let first = m.components.first()?.open_space()?;
                m.components.iter().all(|c| c.open_space() == Some(first)).then_some(first)
            }
            _ => None,
        }
    }

    /// The log density of a positive number, given also its logarithm, as the number may be out of range, nats.
    pub fn log_density_by_log(&self, x: S, log: S) -> S {
        match self {
            Dist::Gamma { shape, scale } => super::waiting::gamma_log_density_at(*shape, *scale, x, log),
            Dist::InverseGamma { shape, scale } => {
                super::waiting::inverse_gamma_log_density_at(*shape, *scale, x, log)
            }
            Dist::LogNormal { mean, sd } => super::bell::gaussian_log_density(*mean, *sd, log) - log,
            Dist::Mixture(m) => {
                let term = |(k, c): (usize, &Dist<S>)| {
                    m.weights.log_probability(k as i64) + c.log_density_by_log(x, log)
                };
                log_sum_exp_of(m.components.iter().enumerate().map(term))
            }
            _ => self.log_density_of_real(x),
        }
    }

    /// The log density over the coordinate of a share of (0, 1), from the logarithms of the share and of the rest, nats.
    pub fn log_density_by_shares(&self, share: S, rest: S) -> Option<S> {
        match self {
            Dist::Beta { a, b } => {
                let norm = a.ln_gamma() + b.ln_gamma() - (*a + *b).ln_gamma();
                Some(*a * share + *b * rest - norm)
            }
            Dist::Mixture(m) => {
                let term = |(k, c): (usize, &Dist<S>)| {
                    c.log_density_by_shares(share, rest).map(|log| m.weights.log_probability(k as i64) + log)
                };
                let terms: Option<Vec<S>> = m.components.iter().enumerate().map(term).collect();
                Some(log_sum_exp_of(terms?.into_iter()))
            }
            _ => None,
        }
    }
}

impl Dist {
    /// The last numbers of the interval: the bounds themselves if they are values.
    fn last(&self, interval: &Interval) -> (f64, f64) {
        match (self.open_space(), interval.lo, interval.hi) {
            (None, Some(lo), Some(hi)) => (lo, hi),
            _ => interval.inside(),
        }
    }

    /// The log density over the coordinate of the interval, also at coordinates beyond the last number, nats.
    pub fn log_density_of_coordinate(&self, interval: &Interval, v: f64) -> f64 {
        let (share, rest) = (log_logistic(v), log_logistic(-v));
        let nearest = || interval.nearest(v, self.last(interval));
        match (self.open_space(), interval.lo.zip(interval.hi)) {
            (Some(Space::Positive), _) => {
                let number = v.clamp(COORDINATES.0, COORDINATES.1).exp();
                self.log_density_by_log(number, v) + v
            }
            (_, Some((lo, hi))) => self
                .log_density_by_shares(share, rest)
                .unwrap_or_else(|| self.log_density_of_real(nearest()) + (hi - lo).ln() + share + rest),
            _ => self.log_density_of_real(nearest()) + interval.log_slope(nearest()),
        }
    }

    /// The decrease of the coordinate's log density for each unit beyond the last number.
    fn rate(&self, above: bool) -> f64 {
        match self {
            Dist::Beta { a, b } => {
                if above {
                    *b
                } else {
                    *a
                }
            }
            Dist::Gamma { shape, .. } if !above => *shape,
            Dist::InverseGamma { shape, .. } if above => *shape,
            _ => 1.0,
        }
    }

    /// A draw of the coordinates for which the last number stands, by their density.
    fn beyond(&self, interval: &Interval, above: bool, rng: &mut (impl RngCore + ?Sized)) -> f64 {
        let begin = interval.begin(self.last(interval), above);
        match self {
            Dist::Mixture(m) => {
                // A component is drawn by its mass there.
                let mass = |(k, c): (usize, &Dist)| {
                    m.weights.log_probability(k as i64) + c.log_mass(interval, above)
                };
                let logs: Vec<f64> = m.components.iter().enumerate().map(mass).collect();
                let most = logs.iter().fold(f64::NEG_INFINITY, |most, log| most.max(*log));
                let shares: Vec<f64> = logs.iter().map(|log| (log - most).exp()).collect();
                let mut rest = open_unit(rng) * shares.iter().sum::<f64>();
                let reached = shares.iter().position(|share| {
                    rest -= share;
                    rest < 0.0
                });
                m.components[reached.unwrap_or(0)].beyond(interval, above, rng)
            }
            Dist::LogNormal { mean, sd } if above => truncated::sample(*mean, *sd, begin, f64::INFINITY, rng),
            Dist::LogNormal { mean, sd } => truncated::sample(*mean, *sd, f64::NEG_INFINITY, begin, rng),
            _ => {
                let e: f64 = Exp1.sample(rng);
                begin + if above { e } else { -e } / self.rate(above)
            }
        }
    }

    /// The log of the mass for which the last number stands, nats.
    fn log_mass(&self, interval: &Interval, above: bool) -> f64 {
        let begin = interval.begin(self.last(interval), above);
        match self {
            Dist::LogNormal { mean, sd } => {
                let z = (begin - mean) / sd;
                (0.5 * libm::erfc(if above { z } else { -z } * FRAC_1_SQRT_2)).ln()
            }
            _ => self.log_density_of_coordinate(interval, begin) - self.rate(above).ln(),
        }
    }

    /// A value moved by a Gaussian step of this deviation in each coordinate, and the log densities of the move and
    /// its reverse, up to common terms. `None` for a value of another kind, and for a discrete value.
    pub fn moved(
        &self,
        old: &Draw,
        deviation: f64,
        rng: &mut (impl RngCore + ?Sized),
    ) -> Option<(Draw, f64, f64)> {
        let mut step = || {
            let z: f64 = StandardNormal.sample(&mut *rng);
            deviation * z
        };
        match (self, self.support(), old) {
            (_, Support::Reals(interval), Draw::Real(x)) if interval != Interval::LINE => {
                let z = step();
                let (new, forward, backward) = self.moved_within(&interval, *x, z, rng);
                Some((Draw::Real(new), forward, backward))
            }
            (Dist::Dirichlet(a), _, Draw::Vector(x)) if x.len() == a.len() => {
                let z: Vec<f64> = x.iter().map(|_| step()).collect();
                let (new, forward, backward) = moved_shares(a, x, &z, rng);
                Some((Draw::Vector(new.into()), forward, backward))
            }
            (_, support, _) => support.moved(old, step),
        }
    }

    /// A number moved by `z` in its coordinate.
    fn moved_within(
        &self,
        interval: &Interval,
        x: f64,
        z: f64,
        rng: &mut (impl RngCore + ?Sized),
    ) -> (f64, f64, f64) {
        let (least, most) = self.last(interval);
        let is_last = |x: f64| x <= least || x >= most;
        if !is_last(x) {
            let (new, forward, backward) = interval.moved(x, z);
            if !is_last(new) {
                return (new, forward, backward);
            }
        }
        let from = match is_last(x) {
            true => self.beyond(interval, x >= most, rng),
            false => interval.coordinate(x),
        };
        let to = from + z;
        let new = interval.nearest(to, (least, most));
        // The score has the density of the number; the move needs that of the coordinate.
        let log = |x: f64, v: f64| match is_last(x) {
            true => self.log_density_of_real(x) - self.log_density_of_coordinate(interval, v),
            false => -interval.log_slope(x),
        };
        (new, log(new, to), log(x, from))
    }
}

/// Shares whose logarithms move by `z`.
fn moved_shares(a: &[f64], x: &[f64], z: &[f64], rng: &mut (impl RngCore + ?Sized)) -> (Vec<f64>, f64, f64) {
    let products: Vec<f64> = x.iter().zip(z).map(|(x, z)| x * z.exp()).collect();
    let sum: f64 = products.iter().sum();
    let new: Vec<f64> = products.iter().map(|x| x / sum).collect();
    if x.iter().chain(&new).all(|x| *x > LAST.0 && x.is_finite()) {
        let log = |x: &[f64]| -x.iter().map(|x| x.ln()).sum::<f64>();
        let (forward, backward) = (log(&new), log(x));
        return (new, forward, backward);
    }
    let from: Vec<f64> = a
        .iter()
        .zip(x)
        .map(|(a, x)| {
            if *x > LAST.0 {
                return x.ln();
            }
            let e: f64 = Exp1.sample(&mut *rng);
            LAST.0.ln() - e / a
        })
        .collect();
    let mut to: Vec<f64> = from.iter().zip(z).map(|(v, z)| v + z).collect();
    let most = to.iter().fold(f64::NEG_INFINITY, |most, v| most.max(*v));
    let log_sum = most + to.iter().map(|v| (v - most).exp()).sum::<f64>().ln();
    to.iter_mut().for_each(|v| *v -= log_sum);
    let new: Vec<f64> = to.iter().map(|v| v.exp().max(LAST.0)).collect();
    let log = |x: &[f64], v: &[f64]| -> f64 {
        let log_term = |((a, x), v): ((&f64, &f64), &f64)| match *x > LAST.0 {
            true => -x.ln(),
            // This case equals that of an interval. A corner of the simplex has a score if the concentration is one.
            false => (if *a == 1.0 { 0.0 } else { (a - 1.0) * x.ln() }) - a * v,
        };
        a.iter().zip(x).zip(v).map(log_term).sum()
    };
    let (forward, backward) = (log(&new, &to), log(x, &from));
    (new, forward, backward)
}

#[cfg(test)]
mod tests {
    //! Moves from and to any place leave the law of forward draws invariant, also with much mass at the ends.
    use super::super::testing::*;
    use super::*;
    use crate::{Family, Param};

    fn mixture(components: Vec<Dist>) -> Dist {
        let weights = Param::Vector(vec![1.0; components.len()]);
        Dist::new(Family::Mixture, &[weights, Param::Dists(components)]).unwrap()
    }

    fn extreme() -> Vec<Dist> {
        let beta = |a, b| dist(Family::Beta, &[a, b]);
        vec![
            beta(0.2, 0.2),
            beta(0.05, 0.05),
            beta(0.001, 0.002),
            beta(3.0, 0.1),
            dist(Family::Gamma, &[0.001, 1000.0]),
            dist(Family::Gamma, &[1.0, 2.0]),
            dist(Family::InverseGamma, &[0.001, 1e-3]),
            dist(Family::LogNormal, &[0.0, 1000.0]),
            dist(Family::Exponential, &[1e3]),
            dist(Family::Uniform, &[-1.0, 3.0]),
            dist(Family::TruncatedGaussian, &[0.0, 1.0, 0.0, 2.0]),
            mixture(vec![beta(0.05, 1.0), beta(2.0, 0.05)]),
            mixture(vec![dist(Family::Gamma, &[0.002, 1.0]), dist(Family::LogNormal, &[0.0, 900.0])]),
        ]
    }

    /// A move from each of many forward draws leaves the share of draws at the ends, and of those on one side of a coordinate,
    /// unchanged. The test compares a share before and after the move: of n pairs, the difference of the two counts is
    /// within 4.5 times the root of the number of changed pairs, except with probability 7e-6.
    #[test]
    fn moves_keep_the_law_of_forward_draws() {
        for (number, d) in extreme().into_iter().enumerate() {
            let Support::Reals(interval) = d.support() else { panic!("an interval") };
            let (least, most) = d.last(&interval);
            let sides: [&dyn Fn(f64) -> bool; 5] = [
                &|x| x <= least,
                &|x| x >= most,
                &|x| interval.coordinate(x) < -30.0,
                &|x| interval.coordinate(x) < 0.0,
                &|x| interval.coordinate(x) < 30.0,
            ];
            let mut changes = [(0_i32, 0_i32); 5];
            for k in 0..60_000 {
                let mut rng = stream(1_000_000 * (number as u64 + 1) + k);
                let Draw::Real(x) = d.sample(&mut rng) else { panic!("a number") };
                let (new, forward, backward) = d.moved(&Draw::Real(x), 8.0, &mut rng).unwrap();
                let Draw::Real(y) = new else { panic!("a number") };
                let is_open = d.open_space().is_some();
                assert!(!is_open || interval.lo < Some(y) && interval.hi.is_none_or(|hi| y < hi), "{y}");
                let score = |x: f64| d.log_density(&Draw::Real(x));
                let log = score(y) - score(x) + backward - forward;
                assert!(!log.is_nan(), "{d:?} {x} {y}");
                let after = if open_unit(&mut rng).ln() < log { y } else { x };
                for (side, (more, fewer)) in sides.iter().zip(&mut changes) {
                    *more += i32::from(side(after) && !side(x));
                    *fewer += i32::from(side(x) && !side(after));
                }
            }
            for (k, (more, fewer)) in changes.iter().enumerate() {
                let error = f64::from(more + fewer).sqrt();
                assert!(f64::from(more - fewer).abs() <= 4.5 * error.max(1.0), "{d:?} {k}: {more} {fewer}");
            }
        }
    }

    #[test]
    fn the_coordinate_has_all_of_the_mass() {
        for d in extreme() {
            let Support::Reals(interval) = d.support() else { panic!("an interval") };
            // Tails of rate 0.001 reach far beyond the numbers.
            let step = 0.01;
            let mass: f64 = (-3_000_000..3_000_000)
                .map(|k| step * d.log_density_of_coordinate(&interval, step * f64::from(k)).exp())
                .sum();
            assert!((mass - 1.0).abs() < 1e-4, "{d:?}: {mass}");
        }
    }

    #[test]
    fn shares_move_without_leaving_the_simplex() {
        let d = Dist::new(Family::Dirichlet, &[Param::Vector(vec![0.002, 0.003, 0.001])]).unwrap();
        let (mut changes, first) = ([(0_i32, 0_i32); 3], |x: &Draw, k: usize| entry(x, k) <= LAST.0);
        for k in 0..60_000 {
            let mut rng = stream(77_000_000 + k);
            let x = d.sample(&mut rng);
            let (y, forward, backward) = d.moved(&x, 100.0, &mut rng).unwrap();
            let log = d.log_density(&y) - d.log_density(&x) + backward - forward;
            assert!(!log.is_nan() && d.log_density(&y).is_finite(), "{x:?} {y:?}");
            let after = if open_unit(&mut rng).ln() < log { &y } else { &x };
            for (k, (more, fewer)) in changes.iter_mut().enumerate() {
                *more += i32::from(first(after, k) && !first(&x, k));
                *fewer += i32::from(first(&x, k) && !first(after, k));
            }
        }
        for (more, fewer) in changes {
            assert!(f64::from(more - fewer).abs() <= 4.5 * f64::from(more + fewer).sqrt(), "{more} {fewer}");
            assert!(more > 100);
        }
    }
}
