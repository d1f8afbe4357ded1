//! Variational inference: a normal over real coordinates that is as near to a target as its family allows.
//!
//! The evidence bound of a normal `q` is `E_q[log p(x) - log q(x)]`, nats: below the log evidence by the divergence
//! `KL(q || p)`. The nearer `q` is, the higher the bound.
//!
//! * [`normal`]: a normal with a scale for each coordinate, a low-rank or a dense one: drawing, and its density;
//! * [`turns`]: its density where coordinates are angles, on the circle;
//! * [`mixture`]: several normals as one proposal;
//! * [`batch`]: a target at several draws at once, and what becomes of draws that it refuses;
//! * [`curvature`]: an inverse Hessian from the steps of an ascent;
//! * [`pathfinder`]: an ascent, and the best of the normals along it (Zhang, Carpenter, Gelman & Vehtari 2022);
//! * [`family`]: the parameters of a normal that an ascent of the bound moves, and the bound's gradient;
//! * [`ascent`]: that ascent: Adam, means of iterates, when it ends.
//!
//! Not here: programs (they are in `gradient/approximate.rs`), weights of draws and Pareto's k (they are the package's).

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
