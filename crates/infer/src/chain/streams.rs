//! The random streams of a chain: a function of (seed, chain, address, visit). The visit is the number of the
//! proposal. So no draw depends on how much of the program was run again.

use niwaki_math::{RngCore, Stream, StreamKey};

/// Stream numbers for each chain, one for each purpose.
const STREAMS: u64 = 8;

/// The streams of one chain.
#[derive(Clone, Copy, Debug)]
pub struct Streams {
    fresh: StreamKey,
    moves: StreamKey,
    decisions: StreamKey,
    schedule: StreamKey,
}

impl Streams {
    /// Of the `chain`-th chain of a seed.
    pub fn new(seed: u64, chain: u64) -> Streams {
        let key = |which| StreamKey::new(seed, chain.wrapping_mul(STREAMS).wrapping_add(which), 0);
        Streams { fresh: key(0), moves: key(1), decisions: key(2), schedule: key(3) }
    }

    /// For new choices, and for choices that are drawn anew.
    #[inline]
    pub fn fresh(self, visit: u64) -> StreamKey {
        self.fresh.revisited(visit)
    }

    /// For new values of old choices.
    #[inline]
    pub fn moves(self, visit: u64) -> StreamKey {
        self.moves.revisited(visit)
    }

    /// For the choice that is changed, and for the acceptance: the first two numbers.
    #[inline]
    pub fn decisions(self, visit: u64) -> Stream {
        self.decisions.revisited(visit).at(0)
    }

    /// For the next kernel of a mixture.
    #[inline]
    pub fn schedule(self, visit: u64) -> Stream {
        self.schedule.revisited(visit).at(0)
    }
}

/// The random numbers that decide on a proposal. They are drawn while the proposal before runs, so that memory can be
/// prefetched.
pub(crate) struct Ahead {
    /// The number of the proposal.
    pub visit: u64,
    /// The first number: which choice.
    first: u64,
    /// The numbers after it.
    pub rest: Stream,
}

impl Ahead {
    /// Of that visit.
    pub fn of(streams: &Streams, visit: u64) -> Ahead {
        let mut rest = streams.decisions(visit);
        Ahead { visit, first: rest.next_u64(), rest }
    }

    /// The first number as one below `n`.
    #[inline(always)]
    pub fn below(&self, n: u64) -> u64 {
        scaled(self.first, n)
    }
}

/// A number below `n`, evenly (up to `n / 2^64`).
#[inline(always)]
pub(crate) fn below(rng: &mut Stream, n: u64) -> u64 {
    scaled(rng.next_u64(), n)
}

#[inline(always)]
fn scaled(bits: u64, n: u64) -> u64 {
    ((u128::from(bits) * u128::from(n)) >> 64) as u64
}
