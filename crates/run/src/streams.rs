//! Random streams of a search that belong to no run. Each has a unique number.
//!
//! Runs, lineages and chains use the numbers from 0 upwards, so reserved numbers count down from the greatest. Never change a
//! number: the same seeds must give the same bits.

use niwaki_math::{Stream, StreamKey};

/// The purpose of a reserved stream. Equal numbers do not compile.
#[derive(Clone, Copy, Debug)]
#[repr(u64)]
pub enum Reserved {
    /// Resampling; the address is the barrier.
    Resampling = u64::MAX,
    /// The seed of a further population; the address is its number.
    Population = u64::MAX - 1,
    /// Particle Gibbs and independent Metropolis-Hastings: the seed of a sweep, and the draws after it.
    Sweep = u64::MAX - 2,
    /// Particle Gibbs: the ancestor of the held run; the address is the barrier.
    Ancestor = u64::MAX - 3,
    /// Particle Gibbs: the orders of held runs.
    Order = u64::MAX - 4,
    /// Particle independent Metropolis-Hastings: the acceptance of a sweep.
    SweepAcceptance = u64::MAX - 5,
    /// Rejuvenation: the kernels of a mixture; the address is the round.
    MoveSchedule = u64::MAX - 6,
    /// Rejuvenation: the first runs, from which spreads are estimated.
    Spread = u64::MAX - 7,
    /// Rejuvenation: the seed of a particle's chain; the address is its lineage.
    ChainSeed = u64::MAX - 8,
    /// Final chains: the particles from which they start.
    ChainStart = u64::MAX - 9,
    /// Particles with a time limit: the seed of a pilot, which measures the cost of a run.
    Pilot = u64::MAX - 10,
    /// Rejection sampling: the acceptance of a run; the address is the run.
    RunAcceptance = u64::MAX - 11,
    /// Nested inference: the weighted run whose value is returned.
    Pick = u64::MAX - 12,
    /// Optimising search: the kind of the next step (the address is the round), and the seed of a further population.
    Improve = u64::MAX - 13,
    /// Paused particles: the particles that are examined (the address is the barrier), and the seed of the search that resumes
    /// from a particle (the address is its number).
    Paused = u64::MAX - 14,
}

impl Reserved {
    /// The random bits of the `visit`-th draw at an address.
    pub fn stream(self, seed: u64, address: u128, visit: u64) -> Stream {
        Stream::new(seed, self as u64, address, visit)
    }

    /// The key of all addresses.
    pub fn key(self, seed: u64, visit: u64) -> StreamKey {
        StreamKey::new(seed, self as u64, visit)
    }
}
