//! Object avoidance: no cell may be filled by both the scene and an obstacle.
//!
//! The obstacle and each shape are voxelised as solids on the obstacle's own grid, conservatively, so that a scene
//! that is allowed never touches the obstacle and keeps up to two cells away from it (dissertation 5.5.1). The sketch
//! keeps the sum over shapes of the cells that each shares with the obstacle: an integer that is zero exactly when
//! no shape shares one, so no grid of the scene is needed and a step costs the new shape's own cells.

use super::bag::Bag;
use super::volume::Target;
use super::{Sketch, SketchSpec, share};
use crate::primitive::Primitive;
use crate::voxel::Voxels;
use std::sync::Arc;

struct AvoidSpec {
    obstacle: Arc<Target>,
}

/// Forbids scenes that fill a cell of `obstacle`.
pub fn avoid(obstacle: Arc<Target>) -> Arc<dyn SketchSpec> {
    Arc::new(AvoidSpec { obstacle })
}

impl SketchSpec for AvoidSpec {
    fn name(&self) -> &'static str {
        "avoid"
    }

    fn start(&self) -> Box<dyn Sketch> {
        Box::new(Avoid::new(self.obstacle.clone()))
    }
}

/// How many cells of the obstacle the shapes fill, each shape counted by itself.
#[derive(Debug)]
pub struct Avoid {
    obstacle: Arc<Target>,
    shared: u64,
    /// With the cells of the obstacle that each primitive fills.
    bag: Bag<u64>,
}

impl Avoid {
    /// The empty scene.
    pub fn new(obstacle: Arc<Target>) -> Avoid {
        Avoid { obstacle, shared: 0, bag: Bag::default() }
    }

    /// Cells of the obstacle that shapes fill, each shape counted by itself.
    pub fn shared(&self) -> u64 {
        self.shared
    }
}

/// Cells of `obstacle` that the shapes of `primitive` fill, each shape counted by itself.
fn shared_by(obstacle: &Target, primitive: &Primitive) -> u64 {
    let voxels = primitive.shapes().iter().filter_map(|s| Voxels::of(s, obstacle.grid()));
    voxels.map(|voxels| obstacle.shared_with(&voxels)).sum()
}

impl Clone for Avoid {
    fn clone(&self) -> Avoid {
        Avoid { obstacle: self.obstacle.clone(), shared: self.shared, bag: self.bag.clone() }
    }

    fn clone_from(&mut self, source: &Avoid) {
        share(&mut self.obstacle, &source.obstacle);
        self.shared = source.shared;
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for Avoid {
    fn eq(&self, other: &Avoid) -> bool {
        Arc::ptr_eq(&self.obstacle, &other.obstacle) && self.shared == other.shared && self.bag == other.bag
    }
}

impl Sketch for Avoid {
    fn name(&self) -> &'static str {
        "avoid"
    }

    fn add(&mut self, primitive: &Primitive) {
        let shared = shared_by(&self.obstacle, primitive);
        self.shared += shared;
        self.bag.add(primitive, shared);
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let shared = self.bag.remove(primitive, || shared_by(&self.obstacle, primitive));
        self.shared -= shared.unwrap_or(0);
        shared.is_some()
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn log_score(&self) -> f64 {
        if self.shared == 0 { 0.0 } else { f64::NEG_INFINITY }
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("cells_in_obstacle", self.shared as f64)]
    }
}
