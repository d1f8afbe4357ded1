//! Random streams of a chain, keyed by (seed, chain, address, visit). The visit is the number of the proposal. No draw depends on
//! the amount of code that runs again.

use niwaki_math::{RngCore, Stream, StreamKey};

/// The number of streams of a chain: a stream for each purpose.
const STREAMS: u64 = 8;

/// The streams of a chain.
#[derive(Clone, Copy, Debug)]
pub struct Streams {
    fresh: StreamKey,
    moves: StreamKey,
    decisions: StreamKey,
    schedule: StreamKey,
}

impl Streams {
    /// The streams of the `chain`-th chain of a seed.
    pub fn new(seed: u64, chain: u64) -> Streams {
        let key = |number| StreamKey::new(seed, chain.wrapping_mul(STREAMS).wrapping_add(number), 0);
        Streams { fresh: key(0), moves: key(1), decisions: key(2), schedule: key(3) }
    }

    /// The stream of new and redrawn choices.
    #[inline]
    pub fn fresh(self, visit: u64) -> StreamKey {
        self.fresh.revisited(visit)
    }

    /// The stream of new values of existing choices.
    #[inline]
    pub fn moves(self, visit: u64) -> StreamKey {
        self.moves.revisited(visit)
    }

    /// The stream of decisions: its first two numbers pick the choice and decide on the acceptance.
    #[inline]
    pub fn decisions(self, visit: u64) -> Stream {
        self.decisions.revisited(visit).at(0)
    }

    /// The stream that picks the next kernel of a mixture.
    #[inline]
    pub fn schedule(self, visit: u64) -> Stream {
        self.schedule.revisited(visit).at(0)
    }
}

/// Draw a number below `n`, uniformly up to `n / 2^64`.
#[inline(always)]
pub fn below(rng: &mut Stream, n: u64) -> u64 {
    ((u128::from(rng.next_u64()) * u128::from(n)) >> 64) as u64
}
