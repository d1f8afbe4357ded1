//! Picture matching: the likeness of a scene, or of the shadow that it casts, to a picture.
//!
//! ```text
//! log score  = ln N(similarity; 1, sigma)                                     with its normaliser
//! similarity = sum of the weights of equal pixels / sum of all weights
//! weight     = 1 + multiplier * grey / 255                                    grey of the weight image
//! ```
//!
//! Dissertation 5.5.2 and 5.5.3. A pixel of the scene is on when its ray meets a shape: the camera's own ray for a
//! silhouette, the ray to the light from the point that the pixel sees of the receiver for a shadow. Both are exact
//! (differs: the original draws with a depth map of 800 x 800 and a bias that loses what is close to the receiver).
//! In a shadow picture shapes cast shadows on the receiver and do not hide it (differs: the original draws them too).
//!
//! The sketch keeps counts for each pixel and four integers, so a score is the same to the bit in any order; weights
//! are used only when the score is computed. The empty scene is scored as a picture with every pixel off.

use super::bag::Bag;
use super::score::{Sketch, SketchSpec, check_sigma, log_normal, share};
use super::tiles::Tiles;
use crate::error::GeomError;
use crate::once::Once;
use crate::solids::primitive::Primitive;
use crate::view::camera::check_size;
use crate::view::{Cover, Rays};
use crate::window::bits::Bits;
use crate::window::plate::Plate;
use crate::window::{Place, WindowForm};
use std::ops::{Add, AddAssign, Sub, SubAssign};
use std::sync::{Arc, OnceLock};

/// A number of pixels, and the sum of their greys in the weight image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// Pixels.
    pub pixels: i64,
    /// Sum of their greys, each 0 to 255.
    pub grey: i64,
}

impl Add for Amount {
    type Output = Amount;
    fn add(self, other: Amount) -> Amount {
        Amount { pixels: self.pixels + other.pixels, grey: self.grey + other.grey }
    }
}

impl Sub for Amount {
    type Output = Amount;
    fn sub(self, other: Amount) -> Amount {
        Amount { pixels: self.pixels - other.pixels, grey: self.grey - other.grey }
    }
}

impl AddAssign for Amount {
    fn add_assign(&mut self, other: Amount) {
        *self = *self + other;
    }
}

impl SubAssign for Amount {
    fn sub_assign(&mut self, other: Amount) {
        *self = *self - other;
    }
}

/// The pixels that should be on, and their weights.
#[derive(Clone, Debug)]
pub struct TargetPicture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// The mask of the pixels that should be on, row by row from the top.
    pub on: Vec<bool>,
    /// Greys of the weight image, row by row; all pixels weigh the same without one.
    pub greys: Option<Vec<u8>>,
    /// The additional weight of a white pixel of the weight image; a black pixel weighs 1.
    pub multiplier: f64,
}

/// A picture to match and the rays of its pixels.
#[derive(Debug)]
pub struct Picture {
    size: [usize; 2],
    rays: Rays,
    /// Words in the order of rays: pixels that should be on, and the eight bits of their greys.
    on: Vec<u64>,
    greys: Option<Vec<[u64; 8]>>,
    multiplier: f64,
    /// The amount of all pixels, with and without a ray.
    all: Amount,
    /// The amount of the pixels that should be on.
    target: Amount,
    /// The page for windows, computed at the first use.
    plate: OnceLock<Plate>,
}

impl Picture {
    /// The picture of `target`; pixels without a ray are always off in a scene.
    ///
    /// # Errors
    /// `bad-image` for a size without pixels or with too many, or lists of other lengths; `image-one-color` when all
    /// pixels should be alike; `bad-setting` for a multiplier that is not finite or negative.
    pub fn new(target: &TargetPicture, rays: Rays) -> Result<Picture, GeomError> {
        let size = target.size;
        check_size(size)?;
        let count = size[0] * size[1];
        let lengths = [Some(target.on.len()), target.greys.as_ref().map(Vec::len)];
        if let Some(length) = lengths.into_iter().flatten().find(|n| *n != count) {
            let message = format!("{length} values for a picture of {} x {}", size[0], size[1]);
            return Err(GeomError::new("bad-image", message));
        }
        if !(target.multiplier >= 0.0 && target.multiplier.is_finite()) {
            let message = format!("the weight is {}, expected zero or more", target.multiplier);
            return Err(GeomError::new("bad-setting", message));
        }
        let lit = target.on.iter().filter(|on| **on).count();
        if lit == 0 || lit == count {
            let all = if lit == 0 { "off" } else { "on" };
            return Err(GeomError::new(
                "image-one-color",
                format!("all {count} pixels of the picture are {all}"),
            ));
        }
        let words = |bit: &dyn Fn(usize) -> bool| -> Vec<u64> {
            let word =
                |rays: &[u32]| (0..).zip(rays).fold(0, |w, (k, p)| w | u64::from(bit(*p as usize)) << k);
            rays.pixels().chunks(64).map(word).collect()
        };
        let on = words(&|pixel| target.on[pixel]);
        let greys = target.greys.as_ref().map(|greys| {
            let planes: [Vec<u64>; 8] = std::array::from_fn(|k| words(&|pixel| greys[pixel] >> k & 1 == 1));
            (0..on.len()).map(|word| std::array::from_fn(|k| planes[k][word])).collect()
        });
        let grey = |pixel: usize| target.greys.as_ref().map_or(0, |greys| i64::from(greys[pixel]));
        let total = |counts: &dyn Fn(usize) -> bool| {
            let pixels = (0..count).filter(|p| counts(*p));
            pixels.fold(Amount::default(), |sum, p| sum + Amount { pixels: 1, grey: grey(p) })
        };
        let (all, on_target) = (total(&|_| true), total(&|pixel| target.on[pixel]));
        let (multiplier, plate) = (target.multiplier, OnceLock::new());
        Ok(Picture { size, rays, on, greys, multiplier, all, target: on_target, plate })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The rays of its pixels.
    pub fn rays(&self) -> &Rays {
        &self.rays
    }

    /// Share of the weight that should be on.
    pub fn on_fraction(&self) -> f64 {
        self.weight(self.target) / self.weight(self.all)
    }

    /// The mask of the pixels of a scene that are on, row by row.
    pub fn mask(&self, scene: &[Primitive]) -> Vec<bool> {
        let mut mask = vec![false; self.size[0] * self.size[1]];
        for shape in scene.iter().flat_map(Primitive::shapes) {
            self.rays.meeting(shape).rays().for_each(|ray| mask[self.rays.pixels()[ray] as usize] = true);
        }
        mask
    }

    fn plate(&self) -> &Plate {
        let on = |ray: usize| self.on[ray / 64] >> (ray % 64) & 1 == 1;
        self.plate.once(|| Plate::new(&self.rays, self.size, on))
    }

    fn amount(&self, word: usize, rays: u64) -> Amount {
        let pixels = i64::from(rays.count_ones());
        let grey = self.greys.as_ref().map_or(0, |greys| {
            (0..).zip(&greys[word]).map(|(k, plane)| i64::from((rays & plane).count_ones()) << k).sum()
        });
        Amount { pixels, grey }
    }

    fn weight(&self, amount: Amount) -> f64 {
        amount.pixels as f64 + self.multiplier * (amount.grey as f64 / 255.0)
    }
}

/// Scores a scene by how well its silhouette is `picture`, seen by the camera of the picture's rays.
///
/// # Errors
/// `bad-setting` when it is not positive.
pub fn match_image(picture: Arc<Picture>, sigma: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(sigma)?;
    Ok(Arc::new(PictureMatch::new("match_image", picture, sigma)))
}

/// Scores a scene by how well its shadow is `picture`, whose rays go from a receiver to a light.
///
/// # Errors
/// `bad-setting` when it is not positive.
pub fn match_shadow(picture: Arc<Picture>, sigma: f64) -> Result<Arc<dyn SketchSpec>, GeomError> {
    check_sigma(sigma)?;
    Ok(Arc::new(PictureMatch::new("match_shadow", picture, sigma)))
}

impl SketchSpec for PictureMatch {
    fn name(&self) -> &'static str {
        self.name
    }

    fn most(&self) -> f64 {
        log_normal(1.0, 1.0, self.sigma)
    }

    fn window(&self) -> Option<WindowForm> {
        let is_visible = !self.picture.rays.is_empty();
        is_visible.then(|| WindowForm::flat(self.picture.plate().side()))
    }
}

/// Counts of the shapes that the ray of each pixel meets.
#[derive(Debug)]
pub struct PictureMatch {
    name: &'static str,
    picture: Arc<Picture>,
    sigma: f64,
    tiles: Tiles,
    /// Pixels that are on, and the pixels among them that should be.
    on: Amount,
    right: Amount,
    /// Pixels of the plate that are on, once windows are expected.
    shown: Option<Bits>,
    /// The primitives; a mark has the rays that meet a primitive, shape by shape.
    bag: Bag<Arc<[Cover]>>,
}

impl PictureMatch {
    /// The empty scene, for the sketch of this name.
    pub fn new(name: &'static str, picture: Arc<Picture>, sigma: f64) -> PictureMatch {
        let tiles = Tiles::new(picture.rays.words());
        let (on, right) = (Amount::default(), Amount::default());
        PictureMatch { name, picture, sigma, tiles, on, right, shown: None, bag: Bag::default() }
    }

    /// Pixels that are on.
    pub fn on(&self) -> Amount {
        self.on
    }

    /// Pixels that are equal in scene and picture.
    pub fn equal(&self) -> Amount {
        // A pixel that is on and should be off, or off and should be on, is a mismatch.
        self.picture.all - (self.on - self.right) - (self.picture.target - self.right)
    }

    /// Share of the weight of the pixels that are equal in scene and picture.
    pub fn similarity(&self) -> f64 {
        self.picture.weight(self.equal()) / self.picture.weight(self.picture.all)
    }

    /// Counts of shapes for each ray.
    pub fn tiles(&self) -> &Tiles {
        &self.tiles
    }

    /// Pixels of the plate that are on.
    fn on_plate(&self) -> Bits {
        let plate = self.picture.plate();
        let mut bits = plate.empty();
        for word in 0..self.picture.rays.words() {
            plate.flip(&mut bits, word, self.tiles.any(word));
        }
        bits
    }

    /// The mask of the pixels that are on, row by row.
    pub fn mask(&self) -> Vec<bool> {
        let [columns, rows] = self.picture.size;
        let mut mask = vec![false; columns * rows];
        for (ray, pixel) in self.picture.rays.pixels().iter().enumerate() {
            mask[*pixel as usize] = self.tiles.any(ray / 64) >> (ray % 64) & 1 == 1;
        }
        mask
    }
}

/// The rays that meet each shape.
fn covers(primitive: &Primitive, rays: &Rays) -> Arc<[Cover]> {
    primitive.shapes().iter().map(|shape| rays.meeting(shape)).collect()
}

impl Clone for PictureMatch {
    fn clone(&self) -> PictureMatch {
        PictureMatch {
            name: self.name,
            picture: self.picture.clone(),
            sigma: self.sigma,
            tiles: self.tiles.clone(),
            on: self.on,
            right: self.right,
            shown: self.shown.clone(),
            bag: self.bag.clone(),
        }
    }

    fn clone_from(&mut self, source: &PictureMatch) {
        self.name = source.name;
        share(&mut self.picture, &source.picture);
        self.sigma = source.sigma;
        self.tiles.clone_from(&source.tiles);
        self.on = source.on;
        self.right = source.right;
        self.shown.clone_from(&source.shown);
        self.bag.clone_from(&source.bag);
    }
}

impl PartialEq for PictureMatch {
    fn eq(&self, other: &PictureMatch) -> bool {
        Arc::ptr_eq(&self.picture, &other.picture)
            && (self.sigma, self.on, self.right) == (other.sigma, other.on, other.right)
            && self.tiles == other.tiles
            && self.bag == other.bag
    }
}

impl Sketch for PictureMatch {
    fn add(&mut self, primitive: &Primitive) {
        let covers = covers(primitive, &self.picture.rays);
        for cover in &*covers {
            let (picture, on, right) = (&self.picture, &mut self.on, &mut self.right);
            let shown = &mut self.shown;
            self.tiles.add(cover, |word, new| {
                if let Some(shown) = shown {
                    picture.plate().flip(shown, word, new);
                }
                *on += picture.amount(word, new);
                *right += picture.amount(word, new & picture.on[word]);
            });
        }
        self.bag.add(primitive, || covers);
    }

    fn remove(&mut self, primitive: &Primitive) -> bool {
        let Some(covers) = self.bag.remove(primitive, || covers(primitive, &self.picture.rays)) else {
            return false;
        };
        for cover in &*covers {
            let (picture, on, right) = (&self.picture, &mut self.on, &mut self.right);
            let shown = &mut self.shown;
            self.tiles.remove(cover, |word, bare| {
                if let Some(shown) = shown {
                    picture.plate().flip(shown, word, bare);
                }
                *on -= picture.amount(word, bare);
                *right -= picture.amount(word, bare & picture.on[word]);
            });
        }
        true
    }

    fn expect_removals(&mut self) {
        self.bag.expect_removals();
    }

    fn expect_windows(&mut self) {
        if self.shown.is_none() {
            self.shown = Some(self.on_plate());
        }
    }

    fn look(&self, form: &WindowForm, place: &Place, out: &mut Vec<f32>) {
        let known;
        let bits = match &self.shown {
            Some(bits) => bits,
            None => {
                known = self.on_plate();
                &known
            }
        };
        self.picture.plate().look(self.picture.rays.projection(), form, place, bits, out);
    }

    fn log_score(&self) -> f64 {
        log_normal(self.similarity(), 1.0, self.sigma)
    }

    fn measures(&self) -> Vec<(&'static str, f64)> {
        vec![("similarity", self.similarity()), ("pixels_on", self.on.pixels as f64)]
    }
}
