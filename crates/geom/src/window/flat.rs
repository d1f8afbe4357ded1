//! Flat windows: shares of square cells of a page, exact to the area of their pixels.
//!
//! A cell lies along the rows of the page around a point that may be anywhere in a pixel. A pixel counts by the part of
//! it that lies in the cell:
//!
//! ```text
//! |<-- left -->|<----- whole pixels ----->|<- right ->|
//! sum of a row = bits + (left - 1) first bit + (right - 1) last bit
//! ```
//!
//! Both channels are counted at once, one in each half of a word. Nothing is kept beside the bits of the sketch, so
//! nothing can become stale.

use super::{Place, WindowForm};
use crate::plane::Page;

/// Most columns that are counted at once: one half of a word.
const STRIP: usize = 32;
/// The lowest bit of each half of a word.
const LOWEST: u64 = 0x0000_0001_0000_0001;

/// A place on a page, in pixels from its upper left corner: to the right and down.
pub(crate) struct Spot {
    pub at: [f64; 2],
    /// One world unit along the first and the second direction of the window.
    pub ahead: [f64; 2],
    pub left: [f64; 2],
    /// Columns and rows of a world unit.
    pub unit: [f64; 2],
}

impl Spot {
    /// Of a place on a page; along `up` when it looks along z.
    pub fn on(page: &Page, place: &Place) -> Spot {
        let [wide, tall] = page.pixel();
        let flat = |v: crate::Vec3| Some(v.x.hypot(v.y)).filter(|n| *n > 1e-9).map(|n| [v.x / n, v.y / n]);
        let [x, y] = flat(place.forward).or_else(|| flat(place.up)).unwrap_or([1.0, 0.0]);
        let (columns, rows) = (place.scale / wide, place.scale / tall);
        Spot {
            at: [(place.position.x - page.low()[0]) / wide, (page.high()[1] - place.position.y) / tall],
            ahead: [x * columns, -y * rows],
            left: [-y * columns, -x * rows],
            unit: [columns, rows],
        }
    }
}

/// A part of a page in pixels: columns and rows from `low` to `high`.
struct Cell {
    low: [f64; 2],
    high: [f64; 2],
}

impl Cell {
    /// The part of it on a page, and its own area.
    fn around(at: [f64; 2], sides: [f64; 2], size: [usize; 2]) -> (Cell, f64) {
        let (mut low, mut high) = ([0.0; 2], [0.0; 2]);
        for a in 0..2 {
            let most = size[a] as f64;
            low[a] = (at[a] - 0.5 * sides[a]).clamp(0.0, most);
            high[a] = (at[a] + 0.5 * sides[a]).clamp(0.0, most);
        }
        (Cell { low, high }, sides[0] * sides[1])
    }

    /// Its area.
    fn area(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    /// Area of the pixels of both channels in it; `words(column / 64, row)` gives their bits.
    #[inline(always)]
    fn sums(&self, words: &impl Fn(usize, usize) -> [u64; 2]) -> [f64; 2] {
        let ([left, top], [right, bottom]) = (self.low, self.high);
        if !(left < right && top < bottom) {
            return [0.0; 2];
        }
        let (mut first, end) = (left as usize, right.ceil() as usize);
        let (first_row, end_row) = (top as usize, bottom.ceil() as usize);
        let mut sums = [0.0; 2];
        while first < end {
            let count = (end - first).min(STRIP);
            // Of the first and the last column, what is not in the cell; both when they are one.
            let missing = [(left - first as f64).max(0.0), ((first + count) as f64 - right).max(0.0)];
            for row in first_row..end_row {
                let height = (row as f64 + 1.0).min(bottom) - (row as f64).max(top);
                let bits = strip(words, first, count, row);
                let whole = counts(bits);
                let (lowest, highest) = (bits & LOWEST, bits >> (count - 1) & LOWEST);
                for (channel, sum) in sums.iter_mut().enumerate() {
                    let of = |x: u64| (x >> (32 * channel) & 0xffff_ffff) as u32 as f64;
                    *sum += height * (of(whole) - missing[0] * of(lowest) - missing[1] * of(highest));
                }
            }
            first += count;
        }
        sums
    }
}

/// The bits of `count` columns from `first`, both channels beside each other.
#[inline(always)]
fn strip(words: &impl Fn(usize, usize) -> [u64; 2], first: usize, count: usize, row: usize) -> u64 {
    let (word, shift) = (first / 64, first % 64);
    let mut both = words(word, row).map(|bits| bits >> shift);
    if shift + count > 64 {
        let next = words(word + 1, row).map(|bits| bits << (64 - shift));
        both = [both[0] | next[0], both[1] | next[1]];
    }
    let mask = (1 << count) - 1;
    both[0] & mask | (both[1] & mask) << 32
}

/// Number of bits in each half of a word.
#[inline(always)]
fn counts(x: u64) -> u64 {
    let x = x - (x >> 1 & 0x5555_5555_5555_5555);
    let x = (x & 0x3333_3333_3333_3333) + (x >> 2 & 0x3333_3333_3333_3333);
    let x = (x + (x >> 4)) & 0x0f0f_0f0f_0f0f_0f0f;
    x.wrapping_mul(0x0101_0101) >> 24 & 0x0000_00ff_0000_00ff
}

/// Appends both channels of every point: shares of the cell that `words` has, and, in the second, `beyond` times the
/// share that is outside of a page of `size` (columns, rows).
#[inline(always)]
pub(crate) fn look(
    form: &WindowForm,
    spot: &Spot,
    size: [usize; 2],
    beyond: f64,
    words: impl Fn(usize, usize) -> [u64; 2],
    out: &mut Vec<f32>,
) {
    out.reserve(form.values());
    for point in &form.points {
        let [ahead, left, _] = point.at;
        let at = [0, 1].map(|a| spot.at[a] + ahead * spot.ahead[a] + left * spot.left[a]);
        let (cell, area) = Cell::around(at, spot.unit.map(|unit| unit * point.cell), size);
        let [first, second] = cell.sums(&words);
        out.extend([(first / area) as f32, ((second + beyond * (area - cell.area())) / area) as f32]);
    }
}
