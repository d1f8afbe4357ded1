//! A small block of counts, bit-sliced: plane `k` holds bit `k` of every count, one bit of 64 words for each cell.
//!
//! Adding a set of cells is a ripple carry, removing a set a ripple borrow, 64 cells for each word operation:
//!
//! ```text
//! carry = cells;   plane, carry = plane ^ carry, plane & carry      (then the next plane)
//! borrow = cells;  plane, borrow = plane ^ borrow, !plane & borrow
//! ```
//!
//! Planes exist only while a count needs them, so that equal counts are equal data.

/// One bit for each cell of a brick.
pub type Plane = [u64; 64];

/// Counts of 64 words of cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Brick {
    /// The lowest plane, which always exists: most counts are 0 or 1.
    lowest: Plane,
    higher: Vec<Plane>,
}

impl Default for Brick {
    fn default() -> Brick {
        Brick { lowest: [0; 64], higher: Vec::new() }
    }
}

/// The rows of a brick at one z.
pub type Slab = [u64; 8];

/// `f` of two planes, word by word.
#[inline]
fn each<const N: usize>(a: &[u64; N], b: &[u64; N], f: impl Fn(u64, u64) -> u64) -> [u64; N] {
    std::array::from_fn(|k| f(a[k], b[k]))
}

/// True when a bit is set.
#[inline]
pub fn any<const N: usize>(words: &[u64; N]) -> bool {
    words.iter().fold(0, |all, word| all | word) != 0
}

impl Brick {
    /// Adds one to the counts of `cells`, words from `N * at` on; returns the cells whose count was 0.
    #[inline]
    pub fn raise<const N: usize>(&mut self, at: usize, cells: &[u64; N]) -> [u64; N] {
        let lowest = part(&mut self.lowest, at);
        let (new, carry) = (each(cells, lowest, |c, old| c & !old), each(cells, lowest, |c, old| c & old));
        *lowest = each(cells, lowest, |c, old| c ^ old);
        // Most calls end here: no count is above 1.
        if self.higher.is_empty() && !any(&carry) {
            return new;
        }
        self.carry(at, carry, new)
    }

    /// Adds `carry` to the planes above the lowest; returns the cells of `new` that these planes lack.
    fn carry<const N: usize>(&mut self, at: usize, mut carry: [u64; N], mut new: [u64; N]) -> [u64; N] {
        for plane in &mut self.higher {
            let words = part(plane, at);
            new = each(&new, words, |n, old| n & !old);
            (*words, carry) = (each(&carry, words, |c, old| c ^ old), each(&carry, words, |c, old| c & old));
        }
        if any(&carry) {
            let mut top = [0; 64];
            *part(&mut top, at) = carry;
            self.higher.push(top);
        }
        new
    }

    /// Subtracts one from the counts of `cells`, words from `N * at` on, which must be above 0; returns the cells whose count
    /// is 0 now.
    #[inline]
    pub fn lower<const N: usize>(&mut self, at: usize, cells: &[u64; N]) -> [u64; N] {
        let (mut borrow, mut emptied) = (*cells, *cells);
        for plane in std::iter::once(&mut self.lowest).chain(&mut self.higher) {
            let words = part(plane, at);
            let old = *words;
            *words = each(&borrow, &old, |b, old| b ^ old);
            borrow = each(&borrow, &old, |b, old| b & !old);
            emptied = each(&emptied, words, |g, after| g & !after);
        }
        debug_assert!(!any(&borrow), "a cell was emptied that nothing filled");
        emptied
    }

    /// Drops empty planes; true when no count remains.
    #[inline]
    pub fn trim(&mut self) -> bool {
        while self.higher.last().is_some_and(|top| !any(top)) {
            self.higher.pop();
        }
        self.is_empty()
    }

    /// True when every count is 0.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.higher.is_empty() && !any(&self.lowest)
    }

    fn planes(&self) -> impl Iterator<Item = &Plane> {
        std::iter::once(&self.lowest).chain(&self.higher)
    }

    /// Cells of a word whose count is above 0.
    #[inline]
    pub fn any(&self, word: usize) -> u64 {
        self.higher.iter().fold(self.lowest[word], |all, plane| all | plane[word])
    }

    /// Count of one cell.
    pub fn get(&self, word: usize, bit: usize) -> u32 {
        self.planes().enumerate().map(|(k, plane)| ((plane[word] >> bit & 1) as u32) << k).sum()
    }
}

/// Words of a plane from `N * at` on.
#[inline]
fn part<const N: usize>(plane: &mut Plane, at: usize) -> &mut [u64; N] {
    &mut plane.as_chunks_mut().0[at]
}
