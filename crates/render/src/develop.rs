//! The last step of a picture: sums to bytes.
//!
//! The backdrop is a colour in the finished picture, not light: a white page stays exactly white, and the floor only
//! darkens it. So the filmic curve applies to the parts only.

use super::pixel::Pixel;
use super::plate::Plate;
use super::shot::{Backdrop, Shot};
use super::smooth::smooth;
use super::tone;
use super::trace::Stage;
use super::v3::{V3, v3};
use rayon::prelude::*;

/// Darkest shadow on the floor, as a share of its light.
const DEEPEST: f32 = 0.20;

/// Linear colour times opacity, and opacity.
#[derive(Clone, Copy, Default)]
struct Layer {
    color: V3,
    alpha: f32,
}

impl Layer {
    fn under(self, color: V3, alpha: f32) -> Layer {
        Layer { color: self.color * (1.0 - alpha) + color * alpha, alpha: self.alpha * (1.0 - alpha) + alpha }
    }

    /// Straight alpha, sRGB.
    fn bytes(self) -> [u8; 4] {
        let straight = if self.alpha > 0.0 { self.color / self.alpha } else { V3::ZERO };
        let alpha = (self.alpha.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        [tone::byte(straight.x), tone::byte(straight.y), tone::byte(straight.z), alpha]
    }
}

/// Develops a traced picture.
pub fn develop(stage: &Stage, plate: &Plate, shot: &Shot) -> Vec<u8> {
    let body_light = smooth(plate, |pixel| &pixel.body_grain);
    let floor_light = smooth(plate, |pixel| &pixel.floor_grain);
    let ghost = tone::linear(shot.ghost_color);
    let mut bytes = vec![0u8; 4 * shot.width * shot.height];
    bytes.par_chunks_mut(4 * shot.width).enumerate().for_each(|(y, line)| {
        let below = (y as f32 + 0.5) / shot.height as f32;
        let bare = backdrop(shot.backdrop, below, V3::splat(1.0)).bytes();
        line.chunks_exact_mut(4).for_each(|out| out.copy_from_slice(&bare));
        let row = &plate.rows[y];
        for (k, pixel) in row.pixels.iter().enumerate().filter(|(_, pixel)| pixel.is_hit()) {
            let column = row.first + k;
            let shade = shade(stage, pixel, floor_light[y][k]);
            let mut layer = backdrop(shot.backdrop, below, shade);
            if pixel.body.count > 0.0 {
                let share = pixel.body.count / pixel.samples;
                layer = layer.under(tone::film(scene_light(stage, pixel, body_light[y][k])), share);
            }
            if pixel.shell.count > 0.0 {
                let visible = pixel.shell.visible / pixel.samples;
                layer = layer.under(ghost, pixel.shell.opacity / pixel.samples);
                layer = layer.under(ghost * 0.5, 0.85 * outline(plate, pixel, column, y) * visible);
            }
            line[4 * column..4 * column + 4].copy_from_slice(&layer.bytes());
        }
    });
    bytes
}

/// The equation of `trace.rs`, for the mean of the pixel's samples.
fn scene_light(stage: &Stage, pixel: &Pixel, (blocked, sun): (V3, f32)) -> V3 {
    let body = &pixel.body;
    let full = stage.light.open_sky(pixel.body_grain.normal).luminance();
    let visible = 1.0 - (blocked.luminance() / full).clamp(0.0, 1.0);
    let light = body.sunlit * sun + body.open - body.paint.tint(blocked) + body.shine * (visible * visible);
    light.max(V3::ZERO) / body.count
}

/// Light on the floor over light on the open floor, faded to 1 away from the scene.
fn shade(stage: &Stage, pixel: &Pixel, (blocked, sun): (V3, f32)) -> V3 {
    if pixel.floor == 0.0 || pixel.fade == 0.0 {
        return V3::splat(1.0);
    }
    let up = v3(0.0, 1.0, 0.0);
    let (sunny, open) = (stage.light.strength * stage.light.sun.y, stage.light.open_sky(up));
    let light = sunny * sun + (open - blocked).max(V3::ZERO);
    let whole = sunny + open;
    let ratio = v3(light.x / whole.x, light.y / whole.y, light.z / whole.z);
    // Shadows are a little lighter than physically correct, because they look better on a page.
    let ratio = ratio * (1.0 - DEEPEST) + V3::splat(DEEPEST);
    let fade = pixel.fade;
    V3::splat(1.0).lerp(ratio, fade)
}

fn backdrop(backdrop: Backdrop, below: f32, shade: V3) -> Layer {
    match backdrop {
        Backdrop::Clear => Layer { color: V3::ZERO, alpha: 1.0 - shade.luminance() },
        Backdrop::Roll { top, bottom } => {
            let t = below * below * (3.0 - 2.0 * below);
            Layer { color: tone::linear(top).lerp(tone::linear(bottom), t).tint(shade), alpha: 1.0 }
        }
    }
}

/// The strength of the ghost's edges in a pixel, in `[0, 1]`: silhouette, creases, and ends of a sheet before another.
fn outline(plate: &Plate, pixel: &Pixel, column: usize, row: usize) -> f32 {
    let shell = &pixel.shell;
    let normal = shell.normal.unit();
    let depth = shell.depth / shell.count;
    let mut edge = 1.0 - shell.count / pixel.samples;
    let around = [
        (column.checked_sub(1), Some(row)),
        (Some(column + 1), Some(row)),
        (Some(column), row.checked_sub(1)),
        (Some(column), Some(row + 1)),
    ];
    for (column, row) in around.into_iter().filter_map(|(column, row)| column.zip(row)) {
        if column >= plate.width || row >= plate.rows.len() {
            continue;
        }
        let Some(neighbour) = plate.get(column, row).filter(|neighbour| neighbour.shell.count > 0.0) else {
            edge = 1.0;
            continue;
        };
        edge = edge.max(1.0 - neighbour.shell.count / neighbour.samples);
        let neighbour = &neighbour.shell;
        let crease = ((0.94 - normal.dot(neighbour.normal.unit())) / 0.10).clamp(0.0, 1.0);
        let step = ((depth - neighbour.depth / neighbour.count).abs() / 0.03 - 1.0).clamp(0.0, 1.0);
        edge = edge.max(crease * 0.7).max(step);
    }
    edge
}
