//! The layout of the cells of a grid in bricks: 64 by 8 by 8 cells, 64 words, one bit for each cell.

use super::brick::{Plane, Slab};
use crate::voxel::{CellBox, Voxels};

/// Cells along x, y and z in one brick; row (y, z) of it is word `8 * z + y`.
pub const BRICK: [usize; 3] = [64, 8, 8];

/// Cells of a grid as planes, brick by brick, x fastest.
#[inline]
pub fn bricks_of(dims: [usize; 3]) -> [usize; 3] {
    std::array::from_fn(|a| dims[a].div_ceil(BRICK[a]))
}

/// The part of a box of cells in a brick: the column of words, and the first and last y and z.
#[derive(Clone, Copy)]
pub(super) struct Rows {
    pub column: usize,
    pub y: [usize; 2],
    pub z: [usize; 2],
}

impl Rows {
    /// Calls `f` with the slabs of the brick in this part, and the cells of `voxels` in them, until it returns true. Returns
    /// true if it did.
    #[inline]
    pub fn any_slab(self, voxels: &Voxels, mut f: impl FnMut(usize, &Slab) -> bool) -> bool {
        let Rows { column, y, z: [first, last] } = self;
        let mut cells = voxels.slab(column, y, first);
        for z in first..=last {
            if z > first && !voxels.is_block() {
                cells = voxels.slab(column, y, z);
            }
            if f(z % 8, &cells) {
                return true;
            }
        }
        false
    }
}

/// The bricks along one axis that `cells` touch, and the first and last cell in each.
#[inline]
pub(super) fn parts(cells: CellBox, axis: usize) -> impl Iterator<Item = (usize, [usize; 2])> {
    let (low, high, size) = (cells.low[axis], cells.high[axis], BRICK[axis]);
    (low / size..=high / size).map(move |b| (b, [low.max(b * size), high.min(b * size + size - 1)]))
}

/// Calls `f` with the bricks that `cells` touch, the index of each and its rows, until it returns true. Returns true if it
/// did.
#[inline]
pub(super) fn any_brick(cells: CellBox, across: [usize; 3], mut f: impl FnMut(usize, Rows) -> bool) -> bool {
    for (layer, z) in parts(cells, 2) {
        for (row, y) in parts(cells, 1) {
            for (column, _) in parts(cells, 0) {
                if f((layer * across[1] + row) * across[0] + column, Rows { column, y, z }) {
                    return true;
                }
            }
        }
    }
    false
}

/// The cells that `cells` and slab `slab` of the target share.
#[inline]
pub(super) fn both(cells: &Slab, target: &Plane, slab: usize) -> Slab {
    let target = &target.as_chunks::<8>().0[slab];
    std::array::from_fn(|y| cells[y] & target[y])
}

/// Number of set bits.
#[inline]
pub(super) fn set_bits(words: &Slab) -> i64 {
    // At most 512: without a check at each word the loop is four instructions wide.
    words.iter().fold(0u64, |sum, word| sum.wrapping_add(u64::from(word.count_ones()))) as i64
}

/// The cells of `voxels` as planes, brick by brick.
pub fn planes_of(voxels: &Voxels, dims: [usize; 3]) -> Vec<Plane> {
    let across = bricks_of(dims);
    let mut planes = vec![[0; 64]; across.iter().product()];
    any_brick(voxels.cells, across, |index, rows| {
        rows.any_slab(voxels, |slab, cells| {
            planes[index].as_chunks_mut().0[slab] = *cells;
            false
        })
    });
    planes
}
