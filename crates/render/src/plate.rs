//! The traced picture, and the pixels that take all samples.
//!
//! Every pixel takes a few samples first. The rest goes to the pixels where the picture changes: at edges, on
//! bumps, in the penumbra of a shadow, along the ghost's outline. A row keeps the pixels from the first to the last
//! that a part, a shadow or the ghost is in, because most of a page is backdrop.

use super::light::TILE;
use super::pixel::Pixel;
use super::trace::Stage;
use rayon::prelude::*;

/// Share of the samples that every pixel takes, as a divisor.
const SHARE: usize = 4;
/// The fewest samples of a pixel, if the picture has as many.
const FEWEST: usize = 4;
/// Relative difference of brightness that counts as a change.
const CONTRAST: f32 = 0.05;

/// A row of a plate: the pixels `first..first + pixels.len()`.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Column of the first pixel.
    pub first: usize,
    /// The pixels, which include every hit pixel.
    pub pixels: Vec<Pixel>,
}

/// A traced picture.
#[derive(Clone, Debug)]
pub struct Plate {
    /// The rows of pixels, from the top.
    pub rows: Vec<Row>,
    /// Pixels across.
    pub width: usize,
}

impl Plate {
    /// Casts the rays of a picture `height` pixels high.
    pub fn trace(stage: &Stage, height: usize) -> Plate {
        let few = (stage.samples / SHARE).max(FEWEST).min(stage.samples);
        let rows = (0..height).into_par_iter().map(|row| Row::begin(stage, row, few)).collect();
        let mut plate = Plate { rows, width: stage.width };
        if few < stage.samples {
            let edges = ShadowEdges::new(&plate);
            plate.rows =
                (0..height).into_par_iter().map(|row| plate.refined(stage, &edges, row, few)).collect();
        }
        plate.rows.par_iter_mut().for_each(|row| row.pixels.iter_mut().for_each(Pixel::finish));
        plate
    }

    /// The pixel at a place; `None` for backdrop.
    pub fn get(&self, column: usize, row: usize) -> Option<&Pixel> {
        let row = self.rows.get(row)?;
        row.pixels.get(column.checked_sub(row.first)?)
    }

    /// A row with all samples where the picture changes.
    fn refined(&self, stage: &Stage, edges: &ShadowEdges, row: usize, few: usize) -> Row {
        // An edge can run through a pixel whose first samples missed it: look one pixel beyond the neighbours.
        let near = &self.rows[row.saturating_sub(1)..(row + 2).min(self.rows.len())];
        let hit_rows = || near.iter().filter(|r| !r.pixels.is_empty());
        let Some(first) = hit_rows().map(|r| r.first.saturating_sub(1)).min() else { return Row::default() };
        let last = hit_rows().map(|r| r.first + r.pixels.len() + 1).max().unwrap_or(first).min(stage.width);
        let empty = Pixel::default();
        let at = |column: Option<usize>, row: Option<usize>| {
            column.zip(row).and_then(|(column, row)| self.get(column, row)).unwrap_or(&empty)
        };
        let pixels = (first..last)
            .map(|column| {
                let center = at(Some(column), Some(row));
                let around = [
                    at(column.checked_sub(1), Some(row)),
                    at(Some(column + 1), Some(row)),
                    at(Some(column), row.checked_sub(1)),
                    at(Some(column), Some(row + 1)),
                ];
                let mut pixel = *center;
                if is_mixed(center, few)
                    || edges.near(column, row)
                    || around.iter().any(|neighbour| differ(center, neighbour))
                {
                    stage.cast(&mut pixel, column, row, few..stage.samples);
                } else if pixel.samples == 0.0 {
                    pixel.samples = few as f32;
                }
                pixel
            })
            .collect();
        Row { first, pixels }
    }
}

impl Row {
    /// The first `few` samples of a row.
    fn begin(stage: &Stage, row: usize, few: usize) -> Row {
        let mut line = vec![Pixel::default(); stage.width];
        for (column, pixel) in line.iter_mut().enumerate() {
            stage.cast(pixel, column, row, 0..few);
        }
        let Some(first) = line.iter().position(Pixel::is_hit) else { return Row::default() };
        let last = line.iter().rposition(Pixel::is_hit).unwrap_or(first);
        Row { first, pixels: line[first..=last].to_vec() }
    }
}

/// The tiles of pixels through which the edge of a shadow runs. The pixels of a tile share one set of directions
/// (`light::Directions`), so all of them take all samples or none does. The neighbouring tiles, which are smoothed together
/// with it, follow.
struct ShadowEdges {
    tiles: Vec<bool>,
    across: usize,
}

impl ShadowEdges {
    fn new(plate: &Plate) -> ShadowEdges {
        let across = plate.width.div_ceil(TILE);
        let mut tiles = vec![false; across * plate.rows.len().div_ceil(TILE)];
        tiles.par_chunks_mut(across.max(1)).zip(plate.rows.par_chunks(TILE)).for_each(|(line, rows)| {
            let mut sums = vec![[(0.0, 0.0); 2]; across];
            for row in rows {
                for (column, pixel) in (row.first..).zip(&row.pixels) {
                    for (sum, grain) in
                        sums[column / TILE].iter_mut().zip([&pixel.body_grain, &pixel.floor_grain])
                    {
                        *sum = (sum.0 + grain.sun, sum.1 + grain.sun_weight);
                    }
                }
            }
            for (tile, sums) in line.iter_mut().zip(sums) {
                *tile = sums.iter().any(|&(sun, weight)| sun > 0.0 && sun < weight);
            }
        });
        ShadowEdges { tiles, across }
    }

    /// True if an edge runs through the pixel's tile or a neighbouring tile.
    fn near(&self, column: usize, row: usize) -> bool {
        let (x, y) = (column / TILE, row / TILE);
        let columns = x.saturating_sub(1)..(x + 2).min(self.across);
        let rows = y.saturating_sub(1)..(y + 2).min(self.tiles.len() / self.across.max(1));
        rows.into_iter().any(|y| self.tiles[y * self.across..][columns.clone()].contains(&true))
    }
}

/// True if the samples of a pixel disagree.
fn is_mixed(pixel: &Pixel, few: usize) -> bool {
    let all = few as f32;
    let part = |count: f32| count > 0.0 && count < all;
    let (body, shell) = (&pixel.body, &pixel.shell);
    part(body.count)
        || part(shell.count)
        || part(shell.visible)
        || (body.count > 0.0 && contrast(body.darkest, body.brightest))
}

/// True if the picture changes between two pixels with the same samples.
fn differ(a: &Pixel, b: &Pixel) -> bool {
    a.body.count != b.body.count
        || a.shell.count != b.shell.count
        || a.shell.visible != b.shell.visible
        || (a.body.count > 0.0
            && b.body.count > 0.0
            && contrast(a.body.darkest.min(b.body.darkest), a.body.brightest.max(b.body.brightest)))
}

fn contrast(dark: f32, bright: f32) -> bool {
    bright - dark > CONTRAST * (bright + dark)
}

#[cfg(test)]
mod tests {
    //! Claim: a picture in which most pixels take a quarter of the samples is as good as a picture with all samples.
    use crate::{Shot, Surface, render};

    /// A grey post on a red slab, both turned.
    fn scene() -> Vec<Surface> {
        let block = |middle: [f32; 3], size: [f32; 3], color| {
            let vertices = (0..8u8)
                .map(|k| {
                    let side = |axis: usize| if k >> axis & 1 == 1 { 0.5 } else { -0.5 };
                    let (x, z) = (side(0) * size[0], side(2) * size[2]);
                    [
                        middle[0] + 0.8 * x - 0.6 * z,
                        middle[1] + side(1) * size[1],
                        middle[2] + 0.6 * x + 0.8 * z,
                    ]
                })
                .collect();
            let sides: [[u32; 4]; 6] =
                [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
            let faces = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
            Surface { vertices, faces, color, gloss: 0.3, ..Surface::default() }
        };
        vec![
            block([0., 0.2, 0.], [3., 0.4, 2.], [0.8, 0.3, 0.2]),
            block([0.3, 1.2, 0.], [0.4, 1.6, 0.4], [0.7; 3]),
        ]
    }

    /// Root mean square difference to a picture of very many samples, in bytes.
    fn error(samples: usize, reference: &[u8]) -> f64 {
        let shot = Shot { width: 160, height: 120, samples, ..Shot::default() };
        let bytes = render(&scene(), None, &shot).unwrap();
        let sum: f64 =
            bytes.iter().zip(reference).map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2)).sum();
        (sum / bytes.len() as f64).sqrt()
    }

    #[test]
    fn samples_go_where_the_picture_changes() {
        let shot = Shot { width: 160, height: 120, samples: 4096, ..Shot::default() };
        let reference = render(&scene(), None, &shot).unwrap();
        let [few, many] = [4, 16].map(|samples| error(samples, &reference));
        // Measured: 3.0 and 1.3; without the second pass both are equal.
        assert!(many < 0.6 * few && many < 1.6, "{few} {many}");
    }
}
