//! Sketches: summaries of a scene that inference scores, updated shape by shape.
//!
//! A sketch keeps sums of integers or order statistics, so its score is the same to the bit for every order of adding,
//! and adding then removing restores the old sketch.
//!
//! - [`volume`], over [`counters`]: fill a target's volume
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
pub mod brick;
pub mod counters;
pub mod drawing;
pub mod floor;
pub mod intersection;
pub mod outside;
pub mod overshoot;
pub mod picture;
pub mod product;
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
pub use texture::{Texture, TextureMatch, fill_drawing};
pub use volume::{Target, VolumeMatch, match_volume};

use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::intersect::Rule;
use crate::plane::Page;
use crate::primitive::Primitive;
use crate::tree::{BoxTree, Boxed};
use crate::window::{Place, WindowForm};
use serde::Deserialize;
use std::any::Any;
use std::sync::Arc;

/// A running score of a bag of primitives.
pub trait Sketch: Copied + Any + Send + Sync {
    /// Its name for people, for example `no_self_intersection`.
    fn name(&self) -> &'static str;
    /// Adds a primitive to the bag.
    fn add(&mut self, primitive: &Primitive);
    /// Removes one primitive equal to this from the bag; false, and nothing changed, when there is none.
    fn remove(&mut self, primitive: &Primitive) -> bool;
    /// Prepares for removals: the data that they need is kept from now on, so that copies share it.
    fn expect_removals(&mut self) {}
    /// Prepares for windows: the data that they need is kept from now on, so that copies share it.
    fn expect_windows(&mut self) {}
    /// Appends what `form`, one that fits its target, shows from `place`: exactly `form.values()` numbers. The answer is
    /// the same with and without [`Sketch::expect_windows`]; with it, it is fast. A sketch that shows nothing appends
    /// zeros.
    fn look(&self, form: &WindowForm, _place: &Place, out: &mut Vec<f32>) {
        out.resize(out.len() + form.values(), 0.0);
    }
    /// Appends the pixels that the scene touches on its target's page, as [`SketchSpec::image`] has them; nothing where
    /// that has none.
    fn image(&self, _out: &mut Vec<u64>) {}
    /// Log of the score of the bag, nats; negative infinity when it is forbidden.
    fn log_score(&self) -> f64;
    /// Named numbers behind the score, for people.
    fn measures(&self) -> Vec<(&'static str, f64)>;
}

/// What to score, given by the caller: creates the sketch of the empty scene.
pub trait SketchSpec: Send + Sync {
    /// Name of its sketch.
    fn name(&self) -> &'static str;
    /// The window that fits its target; `None` when it shows nothing.
    fn window(&self) -> Option<WindowForm> {
        None
    }
    /// The page that scenes are drawn on, and the pixels that the target fills there: one bit each, row by row from the
    /// top, each row in words of its own. `None` where nothing is drawn on a page.
    fn image(&self) -> Option<(Page, Vec<u64>)> {
        None
    }
    /// The box around what its target covers, world space; `None` when it has no target in the world.
    fn domain(&self) -> Option<Aabb> {
        None
    }
    /// The sketch of the empty scene.
    fn start(&self) -> Box<dyn Sketch>;
}

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

/// Copies of a sketch whose kind is not known: every sketch that can be cloned has them.
pub trait Copied {
    /// A copy that shares all unchanged data.
    fn fork(&self) -> Box<dyn Sketch>;
    /// Becomes a copy of `other`, in place and sharing as `fork` does; false, and nothing changed, when that is another
    /// kind of sketch.
    fn become_copy(&mut self, other: &dyn Sketch) -> bool;
}

impl<T: Sketch + Clone> Copied for T {
    fn fork(&self) -> Box<dyn Sketch> {
        Box::new(self.clone())
    }

    fn become_copy(&mut self, other: &dyn Sketch) -> bool {
        let other: &dyn Any = other;
        other.downcast_ref::<T>().map(|other| self.clone_from(other)).is_some()
    }
}

/// Makes both the same. A reference that all sketches of a search share is not written again: its count would make
/// every processor that reads it wait.
#[inline]
pub(crate) fn share<T>(to: &mut Arc<T>, from: &Arc<T>) {
    if !Arc::ptr_eq(to, from) {
        to.clone_from(from);
    }
}

/// Equality of bags: every primitive of one is in the other as often.
pub(crate) fn same_bag<T: Clone + Boxed>(
    a: &BoxTree<T>,
    b: &BoxTree<T>,
    of: impl Fn(&T) -> &Primitive,
) -> bool {
    let mut rest = a.clone();
    let mut same = a.len() == b.len();
    b.each(|item| same = same && rest.remove(item.aabb(), |p| of(p) == of(item)).is_some());
    same
}

/// ln N(x; mean, sd), nats.
pub(crate) fn log_normal(x: f64, mean: f64, sd: f64) -> f64 {
    const HALF_LOG_TAU: f64 = 0.918_938_533_204_672_8;
    let z = (x - mean) / sd;
    -HALF_LOG_TAU - sd.ln() - 0.5 * z * z
}

/// Refuses a standard deviation that is not valid: `bad-setting`.
pub(crate) fn check_sigma(sigma: f64) -> Result<(), GeomError> {
    if sigma > 0.0 && sigma.is_finite() {
        return Ok(());
    }
    Err(GeomError::new("bad-setting", format!("sigma is {sigma}, expected a positive number")))
}
