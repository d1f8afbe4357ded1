//! The cost of a stroke of a drawing for a particle: copy the sketch, make the shape, add it, read the score.
//!
//! `cargo run --release -p niwaki-geom --example add_stroke`
//!
//! Input: 200 walks of 100 strokes, 2 long and 0.75 wide, in a window of 24 by 24. Prints microseconds for each stroke:
//! added to a copy, as particles do, and taken out again, as chains do. The scores are checked against sketches that
//! were never copied.

use niwaki_geom::{
    Drawing, Look, Page, Primitive, Shape, SketchSpec, Sketches, Texture, fill_drawing, match_drawing, vec3,
};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

fn main() {
    for side in [50, 100, 200] {
        let page = Page::new([-12.0, -2.0], [12.0, 22.0], [side, side]).expect("a page");
        let greys: Vec<u8> = (0..side * side).map(|p| if p / side % 3 == 0 { 0 } else { 255 }).collect();
        let drawing = Drawing::new(page.clone(), &greys).expect("a drawing");
        measure("match_drawing", side, &match_drawing(Arc::new(drawing), 0.014).expect("a sketch"));
        let texture = Texture { page, share: 0.5, sigma: 0.007 };
        measure("fill_drawing", side, &fill_drawing(texture).expect("a sketch"));
    }
}

fn measure(name: &str, side: usize, spec: &Arc<dyn SketchSpec>) {
    let specs = std::slice::from_ref(spec);
    let (mut added, mut removed, mut count) = (0.0, 0.0, 0);
    for walk in 0..200_u32 {
        let (mut at, mut turn) = (vec3(0.0, 10.0, 0.0), f64::from(walk));
        let mut plain = Sketches::start(specs);
        let mut particle = plain.fork();
        let mut strokes = Vec::new();
        for step in 0..100_u32 {
            turn += f64::from((walk * 31 + step * 17) % 13) / 6.0 - 1.0;
            let ahead = vec3(turn.cos(), turn.sin(), 0.0) * 2.0;
            // Back to the middle at the border.
            let end = if (at + ahead).norm() > 20.0 { vec3(0.0, 10.0, 0.0) } else { at + ahead };
            let started = Instant::now();
            let shape = Shape::stroke(at, end, (0.75, 0.73), &Look::default()).expect("a stroke");
            let stroke = Primitive::new([shape]);
            let mut next = particle.fork();
            next.add(&stroke);
            black_box(next.log_score());
            // The parent exists until its child is done, so nothing is changed in place.
            particle = next;
            added += started.elapsed().as_secs_f64() * 1e6;
            plain.add(&stroke);
            strokes.push(stroke);
            at = end;
            count += 1;
        }
        assert_eq!(plain.log_score().to_bits(), particle.log_score().to_bits());
        plain.expect_removals();
        let started = Instant::now();
        for stroke in &strokes {
            assert!(plain.remove(stroke));
            black_box(plain.log_score());
        }
        removed += started.elapsed().as_secs_f64() * 1e6;
    }
    let each = f64::from(count);
    println!("{name}, {side} x {side}: {:.2} us to add, {:.2} us to remove", added / each, removed / each);
}
