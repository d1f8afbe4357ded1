//! Drawing matching: the likeness of a scene on a page to a picture.
//!
//! ```text
//! log score  = ln N(similarity; 1, sigma) + outside              see `outside`
//! similarity = (agree - agree_blank) / (1 - agree_blank)         1: the picture, 0: an empty page
//! agree      = weight of the equal pixels / weight of all pixels
//! weight     = 1 where the picture is empty, 2/3 + g/3 where it is filled
//! ```
//!
//! Dissertation 6.5.2. `g` is the magnitude of the picture's Sobel gradient (white is 1, black and everything outside
//! of the picture 0, no division), so that contours count more than areas. The text has weights of 1 and 0.6;
//! its code, which made the figures, has these. A pixel of the picture is filled when it is not white. A pixel of the scene
//! is filled when a shape has a point inside of it.
//!
//! The gain of a pixel when it is first covered does not depend on other pixels:
//!
//! ```text
//! similarity = (weight of covered filled pixels - covered empty pixels) / weight of all filled pixels
//! ```
//!
//! so a shape costs only its own pixels. Weights are multiples of 2^-20 and sums are integers: the score is the same
//! to the bit in any order, and adding and then removing restores it.

use super::bag::Bag;
use super::outside::Outside;
use super::score::{Sketch, SketchSpec, check_sigma, log_normal, share};
use super::tiles::Tiles;
use crate::bounds::Aabb;
use crate::error::GeomError;
use crate::plane::Page;
use crate::solids::primitive::Primitive;
use crate::view::Cover;
use crate::window::flat::{self, Spot};
use crate::window::{Place, WindowForm};
use std::sync::Arc;

/// The weight of an empty pixel in integers.
const ONE: i64 = 1 << 20;

/// A picture to draw, on its page.
#[derive(Debug)]
pub struct Drawing {
    page: Page,
    /// The filled pixels, in the words of [`Page::bit`].
    filled: Vec<u64>,
    /// The gain of each pixel when it is covered, in the same order, 64 for each word.
    gains: Vec<i64>,
    /// Weight of all filled pixels.
    all: i64,
}

impl Drawing {
    /// The picture of `greys` (255 is white), row by row from the top.
    ///
    /// # Errors
    /// `bad-image` for another number of greys; `image-one-color` when all pixels are filled or none is.
    pub fn new(page: Page, greys: &[u8]) -> Result<Drawing, GeomError> {
        let [columns, rows] = page.size();
        if greys.len() != columns * rows {
            let message = format!("{} values for a drawing of {columns} x {rows}", greys.len());
            return Err(GeomError::new("bad-image", message));
        }
        let count = greys.iter().filter(|grey| **grey < 255).count();
        if count == 0 || count == greys.len() {
            let all = if count == 0 { "white" } else { "filled" };
            return Err(GeomError::new(
                "image-one-color",
                format!("all {} pixels of the drawing are {all}", greys.len()),
            ));
        }
        let (mut filled, mut gains) = (vec![0; page.words()], vec![0; page.words() * 64]);
        let mut all = 0;
        for (pixel, grey) in greys.iter().enumerate() {
            let (column, row) = (pixel % columns, pixel / columns);
            let (word, bit) = page.bit(column, row);
            gains[word * 64 + bit] = -ONE;
            if *grey < 255 {
                let weight = (2.0 + slope(greys, [columns, rows], column, row)) / 3.0;
                filled[word] |= 1 << bit;
                gains[word * 64 + bit] = (weight * ONE as f64).round() as i64;
                all += gains[word * 64 + bit];
            }
        }
        Ok(Drawing { page, filled, gains, all })
    }

    /// The page.
    pub fn page(&self) -> &Page {
        &self.page
    }

    /// Pixels of a word that are filled, in the words of [`Page::bit`].
    #[inline]
    pub fn filled(&self, word: usize) -> u64 {
        self.filled[word]
    }

    /// True where the picture is filled.
    pub fn is_filled(&self, column: usize, row: usize) -> bool {
        let (word, bit) = self.page.bit(column, row);
        self.filled[word] >> bit & 1 == 1
    }

    /// The mask of the pixels that the shapes of a scene touch, row by row.
    pub fn mask(&self, scene: &[Primitive]) -> Vec<bool> {
        let mut words = vec![0; self.page.words()];
        for shape in scene.iter().flat_map(Primitive::shapes) {
            for (word, bits) in self.page.touched(shape).words() {
                words[*word as usize] |= bits;
            }
        }
        let [columns, rows] = self.page.size();
        let on = |pixel: usize| {
            let (word, bit) = self.page.bit(pixel % columns, pixel / columns);
            words[word] >> bit & 1 == 1
        };
        (0..columns * rows).map(on).collect()
    }

    /// The gain of the pixels `new` of a word when they are covered.
    #[inline]
    fn gain(&self, word: usize, mut new: u64) -> i64 {
        let gains = &self.gains[word * 64..word * 64 + 64];
        let mut sum = 0;
        while new != 0 {
            sum += gains[new.trailing_zeros() as usize];
            new &= new - 1;
        }
        sum
    }
}

/// Magnitude of the Sobel gradient; white is 1, and the outside of the page is 0.
fn slope(greys: &[u8], [columns, rows]: [usize; 2], column: usize, row: usize) -> f64 {
    let at = |dx: isize, dy: isize| {
        let (x, y) = (column.wrapping_add_signed(dx), row.wrapping_add_signed(dy));
        if x < columns && y < rows { f64::from(greys[y * columns + x]) / 255.0 } else { 0.0 }
    };
    let side = |dx: isize| at(dx, -1) + 2.0 * at(dx, 0) + at(dx, 1);
    let line = |dy: isize| at(-1, dy) + 2.0 * at(0, dy) + at(1, dy);
    let (x, y) = (side(1) - side(-1), line(1) - line(-1));
    (x * x + y * y).sqrt()
}

/// Scores a scene by how well it draws `drawing`.
///
/// # Errors
/// `bad-setting` when `sigma` is not positive.
pub fn match_drawing(drawing: Arc<Drawing>, sigma: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(sigma)?;
    Ok(Arc::new(DrawingMatch::new(drawing, sigma)))
}

impl SketchSpec for DrawingMatch {
    fn name(&self) -> &'static str {
        "match_drawing"
    }

    fn most(&self) -> f64 {
        log_normal(1.0, 1.0, self.sigma)
    }

    fn window(&self) -> Option<WindowForm> {
        Some(WindowForm::flat(self.drawing.page.side()))
    }

    fn image(&self) -> Option<(Page, Vec<u64>)> {
        let mut bits = Vec::new();
        self.drawing.page.image(|word| self.drawing.filled(word), &mut bits);
        Some((self.drawing.page.clone(), bits))
    }

    fn domain(&self) -> Option<Aabb> {
        Some(self.drawing.page.domain())
    }
}

/// Counts of the shapes that touch each pixel.
#[derive(Debug)]
pub struct DrawingMatch {
    drawing: Arc<Drawing>,
    sigma: f64,
    tiles: Tiles,
    /// Sum of the gains of the covered pixels, and their number.
    gained: i64,
    covered: i64,
    outside: Outside,
    /// With the pixels that each primitive touches, shape by shape.
    bag: Bag<Arc<[Cover]>>,
}

impl DrawingMatch {
    /// The empty page.
    pub fn new(drawing: Arc<Drawing>, sigma: f64) -> DrawingMatch {
        let tiles = Tiles::new(drawing.page.words());
        let outside = Outside::default();
        DrawingMatch { drawing, sigma, tiles, gained: 0, covered: 0, outside, bag: Bag::default() }
    }

    /// 1 for the picture, 0 for an empty page, below 0 for worse.
    pub fn similarity(&self) -> f64 {
        self.gained as f64 / self.drawing.all as f64
    }

    /// The picture to draw.
    pub fn drawing(&self) -> &Drawing {
        &self.drawing
    }

    /// Pixels of a word that are touched, in the words of [`Page::bit`].
    #[inline]
    pub fn any(&self, word: usize) -> u64 {
        self.tiles.any(word)
    }
}

/// The pixels that each shape touches.
fn covers(primitive: &Primitive, page: &Page) -> Arc<[Cover]> {
    primitive.shapes().iter().map(|shape| page.touched(shape)).collect()
}

impl Clone for DrawingMatch {
    fn clone(&self) -> DrawingMatch {
        DrawingMatch {
            drawing: self.drawing.clone(),
            sigma: self.sigma,
            tiles: self.tiles.clone(),
            gained: self.gained,
            covered: self.covered,
            outside: self.outside.clone(),
            bag: self.bag.clone(),
        }
    }

    fn clone_from(&mut self, source: &DrawingMatch) {
        share(&mut self.drawing, &source.drawing);
        self.sigma = source.sigma;
        self.tiles.clone_from(&source.tiles);
        (self.gained, self.covered) = (source.gained, source.covered);
        self.outside.clone_from(&source.outside);
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for DrawingMatch {
    fn eq(&self, other: &DrawingMatch) -> bool {
        Arc::ptr_eq(&self.drawing, &other.drawing)
            && (self.sigma, self.gained, self.covered) == (other.sigma, other.gained, other.covered)
            && self.tiles == other.tiles
            && self.outside == other.outside
            && self.bag == other.bag
    }
}

impl Sketch for DrawingMatch {
    fn add(&mut self, primitive: &Primitive) {
        let covers = covers(primitive, &self.drawing.page);
        for (shape, cover) in primitive.shapes().iter().zip(&*covers) {
            let (drawing, gained, covered) = (&self.drawing, &mut self.gained, &mut self.covered);
            self.tiles.add(cover, |word, new| {
                *gained += drawing.gain(word, new);
                *covered += i64::from(new.count_ones());
            });
            self.outside.add(shape, &drawing.page);
        }
        self.bag.add(primitive, || covers);
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let Some(covers) = self.bag.remove(primitive, || covers(primitive, &self.drawing.page)) else {
            return false;
        };
        for (shape, cover) in primitive.shapes().iter().zip(&*covers) {
            let (drawing, gained, covered) = (&self.drawing, &mut self.gained, &mut self.covered);
            self.tiles.remove(cover, |word, bare| {
                *gained -= drawing.gain(word, bare);
                *covered -= i64::from(bare.count_ones());
            });
            self.outside.remove(shape, &drawing.page);
        }
        true
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn look(&self, form: &WindowForm, place: &Place, out: &mut Vec<f32>) {
        let (drawing, page) = (&self.drawing, &self.drawing.page);
        let words = |across: usize, row: usize| {
            let word = page.word(across, row);
            let (filled, any) = (drawing.filled[word], self.tiles.any(word));
            [filled & !any, !filled & !any]
        };
        flat::look(form, &Spot::on(page, place), page.size(), 2.0, words, out);
    }

    fn image(&self, out: &mut Vec<u64>) {
        self.drawing.page.image(|word| self.tiles.any(word), out);
    }

    fn log_score(&self) -> f64 {
        log_normal(self.similarity(), 1.0, self.sigma) + self.outside.log_score(&self.drawing.page)
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        let [x, y] = self.outside.shares(&self.drawing.page);
        vec![("similarity", self.similarity()), ("pixels_on", self.covered as f64), ("outside", x + y)]
    }
}
