//! The first random bits at one address in many streams, made together.
//!
//! Particles at the same place draw at the same address, each from its own stream. Philox takes the address as its counter and
//! the stream as its key, so the blocks of many streams are one loop over keys, which the processor carries out several at once.
#![allow(unsafe_code)] // Code for processors with AVX2, called where the processor has it.

use crate::streams::{MULTIPLIER, RngCore, Stream, StreamKey, WEYL, fill, mix};
use rand_core::TryRng;
use std::convert::Infallible;

/// The random bits of one address in many streams: their first blocks are made together, several at once.
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
    /// The blocks of an address for these keys.
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

    /// The bits of the `lane`-th stream.
    #[inline(always)]
    pub fn stream(&self, keys: &[StreamKey], lane: usize) -> Begun {
        Begun { words: self.words[lane], used: 0, rest: keys[lane].behind_first(self.address) }
    }
}

/// Adds the first blocks, `N` in one pass of the loop.
#[inline(always)]
fn make<const N: usize>(address: u128, keys: &[StreamKey], words: &mut Vec<[u64; 2]>) {
    for keys in keys.chunks(N) {
        let mut mixed = [0; N];
        keys.iter().zip(&mut mixed).for_each(|(key, to)| *to = mix(key.0));
        words.extend(&wide_philox(address, &mixed)[..keys.len()]);
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn make_avx2(address: u128, keys: &[StreamKey], words: &mut Vec<[u64; 2]>) {
    make::<8>(address, keys, words);
}

/// A stream whose first block is there.
#[derive(Clone, Debug)]
pub struct Begun {
    words: [u64; 2],
    used: usize,
    rest: Stream,
}

impl TryRng for Begun {
    type Error = Infallible;

    #[inline(always)]
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.try_next_u64().map(|bits| (bits >> 32) as u32)
    }

    #[inline(always)]
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        match self.words.get(self.used) {
            Some(word) => {
                self.used += 1;
                Ok(*word)
            }
            None => self.rest.try_next_u64(),
        }
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        fill(bytes, || self.next_u64());
        Ok(())
    }
}

/// [`philox`](crate::streams::philox) of one counter with many keys. Numbers of 32 bits are held in 64, so that a product is one instruction of the
/// processor for several of them.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the four quarters of an address")]
fn wide_philox<const N: usize>(counter: u128, keys: &[u64; N]) -> [[u64; 2]; N] {
    const LOW: u64 = u32::MAX as u64;
    let quarter = |i: u32| [(counter >> (32 * i)) as u64 & LOW; N];
    let ([mut a, mut b], [mut c, mut d]) = ([quarter(0), quarter(1)], [quarter(2), quarter(3)]);
    let (mut k, mut l) = (keys.map(|key| key & LOW), keys.map(|key| key >> 32));
    for _ in 0..10 {
        for i in 0..N {
            let left = u64::from(MULTIPLIER[0]) * (a[i] & LOW);
            let right = u64::from(MULTIPLIER[1]) * (c[i] & LOW);
            (a[i], b[i]) = ((right >> 32) ^ b[i] ^ k[i], right & LOW);
            (c[i], d[i]) = ((left >> 32) ^ d[i] ^ l[i], left & LOW);
            k[i] = (k[i] + u64::from(WEYL[0])) & LOW;
            l[i] = (l[i] + u64::from(WEYL[1])) & LOW;
        }
    }
    std::array::from_fn(|i| [b[i] << 32 | a[i], d[i] << 32 | c[i]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_blocks_are_those_of_the_streams() {
        for count in [1, 7, 8, 9, 40] {
            let keys: Vec<StreamKey> = (0..count).map(|n| StreamKey::new(n * n, 3, n)).collect();
            let mut blocks = FirstBlocks::default();
            for address in [0, 77, u128::MAX, 0x0123_4567_89AB_CDEF_0011_2233_4455_6677] {
                blocks.make(&keys, address);
                for (lane, key) in keys.iter().enumerate() {
                    let (mut begun, mut plain) = (blocks.stream(&keys, lane), key.at(address));
                    let mut narrow = Vec::new();
                    make::<4>(address, &keys, &mut narrow);
                    assert_eq!(narrow[lane], begun.words);
                    for _ in 0..7 {
                        assert_eq!(begun.next_u64(), plain.next_u64());
                    }
                }
            }
        }
    }
}
