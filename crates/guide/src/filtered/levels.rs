//! An image after its filters, windows on it, and derivatives by the filters.

use crate::net::{LANES, Real};

/// Number of filtered images of an image, each at half the size of the one before.
pub const LEVELS: usize = 4;
/// Weights of a filter, and cells of a window.
pub(super) const CELLS: usize = 9;
/// Weights of an image's filters: for each level the filter and its constant; then the value outside of each level.
pub(super) const FILTERS: usize = LEVELS * (CELLS + 1) + LEVELS;

/// An image at all levels.
#[derive(Clone, Debug, Default)]
pub struct Levels<T: Real = f32> {
    levels: [Level<T>; LEVELS],
}

#[derive(Clone, Debug, Default)]
struct Level<T: Real> {
    columns: usize,
    rows: usize,
    /// The input of the filter, with zeros around it: a row above and below, and a column on the left.
    input: Vec<T>,
    /// The output of the filter.
    output: Vec<T>,
}

impl<T: Real> Level<T> {
    /// Length of a row of outputs; numbers beyond the columns have no meaning.
    fn width(&self) -> usize {
        self.columns.next_multiple_of(LANES)
    }

    /// Length of a row of inputs.
    fn stride(&self) -> usize {
        self.width() + LANES
    }

    fn resize(&mut self, [columns, rows]: [usize; 2]) {
        if [self.columns, self.rows] != [columns, rows] {
            (self.columns, self.rows) = (columns, rows);
            self.input = vec![T::ZERO; (rows + 2) * self.stride()];
            self.output = vec![T::ZERO; rows * self.width()];
        }
    }

    /// Filters the input.
    fn filter(&mut self, filter: &[T]) {
        let (width, stride) = (self.width(), self.stride());
        for (row, line) in self.output.chunks_exact_mut(width.max(1)).enumerate() {
            let above = &self.input[row * stride..(row + 3) * stride];
            for (at, block) in line.chunks_exact_mut(LANES).enumerate() {
                let mut lanes = [filter[CELLS]; LANES];
                for (cell, weight) in filter[..CELLS].iter().enumerate() {
                    let from = cell / 3 * stride + cell % 3 + at * LANES;
                    let input = &above[from..from + LANES];
                    for lane in 0..LANES {
                        lanes[lane] += *weight * input[lane];
                    }
                }
                block.copy_from_slice(&lanes);
            }
        }
    }

    /// The output at half the size: the input of the next level.
    fn halve(&self, next: &mut Level<T>) {
        let (width, stride, quarter) = (self.width(), next.stride(), T::from_f64(0.25));
        for row in 0..next.rows {
            let (upper, lower) = self.output[2 * row * width..].split_at(width);
            let line = &mut next.input[(row + 1) * stride + 1..][..next.columns];
            for (column, x) in line.iter_mut().enumerate() {
                let at = 2 * column;
                *x = quarter * (upper[at] + upper[at + 1] + lower[at] + lower[at + 1]);
            }
        }
    }

    /// Places in the outputs of the cells of the window around `at`, a place in shares of the image from its upper left
    /// corner.
    #[expect(clippy::cast_possible_truncation, reason = "nine images at most from the corner")]
    fn cells(&self, at: [f64; 2]) -> [Option<usize>; CELLS] {
        let middle = |share: f64, count: usize| (share.clamp(-9.0, 9.0) * count as f64).floor() as isize;
        let (column, row) = (middle(at[0], self.columns), middle(at[1], self.rows));
        let mut cells = [None; CELLS];
        for (k, cell) in cells.iter_mut().enumerate() {
            let (x, y) = (column + k as isize % 3 - 1, row + k as isize / 3 - 1);
            let inside = (0..self.columns as isize).contains(&x) && (0..self.rows as isize).contains(&y);
            *cell = inside.then(|| y as usize * self.width() + x as usize);
        }
        cells
    }
}

impl<T: Real> Levels<T> {
    /// Sets all sizes for an image of these columns and rows.
    fn resize(&mut self, mut size: [usize; 2]) {
        for level in &mut self.levels {
            level.resize(size);
            size = size.map(|side| side / 2);
        }
    }

    /// Filters an image: a bit for each touched pixel, row by row from the top, each row in words of its own.
    pub(super) fn see(&mut self, size: [usize; 2], bits: &[u64], filters: &[T]) {
        self.resize(size);
        let first = &mut self.levels[0];
        let (stride, words) = (first.stride(), size[0].div_ceil(64));
        for (row, words) in bits.chunks_exact(words).enumerate().take(size[1]) {
            let line = &mut first.input[(row + 1) * stride + 1..][..size[0]];
            for (column, x) in line.iter_mut().enumerate() {
                *x = T::from_f64(1.0 - 2.0 * (words[column / 64] >> (column % 64) & 1) as f64);
            }
        }
        for number in 0..LEVELS {
            let (before, rest) = self.levels.split_at_mut(number);
            if let Some(before) = before.last() {
                before.halve(&mut rest[0]);
            }
            rest[0].filter(&filters[number * (CELLS + 1)..]);
        }
    }

    /// The windows around a place, level by level; `put` gets the number of each cell and its value.
    pub(super) fn window(&self, at: [f64; 2], filters: &[T], mut put: impl FnMut(usize, T)) {
        for (number, level) in self.levels.iter().enumerate() {
            let outside = filters[LEVELS * (CELLS + 1) + number];
            for (k, cell) in level.cells(at).into_iter().enumerate() {
                put(number * CELLS + k, cell.map_or(outside, |cell| level.output[cell]));
            }
        }
    }

    /// Clears the outputs, as slopes.
    pub(super) fn clear(&mut self, like: &Levels<T>) {
        self.resize([like.levels[0].columns, like.levels[0].rows]);
        self.levels.iter_mut().for_each(|level| level.output.fill(T::ZERO));
    }

    /// Adds slopes of a window's cells to those of outputs, and slopes of the values outside to `slope`.
    pub(super) fn add_window(&mut self, at: [f64; 2], slopes: impl Fn(usize) -> T, slope: &mut [T]) {
        for (number, level) in self.levels.iter_mut().enumerate() {
            for (k, cell) in level.cells(at).into_iter().enumerate() {
                let cell_slope = slopes(number * CELLS + k);
                match cell {
                    Some(cell) => level.output[cell] += cell_slope,
                    None => slope[LEVELS * (CELLS + 1) + number] += cell_slope,
                }
            }
        }
    }

    /// Adds slopes by the filters of the image `seen` to `slope`, from the slopes by outputs in `self`.
    pub(super) fn back(&mut self, image: &Levels<T>, filters: &[T], slope: &mut [T]) {
        for number in (0..LEVELS).rev() {
            let (before, rest) = self.levels.split_at_mut(number);
            let (level, input) = (&mut rest[0], &image.levels[number].input);
            let (width, stride) = (level.width(), level.stride());
            let at = number * (CELLS + 1);
            let mut sums = [[T::ZERO; LANES]; CELLS + 1];
            if number > 0 {
                level.input.fill(T::ZERO);
            }
            for (row, line) in level.output.chunks_exact(width.max(1)).enumerate() {
                let above = row * stride..(row + 3) * stride;
                let (input, back) = (&input[above.clone()], &mut level.input[above]);
                for (block, slopes) in line.chunks_exact(LANES).enumerate() {
                    for cell in 0..CELLS {
                        let from = cell / 3 * stride + cell % 3 + block * LANES;
                        let input = &input[from..from + LANES];
                        for lane in 0..LANES {
                            sums[cell][lane] += slopes[lane] * input[lane];
                        }
                        if number > 0 {
                            let weight = filters[at + cell];
                            let back = &mut back[from..from + LANES];
                            for lane in 0..LANES {
                                back[lane] += weight * slopes[lane];
                            }
                        }
                    }
                    for lane in 0..LANES {
                        sums[CELLS][lane] += slopes[lane];
                    }
                }
            }
            for (to, sums) in slope[at..].iter_mut().zip(sums) {
                *to += sums.into_iter().sum();
            }
            if let Some(before) = before.last_mut() {
                let (wide, quarter) = (before.width(), T::from_f64(0.25));
                for row in 0..level.rows {
                    let back = &level.input[(row + 1) * stride + 1..][..level.columns];
                    let (upper, lower) = before.output[2 * row * wide..].split_at_mut(wide);
                    for (column, x) in back.iter().enumerate() {
                        for line in [&mut *upper, &mut *lower] {
                            line[2 * column] += quarter * *x;
                            line[2 * column + 1] += quarter * *x;
                        }
                    }
                }
            }
        }
    }
}
