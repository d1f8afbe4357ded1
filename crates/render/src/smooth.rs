//! A filter that removes the noise of sampled light and keeps edges.
//!
//! The pixels of a tile sample different directions (`light::Directions`). The mean over a neighbourhood on the same
//! surface therefore has all of them. A neighbour counts when its normal agrees and it lies in the pixel's tangent
//! plane (a cross-bilateral filter: Eisemann & Durand 2004, Petschnigg et al. 2004).

use super::light::TILE;
use super::pixel::{Grain, Pixel};
use super::plate::Plate;
use super::v3::V3;
use rayon::prelude::*;

/// Half-width of the neighbourhood, pixels.
const REACH: usize = TILE - 1;

/// Weighted sums of the light around a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    blocked: V3,
    sky_weight: f32,
    sun: f32,
    sun_weight: f32,
}

impl Sums {
    fn of(grain: &Grain) -> Sums {
        Sums {
            blocked: grain.blocked * grain.sky_weight,
            sky_weight: grain.sky_weight,
            sun: grain.sun * grain.sun_weight,
            sun_weight: grain.sun_weight,
        }
    }

    fn add(&mut self, other: &Sums, share: f32) {
        self.blocked = self.blocked + other.blocked * share;
        self.sky_weight += other.sky_weight * share;
        self.sun += other.sun * share;
        self.sun_weight += other.sun_weight * share;
    }

    /// `(blocked, sun)`, or the values of the pixel itself without samples.
    fn mean(&self, here: &Grain) -> (V3, f32) {
        (
            if self.sky_weight > 0.0 { self.blocked / self.sky_weight } else { here.blocked },
            if self.sun_weight > 0.0 { self.sun / self.sun_weight } else { here.sun },
        )
    }
}

/// The smoothed `(blocked, sun)` of every pixel of a plate, for the light that `of` picks: along the rows, then along
/// the columns. The two passes are the whole neighbourhood on a plane, and nearly so where a surface bends.
pub fn smooth(plate: &Plate, of: impl Fn(&Pixel) -> &Grain + Sync) -> Vec<Vec<(V3, f32)>> {
    let along: Vec<Vec<Sums>> = plate
        .rows
        .par_iter()
        .map(|row| {
            let grains = &row.pixels;
            (0..grains.len())
                .map(|k| {
                    let center = of(&grains[k]);
                    let mut sums = Sums::default();
                    if center.count > 0.0 {
                        let lowest = k.saturating_sub(REACH);
                        for (j, neighbour) in grains.iter().enumerate().take(k + REACH + 1).skip(lowest) {
                            let neighbour = of(neighbour);
                            if neighbour.count > 0.0 {
                                sums.add(
                                    &Sums::of(neighbour),
                                    tent(k.abs_diff(j)) * likeness(center, neighbour),
                                );
                            }
                        }
                    }
                    sums
                })
                .collect()
        })
        .collect();
    plate
        .rows
        .par_iter()
        .enumerate()
        .map(|(y, row)| {
            let near = y.saturating_sub(REACH)..(y + REACH + 1).min(plate.rows.len());
            (0..row.pixels.len())
                .map(|k| {
                    let center = of(&row.pixels[k]);
                    let mut sums = Sums::default();
                    if center.count > 0.0 {
                        for other in near.clone() {
                            let Some(j) = (row.first + k).checked_sub(plate.rows[other].first) else {
                                continue;
                            };
                            let Some(neighbour) = plate.rows[other].pixels.get(j).map(&of) else { continue };
                            if neighbour.count > 0.0 {
                                sums.add(
                                    &along[other][j],
                                    tent(y.abs_diff(other)) * likeness(center, neighbour),
                                );
                            }
                        }
                    }
                    sums.mean(center)
                })
                .collect()
        })
        .collect()
}

/// The likeness of two pixels, in `[0, 1]`: their normals agree, and each lies in the plane of the other.
fn likeness(a: &Grain, b: &Grain) -> f32 {
    let agree = a.normal.dot(b.normal).max(0.0).powi(16);
    let off = a.normal.dot(b.point - a.point) / (2.0 * a.footprint);
    agree / (1.0 + off * off * off * off)
}

/// Two boxes as wide as a tile, convolved: on a plane, a pattern that repeats from tile to tile cancels exactly.
fn tent(d: usize) -> f32 {
    (TILE - d) as f32
}

#[cfg(test)]
mod tests {
    //! Claim: light does not leak across a crease, and noise on one plane goes down.
    use super::*;
    use crate::plate::Row;
    use crate::v3::v3;

    #[test]
    fn stops_at_a_crease() {
        let width = 16;
        let pixels: Vec<Pixel> = (0..width * 16)
            .map(|k| {
                let left = k % width < 8;
                let body_grain = Grain {
                    normal: if left { v3(0., 1., 0.) } else { v3(1., 0., 0.) },
                    point: v3((k % width) as f32, 0.0, (k / width) as f32),
                    footprint: 1.0,
                    blocked: V3::splat(if left { 0.0 } else { 1.0 }),
                    count: 16.0,
                    sky_weight: 16.0,
                    sun: (k % 2) as f32,
                    sun_weight: 16.0,
                };
                Pixel { body_grain, ..Pixel::default() }
            })
            .collect();
        let rows = pixels.chunks(width).map(|row| Row { first: 3, pixels: row.to_vec() }).collect();
        let out = smooth(&Plate { rows, width: 32 }, |pixel| &pixel.body_grain);
        assert_eq!(out[8][7].0, V3::ZERO);
        assert_eq!(out[8][8].0, V3::splat(1.0));
        assert!((out[8][4].1 - 0.5).abs() < 1e-6, "stripes cancel");
    }
}
