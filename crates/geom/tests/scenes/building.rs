//! A forward sampler of the building complex (dissertation fig. 5.3): towers with further towers on their first storey.

use super::Dice;
use niwaki_geom::{Look, Primitive, Shape, Vec3, vec3};

/// A rectangle on the ground: low and high x, low and high z.
type Lot = [f64; 4];

/// The side that a tower came from and is flush against: index into its lot.
type From = Option<usize>;

/// The parts of one complex, depth first.
pub fn building(dice: &mut Dice) -> Vec<Primitive> {
    let mut parts = Vec::new();
    tower(dice, 0, [-2.0, 2.0, -2.0, 2.0], None, &mut parts);
    parts
}

fn tower(dice: &mut Dice, depth: usize, lot: Lot, from: From, parts: &mut Vec<Primitive>) {
    let round = dice.unit() < 0.5;
    let mut current = lot;
    let mut floor = 0.0;
    let upright = Vec3::AXES[1];
    for i in 0.. {
        let (width, depth_z) = (current[1] - current[0], current[3] - current[2]);
        let (w, d, h, r);
        if round {
            r = dice.uniform(0.5, 1.0) * 0.5 * width.min(depth_z);
            h = dice.uniform(1.0, 3.0);
            (w, d) = (2.0 * r, 2.0 * r);
        } else {
            r = 0.0;
            w = dice.uniform(0.5, 1.0) * width;
            d = dice.uniform(0.5, 1.0) * depth_z;
            h = dice.uniform(1.0, 3.0);
        }
        let mut x = 0.5 * (current[0] + current[1]);
        let mut z = 0.5 * (current[2] + current[3]);
        if i == 0 {
            match from {
                Some(0) => x = current[0] + 0.5 * w,
                Some(1) => x = current[1] - 0.5 * w,
                Some(2) => z = current[2] + 0.5 * d,
                Some(_) => z = current[3] - 0.5 * d,
                None => (),
            }
        }
        let center = vec3(x, floor + 0.5 * h, z);
        let shape = if round {
            Shape::cylinder(center, r, h, upright, None, &Look::default())
        } else {
            Shape::cuboid(center, vec3(w, h, d), &Look::default())
        };
        parts.push(Primitive::new([shape.unwrap()]));
        let placed = [x - 0.5 * w, x + 0.5 * w, z - 0.5 * d, z + 0.5 * d];
        if i == 0 {
            let (lot_x, lot_z) = (lot[1] - lot[0], lot[3] - lot[2]);
            let neighbours = [
                [placed[0] - lot_x, placed[0], lot[2], lot[3]],
                [placed[1], placed[1] + lot_x, lot[2], lot[3]],
                [lot[0], lot[1], placed[2] - lot_z, placed[2]],
                [lot[0], lot[1], placed[3], placed[3] + lot_z],
            ];
            for (side, next) in neighbours.into_iter().enumerate() {
                if from != Some(side) && dice.unit() < 0.5 - 0.05 * depth as f64 {
                    // The child's facing side is the opposite one.
                    tower(dice, depth + 1, next, Some(side ^ 1), parts);
                }
            }
        }
        current = placed;
        floor += h;
        if dice.unit() >= (-0.4 * i as f64).exp() {
            break;
        }
    }
    if dice.unit() < 0.5 {
        let h = dice.uniform(0.5, 1.5);
        let top = dice.uniform(0.1, 0.5);
        let (w, d) = (current[1] - current[0], current[3] - current[2]);
        let center = vec3(0.5 * (current[0] + current[1]), floor + 0.5 * h, 0.5 * (current[2] + current[3]));
        let cap = if round {
            Shape::cylinder(center, 0.5 * w, h, upright, Some(0.5 * w * top), &Look::default())
        } else {
            Shape::tapered_box(center, vec3(w, h, d), top, 1, &Look::default())
        };
        parts.push(Primitive::new([cap.unwrap()]));
    }
}
