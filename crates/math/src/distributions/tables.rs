//! Categorical distributions side by side, for many draws, such as those of all particles.
//!
//! Each distribution is a row of fixed length, so a draw compares a fixed number of sums, without a jump.

use super::family::Dist;
use crate::rounding::grid;

/// Categorical distributions over few choices, as rows of a table.
///
/// ```
/// use niwaki_math::distributions::Tables;
/// use niwaki_math::{Dist, Family, Param, Stream, StreamKey, grid};
/// let coin = Dist::new(Family::Categorical, &[Param::Vector(vec![0.2, 0.8])]).unwrap();
/// let tables = Tables::of(&[&coin]).unwrap();
/// let mut draw = (0, 0.0);
/// tables.draw([(0, 0.5)].into_iter(), |k, log| draw = (k, log));
/// assert_eq!(draw, (1, grid(coin.log_density_of_int(1))));
/// ```
#[derive(Clone, Debug)]
pub struct Tables {
    /// The number of entries in a row.
    width: usize,
    /// Running sums of probabilities; 1 in the unused entries.
    cumulative: Vec<f64>,
    /// Log probabilities on the grid, nats.
    log: Vec<f64>,
}

impl Tables {
    /// The tables of distributions; `None` if one is not categorical, or has more than 16 choices.
    pub fn of(dists: &[&Dist]) -> Option<Tables> {
        let all = dists.iter().map(|dist| match dist {
            Dist::Categorical(weights) => Some(&**weights),
            _ => None,
        });
        let all: Vec<_> = all.collect::<Option<_>>()?;
        let most = all.iter().map(|weights| weights.len()).max()?;
        let width = [4, 8, 16].into_iter().find(|width| *width >= most)?;
        let (mut cumulative, mut log) = (Vec::new(), Vec::new());
        for weights in all {
            cumulative.extend_from_slice(weights.cumulative());
            log.extend((0..weights.len() as i64).map(|k| grid(weights.log_probability(k))));
            let end = cumulative.len().next_multiple_of(width);
            cumulative.resize(end, 1.0);
            log.resize(end, f64::NEG_INFINITY);
        }
        Some(Tables { width, cumulative, log })
    }

    /// Draws from a row by a uniform, for each pair of row and uniform, as [`Dist::sample`] does. Each choice goes to `each`
    /// with its log probability on the [`grid`].
    #[inline]
    pub fn draw(&self, all: impl Iterator<Item = (usize, f64)>, each: impl FnMut(i64, f64)) {
        match self.width {
            4 => self.draw_wide::<4>(all, each),
            8 => self.draw_wide::<8>(all, each),
            _ => self.draw_wide::<16>(all, each),
        }
    }

    #[inline(always)]
    fn draw_wide<const WIDTH: usize>(
        &self,
        all: impl Iterator<Item = (usize, f64)>,
        mut each: impl FnMut(i64, f64),
    ) {
        let (rows, _) = self.cumulative.as_chunks::<WIDTH>();
        let (logs, _) = self.log.as_chunks::<WIDTH>();
        for (row, u) in all {
            let k = rows[row].iter().map(|sum| usize::from(*sum <= u)).sum::<usize>();
            each(k as i64, logs[row][k & (WIDTH - 1)]);
        }
    }
}

#[cfg(test)]
mod tests {
    //! Draws and log probabilities equal those of the distributions, to the bit.
    use super::*;
    use crate::streams::StreamKey;
    use crate::{Draw, Family, Param};

    fn categorical(weights: Vec<f64>) -> Dist {
        Dist::new(Family::Categorical, &[Param::Vector(weights)]).unwrap()
    }

    #[test]
    fn draws_equal_those_of_the_distributions() {
        for most in [1, 3, 4, 5, 8, 9, 16] {
            let weights = |d: usize| {
                (0..1 + d % most).map(move |k| ((k * 7 + d) % 5) as f64 + 0.01 * k as f64 + f64::from(k == 0))
            };
            let dists: Vec<Dist> = (0..20).map(|d| categorical(weights(d).collect())).collect();
            let tables = Tables::of(&dists.iter().collect::<Vec<_>>()).unwrap();
            let streams = (0..500).map(|n| StreamKey::new(1, n, 0).at(5));
            let mut drawn = Vec::new();
            let units = streams.clone().map(|mut stream| stream.uniform()).enumerate();
            tables.draw(units.map(|(n, u)| (n % 20, u)), |k, log| drawn.push((k, log)));
            for (n, mut stream) in streams.enumerate() {
                let (Draw::Int(k), log) = dists[n % 20].sample_and_score(&mut stream) else {
                    panic!("a number")
                };
                assert_eq!(drawn[n], (k, grid(log)));
            }
        }
    }

    #[test]
    fn other_distributions_have_no_tables() {
        let coin = Dist::new(Family::Bernoulli, &[Param::Real(0.5)]).unwrap();
        assert!(Tables::of(&[&categorical(vec![1.0; 16]), &coin]).is_none());
        assert!(Tables::of(&[&categorical(vec![1.0; 17])]).is_none());
        assert!(Tables::of(&[]).is_none());
    }
}
