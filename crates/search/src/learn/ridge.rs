//! Ridge regression: a line through examples, whose slopes stay as small as the examples held out demand.
//!
//! With standardised inputs `X` (a row for each of `n` examples) and centred labels `y`, the weights at strength `s` are
//!
//! ```text
//! w = (X^T X / n + s I)^(-1)  X^T y / n
//! ```
//!
//! Sums run in the order of the examples, so equal examples give equal bits.

use niwaki_continuous::hamiltonian::metric::{cholesky, solve};

/// Exponents of the strengths, which are powers of ten.
const EXPONENTS: std::ops::RangeInclusive<i32> = -6..=1;

/// Examples: inputs row by row, and a label for each.
#[derive(Clone, Debug, Default)]
pub(super) struct Examples {
    pub inputs: Vec<f64>,
    pub labels: Vec<f64>,
}

/// A fitted line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    pub constant: f64,
    pub weights: Vec<f64>,
    /// The best strength.
    pub strength: f64,
}

impl Examples {
    /// Each row with its label.
    fn rows(&self) -> impl Iterator<Item = (&[f64], f64)> {
        let width = self.inputs.len() / self.labels.len().max(1);
        self.inputs.chunks_exact(width.max(1)).zip(self.labels.iter().copied())
    }

    /// The mean square error of a line.
    pub fn error(&self, line: &Line) -> f64 {
        let square = |(row, label): (&[f64], f64)| (label - line.at(row)).powi(2);
        self.rows().map(square).sum::<f64>() / self.labels.len() as f64
    }
}

impl Line {
    /// The label by the line for a row.
    pub fn at(&self, row: &[f64]) -> f64 {
        self.constant + self.weights.iter().zip(row).map(|(w, x)| w * x).sum::<f64>()
    }
}

/// The line through `learned` with the strength that is best for `judging`; if that is empty, for `learned`. `None` without
/// examples, or if a number is not finite.
pub(super) fn ridge(learned: &Examples, judging: &Examples) -> Option<Line> {
    let n = learned.labels.len() as f64;
    let width = learned.rows().next()?.0.len();
    let mean = |of: &dyn Fn(&[f64], f64) -> f64| learned.rows().map(|(row, y)| of(row, y)).sum::<f64>() / n;
    let label = mean(&|_, y| y);
    let means: Vec<f64> = (0..width).map(|k| mean(&|row, _| row[k])).collect();
    // A constant input has no slope.
    let scale = |k: usize| {
        let sd = mean(&|row, _| (row[k] - means[k]).powi(2)).sqrt();
        if sd > 1e-9 * (1.0 + means[k].abs()) { 1.0 / sd } else { 0.0 }
    };
    let scales: Vec<f64> = (0..width).map(scale).collect();
    let (mut gram, mut slope) = (vec![0.0; width * width], vec![0.0; width]);
    let mut x = vec![0.0; width];
    for (row, y) in learned.rows() {
        for k in 0..width {
            x[k] = (row[k] - means[k]) * scales[k];
            slope[k] += x[k] * (y - label) / n;
        }
        for (to, a) in gram.chunks_exact_mut(width).zip(&x) {
            for (to, b) in to.iter_mut().zip(&x) {
                *to += a * b / n;
            }
        }
    }
    let at_strength = |exponent: i32| {
        let strength = 10.0_f64.powi(exponent);
        let mut matrix = gram.clone();
        (0..width).for_each(|k| matrix[k * width + k] += strength);
        let standardised = solve(&cholesky(&matrix)?, &slope);
        let weights: Vec<f64> = standardised.iter().zip(&scales).map(|(w, s)| w * s).collect();
        let constant = label - weights.iter().zip(&means).map(|(w, m)| w * m).sum::<f64>();
        Some(Line { constant, weights, strength })
    };
    let judges = if judging.labels.is_empty() { learned } else { judging };
    let lines = EXPONENTS.filter_map(at_strength).map(|line| (judges.error(&line), line));
    let best = lines.filter(|(error, _)| error.is_finite()).min_by(|(a, _), (b, _)| a.total_cmp(b));
    best.map(|(_, line)| line)
}

#[cfg(test)]
mod tests {
    //! The line of exact points is found for inputs of any scale; noise is not learnt by heart.
    use super::*;
    use niwaki_math::Stream;

    fn points(n: usize, noise: f64, seed: u64) -> Examples {
        let mut stream = Stream::new(seed, 0, 0, 0);
        let mut all = Examples::default();
        for _ in 0..n {
            let row = [1000.0 + 3.0 * stream.normal(), 1e-3 * stream.normal(), 7.0];
            all.labels.push(2.0 + 0.5 * row[0] - 400.0 * row[1] + noise * stream.normal());
            all.inputs.extend(row);
        }
        all
    }

    #[test]
    fn a_line_comes_back() {
        let line = ridge(&points(50, 0.0, 1), &points(20, 0.0, 2)).unwrap();
        assert_eq!(line.strength, 1e-6);
        for (weight, real) in line.weights.iter().zip([0.5, -400.0, 0.0]) {
            assert!((weight - real).abs() <= 1e-5 * real.abs(), "{line:?}");
        }
        assert!((line.at(&[1001.0, 0.0, 7.0]) - 502.5).abs() < 1e-4);
    }

    #[test]
    fn the_strength_follows_the_examples_held_out() {
        // Labels that do not depend on inputs: the largest strength is best for other examples.
        let noise = |seed| {
            let mut examples = points(30, 0.0, seed);
            let mut stream = Stream::new(seed, 1, 0, 0);
            examples.labels.iter_mut().for_each(|y| *y = stream.normal());
            examples
        };
        assert_eq!(ridge(&noise(3), &noise(4)).unwrap().strength, 10.0);
        assert_eq!(ridge(&noise(3), &Examples::default()).unwrap().strength, 1e-6);
    }

    #[test]
    fn without_numbers_there_is_no_line() {
        assert_eq!(ridge(&Examples::default(), &Examples::default()), None);
        let mut bad = points(10, 0.0, 5);
        bad.labels[3] = f64::NAN;
        assert_eq!(ridge(&bad, &Examples::default()), None);
    }
}
