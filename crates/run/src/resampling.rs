//! Resampling: the number of copies of each particle. All methods are unbiased: the expected number of copies of
//! particle `i` is `N w_i / sum w` (Douc and Cappe 2005), where `w` are the weights of the particles, or
//! for [`Resampling::Tempered`] a power of them. Survivors keep their index, and their further copies replace those that got
//! no copy.

use niwaki_math::Stream;
use serde::Deserialize;

/// A resampling method.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Hash)]
#[serde(rename_all = "kebab-case")]
pub enum Resampling {
    /// One uniform draw, `N` points at equal distances: particle `k` gets
    /// `floor(N C_k + u) - floor(N C_{k-1} + u)` copies, `C` the cumulative normalised weights.
    Systematic,
    /// `floor(N w_i)` copies each; further copies are drawn multinomially from the remainders.
    Residual,
    /// A uniform draw in each of `N` equal intervals.
    Stratified,
    /// `N` independent draws.
    Multinomial,
    /// Systematic, by a power of the weights; the copies keep the remaining power as their weight (`tempered`).
    Tempered,
}

impl Resampling {
    /// All resampling methods.
    pub const ALL: [Resampling; 5] = [
        Resampling::Systematic,
        Resampling::Residual,
        Resampling::Stratified,
        Resampling::Multinomial,
        Resampling::Tempered,
    ];

    /// Draw the number of copies of each particle; the sum is the number of particles. `weights` are not negative and not all
    /// zero.
    pub fn copies(self, weights: &[f64], random: &mut Stream) -> Vec<usize> {
        let n = weights.len();
        let total: f64 = weights.iter().sum();
        match self {
            Resampling::Systematic | Resampling::Tempered => {
                let u = random.uniform();
                place(weights, total, ROUNDED, |k| (k as f64 + u) / n as f64)
            }
            Resampling::Stratified => {
                let us: Vec<f64> = (0..n).map(|_| random.uniform()).collect();
                place(weights, total, 1.0, |k| (k as f64 + us[k]) / n as f64)
            }
            Resampling::Multinomial => multinomial(weights, n, random),
            Resampling::Residual => {
                let share: Vec<f64> = weights.iter().map(|w| n as f64 * w / total).collect();
                let mut copies: Vec<usize> = share.iter().map(|s| s.floor() as usize).collect();
                let rest: Vec<f64> = share.iter().map(|s| s - s.floor()).collect();
                let left = n - copies.iter().sum::<usize>().min(n);
                if left > 0 {
                    let drawn = multinomial(&rest, left, random);
                    copies.iter_mut().zip(drawn).for_each(|(c, d)| *c += d);
                }
                copies
            }
        }
    }

    /// Copies of each particle, one of which may be `held`. The held particle survives for certain; the others are drawn independently,
    /// whatever the method is. Only independent draws have this simple conditional form (Andrieu, Doucet & Holenstein 2010, section 4.3).
    pub fn copies_with(self, held: Option<usize>, weights: &[f64], random: &mut Stream) -> Vec<usize> {
        let Some(held) = held else { return self.copies(weights, random) };
        let mut copies = multinomial(weights, weights.len() - 1, random);
        copies[held] += 1;
        copies
    }
}

/// How many numbers from the start of a range have a property. Apart from its caller, whose usual way needs no loop.
#[cold]
#[inline(never)]
fn count(among: std::ops::Range<usize>, has: impl Fn(usize) -> bool) -> usize {
    among.take_while(|k| has(*k)).count()
}

/// The largest rounding error of a point, in distances of points, for fewer than a thousand million of them.
const ROUNDED: f64 = 1e-6;

/// Counts how many of the increasing points `at(0), at(1), ...` are in each particle's share: the points up to its end less
/// those up to the end of the one before. The points are off equal distances by at most `off` of one, so the number up to an
/// end is known where no point is that near.
fn place(weights: &[f64], total: f64, off: f64, at: impl Fn(usize) -> f64) -> Vec<usize> {
    let n = weights.len();
    let last = weights.iter().rposition(|w| *w > 0.0).unwrap_or(0);
    let (mut cumulative, mut before) = (0.0, 0);
    let (scale, offset) = (n as f64 / total, n as f64 * at(0));
    let mut copies = Vec::with_capacity(n);
    copies.extend(weights[..last].iter().map(|weight| {
        cumulative += weight;
        let is_within = |k: usize| at(k) * total <= cumulative;
        let about = cumulative * scale - offset + 1.0;
        let mut within = (about as usize).clamp(before, n);
        let past = about - within as f64;
        let is_near = !(past > off && past < 1.0 - off);
        if is_near && (within < n && is_within(within) || within > before && !is_within(within - 1)) {
            within = before + count(before..n, is_within);
        }
        within - std::mem::replace(&mut before, within)
    }));
    copies.push(n - before);
    copies.resize(n, 0);
    copies
}

/// How often each particle is drawn in `draws` independent draws by weight.
fn multinomial(weights: &[f64], draws: usize, random: &mut Stream) -> Vec<usize> {
    let cumulative: Vec<f64> = weights
        .iter()
        .scan(0.0, |sum, w| {
            *sum += w;
            Some(*sum)
        })
        .collect();
    let total = cumulative.last().copied().unwrap_or(0.0);
    let last = weights.iter().rposition(|w| *w > 0.0).unwrap_or(0);
    let mut copies = vec![0; weights.len()];
    for _ in 0..draws {
        let u = random.uniform() * total;
        copies[cumulative.partition_point(|c| *c < u).min(last)] += 1;
    }
    copies
}

/// Parent and index of each further copy, parents ascending. The sum of `copies` is at most their number.
pub fn further_copies(copies: &[usize]) -> Vec<(usize, usize)> {
    // Counts are noise, so a jump that depends on one is mostly guessed wrong: what is written too early is written again.
    let mut moves = vec![(0, 0); copies.len() + 1];
    let (mut further, mut dead) = (0, 0);
    for (index, &count) in copies.iter().enumerate() {
        moves[further].0 = index;
        if count > 2 {
            moves[further..further + count - 1].iter_mut().for_each(|(parent, _)| *parent = index);
        }
        further += count.saturating_sub(1);
        moves[dead].1 = index;
        dead += usize::from(count == 0);
    }
    moves.truncate(further.min(dead));
    moves
}

/// Borrow two different particles.
pub fn pair<P>(particles: &mut [P], a: usize, b: usize) -> [&mut P; 2] {
    if a < b {
        let (left, right) = particles.split_at_mut(b);
        [&mut left[a], &mut right[0]]
    } else {
        let (left, right) = particles.split_at_mut(a);
        [&mut right[0], &mut left[b]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_counted_in_the_share_that_they_are_in() {
        let shapes: [fn(usize) -> f64; 4] =
            [|_| 1.0, |i| (i % 3) as f64, |i| 0.3 + (i % 7) as f64, |i| f64::from(i == 5)];
        for (n, weight) in [8, 10, 49, 1000].into_iter().flat_map(|n| shapes.map(|weight| (n, weight))) {
            let weights: Vec<f64> = (0..n).map(weight).collect();
            let total: f64 = weights.iter().sum();
            for u in [0.0, 0.25, 0.5, 1.0 / 3.0, 0.999] {
                let at = |k: usize| (k as f64 + u) / n as f64;
                let sums = weights.iter().scan(0.0, |sum, w| {
                    *sum += w;
                    Some(*sum)
                });
                let last = weights.iter().rposition(|w| *w > 0.0).unwrap();
                let ends = sums.take(last).chain([f64::INFINITY]);
                let within = |end: f64| (0..n).filter(|k| at(*k) * total <= end).count();
                let mut expected = vec![0; n];
                let mut before = 0;
                for (expected, end) in expected.iter_mut().zip(ends) {
                    *expected = within(end) - before;
                    before += *expected;
                }
                assert_eq!(place(&weights, total, ROUNDED, at), expected, "{n} points at {u}");
            }
        }
    }

    #[test]
    fn further_copies_go_where_a_particle_died() {
        let copies = [0, 3, 1, 0, 0, 2, 1, 4, 0, 0, 0];
        let moves = [(1, 0), (1, 3), (5, 4), (7, 8), (7, 9), (7, 10)];
        assert_eq!(further_copies(&copies), moves);
        assert_eq!(further_copies(&[1; 5]), []);
        assert_eq!(further_copies(&[0, 0, 3]), [(2, 0), (2, 1)]);
    }

    /// Expected copies are `N w / sum w`. Each mean over 20,000 draws has a standard error of at most
    /// `sqrt(N p (1 - p) / 20000)`; five of them are exceeded once in 1.7 million, 20 means are looked at.
    #[test]
    fn every_method_is_unbiased() {
        let weights = [0.5, 0.0, 0.1, 2.0, 0.7];
        let (n, total) = (weights.len() as f64, weights.iter().sum::<f64>());
        for method in Resampling::ALL {
            let mut sums = [0usize; 5];
            for i in 0..20_000u64 {
                let mut random = Stream::new(7, 0, u128::from(i), 0);
                let copies = method.copies(&weights, &mut random);
                assert_eq!(copies.iter().sum::<usize>(), 5);
                sums.iter_mut().zip(copies).for_each(|(s, c)| *s += c);
            }
            for (sum, w) in sums.iter().zip(weights) {
                let (mean, p) = (*sum as f64 / 20_000.0, w / total);
                let bound = 5.0 * (n * p * (1.0 - p) / 20_000.0).sqrt();
                assert!((mean - n * p).abs() <= bound, "{method:?}: {mean} for {}", n * p);
            }
        }
    }
}
