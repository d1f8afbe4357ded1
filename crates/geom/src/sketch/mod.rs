//! Sketches: summaries of a scene that inference scores, updated shape by shape.
//!
//! A sketch keeps sums of integers or order statistics, so its score is the same to the bit for every order of adding,
//! and adding then removing restores the old sketch.
//!
//! - [`score`]: what every sketch is; [`settings`]: what every sketch is as data
//! - [`volume`], over [`crate::bricks`]: fill a target's volume
//! - [`picture`], over [`tiles`]: look like a picture, or cast a shadow like one
//! - [`drawing`], [`texture`], over [`tiles`] and [`outside`]: draw a picture on a page, or fill the page with edges
//! - [`intersection`]: parts must not run into each other
//! - [`avoid()`], [`floor()`]: keep out of an obstacle, stay above a floor
//! - [`overshoot`]: stay inside of a box
//! - [`bag`]: the primitives of a sketch
//! - [`product`]: several sketches of one scene
//!
//! [`SketchForm`] is the table of the sketches. To add a sketch, write a file like `floor.rs` (settings that are [`Settings`], the
//! [`Sketch`] and its [`SketchSpec`]), and a row below.

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
pub mod settings;
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

use crate::error::GeomError;
use serde::Deserialize;
pub use settings::{Forbids, Inputs};
use settings::{Named, Settings};
use std::sync::Arc;

/// Declares [`SketchForm`] and [`SKETCHES`]. A row is the name of Python's function, a variant, and the settings by their file.
macro_rules! sketches {
    ($($name:literal $variant:ident($file:ident::$settings:ident);)*) => {
        /// A sketch as data: its name and its settings. [`Inputs`] hold the targets.
        #[derive(Clone, Debug, Deserialize)]
        pub enum SketchForm {
            $(#[doc = concat!("`", $name, "`")] #[serde(rename = $name)] $variant($file::$settings),)*
        }

        $(impl Named for $file::$settings {
            const NAME: &'static str = $name;
        })*

        /// The names of all sketches, and the texts of those that forbid scenes, in the order of the table.
        pub const SKETCHES: &[(&str, Option<Forbids>)] = &[$(($name, <$file::$settings as Settings>::FORBIDS)),*];

        impl SketchForm {
            /// The specification with these settings.
            ///
            /// # Errors
            /// `bad-setting` for a value out of its range, and for an input that is missing.
            pub fn spec(self, inputs: Inputs) -> Result<Arc<dyn SketchSpec>, GeomError> {
                match self { $(SketchForm::$variant(form) => form.spec(inputs),)* }
            }
        }
    };
}

// The order in which Python evaluates sketches that are asked for by name: those that may forbid a scene come first.
sketches! {
    "no_self_intersection" NoSelfIntersection(intersection::IntersectionSettings);
    "match_drawing" MatchDrawing(drawing::DrawingSettings);
    "fill_drawing" FillDrawing(texture::TextureSettings);
    "floor" Floor(floor::FloorSettings);
    "avoid" Avoid(avoid::AvoidSettings);
    "match_image" MatchImage(picture::ImageSettings);
    "match_shadow" MatchShadow(picture::ShadowSettings);
    "overshoot" Overshoot(overshoot::OvershootSettings);
    "match_volume" MatchVolume(volume::VolumeSettings);
}
