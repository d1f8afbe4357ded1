//! What both filters share: uniform and discrete draws, and systematic resampling.
use rand::RngExt;
pub use rand::SeedableRng;

/// The generator: xoshiro256++, as cheap as a good one gets.
pub type Random = rand_xoshiro::Xoshiro256PlusPlus;

/// A uniform draw from `[0, 1)`.
#[inline]
pub fn uniform(random: &mut Random) -> f64 {
    random.random()
}

/// Running sums of probabilities, as `draw` reads them.
pub fn cumulative(probabilities: &[f64]) -> Vec<f64> {
    probabilities
        .iter()
        .scan(0.0, |sum, p| {
            *sum += p;
            Some(*sum)
        })
        .collect()
}

/// An index from its running sums of probabilities, without branches: the tables are ten long.
#[inline]
pub fn draw(random: &mut Random, sums: &[f64]) -> usize {
    let u = uniform(random);
    sums[..sums.len() - 1].iter().map(|&sum| usize::from(u >= sum)).sum()
}

/// Systematic resampling: `parents[k]` becomes the row that row `k` continues.
///
/// One uniform number shifts a comb of evenly spaced teeth; each row is continued as many times as teeth
/// fall into its share of `total`, the sum of `weights`.
pub fn resample(weights: &[f64], total: f64, random: &mut Random, parents: &mut [u32]) {
    let space = total / parents.len() as f64;
    let mut tooth = uniform(random) * space;
    let (mut row, mut sum) = (0, weights[0]);
    for parent in parents.iter_mut() {
        while tooth > sum && row + 1 < weights.len() {
            row += 1;
            sum += weights[row];
        }
        *parent = row as u32;
        tooth += space;
    }
}
