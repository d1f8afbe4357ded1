//! What is wrong with a shape, a mesh or a target, as data: a code for the table of messages and a sentence.

use std::fmt;

/// A shape, mesh or target that cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeomError {
    /// Which rule was broken, in kebab case: `bad-shape`, `bad-shape`, `bad-shape`, `bad-shape`,
    /// `no-cell-filled`, `bad-setting`, `bad-setting`, `too-many-cells`, `bad-camera`, `bad-setting`, `light-grazes`,
    /// `receiver-unseen`, `bad-image`, `image-one-color`, `bad-setting`, `bad-setting`, `bad-setting`.
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
