//! Means and deviations of inputs, with which training standardises them.
//!
//! The network standardises features itself, so that a feature that a site lacks can count as its mean. For
//! windows, means and deviations go into the weights of the first layer when training ends.

use super::rows::Rows;
use crate::net::{Layout, Net, Real};

/// Least deviation of a window's number, as a share of the largest: smaller deviations count as this one, so that a number
/// that was nearly constant is not blown up.
const LEAST: f64 = 0.05;
/// Least deviation of a feature, as a share of its size; with a smaller deviation the feature counts as constant.
const SAME: f64 = 1e-6;

/// Sums over inputs, in the order of the rows.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Sums {
    /// Welford's update.
    fn add(&mut self, x: f64) {
        if x.is_finite() {
            self.count += 1.0;
            let step = x - self.mean;
            self.mean += step / self.count;
            self.squares += step * (x - self.mean);
        }
    }

    fn deviation(&self) -> f64 {
        (self.squares / self.count.max(1.0)).sqrt()
    }
}

/// One over a deviation; zero for a deviation of zero.
fn inverse<T: Real>(deviation: f64) -> T {
    T::from_f64(if deviation > 0.0 { 1.0 / deviation } else { 0.0 })
}

/// Mean and one over deviation of each number of a window.
pub(super) fn of_windows<T: Real>(rows: &Rows, windows: usize) -> Vec<(T, T)> {
    let mut sums = vec![Sums::default(); windows];
    for window in rows.all_windows() {
        sums.iter_mut().zip(window).for_each(|(sum, x)| sum.add(f64::from(*x)));
    }
    let largest = sums.iter().map(Sums::deviation).fold(0.0, f64::max);
    let least = LEAST * largest;
    sums.iter().map(|s| (T::from_f64(s.mean), inverse(s.deviation().max(least)))).collect()
}

/// Sets means and deviations of a network's features that have none yet.
pub(super) fn set_features<T: Real>(net: &mut Net<T>, rows: &Rows) {
    let mut sums = vec![Sums::default(); net.features.len()];
    for (k, x) in rows.all_features() {
        sums[*k as usize].add(f64::from(*x));
    }
    for (feature, sum) in net.features.iter_mut().zip(sums) {
        let deviation = sum.deviation();
        if feature.1 == T::ZERO && deviation > SAME * sum.mean.abs() {
            *feature = (T::from_f64(sum.mean), inverse(deviation));
        }
    }
}

/// Turns weights for standardised windows into weights for raw windows.
pub(super) fn fold<T: Real>(net: &mut Net<T>, scaling: &[(T, T)]) {
    let width = net.layout.width[0];
    let first = net.layout.first;
    for (k, (mean, scale)) in scaling.iter().enumerate() {
        let row = Layout::row(net.layout.windows, k, width);
        for (lane, at) in row.enumerate() {
            let w = net.weights[at] * *scale;
            net.weights[at] = w;
            let constant = net.weights[first + lane] - w * *mean;
            net.weights[first + lane] = constant;
        }
    }
}

/// Turns weights for raw windows into weights for standardised windows: the inverse of [`fold`]. The weights of a number
/// that never changes stay as they are.
pub(super) fn unfold<T: Real>(net: &mut Net<T>, scaling: &[(T, T)]) {
    let width = net.layout.width[0];
    let first = net.layout.first;
    for (k, (mean, scale)) in scaling.iter().enumerate() {
        let row = Layout::row(net.layout.windows, k, width);
        for (lane, at) in row.enumerate() {
            let w = net.weights[at];
            let constant = net.weights[first + lane] + w * *mean;
            net.weights[first + lane] = constant;
            if *scale > T::ZERO {
                net.weights[at] = w / *scale;
            }
        }
    }
}
