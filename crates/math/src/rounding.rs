//! The grid of log scores.
//!
//! Every log density, factor and sketch is rounded to a multiple of 2^-32 nats. Sums of such numbers can be exact, in
//! any order, and then subtracting a term restores the sum before it: see [`Total`](crate::Total).

/// 1.5 * 2^20: adding this number leaves 32 binary places, for terms below 2^19.
const SHIFT: f64 = 1.5 * (1u64 << 20) as f64;
/// Number of steps in one nat.
const STEPS: f64 = (1u64 << 32) as f64;

/// The nearest multiple of 2^-32 nats, ties to even. Infinities and NaN pass.
///
/// ```
/// assert_eq!(niwaki_math::grid(0.1 + 1e-12), niwaki_math::grid(0.1));
/// assert_eq!(niwaki_math::grid(f64::NEG_INFINITY), f64::NEG_INFINITY);
/// ```
#[inline]
pub fn grid(x: f64) -> f64 {
    let size = x.abs();
    if size < 524_288.0 {
        (x + SHIFT) - SHIFT
    } else if size < 1_048_576.0 {
        (x * STEPS).round_ties_even() / STEPS
    } else {
        // Every number of this size is a multiple.
        x
    }
}

#[cfg(test)]
mod tests {
    //! Grid values are multiples of the step, near the exact numbers, and add up exactly in any order.
    use super::*;

    #[test]
    fn values_are_the_nearest_multiples() {
        let step = 2.0_f64.powi(-32);
        for x in [
            0.0,
            1.0,
            -1.0,
            0.1,
            -700.123,
            524_287.9,
            -524_287.9,
            1e-12,
            -524_289.3,
            1_048_575.9,
            -1e6,
            -1e12 / 3.0,
        ] {
            let g = grid(x);
            assert!((g - x).abs() <= 0.5 * step, "{x}");
            assert_eq!((g / step).fract(), 0.0, "{x}");
        }
        assert_eq!(grid(1e300), 1e300);
        assert!(grid(f64::NAN).is_nan());
    }

    #[test]
    fn sums_are_exact_in_any_order() {
        let terms: Vec<f64> = (1..2000).map(|k| grid((f64::from(k) * 0.7).sin() * 100.0)).collect();
        let forward: f64 = terms.iter().sum();
        let backward: f64 = terms.iter().rev().sum();
        assert_eq!(forward, backward);
        assert_eq!(terms.iter().fold(forward, |total, t| total - t), 0.0);
    }
}
