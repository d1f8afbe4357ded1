//! What is wrong with a shape, a mesh or a target, as data: a code for the table of messages and a sentence.

use std::fmt;

/// A shape, mesh or target that cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeomError {
    /// Which rule was broken, in kebab case: `bad-shape`, `empty-mesh`, `non-finite-mesh`, `mesh-index`,
    /// `no-cell-filled`, `bad-voxel`, `bad-sigma`, `large-grid`, `bad-camera`, `bad-light`, `light-grazes`,
    /// `receiver-unseen`, `bad-picture`, `one-color`, `bad-weight`, `bad-floor`, `bad-domain`.
    pub code: &'static str,
    /// What was found and what was expected.
    pub message: String,
}

impl GeomError {
    /// An error with its code and sentence.
    pub fn new(code: &'static str, message: impl Into<String>) -> GeomError {
        GeomError { code, message: message.into() }
    }
}

impl fmt::Display for GeomError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for GeomError {}
