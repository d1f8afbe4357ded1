//! Removes the noise of sampled light and keeps edges.
//!
//! Each pixel of a tile sampled its own directions (`light::Directions`); the mean over a neighbourhood on the same
//! surface therefore sees all of them. A neighbour counts when its normal agrees and it lies in the pixel's tangent
//! plane (a cross-bilateral filter: Eisemann & Durand 2004, Petschnigg et al. 2004).

use super::light::TILE;
use super::v3::V3;
use rayon::prelude::*;

/// The surface of one pixel and its sampled light.
#[derive(Clone, Copy, Debug, Default)]
pub struct Grain {
    /// Mean normal (unit), or zero where there is no surface.
    pub normal: V3,
    /// Mean position.
    pub point: V3,
    /// Width of the pixel on the surface, scene units.
    pub footprint: f32,
    /// Samples that met the surface.
    pub count: f32,
    /// Mean sky light that is blocked.
    pub blocked: V3,
    /// Samples behind `blocked`.
    pub sky_weight: f32,
    /// Share of the sun that is seen.
    pub sun: f32,
    /// Samples behind `sun`.
    pub sun_weight: f32,
}

/// Half-width of the neighbourhood, pixels.
const REACH: i32 = TILE as i32 - 1;

/// For every pixel the smoothed `(blocked, sun)`.
pub fn smooth(grains: &[Grain], width: usize) -> Vec<(V3, f32)> {
    let height = grains.len() / width.max(1);
    let mut out = vec![(V3::ZERO, 1.0); grains.len()];
    out.par_chunks_mut(width.max(1)).enumerate().for_each(|(row, line)| {
        for (column, answer) in line.iter_mut().enumerate() {
            let here = &grains[row * width + column];
            if here.count > 0.0 {
                *answer = around(grains, width, height, column, row, here);
            }
        }
    });
    out
}

fn around(
    grains: &[Grain],
    width: usize,
    height: usize,
    column: usize,
    row: usize,
    here: &Grain,
) -> (V3, f32) {
    let (mut blocked, mut sky_weight) = (V3::ZERO, 0.0);
    let (mut sun, mut sun_weight) = (0.0, 0.0);
    for dy in -REACH..=REACH {
        let y = row as i32 + dy;
        if y < 0 || y >= height as i32 {
            continue;
        }
        for dx in -REACH..=REACH {
            let x = column as i32 + dx;
            if x < 0 || x >= width as i32 {
                continue;
            }
            let there = &grains[y as usize * width + x as usize];
            if there.count == 0.0 {
                continue;
            }
            let agree = here.normal.dot(there.normal).max(0.0).powi(16);
            let off = here.normal.dot(there.point - here.point) / (2.0 * here.footprint);
            let same = agree / (1.0 + off * off * off * off) * tent(dx) * tent(dy);
            blocked = blocked + there.blocked * (same * there.sky_weight);
            sky_weight += same * there.sky_weight;
            sun += there.sun * (same * there.sun_weight);
            sun_weight += same * there.sun_weight;
        }
    }
    let blocked = if sky_weight > 0.0 { blocked / sky_weight } else { here.blocked };
    (blocked, if sun_weight > 0.0 { sun / sun_weight } else { here.sun })
}

/// Two boxes as wide as a tile, convolved: on a plane, what repeats from tile to tile cancels exactly.
fn tent(d: i32) -> f32 {
    (TILE as i32 - d.abs()) as f32
}

#[cfg(test)]
mod tests {
    //! Claim: light does not leak across a crease, and noise on one plane goes down.
    use super::*;
    use crate::render::v3::v3;

    #[test]
    fn stops_at_a_crease() {
        let width = 16;
        let grains: Vec<Grain> = (0..width * 16)
            .map(|k| {
                let left = k % width < 8;
                Grain {
                    normal: if left { v3(0., 1., 0.) } else { v3(1., 0., 0.) },
                    point: v3((k % width) as f32, 0.0, (k / width) as f32),
                    footprint: 1.0,
                    blocked: V3::splat(if left { 0.0 } else { 1.0 }),
                    count: 16.0,
                    sky_weight: 16.0,
                    sun: (k % 2) as f32,
                    sun_weight: 16.0,
                }
            })
            .collect();
        let out = smooth(&grains, width);
        assert_eq!(out[8 * width + 7].0, V3::ZERO);
        assert_eq!(out[8 * width + 8].0, V3::splat(1.0));
        assert!((out[8 * width + 4].1 - 0.5).abs() < 1e-6, "stripes cancel");
    }
}
