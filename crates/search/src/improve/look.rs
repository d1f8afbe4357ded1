//! The look of a scene: the cells of a coarse grid that it fills. Two scenes look alike by the share of cells that they have in
//! common (Jaccard 1912).

use niwaki_geom::{Aabb, Grid, Shape, Voxels};
use niwaki_run::replay::Part;

/// Cells along the longest side of the scenes for which a grid is made.
const CELLS: f64 = 28.0;
/// The room around these scenes, in their longest sides.
const ROOM: f64 = 0.1;

/// Cells of a grid, as bits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Cells(Vec<u64>);

impl Cells {
    /// A set of these cells.
    #[cfg(test)]
    pub fn of(numbers: &[u32]) -> Cells {
        let mut words = vec![0; 4];
        numbers.iter().for_each(|cell| words[*cell as usize / 64] |= 1 << (cell % 64));
        Cells(words)
    }

    /// The number of cells.
    pub fn count(&self) -> u32 {
        self.0.iter().map(|word| word.count_ones()).sum()
    }

    /// Adds the cells of another set.
    pub fn add(&mut self, other: &Cells) {
        self.0.resize(self.0.len().max(other.0.len()), 0);
        self.0.iter_mut().zip(&other.0).for_each(|(word, more)| *word |= more);
    }

    /// The share of the cells of either set that both have; 1 for two empty sets.
    pub fn in_common(&self, other: &Cells) -> f64 {
        let words = self.0.len().max(other.0.len());
        let word = |cells: &Cells, at: usize| cells.0.get(at).copied().unwrap_or(0);
        let (mut both, mut either) = (0, 0);
        for at in 0..words {
            let (a, b) = (word(self, at), word(other, at));
            both += (a & b).count_ones();
            either += (a | b).count_ones();
        }
        if either == 0 { 1.0 } else { f64::from(both) / f64::from(either) }
    }
}

/// The smallest box around the scenes of runs.
pub(super) fn bounds<'a>(parts: impl Iterator<Item = &'a Part>) -> Aabb {
    parts.flat_map(|part| &part.shapes).fold(Aabb::EMPTY, |bounds, shape| bounds.union(shape.aabb()))
}

/// The grid for scenes within about these bounds; `None` where there is no scene.
pub(super) fn grid(bounds: &Aabb) -> Option<Grid> {
    let longest = bounds.extent().to_array().into_iter().fold(f64::NEG_INFINITY, f64::max);
    if !(longest > 0.0 && longest.is_finite()) {
        return None;
    }
    // A grid leaves a margin of its own, which is small beside most scenes.
    let whole = longest * (1.0 + 2.0 * ROOM) + 2.0 * niwaki_geom::voxel::grid::PAD;
    Grid::around(&bounds.grown(longest * ROOM), whole / CELLS).ok()
}

/// The cells that shapes fill.
pub(super) fn cells(shapes: &[Shape], grid: &Grid) -> Cells {
    let [nx, ny, _] = grid.dims();
    let mut bits = vec![0; grid.len().div_ceil(64)];
    for voxels in shapes.iter().filter_map(|shape| Voxels::of(shape, grid)) {
        let (low, high) = (voxels.cells.low, voxels.cells.high);
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    if voxels.contains([x, y, z]) {
                        let cell = (z * ny + y) * nx + x;
                        bits[cell / 64] |= 1 << (cell % 64);
                    }
                }
            }
        }
    }
    Cells(bits)
}

/// The cells that parts fill together.
pub(super) fn cells_of(parts: &[Part], grid: &Grid) -> Cells {
    let mut all = Cells::default();
    parts.iter().for_each(|part| all.add(&cells(&part.shapes, grid)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_in_common_are_counted_once() {
        let (a, b) = (Cells(vec![0b1110, 1]), Cells(vec![0b0111]));
        assert_eq!(a.in_common(&b), 2.0 / 5.0);
        assert_eq!(b.in_common(&a), 2.0 / 5.0);
        assert_eq!((a.count(), b.count()), (4, 3));
        assert_eq!(Cells::default().in_common(&Cells::default()), 1.0);
        assert_eq!(Cells::default().in_common(&b), 0.0);
        let mut both = b.clone();
        both.add(&a);
        assert_eq!(both.count(), 5);
    }
}
