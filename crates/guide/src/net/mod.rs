//! The network: two hidden layers that all sites share, and one linear layer for each site.
//!
//! ```text
//! windows --(see)--+
//! features --------+--> tanh, 38 --> tanh, 32 --> the site's head
//! the site's number+
//! ```
//!
//! | file | what it holds |
//! | --- | --- |
//! | `real` | the numbers of its computations: `f32`, and `f64` for tests |
//! | `form` | [`NetForm`]: its inputs, sizes and heads, and the places of its weights |
//! | `pass` | [`Net`]: its way from inputs to outputs |
//! | `file` | its bytes, in the safetensors format |

mod file;
mod form;
mod pass;
mod real;

pub use file::{BadFile, read, write};
pub(crate) use file::{read_form, read_numbers, write_as};
pub use form::NetForm;
pub(crate) use form::{LANES, Layout};
pub use pass::{Net, Scratch};
pub(crate) use pass::{add_rows, squash};
pub use real::Real;
