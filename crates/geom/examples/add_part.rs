//! The cost of a part of a spaceship for a particle: copy the sketches, make the shapes, add them, read the score.
//!
//! `cargo run --release -p niwaki-geom --example add_part`
//!
//! Input: 2000 forward ships (about 16 parts each) against a block in a grid of 75 x 14 x 62 cells, surface rule.
//! The scores are checked against sketches that were never copied. Prints microseconds for each part: the mean and
//! the 50th and 95th percentile over ships.

#[path = "../tests/scenes/mod.rs"]
mod scenes;

use niwaki_geom::{Look, Primitive, Rule, Shape, Sketches, Target, match_volume, no_self_intersection, vec3};
use scenes::{Dice, ship::ship};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

fn main() {
    let block = Shape::cuboid(vec3(0.03, 0.36, -2.29), vec3(18.44, 3.24, 15.22), &Look::default());
    let target = Target::new(block.expect("a block").world_mesh().clone(), 0.25).expect("a target");
    assert_eq!(target.grid().dims(), [75, 14, 62]);
    let volume = match_volume(Arc::new(target), 0.02).expect("a sketch");
    let intersection = no_self_intersection(Rule::Surface);
    for (name, specs) in [
        ("both sketches", vec![intersection.clone(), volume.clone()]),
        ("no_self_intersection", vec![intersection]),
        ("match_volume", vec![volume]),
    ] {
        let mut dice = Dice::new(4);
        let mut prices: Vec<f64> = Vec::new();
        let (mut parts, mut total) = (0, 0.0);
        for _ in 0..2000 {
            let ship = ship(&mut dice);
            let mut plain = Sketches::start(&specs);
            let mut particle = plain.fork();
            let started = Instant::now();
            for part in &ship {
                let shapes: Vec<Shape> = part.shapes().iter().map(again).collect();
                let mut next = particle.fork();
                next.add(&Primitive::new(shapes));
                black_box(next.log_score());
                // The parent exists until its child is done, so nothing is changed in place.
                particle = next;
            }
            let spent = started.elapsed().as_secs_f64() * 1e6;
            for part in &ship {
                plain.add(part);
            }
            assert_eq!(plain.log_score().to_bits(), particle.log_score().to_bits());
            prices.push(spent / ship.len() as f64);
            parts += ship.len();
            total += spent;
        }
        prices.sort_by(f64::total_cmp);
        let (half, most) = (prices[1000], prices[1900]);
        println!(
            "{name}: {:.2} us for each part, median {half:.2}, 95th percentile {most:.2}",
            total / parts as f64
        );
    }
    let mut dice = Dice::new(4);
    let shapes: Vec<Shape> =
        (0..200).flat_map(|_| ship(&mut dice)).flat_map(|p| p.shapes().to_vec()).collect();
    for kind in ["box", "tapered-box", "cylinder", "tapered-cylinder"] {
        let some: Vec<&Shape> = shapes.iter().filter(|s| s.kind() == kind).collect();
        let started = Instant::now();
        for _ in 0..20 {
            some.iter().for_each(|s| drop(black_box(again(s))));
        }
        println!("make a {kind}: {:.2} us", started.elapsed().as_secs_f64() * 1e6 / (20 * some.len()) as f64);
    }
    let limb = |k: usize| {
        let (end, direction) = (vec3(0.1, 3.0, 0.01 * k as f64), vec3(0.1, 1.0, 0.2));
        Shape::limb(vec3(0.0, 0.0, 0.0), end, (1.0, 0.8), (None, Some(direction)), &Look::default())
    };
    let started = Instant::now();
    (0..20000).for_each(|k| drop(black_box(limb(k))));
    println!("make a limb: {:.2} us", started.elapsed().as_secs_f64() * 1e6 / 20000.0);
}

fn again(shape: &Shape) -> Shape {
    Shape::new(shape.solid().clone(), shape.placement(), &Look::default()).expect("it was made before")
}
