//! Filling a surface: inside the box of touched cells, empty regions that do not reach its outer layer are filled.
//!
//! Regions are 6-connected. What is outside spreads from the outer layer, 64 cells at a time, in sweeps up and down
//! the rows until nothing changes.

use super::grid::Grid;
use super::surface::{Bits, in_grid, mark};
use crate::mesh::TriMesh;

/// Above this many cells a mesh is cut to the domain before it is filled.
const MOST_CELLS: f64 = 16_777_216.0;

/// Cells that a closed mesh fills. Cells outside of the grid may be among them; `None` when all are outside.
///
/// A mesh that is far larger than the domain is cut to the domain and one layer around it; a region that reaches
/// the cut is then empty, and an error of no consequence for meshes anyone has shown us: parts cut there are open.
pub fn solid(mesh: &TriMesh, grid: &Grid) -> Option<Bits> {
    let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
    for corners in mesh.corners() {
        let (_, first, last) = in_grid(corners, grid);
        for a in 0..3 {
            low[a] = low[a].min(first[a]);
            high[a] = high[a].max(last[a]);
        }
    }
    if (0..3).any(|a| high[a] < 0 || low[a] >= grid.dims()[a] as i64) {
        return None;
    }
    let cells: f64 = (0..3).map(|a| (high[a] - low[a] + 1) as f64).product();
    if cells > MOST_CELLS {
        for a in 0..3 {
            low[a] = low[a].max(-1);
            high[a] = high[a].min(grid.dims()[a] as i64);
        }
    }
    let mut bits = Bits::empty(low, high);
    mark(mesh, grid, &mut bits);
    fill(&mut bits, low[0], high[0]);
    Some(bits)
}

/// Fills what the set encloses; x of its box runs from `first` to `last`.
fn fill(bits: &mut Bits, first: i64, last: i64) {
    let [ny, nz] = bits.rows();
    let columns = bits.columns();
    let base = bits.low()[0];
    // Cells of the box in each word, and those in its outer layer along x.
    let mut inside = vec![0u64; columns];
    let mut ends = vec![0u64; columns];
    for x in first..=last {
        let at = (x - base) as usize;
        inside[at / 64] |= 1 << (at % 64);
        if x == first || x == last {
            ends[at / 64] |= 1 << (at % 64);
        }
    }
    let at = |y: usize, z: usize, c: usize| (z * ny + y) * columns + c;
    let free: Vec<u64> = bits.words.iter().enumerate().map(|(i, w)| inside[i % columns] & !w).collect();
    let mut outside = vec![0u64; free.len()];
    for z in 0..nz {
        for y in 0..ny {
            let edge = y == 0 || z == 0 || y + 1 == ny || z + 1 == nz;
            for (c, end) in ends.iter().enumerate() {
                let i = at(y, z, c);
                outside[i] = if edge { free[i] } else { free[i] & end };
            }
        }
    }
    let rows = ny * nz;
    let mut changed = true;
    while changed {
        changed = false;
        for step in 0..2 * rows {
            // Down the rows, then up again: most regions settle in one or two rounds.
            let row = if step < rows { step } else { 2 * rows - 1 - step };
            let (y, z) = (row % ny, row / ny);
            for step in 0..2 * columns {
                let c = if step < columns { step } else { 2 * columns - 1 - step };
                let i = at(y, z, c);
                let mut seen = outside[i];
                let mut take = |there: bool, j: usize| seen |= if there { outside[j] } else { 0 };
                take(y > 0, i.wrapping_sub(columns));
                take(y + 1 < ny, i + columns);
                take(z > 0, i.wrapping_sub(ny * columns));
                take(z + 1 < nz, i + ny * columns);
                if c > 0 {
                    seen |= outside[i - 1] >> 63;
                }
                if c + 1 < columns {
                    seen |= outside[i + 1] << 63;
                }
                let spread = spread(seen & free[i], free[i]);
                changed |= spread != outside[i];
                outside[i] = spread;
            }
        }
    }
    for (i, word) in bits.words.iter_mut().enumerate() {
        *word |= inside[i % columns] & free[i] & !outside[i];
    }
}

/// Spreads set bits to both sides through the runs of `free`, in six doublings.
fn spread(seen: u64, free: u64) -> u64 {
    let (mut up, mut way) = (seen, free);
    let (mut down, mut back) = (seen, free);
    for shift in [1, 2, 4, 8, 16, 32] {
        up |= way & (up << shift);
        way &= way << shift;
        down |= back & (down >> shift);
        back &= back >> shift;
    }
    up | down
}

#[cfg(test)]
mod tests {
    //! Spreading stops at walls.
    use super::spread;

    #[test]
    fn bits_spread_through_free_runs_only() {
        assert_eq!(spread(0b0000_0100, 0b1101_1110), 0b0001_1110);
        assert_eq!(spread(1, u64::MAX), u64::MAX);
        assert_eq!(spread(1 << 63, u64::MAX << 7), u64::MAX << 7);
    }
}
