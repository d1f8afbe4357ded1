//! Sequential Monte Carlo. The barriers are the sites of `emit`, `factor` and `observe`.
//!
//! With `s(r_n)` the score of a run at its n-th barrier and `T` the power, particles target
//! `F_n = p_n(x_n) s(r_n)^T` (dissertation 5.3, with `T = 1`). A step of a [`sweep`](niwaki_propose::sweep):
//!
//! 1. *Advance*: each particle that has not ended runs to its next barrier (`particle`). After each barrier
//!    and whenever a future returns, the order policy picks the future that runs next.
//!    Particles at the same place run together (`in_lanes`).
//! 2. *Weigh* (`weights`): `w *= (s(r_n) / s(r_{n-1}))^T`. A particle that has ended keeps its last score. For choices that a
//!    proposal drew since the last barrier ([`Proposal`](niwaki_propose::proposal::Proposal)) `p(x) / q(x)` counts too, which is
//!    not raised to a power. A forecast of what is still to come may count on the way ([`look_ahead`](niwaki_propose::look_ahead)).
//! 3. *Resample* ([`resampling`](niwaki_run::resampling)): at every barrier, or when the effective sample size is low; weights
//!    are reset, or keep what the particles were not drawn by (`tempered`). Copies (`copies`) are made when the particles
//!    run again, by the thread that ran their parent (`shared`).
//! 4. *Rejuvenate*, where set ([`rejuvenation`]): each particle is moved by a Markov kernel that leaves `F_n` invariant (`moves`);
//!    one that still runs is followed again from its start with other values (`partial_run`). In the end chains may start
//!    from a few of the final set, and their states take its place (`final_chains`).
//!
//! The power may differ from barrier to barrier ([`Anneal`]): weights then count `s(r_n)^(T_n) / s(r_{n-1})^(T_{n-1})`, and
//! the final set is weighed by the declared `T`, so that the schedule changes neither law nor constant.
//!
//! The evidence is the score of the empty scene times the product of the mean weights at each resampling, times
//! the last mean weight; it is unbiased for `T = 1` and ratio weights, under any order policy (appendix C). The
//! original weighed by the whole score `s(r_n)` at every step ([`Weights::Absolute`]): an undeclared sharpening
//! that grows with the model, kept under its own name, without evidence.
//!
//! Built on one population: [`populations`] (several, by a plan or [`within`] a time), [`particle_gibbs`] and [`pimh`]
//! (chains of whole runs), and [`distinct`] (which results are really different).
//!
//! Random streams belong to a particle's lineage: at resampling the first copy keeps its parent's, every other
//! copy gets a fresh one, and none is used again.

mod copies;
pub mod distinct;
mod final_chains;
mod gibbs;
mod in_lanes;
mod many;
mod moves;
mod partial_run;
mod pimh;
mod population;
mod powers;
pub mod rejuvenation;
mod resident;
pub mod rises;
mod settings;
mod shared;
mod smc;
mod swarm;
mod tempered;

// The judges of the tests name the crate from outside.
#[cfg(test)]
extern crate self as niwaki_particles;
#[cfg(test)]
mod tests;

pub use gibbs::{Ancestors, Chain, particle_gibbs};
pub use many::{AT_ONCE, Share, Watch, population_seed, populations, side_by_side, united, within};
pub use pimh::pimh;
pub use rejuvenation::MoveCounts;
pub use settings::{Anneal, FinalChains, Moment, Rejuvenation, Settings, Weights, When};
pub use smc::{Progress, Result, smc};
