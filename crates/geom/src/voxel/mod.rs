//! The cells of a grid that a solid fills.
//!
//! A cell is filled when its closed cube meets the closed solid: surface cells are found conservatively, then enclosed cells
//! are filled. Each shape is voxelised and filled alone, so that a union never depends on order
//! (differs: the original's fill sees the accumulated grid).
//!
//! - [`grid`]: the domain and its cells; world to grid coordinates
//! - [`surface`], [`fill`]: any triangle mesh
//! - [`cut`]: cuts, by the cells of their solids
//! - [`slabs`]: convex solids, row by row; must agree with the method for meshes

pub mod cells;
pub mod cut;
pub mod fill;
pub mod grid;
pub mod slabs;
pub mod surface;

pub use cells::CellBox;
pub use grid::Grid;

use crate::solids::shape::Shape;
use surface::Bits;

/// The cells of a grid that a shape fills.
#[derive(Clone, Debug)]
pub struct Voxels {
    /// The box around the cells.
    pub cells: CellBox,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Every cell of the box.
    Block,
    /// A run of x for each row.
    Rows(slabs::Rows),
    /// Any set of cells.
    Bits(Bits),
}

impl Voxels {
    /// Cells of `grid` that `shape` fills; `None` when it fills none.
    pub fn of(shape: &Shape, grid: &Grid) -> Option<Voxels> {
        if shape.is_aligned_box() {
            return grid.cells_of(shape.aabb()).map(Voxels::block);
        }
        if let Some(tree) = shape.cut() {
            let (cells, bits) = cut::cells(tree, &shape.world_mesh(), grid)?;
            return Some(Voxels { cells, kind: Kind::Bits(bits) });
        }
        let Some(convex) = shape.convex() else { return Voxels::of_mesh(&shape.world_mesh(), grid) };
        let cells = grid.cells_of(shape.aabb())?;
        Some(Voxels { cells, kind: Kind::Rows(slabs::rows(&convex, grid, &cells)) })
    }

    /// Every cell of a box.
    #[inline]
    pub fn block(cells: CellBox) -> Voxels {
        Voxels { cells, kind: Kind::Block }
    }

    /// Cells that a closed mesh fills, by its triangles.
    pub fn of_mesh(mesh: &crate::mesh::TriMesh, grid: &Grid) -> Option<Voxels> {
        let bits = fill::solid(mesh, grid)?;
        let high = std::array::from_fn(|a| grid.dims()[a] - 1);
        Some(Voxels { cells: bits.cells_within(&CellBox { low: [0; 3], high })?, kind: Kind::Bits(bits) })
    }

    /// Cells `64 * column ..` of row (y, z), the lowest x in the lowest bit. (y, z) must lie in the box.
    #[inline(always)]
    pub fn word(&self, column: usize, y: usize, z: usize) -> u64 {
        let (first, last) = match &self.kind {
            Kind::Block => (self.cells.low[0], self.cells.high[0]),
            Kind::Rows(rows) => {
                let [_, y0, z0] = self.cells.low;
                rows.get(y - y0, z - z0)
            }
            Kind::Bits(bits) => {
                return bits.word(column, y, z) & run(column, self.cells.low[0], self.cells.high[0]);
            }
        };
        run(column, first, last)
    }

    /// Cells `64 * column ..` of the rows from `first` to `last` at `z`: row `y` is word `y % 8`, other words are zero. The
    /// rows must lie in the box, and among eight rows that begin at a multiple of eight.
    #[inline(always)]
    pub fn slab(&self, column: usize, [first, last]: [usize; 2], z: usize) -> [u64; 8] {
        let mut words = [0; 8];
        let rows = &mut words[first % 8..=last % 8];
        match &self.kind {
            Kind::Block => rows.fill(run(column, self.cells.low[0], self.cells.high[0])),
            Kind::Rows(runs) => {
                let [_, y0, z0] = self.cells.low;
                let line = runs.along_y(first - y0, z - z0);
                rows.iter_mut().zip(line).for_each(|(word, (first, last))| *word = run(column, first, last));
            }
            Kind::Bits(_) => {
                rows.iter_mut().zip(first..).for_each(|(word, y)| *word = self.word(column, y, z))
            }
        }
        words
    }

    /// True when every cell of the box is filled.
    #[inline]
    pub fn is_block(&self) -> bool {
        matches!(self.kind, Kind::Block)
    }

    /// True when the cell is filled.
    pub fn contains(&self, cell: [usize; 3]) -> bool {
        let within = (0..3).all(|a| (self.cells.low[a]..=self.cells.high[a]).contains(&cell[a]));
        within && self.word(cell[0] / 64, cell[1], cell[2]) >> (cell[0] % 64) & 1 == 1
    }

    /// Number of filled cells.
    pub fn count(&self) -> usize {
        let CellBox { low, high } = self.cells;
        let rows = (low[2]..=high[2]).flat_map(|z| (low[1]..=high[1]).map(move |y| (y, z)));
        let words = rows.flat_map(|(y, z)| (low[0] / 64..=high[0] / 64).map(move |c| (c, y, z)));
        words.map(|(c, y, z)| self.word(c, y, z).count_ones() as usize).sum()
    }
}

/// Bits of the word `column` for the cells `first..=last`.
#[inline]
fn run(column: usize, first: usize, last: usize) -> u64 {
    let from = |cell: usize| u64::MAX.checked_shl(cell.saturating_sub(64 * column) as u32).unwrap_or(0);
    from(first) & !from(last + 1)
}
