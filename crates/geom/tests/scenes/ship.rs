//! A forward sampler of the spaceship (dissertation fig. 5.1): parts in the order of depth-first execution.

use super::Dice;
use niwaki_geom::{Look, Primitive, Shape, vec3};

impl Dice {
    fn flip(&mut self, p: f64) -> bool {
        self.unit() < p
    }
}

fn cuboid(x: f64, y: f64, z: f64, size: [f64; 3]) -> Shape {
    Shape::cuboid(vec3(x, y, z), size.into(), &Look::default()).unwrap()
}

fn rod(x: f64, y: f64, z: f64, r: f64, length: f64, top: Option<f64>) -> Shape {
    Shape::cylinder(vec3(x, y, z), r, length, vec3(0.0, 0.0, 1.0), top, &Look::default()).unwrap()
}

#[derive(Clone, Copy, PartialEq)]
enum Part {
    None,
    Box,
    Cylinder,
    Cluster,
}

fn box_size(dice: &mut Dice, before: (Part, f64, f64)) -> (f64, f64) {
    let x = dice.uniform(1.0, 3.0);
    let y = dice.uniform(0.5, 1.0) * x;
    if before.0 == Part::Box { (x, y) } else { (x.max(before.1), y.max(before.1)) }
}

/// The parts of one ship, tail first.
pub fn ship(dice: &mut Dice) -> Vec<Primitive> {
    let mut parts = Vec::new();
    let (mut rear, mut before) = (-5.0, (Part::None, -1.0, -1.0));
    for i in 0.. {
        let part = [Part::Box, Part::Cylinder, Part::Cluster][dice.below(3)];
        let limit = 0.5 * f64::min(before.1, before.2);
        let (x, y, length);
        match part {
            Part::Cylinder => {
                let (low, high) = if before.0 == Part::Box { (0.4 * limit, limit) } else { (0.3, 1.25) };
                let r = dice.uniform(low, high);
                (x, y, length) = (2.0 * r, 2.0 * r, dice.uniform(2.0, 5.0));
                parts.push(Primitive::new([rod(0.0, 0.0, rear + length / 2.0, r, length, None)]));
            }
            Part::Cluster => {
                let limit = 0.5 * limit;
                let (low, high) = if before.0 == Part::Box { (0.4 * limit, limit) } else { (0.15, 0.625) };
                let r = dice.uniform(low, high);
                (x, y, length) = (4.0 * r, 4.0 * r, dice.uniform(2.0, 5.0));
                let at = |sx: f64, sy: f64| rod(sx * r, sy * r, rear + length / 2.0, r, length, None);
                parts.push(Primitive::new([at(1.0, 1.0), at(-1.0, 1.0), at(1.0, -1.0), at(-1.0, -1.0)]));
            }
            _ => {
                (x, y) = box_size(dice, before);
                length = dice.uniform(2.0, 5.0);
                parts.push(Primitive::new([cuboid(0.0, 0.0, rear + length / 2.0, [x, y, length])]));
            }
        }
        before = (part, x, y);
        rear += length;
        if dice.flip((-0.5 * (i + 1) as f64).exp()) {
            wing(dice, x / 2.0, rear - length + 0.5, rear - 0.5, &mut parts);
        }
        if dice.flip(0.7) {
            fin(dice, y / 2.0, rear - length, rear, 0.6 * x, &mut parts);
        }
        if !dice.flip((-0.4 * i as f64).exp()) {
            break;
        }
    }
    if dice.flip(0.75) {
        let (x, y) = box_size(dice, before);
        let (length, taper) = (dice.uniform(1.0, 3.0), dice.uniform(0.25, 0.75));
        let (center, size) = (vec3(0.0, 0.0, rear + length / 2.0), vec3(x, y, length));
        parts.push(Primitive::new([Shape::tapered_box(center, size, taper, 2, &Look::default()).unwrap()]));
    }
    parts
}

fn wing(dice: &mut Dice, mut base: f64, mut low: f64, mut high: f64, parts: &mut Vec<Primitive>) {
    for j in 0.. {
        let boxed = dice.below(2) == 0;
        let z = dice.uniform(low, high);
        let (x, length);
        if boxed {
            x = dice.uniform(0.25, 2.0);
            let y = dice.uniform(0.25, 1.25);
            length = dice.uniform(0.5, 4.0);
            let side = base + x / 2.0;
            parts.push(Primitive::new([-side, side].map(|at| cuboid(at, 0.0, z, [x, y, length]))));
            if dice.flip(0.5) {
                let gun = dice.uniform(1.0, 1.2) * length;
                let mut guns = Vec::new();
                for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
                    let (gx, gy) = (sx * side, sy * (y / 2.0 + 0.15));
                    guns.push(rod(gx, gy, z, 0.15, gun, None));
                    guns.push(rod(gx, gy, z + gun / 2.0 + 0.2, 0.15, 0.4, Some(0.03)));
                }
                parts.push(Primitive::new(guns));
            }
        } else {
            let r = dice.uniform(0.15, 0.7);
            (x, length) = (2.0 * r, dice.uniform(1.0, 5.0));
            parts.push(Primitive::new([-base - r, base + r].map(|at| rod(at, 0.0, z, r, length, None))));
        }
        base += x;
        (low, high) = (z - length / 2.0, z + length / 2.0);
        if !dice.flip((-0.6 * j as f64).exp()) {
            return;
        }
    }
}

fn fin(dice: &mut Dice, mut base: f64, low: f64, high: f64, mut widest: f64, parts: &mut Vec<Primitive>) {
    let (middle, mut length) = ((low + high) / 2.0, high - low);
    for j in 0.. {
        let x = dice.uniform(0.5, 1.0) * widest;
        widest = x;
        let y = dice.uniform(0.1, 0.5);
        length *= dice.uniform(0.5, 1.0);
        parts.push(Primitive::new([cuboid(0.0, base + y / 2.0, middle, [x, y, length])]));
        base += y;
        if !dice.flip((-0.2 * j as f64).exp()) {
            return;
        }
    }
}
