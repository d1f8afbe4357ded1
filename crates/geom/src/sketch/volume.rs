//! Volume matching: the agreement of filled cells with those of a target, and the reach of the scene beyond it.
//!
//! ```text
//! log score = ln N(similarity; 1, deviation) + ln N(overshoot; 0, sigma)      both with normalisers
//! cells:     similarity = cells equal in scene and target / cells of the domain,            deviation = sigma
//! balanced:  similarity = cells that both fill / cells that the scene or the target fills,  deviation = 5 sigma
//! overshoot = sum over six sides of (length outside the domain / extent of the domain along that axis)
//! ```
//!
//! Dissertation 5.5.1. differs: similarity is over exactly the domain's cells (the original pads to words of 32);
//! overshoot is a sum over the sides, as in the original's code; its text has the maximum. That is the similarity of `cells`.
//!
//! That of `balanced` is the Jaccard index of the two sets (intersection over union): cells that neither fills do not count, so that
//! the emptiness around a thin target is no merit. Both are quotients of the same integers, the filled cells and those among them
//! inside of the target, so either is exact in any order of shapes.

use super::bag::Bag;
use super::overshoot::overshoot;
use super::score::{Sketch, SketchSpec, check_sigma, log_normal, share};
use crate::bounds::Aabb;
use crate::bricks::{Counters, Target};
use crate::error::GeomError;
use crate::solids::primitive::Primitive;
use crate::voxel::{Grid, Voxels};
use crate::window::solid::Volume;
use crate::window::{Place, WindowForm};
use serde::Deserialize;
use std::sync::Arc;

/// The standard deviation of the balanced similarity, in those of the other terms. A target of the usual size fills a fifth of its
/// domain. If all of it is missing, both similarities lower the score by as much.
pub const BALANCED_DEVIATIONS: f64 = 5.0;

/// The cells that count in the similarity of volumes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CellWeight {
    /// All cells of the domain.
    #[default]
    Cells,
    /// The cells that the target or the scene fills.
    Balanced,
}

/// Scores a scene by how well it fills `target`, where all cells count; `sigma` is the standard deviation of both terms.
///
/// # Errors
/// `bad-setting` when it is not positive.
pub fn match_volume(target: Arc<Target>, sigma: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    match_volume_by(target, sigma, CellWeight::Cells)
}

/// Scores a scene by how well it fills `target`, where the cells of `weight` count.
///
/// # Errors
/// `bad-setting` when `sigma` is not positive.
pub fn match_volume_by(
    target: Arc<Target>,
    sigma: f64,
    weight: CellWeight,
) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(sigma)?;
    Ok(Arc::new(VolumeMatch::new(target, sigma).weighted(weight)))
}

impl SketchSpec for VolumeMatch {
    fn name(&self) -> &'static str {
        "match_volume"
    }

    fn most(&self) -> f64 {
        log_normal(1.0, 1.0, self.deviation()) + log_normal(0.0, 0.0, self.sigma)
    }

    fn window(&self) -> Option<WindowForm> {
        let [x, y, z] = self.target.grid().domain().extent().to_array();
        Some(WindowForm::solid(x.max(y).max(z)))
    }

    fn domain(&self) -> Option<Aabb> {
        Some(*self.target.grid().domain())
    }

    fn grid(&self) -> Option<&Grid> {
        Some(self.target.grid())
    }
}

/// The cells filled so far, and the box around everything.
#[derive(Debug)]
pub struct VolumeMatch {
    target: Arc<Target>,
    sigma: f64,
    weight: CellWeight,
    counters: Counters,
    /// Filled cells, and the cells among them that the target fills.
    filled: i64,
    inside: i64,
    /// The primitives; a mark has the cells that a primitive fills, shape by shape.
    bag: Bag<Arc<[Voxels]>>,
}

impl VolumeMatch {
    /// The empty scene, where all cells count.
    pub fn new(target: Arc<Target>, sigma: f64) -> VolumeMatch {
        let (weight, counters) = (CellWeight::default(), Counters::new(target.grid().dims()));
        VolumeMatch { target, sigma, weight, counters, filled: 0, inside: 0, bag: Bag::default() }
    }

    /// Makes the cells of `weight` count.
    #[must_use]
    pub fn weighted(self, weight: CellWeight) -> VolumeMatch {
        VolumeMatch { weight, ..self }
    }

    /// Number of cells that are filled in both or empty in both.
    pub fn matched(&self) -> i64 {
        // A cell of the target that is empty, or a filled cell outside of the target, is a mismatch.
        let missing = self.target.filled() as i64 - self.inside;
        let surplus = self.filled - self.inside;
        self.target.grid().len() as i64 - missing - surplus
    }

    /// Share of the cells that count and are equal in scene and target.
    pub fn similarity(&self) -> f64 {
        match self.weight {
            CellWeight::Cells => self.matched() as f64 / self.target.grid().len() as f64,
            CellWeight::Balanced => {
                let either = self.target.filled() as i64 + self.filled - self.inside;
                self.inside as f64 / either as f64
            }
        }
    }

    /// Standard deviation of the similarity.
    fn deviation(&self) -> f64 {
        match self.weight {
            CellWeight::Cells => self.sigma,
            CellWeight::Balanced => BALANCED_DEVIATIONS * self.sigma,
        }
    }

    /// Number of cells that the scene fills.
    pub fn filled(&self) -> i64 {
        self.filled
    }

    /// Sum over the six sides of the length outside the domain, as a share of the domain's extent.
    pub fn overshoot(&self) -> f64 {
        overshoot(&self.bag.bounds(), self.target.grid().domain())
    }

    /// Counts of shapes for each cell.
    pub fn counters(&self) -> &Counters {
        &self.counters
    }
}

/// The cells of each shape that fills any, one after another.
fn voxels_of(primitive: &Primitive, grid: &Grid) -> impl Iterator<Item = Voxels> {
    primitive.shapes().iter().filter_map(|shape| Voxels::of(shape, grid))
}

/// The cells of each shape that fills any, as a list.
fn filled_by(primitive: &Primitive, grid: &Grid) -> Arc<[Voxels]> {
    voxels_of(primitive, grid).collect()
}

impl Clone for VolumeMatch {
    fn clone(&self) -> VolumeMatch {
        VolumeMatch {
            target: self.target.clone(),
            sigma: self.sigma,
            weight: self.weight,
            counters: self.counters.clone(),
            filled: self.filled,
            inside: self.inside,
            bag: self.bag.clone(),
        }
    }

    fn clone_from(&mut self, source: &VolumeMatch) {
        share(&mut self.target, &source.target);
        (self.sigma, self.weight) = (source.sigma, source.weight);
        self.counters.clone_from(&source.counters);
        self.filled = source.filled;
        self.inside = source.inside;
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for VolumeMatch {
    fn eq(&self, other: &VolumeMatch) -> bool {
        Arc::ptr_eq(&self.target, &other.target)
            && (self.sigma, self.weight) == (other.sigma, other.weight)
            && (self.filled, self.inside) == (other.filled, other.inside)
            && self.counters == other.counters
            && self.bag == other.bag
    }
}

impl Sketch for VolumeMatch {
    fn add(&mut self, primitive: &Primitive) {
        let VolumeMatch { target, counters, bag, .. } = self;
        let mut fill = |voxels: &Voxels| {
            let change = counters.add(voxels, target.planes());
            self.filled += change.filled;
            self.inside += change.inside;
        };
        if bag.keeps_marks() {
            let filled = filled_by(primitive, target.grid());
            filled.iter().for_each(fill);
            bag.add(primitive, || filled);
        } else {
            voxels_of(primitive, target.grid()).for_each(|voxels| fill(&voxels));
            bag.add(primitive, || filled_by(primitive, target.grid()));
        }
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let Some(filled) = self.bag.remove(primitive, || filled_by(primitive, self.target.grid())) else {
            return false;
        };
        for voxels in &*filled {
            let change = self.counters.remove(voxels, self.target.planes());
            self.filled += change.filled;
            self.inside += change.inside;
        }
        true
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn expect_windows(&mut self) {
        self.counters.expect_windows(self.target.planes());
    }

    fn look(&self, form: &WindowForm, place: &Place, out: &mut Vec<f32>) {
        let known;
        let counters = match self.counters.expects_windows() {
            true => &self.counters,
            false => {
                let mut counters = self.counters.clone();
                counters.expect_windows(self.target.planes());
                known = counters;
                &known
            }
        };
        Volume::new(&self.target, counters).look(form, place, out);
    }

    fn log_score(&self) -> f64 {
        log_normal(self.similarity(), 1.0, self.deviation()) + log_normal(self.overshoot(), 0.0, self.sigma)
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("similarity", self.similarity()),
            ("overshoot", self.overshoot()),
            ("filled", self.filled as f64),
        ]
    }
}
