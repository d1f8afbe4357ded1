//! Angles among the coordinates of a normal: its density over the circle.
//!
//! The coordinate of an angle is the whole line, and the target repeats with every turn: over the line it has no finite
//! mass. So a normal is compared with it on the circle, where its density is the sum over all turns. With `z` the standard
//! normal number of an angle, given those before it, and `T` its deviation, radians,
//!
//! ```text
//! log q = log sum_k exp(-(z + 2 pi k / T)^2 / 2) - log T - log(2 pi) / 2
//! ```
//!
//! in place of the term of `k = 0`. Of one angle, and of angles that are independent, this is the wrapped normal (Mardia &
//! Jupp 2000, section 3.5.7). Of several that depend on each other it is the product of their conditional densities: the
//! turns of each are shared out by the normal itself, given the coordinates before. The target times these shares
//! integrates over the line to what it integrates to over the circle, so the evidence bound holds, and weights are right.
//! Angles come last in that order ([`Normal::in_order`]), so that every other coordinate says what it can about a turn.

use super::LANES;
use super::batch::Row;
#[cfg(doc)]
use super::normal::Normal;
use std::f64::consts::TAU;

/// From this deviation on the sum over turns is the uniform density to the last bit: its first harmonic is `exp(-T^2 / 2)`.
const FLAT: f64 = 9.0;
/// Terms below this share of the largest do not change the sum.
const NOTHING: f64 = 1e-18;

/// The angles of a normal: the place of each one's `z`, and its deviation given the coordinates before it, radians.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Turns(pub Vec<(usize, f64)>);

impl Turns {
    /// Adds to the log densities of draws over the line what makes them those over the circle, nats.
    pub fn add(&self, z: &[Row], log_q: &mut Row) {
        for (at, deviation) in &self.0 {
            for l in 0..LANES {
                let z = z[*at][l];
                log_q[l] += wound(z, *deviation).0 + 0.5 * z * z;
            }
        }
    }

    /// Makes of each angle's `z` minus the derivative of its log density by it; of other coordinates that is `z`.
    pub fn slopes(&self, z: &mut [Row]) {
        for (at, deviation) in &self.0 {
            z[*at].iter_mut().for_each(|z| *z = wound(*z, *deviation).1);
        }
    }
}

/// The log of the sum over turns of `exp(-(z + 2 pi k / T)^2 / 2)`, and minus its derivative by `z`.
pub fn wound(z: f64, deviation: f64) -> (f64, f64) {
    if deviation >= FLAT {
        return (deviation.ln() - 0.5 * TAU.ln(), 0.0);
    }
    let turn = TAU / deviation;
    let near = z - turn * (z / turn).round();
    let (mut sum, mut slope, mut k) = (1.0, near, 0.0);
    loop {
        k += turn;
        // Relative to the nearest turn, none of whose neighbours is larger.
        let (up, down) = ((-0.5 * k * (k + 2.0 * near)).exp(), (-0.5 * k * (k - 2.0 * near)).exp());
        sum += up + down;
        slope += (near + k) * up + (near - k) * down;
        if up.max(down) < NOTHING || up.is_nan() {
            return (sum.ln() - 0.5 * near * near, slope / sum);
        }
    }
}

#[cfg(test)]
mod tests {
    //! Over one turn the density integrates to one, whatever its width; its slope is that of differences.
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_wound_normal_integrates_to_one_over_one_turn() {
        for deviation in [0.05, 0.5, 1.3, 2.5, 6.0, 8.99, 9.0, 40.0] {
            let cells = 20_000;
            let width = TAU / f64::from(cells);
            let density = |v: f64| (wound(v / deviation, deviation).0).exp() / (deviation * TAU.sqrt());
            // The rule of midpoints is exact to the last digits for a periodic function.
            let first = -PI + 0.5 * width + 31.0 * TAU;
            let mass: f64 = (0..cells).map(|k| width * density(first + width * f64::from(k))).sum();
            assert!((mass - 1.0).abs() < 1e-9, "{deviation}: {mass}");
        }
    }

    #[test]
    fn its_slope_is_that_of_differences_and_it_repeats() {
        for deviation in [0.3, 1.0, 2.0, 5.0] {
            for z in [-7.0, -1.2, 0.0, 0.4, 3.0] {
                let h = 1e-5;
                let (log, slope) = wound(z, deviation);
                let expected = -(wound(z + h, deviation).0 - wound(z - h, deviation).0) / (2.0 * h);
                assert!((slope - expected).abs() < 1e-6 * (1.0 + expected.abs()), "{deviation} {z}");
                assert!((log - wound(z + TAU / deviation, deviation).0).abs() < 1e-9);
            }
        }
    }
}
