//! Limits: the height of a scene, and the box that it stays in, as a person requires them.
//!
//! ```text
//! log score = 0 if all limits hold, else -12 - (excess / sigma)^2 / 2
//! excess    = the height's distance from its limits, as a share of the nearer one
//!             + the reach beyond the box, summed over six sides, as shares of its extent
//! ```
//!
//! The step keeps the best scene from lying just beyond a limit, where a target pulls it across.

use super::bag::Bag;
use super::overshoot::{check_box, overshoot};
use super::score::{Sketch, SketchSpec, check_sigma};
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::solids::primitive::Primitive;
use std::sync::Arc;

/// The cost of a scene just beyond a limit, nats.
const STEP: f64 = 12.0;
/// A share of a length by which coordinates round.
const ROUNDING: f64 = 1e-9;

/// Scores a scene by its height, scene units along y, and by how far it reaches out of a box.
///
/// # Errors
/// `bad-setting` when `sigma` is not positive, for limits of the height that are negative or in the wrong order, and for a
/// box whose corners are in the wrong order.
pub fn limits(
    height: Option<[f64; 2]>,
    within: Option<Aabb>,
    sigma: f64,
) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(sigma)?;
    if let Some([least, most]) = height.filter(|[a, b]| !(0.0 <= *a && a <= b && b.is_finite())) {
        let message = format!("the height is to be {least} to {most}, expected the least height first");
        return Err(GeomError::new("bad-setting", message));
    }
    within.iter().try_for_each(check_box)?;
    Ok(Arc::new(Limits { height, within, sigma, bag: Bag::default() }))
}

impl SketchSpec for Limits {
    fn name(&self) -> &'static str {
        "limits"
    }

    fn most(&self) -> f64 {
        0.0
    }
}

/// The box around the scene so far.
#[derive(Clone, Debug)]
pub struct Limits {
    height: Option<[f64; 2]>,
    within: Option<Aabb>,
    sigma: f64,
    bag: Bag,
}

impl Limits {
    /// How far the scene is beyond its limits, as a share of them.
    fn excess(&self) -> f64 {
        let scene = self.bag.bounds();
        let tall = self.height.map_or(0.0, |[least, most]| {
            let height = if scene.is_empty() { 0.0 } else { scene.extent().y };
            if height < least {
                1.0 - height / least
            } else if height > most {
                // A largest height of 0 has no shares.
                (height - most) / if most > 0.0 { most } else { 1.0 }
            } else {
                0.0
            }
        });
        let excess = tall + self.within.map_or(0.0, |domain| overshoot(&scene, &domain));
        if excess > ROUNDING { excess } else { 0.0 }
    }
}

impl PartialEq for Limits {
    fn eq(&self, other: &Limits) -> bool {
        (self.height, self.within, self.sigma) == (other.height, other.within, other.sigma)
            && self.bag == other.bag
    }
}

impl Sketch for Limits {
    fn add(&mut self, primitive: &Primitive) {
        self.bag.add(primitive, || ());
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        self.bag.remove(primitive, || ()).is_some()
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn log_score(&self) -> f64 {
        let excess = self.excess();
        if excess > 0.0 { -STEP - 0.5 * (excess / self.sigma).powi(2) } else { 0.0 }
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("excess", self.excess())]
    }
}
