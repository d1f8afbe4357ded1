//! The random streams of a chain: a function of (seed, chain, address, visit), where the visit is the number of the
//! proposal, so that no draw depends on how much of the program was run again.

use niwaki_math::{RngCore, Stream, StreamKey};

/// Streams of one chain, by what is drawn from them. A chain's numbers are eight times its own and more.
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

    /// Choices that a run makes for the first time, or anew.
    #[inline]
    pub fn fresh(self, visit: u64) -> StreamKey {
        self.fresh.revisited(visit)
    }

    /// New values for old choices.
    #[inline]
    pub fn moves(self, visit: u64) -> StreamKey {
        self.moves.revisited(visit)
    }

    /// Which choice is changed, and whether the change is kept: the first two numbers.
    #[inline]
    pub fn decisions(self, visit: u64) -> Stream {
        self.decisions.revisited(visit).at(0)
    }

    /// Which kernel of a mixture is next.
    #[inline]
    pub fn schedule(self, visit: u64) -> Stream {
        self.schedule.revisited(visit).at(0)
    }
}

/// The random numbers that decide over a proposal, drawn while the one before runs, so that what it will need can be
/// asked for.
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
