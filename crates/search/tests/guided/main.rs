//! With any guide, every method gives the evidence and the posterior of the method without a guide. The guides have random
//! weights far from the prior; the programs have discrete and continuous choices, with and without a sketch that guides
//! see.
//!
//! Answers come from enumeration and quadrature ([`law`]). Estimates are averaged, values counted; a quantity
//! is compared with the exact one by its distance in standard errors. It is beyond 5 once in 1.7 million; there are some
//! 700 quantities, so a re-seeded suite fails once in 2,400 runs.

mod chains;
mod guides;
mod law;
mod populations;
mod programs;
mod strategies;

/// Largest distance from the exact answer in standard errors; chance does not reach it.
const LIMIT: f64 = 5.0;

/// Runs many small searches, which gain nothing from more threads, on one thread; the bits are equal.
fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool").install(work)
}
