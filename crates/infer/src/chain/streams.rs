//! The random streams of a chain: a function of (seed, chain, address, visit). The visit is the number of the
//! proposal. So no draw depends on how much of the program was run again.

use niwaki_math::first_blocks::Begun;
use niwaki_math::{FirstBlocks, RngCore, Stream, StreamKey};

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

/// The random numbers that decide on one proposal.
#[derive(Clone, Debug)]
pub(crate) struct Decisions {
    /// The first number: which choice.
    first: u64,
    /// The numbers after it.
    pub rest: Begun,
}

impl Decisions {
    /// The first number as one below `n`.
    #[inline(always)]
    pub fn below(&self, n: u64) -> u64 {
        scaled(self.first, n)
    }
}

/// How many proposals' decisions are made at once.
const AT_ONCE: usize = 8;

/// The decisions of the next proposals. They are made together, which is quicker, and before the proposals run, so that memory
/// can be prefetched.
#[derive(Debug, Default)]
pub(crate) struct Ahead {
    /// The number of the first of these proposals.
    from: u64,
    keys: Vec<StreamKey>,
    blocks: FirstBlocks,
}

impl Ahead {
    /// Those of a proposal.
    #[inline(always)]
    pub fn of(&mut self, streams: &Streams, visit: u64) -> Decisions {
        if visit.wrapping_sub(self.from) >= self.keys.len() as u64 {
            self.make(streams, visit);
        }
        let mut rest = self.blocks.stream(&self.keys, (visit - self.from) as usize);
        Decisions { first: rest.next_u64(), rest }
    }

    #[inline(never)]
    fn make(&mut self, streams: &Streams, visit: u64) {
        self.from = visit;
        self.keys.clear();
        self.keys.extend((0..AT_ONCE as u64).map(|n| streams.decisions.revisited(visit + n)));
        self.blocks.make(&self.keys, 0);
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
