//! Random bits as a function of seed, stream, address and visit: no draw depends on the draws before it.
//!
//! Philox4x32-10 (Salmon, Moraes, Dror & Shaw 2011, section 3.3 and table 2) turns a 128-bit counter and a
//! 64-bit key into 128 random bits. The counter is the address of the choice; the key is a hash of (seed,
//! stream, visit, block number). A choice therefore draws the same bits whatever was drawn before it, on
//! any thread, after any fork.

use std::convert::Infallible;

/// A source of random bits; `rand_core` calls it `Rng`.
pub use rand_core::Rng as RngCore;
use rand_core::TryRng;
use rand_distr::{Distribution, StandardNormal};

/// Multipliers of the two lanes (Salmon et al. 2011, table 2).
pub(crate) const MULTIPLIER: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
/// Added to the key each round: the golden ratio and the square root of three, less one.
pub(crate) const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];

/// Ten rounds of Philox4x32: 128 random bits from a counter and a key.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the two halves of a product")]
pub fn philox(counter: [u32; 4], key: [u32; 2]) -> [u32; 4] {
    let ([mut a, mut b, mut c, mut d], [mut k, mut l]) = (counter, key);
    for _ in 0..10 {
        let left = u64::from(MULTIPLIER[0]) * u64::from(a);
        let right = u64::from(MULTIPLIER[1]) * u64::from(c);
        (a, b, c, d) = ((right >> 32) as u32 ^ b ^ k, right as u32, (left >> 32) as u32 ^ d ^ l, left as u32);
        k = k.wrapping_add(WEYL[0]);
        l = l.wrapping_add(WEYL[1]);
    }
    [a, b, c, d]
}

/// The bits of [`philox`] as two words.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
#[allow(unsafe_code)]
fn block(counter: [u64; 2], key: u64) -> [u64; 2] {
    // SAFETY: every processor of this architecture has SSE2.
    unsafe { block_in_lanes(counter, key) }
}

/// Philox with both products in one instruction: less than half of the instructions of two.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "sse2")]
#[inline]
fn block_in_lanes(counter: [u64; 2], key: u64) -> [u64; 2] {
    use std::arch::x86_64 as simd;
    let pair = |low: u64, high: u64| simd::_mm_set_epi64x(high.cast_signed(), low.cast_signed());
    let [multipliers, steps] = [MULTIPLIER, WEYL].map(|[k, l]| pair(u64::from(k), u64::from(l)));
    // Each number of 32 bits is the lower half of a lane; the upper halves have no meaning. The first lane has `a`, `b` and `k` of
    // [`philox`], the second one `c`, `d` and `l`.
    let mut even = pair(counter[0], counter[1]);
    let mut odd = simd::_mm_srli_epi64(even, 32);
    let mut keys = pair(key, key >> 32);
    for _ in 0..10 {
        let products = simd::_mm_mul_epu32(even, multipliers);
        // The upper halves of the products change lanes, then their lower halves.
        even = simd::_mm_xor_si128(simd::_mm_shuffle_epi32(products, 0x1B), simd::_mm_xor_si128(odd, keys));
        odd = simd::_mm_shuffle_epi32(products, 0x4E);
        keys = simd::_mm_add_epi32(keys, steps);
    }
    let [even, odd] = [even, odd].map(|lanes| simd::_mm_shuffle_epi32(lanes, 0x08));
    let words = simd::_mm_unpacklo_epi32(even, odd);
    [words, simd::_mm_unpackhi_epi64(words, words)].map(|word| simd::_mm_cvtsi128_si64(word).cast_unsigned())
}

/// The bits of [`philox`] as two words.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the quarters of a counter and the halves of a key")]
fn block([low, high]: [u64; 2], key: u64) -> [u64; 2] {
    let counter = [low as u32, (low >> 32) as u32, high as u32, (high >> 32) as u32];
    let [a, b, c, d] = philox(counter, [key as u32, (key >> 32) as u32]);
    [u64::from(b) << 32 | u64::from(a), u64::from(d) << 32 | u64::from(c)]
}

/// A bijection of 64 bits in which every input bit reaches every output bit (Stafford 2011, mix 13).
#[inline]
pub(crate) fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// The golden ratio in 64 bits: distinct inputs of [`mix`] stay distinct when it is added.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// The random bits of one choice, in blocks as needed.
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
    counter: [u64; 2],
    /// Hash of seed, stream and visit; each block mixes its number in.
    base: u64,
    /// Number of the next block.
    block: u64,
    /// The last block, and the number of its unused words.
    words: [u64; 2],
    left: u64,
}

/// The part of the key that all choices of a stream share: mixed once for many draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamKey(pub(crate) u64);

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
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the two halves of an address")]
    pub fn at(self, address: u128) -> Stream {
        let counter = [address as u64, (address >> 64) as u64];
        Stream { counter, base: self.0, block: 0, words: [0; 2], left: 0 }
    }

    /// The bits of the choice at `address`, whose first block is known.
    #[inline(always)]
    pub(crate) fn with_first_block(self, address: u128, words: [u64; 2]) -> Stream {
        Stream { block: 1, words, left: 2, ..self.at(address) }
    }
}

impl Stream {
    /// The bits of the choice at `address`, drawn for the `visit`-th time in `stream` (a particle, a chain).
    #[inline]
    pub fn new(seed: u64, stream: u64, address: u128, visit: u64) -> Stream {
        StreamKey::new(seed, stream, visit).at(address)
    }

    /// Makes the next block.
    #[inline(never)]
    fn make_block(&mut self) {
        let key = mix(self.base.wrapping_add(self.block.wrapping_mul(GOLDEN)));
        self.block += 1;
        self.words = block(self.counter, key);
        self.left = 2;
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
        if self.left == 0 {
            self.make_block();
        }
        self.left -= 1;
        Ok(if self.left == 1 { self.words[0] } else { self.words[1] })
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        fill(bytes, || self.next_u64());
        Ok(())
    }
}

/// Fills bytes from words of 64 bits.
pub(crate) fn fill(bytes: &mut [u8], mut word: impl FnMut() -> u64) {
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
pub(crate) fn unit(bits: u64) -> f64 {
    const STEP: f64 = 1.0 / (1u64 << 52) as f64;
    ((bits >> 12) as f64 + 0.5) * STEP
}

#[cfg(test)]
mod tests {
    //! Philox gives its published numbers; streams depend on all four of their coordinates and are uniform.
    use super::*;

    #[test]
    fn philox_gives_its_published_numbers() {
        // Random123, tests/kat_vectors, philox4x32 10.
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox([!0; 4], [!0; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn blocks_are_those_of_philox() {
        for n in 0..1000 {
            let [low, high, key] = [0, 1, 2].map(|k| mix(3 * n + k));
            let [a, b, c, d] = philox(
                [low as u32, (low >> 32) as u32, high as u32, (high >> 32) as u32],
                [key as u32, (key >> 32) as u32],
            );
            let word = |low: u32, high: u32| u64::from(high) << 32 | u64::from(low);
            assert_eq!(block([low, high], key), [word(a, b), word(c, d)]);
        }
    }

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
    fn a_stream_does_not_repeat_its_blocks() {
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
