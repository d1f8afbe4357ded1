//! The random streams of a search that belong to no run: each has its number here, once.
//!
//! Runs, lineages and chains take the numbers from 0 upwards, so these count down from the greatest. Numbers stay as they
//! are, so that the same seeds give the same bits.

use niwaki_math::{Stream, StreamKey};

/// What a reserved stream is for. Two that had the same number would not compile.
#[derive(Clone, Copy, Debug)]
#[repr(u64)]
pub enum Reserved {
    /// Resampling; the address is the barrier.
    Resampling = u64::MAX,
    /// The seed of a further population; the address is its number.
    Population = u64::MAX - 1,
    /// Particle Gibbs and independent Metropolis-Hastings: the seed of a sweep, and what is drawn after it.
    Sweep = u64::MAX - 2,
    /// Particle Gibbs: the ancestor of the run that is kept; the address is the barrier.
    Ancestor = u64::MAX - 3,
    /// Particle Gibbs: the orders of held runs.
    Order = u64::MAX - 4,
    /// Particle independent Metropolis-Hastings: whether a sweep is accepted.
    SweepAcceptance = u64::MAX - 5,
    /// Particles that are moved: the kernels of a mixture; the address is the round.
    MoveSchedule = u64::MAX - 6,
    /// Particles that are moved: the first runs, from which spreads are read.
    Spread = u64::MAX - 7,
    /// Particles that are moved: the seed of a particle's chain; the address is its lineage.
    ChainSeed = u64::MAX - 8,
    /// Final chains: the particles from which they start.
    ChainStart = u64::MAX - 9,
    /// Particles with a time limit: the seed of a pilot, which measures the cost of a run.
    Pilot = u64::MAX - 10,
    /// Rejection sampling: whether a run is accepted; the address is the run.
    RunAcceptance = u64::MAX - 11,
    /// Which of the weighted runs of an inference inside a model is returned.
    Pick = u64::MAX - 12,
    /// A search for the best: which kind of step is next (the address is the round), and the seed of a further population.
    Improve = u64::MAX - 13,
    /// Particles that are looked at while they are paused: which (the address is the barrier), and the seed of the search that
    /// goes on from one (the address is its number).
    Paused = u64::MAX - 14,
}

impl Reserved {
    /// The bits at an address, drawn for the `visit`-th time.
    pub fn stream(self, seed: u64, address: u128, visit: u64) -> Stream {
        Stream::new(seed, self as u64, address, visit)
    }

    /// The key of all addresses.
    pub fn key(self, seed: u64, visit: u64) -> StreamKey {
        StreamKey::new(seed, self as u64, visit)
    }
}
