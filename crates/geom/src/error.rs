//! An error in a shape, a mesh or a target, as data: a code for the table of messages and a sentence.

use std::fmt;

/// A shape, mesh or target that is not valid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeomError {
    /// The code of the error, in kebab case: `bad-shape`, `bad-setting`, `bad-camera`, `bad-image`, `image-one-color`,
    /// `no-cell-filled`, `too-many-cells`, `light-grazes`, `receiver-unseen`.
    pub code: &'static str,
    /// A sentence with the actual and the expected value.
    pub message: String,
}

impl GeomError {
    /// An error with its code and sentence.
    pub fn new(code: &'static str, message: impl Into<String>) -> GeomError {
        GeomError { code, message: message.into() }
    }
}

/// Refuses a shape: `bad-shape`.
pub(crate) fn bad_shape<T>(message: String) -> Result<T, GeomError> {
    Err(GeomError::new("bad-shape", message))
}

impl fmt::Display for GeomError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for GeomError {}
