//! Sums of numbers whose logarithms are known, relative to the largest, so that nothing overflows.

use crate::scalar::Scalar;

/// The log of the mean of exponentials, added up in order; `-inf` of an empty list.
///
/// ```
/// use niwaki_math::log_sums::log_mean_exp;
/// assert_eq!(log_mean_exp([1000.0, 1000.0].into_iter()), 1000.0);
/// ```
pub fn log_mean_exp(logs: impl Iterator<Item = f64> + Clone) -> f64 {
    let (max, n) = logs.clone().fold((f64::NEG_INFINITY, 0usize), |(m, n), x| (m.max(x), n + 1));
    if max == f64::NEG_INFINITY || n == 0 {
        return f64::NEG_INFINITY;
    }
    let sum: f64 = logs.map(|x| (x - max).exp()).sum();
    max + (sum / n as f64).ln()
}

/// The log of the sum of exponentials, added up in order.
pub fn log_sum_exp(logs: impl Iterator<Item = f64> + Clone) -> f64 {
    let n = logs.clone().count();
    log_mean_exp(logs) + (n.max(1) as f64).ln()
}

/// `ln sum exp` of numbers that may be recorded, added up in order; `-inf` if none is above it. Operations, not comparisons,
/// determine the largest number, so that a recording holds everywhere.
pub fn log_sum_exp_of<S: Scalar>(logs: impl Iterator<Item = S> + Clone) -> S {
    let shift = logs.clone().fold(S::from_f64(f64::NEG_INFINITY), S::max);
    if shift.value() == f64::NEG_INFINITY {
        return shift;
    }
    let possible = logs.filter(|log| log.value() > f64::NEG_INFINITY);
    shift + possible.fold(S::from_f64(0.0), |sum, log| sum + (log - shift).exp()).ln()
}

/// `ln(exp(a) + exp(b))`.
pub fn log_add_exp(a: f64, b: f64) -> f64 {
    let (large, small) = if a > b { (a, b) } else { (b, a) };
    if large == f64::NEG_INFINITY { large } else { large + (small - large).exp().ln_1p() }
}
