//! The grid on which log scores are added and taken away exactly.
//!
//! A score that is kept up to date (`total - old + new`) drifts away from one that is summed afresh, and two
//! runs that made the same choices in another order would disagree in the last bits. Terms on a common grid
//! of 2^-32 nats have exact sums, in any order, as long as totals stay below 2^20 nats.

/// 1.5 * 2^20: adding it leaves 32 binary places, for terms below 2^19.
const NEAR: f64 = 1.5 * (1u64 << 20) as f64;
/// 1.5 * 2^40: the same with 12 binary places, for terms below 2^39.
const FAR: f64 = 1.5 * (1u64 << 40) as f64;

/// The nearest multiple of 2^-32 nats; beyond half a million nats, of 2^-12. Infinities and NaN pass.
///
/// ```
/// assert_eq!(niwaki_math::grid(0.1 + 1e-12), niwaki_math::grid(0.1));
/// assert_eq!(niwaki_math::grid(f64::NEG_INFINITY), f64::NEG_INFINITY);
/// ```
#[inline]
pub fn grid(x: f64) -> f64 {
    let size = x.abs();
    if size < 524_288.0 {
        (x + NEAR) - NEAR
    } else if size < 549_755_813_888.0 {
        (x + FAR) - FAR
    } else {
        x
    }
}

#[cfg(test)]
mod tests {
    //! Grid values are multiples of the step, near what they stand for, and add up exactly in any order.
    use super::*;

    #[test]
    fn values_are_the_nearest_multiples() {
        let step = 2.0_f64.powi(-32);
        for x in [0.0, 1.0, -1.0, 0.1, -700.123, 524_287.9, -524_287.9, 1e-12] {
            let g = grid(x);
            assert!((g - x).abs() <= 0.5 * step, "{x}");
            assert_eq!((g / step).fract(), 0.0, "{x}");
        }
        assert_eq!(grid(-524_289.3), (-524_289.3_f64 * 4096.0).round() / 4096.0);
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
