//! Overshoot: the reach of a scene beyond a box.
//!
//! ```text
//! log score = ln N(overshoot; 0, sigma)
//! overshoot = sum over six sides of (length outside the box / extent of the box along that axis)
//! ```
//!
//! Dissertation 5.5.1: it is one of the two terms of volume matching. Alone it goes with pictures and shadows, which ignore
//! shapes outside of them. differs: a sum over the sides, as in the original's code; its text has the maximum.

use super::bag::Bag;
use super::score::{Sketch, SketchSpec, check_sigma, log_normal};
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::solids::primitive::Primitive;
use std::sync::Arc;

/// Scores a scene by how far it reaches out of `domain`.
///
/// # Errors
/// `bad-setting` when `sigma` is not positive, or for a box without extent along an axis.
pub fn no_overshoot(domain: Aabb, sigma: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(sigma)?;
    check_box(&domain)?;
    Ok(Arc::new(Overshoot { domain, sigma, bag: Bag::default() }))
}

/// Checks that a box has an inside.
///
/// # Errors
/// `bad-setting` for a box without extent along an axis, or without an end.
pub(super) fn check_box(domain: &Aabb) -> Result<(), GeomError> {
    let extent = domain.extent().to_array();
    if !domain.low.is_finite() || !domain.high.is_finite() || extent.iter().any(|e| *e <= 0.0) {
        let (low, high) = (domain.low.to_array(), domain.high.to_array());
        let message = format!("the box from {low:?} to {high:?} has no inside");
        return Err(GeomError::new("bad-setting", message));
    }
    Ok(())
}

impl SketchSpec for Overshoot {
    fn name(&self) -> &'static str {
        "overshoot"
    }

    fn most(&self) -> f64 {
        log_normal(0.0, 0.0, self.sigma)
    }
}

/// The box around the scene so far.
#[derive(Clone, Debug)]
pub struct Overshoot {
    domain: Aabb,
    sigma: f64,
    bag: Bag,
}

/// Sum over the six sides of the length of `scene` outside `domain`, as a share of the domain's extent.
pub fn overshoot(scene: &Aabb, domain: &Aabb) -> f64 {
    if scene.is_empty() {
        return 0.0;
    }
    let extent = domain.extent();
    let side = |a: usize| {
        let below = (domain.low[a] - scene.low[a]).max(0.0);
        let above = (scene.high[a] - domain.high[a]).max(0.0);
        below / extent[a] + above / extent[a]
    };
    side(0) + side(1) + side(2)
}

impl PartialEq for Overshoot {
    fn eq(&self, other: &Overshoot) -> bool {
        (self.domain, self.sigma) == (other.domain, other.sigma) && self.bag == other.bag
    }
}

impl Sketch for Overshoot {
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
        log_normal(overshoot(&self.bag.bounds(), &self.domain), 0.0, self.sigma)
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("overshoot", overshoot(&self.bag.bounds(), &self.domain))]
    }
}
