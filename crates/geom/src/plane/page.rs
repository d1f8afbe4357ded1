//! Pages: windows of the plane in square or oblong pixels, and the pixels that a shape covers.
//!
//! A shape covers pixels in two ways, both from [`Outline::across`]:
//!
//! - *touched*: one bit for each pixel, set where the shape has a point inside of the pixel. Between the heights of a
//!   row of pixels a convex piece has one interval of x, so a row is a run of bits;
//! - *sampled*: 64 bits for each pixel, its 8 x 8 sample points, of which the share that the shape holds is the pixel's
//!   coverage.
//!
//! Words of bits are grouped in 64s that are near each other, as [`crate::sketch::tiles`] needs it: 64 rows of 64 pixels
//! for touched, 8 x 8 pixels for sampled.

use super::outline::Outline;
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::solids::shape::Shape;
use crate::vector::vec3;
use crate::view::Cover;
use crate::view::camera::check_size;

/// Sample points along each side of a pixel.
pub const SAMPLES: usize = 8;
/// Words in a group.
const GROUP: usize = 64;

/// A window of the plane, and its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    low: [f64; 2],
    high: [f64; 2],
    /// Columns and rows.
    size: [usize; 2],
    /// Width and height of a pixel.
    pixel: [f64; 2],
}

impl Page {
    /// The window from `low` to `high` in `size` columns and rows; the first row is at the top, where y is high.
    ///
    /// # Errors
    /// `bad-setting` for a window without inside, `bad-image` for a size without pixels or with too many.
    pub fn new(low: [f64; 2], high: [f64; 2], size: [usize; 2]) -> Result<Page, GeomError> {
        check_size(size)?;
        let sides = [high[0] - low[0], high[1] - low[1]];
        if !sides.iter().all(|side| *side > 0.0 && side.is_finite()) {
            let message = format!("the window from {low:?} to {high:?} has no inside");
            return Err(GeomError::new("bad-setting", message));
        }
        let pixel = [sides[0] / size[0] as f64, sides[1] / size[1] as f64];
        Ok(Page { low, high, size, pixel })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Lowest x and y of the window.
    pub fn low(&self) -> [f64; 2] {
        self.low
    }

    /// Highest x and y of the window.
    pub fn high(&self) -> [f64; 2] {
        self.high
    }

    /// Width and height of a pixel, world units.
    pub fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    /// The window in space, where z is 0.
    pub fn domain(&self) -> Aabb {
        let at = |[x, y]: [f64; 2]| vec3(x, y, 0.0);
        Aabb { low: at(self.low), high: at(self.high) }
    }

    /// The longer side of the window, world units.
    pub fn side(&self) -> f64 {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1])
    }

    /// Number of words of touched pixels.
    pub fn words(&self) -> usize {
        self.size[0].div_ceil(64) * self.size[1].div_ceil(GROUP) * GROUP
    }

    /// The word and the bit of a touched pixel.
    #[inline]
    pub fn bit(&self, column: usize, row: usize) -> (usize, usize) {
        (self.word(column / 64, row), column % 64)
    }

    /// The word of the touched pixels `64 * across ..` of a row.
    #[inline]
    pub(crate) fn word(&self, across: usize, row: usize) -> usize {
        (row / GROUP * self.size[0].div_ceil(64) + across) * GROUP + row % GROUP
    }

    /// Appends the touched pixels row by row from the top, each row from a new word on; `word` returns the words of
    /// [`Page::bit`].
    pub(crate) fn image(&self, word: impl Fn(usize) -> u64, out: &mut Vec<u64>) {
        for row in 0..self.size[1] {
            out.extend((0..self.size[0].div_ceil(64)).map(|across| word(self.word(across, row))));
        }
    }

    /// Number of words of sampled pixels.
    pub fn sampled_words(&self) -> usize {
        self.size[0].div_ceil(SAMPLES) * self.size[1].div_ceil(SAMPLES) * GROUP
    }

    /// The word of a pixel's samples.
    #[inline]
    pub fn sampled_word(&self, column: usize, row: usize) -> usize {
        let group = row / SAMPLES * self.size[0].div_ceil(SAMPLES) + column / SAMPLES;
        group * GROUP + row % SAMPLES * SAMPLES + column % SAMPLES
    }

    /// The pixel (column, row) of a word of samples.
    #[inline]
    pub(crate) fn sampled_pixel(&self, word: usize) -> (usize, usize) {
        let (group, inside, across) = (word / GROUP, word % GROUP, self.size[0].div_ceil(SAMPLES));
        (group % across * SAMPLES + inside % SAMPLES, group / across * SAMPLES + inside / SAMPLES)
    }

    /// The height of the upper border of a row; of the page's lower border for the row after the last.
    #[inline]
    fn top(&self, row: usize) -> f64 {
        self.high[1] - row as f64 * self.pixel[1]
    }

    /// The rows that an interval of heights touches.
    fn rows(&self, (low, high): (f64, f64)) -> std::ops::Range<usize> {
        cells((self.high[1] - high) / self.pixel[1], (self.high[1] - low) / self.pixel[1], self.size[1])
    }

    /// The pixels that have a point of `shape` inside.
    pub fn touched(&self, shape: &Shape) -> Cover {
        let mut words = Vec::with_capacity(8);
        let mut pieces = 0;
        Outline::of(shape, |piece| {
            pieces += 1;
            for row in self.rows(piece.heights()) {
                let Some((least, most)) = piece.across(self.top(row + 1), self.top(row)) else { continue };
                let columns = cells(
                    (least - self.low[0]) / self.pixel[0],
                    (most - self.low[0]) / self.pixel[0],
                    self.size[0],
                );
                let mut first = columns.start;
                while first < columns.end {
                    let end = columns.end.min(first / 64 * 64 + 64);
                    let bits = (!0 >> (64 - (end - first))) << (first % 64);
                    words.push((self.word(first / 64, row) as u32, bits));
                    first = end;
                }
            }
        });
        // The words of a single piece on a narrow page are in order.
        if pieces == 1 && self.size[0] <= 64 { Cover::in_order(words) } else { Cover::settled(words) }
    }

    /// The sample points that `shape` holds.
    pub fn sampled(&self, shape: &Shape) -> Cover {
        let (wide, tall) = (self.pixel[0] / SAMPLES as f64, self.pixel[1] / SAMPLES as f64);
        let mut words: Vec<(u32, u64)> = Vec::with_capacity(16);
        Outline::of(shape, |piece| {
            for row in self.rows(piece.heights()) {
                let start = words.len();
                for line in 0..SAMPLES {
                    let y = self.top(row) - (line as f64 + 0.5) * tall;
                    let Some((least, most)) = piece.across(y, y) else { continue };
                    // Sample k is at `low + (k + 1/2) wide`.
                    let place = |x: f64| ((x - self.low[0]) / wide - 0.5).ceil();
                    let last = (self.size[0] * SAMPLES) as f64;
                    let samples =
                        place(least).clamp(0.0, last) as usize..place(most).clamp(0.0, last) as usize;
                    let mut first = samples.start;
                    while first < samples.end {
                        let column = first / SAMPLES;
                        let end = samples.end.min((column + 1) * SAMPLES);
                        let bits = ((1 << (end - first)) - 1) << (first % SAMPLES + line * SAMPLES);
                        let word = self.sampled_word(column, row) as u32;
                        match words[start..].iter_mut().find(|(other, _)| *other == word) {
                            Some((_, known)) => *known |= bits,
                            None => words.push((word, bits)),
                        }
                        first = end;
                    }
                }
            }
        });
        Cover::settled(words)
    }
}

/// The cells of `0..count` that have points inside of the open interval, in units of a cell.
#[inline]
fn cells(least: f64, most: f64, count: usize) -> std::ops::Range<usize> {
    let count = count as f64;
    // NaN becomes an empty range.
    least.floor().clamp(0.0, count) as usize..most.ceil().clamp(0.0, count) as usize
}
