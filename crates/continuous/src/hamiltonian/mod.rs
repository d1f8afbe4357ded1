//! Hamiltonian Monte Carlo: a point moves along its gradient over the log density, and is accepted or put back.
//!
//! In the order of a step: momentum from the metric, leapfrog steps along the gradient, acceptance by the change of
//! the total energy `H(x, p) = p . v / 2 - log_density(x)`, with velocity `v = M^-1 p` (dissertation 4.3).
//!
//! * [`potential`]: what a target is: a log density with its gradient, and what may stop a trajectory;
//! * [`metric`]: the mass matrix `M`: diagonal, dense, or diagonal with a low-rank correction;
//! * [`leapfrog`]: the integrator;
//! * [`hmc`], [`nuts`]: one transition, with a fixed length and until it turns back;
//! * [`transition`]: what both report, and the choice between them;
//! * [`mod@climb`]: the ascent from an unlikely start;
//! * [`step_size`], [`estimate`], [`warmup`]: what is adapted in warm-up and frozen afterwards;
//! * [`chains`]: whole chains, in parallel; [`lanes`]: many of them in the lanes of one vector.
//!
//! Not here: programs, how a gradient is computed, diagnostics of the draws (they are the package's).

pub mod chains;
pub mod climb;
pub mod estimate;
pub mod hmc;
pub mod lanes;
pub mod leapfrog;
mod live;
pub mod metric;
pub mod nuts;
pub mod potential;
pub mod step_size;
pub mod transition;
pub mod warmup;

pub use chains::{Chain, Draws, Settings, sample};
pub use leapfrog::Phase;
pub use metric::{Metric, Shape};
pub use potential::{Cause, Potential, Stop};
pub use transition::{BrokenOff, Divergence, Kernel, Transition};
