//! Hamiltonian Monte Carlo: a point moves along the gradient of the log density, and is accepted or reset.
//!
//! In the order of a step: momentum from the metric, leapfrog steps along the gradient, acceptance by the change of
//! the total energy `H(x, p) = p . v / 2 - log_density(x)`, with velocity `v = M^-1 p` (dissertation 4.3).
//!
//! * [`potential`]: targets: a log density with its gradient, and the reasons that stop a trajectory;
//! * [`metric`]: the mass matrix `M`: diagonal, dense, or diagonal with a low-rank correction;
//! * [`leapfrog`]: the integrator;
//! * [`hmc`], [`nuts`]: transitions of fixed length, and until the trajectory turns back;
//! * [`transition`]: the report of a transition, and the choice between both kernels;
//! * [`mod@climb`]: the ascent from an unlikely start;
//! * [`step_size`], [`estimate`], [`warmup`]: the adaptation during warm-up;
//! * [`chains`]: whole chains, in parallel; [`lanes`]: many chains in the lanes of a vector.
//!
//! The diagnostics of the draws are in the Python package.

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
