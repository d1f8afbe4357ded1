//! Solid windows: shares of boxes of cells, read between boxes.
//!
//! The box of a point has 1, 2, 4, 8 or 16 cells along each side, the number nearest to the size in the form.
//! Boxes lie side by side from the grid's first corner, and a point between the middles of eight shows their shares by
//! trilinear interpolation. Boxes of 1 and 2 are counted in the bits. Each brick keeps [`Sums`] for
//! boxes of 4 and 8. A box of 16 is the sum of boxes of 8.

use super::{Place, WindowForm};
use crate::bricks::layout::bricks_of;
use crate::bricks::sums::{Sums, domain};
use crate::bricks::{Counters, Target};
use crate::vector::Vec3;

/// The number of doublings of the largest box.
const LARGEST: u32 = 4;
/// A target and the cells that a scene fills, with sums.
pub(crate) struct Volume<'a> {
    target: &'a Target,
    filled: &'a Counters,
    /// Sums of the target, brick by brick.
    sums: &'a [Sums],
    dims: [usize; 3],
    across: [usize; 3],
}

impl<'a> Volume<'a> {
    pub fn new(target: &'a Target, filled: &'a Counters) -> Volume<'a> {
        let dims = target.grid().dims();
        Volume { target, filled, sums: target.sums(), dims, across: bricks_of(dims) }
    }

    /// Appends both channels of every point.
    pub fn look(&self, form: &WindowForm, place: &Place, out: &mut Vec<f32>) {
        let (grid, left) = (self.target.grid(), place.left());
        let cell = grid.cell();
        let cell = (cell.x + cell.y + cell.z) / 3.0;
        out.reserve(form.values());
        for point in &form.points {
            let [ahead, aside, above] = point.at.map(|length| length * place.scale);
            let at = place.position + place.forward * ahead + left * aside + place.up * above;
            let (mut level, mut border) = (0, cell * std::f64::consts::SQRT_2);
            while level < LARGEST && point.cell * place.scale > border {
                (level, border) = (level + 1, 2.0 * border);
            }
            out.extend(self.shares(grid.to_grid(at), level).map(|share| share as f32));
        }
    }

    /// Both channels at a point, in grid coordinates, of boxes of `2^level` cells.
    fn shares(&self, at: Vec3, level: u32) -> [f64; 2] {
        let side = f64::from(1 << level);
        let per_side = 1.0 / side;
        let mut first = [0; 3];
        let (mut weights, mut inside) = ([[0.0; 2]; 3], 1.0);
        for a in 0..3 {
            let most = self.dims[a] as f64;
            // The unit is a box, from the middle of the first box on; farther out everything is outside.
            let x = (at[a] * per_side - 0.5).clamp(-2.0, most + 1.0);
            first[a] = (x + 2.0) as i32 - 2;
            let floor = f64::from(first[a]);
            weights[a] = [1.0 - (x - floor), x - floor];
            let within = |k: f64| ((k + 1.0) * side).clamp(0.0, most) - (k * side).clamp(0.0, most);
            inside *= weights[a][0] * within(floor) + weights[a][1] * within(floor + 1.0);
        }
        if inside == 0.0 {
            return [0.0, 2.0];
        }
        let mut sums = [0.0; 2];
        for (z, of_z) in weights[2].into_iter().enumerate() {
            for (y, of_y) in weights[1].into_iter().enumerate() {
                let (y, z) = (first[1] + y as i32, first[2] + z as i32);
                let pair = self.pair(level, [first[0], y, z]);
                for (channel, sum) in sums.iter_mut().enumerate() {
                    let along = weights[0][0] * f64::from(pair[0][channel])
                        + weights[0][1] * f64::from(pair[1][channel]);
                    *sum += of_y * of_z * along;
                }
            }
        }
        let share = per_side * per_side * per_side;
        [sums[0] * share, sums[1] * share + 2.0 * (1.0 - inside * share)]
    }

    /// Uncovered cells of a box and of its neighbour along x.
    #[inline]
    fn pair(&self, level: u32, [x, y, z]: [i32; 3]) -> [[i32; 2]; 2] {
        match level {
            0 => {
                let bits = self.bits([x, y, z]);
                [0, 1].map(|k| bits.map(|bits| (bits >> k & 1) as i32))
            }
            1 => {
                let mut pair = [[0; 2]; 2];
                for (dy, dz) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let bits = self.bits([2 * x, 2 * y + dy, 2 * z + dz]);
                    for (k, counts) in pair.iter_mut().enumerate() {
                        for (count, bits) in counts.iter_mut().zip(bits) {
                            *count += ((bits >> (2 * k) & 1) + (bits >> (2 * k + 1) & 1)) as i32;
                        }
                    }
                }
                pair
            }
            2 => {
                let inner = [(y & 1) as usize, (z & 1) as usize];
                self.boxes([x, y >> 1, z >> 1], 4, |sums, x| sums.four([x, inner[0], inner[1]]))
            }
            3 => self.boxes([x, y, z], 3, Sums::eight),
            _ => {
                let mut pair = [[0; 2]; 2];
                for (dy, dz) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let halves = self.boxes([x, 2 * y + dy, 2 * z + dz], 2, Sums::sixteen);
                    for k in 0..2 {
                        pair[k] = [pair[k][0] + halves[k][0], pair[k][1] + halves[k][1]];
                    }
                }
                pair
            }
        }
    }

    /// The target less the scene in the boxes `x` and `x + 1` of a row of bricks, each of `2^shift` boxes; zero outside.
    #[inline(always)]
    fn boxes(&self, [x, y, z]: [i32; 3], shift: u32, of: impl Fn(&Sums, usize) -> [i32; 2]) -> [[i32; 2]; 2] {
        let first = self.sums([x >> shift, y, z]);
        let second = if (x + 1) & !(-1 << shift) == 0 { self.sums([(x + 1) >> shift, y, z]) } else { first };
        let uncovered = |sums: Option<(&Sums, Option<&Sums>)>, x: i32| {
            let Some((target, filled)) = sums else { return [0; 2] };
            let x = (x & !(-1 << shift)) as usize;
            let ([target, empty], [right, wrong]) =
                (of(target, x), filled.map_or([0; 2], |sums| of(sums, x)));
            [target - right, empty - wrong]
        };
        [uncovered(first, x), uncovered(second, x + 1)]
    }

    /// The sums of a brick: of the target, and of the scene unless it is empty there.
    #[inline(always)]
    fn sums(&self, brick: [i32; 3]) -> Option<(&Sums, Option<&Sums>)> {
        let place = self.brick(brick)?;
        let filled = self.filled.brick(place).and_then(|brick| brick.sums.as_deref());
        Some((&self.sums[place[1] * self.across[0] * self.across[1] + place[0]], filled))
    }

    /// The place of a brick in its layer, and its layer.
    #[inline]
    fn brick(&self, brick: [i32; 3]) -> Option<[usize; 2]> {
        let within = (0..3).all(|a| (brick[a] as u32 as usize) < self.across[a]);
        let [x, y, z] = brick.map(|b| b as usize);
        within.then(|| [y * self.across[0] + x, z])
    }

    /// Uncovered cells of both channels along x, from the lowest bit on: at least four.
    #[inline]
    fn bits(&self, [x, y, z]: [i32; 3]) -> [u64; 2] {
        let (column, shift) = (x >> 6, x & 63);
        let [a, b] = self.words(column, y, z).map(|word| word >> shift);
        if shift <= 60 {
            return [a, b];
        }
        let [c, d] = self.words(column + 1, y, z).map(|word| word << (64 - shift));
        [a | c, b | d]
    }

    /// Uncovered cells `64 * column ..` of a row.
    #[inline]
    fn words(&self, column: i32, y: i32, z: i32) -> [u64; 2] {
        let within = (y as u32 as usize) < self.dims[1] && (z as u32 as usize) < self.dims[2];
        let Some(place) = self.brick([column, y >> 3, z >> 3]).filter(|_| within) else { return [0; 2] };
        let word = ((z & 7) * 8 + (y & 7)) as usize;
        let target = self.target.plane(place)[word];
        let any = self.filled.brick(place).map_or(0, |brick| brick.counts.any(word));
        [target & !any, self.domain(column as usize) & !target & !any]
    }

    /// Bits of a column of words that are cells of the grid.
    #[inline]
    fn domain(&self, column: usize) -> u64 {
        domain(self.dims, column)
    }
}
