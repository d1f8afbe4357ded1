//! Sums of the cells of a brick over boxes of 4 and of 8, for windows.

use super::brick::Plane;
use super::layout::bricks_of;

/// A mask of every second byte of a word.
const BYTES: u64 = 0x00ff_00ff_00ff_00ff;

/// Counts of the set bits of a brick in each box of 4 and of 8 cells, in two channels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    /// Counts of boxes of 4, by channel, by quarter of the brick (y / 4 + 2 (z / 4)), and by parity of the box along x: byte
    /// `k` counts box `2 k + parity`, 64 at most.
    fours: [[[u64; 2]; 4]; 2],
    /// Counts of boxes of 8, by channel and box along x.
    eights: [[u16; 8]; 2],
}

impl Sums {
    /// The sums of the 64 words of a brick.
    pub fn of(words: impl Fn(usize) -> [u64; 2]) -> Sums {
        let mut sums = Sums::default();
        (0..64).for_each(|word| sums.add(word, words(word)));
        sums.settle();
        sums
    }

    /// Adds bits of a word; [`Sums::settle`] follows when all words are added.
    #[inline]
    pub fn add(&mut self, word: usize, bits: [u64; 2]) {
        self.change(word, bits, |sum, n| *sum += n);
    }

    /// Subtracts bits of a word; [`Sums::settle`] follows.
    #[inline]
    pub fn remove(&mut self, word: usize, bits: [u64; 2]) {
        self.change(word, bits, |sum, n| *sum -= n);
    }

    #[inline]
    fn change(&mut self, word: usize, bits: [u64; 2], by: impl Fn(&mut u64, u64)) {
        let quarter = word % 8 / 4 + word / 32 * 2;
        for (sums, bits) in self.fours.iter_mut().zip(bits) {
            // Number of bits in each four.
            let twos = bits - (bits >> 1 & 0x5555_5555_5555_5555);
            let fours = (twos & 0x3333_3333_3333_3333) + (twos >> 2 & 0x3333_3333_3333_3333);
            by(&mut sums[quarter][0], fours & 0x0f0f_0f0f_0f0f_0f0f);
            by(&mut sums[quarter][1], fours >> 4 & 0x0f0f_0f0f_0f0f_0f0f);
        }
    }

    /// Updates the boxes of 8 from the boxes of 4.
    #[inline]
    pub fn settle(&mut self) {
        for (fours, eights) in self.fours.iter().zip(&mut self.eights) {
            let all = || fours.iter().flatten();
            let even: u64 = all().map(|word| word & BYTES).sum();
            let odd: u64 = all().map(|word| word >> 8 & BYTES).sum();
            for k in 0..4 {
                eights[2 * k] = (even >> (16 * k)) as u16;
                eights[2 * k + 1] = (odd >> (16 * k)) as u16;
            }
        }
    }

    /// The counts of a box of 4 cells.
    #[inline]
    pub fn four(&self, [x, y, z]: [usize; 3]) -> [i32; 2] {
        self.fours.each_ref().map(|fours| (fours[y + 2 * z][x % 2] >> (x / 2 * 8) & 0xff) as i32)
    }

    /// The counts of a box of 8 cells.
    #[inline]
    pub fn eight(&self, x: usize) -> [i32; 2] {
        self.eights.each_ref().map(|eights| i32::from(eights[x & 7]))
    }

    /// The counts of the part of a box of 16 cells in this brick.
    #[inline]
    pub fn sixteen(&self, x: usize) -> [i32; 2] {
        let ([a, b], [c, d]) = (self.eight(2 * x), self.eight(2 * x + 1));
        [a + c, b + d]
    }
}

/// Bits of a column of words that are cells of the grid.
#[inline]
pub(crate) fn domain(dims: [usize; 3], column: usize) -> u64 {
    u64::MAX >> (64 - (dims[0] - 64 * column).min(64))
}

/// Sums of the filled and the empty cells of a target, brick by brick.
pub(crate) fn sums_of(planes: &[Plane], dims: [usize; 3]) -> Vec<Sums> {
    let across = bricks_of(dims);
    let of = |(index, plane): (usize, &Plane)| {
        let (column, y, z) =
            (index % across[0], index / across[0] % across[1] * 8, index / (across[0] * across[1]) * 8);
        Sums::of(|word| {
            let within = y + word % 8 < dims[1] && z + word / 8 < dims[2];
            let domain = if within { domain(dims, column) } else { 0 };
            [plane[word], domain & !plane[word]]
        })
    };
    planes.iter().enumerate().map(of).collect()
}
