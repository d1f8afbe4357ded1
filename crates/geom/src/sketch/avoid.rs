//! Object avoidance: no cell may be filled by both the scene and an obstacle.
//!
//! The obstacle and each shape are voxelised as solids on the obstacle's own grid, conservatively. So a scene
//! that is allowed never touches the obstacle and keeps up to two cells away from it (dissertation 5.5.1). The sketch
//! keeps the number of primitives that share a cell with the obstacle. It is zero exactly when no primitive does, so no grid of
//! the scene is needed.
//!
//! Most tests of a shape need no cells of it. A shape shares no cell when the obstacle fills no cell of the box around it, and
//! it shares a cell when the obstacle fills the cell of one of its points. Shared cells are counted only for people.

use super::bag::Bag;
use super::form::Forbids;
use super::score::{Sketch, SketchSpec, share};
use crate::bricks::Target;
use crate::solids::primitive::Primitive;
use crate::solids::shape::Shape;
use crate::vector::Vec3;
use crate::voxel::{Grid, Voxels};
use std::sync::Arc;

/// The texts for forbidden scenes.
pub(super) const FORBIDS: Forbids = Forbids {
    part: "reaches into the obstacle",
    cure: "start the model beside the obstacle, or make the obstacle smaller",
};

/// Forbids scenes that fill a cell of `obstacle`.
pub fn avoid(obstacle: Arc<Target>) -> Arc<dyn SketchSpec> {
    Arc::new(Avoid::new(obstacle))
}

impl SketchSpec for Avoid {
    fn name(&self) -> &'static str {
        "avoid"
    }

    fn grid(&self) -> Option<&Grid> {
        Some(self.obstacle.grid())
    }

    fn most(&self) -> f64 {
        0.0
    }
}

/// The count of primitives that fill a cell of the obstacle.
#[derive(Debug)]
pub struct Avoid {
    obstacle: Arc<Target>,
    touching: u64,
    /// The primitives; a mark is true if a primitive fills a cell of the obstacle.
    bag: Bag<bool>,
}

impl Avoid {
    /// The empty scene.
    pub fn new(obstacle: Arc<Target>) -> Avoid {
        Avoid { obstacle, touching: 0, bag: Bag::default() }
    }

    /// Cells of the obstacle that shapes fill, each shape counted by itself.
    pub fn shared(&self) -> u64 {
        let mut shared = 0;
        if self.touching > 0 {
            self.bag.each(|primitive| shared += shared_by(&self.obstacle, primitive));
        }
        shared
    }
}

/// Cells of `obstacle` that the shapes of `primitive` fill, each shape counted by itself.
fn shared_by(obstacle: &Target, primitive: &Primitive) -> u64 {
    let voxels = primitive.shapes().iter().filter_map(|s| Voxels::of(s, obstacle.grid()));
    voxels.map(|voxels| obstacle.shared_with(&voxels)).sum()
}

/// True when a shape of `primitive` fills a cell of `obstacle`.
fn touches(obstacle: &Target, primitive: &Primitive) -> bool {
    primitive.shapes().iter().any(|shape| shares_a_cell(obstacle, shape))
}

fn shares_a_cell(obstacle: &Target, shape: &Shape) -> bool {
    let Some(cells) = obstacle.grid().cells_of(shape.aabb()) else { return false };
    if !obstacle.meets(&Voxels::block(cells)) {
        return false;
    }
    shape.is_aligned_box()
        || has_a_point_in(obstacle, shape)
        || Voxels::of(shape, obstacle.grid()).is_some_and(|voxels| obstacle.meets(&voxels))
}

/// True when a corner of the shape, or the mean of a convex shape's corners, lies in a cell of the obstacle.
fn has_a_point_in(obstacle: &Target, shape: &Shape) -> bool {
    let inside = |p: Vec3| obstacle.grid().cell_at(p).is_some_and(|cell| obstacle.contains(cell));
    match shape.convex() {
        Some(convex) => {
            let corners = convex.corners();
            let sum = corners.iter().fold(Vec3::ZERO, |sum, p| sum + *p);
            inside(sum * (1.0 / corners.len() as f64)) || corners.iter().any(|p| inside(*p))
        }
        None => shape.world_mesh().corners().flatten().any(inside),
    }
}

impl Clone for Avoid {
    fn clone(&self) -> Avoid {
        Avoid { obstacle: self.obstacle.clone(), touching: self.touching, bag: self.bag.clone() }
    }

    fn clone_from(&mut self, source: &Avoid) {
        share(&mut self.obstacle, &source.obstacle);
        self.touching = source.touching;
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for Avoid {
    fn eq(&self, other: &Avoid) -> bool {
        Arc::ptr_eq(&self.obstacle, &other.obstacle)
            && self.touching == other.touching
            && self.bag == other.bag
    }
}

impl Sketch for Avoid {
    fn add(&mut self, primitive: &Primitive) {
        let touches = touches(&self.obstacle, primitive);
        self.touching += u64::from(touches);
        self.bag.add(primitive, || touches);
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let touched = self.bag.remove(primitive, || touches(&self.obstacle, primitive));
        self.touching -= u64::from(touched.unwrap_or(false));
        touched.is_some()
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn log_score(&self) -> f64 {
        if self.touching == 0 { 0.0 } else { f64::NEG_INFINITY }
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("cells_in_obstacle", self.shared() as f64)]
    }
}
