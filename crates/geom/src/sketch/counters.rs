//! How many shapes fill each cell of a grid, in bricks that copies share.
//!
//! A brick is 64 by 8 by 8 cells: 64 words, one bit for each cell. A brick without counts is not stored, so that
//! equal counts are equal data.

use super::brick::{Brick, Plane};
use crate::voxel::{CellBox, Voxels};
use crate::window::solid::Sums;
use std::sync::Arc;

/// Cells along x, y and z in one brick; row (y, z) of it is word `8 * z + y`.
pub const BRICK: [usize; 3] = [64, 8, 8];

/// Cells of a grid as planes, brick by brick, x fastest.
pub fn bricks_of(dims: [usize; 3]) -> [usize; 3] {
    std::array::from_fn(|a| dims[a].div_ceil(BRICK[a]))
}

/// The change of the number of filled cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Change {
    /// Cells that became filled, less those that became empty.
    pub filled: i64,
    /// The same, among the cells of the target.
    pub inside: i64,
}

/// The counts of a brick, and what windows need of it once they are expected.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Cells {
    pub counts: Brick,
    /// Filled cells that the target wants, and the other filled cells, by boxes.
    pub sums: Option<Box<Sums>>,
}

/// Cells that the target wants, and the others.
#[inline]
fn split(cells: u64, target: u64) -> [u64; 2] {
    [cells & target, cells & !target]
}

/// Bricks of one layer of z. Copies share layers too, so that a change copies references to few bricks.
type Layer = Arc<Vec<Option<Arc<Cells>>>>;

/// A count for every cell of a grid. Cloning shares all bricks.
#[derive(Clone, Debug, PartialEq)]
pub struct Counters {
    layers: Arc<Vec<Layer>>,
    across: [usize; 3],
    /// Bricks keep sums.
    windows: bool,
}

impl Counters {
    /// All zero.
    pub fn new(dims: [usize; 3]) -> Counters {
        let across = bricks_of(dims);
        let layer: Layer = Arc::new(vec![None; across[0] * across[1]]);
        Counters { layers: Arc::new(vec![layer; across[2]]), across, windows: false }
    }

    /// Adds one to every cell of `voxels`; `target` gives the wanted cells.
    pub fn add(&mut self, voxels: &Voxels, target: &[Plane]) -> Change {
        let (layers, size) = (Arc::make_mut(&mut self.layers), self.across[0] * self.across[1]);
        let windows = self.windows;
        let mut change = Change::default();
        visit(&voxels.cells, self.across, |index, column, words| {
            let place = &mut Arc::make_mut(&mut layers[index / size])[index % size];
            let is_new = place.is_none();
            let cells = Arc::make_mut(place.get_or_insert_with(Arc::default));
            if is_new && windows {
                cells.sums = Some(Box::default());
            }
            let (brick, sums) = (&mut cells.counts, &mut cells.sums);
            for (word, y, z) in words {
                let cells = voxels.word(column, y, z);
                let new = brick.raise(word, cells);
                change.filled += i64::from(new.count_ones());
                change.inside += i64::from((new & target[index][word]).count_ones());
                if let Some(sums) = sums {
                    sums.add(word, split(new, target[index][word]));
                }
            }
            if is_new && brick.is_empty() {
                *place = None;
            } else if let Some(sums) = sums {
                sums.settle();
            }
        });
        change
    }

    /// Subtracts one from every cell of `voxels`, all of which must have one.
    pub fn remove(&mut self, voxels: &Voxels, target: &[Plane]) -> Change {
        let (layers, size) = (Arc::make_mut(&mut self.layers), self.across[0] * self.across[1]);
        let mut change = Change::default();
        visit(&voxels.cells, self.across, |index, column, words| {
            let place = &mut Arc::make_mut(&mut layers[index / size])[index % size];
            let Some(cells) = place else { return };
            let cells = Arc::make_mut(cells);
            let (brick, sums) = (&mut cells.counts, &mut cells.sums);
            for (word, y, z) in words {
                let cells = voxels.word(column, y, z);
                let gone = brick.lower(word, cells);
                change.filled -= i64::from(gone.count_ones());
                change.inside -= i64::from((gone & target[index][word]).count_ones());
                if let Some(sums) = sums {
                    sums.remove(word, split(gone, target[index][word]));
                }
            }
            if brick.trim() {
                *place = None;
            } else if let Some(sums) = sums {
                sums.settle();
            }
        });
        change
    }

    /// True once bricks keep what windows need.
    pub(crate) fn expects_windows(&self) -> bool {
        self.windows
    }

    /// From now on bricks keep what windows need.
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

/// The bricks that `cells` touch: index of the brick, its place along x, and its words with their rows (y, z).
#[inline]
pub(super) fn bricks_at(cells: &CellBox, across: [usize; 3]) -> impl Iterator<Item = (usize, usize, Words)> {
    let CellBox { low, high } = *cells;
    let range = move |a: usize| low[a] / BRICK[a]..=high[a] / BRICK[a];
    let within =
        move |a: usize, b: usize| (low[a].max(b * BRICK[a]), high[a].min(b * BRICK[a] + BRICK[a] - 1));
    let rows = range(2).flat_map(move |bz| range(1).map(move |by| (by, bz)));
    rows.flat_map(move |(by, bz)| {
        let (y, z) = (within(1, by), within(2, bz));
        range(0).map(move |bx| {
            let words = Words { first_y: y.0, last_y: y.1, y: y.0, z: z.0, last_z: z.1 };
            ((bz * across[1] + by) * across[0] + bx, bx, words)
        })
    })
}

/// Visits the bricks that `cells` touch, as [`bricks_at`] has them.
pub(super) fn visit(cells: &CellBox, across: [usize; 3], mut f: impl FnMut(usize, usize, Words)) {
    bricks_at(cells, across).for_each(|(index, column, words)| f(index, column, words));
}

pub(super) struct Words {
    first_y: usize,
    last_y: usize,
    last_z: usize,
    y: usize,
    z: usize,
}

impl Iterator for Words {
    type Item = (usize, usize, usize);
    #[inline]
    fn next(&mut self) -> Option<(usize, usize, usize)> {
        if self.z > self.last_z {
            return None;
        }
        let row = (self.z % 8 * 8 + self.y % 8, self.y, self.z);
        if self.y == self.last_y {
            (self.y, self.z) = (self.first_y, self.z + 1);
        } else {
            self.y += 1;
        }
        Some(row)
    }
}

/// The cells of `voxels` as planes, brick by brick.
pub fn planes_of(voxels: &Voxels, dims: [usize; 3]) -> Vec<Plane> {
    let across = bricks_of(dims);
    let mut planes = vec![[0; 64]; across.iter().product()];
    visit(&voxels.cells, across, |index, column, words| {
        for (word, y, z) in words {
            planes[index][word] = voxels.word(column, y, z);
        }
    });
    planes
}
