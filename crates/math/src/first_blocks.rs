//! First random bits of many streams, made together: at one address, or each stream at its own.
//!
//! Particles at the same place draw at the same address, each from its own stream. Philox takes the address as its counter and
//! the stream as its key. So the blocks of many streams are one loop over keys, which the processor runs for several keys at once.
//! The next proposals of a Markov chain have addresses of their own.
#![allow(unsafe_code)] // Code for processors with AVX2, called where the processor has it.

use crate::streams::{MULTIPLIER, Stream, StreamKey, WEYL, mix, unit};

/// The random bits of one address in many streams: their first blocks are made together, several in one pass.
///
/// ```
/// use niwaki_math::{FirstBlocks, RngCore, Stream, StreamKey};
/// let keys: Vec<StreamKey> = (0..5).map(|lineage| StreamKey::new(1, lineage, 0)).collect();
/// let mut blocks = FirstBlocks::default();
/// blocks.make(&keys, 77);
/// assert_eq!(blocks.stream(&keys, 3).next_u64(), Stream::new(1, 3, 77, 0).next_u64());
/// ```
#[derive(Debug, Default)]
pub struct FirstBlocks {
    address: u128,
    words: Vec<[u64; 2]>,
}

impl FirstBlocks {
    /// Makes the blocks of an address for these keys.
    pub fn make(&mut self, keys: &[StreamKey], address: u128) {
        self.address = address;
        self.words.clear();
        self.words.reserve(keys.len());
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2.
            return unsafe { make_avx2(address, keys, &mut self.words) };
        }
        make::<4>(address, keys, &mut self.words);
    }

    /// The first uniform of each stream, as [`Stream::uniform`] makes it.
    #[inline(always)]
    pub fn uniforms(&self) -> impl Iterator<Item = f64> {
        self.words.iter().map(|words| unit(words[0]))
    }

    /// The bits of the `lane`-th stream.
    #[inline(always)]
    pub fn stream(&self, keys: &[StreamKey], lane: usize) -> Stream {
        keys[lane].with_first_block(self.address, self.words[lane])
    }
}

/// Appends the first blocks, `N` in each pass of the loop.
#[inline(always)]
fn make<const N: usize>(address: u128, keys: &[StreamKey], words: &mut Vec<[u64; 2]>) {
    for keys in keys.chunks(N) {
        let mut mixed = [0; N];
        keys.iter().zip(&mut mixed).for_each(|(key, to)| *to = mix(key.0));
        words.extend(&wide_philox(&[address; N], &mixed)[..keys.len()]);
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn make_avx2(address: u128, keys: &[StreamKey], words: &mut Vec<[u64; 2]>) {
    make::<8>(address, keys, words);
}

/// Number of streams that [`eight`] makes together.
pub const EIGHT: usize = 8;

/// A stream key, and the first block of its stream at one address.
#[derive(Clone, Copy, Debug)]
pub struct FirstBlock {
    key: StreamKey,
    address: u128,
    words: [u64; 2],
}

impl FirstBlock {
    /// The first word at the address of the block.
    #[inline(always)]
    pub fn first(&self) -> u64 {
        self.words[0]
    }

    /// The stream of an address: quickest at the address of the block.
    #[inline(always)]
    pub fn at(&self, address: u128) -> Stream {
        if self.address == address {
            self.key.with_first_block(address, self.words)
        } else {
            self.key.at(address)
        }
    }
}

/// The first blocks of the streams with these keys, each at an address of its own.
///
/// ```
/// use niwaki_math::first_blocks::eight;
/// use niwaki_math::{RngCore, StreamKey};
/// let keys: [StreamKey; 8] = std::array::from_fn(|visit| StreamKey::new(1, 0, visit as u64));
/// let blocks = eight(keys, [4, 7, 4, 1, 0, 9, 2, 3]);
/// assert_eq!(blocks[1].at(7).next_u64(), keys[1].at(7).next_u64());
/// assert_eq!(blocks[2].at(5).next_u64(), keys[2].at(5).next_u64());
/// ```
#[inline(always)]
pub fn eight(keys: [StreamKey; EIGHT], addresses: [u128; EIGHT]) -> [FirstBlock; EIGHT] {
    let words = eight_words(&addresses, &keys.map(|key| mix(key.0)));
    std::array::from_fn(|lane| FirstBlock { key: keys[lane], address: addresses[lane], words: words[lane] })
}

#[inline(always)]
fn eight_words(addresses: &[u128; EIGHT], mixed: &[u64; EIGHT]) -> [[u64; 2]; EIGHT] {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2.
        return unsafe { eight_avx2(addresses, mixed) };
    }
    wide_philox(addresses, mixed)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn eight_avx2(addresses: &[u128; EIGHT], mixed: &[u64; EIGHT]) -> [[u64; 2]; EIGHT] {
    wide_philox(addresses, mixed)
}

/// [`philox`](crate::streams::philox) of many counters and keys. Each number of 32 bits is held in 64, so that the processor
/// multiplies several with one instruction; the upper 32 bits have no meaning.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the four quarters of an address")]
fn wide_philox<const N: usize>(counters: &[u128; N], keys: &[u64; N]) -> [[u64; 2]; N] {
    const LOW: u64 = u32::MAX as u64;
    let quarter = |i: u32| counters.map(|counter| (counter >> (32 * i)) as u64);
    let ([mut a, mut b], [mut c, mut d]) = ([quarter(0), quarter(1)], [quarter(2), quarter(3)]);
    let (mut k, mut l) = (*keys, keys.map(|key| key >> 32));
    for _ in 0..10 {
        for i in 0..N {
            let left = u64::from(MULTIPLIER[0]) * (a[i] & LOW);
            let right = u64::from(MULTIPLIER[1]) * (c[i] & LOW);
            (a[i], b[i]) = ((right >> 32) ^ b[i] ^ k[i], right);
            (c[i], d[i]) = ((left >> 32) ^ d[i] ^ l[i], left);
            k[i] = k[i].wrapping_add(u64::from(WEYL[0]));
            l[i] = l[i].wrapping_add(u64::from(WEYL[1]));
        }
    }
    std::array::from_fn(|i| [b[i] << 32 | a[i] & LOW, d[i] << 32 | c[i] & LOW])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::RngCore;

    #[test]
    fn first_blocks_equal_the_blocks_of_the_streams() {
        for count in [1, 7, 8, 9, 40] {
            let keys: Vec<StreamKey> = (0..count).map(|n| StreamKey::new(n * n, 3, n)).collect();
            let mut blocks = FirstBlocks::default();
            for address in [0, 77, u128::MAX, 0x0123_4567_89AB_CDEF_0011_2233_4455_6677] {
                blocks.make(&keys, address);
                let mut uniforms = blocks.uniforms();
                for (lane, key) in keys.iter().enumerate() {
                    let (mut stream, mut plain) = (blocks.stream(&keys, lane), key.at(address));
                    let mut narrow = Vec::new();
                    make::<4>(address, &keys, &mut narrow);
                    assert_eq!(narrow[lane], blocks.words[lane]);
                    assert_eq!(uniforms.next(), Some(key.at(address).uniform()));
                    for _ in 0..7 {
                        assert_eq!(stream.next_u64(), plain.next_u64());
                    }
                }
            }
        }
    }

    #[test]
    fn eight_streams_have_addresses_of_their_own() {
        let keys = std::array::from_fn(|n| StreamKey::new(3, n as u64, 5));
        let addresses =
            std::array::from_fn(|n| (n as u128 * 0x0123_4567_89AB_CDEF_0011_2233).rotate_left(40));
        let (first_blocks, plain) =
            (eight(keys, addresses), wide_philox(&addresses, &keys.map(|key| mix(key.0))));
        for lane in 0..EIGHT {
            assert_eq!(first_blocks[lane].words, plain[lane]);
            for address in addresses {
                let (mut actual, mut expected) = (first_blocks[lane].at(address), keys[lane].at(address));
                (0..5).for_each(|_| assert_eq!(actual.next_u64(), expected.next_u64()));
            }
            assert_eq!(first_blocks[lane].first(), keys[lane].at(addresses[lane]).next_u64());
        }
    }
}
