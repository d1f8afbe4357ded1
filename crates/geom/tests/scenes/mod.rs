//! Random shapes for tests, from a small generator of their own, so that a seed always gives the same scene.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

// Each test file uses a part of it.
#![allow(dead_code)]

pub mod building;
pub mod ship;

use niwaki_geom::solids::{Extrusion, PointHull, Revolution, Sweep};
use niwaki_geom::{Look, Mat3, Shape, TriMesh, Vec3, vec3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// SplitMix64: enough randomness for a test.
pub struct Dice(u64);

impl Dice {
    /// From a seed.
    pub fn new(seed: u64) -> Dice {
        Dice(seed)
    }

    /// In `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In `[low, high)`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// An integer below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    /// Entries in `[-reach, reach)`.
    pub fn point(&mut self, reach: f64) -> Vec3 {
        vec3(self.uniform(-reach, reach), self.uniform(-reach, reach), self.uniform(-reach, reach))
    }
}

/// A ring of `tube` sides around a circle of `around` sides in the x-z plane.
pub fn torus(radius: f64, thickness: f64, around: usize, tube: usize) -> TriMesh {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..around {
        let (s, c) = (TAU * i as f64 / around as f64).sin_cos();
        for j in 0..tube {
            let (sin, cos) = (TAU * j as f64 / tube as f64).sin_cos();
            let r = radius + thickness * cos;
            vertices.push(vec3(r * s, thickness * sin, r * c));
            let at = |i: usize, j: usize| ((i % around) * tube + j % tube) as u32;
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    TriMesh::new(vertices, triangles).unwrap()
}

/// A polygon around the origin, between this radius and three times as far.
fn star(dice: &mut Dice, radius: f64) -> impl Iterator<Item = [f64; 2]> {
    (0..7).map(move |k| {
        let (sin, cos) = (TAU * f64::from(k) / 7.0).sin_cos();
        let reach = radius * dice.uniform(1.0, 3.0);
        [reach * cos, reach * sin]
    })
}

/// A shape of any kind with its centre within `reach` of the origin, one time in two along the axes.
pub fn any_shape(dice: &mut Dice, reach: f64) -> Shape {
    let center = dice.point(reach);
    let rotation = (dice.below(2) == 0)
        .then(|| Mat3::rotation(dice.point(1.0).unit().unwrap_or(Vec3::AXES[0]), dice.uniform(0.0, TAU)));
    let look = Look { rotation, ..Look::default() };
    let size = vec3(dice.uniform(0.1, 3.0), dice.uniform(0.1, 3.0), dice.uniform(0.1, 3.0));
    let axis = Vec3::AXES[dice.below(3)];
    let shape = match dice.below(10) {
        0 => Shape::cuboid(center, size, &look),
        1 => Shape::tapered_box(center, size, [0.0, 0.3, 1.7][dice.below(3)], dice.below(3), &look),
        2 => Shape::cylinder(center, 0.5 * size.x, size.y, axis, None, &look),
        3 => Shape::cylinder(center, 0.5 * size.x, size.y, axis, Some([0.0, 0.2, 1.0][dice.below(3)]), &look),
        4 => {
            let end = center + dice.point(2.0);
            let bend = dice.point(0.3) + (end - center) * 0.5;
            Shape::limb(center, end, (0.3 * size.x, 0.3 * size.y), (None, Some(bend)), &look)
        }
        5 => {
            let solid = Extrusion {
                polygon: star(dice, 0.4 * size.x).collect(),
                height: size.y,
                twist: [0.0, 0.0, dice.uniform(-2.0, 2.0)][dice.below(3)],
                taper: [0.0, 1.0, dice.uniform(0.2, 1.5)][dice.below(3)],
            };
            Shape::placed(Arc::new(solid).into(), center, Mat3::between(Vec3::AXES[1], axis), &look)
        }
        6 => {
            let (wide, thick) = (0.5 * size.x, dice.uniform(0.05, 0.4));
            let high = size.y;
            let profile = [
                [0.0, 0.0],
                [wide, 0.0],
                [1.3 * wide, high],
                [(1.3 - thick) * wide, high],
                [(1.0 - thick) * wide, 0.2 * high],
                [0.0, 0.2 * high],
            ];
            let solid = Revolution { profile: profile.into() };
            Shape::placed(Arc::new(solid).into(), center, Mat3::between(Vec3::AXES[1], axis), &look)
        }
        7 => {
            let (reach, turn) = (dice.uniform(0.1, 0.3), dice.uniform(0.2, 0.7));
            let at = |k: usize| {
                let (sin, cos) = (turn * k as f64).sin_cos();
                vec3(size.x * cos, 0.2 * size.y * k as f64, size.x * sin) * 0.5
                    + vec3(0.3, 0.1, 0.2) * k as f64
            };
            let solid = Sweep {
                profile: star(dice, 0.2 * reach).collect(),
                path: (0..5).map(at).collect(),
                scale: [0.0, 1.0, 1.5][dice.below(3)],
            };
            Shape::placed(Arc::new(solid).into(), center, Mat3::IDENTITY, &look)
        }
        8 => {
            let solid = PointHull { points: (0..4 + dice.below(6)).map(|_| dice.point(1.0)).collect() };
            Shape::placed(Arc::new(solid).into(), center, Mat3::IDENTITY, &look)
        }
        _ => {
            let ring = Arc::new(torus(1.0, 0.1 + 0.25 * dice.unit(), 9, 5));
            Shape::mesh(&ring, center, dice.uniform(0.5, 2.0), &look)
        }
    };
    shape.expect("a shape within its rules")
}
