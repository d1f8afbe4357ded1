//! The last step of a picture: sums to bytes.
//!
//! The backdrop is a colour in the finished picture, not light: a white page stays exactly white, and the floor only
//! darkens it. So the filmic curve applies to the parts only.

use super::smooth::{Grain, smooth};
use super::trace::{Pixel, Stage};
use super::v3::{V3, v3};
use super::{Backdrop, Shot, tone};
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
}

/// Develops traced pixels.
pub fn develop(stage: &Stage, pixels: &[Pixel], shot: &Shot) -> Vec<u8> {
    let width = shot.width;
    let body_light = smooth(&grains(pixels, |p| p.body_grain), width);
    let floor_light = smooth(&grains(pixels, |p| p.floor_grain), width);
    let ghost = tone::linear(shot.ghost_color);
    let mut bytes = vec![0u8; 4 * pixels.len()];
    bytes.par_chunks_mut(4 * width).enumerate().for_each(|(row, line)| {
        let below = (row as f32 + 0.5) / shot.height as f32;
        for (column, out) in line.chunks_exact_mut(4).enumerate() {
            let k = row * width + column;
            let pixel = &pixels[k];
            let share = pixel.body.count / shot.samples as f32;
            let shade = shade(stage, pixel, floor_light[k]);
            let mut layer = backdrop(shot.backdrop, below, shade);
            if share > 0.0 {
                layer = layer.under(tone::film(scene_light(stage, pixel, body_light[k])), share);
            }
            if pixel.shell.count > 0.0 {
                let n = shot.samples as f32;
                let seen = pixel.shell.seen / n;
                layer = layer.under(ghost, pixel.shell.opacity / n);
                let line = outline(pixels, shot, column, row);
                layer = layer.under(ghost * 0.5, 0.85 * line * seen);
            }
            let straight = if layer.alpha > 0.0 { layer.color / layer.alpha } else { V3::ZERO };
            out[0] = tone::byte(straight.x);
            out[1] = tone::byte(straight.y);
            out[2] = tone::byte(straight.z);
            out[3] = (layer.alpha.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        }
    });
    bytes
}

fn grains(pixels: &[Pixel], of: impl Fn(&Pixel) -> Grain) -> Vec<Grain> {
    pixels.iter().map(of).collect()
}

/// The equation of `trace.rs`, for the mean of the pixel's samples.
fn scene_light(stage: &Stage, pixel: &Pixel, (blocked, sun): (V3, f32)) -> V3 {
    let body = &pixel.body;
    let full = stage.light.open_sky(pixel.body_grain.normal).luminance();
    let seen = 1.0 - (blocked.luminance() / full).clamp(0.0, 1.0);
    let light = body.sunlit * sun + body.open - body.paint.tint(blocked) + body.shine * (seen * seen);
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
    // Shadows are a little lighter than physics has them: they look better on a page.
    let ratio = ratio * (1.0 - DEEPEST) + V3::splat(DEEPEST);
    let covered = pixel.fade;
    V3::splat(1.0).lerp(ratio, covered)
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

/// How much of an edge of the ghost runs through a pixel, in `[0, 1]`: its silhouette, its creases, and where one
/// of its sheets ends before another.
fn outline(pixels: &[Pixel], shot: &Shot, column: usize, row: usize) -> f32 {
    let (width, height, samples) = (shot.width, shot.height, shot.samples as f32);
    let here = &pixels[row * width + column].shell;
    let normal = here.normal.unit();
    let depth = here.depth / here.count;
    let mut edge = 1.0 - here.count / samples;
    for (dx, dy) in [(-1i32, 0i32), (1, 0), (0, -1), (0, 1)] {
        let (x, y) = (column as i32 + dx, row as i32 + dy);
        if x < 0 || y < 0 || x >= width as i32 || y >= height as i32 {
            continue;
        }
        let there = &pixels[y as usize * width + x as usize].shell;
        edge = edge.max(1.0 - there.count / samples);
        if there.count == 0.0 {
            continue;
        }
        let crease = ((0.94 - normal.dot(there.normal.unit())) / 0.10).clamp(0.0, 1.0);
        let step = ((depth - there.depth / there.count).abs() / 0.03 - 1.0).clamp(0.0, 1.0);
        edge = edge.max(crease * 0.7).max(step);
    }
    edge
}
