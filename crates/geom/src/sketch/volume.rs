//! Volume matching: how well the filled cells agree with a target's, and how far the scene reaches beyond it.
//!
//! ```text
//! log score = ln N(similarity; 1, sigma) + ln N(overshoot; 0, sigma)          both with normalisers
//! similarity = cells equal in scene and target / cells of the domain
//! overshoot  = sum over six sides of (length outside the domain / extent of the domain along that axis)
//! ```
//!
//! Dissertation 5.5.1. differs: similarity is over exactly the domain's cells (the original pads to words of 32);
//! overshoot is a sum over the sides, as in the original's code; its text has the maximum.

use super::bag::Bag;
use super::brick::{Plane, any};
use super::counters::{Counters, any_brick, both, bricks_of, ones, planes_of};
use super::overshoot::overshoot;
use super::{Sketch, SketchSpec, log_normal, share};
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::mesh::TriMesh;
use crate::once::Once;
use crate::primitive::Primitive;
use crate::shape::Shape;
use crate::voxel::{CellBox, Grid, Voxels};
use crate::window::solid::{Sums, Volume, sums_of};
use crate::window::{Place, WindowForm};
use std::sync::{Arc, OnceLock};

/// A mesh to match, voxelised once.
#[derive(Debug)]
pub struct Target {
    mesh: TriMesh,
    grid: Grid,
    planes: Vec<Plane>,
    filled: usize,
    /// What windows need, once one asks.
    sums: OnceLock<Vec<Sums>>,
}

impl Target {
    /// Voxelises `mesh` with cells at most `voxel` scene units wide.
    ///
    /// # Errors
    /// `bad-setting`, `too-many-cells`, and `no-cell-filled` (impossible for a mesh with a finite triangle).
    pub fn new(mesh: TriMesh, voxel: f64) -> Result<Target, GeomError> {
        let grid = Grid::around(&mesh.aabb(), voxel)?;
        let empty = || GeomError::new("no-cell-filled", "the target mesh fills no cell of its grid");
        let voxels = Voxels::of_mesh(&mesh, &grid).ok_or_else(empty)?;
        let planes = planes_of(&voxels, grid.dims());
        let filled = planes.iter().flatten().map(|w| w.count_ones() as usize).sum();
        if filled == 0 {
            return Err(empty());
        }
        Ok(Target { mesh, grid, planes, filled, sums: OnceLock::new() })
    }

    /// The mesh.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// The domain and its cells.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Number of filled cells.
    pub fn filled(&self) -> usize {
        self.filled
    }

    /// The cells of a brick, by its place in its layer and its layer.
    #[inline]
    pub(crate) fn plane(&self, [place, layer]: [usize; 2]) -> &Plane {
        let across = bricks_of(self.grid.dims());
        &self.planes[layer * across[0] * across[1] + place]
    }

    /// Wanted and empty cells by boxes, brick by brick.
    pub(crate) fn sums(&self) -> &[Sums] {
        self.sums.once(|| sums_of(&self.planes, self.grid.dims()))
    }

    /// Number of cells that the target and `voxels`, of the same grid, both fill.
    pub fn shared_with(&self, voxels: &Voxels) -> u64 {
        let mut shared = 0;
        any_brick(voxels.cells, bricks_of(self.grid.dims()), |index, rows| {
            let target = &self.planes[index];
            rows.any_slab(voxels, |slab, cells| {
                shared += ones(&both(cells, target, slab));
                false
            })
        });
        shared as u64
    }

    /// True when the target and `voxels`, of the same grid, both fill some cell.
    pub fn meets(&self, voxels: &Voxels) -> bool {
        any_brick(voxels.cells, bricks_of(self.grid.dims()), |index, rows| {
            let target = &self.planes[index];
            rows.any_slab(voxels, |slab, cells| any(&both(cells, target, slab)))
        })
    }

    /// Calls `fill` with each cell that shapes fill, those of several more than once: the cells that the score counts.
    pub fn visit_filled(&self, shapes: &[Shape], mut fill: impl FnMut([usize; 3])) {
        for voxels in shapes.iter().filter_map(|shape| Voxels::of(shape, &self.grid)) {
            let CellBox { low, high } = voxels.cells;
            for (z, y) in (low[2]..=high[2]).flat_map(|z| (low[1]..=high[1]).map(move |y| (z, y))) {
                for column in low[0] / 64..=high[0] / 64 {
                    let mut word = voxels.word(column, y, z);
                    while word != 0 {
                        fill([64 * column + word.trailing_zeros() as usize, y, z]);
                        word &= word - 1;
                    }
                }
            }
        }
    }

    /// True when the target fills the cell.
    pub fn contains(&self, cell: [usize; 3]) -> bool {
        let [x, y, z] = cell;
        let across = bricks_of(self.grid.dims());
        let brick = ((z / 8) * across[1] + y / 8) * across[0] + x / 64;
        self.planes[brick][z % 8 * 8 + y % 8] >> (x % 64) & 1 == 1
    }
}

struct VolumeSpec {
    target: Arc<Target>,
    sigma: f64,
}

/// Scores a scene by how well it fills `target`; `sigma` is the standard deviation of both terms.
///
/// # Errors
/// `bad-setting` when it is not positive.
pub fn match_volume(target: Arc<Target>, sigma: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    super::check_sigma(sigma)?;
    Ok(Arc::new(VolumeSpec { target, sigma }))
}

impl SketchSpec for VolumeSpec {
    fn name(&self) -> &'static str {
        "match_volume"
    }

    fn window(&self) -> Option<WindowForm> {
        let [x, y, z] = self.target.grid.domain().extent().to_array();
        Some(WindowForm::solid(x.max(y).max(z)))
    }

    fn domain(&self) -> Option<Aabb> {
        Some(*self.target.grid.domain())
    }

    fn start(&self) -> Box<dyn Sketch> {
        Box::new(VolumeMatch::new(self.target.clone(), self.sigma))
    }
}

/// The cells filled so far, and the box around everything.
#[derive(Debug)]
pub struct VolumeMatch {
    target: Arc<Target>,
    sigma: f64,
    counters: Counters,
    /// Filled cells, and those of them that the target fills too.
    filled: i64,
    inside: i64,
    /// With the cells that each primitive fills, shape by shape.
    bag: Bag<Arc<[Voxels]>>,
}

impl VolumeMatch {
    /// The empty scene.
    pub fn new(target: Arc<Target>, sigma: f64) -> VolumeMatch {
        let counters = Counters::new(target.grid.dims());
        VolumeMatch { target, sigma, counters, filled: 0, inside: 0, bag: Bag::default() }
    }

    /// Number of cells that are filled in both or empty in both.
    pub fn matched(&self) -> i64 {
        // Wanted and not filled, or filled and not wanted, is a mismatch.
        let missing = self.target.filled as i64 - self.inside;
        let surplus = self.filled - self.inside;
        self.target.grid.len() as i64 - missing - surplus
    }

    /// Share of the domain's cells that are equal in scene and target.
    pub fn similarity(&self) -> f64 {
        self.matched() as f64 / self.target.grid.len() as f64
    }

    /// Number of cells that the scene fills.
    pub fn filled(&self) -> i64 {
        self.filled
    }

    /// Sum over the six sides of the length outside the domain, as a share of the domain's extent.
    pub fn overshoot(&self) -> f64 {
        overshoot(&self.bag.bounds(), self.target.grid.domain())
    }

    /// Counts of shapes for each cell.
    pub fn counters(&self) -> &Counters {
        &self.counters
    }
}

/// The cells that each shape fills, but for those that fill none.
fn voxels_of(primitive: &Primitive, grid: &Grid) -> impl Iterator<Item = Voxels> {
    primitive.shapes().iter().filter_map(|shape| Voxels::of(shape, grid))
}

/// The same, all of them.
fn filled_by(primitive: &Primitive, grid: &Grid) -> Arc<[Voxels]> {
    voxels_of(primitive, grid).collect()
}

impl Clone for VolumeMatch {
    fn clone(&self) -> VolumeMatch {
        VolumeMatch {
            target: self.target.clone(),
            sigma: self.sigma,
            counters: self.counters.clone(),
            filled: self.filled,
            inside: self.inside,
            bag: self.bag.clone(),
        }
    }

    fn clone_from(&mut self, source: &VolumeMatch) {
        share(&mut self.target, &source.target);
        self.sigma = source.sigma;
        self.counters.clone_from(&source.counters);
        self.filled = source.filled;
        self.inside = source.inside;
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for VolumeMatch {
    fn eq(&self, other: &VolumeMatch) -> bool {
        Arc::ptr_eq(&self.target, &other.target)
            && self.sigma == other.sigma
            && (self.filled, self.inside) == (other.filled, other.inside)
            && self.counters == other.counters
            && self.bag == other.bag
    }
}

impl Sketch for VolumeMatch {
    fn name(&self) -> &'static str {
        "match_volume"
    }

    fn add(&mut self, primitive: &Primitive) {
        let VolumeMatch { target, counters, bag, .. } = self;
        let mut fill = |voxels: &Voxels| {
            let change = counters.add(voxels, &target.planes);
            self.filled += change.filled;
            self.inside += change.inside;
        };
        if bag.keeps_marks() {
            let filled = filled_by(primitive, &target.grid);
            filled.iter().for_each(fill);
            bag.add(primitive, || filled);
        } else {
            voxels_of(primitive, &target.grid).for_each(|voxels| fill(&voxels));
            bag.add(primitive, || filled_by(primitive, &target.grid));
        }
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let Some(filled) = self.bag.remove(primitive, || filled_by(primitive, &self.target.grid)) else {
            return false;
        };
        for voxels in &*filled {
            let change = self.counters.remove(voxels, &self.target.planes);
            self.filled += change.filled;
            self.inside += change.inside;
        }
        true
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn expect_windows(&mut self) {
        self.counters.expect_windows(&self.target.planes);
    }

    fn look(&self, form: &WindowForm, place: &Place, out: &mut Vec<f32>) {
        let known;
        let counters = match self.counters.expects_windows() {
            true => &self.counters,
            false => {
                let mut counters = self.counters.clone();
                counters.expect_windows(&self.target.planes);
                known = counters;
                &known
            }
        };
        Volume::new(&self.target, counters).look(form, place, out);
    }

    fn log_score(&self) -> f64 {
        log_normal(self.similarity(), 1.0, self.sigma) + log_normal(self.overshoot(), 0.0, self.sigma)
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("similarity", self.similarity()),
            ("overshoot", self.overshoot()),
            ("filled", self.filled as f64),
        ]
    }
}
