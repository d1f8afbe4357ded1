//! Sketches: summaries of a scene that inference scores, updated shape by shape.
//!
//! A sketch keeps sums of integers or order statistics. So its score is the same to the bit for every order of shapes, and
//! removal of a new shape restores the old sketch.
//!
//! - [`score`]: the traits of sketches; [`form`]: their inputs and texts as data
//! - [`volume`], over [`crate::bricks`]: fill a target's volume
//! - [`picture`], over [`tiles`]: look like a picture, or cast a shadow like one
//! - [`drawing`], [`texture`], over [`tiles`] and [`outside`]: draw a picture on a page, or fill the page with edges
//! - [`intersection`]: parts must not run into each other
//! - [`avoid()`], [`floor()`]: keep out of an obstacle, stay above a floor
//! - [`overshoot`]: stay inside of a box
//! - [`limits()`]: have a height, and stay inside of a box, as a person requires
//! - [`bag`]: the primitives of a sketch
//! - [`product`]: several sketches of one scene
//!
//! [`SketchForm`] is the table of the sketches. To add a sketch, write a file like `floor.rs` (a [`Sketch`] that is its own
//! [`SketchSpec`]), and a row below.

pub mod avoid;
pub mod bag;
pub mod drawing;
pub mod floor;
pub mod form;
pub mod intersection;
pub mod limits;
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
pub use limits::{Limits, limits};
pub use overshoot::{Overshoot, no_overshoot};
pub use picture::{Picture, PictureMatch, TargetPicture, match_image, match_shadow};
pub use product::Sketches;
pub use score::{Copied, Sketch, SketchSpec};
pub use texture::{Texture, TextureMatch, fill_drawing};
pub use volume::{BALANCED_DEVIATIONS, CellWeight, VolumeMatch, match_volume, match_volume_by};

use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::intersect::Rule;
use crate::plane::Page;
pub use form::{Forbids, Inputs};
use serde::Deserialize;
use std::sync::Arc;

/// Declares [`SketchForm`] and [`SKETCHES`]. A row is the name of Python's function, a variant with its settings, and how the
/// inputs and the settings make a specification. A sketch that forbids scenes names its [`Forbids`] in brackets.
macro_rules! sketches {
    ($($name:literal $variant:ident { $($setting:ident: $kind:ty),* } $([$forbids:path])? |$inputs:pat_param| $spec:expr;)*) => {
        /// A sketch as data: its name and its settings, which Python's function of that name documents.
        #[derive(Clone, Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        #[expect(missing_docs, reason = "the settings are described where people read them: in Python's functions")]
        pub enum SketchForm {
            $(#[serde(rename = $name)] $variant { $($setting: $kind),* },)*
        }

        /// The names of all sketches in the order of the table, with the texts of those that forbid scenes.
        pub const SKETCHES: &[(&str, Option<Forbids>)] =
            &[$(($name, [$(Some($forbids),)? None][0]),)*];

        impl SketchForm {
            /// The specification.
            ///
            /// # Errors
            /// `bad-setting` for a value out of its range, and for an input that is missing.
            pub fn spec(self, inputs: Inputs) -> Result<Arc<dyn SketchSpec>, GeomError> {
                match self {
                    $(SketchForm::$variant { $($setting),* } => {
                        let $inputs = inputs;
                        $spec
                    })*
                }
            }
        }
    };
}

// The order in which Python evaluates sketches that are asked for by name: those that may forbid a scene come first.
sketches! {
    "no_self_intersection" NoSelfIntersection { rule: Rule } [intersection::FORBIDS] |_| Ok(no_self_intersection(rule));
    "match_drawing" MatchDrawing { sigma: f64 } |inputs| match_drawing(inputs.drawing()?, sigma);
    "fill_drawing" FillDrawing { window: [[f64; 2]; 2], size: [usize; 2], share: f64, sigma: f64 } |_| {
        fill_drawing(Texture { page: Page::new(window[0], window[1], size)?, share, sigma })
    };
    "floor" Floor { y: f64 } [floor::FORBIDS] |_| floor(y);
    "avoid" Avoid {} [avoid::FORBIDS] |inputs| Ok(avoid(inputs.target()?));
    "match_image" MatchImage { sigma: f64 } |inputs| match_image(inputs.picture()?, sigma);
    "match_shadow" MatchShadow { sigma: f64 } |inputs| match_shadow(inputs.picture()?, sigma);
    "overshoot" Overshoot { domain: [[f64; 3]; 2], sigma: f64 } |_| {
        let [low, high] = domain.map(Into::into);
        no_overshoot(Aabb { low, high }, sigma)
    };
    "limits" Limits { height: Option<[f64; 2]>, within: Option<[[f64; 3]; 2]>, sigma: f64 } |_| {
        limits(height, within.map(|corners| { let [low, high] = corners.map(Into::into); Aabb { low, high } }), sigma)
    };
    "match_volume" MatchVolume { sigma: f64, weight: Option<CellWeight> } |inputs| {
        match_volume_by(inputs.target()?, sigma, weight.unwrap_or_default())
    };
}
