//! A small block of counts, bit-sliced: plane `k` holds bit `k` of every count, one bit of 64 words for each cell.
//!
//! Adding a set of cells is a ripple carry, removing one a ripple borrow, 64 cells for each word operation:
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
    /// Most cells have one count or none: the lowest plane is always there.
    lowest: Plane,
    higher: Vec<Plane>,
}

impl Default for Brick {
    fn default() -> Brick {
        Brick { lowest: [0; 64], higher: Vec::new() }
    }
}

impl Brick {
    /// Adds one to `cells` of a word; returns those that had none.
    #[inline]
    pub fn raise(&mut self, word: usize, cells: u64) -> u64 {
        let mut before = self.lowest[word];
        let mut carry = cells & before;
        self.lowest[word] ^= cells;
        for plane in &mut self.higher {
            let old = plane[word];
            before |= old;
            plane[word] = old ^ carry;
            carry &= old;
        }
        if carry != 0 {
            let mut top = [0; 64];
            top[word] = carry;
            self.higher.push(top);
        }
        cells & !before
    }

    /// Subtracts one from `cells` of a word, all of which must have one; returns those that have none now.
    #[inline]
    pub fn lower(&mut self, word: usize, cells: u64) -> u64 {
        let (mut borrow, mut after) = (cells, 0);
        for plane in std::iter::once(&mut self.lowest).chain(&mut self.higher) {
            let old = plane[word];
            plane[word] = old ^ borrow;
            borrow &= !old;
            after |= plane[word];
        }
        debug_assert_eq!(borrow, 0, "a cell was emptied that nothing filled");
        cells & !after
    }

    /// Drops planes that hold nothing; true when no count is left.
    #[inline]
    pub fn trim(&mut self) -> bool {
        while self.higher.last().is_some_and(|top| top.iter().all(|w| *w == 0)) {
            self.higher.pop();
        }
        self.is_empty()
    }

    /// True when there is no count.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.higher.is_empty() && self.lowest.iter().all(|w| *w == 0)
    }

    fn planes(&self) -> impl Iterator<Item = &Plane> {
        std::iter::once(&self.lowest).chain(&self.higher)
    }

    /// Cells of a word that have a count.
    #[inline]
    pub fn any(&self, word: usize) -> u64 {
        self.higher.iter().fold(self.lowest[word], |all, plane| all | plane[word])
    }

    /// Count of one cell.
    pub fn get(&self, word: usize, bit: usize) -> u32 {
        self.planes().enumerate().map(|(k, plane)| ((plane[word] >> bit & 1) as u32) << k).sum()
    }
}
