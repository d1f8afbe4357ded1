//! The traits of sketches: running scores of a bag of primitives.

use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::plane::Page;
use crate::solids::primitive::Primitive;
use crate::voxel::Grid;
use crate::window::{Place, WindowForm};
use std::any::Any;
use std::sync::Arc;

/// A running score of a bag of primitives.
pub trait Sketch: Copied + Any + Send + Sync {
    /// Adds a primitive to the bag.
    fn add(&mut self, primitive: &Primitive);
    /// Removes one primitive equal to this from the bag; false, and nothing changed, when there is none.
    fn remove(&mut self, primitive: &Primitive) -> bool;
    /// Prepares for removals: the data that they need is kept from now on, so that copies share it.
    fn expect_removals(&mut self) {}
    /// Prepares for windows: the data that they need is kept from now on, so that copies share it.
    fn expect_windows(&mut self) {}
    /// Appends the view of `form`, which fits its target, from `place`: exactly `form.values()` numbers. The numbers are the
    /// same with and without [`Sketch::expect_windows`], which makes views fast. A sketch without a view appends zeros.
    fn look(&self, form: &WindowForm, _place: &Place, out: &mut Vec<f32>) {
        out.resize(out.len() + form.values(), 0.0);
    }
    /// Appends the pixels that the scene touches on its target's page, in the order of [`SketchSpec::image`], or nothing
    /// without a page.
    fn image(&self, _out: &mut Vec<u64>) {}
    /// Log of the score of the bag, nats; negative infinity when it is forbidden.
    fn log_score(&self) -> f64;
    /// Named numbers behind the score, for people.
    fn measures(&self) -> Vec<(&'static str, f64)>;
}

/// The sketch of the empty scene, from which those of scenes are copied.
pub trait SketchSpec: Copied + Send + Sync {
    /// Its name for people, for example `no_self_intersection`.
    fn name(&self) -> &'static str;
    /// The window that fits its target; `None` without a view.
    fn window(&self) -> Option<WindowForm> {
        None
    }
    /// The page of a drawing, and the pixels that the target fills there: one bit each, row by row from the top, each row from
    /// a new word on. `None` without a page.
    fn image(&self) -> Option<(Page, Vec<u64>)> {
        None
    }
    /// The box around its target, world space; `None` without a target in the world.
    fn domain(&self) -> Option<Aabb> {
        None
    }
    /// The grid of its target, whose cells a scene fills; `None` for a sketch without cells.
    fn grid(&self) -> Option<&Grid> {
        None
    }
    /// The log score of a scene that fits in everything, nats: no scene has a higher one. Infinite where none is known.
    fn most(&self) -> f64 {
        f64::INFINITY
    }
    /// A copy.
    fn start(&self) -> Box<dyn Sketch> {
        self.fork()
    }
}

/// Copies of a sketch of any kind, for every sketch that is `Clone`.
pub trait Copied {
    /// A copy that shares all unchanged data.
    fn fork(&self) -> Box<dyn Sketch>;
    /// Becomes a copy of `other` in place, which shares data as `fork` does. Returns false without a change if `other` is
    /// another kind of sketch.
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

/// Makes `to` a reference like `from`. A reference that all sketches of a search share is not written again, because a
/// change of its count would make every processor that reads it wait.
#[inline]
pub(crate) fn share<T>(to: &mut Arc<T>, from: &Arc<T>) {
    if !Arc::ptr_eq(to, from) {
        to.clone_from(from);
    }
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
