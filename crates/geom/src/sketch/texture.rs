//! Textures: the fill of a window to a certain share, with lively edges.
//!
//! ```text
//! log score = ln N(score; 1, sigma) + outside                    see `outside`
//! score     = (1 - |edge - 1|) (1 - min(1, |fill - share| / share))
//! fill      = share of the pixels that are touched
//! edge      = mean magnitude of the Sobel gradient over all pixels
//! ```
//!
//! Dissertation 6.5.3, eq. 6.4: with a share of one half and long straight strokes it makes circuits. As in the
//! original's code the edge term is `1 - |edge - 1|` (its text has `edge`), and the gradient is not divided by its
//! weights; the page is white, 1, and all is black outside of it, 0, so that an empty page has an edge of 0.31
//! from its border alone. A pixel's value is the share of its 8 x 8 sample points that no shape holds; it is touched when
//! one is held.
//!
//! The sketch keeps counts for each sample, the number of touched pixels and the sum of all magnitudes in steps of
//! 2^-26: integers, the same in any order.
//!
//! A texture has no target. So a window shows other shares of its cells: the share of touched pixels, and the share outside
//! of the page, both 0 to 1.

use super::bag::Bag;
use super::outside::Outside;
use super::score::{Sketch, SketchSpec, check_sigma, log_normal, share};
use super::tiles::Tiles;
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::plane::Page;
use crate::solids::primitive::Primitive;
use crate::view::Cover;
use crate::window::bits::Bits;
use crate::window::flat::{self, Spot};
use crate::window::{Place, WindowForm};
use std::sync::Arc;

/// Samples of a pixel, and its value where nothing is drawn.
const WHITE: i32 = 64;
/// Steps of a magnitude in units of samples.
const STEPS: f64 = (1 << 20) as f64;

/// The texture that a drawing should have, on its page.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The window and its pixels.
    pub page: Page,
    /// The share of the pixels that should be touched, above 0 and at most 1.
    pub share: f64,
    /// Standard deviation of the score.
    pub sigma: f64,
}

/// Scores a scene by how it fills a window.
///
/// # Errors
/// `bad-setting` for a share outside of `(0, 1]`, and when `sigma` is not positive.
pub fn fill_drawing(texture: Texture) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(texture.sigma)?;
    if !(texture.share > 0.0 && texture.share <= 1.0) {
        let message = format!("the share is {}, expected a number above 0, at most 1", texture.share);
        return Err(GeomError::new("bad-setting", message));
    }
    Ok(Arc::new(TextureMatch::new(Arc::new(texture))))
}

impl SketchSpec for TextureMatch {
    fn name(&self) -> &'static str {
        "fill_drawing"
    }

    fn window(&self) -> Option<WindowForm> {
        Some(WindowForm::flat(self.texture.page.side()))
    }

    /// Without a target no pixel is filled.
    fn image(&self) -> Option<(Page, Vec<u64>)> {
        let page = &self.texture.page;
        let mut bits = Vec::new();
        page.image(|_| 0, &mut bits);
        Some((page.clone(), bits))
    }

    fn domain(&self) -> Option<Aabb> {
        Some(self.texture.page.domain())
    }
}

/// Counts of the shapes that cover each sample point.
#[derive(Debug)]
pub struct TextureMatch {
    texture: Arc<Texture>,
    tiles: Tiles,
    touched: i64,
    /// Sum of the magnitudes, in steps.
    edges: i64,
    outside: Outside,
    /// The touched pixels, in the words of [`Page::bit`], once windows are expected.
    shown: Option<Bits>,
    /// With the samples that each primitive holds, shape by shape.
    bag: Bag<Arc<[Cover]>>,
}

/// A rectangle of pixels: columns and rows.
type Area = [std::ops::Range<usize>; 2];

impl TextureMatch {
    /// The empty page.
    pub fn new(texture: Arc<Texture>) -> TextureMatch {
        let [columns, rows] = texture.page.size();
        let (tiles, outside) = (Tiles::new(texture.page.sampled_words()), Outside::default());
        let (shown, bag) = (None, Bag::default());
        let mut empty = TextureMatch { texture, tiles, touched: 0, edges: 0, outside, shown, bag };
        empty.edges = empty.steps(&[0..columns, 0..rows]);
        empty
    }

    /// Share of the pixels that are touched.
    pub fn fill(&self) -> f64 {
        self.touched as f64 / self.pixels()
    }

    /// Mean magnitude of the gradient.
    pub fn edge(&self) -> f64 {
        self.edges as f64 / (STEPS * f64::from(WHITE) * self.pixels())
    }

    /// 1 at best.
    pub fn score(&self) -> f64 {
        let share = self.texture.share;
        let filled = 1.0 - ((self.fill() - share).abs() / share).min(1.0);
        filled * (1.0 - (self.edge() - 1.0).abs())
    }

    /// Samples of a pixel that a shape holds, in the words of [`Page::sampled_word`].
    #[inline]
    pub fn any(&self, word: usize) -> u64 {
        self.tiles.any(word)
    }

    /// The score before its normal density.
    pub fn texture(&self) -> &Texture {
        &self.texture
    }

    fn pixels(&self) -> f64 {
        let [columns, rows] = self.texture.page.size();
        (columns * rows) as f64
    }

    /// Sum of the magnitudes in an area, in steps.
    fn steps(&self, [columns, rows]: &Area) -> i64 {
        let page = &self.texture.page;
        let [width, height] = page.size();
        // The values of the area and of one pixel around it, row by row.
        let wide = columns.len() + 2;
        let mut values = vec![0; wide * (rows.len() + 2)];
        for y in rows.start.max(1) - 1..(rows.end + 1).min(height) {
            for x in columns.start.max(1) - 1..(columns.end + 1).min(width) {
                let covered = self.tiles.any(page.sampled_word(x, y)).count_ones() as i32;
                values[(y + 1 - rows.start) * wide + x + 1 - columns.start] = WHITE - covered;
            }
        }
        let mut sum = 0;
        for middle in (1..=rows.len()).map(|row| row * wide) {
            let (above, here, below) = (
                &values[middle - wide..middle],
                &values[middle..middle + wide],
                &values[middle + wide..middle + 2 * wide],
            );
            for x in 1..=columns.len() {
                let side = |x: usize| above[x] + 2 * here[x] + below[x];
                let line = |row: &[i32]| row[x - 1] + 2 * row[x] + row[x + 1];
                let (across, down) = (side(x + 1) - side(x - 1), line(below) - line(above));
                sum += (f64::from(across * across + down * down).sqrt() * STEPS).round() as i64;
            }
        }
        sum
    }

    /// The pixels whose gradient can change with a shape: its box and one pixel around it.
    fn area(&self, primitive: &Primitive) -> Area {
        let page = &self.texture.page;
        let (aabb, [columns, rows]) = (primitive.aabb(), page.size());
        let ([left, _], [_, top]) = (page.low(), page.high());
        let wide = (page.high()[0] - left) / columns as f64;
        let tall = (top - page.low()[1]) / rows as f64;
        let range = |least: f64, most: f64, count: usize| {
            let end = (most.ceil() + 1.0).clamp(0.0, count as f64) as usize;
            (least.floor() - 1.0).clamp(0.0, end as f64) as usize..end
        };
        [
            range((aabb.low.x - left) / wide, (aabb.high.x - left) / wide, columns),
            range((top - aabb.high.y) / tall, (top - aabb.low.y) / tall, rows),
        ]
    }

    /// The pixels that are touched, where they are kept or else found.
    fn with_touched<R>(&self, see: impl FnOnce(&Bits) -> R) -> R {
        match &self.shown {
            Some(bits) => see(bits),
            None => see(&self.touched_pixels()),
        }
    }

    /// The touched pixels.
    fn touched_pixels(&self) -> Bits {
        let page = &self.texture.page;
        let mut bits = Bits::new(page.words());
        for word in (0..page.sampled_words()).filter(|word| self.tiles.any(*word) != 0) {
            let (column, row) = page.sampled_pixel(word);
            let (word, bit) = page.bit(column, row);
            bits.flip(word, 1 << bit);
        }
        bits
    }

    /// A pixel, by its word of samples, becomes touched or is no longer.
    #[inline]
    fn flip(&mut self, word: usize) {
        if let Some(shown) = &mut self.shown {
            let page = &self.texture.page;
            let (column, row) = page.sampled_pixel(word);
            let (word, bit) = page.bit(column, row);
            shown.flip(word, 1 << bit);
        }
    }

    /// Changes the counts, and what follows from them around the primitive.
    fn change(&mut self, primitive: &Primitive, change: impl FnOnce(&mut TextureMatch)) {
        let area = self.area(primitive);
        self.edges -= self.steps(&area);
        change(self);
        self.edges += self.steps(&area);
    }
}

/// The samples that each shape holds.
fn covers(primitive: &Primitive, page: &Page) -> Arc<[Cover]> {
    primitive.shapes().iter().map(|shape| page.sampled(shape)).collect()
}

impl Clone for TextureMatch {
    fn clone(&self) -> TextureMatch {
        TextureMatch {
            texture: self.texture.clone(),
            tiles: self.tiles.clone(),
            touched: self.touched,
            edges: self.edges,
            outside: self.outside.clone(),
            shown: self.shown.clone(),
            bag: self.bag.clone(),
        }
    }

    fn clone_from(&mut self, source: &TextureMatch) {
        share(&mut self.texture, &source.texture);
        self.tiles.clone_from(&source.tiles);
        (self.touched, self.edges) = (source.touched, source.edges);
        self.outside.clone_from(&source.outside);
        self.shown.clone_from(&source.shown);
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for TextureMatch {
    fn eq(&self, other: &TextureMatch) -> bool {
        Arc::ptr_eq(&self.texture, &other.texture)
            && (self.touched, self.edges) == (other.touched, other.edges)
            && self.tiles == other.tiles
            && self.outside == other.outside
            && self.bag == other.bag
    }
}

impl Sketch for TextureMatch {
    fn add(&mut self, primitive: &Primitive) {
        let covers = covers(primitive, &self.texture.page);
        self.change(primitive, |sketch| {
            for (shape, cover) in primitive.shapes().iter().zip(&*covers) {
                for (word, _) in cover.words() {
                    if sketch.tiles.any(*word as usize) == 0 {
                        sketch.touched += 1;
                        sketch.flip(*word as usize);
                    }
                }
                sketch.tiles.add(cover, |_, _| {});
                sketch.outside.add(shape, &sketch.texture.page);
            }
        });
        self.bag.add(primitive, || covers);
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let Some(covers) = self.bag.remove(primitive, || covers(primitive, &self.texture.page)) else {
            return false;
        };
        self.change(primitive, |sketch| {
            for (shape, cover) in primitive.shapes().iter().zip(&*covers) {
                sketch.tiles.remove(cover, |_, _| {});
                for (word, _) in cover.words() {
                    if sketch.tiles.any(*word as usize) == 0 {
                        sketch.touched -= 1;
                        sketch.flip(*word as usize);
                    }
                }
                sketch.outside.remove(shape, &sketch.texture.page);
            }
        });
        true
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn expect_windows(&mut self) {
        if self.shown.is_none() {
            self.shown = Some(self.touched_pixels());
        }
    }

    fn look(&self, form: &WindowForm, place: &Place, out: &mut Vec<f32>) {
        let page = &self.texture.page;
        self.with_touched(|bits| {
            let words = |across: usize, row: usize| [bits.word(page.word(across, row)), 0];
            flat::look(form, &Spot::on(page, place), page.size(), 1.0, words, out);
        });
    }

    fn image(&self, out: &mut Vec<u64>) {
        self.with_touched(|bits| self.texture.page.image(|word| bits.word(word), out));
    }

    fn log_score(&self) -> f64 {
        log_normal(self.score(), 1.0, self.texture.sigma) + self.outside.log_score(&self.texture.page)
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        let [x, y] = self.outside.shares(&self.texture.page);
        vec![("score", self.score()), ("fill", self.fill()), ("edge", self.edge()), ("outside", x + y)]
    }
}
