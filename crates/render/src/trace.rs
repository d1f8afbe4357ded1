//! The first step of a picture: rays through pixels, and sums over what they hit.
//!
//! A pixel keeps sums of the factors of colours. It keeps no colours, because sampled light is smoothed before it is
//! multiplied by the paint:
//!
//! ```text
//! scene light = sun * sunlit + open - blocked * paint + shine * visible
//! ```
//!
//! with `sun` (the visible share of the sun) and `blocked` (blocked sky light) after smoothing, and `visible` the visible
//! share of the sky.

use super::bump;
use super::bvh::Bvh;
use super::camera::{Camera, View};
use super::light::{Directions, Light};
use super::pixel::{Body, Grain, Pixel};
use super::shot::{Shot, Surface, corners};
use super::tone;
use super::v3::{V3, least, most, v3};
use std::ops::Range;

/// Share of the paint's colour that a blocking part sends back: one bounce, roughly.
const BOUNCE: f32 = 0.42;

/// Share of a metal's paint that is not visible: the rest stands for light that its rough grains scatter.
const METAL: f32 = 0.8;

/// A surface's look.
struct Paint {
    color: V3,
    gloss: f32,
    metal: f32,
    rough: f32,
    pitch: f32,
}

/// Everything that rays can hit.
pub struct Stage {
    tree: Bvh,
    ghost: Bvh,
    normals: Vec<[V3; 3]>,
    owner: Vec<u32>,
    paints: Vec<Paint>,
    ghost_normals: Vec<[V3; 3]>,
    lens: super::camera::Lens,
    pub(super) light: Light,
    directions: Directions,
    floor: f32,
    middle: V3,
    radius: f32,
    /// The most samples of a pixel.
    pub(super) samples: usize,
    /// Pixels across.
    pub(super) width: usize,
    height: usize,
}

impl Stage {
    /// Builds the trees; `None` for an unusable camera.
    pub fn new(surfaces: &[Surface], ghost: Option<&Surface>, shot: &Shot) -> Option<Stage> {
        let parts: Vec<[V3; 3]> = surfaces.iter().flat_map(corners).collect();
        let shell: Vec<[V3; 3]> = ghost.into_iter().flat_map(corners).collect();
        let aspect = shot.width as f32 / shot.height as f32;
        let camera = shot.camera.unwrap_or_else(|| {
            let points: Vec<[f32; 3]> = parts.iter().chain(&shell).flatten().map(|&p| p.into()).collect();
            Camera::framing(&points, View::default(), aspect)
        });
        let lens = camera.lens(aspect);
        let numbers = [lens.eye.x + lens.eye.y + lens.eye.z, lens.right.norm(), lens.half_height];
        if numbers.iter().any(|n| !n.is_finite()) || lens.right.norm() < 0.5 || lens.half_height <= 0.0 {
            return None;
        }
        // The scene's extent sets offsets, reaches and the shadow's fade; a picture of a ghost alone uses its extent.
        let extent = if parts.is_empty() { &shell } else { &parts };
        let (lo, hi) = extent
            .iter()
            .flatten()
            .fold((V3::splat(f32::MAX), V3::splat(f32::MIN)), |(lo, hi), &p| (lo.min(p), hi.max(p)));
        let (lo, hi) = if extent.is_empty() { (V3::splat(-1.0), V3::splat(1.0)) } else { (lo, hi) };
        Some(Stage {
            tree: Bvh::new(&parts),
            ghost: Bvh::new(&shell),
            normals: surfaces.iter().flat_map(corner_normals).collect(),
            owner: surfaces
                .iter()
                .zip(0..)
                .flat_map(|(s, k)| std::iter::repeat_n(k, s.faces.len()))
                .collect(),
            paints: surfaces
                .iter()
                .map(|s| Paint {
                    color: tone::linear(s.color),
                    gloss: s.gloss.clamp(0.0, 1.0),
                    metal: s.metal.clamp(0.0, 1.0),
                    rough: if s.pitch > 0.0 { s.rough.clamp(0.0, 1.0) } else { 0.0 },
                    pitch: s.pitch,
                })
                .collect(),
            ghost_normals: ghost.into_iter().flat_map(corner_normals).collect(),
            lens,
            light: Light::studio(lens.forward),
            directions: Directions::new(shot.samples),
            floor: shot.floor.unwrap_or(lo.y),
            middle: (lo + hi) * 0.5,
            radius: ((hi - lo).norm() * 0.5).max(1e-6),
            samples: shot.samples,
            width: shot.width,
            height: shot.height,
        })
    }

    /// Adds the samples with the given numbers to a pixel.
    pub fn cast(&self, pixel: &mut Pixel, column: usize, row: usize, numbers: Range<usize>) {
        pixel.samples = numbers.end as f32;
        for s in numbers {
            let [dx, dy] = self.directions.in_pixel(s);
            let x = 2.0 * (column as f32 + dx) / self.width as f32 - 1.0;
            let y = 1.0 - 2.0 * (row as f32 + dy) / self.height as f32;
            self.sample(pixel, column, row, s, self.lens.direction(x, y).unit());
        }
    }

    fn sample(&self, pixel: &mut Pixel, column: usize, row: usize, s: usize, direction: V3) {
        let eye = self.lens.eye;
        let hit = self.tree.hit(eye, direction, f32::INFINITY);
        let fall = (self.floor - eye.y) / direction.y;
        let floor = if fall > 0.0 && fall.is_finite() { fall } else { f32::INFINITY };
        // Parts hide the ghost; the invisible floor does not.
        let mut front = f32::INFINITY;
        match hit {
            // A camera below the floor looks through it.
            Some(hit) if hit.t <= floor || eye.y < self.floor => {
                front = hit.t;
                let face = hit.triangle as usize;
                let [a, b, c] = self.normals[face];
                let mut normal = (a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v).unit();
                if normal.dot(direction) > 0.0 {
                    // Seen from behind, or a smooth normal that leans over the edge: bring it back to the eye's side.
                    normal = if normal.dot(direction) > 0.35 { -normal } else { lean(normal, direction) };
                }
                let point = eye + direction * hit.t;
                let paint = &self.paints[self.owner[face] as usize];
                self.light_body(&mut pixel.body, paint, direction, point, normal);
                self.grain(&mut pixel.body_grain, column, row, s, point, normal, hit.t);
            }
            _ if floor.is_finite() && eye.y > self.floor => {
                let point = eye + direction * floor;
                pixel.floor += 1.0;
                let from = v3(point.x - self.middle.x, 0.0, point.z - self.middle.z).norm();
                let fade = 1.0 - ((from / self.radius - 1.2) / 2.2).clamp(0.0, 1.0);
                pixel.fade += fade * fade * (3.0 - 2.0 * fade);
                if fade > 0.0 {
                    self.grain(&mut pixel.floor_grain, column, row, s, point, v3(0.0, 1.0, 0.0), floor);
                }
            }
            _ => {}
        }
        if let Some(hit) = self.ghost.hit(eye, direction, f32::INFINITY) {
            let [a, b, c] = self.ghost_normals[hit.triangle as usize];
            let normal = (a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v).unit();
            let facing = normal.dot(direction).abs();
            let shell = &mut pixel.shell;
            shell.count += 1.0;
            shell.normal = shell.normal + normal;
            shell.depth += hit.t / self.radius;
            if hit.t < front {
                shell.visible += 1.0;
                // Thinner over parts, whose colours should come through.
                let thin = if front.is_finite() { 0.5 } else { 1.0 };
                shell.opacity += thin * (0.055 + 0.42 * (1.0 - facing).powi(3));
            }
        }
    }

    /// Adds the factors of a part's colour.
    fn light_body(&self, body: &mut Body, look: &Paint, direction: V3, point: V3, smooth: V3) {
        let light = &self.light;
        let (mut normal, mut paint) = (smooth, look.color);
        if look.rough > 0.0 {
            // Bumps turn the normal, and hollows are darker than ridges.
            let (height, slope) = bump::field(point / look.pitch);
            normal = (smooth - (slope - smooth * slope.dot(smooth)) * (0.5 * look.rough)).unit();
            paint = paint * (1.0 + 0.45 * look.rough * height);
        }
        let facing = if smooth.dot(light.sun) > 0.0 { normal.dot(light.sun).max(0.0) } else { 0.0 };
        let half = (light.sun - direction).unit();
        let grazing = (1.0 + direction.dot(normal)).clamp(0.0, 1.0);
        let fresnel = look.gloss * (0.05 + 0.55 * grazing.powi(4));
        // Metal mirrors by its colour, but for grazing light, and has no paint.
        let tinted = paint.lerp(V3::splat(1.0), grazing.powi(5)) * (0.6 + 0.4 * look.gloss);
        let mirror = V3::splat(fresnel).lerp(tinted, look.metal);
        let mirrored = direction - normal * (2.0 * direction.dot(normal));
        let highlight =
            if facing > 0.0 { 0.45 * look.gloss * normal.dot(half).max(0.0).powi(48) } else { 0.0 };
        let highlight = V3::splat(highlight).lerp(paint * (4.0 * highlight), look.metal);
        let paint = paint * (1.0 - METAL * look.metal);
        let sunlit = (paint * facing + highlight).tint(light.strength);
        let open = paint.tint(light.open_sky(normal));
        let bright = (sunlit + open).luminance();
        body.darkest = if body.count == 0.0 { bright } else { least(body.darkest, bright) };
        body.brightest = most(body.brightest, bright);
        body.count += 1.0;
        body.paint = body.paint + paint;
        body.sunlit = body.sunlit + sunlit;
        body.open = body.open + open;
        body.shine = body.shine + light.sky(mirrored).tint(mirror);
    }

    /// Adds the sun and sky that this sample sees from a point.
    #[expect(clippy::too_many_arguments, reason = "one sample's coordinates")]
    fn grain(
        &self,
        grain: &mut Grain,
        column: usize,
        row: usize,
        s: usize,
        point: V3,
        normal: V3,
        distance: f32,
    ) {
        let start = point + normal * (3e-4 * self.radius);
        grain.normal = grain.normal + normal;
        grain.point = grain.point + point;
        grain.footprint += 2.0 * self.lens.half_height * distance / self.height as f32;
        grain.count += 1.0;
        // Samples alternate: one tests the sky, the next the sun. Smoothing compensates for it.
        let (turn, both) = (s / 2, self.samples == 1);
        if both || s.is_multiple_of(2) {
            grain.sky_weight += 1.0;
            grain.blocked = grain.blocked + self.blocked_sky(start, normal, column, row, turn);
        }
        if (both || !s.is_multiple_of(2)) && normal.dot(self.light.sun) > 0.0 {
            grain.sun_weight += 1.0;
            let sunward = self.directions.sunward(&self.light, column, row, turn);
            if !self.tree.blocked(start, sunward, f32::INFINITY) {
                grain.sun += 1.0;
            }
        }
    }

    /// The blocked sky light from one direction about the normal, less the light that the blocker reflects.
    fn blocked_sky(&self, start: V3, normal: V3, column: usize, row: usize, turn: usize) -> V3 {
        let direction = self.directions.about(normal, column, row, turn);
        let reach = 1.3 * self.radius;
        if let Some(hit) = self.tree.hit(start, direction, reach) {
            // Far blockers matter less than in a closed room: they are lit themselves.
            let near = 1.0 - hit.t / reach;
            let other = self.paints[self.owner[hit.triangle as usize] as usize].color;
            let back = other.tint(self.light.open_sky(-direction)) * BOUNCE;
            return (self.light.sky(direction) - back) * (near * (2.0 - near));
        }
        if direction.y < 0.0 && start.y > self.floor {
            // The floor below a part lies in the part's own shadow: less light comes up the closer it is.
            let height = (start.y - self.floor) / (0.35 * self.radius);
            return self.light.sky(direction) * (-0.75 * direction.y / (1.0 + height * height));
        }
        V3::ZERO
    }
}

/// A normal turned just far enough to be seen edge-on.
fn lean(normal: V3, direction: V3) -> V3 {
    (normal - direction * (normal.dot(direction) + 1e-3)).unit()
}

/// The normals at the corners of each face.
fn corner_normals(surface: &Surface) -> Vec<[V3; 3]> {
    let smooth = surface.normals.len() == surface.vertices.len() && !surface.normals.is_empty();
    let flat = !smooth && surface.normals.len() == surface.faces.len();
    surface
        .faces
        .iter()
        .enumerate()
        .map(|(k, face)| {
            if smooth {
                return face.map(|i| V3::from(surface.normals[i as usize]));
            }
            let [a, b, c] = face.map(|i| V3::from(surface.vertices[i as usize]));
            [if flat { V3::from(surface.normals[k]) } else { (b - a).cross(c - a).unit() }; 3]
        })
        .collect()
}
