//! Ranks with ties, and the chi-square statistic of their uniformity.

use niwaki_math::Stream;

/// How many of `others` lie below `value`; ties are broken by a fair draw of their order.
pub fn rank(value: f64, draws: impl Iterator<Item = f64>, stream: &mut Stream) -> usize {
    let (mut below, mut ties) = (0, 0);
    for other in draws {
        below += usize::from(other < value);
        ties += usize::from(other == value);
    }
    below + (stream.uniform() * (ties + 1) as f64) as usize
}

/// The chi-square statistic of counts that should be equal; `bins - 1` degrees of freedom.
pub fn chi_square(counts: &[f64]) -> f64 {
    let expected = counts.iter().sum::<f64>() / counts.len() as f64;
    counts.iter().map(|c| (c - expected).powi(2) / expected).sum()
}

/// How many ranks there are: a value among nine others.
pub const RANKS: usize = 10;
/// Chi-square with 9 degrees of freedom exceeds this with probability 1e-6.
pub const LIMIT: f64 = 44.8;
