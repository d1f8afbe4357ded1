//! The targets of sketches as data, and the texts for scenes that a sketch forbids.

use super::drawing::Drawing;
use super::picture::Picture;
use crate::bricks::Target;
use crate::error::GeomError;
use std::sync::Arc;

/// Texts of a message about scenes that a sketch forbids.
#[derive(Clone, Copy, Debug)]
pub struct Forbids {
    /// The verb and object of the sentence about a part, for example `reaches below the floor`.
    pub part: &'static str,
    /// Advice, as an imperative.
    pub cure: &'static str,
}

/// Targets for a sketch, beside its settings.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// The volume to fill or to avoid.
    pub target: Option<Arc<Target>>,
    /// The image of a silhouette or of a shadow.
    pub picture: Option<Arc<Picture>>,
    /// The picture to draw.
    pub drawing: Option<Arc<Drawing>>,
}

impl Inputs {
    /// The volume.
    ///
    /// # Errors
    /// `bad-setting` without one, as of the other inputs.
    pub fn target(self) -> Result<Arc<Target>, GeomError> {
        self.target.ok_or_else(|| missing("a target"))
    }

    /// The image.
    ///
    /// # Errors
    /// `bad-setting` without one.
    pub fn picture(self) -> Result<Arc<Picture>, GeomError> {
        self.picture.ok_or_else(|| missing("an image"))
    }

    /// The picture to draw.
    ///
    /// # Errors
    /// `bad-setting` without one.
    pub fn drawing(self) -> Result<Arc<Drawing>, GeomError> {
        self.drawing.ok_or_else(|| missing("a drawing"))
    }
}

fn missing(input: &str) -> GeomError {
    GeomError::new("bad-setting", format!("this sketch needs {input}"))
}
