//! Random bits as a function of seed, stream, address and visit: no draw depends on the draws before it.
//!
//! The key of a stream is a hash of (seed, stream, visit). A word of 64 random bits is a hash of the key, the address of the choice and
//! the number of the word: two products of 64 by 64 bits, each folded by an exclusive or or used whole, as in the hash functions MUM
//! (Makarov 2016) and wyhash (Wang 2019). A choice therefore draws the same bits whatever was drawn before it, on any thread, after
//! any fork. The bits pass PractRand (Doty-Humphrey 2010) along a stream, across streams and between streams that differ in a single
//! bit: the example `random_bits` repeats that.

use std::convert::Infallible;

/// A source of random bits; `rand_core` calls it `Rng`.
pub use rand_core::Rng as RngCore;
use rand_core::TryRng;
use rand_distr::{Distribution, StandardNormal};

/// Odd numbers whose bits are those of the fractions of the square roots of 2 and 3: they keep a factor of a product from being zero where
/// address and key agree.
const ROOTS: [u64; 2] = [0x6A09_E667_F3BC_C909, 0xBB67_AE85_84CA_A73B];

/// A word from an address and a key.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the two halves of a product")]
fn word([low, high]: [u64; 2], key: u64) -> u64 {
    let product = |a: u64, b: u64| u128::from(a) * u128::from(b);
    let first = product(low ^ key, high ^ key.rotate_left(32) ^ ROOTS[0]);
    let second = product(first as u64 ^ ROOTS[1], (first >> 64) as u64 ^ key);
    second as u64 ^ (second >> 64) as u64
}

/// A bijection of 64 bits in which every input bit reaches every output bit (Stafford 2011, mix 13).
#[inline]
fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// The golden ratio in 64 bits: distinct inputs of [`mix`] stay distinct when it is added.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// The random bits of one choice, word by word.
///
/// ```
/// use niwaki_math::Stream;
/// let first = Stream::new(1, 0, 77, 0).uniform();
/// assert_eq!(first, Stream::new(1, 0, 77, 0).uniform());
/// assert_ne!(first, Stream::new(1, 0, 78, 0).uniform());
/// ```
#[derive(Clone, Debug)]
pub struct Stream {
    /// The address of the choice, in two halves (a `u128` would align the stream to 16 bytes).
    address: [u64; 2],
    /// The key of the next word: the hash of seed, stream and visit, plus [`GOLDEN`] for each word before it.
    key: u64,
}

/// The part of the key that all choices of a stream share: mixed once for many draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamKey(u64);

impl StreamKey {
    /// The key of `stream` (a particle, a chain) for choices drawn for the `visit`-th time.
    #[inline]
    pub fn new(seed: u64, stream: u64, visit: u64) -> StreamKey {
        // Three mixes side by side, not nested: the latency is that of one. The odd factors keep equal numbers in two
        // places from cancelling.
        let base = mix(seed.wrapping_add(GOLDEN))
            .wrapping_add(mix(stream.wrapping_add(GOLDEN)).wrapping_mul(0xA24B_AED4_963E_E407))
            .wrapping_add(mix(visit.wrapping_add(GOLDEN)).wrapping_mul(0x9FB2_1C65_1E98_DF25));
        StreamKey(base)
    }

    /// The key of another visit, from the key of visit 0: `new(seed, stream, 0).revisited(n)` is
    /// `new(seed, stream, n)`, for one mix instead of three.
    #[inline]
    pub fn revisited(self, visit: u64) -> StreamKey {
        let part = |n: u64| mix(n.wrapping_add(GOLDEN)).wrapping_mul(0x9FB2_1C65_1E98_DF25);
        StreamKey(self.0.wrapping_sub(part(0)).wrapping_add(part(visit)))
    }

    /// The bits of the choice at `address`.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the two halves of an address")]
    pub fn at(self, address: u128) -> Stream {
        Stream { address: [address as u64, (address >> 64) as u64], key: self.0 }
    }
}

impl Stream {
    /// The bits of the choice at `address`, drawn for the `visit`-th time in `stream` (a particle, a chain).
    #[inline]
    pub fn new(seed: u64, stream: u64, address: u128, visit: u64) -> Stream {
        StreamKey::new(seed, stream, visit).at(address)
    }

    /// A number in the open interval (0, 1): 52 bits and a half step, so that neither end is reached.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        open_unit(self)
    }

    /// A number from the normal distribution of mean 0 and standard deviation 1.
    #[inline]
    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(self)
    }
}

impl TryRng for Stream {
    type Error = Infallible;

    #[inline]
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.try_next_u64().map(|bits| (bits >> 32) as u32)
    }

    #[inline(always)]
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let bits = word(self.address, self.key);
        self.key = self.key.wrapping_add(GOLDEN);
        Ok(bits)
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        fill(bytes, || self.next_u64());
        Ok(())
    }
}

/// Fills bytes from words of 64 bits.
fn fill(bytes: &mut [u8], mut word: impl FnMut() -> u64) {
    for chunk in bytes.chunks_mut(8) {
        let bits = word().to_le_bytes();
        chunk.copy_from_slice(&bits[..chunk.len()]);
    }
}

/// A number in the open interval (0, 1) from 64 bits of `rng`.
#[inline]
pub fn open_unit(rng: &mut (impl RngCore + ?Sized)) -> f64 {
    unit(rng.next_u64())
}

/// The number in (0, 1) of these bits.
#[inline(always)]
fn unit(bits: u64) -> f64 {
    const STEP: f64 = 1.0 / (1u64 << 52) as f64;
    ((bits >> 12) as f64 + 0.5) * STEP
}

#[cfg(test)]
mod tests {
    //! Streams depend on all four of their coordinates and are uniform.
    use super::*;

    #[test]
    fn every_coordinate_changes_the_bits() {
        let draw = |s, t, a, v| Stream::new(s, t, a, v).next_u64();
        let mut seen = std::collections::HashSet::new();
        for s in 0..6 {
            for t in 0..6 {
                for a in [0, 1, 1 << 40, 1 << 70, 1u128 << 100] {
                    for v in 0..6 {
                        assert!(seen.insert(draw(s, t, a, v)), "{s} {t} {a} {v}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_key_can_be_revisited() {
        for visit in [0, 1, 7, u64::MAX] {
            assert_eq!(StreamKey::new(5, 6, 0).revisited(visit), StreamKey::new(5, 6, visit));
        }
    }

    #[test]
    fn a_stream_does_not_repeat_its_words() {
        let mut stream = Stream::new(3, 1, 4, 1);
        let words: std::collections::HashSet<u64> = (0..10_000).map(|_| stream.next_u64()).collect();
        assert_eq!(words.len(), 10_000);
    }

    #[test]
    fn uniforms_fill_the_unit_interval_evenly() {
        // Chi-square with 63 degrees of freedom, false alarm 1e-6: threshold 131.3. First draws of
        // consecutive addresses, then consecutive draws of one stream.
        let n = 64_000;
        let mut stream = Stream::new(5, 0, 0, 0);
        let first: Vec<f64> = (0..n).map(|k| Stream::new(5, 0, k, 0).uniform()).collect();
        let along: Vec<f64> = (0..n).map(|_| stream.uniform()).collect();
        for draws in [first, along] {
            let mut counts = [0.0; 64];
            for u in draws {
                assert!(u > 0.0 && u < 1.0);
                counts[(u * 64.0) as usize] += 1.0;
            }
            let expected = n as f64 / 64.0;
            let statistic: f64 = counts.iter().map(|c: &f64| (c - expected).powi(2) / expected).sum();
            assert!(statistic < 131.3, "{statistic}");
        }
    }
}
