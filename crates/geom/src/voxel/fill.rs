//! The fill of a surface: inside the box of touched cells, empty regions that do not reach its outer layer are filled.
//!
//! Regions are 6-connected. The outside spreads from the outer layer, 64 cells at a time, in sweeps up and down
//! the rows until nothing changes.

use super::grid::Grid;
use super::surface::{Bits, in_grid, mark};
use crate::intersect::inside::{inside_part, parts};
use crate::mesh::TriMesh;
use crate::vector::Vec3;

/// The number of cells above which a mesh is cut to the domain before the fill.
const MOST_CELLS: f64 = 16_777_216.0;

/// Cells that a closed mesh fills. Cells outside of the grid may be among them; `None` when all are outside.
///
/// A cavity is filled: every cell that the outside does not reach is inside, whichever way its surface faces. The outside
/// reaches through holes that are wider than a cell.
///
/// A mesh that is far larger than the domain is cut to the domain and one layer around it. Regions that reach
/// the cut are inside when the mesh or one of its parts winds around them.
pub fn solid(mesh: &TriMesh, grid: &Grid) -> Option<Bits> {
    solid_up_to(MOST_CELLS, mesh, grid)
}

fn solid_up_to(most_cells: f64, mesh: &TriMesh, grid: &Grid) -> Option<Bits> {
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
    let cells: f64 = (0..3).map(|a| high[a] as f64 - low[a] as f64 + 1.0).product();
    let whole = (low, high);
    if cells > most_cells {
        for a in 0..3 {
            low[a] = low[a].max(-1);
            high[a] = high[a].min(grid.dims()[a] as i64);
        }
    }
    let cut = (low, high) != whole;
    let mut bits = Bits::empty(low, high);
    mark(mesh, grid, &mut bits);
    let region = Region::new(&bits, low[0], high[0]);
    let mut outside = region.layer.clone();
    if cut {
        outside.fill(0);
        let mut inside = outside.clone();
        let parts = parts(mesh);
        // Free cells next to each other have no surface between their middles: one test is enough for a whole region.
        while let Some((word, bit)) = region.first_of_layer_beyond(&outside, &inside) {
            let middle = region.cell(&bits, word, bit).map(|i| i as f64 + 0.5);
            let side = if inside_part(mesh, &parts, grid.to_world(Vec3::from(middle))) {
                &mut inside
            } else {
                &mut outside
            };
            side[word] |= 1 << bit;
            region.flood(side);
        }
    } else {
        region.flood(&mut outside);
    }
    for (word, (free, outside)) in bits.words.iter_mut().zip(region.free.iter().zip(outside)) {
        *word |= free & !outside;
    }
    Some(bits)
}

/// The cells of a box that no surface touches, and the cells of its outer layer among them.
struct Region {
    free: Vec<u64>,
    layer: Vec<u64>,
    /// Words along x, rows along y and along z.
    dims: [usize; 3],
}

impl Region {
    /// The region of the box of `bits`, whose x runs from `first` to `last` (its words may reach farther).
    fn new(bits: &Bits, first: i64, last: i64) -> Region {
        let ([ny, nz], columns) = (bits.rows(), bits.columns());
        let mut within = vec![0u64; columns];
        let mut ends = vec![0u64; columns];
        for x in first..=last {
            let at = (x - bits.low()[0]) as usize;
            within[at / 64] |= 1 << (at % 64);
            if x == first || x == last {
                ends[at / 64] |= 1 << (at % 64);
            }
        }
        let free: Vec<u64> = bits.words.iter().enumerate().map(|(i, w)| within[i % columns] & !w).collect();
        let in_layer = |(i, free): (usize, &u64)| {
            let (y, z) = (i / columns % ny, i / columns / ny);
            let edge = y == 0 || z == 0 || y + 1 == ny || z + 1 == nz;
            if edge { *free } else { free & ends[i % columns] }
        };
        let layer = free.iter().enumerate().map(in_layer).collect();
        Region { free, layer, dims: [columns, ny, nz] }
    }

    /// A cell of the layer in neither set.
    fn first_of_layer_beyond(&self, inside: &[u64], outside: &[u64]) -> Option<(usize, u32)> {
        let rest = |i: usize| self.layer[i] & !inside[i] & !outside[i];
        (0..self.layer.len()).find(|i| rest(*i) != 0).map(|i| (i, rest(i).trailing_zeros()))
    }

    fn cell(&self, bits: &Bits, word: usize, bit: u32) -> [i64; 3] {
        let [columns, ny, _] = self.dims;
        let [x, y, z] = bits.low();
        let row = word / columns;
        [x + (word % columns * 64) as i64 + i64::from(bit), y + (row % ny) as i64, z + (row / ny) as i64]
    }

    /// Spreads `reached` through free cells, 6-connected.
    fn flood(&self, reached: &mut [u64]) {
        let [columns, ny, nz] = self.dims;
        let rows = ny * nz;
        let mut changed = true;
        while changed {
            changed = false;
            for step in 0..2 * rows {
                // Up the rows, then down again: most regions settle in one or two rounds.
                let row = if step < rows { step } else { 2 * rows - 1 - step };
                let (y, z) = (row % ny, row / ny);
                for step in 0..2 * columns {
                    let c = if step < columns { step } else { 2 * columns - 1 - step };
                    let i = row * columns + c;
                    if reached[i] == self.free[i] {
                        continue;
                    }
                    let mut near = reached[i];
                    let mut take = |is_inside: bool, j: usize| near |= if is_inside { reached[j] } else { 0 };
                    take(y > 0, i.wrapping_sub(columns));
                    take(y + 1 < ny, i + columns);
                    take(z > 0, i.wrapping_sub(ny * columns));
                    take(z + 1 < nz, i + ny * columns);
                    near |= if c > 0 { reached[i - 1] >> 63 } else { 0 };
                    near |= if c + 1 < columns { reached[i + 1] << 63 } else { 0 };
                    let all = spread(near & self.free[i], self.free[i]);
                    changed |= all != reached[i];
                    reached[i] = all;
                }
            }
        }
    }
}

/// Spreads set bits to both sides through the runs of `free`, in six doublings.
fn spread(reached: u64, free: u64) -> u64 {
    let (mut up, mut free_run) = (reached, free);
    let (mut down, mut back) = (reached, free);
    for shift in [1, 2, 4, 8, 16, 32] {
        up |= free_run & (up << shift);
        free_run &= free_run << shift;
        down |= back & (down >> shift);
        back &= back >> shift;
    }
    up | down
}

#[cfg(test)]
mod tests {
    //! Spreading stops at walls, and a mesh cut to the domain fills the same cells.
    use super::{solid_up_to, spread};
    use crate::{Grid, Look, Mat3, Shape, vec3};

    #[test]
    fn bits_spread_through_free_runs_only() {
        assert_eq!(spread(0b0000_0100, 0b1101_1110), 0b0001_1110);
        assert_eq!(spread(1, u64::MAX), u64::MAX);
        assert_eq!(spread(1 << 63, u64::MAX << 7), u64::MAX << 7);
    }

    #[test]
    fn a_mesh_cut_to_the_domain_fills_the_same_cells() {
        let cube = |size: f64, angle: f64| {
            let look = Look { rotation: Some(Mat3::rotation(vec3(0.6, 0.0, 0.8), angle)), ..Look::default() };
            Shape::cuboid(vec3(0.3, 0.2, 0.1), vec3(size, size, size), &look).unwrap()
        };
        let grid = Grid::around(cube(1.0, 0.0).aabb(), 0.1).unwrap();
        for (size, angle) in [(9.0, 0.3), (2.0, 0.8), (1.3, 0.5), (0.6, 1.0)] {
            let mesh = cube(size, angle);
            let [cut, whole] = [0.0, 1e9].map(|most| solid_up_to(most, &mesh.world_mesh(), &grid).unwrap());
            let [nx, ny, nz] = grid.dims().map(|n| n as i64);
            let cells = (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]);
            let filled = cells.filter(|[x, y, z]| {
                assert_eq!(cut.get(*x, *y, *z), whole.get(*x, *y, *z), "{size}");
                cut.get(*x, *y, *z)
            });
            assert!(filled.count() > 100);
        }
    }
}
