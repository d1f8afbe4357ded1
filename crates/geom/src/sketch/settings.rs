//! The kinds of sketches as data: a name, settings, and the texts for scenes that a sketch forbids.

use super::drawing::Drawing;
use super::picture::Picture;
use super::score::SketchSpec;
use crate::bricks::Target;
use crate::error::GeomError;
use std::sync::Arc;

/// The settings of a kind of sketch, as Python's function of its name sends them. Each file of a sketch has such a type,
/// with a row in the table of [`super::SketchForm`].
pub trait Settings: Named {
    /// The texts for scenes that it forbids; `None` where it forbids none.
    const FORBIDS: Option<Forbids> = None;

    /// The specification with these settings.
    ///
    /// # Errors
    /// `bad-setting` for a value out of its range, and for an input that is missing.
    fn spec(self, inputs: Inputs) -> Result<Arc<dyn SketchSpec>, GeomError>;
}

/// The name of a kind of sketch, from its row in the table.
pub trait Named {
    /// The name of Python's function, for example `floor`.
    const NAME: &'static str;
}

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
