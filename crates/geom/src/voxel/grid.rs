//! Grids over boxes: the domain of a target, its cells, and the map from world to grid coordinates.
//!
//! Grid coordinates count cells: cell `i` is the closed interval `[i, i + 1]`. The domain is the target's box plus
//! 0.1 scene units on all six sides. The number of cells is the extent divided by the voxel size, rounded up, so that cells
//! are a little smaller than the voxel size and no cubes.

use super::cells::CellBox;
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::vector::{Vec3, vec3};

/// Margin around the target on all six sides, scene units.
pub const PAD: f64 = 0.1;
/// The distance, in cells, up to which a solid touches a cell.
pub const TOUCH: f64 = 1e-6;
const MOST_CELLS: f64 = 268_435_456.0;

/// A box cut into cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    domain: Aabb,
    cell: Vec3,
    dims: [usize; 3],
}

impl Grid {
    /// The grid around a target's box, cells at most `voxel` scene units wide.
    ///
    /// # Errors
    /// `bad-setting` for a size that is not positive, `too-many-cells` beyond 2^28 cells.
    pub fn around(target: &Aabb, voxel: f64) -> Result<Grid, GeomError> {
        if !(voxel > 0.0 && voxel.is_finite()) {
            return Err(GeomError::new(
                "bad-setting",
                format!("the voxel size is {voxel}, expected a positive number"),
            ));
        }
        let domain = target.grown(PAD);
        let extent = domain.extent().to_array();
        let counts = extent.map(|e| (e / voxel).ceil());
        let cells: f64 = counts.iter().product();
        if cells.is_nan() || cells > MOST_CELLS {
            let message =
                format!("voxels of {voxel} make a grid of {counts:?} cells; use a larger voxel size");
            return Err(GeomError::new("too-many-cells", message));
        }
        let dims = counts.map(|c| c as usize);
        let cell = vec3(extent[0] / counts[0], extent[1] / counts[1], extent[2] / counts[2]);
        Ok(Grid { domain, cell, dims })
    }

    /// The box that the grid covers, world space.
    pub fn domain(&self) -> &Aabb {
        &self.domain
    }

    /// Cells along x, y and z.
    pub fn dims(&self) -> [usize; 3] {
        self.dims
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.dims.iter().product()
    }

    /// Always false: a grid has cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Lengths of a cell, scene units.
    pub fn cell(&self) -> Vec3 {
        self.cell
    }

    /// From world to grid coordinates.
    #[inline]
    pub fn to_grid(&self, p: Vec3) -> Vec3 {
        let q = p - self.domain.low;
        vec3(q.x / self.cell.x, q.y / self.cell.y, q.z / self.cell.z)
    }

    /// From grid to world coordinates.
    pub fn to_world(&self, p: Vec3) -> Vec3 {
        self.domain.low + vec3(p.x * self.cell.x, p.y * self.cell.y, p.z * self.cell.z)
    }

    /// The cell of a point, world space; `None` when it is outside.
    #[inline]
    pub fn cell_at(&self, p: Vec3) -> Option<[usize; 3]> {
        let at = self.to_grid(p).to_array();
        let inside = (0..3).all(|a| at[a] >= 0.0 && at[a] < self.dims[a] as f64);
        inside.then(|| at.map(|x| x as usize))
    }

    /// Cells that a closed world box touches; `None` when it is outside.
    #[inline]
    pub fn cells_of(&self, bounds: &Aabb) -> Option<CellBox> {
        let (low, high) = (self.to_grid(bounds.low), self.to_grid(bounds.high));
        let mut cells = CellBox { low: [0; 3], high: [0; 3] };
        for a in 0..3 {
            // What is at least zero is rounded down where it becomes a whole number.
            let (first, last) = (low[a] - TOUCH, high[a] + TOUCH);
            if !(last >= 0.0 && first < self.dims[a] as f64) {
                return None;
            }
            cells.low[a] = first.max(0.0) as usize;
            cells.high[a] = (last as usize).min(self.dims[a] - 1);
        }
        Some(cells)
    }
}
