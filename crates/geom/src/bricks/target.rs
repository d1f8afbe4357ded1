//! A target volume: a mesh, and the cells that it fills.

use super::brick::{Plane, any};
use super::layout::{any_brick, both, bricks_of, planes_of, set_bits};
use super::sums::{Sums, sums_of};
use crate::error::GeomError;
use crate::mesh::TriMesh;
use crate::once::Once;
use crate::solids::shape::Shape;
use crate::voxel::{CellBox, Grid, Voxels};
use std::sync::OnceLock;

/// A mesh to match, voxelised once.
#[derive(Debug)]
pub struct Target {
    mesh: TriMesh,
    grid: Grid,
    planes: Vec<Plane>,
    filled: usize,
    /// Sums for windows, once a window needs them.
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
    #[inline]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Number of filled cells.
    #[inline]
    pub fn filled(&self) -> usize {
        self.filled
    }

    /// The filled cells, brick by brick.
    #[inline]
    pub(crate) fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// The cells of a brick, by its place in its layer and its layer.
    #[inline]
    pub(crate) fn plane(&self, [place, layer]: [usize; 2]) -> &Plane {
        let across = bricks_of(self.grid.dims());
        &self.planes[layer * across[0] * across[1] + place]
    }

    /// Sums of the filled and the empty cells, brick by brick.
    pub(crate) fn sums(&self) -> &[Sums] {
        self.sums.once(|| sums_of(&self.planes, self.grid.dims()))
    }

    /// Number of cells that the target and `voxels`, of the same grid, both fill.
    pub fn shared_with(&self, voxels: &Voxels) -> u64 {
        let mut shared = 0;
        any_brick(voxels.cells, bricks_of(self.grid.dims()), |index, rows| {
            let target = &self.planes[index];
            rows.any_slab(voxels, |slab, cells| {
                shared += set_bits(&both(cells, target, slab));
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

    /// Calls `fill` with each cell that shapes fill, as the score counts them. Cells of several shapes come more than once.
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
