//! Plates: pages over the rays of a picture, so that a window looks at a picture as at a drawing.
//!
//! The page lies in the plane of the rays. For a camera, its pixels are those of the picture. The rays to a light start at
//! the visible points of the receiver. For them the pixels are squares, as many as there are rays. A pixel stands for the
//! ray nearest to its middle, of its own rays or else of the rays of its eight neighbours. A pixel without a ray is outside.

use super::bits::Bits;
use super::flat::{self, Spot};
use super::{Place, WindowForm};
use crate::vector::Vec3;
use crate::view::{Projection, Rays};

/// No ray.
const NONE: u32 = u32::MAX;

#[derive(Debug)]
pub(crate) struct Plate {
    /// The lowest first and the highest second coordinate.
    corner: [f64; 2],
    pixel: [f64; 2],
    size: [usize; 2],
    /// Words of a row.
    across: usize,
    /// The pixels that have a ray, row by row.
    inside: Vec<u64>,
    /// The pixels whose ray should be on, row by row.
    target: Vec<u64>,
    /// True if every pixel has a ray.
    full: bool,
    /// The pixels of each ray: ray `r` has `pixels[starts[r]..starts[r + 1]]`.
    starts: Vec<u32>,
    pixels: Vec<u32>,
}

impl Plate {
    /// The plate of the rays of a picture of `picture` (columns, rows); `on` is true for rays that should be on.
    pub fn new(rays: &Rays, picture: [usize; 2], on: impl Fn(usize) -> bool) -> Plate {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for ray in 0..rays.len() {
            let at = rays.ray(ray).at;
            low = [0, 1].map(|a| low[a].min(at[a]));
            high = [0, 1].map(|a| high[a].max(at[a]));
        }
        let extent = [0, 1].map(|a| high[a] - low[a]);
        let (pixel, size) = if rays.are_of_camera() {
            let steps = [0, 1].map(|a| extent[a] / (picture[a] as f64 - 1.0));
            ([0, 1].map(|a| if picture[a] > 1 { steps[a] } else { steps[1 - a] }), picture)
        } else {
            let (long, short) = (extent[0].max(extent[1]), extent[0].min(extent[1]));
            let count = rays.len().max(1) as f64;
            let side = (long * short / count).sqrt().max(long / count).max(f64::MIN_POSITIVE);
            ([side; 2], extent.map(|e| (e / side).max(0.0) as usize + 1))
        };
        // The pixels' middles are in the middle of the rays.
        let corner = [0, 1].map(|a| {
            let (middle, half) = (0.5 * (low[a] + high[a]), 0.5 * size[a] as f64 * pixel[a]);
            if a == 0 { middle - half } else { middle + half }
        });
        let across = size[0].div_ceil(64);
        let zeros = vec![0; across * size[1]];
        let mut plate = Plate {
            corner,
            pixel,
            size,
            across,
            inside: zeros.clone(),
            target: zeros,
            full: false,
            starts: vec![0; rays.len() + 1],
            pixels: Vec::new(),
        };
        plate.assign(rays, on);
        plate
    }

    /// Finds the ray of each pixel.
    fn assign(&mut self, rays: &Rays, on: impl Fn(usize) -> bool) {
        let [columns, rows] = self.size;
        let distance = |plate: &Plate, ray: usize, column: usize, row: usize| {
            let [x, y] = plate.fall(rays.ray(ray).at);
            (x - column as f64 - 0.5).powi(2) + (y - row as f64 - 0.5).powi(2)
        };
        let nearer = |plate: &Plate, a: u32, b: u32, column: usize, row: usize| {
            b == NONE
                || a != NONE
                    && distance(plate, a as usize, column, row) < distance(plate, b as usize, column, row)
        };
        let mut nearest = vec![NONE; columns * rows];
        for ray in 0..rays.len() {
            let [x, y] = self.fall(rays.ray(ray).at);
            let (column, row) = ((x.max(0.0) as usize).min(columns - 1), (y.max(0.0) as usize).min(rows - 1));
            if nearer(self, ray as u32, nearest[row * columns + column], column, row) {
                nearest[row * columns + column] = ray as u32;
            }
        }
        let mut rays_of_pixels = nearest.clone();
        for (pixel, best) in rays_of_pixels.iter_mut().enumerate().filter(|(_, ray)| **ray == NONE) {
            let (column, row) = (pixel % columns, pixel / columns);
            for y in row.saturating_sub(1)..(row + 2).min(rows) {
                for x in column.saturating_sub(1)..(column + 2).min(columns) {
                    if nearest[y * columns + x] != NONE
                        && nearer(self, nearest[y * columns + x], *best, column, row)
                    {
                        *best = nearest[y * columns + x];
                    }
                }
            }
        }
        let mut pairs: Vec<(u32, u32)> =
            (0..).zip(&rays_of_pixels).map(|(pixel, ray)| (*ray, pixel)).collect();
        pairs.retain(|(ray, _)| *ray != NONE);
        self.full = pairs.len() == rays_of_pixels.len();
        pairs.sort_unstable();
        for (ray, pixel) in pairs {
            let (word, bit) = self.bit(pixel);
            self.inside[word] |= bit;
            self.target[word] |= if on(ray as usize) { bit } else { 0 };
            self.starts[ray as usize + 1] += 1;
            self.pixels.push(pixel);
        }
        for ray in 0..rays.len() {
            self.starts[ray + 1] += self.starts[ray];
        }
    }

    /// The position of a point of the plane on the page, in pixels from its upper left corner.
    fn fall(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.corner[0]) / self.pixel[0], (self.corner[1] - y) / self.pixel[1]]
    }

    /// The word of a pixel, and its bit in it.
    fn bit(&self, pixel: u32) -> (usize, u64) {
        let (column, row) = (pixel as usize % self.size[0], pixel as usize / self.size[0]);
        (row * self.across + column / 64, 1 << (column % 64))
    }

    /// The longer side, in units of the plane.
    pub fn side(&self) -> f64 {
        (self.size[0] as f64 * self.pixel[0]).max(self.size[1] as f64 * self.pixel[1])
    }

    /// The empty page.
    pub fn empty(&self) -> Bits {
        Bits::new(self.inside.len())
    }

    /// Changes the pixels of rays of a word.
    pub fn flip(&self, covered: &mut Bits, word: usize, mut rays: u64) {
        while rays != 0 {
            let ray = 64 * word + rays.trailing_zeros() as usize;
            rays &= rays - 1;
            for pixel in &self.pixels[self.starts[ray] as usize..self.starts[ray + 1] as usize] {
                let (word, bit) = self.bit(*pixel);
                covered.flip(word, bit);
            }
        }
    }

    /// Appends both channels of every point, without covered pixels.
    pub fn look(
        &self,
        projection: &Projection,
        form: &WindowForm,
        place: &Place,
        covered: &Bits,
        out: &mut Vec<f32>,
    ) {
        let Some(spot) = self.spot(projection, place) else {
            form.outside(out);
            return;
        };
        let first = out.len();
        let words = |across: usize, row: usize| {
            let word = row * self.across + across;
            let (inside, target) = (self.inside[word], self.target[word]);
            let free = !covered.word(word);
            [target & free, inside & !target & free]
        };
        flat::look(form, &spot, self.size, 2.0, words, out);
        if !self.full {
            let mut unknown = Vec::new();
            let gaps = |across: usize, row: usize| [0, !self.inside[row * self.across + across]];
            flat::look(form, &spot, self.size, 0.0, gaps, &mut unknown);
            out[first..].iter_mut().zip(unknown).for_each(|(shown, gap)| *shown += 2.0 * gap);
        }
    }

    /// The projection of a place to the page, along `up` when it looks along its ray; `None` behind a camera.
    fn spot(&self, projection: &Projection, place: &Place) -> Option<Spot> {
        let depth = projection.depth(place.position);
        if projection.perspective && depth.is_nan() | (depth <= 1e-9) {
            return None;
        }
        let [u, v] = projection.fall(place.position);
        let along = |d: Vec3| {
            let (x, y) = (projection.right.dot(d), projection.up.dot(d));
            let away = if projection.perspective { projection.forward.dot(d) } else { 0.0 };
            let (x, y) = (x - u * away, y - v * away);
            Some(x.hypot(y)).filter(|n| *n > 1e-9).map(|n| [x / n, y / n])
        };
        let [x, y] = along(place.forward).or_else(|| along(place.up)).unwrap_or([1.0, 0.0]);
        let unit = self.pixel.map(|side| place.scale / side);
        Some(Spot {
            at: self.fall([u, v]),
            ahead: [x * unit[0], -y * unit[1]],
            left: [-y * unit[0], -x * unit[1]],
            unit,
        })
    }
}
