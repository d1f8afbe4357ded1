//! Variational inference: the normal over real coordinates that approximates a target best within its family.
//!
//! The evidence bound of a normal `q` is `E_q[log p(x) - log q(x)]`, nats: below the log evidence by the divergence
//! `KL(q || p)`. The nearer `q` is, the higher the bound.
//!
//! * [`normal`]: a normal with a scale for each coordinate, a low-rank or a dense one: drawing, and its density;
//! * [`turns`]: the density of a normal whose coordinates are angles;
//! * [`mixture`]: several normals as one proposal;
//! * [`batch`]: targets at several draws at once, and the treatment of refused draws;
//! * [`curvature`]: an inverse Hessian from the steps of an ascent;
//! * [`pathfinder`]: an ascent, and the best normal along its path (Zhang, Carpenter, Gelman & Vehtari 2022);
//! * [`family`]: the parameters of a normal that an ascent of the bound moves, and the bound's gradient;
//! * [`ascent`]: the ascent of the bound: Adam, means of iterates, the stopping rule.
//!
//! Weights of draws and Pareto's k are in the Python package.

pub mod ascent;
pub mod batch;
pub mod curvature;
pub mod family;
pub mod mixture;
pub mod normal;
pub mod pathfinder;
pub mod turns;

pub use ascent::{Fit, Settings, Start};
pub use batch::{Batch, Row};
pub use normal::{Normal, Scale};

/// Draws that are evaluated at once.
pub const LANES: usize = 16;

/// The purpose of a stream of random bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Purpose {
    /// Draws of one step of an ascent of the bound.
    Step = 16,
    /// Draws by which means of iterates are compared.
    Check,
    /// Draws by which the normals along a path are compared.
    Path,
    /// Draws of the result.
    Draw,
    /// Draws by which a fit is compared with the normal of its path.
    Compare,
}
