//! Sketches: summaries of a scene that inference scores, updated shape by shape.
//!
//! A sketch keeps sums of integers or order statistics, so its score is the same to the bit for every order of adding,
//! and adding then removing restores the old sketch.
//!
//! - [`score`]: what every sketch is
//! - [`volume`], over [`crate::bricks`]: fill a target's volume
//! - [`picture`], over [`tiles`]: look like a picture, or cast a shadow like one
//! - [`drawing`], [`texture`], over [`tiles`] and [`outside`]: draw a picture on a page, or fill the page with edges
//! - [`intersection`]: parts must not run into each other
//! - [`avoid()`], [`floor()`]: keep out of an obstacle, stay above a floor
//! - [`overshoot`]: stay inside of a box
//! - [`bag`]: the primitives of a sketch
//! - [`product`]: several sketches of one scene
//!
//! [`SketchForm`] names all that a scene can be scored by.

pub mod avoid;
pub mod bag;
pub mod drawing;
pub mod floor;
pub mod intersection;
pub mod outside;
pub mod overshoot;
pub mod picture;
pub mod product;
pub mod score;
pub mod texture;
pub mod tiles;
pub mod volume;

pub use avoid::{Avoid, avoid};
pub use drawing::{Drawing, DrawingMatch, match_drawing};
pub use floor::{Floor, floor};
pub use intersection::{NoSelfIntersection, no_self_intersection};
pub use overshoot::{Overshoot, no_overshoot};
pub use picture::{Picture, PictureMatch, TargetPicture, match_image, match_shadow};
pub use product::Sketches;
pub use score::{Copied, Sketch, SketchSpec};
pub use texture::{Texture, TextureMatch, fill_drawing};
pub use volume::{VolumeMatch, match_volume};

use crate::bounds::Aabb;
use crate::bricks::Target;
use crate::error::GeomError;
use crate::intersect::Rule;
use crate::plane::Page;
use serde::Deserialize;
use std::sync::Arc;

/// A sketch as data: its name and its settings, which are those of Python's function of that name. A target and an image
/// are given beside them.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the settings are described where people read them: in Python's functions")]
pub enum SketchForm {
    NoSelfIntersection { rule: Rule },
    MatchVolume { sigma: f64 },
    MatchImage { sigma: f64 },
    MatchShadow { sigma: f64 },
    MatchDrawing { sigma: f64 },
    FillDrawing { window: [[f64; 2]; 2], size: [usize; 2], share: f64, sigma: f64 },
    Avoid {},
    Floor { y: f64 },
    Overshoot { domain: [[f64; 3]; 2], sigma: f64 },
}

impl SketchForm {
    /// Its specification.
    ///
    /// # Errors
    /// `bad-setting` for a setting that it cannot have, and where it needs a target, an image or a drawing that is not given.
    pub fn spec(
        &self,
        target: Option<Arc<Target>>,
        picture: Option<Arc<Picture>>,
        drawing: Option<Arc<Drawing>>,
    ) -> Result<Arc<dyn SketchSpec>, GeomError> {
        let missing = |what| GeomError::new("bad-setting", format!("this sketch needs {what}"));
        let target = || target.ok_or_else(|| missing("a target"));
        let picture = || picture.ok_or_else(|| missing("an image"));
        match *self {
            SketchForm::NoSelfIntersection { rule } => Ok(no_self_intersection(rule)),
            SketchForm::MatchVolume { sigma } => match_volume(target()?, sigma),
            SketchForm::MatchImage { sigma } => match_image(picture()?, sigma),
            SketchForm::MatchShadow { sigma } => match_shadow(picture()?, sigma),
            SketchForm::MatchDrawing { sigma } => {
                match_drawing(drawing.ok_or_else(|| missing("a drawing"))?, sigma)
            }
            SketchForm::FillDrawing { window: [low, high], size, share, sigma } => {
                fill_drawing(Texture { page: Page::new(low, high, size)?, share, sigma })
            }
            SketchForm::Avoid {} => Ok(avoid(target()?)),
            SketchForm::Floor { y } => floor(y),
            SketchForm::Overshoot { domain: [low, high], sigma } => {
                no_overshoot(Aabb { low: low.into(), high: high.into() }, sigma)
            }
        }
    }
}
