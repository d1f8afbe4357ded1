//! Random streams of a chain, keyed by (seed, chain, address, visit). The visit is the number of the proposal. No draw depends on
//! the amount of code that runs again.

use niwaki_math::first_blocks::{EIGHT, FirstBlock, eight};
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

/// The random numbers of the next proposals. They are generated together, which is faster, and before the proposals run, so that
/// memory can be prefetched.
#[derive(Debug, Default)]
pub(crate) struct Ahead {
    /// The number of the first of these proposals.
    from: u64,
    ready: Vec<Decisions>,
}

/// The random numbers of a proposal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decisions {
    decisions: FirstBlock,
    /// The stream of the new value, by address of the choice.
    pub moves: FirstBlock,
}

impl Decisions {
    /// The first number, scaled below `n`.
    #[inline(always)]
    pub fn below(&self, n: u64) -> u64 {
        scaled(self.decisions.first(), n)
    }

    /// The numbers after the first.
    #[inline(always)]
    pub fn rest(&self) -> Stream {
        let mut stream = self.decisions.at(0);
        stream.next_u64();
        stream
    }
}

impl Ahead {
    /// The random numbers of a proposal. `guess` maps the first number of a proposal to the probable address of its choice.
    #[inline(always)]
    pub fn of(&mut self, streams: &Streams, visit: u64, guess: impl Fn(u64) -> u128) -> &Decisions {
        let mut lane = visit.wrapping_sub(self.from);
        if lane >= self.ready.len() as u64 {
            lane = 0;
            self.make(streams, visit, guess);
        }
        &self.ready[lane as usize]
    }

    #[inline(never)]
    fn make(&mut self, streams: &Streams, visit: u64, guess: impl Fn(u64) -> u128) {
        self.from = visit;
        let (mut decisive, mut moving) = ([streams.decisions; EIGHT], [streams.moves; EIGHT]);
        for lane in 0..EIGHT {
            let visit = visit + lane as u64;
            decisive[lane] = streams.decisions.revisited(visit);
            moving[lane] = streams.moves.revisited(visit);
        }
        let decisions = eight(decisive, [0; EIGHT]);
        let mut addresses = [0; EIGHT];
        for lane in 0..EIGHT {
            addresses[lane] = guess(decisions[lane].first());
        }
        let moves = eight(moving, addresses);
        self.ready.clear();
        let both = decisions.into_iter().zip(moves);
        self.ready.extend(both.map(|(decisions, moves)| Decisions { decisions, moves }));
    }
}

/// Scale the first number of a proposal's decisions below `n`, uniformly up to `n / 2^64`.
#[inline(always)]
pub(crate) fn scaled(bits: u64, n: u64) -> u64 {
    ((u128::from(bits) * u128::from(n)) >> 64) as u64
}

/// Draw a number below `n`, uniformly up to `n / 2^64`.
#[inline(always)]
pub fn below(rng: &mut Stream, n: u64) -> u64 {
    scaled(rng.next_u64(), n)
}
