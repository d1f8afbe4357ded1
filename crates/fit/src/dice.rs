//! Random numbers with the same bits on every machine: a stream, and draws that use portable functions alone.

use niwaki_math::{Stream, portable};

/// Purposes of random numbers; each has a stream of its own.
#[derive(Clone, Copy, Debug)]
pub enum Purpose {
    /// The first points.
    Design = 1,
    /// Candidates, and changes of length scales.
    Candidates = 2,
    /// Chains of a posterior.
    Chains = 3,
}

/// A source of random numbers.
#[derive(Clone, Debug)]
pub struct Dice(Stream);

impl Dice {
    /// The numbers of a seed for a purpose, for the `number`-th time.
    pub fn new(seed: u64, purpose: Purpose, number: u64) -> Dice {
        Dice(Stream::new(seed, purpose as u64, 0x6669_7400, number))
    }

    /// A number between 0 and 1, exclusive.
    pub fn uniform(&mut self) -> f64 {
        self.0.uniform()
    }

    /// A number between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.uniform() < probability
    }

    /// A whole number below `count`, which is at least 1.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and count")]
    pub fn below(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count - 1)
    }

    /// A number from the normal distribution (Marsaglia & Bray 1964, the polar method).
    pub fn normal(&mut self) -> f64 {
        loop {
            let (x, y) = (self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            let square = x * x + y * y;
            if square < 1.0 && square > 0.0 {
                return x * (-2.0 * portable::ln(square) / square).sqrt();
            }
        }
    }

    /// A whole number from 0 with falling probability: an exponential of this mean, rounded down, and at most `most`.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative, and below most"
    )]
    pub fn early(&mut self, mean: f64, most: usize) -> usize {
        ((-mean * portable::ln(self.uniform())).min(1e9) as usize).min(most)
    }

    /// An index, with probability in proportion to its weight.
    pub fn weighted(&mut self, weights: &[f64]) -> usize {
        let total: f64 = weights.iter().sum();
        let mut left = self.uniform() * total;
        for (index, weight) in weights.iter().enumerate() {
            left -= weight;
            if left < 0.0 {
                return index;
            }
        }
        weights.len() - 1
    }

    /// `count` of the numbers below `total`, each at most once, in random order.
    pub fn some(&mut self, count: usize, total: usize) -> Vec<usize> {
        let mut all: Vec<usize> = (0..total).collect();
        for place in 0..count.min(total) {
            let other = place + self.below(total - place);
            all.swap(place, other);
        }
        all.truncate(count);
        all
    }
}

#[cfg(test)]
mod tests {
    //! Draws follow their distributions; z-scores below 5 (false alarm below 1e-6 each).
    use super::*;

    #[test]
    fn normals_have_the_moments_of_the_bell_curve() {
        let mut dice = Dice::new(3, Purpose::Design, 0);
        let draws: Vec<f64> = (0..20_000).map(|_| dice.normal()).collect();
        let moment = |k: i32| draws.iter().map(|x| x.powi(k)).sum::<f64>() / draws.len() as f64;
        let root = (draws.len() as f64).sqrt();
        assert!(moment(1).abs() < 5.0 / root);
        assert!((moment(2) - 1.0).abs() < 5.0 * 2f64.sqrt() / root);
        assert!((moment(4) - 3.0).abs() < 5.0 * 96f64.sqrt() / root);
    }

    #[test]
    fn some_of_a_set_are_distinct_and_any_of_them() {
        let mut dice = Dice::new(4, Purpose::Design, 0);
        let mut seen = [0; 7];
        for _ in 0..7_000 {
            let mut three = dice.some(3, 7);
            three.sort_unstable();
            three.dedup();
            assert_eq!(three.len(), 3);
            three.iter().for_each(|&k| seen[k] += 1);
        }
        // Each with probability 3/7.
        let deviation = (7_000.0_f64 * 3.0 / 7.0 * 4.0 / 7.0).sqrt();
        assert!(seen.iter().all(|&n| (f64::from(n) - 3_000.0).abs() < 5.0 * deviation), "{seen:?}");
    }
}
