//! Counts of the shapes that fill each cell of a grid, in bricks that copies share.
//!
//! A brick without counts is not stored, so that equal counts are equal data.

use super::brick::{Brick, Plane, Slab, any};
use super::layout::{Rows, both, bricks_of, parts};
use super::sums::Sums;
use crate::voxel::{CellBox, Voxels};
use std::sync::Arc;

/// The change of the number of filled cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Change {
    /// Cells that became filled, less those that became empty.
    pub filled: i64,
    /// The change among the cells of the target.
    pub inside: i64,
}

/// The counts of a brick, and its sums for windows once these are expected.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Cells {
    pub counts: Brick,
    /// Filled cells of the target, and the other filled cells, by boxes.
    pub sums: Option<Box<Sums>>,
}

/// Cells of the target, and the other cells.
#[inline]
fn split(cells: u64, target: u64) -> [u64; 2] {
    [cells & target, cells & !target]
}

/// Bricks of one layer of z. Copies share layers too, so that a change copies references to few bricks.
type Layer = Arc<[Option<Arc<Cells>>]>;

/// A count for every cell of a grid. Cloning shares all bricks.
#[derive(Clone, Debug, PartialEq)]
pub struct Counters {
    layers: Arc<[Layer]>,
    across: [usize; 3],
    /// True once bricks keep sums.
    windows: bool,
}

impl Counters {
    /// Counters of zero.
    pub fn new(dims: [usize; 3]) -> Counters {
        let across = bricks_of(dims);
        let layer: Layer = vec![None; across[0] * across[1]].into();
        Counters { layers: vec![layer; across[2]].into(), across, windows: false }
    }

    /// Adds one to the count of every cell of `voxels`; `target` has the cells of the target.
    pub fn add(&mut self, voxels: &Voxels, target: &[Plane]) -> Change {
        let windows = self.windows;
        let mut change = Change::default();
        self.visit_mut(&voxels.cells, target, |place, target, rows| {
            let is_new = place.is_none();
            let cells = Arc::make_mut(place.get_or_insert_with(Arc::default));
            if is_new && windows {
                cells.sums = Some(Box::default());
            }
            let (brick, sums) = (&mut cells.counts, &mut cells.sums);
            let [filled, inside] = counted(voxels, target, rows, |slab, cells| {
                let new = brick.raise(slab, cells);
                if let Some(sums) = sums {
                    (0..8).for_each(|y| sums.add(8 * slab + y, split(new[y], target[8 * slab + y])));
                }
                new
            });
            change.filled += filled;
            change.inside += inside;
            if is_new && filled == 0 {
                *place = None;
            } else if let Some(sums) = sums {
                sums.settle();
            }
        });
        change
    }

    /// Subtracts one from the count of every cell of `voxels`, which must be above 0.
    pub fn remove(&mut self, voxels: &Voxels, target: &[Plane]) -> Change {
        let mut change = Change::default();
        self.visit_mut(&voxels.cells, target, |place, target, rows| {
            let Some(cells) = place else { return };
            let cells = Arc::make_mut(cells);
            let (brick, sums) = (&mut cells.counts, &mut cells.sums);
            let [filled, inside] = counted(voxels, target, rows, |slab, cells| {
                let emptied = brick.lower(slab, cells);
                if let Some(sums) = sums {
                    (0..8).for_each(|y| sums.remove(8 * slab + y, split(emptied[y], target[8 * slab + y])));
                }
                emptied
            });
            change.filled -= filled;
            change.inside -= inside;
            if brick.trim() {
                *place = None;
            } else if let Some(sums) = sums {
                sums.settle();
            }
        });
        change
    }

    /// Visits the bricks that `cells` touch: the place in an unshared layer, the cells of the target, and the rows.
    fn visit_mut(
        &mut self,
        cells: &CellBox,
        target: &[Plane],
        mut f: impl FnMut(&mut Option<Arc<Cells>>, &Plane, Rows),
    ) {
        let [nx, ny, _] = self.across;
        let layers = Arc::make_mut(&mut self.layers);
        let cells = *cells;
        for (layer, z) in parts(cells, 2) {
            let (bricks, target) = (Arc::make_mut(&mut layers[layer]), &target[layer * nx * ny..][..nx * ny]);
            for (row, y) in parts(cells, 1) {
                for (column, _) in parts(cells, 0) {
                    let at = row * nx + column;
                    f(&mut bricks[at], &target[at], Rows { column, y, z });
                }
            }
        }
    }

    /// True once bricks keep sums for windows.
    pub(crate) fn expects_windows(&self) -> bool {
        self.windows
    }

    /// Makes bricks keep sums for windows from now on.
    pub(crate) fn expect_windows(&mut self, target: &[Plane]) {
        if std::mem::replace(&mut self.windows, true) {
            return;
        }
        let size = self.across[0] * self.across[1];
        for (layer, target) in Arc::make_mut(&mut self.layers).iter_mut().zip(target.chunks(size)) {
            for (place, target) in Arc::make_mut(layer).iter_mut().zip(target) {
                if let Some(cells) = place {
                    let cells = Arc::make_mut(cells);
                    let sums = Sums::of(|word| split(cells.counts.any(word), target[word]));
                    cells.sums = Some(Box::new(sums));
                }
            }
        }
    }

    /// A brick by its place in its layer and its layer, where it has counts.
    #[inline]
    pub(crate) fn brick(&self, [place, layer]: [usize; 2]) -> Option<&Cells> {
        self.layers[layer][place].as_deref()
    }

    fn bricks(&self) -> impl Iterator<Item = &Option<Arc<Cells>>> {
        self.layers.iter().flat_map(|layer| layer.iter())
    }

    /// Count of one cell.
    pub fn get(&self, cell: [usize; 3]) -> u32 {
        let [x, y, z] = cell;
        let brick = &self.layers[z / 8][y / 8 * self.across[0] + x / 64];
        brick.as_ref().map_or(0, |brick| brick.counts.get(z % 8 * 8 + y % 8, x % 64))
    }

    /// Bricks that this and `other` share in memory.
    pub fn shared_with(&self, other: &Counters) -> usize {
        let pairs = self.bricks().zip(other.bricks());
        pairs.filter(|(a, b)| matches!((a, b), (Some(a), Some(b)) if Arc::ptr_eq(a, b))).count()
    }
}

/// Changes a brick slab by slab, and counts the cells that `change` returns, and the target's cells among them.
#[inline]
fn counted(
    voxels: &Voxels,
    target: &Plane,
    rows: Rows,
    mut change: impl FnMut(usize, &Slab) -> Slab,
) -> [i64; 2] {
    let mut all = [BitCounts::default(); 2];
    rows.any_slab(voxels, |slab, cells| {
        let changed = change(slab, cells);
        if any(&changed) {
            all[0].add(&changed);
            all[1].add(&both(&changed, target, slab));
        }
        false
    });
    all.map(BitCounts::sum)
}

/// Counts of set bits of up to eight slabs: each byte counts sixteen bits of a slab.
#[derive(Clone, Copy, Default)]
struct BitCounts([u64; 4]);

impl BitCounts {
    #[inline]
    fn add(&mut self, words: &Slab) {
        let twos = |word: u64| word.wrapping_sub(word >> 1 & 0x5555_5555_5555_5555);
        let fours = |word: u64| {
            let twos = twos(word);
            (twos & 0x3333_3333_3333_3333).wrapping_add(twos >> 2 & 0x3333_3333_3333_3333)
        };
        self.0 = std::array::from_fn(|k| {
            let sum = fours(words[k]).wrapping_add(fours(words[k + 4]));
            let bytes = (sum & 0x0f0f_0f0f_0f0f_0f0f).wrapping_add(sum >> 4 & 0x0f0f_0f0f_0f0f_0f0f);
            self.0[k].wrapping_add(bytes)
        });
    }

    #[inline]
    fn sum(self) -> i64 {
        const HALVES: u64 = 0x00ff_00ff_00ff_00ff;
        let pairs = self.0.iter().map(|word| (word & HALVES).wrapping_add(word >> 8 & HALVES));
        (pairs.fold(0, u64::wrapping_add).wrapping_mul(0x0001_0001_0001_0001) >> 48) as i64
    }
}

#[cfg(test)]
mod tests {
    //! Slabs are counted right up to a full brick.
    use super::super::layout::set_bits;
    use super::BitCounts;

    #[test]
    fn a_full_brick_has_4096_cells() {
        let mut all = BitCounts::default();
        (0..8).for_each(|_| all.add(&[u64::MAX; 8]));
        assert_eq!(all.sum(), 4096);
        let words = std::array::from_fn(|k| 0x9e37_79b9_7f4a_7c15_u64.rotate_left(7 * k as u32) << k);
        let mut some = BitCounts::default();
        some.add(&words);
        assert_eq!(some.sum(), set_bits(&words));
    }
}
