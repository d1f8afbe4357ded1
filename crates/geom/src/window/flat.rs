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
//! A window reads the bits of the sketch and stores nothing, so nothing can become stale.

use super::{Place, WindowForm, WindowPoint};
use crate::plane::Page;
use std::ops::Range;

/// The most columns that are counted at once.
const STRIP: usize = 64;

/// A place on a page, in pixels from its upper left corner: to the right and down.
pub(crate) struct Spot {
    pub at: [f64; 2],
    /// A world unit along the first and the second direction of the window.
    pub ahead: [f64; 2],
    pub left: [f64; 2],
    /// Columns and rows of a world unit.
    pub unit: [f64; 2],
}

impl Spot {
    /// The spot of a place on a page; along `up` when it looks along z.
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
    /// Area of the whole cell, with its part outside of the page.
    area: f64,
}

impl Cell {
    #[inline(always)]
    fn around(at: [f64; 2], sides: [f64; 2], size: [usize; 2]) -> Cell {
        let within = |a: usize, x: f64| x.clamp(0.0, size[a] as f64);
        Cell {
            low: [0, 1].map(|a| within(a, at[a] - 0.5 * sides[a])),
            high: [0, 1].map(|a| within(a, at[a] + 0.5 * sides[a])),
            area: sides[0] * sides[1],
        }
    }

    /// Area of the part on the page.
    #[inline(always)]
    fn inside(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    /// Area of the pixels of both channels in the part. `most` is the most rows of a cell of this size: all cells of a ring
    /// take the same steps, which a processor predicts.
    #[inline(always)]
    fn sums(&self, bits: &Part, most: usize) -> [f64; 2] {
        let mut sums = [0.0; 2];
        if self.inside() <= 0.0 {
            return sums;
        }
        let ([left, top], [right, bottom]) = (self.low, self.high);
        let (mut first, end) = (floor(left), ceil(right));
        let (first_row, last_row) = (floor(top), ceil(bottom) - 1);
        // The parts of the first and the last row outside of the cell; the two may be the same row.
        let rows = [top - first_row as f64, (last_row + 1) as f64 - bottom];
        while first < end {
            let count = (end - first).min(STRIP);
            let columns = [(left - first as f64).max(0.0), ((first + count) as f64 - right).max(0.0)];
            let strip = bits.strip(first, count);
            let (upper, lower) = (strip.counts(first_row), strip.counts(last_row));
            let mut all = upper;
            for row in first_row + 1..first_row + most {
                let within = if row <= last_row { u64::MAX } else { 0 };
                all.add(strip.row(row.min(last_row)).map(|bits| bits & within), count);
            }
            let [all, upper, lower] = [all, upper, lower].map(|counts| counts.less(columns));
            for (channel, sum) in sums.iter_mut().enumerate() {
                *sum += all[channel] - rows[0] * upper[channel] - rows[1] * lower[channel];
            }
            first += count;
        }
        sums
    }
}

/// Counts of bits of each channel: in all columns, in the first and in the last.
#[derive(Clone, Copy, Default)]
struct Counts {
    all: [u32; 2],
    first: [u32; 2],
    last: [u32; 2],
}

impl Counts {
    #[inline(always)]
    fn add(&mut self, bits: [u64; 2], count: usize) {
        for (channel, bits) in bits.into_iter().enumerate() {
            self.all[channel] += bits.count_ones();
            self.first[channel] += (bits & 1) as u32;
            self.last[channel] += (bits >> (count - 1)) as u32;
        }
    }

    /// The count without parts of the first and the last column.
    #[inline(always)]
    fn less(&self, [first, last]: [f64; 2]) -> [f64; 2] {
        let lanes = |lanes: [u32; 2]| lanes.map(|lane| f64::from(lane as i32));
        let (all, left, right) = (lanes(self.all), lanes(self.first), lanes(self.last));
        [0, 1].map(|channel| all[channel] - first * left[channel] - last * right[channel])
    }
}

/// The integer part of a number of pixels, which is not negative.
#[inline(always)]
fn floor(x: f64) -> usize {
    x as i32 as usize
}

/// The smallest integer that is not below a number of pixels.
#[inline(always)]
fn ceil(x: f64) -> usize {
    let floor = x as i32;
    floor as usize + usize::from(f64::from(floor) < x)
}

/// The words of both channels in a part of a page.
struct Part {
    words: Vec<[u64; 2]>,
    /// The first word of the rows, and the first row.
    first: [usize; 2],
    /// Words in a row.
    across: usize,
}

/// Some columns of the part.
struct Strip<'a> {
    words: &'a [[u64; 2]],
    across: usize,
    first_row: usize,
    columns: usize,
    shift: usize,
    mask: u64,
    /// The columns lie in two words.
    crosses: bool,
}

impl Part {
    #[inline(always)]
    fn new([columns, rows]: [Range<usize>; 2], words: impl Fn(usize, usize) -> [u64; 2]) -> Part {
        let all = columns.start / 64..columns.end.div_ceil(64);
        let mut part = Vec::with_capacity(all.len() * rows.len());
        for row in rows.clone() {
            for word in all.clone() {
                part.push(words(word, row));
            }
        }
        Part { words: part, first: [all.start, rows.start], across: all.len() }
    }

    #[inline(always)]
    fn strip(&self, first: usize, count: usize) -> Strip<'_> {
        let shift = first % 64;
        Strip {
            words: &self.words[first / 64 - self.first[0]..],
            across: self.across,
            first_row: self.first[1],
            columns: count,
            shift,
            mask: u64::MAX >> (64 - count),
            crosses: shift + count > 64,
        }
    }
}

impl Strip<'_> {
    #[inline(always)]
    fn counts(&self, row: usize) -> Counts {
        let mut counts = Counts::default();
        counts.add(self.row(row), self.columns);
        counts
    }

    /// The bits of a row, channel by channel.
    #[inline(always)]
    fn row(&self, row: usize) -> [u64; 2] {
        let word = (row - self.first_row) * self.across;
        let mut both = self.words[word].map(|bits| bits >> self.shift);
        if self.crosses {
            let next = self.words[word + 1].map(|bits| bits << (64 - self.shift));
            both = [both[0] | next[0], both[1] | next[1]];
        }
        both.map(|bits| bits & self.mask)
    }
}

/// Appends both channels of every point: shares of the cell in `words(column / 64, row)`, and in the second channel also
/// `beyond` times the share outside of a page of `size` (columns, rows).
pub(crate) fn look(
    form: &WindowForm,
    spot: &Spot,
    size: [usize; 2],
    beyond: f64,
    words: impl Fn(usize, usize) -> [u64; 2],
    out: &mut Vec<f32>,
) {
    let cell = |point: &WindowPoint| {
        let [ahead, left, _] = point.at;
        let at = [0, 1].map(|a| spot.at[a] + ahead * spot.ahead[a] + left * spot.left[a]);
        Cell::around(at, spot.unit.map(|unit| unit * point.cell), size)
    };
    let cells: Vec<Cell> = form.points.iter().map(cell).collect();
    let range = |a: usize| {
        let low = cells.iter().fold(f64::INFINITY, |low, cell| low.min(cell.low[a]));
        let high = cells.iter().fold(0.0, |high: f64, cell| high.max(cell.high[a]));
        floor(low)..ceil(high)
    };
    let part = Part::new([range(0), range(1)], words);
    out.reserve(form.values());
    for (cell, point) in cells.iter().zip(&form.points) {
        let most = ceil((spot.unit[1] * point.cell).min(size[1] as f64)) + 1;
        let [first, second] = cell.sums(&part, most);
        let outside = beyond * (cell.area - cell.inside());
        let share = 1.0 / cell.area;
        out.extend([(first * share) as f32, ((second + outside) * share) as f32]);
    }
}
