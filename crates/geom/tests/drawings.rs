//! Drawings agree to the pixel with a renderer that tries many points of every pixel, and score with the published
//! formulas, in any order of adding and removing.
//!
//! The renderer shares no code with the engine's: a stroke is all points near enough to one of its discs, an ellipse all
//! that satisfy its equation.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::{
    Drawing, DrawingMatch, Look, Page, Primitive, Shape, Sketch, Texture, TextureMatch, Vec3, match_drawing,
    vec3,
};
use scenes::{Dice, any_shape};
use std::sync::Arc;

/// A shape, and how far a point is outside of it: below zero inside. For an ellipse the distance is in shares of its
/// smaller half axis.
struct Known {
    shape: Shape,
    outside: Box<dyn Fn([f64; 2]) -> f64>,
    /// The upper bound of a distance of one scene unit.
    unit: f64,
}

fn stroke(dice: &mut Dice, reach: f64) -> Known {
    let point = |dice: &mut Dice| [dice.uniform(-reach, reach), dice.uniform(-reach, reach)];
    let (a, b) = (point(dice), if dice.below(5) == 0 { [0.3, 0.2] } else { point(dice) });
    let b = if dice.below(6) == 0 { [a[0] + 0.3 * b[0] / reach, a[1] + 0.3 * b[1] / reach] } else { b };
    let b = match dice.below(9) {
        0 => [a[0], b[1]],
        1 => [b[0], a[1]],
        2 => a,
        _ => b,
    };
    let widths = (dice.uniform(0.02, 1.5), dice.uniform(0.02, 1.5));
    let widths = if dice.below(2) == 0 { (widths.0, widths.0) } else { widths };
    let shape =
        Shape::stroke(vec3(a[0], a[1], 0.1), vec3(b[0], b[1], 0.1), widths, &Look::default()).unwrap();
    let outside = move |p: [f64; 2]| {
        // Distance to the disc at `t`: convex in t, so halving the interval by thirds finds the least.
        let at = |t: f64| {
            let c = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            (p[0] - c[0]).hypot(p[1] - c[1]) - 0.5 * (widths.0 + t * (widths.1 - widths.0))
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let (s, t) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(s) < at(t) { high = t } else { low = s }
        }
        at(low).min(at(0.0)).min(at(1.0))
    };
    Known { shape, outside: Box::new(outside), unit: 1.0 }
}

fn ellipse(dice: &mut Dice, reach: f64) -> Known {
    let center = [dice.uniform(-reach, reach), dice.uniform(-reach, reach)];
    let (long, wide) = (dice.uniform(0.05, 2.5), dice.uniform(0.05, 2.5));
    let angle = if dice.below(4) == 0 { 0.0 } else { dice.uniform(-4.0, 4.0) };
    let at = vec3(center[0], center[1], 0.0);
    let shape = Shape::ellipse(at, (long, wide), angle, &Look::default()).unwrap();
    let outside = move |p: [f64; 2]| {
        let (x, y) = (p[0] - center[0], p[1] - center[1]);
        let (u, v) = (x * angle.cos() + y * angle.sin(), y * angle.cos() - x * angle.sin());
        (2.0 * u / long).hypot(2.0 * v / wide) - 1.0
    };
    Known { shape, outside: Box::new(outside), unit: 2.0 / long.min(wide) }
}

fn any_page(dice: &mut Dice) -> Page {
    let low = [dice.uniform(-2.5, -1.5), dice.uniform(-2.5, -1.5)];
    let high = [dice.uniform(1.5, 2.5), dice.uniform(1.5, 2.5)];
    Page::new(low, high, [15 + dice.below(80), 5 + dice.below(70)]).unwrap()
}

/// The middle of cell (column, row) of a page that is cut into `size` cells.
fn middle(page: &Page, size: [usize; 2], cell: [usize; 2]) -> [f64; 2] {
    let (low, high) = (page.low(), page.high());
    let across = (cell[0] as f64 + 0.5) / size[0] as f64;
    let down = (cell[1] as f64 + 0.5) / size[1] as f64;
    [low[0] + across * (high[0] - low[0]), high[1] - down * (high[1] - low[1])]
}

#[test]
fn touched_pixels_are_those_with_a_point_inside() {
    const FINE: usize = 12;
    let mut dice = Dice::new(11);
    let mut border = 0;
    for k in 0..32 {
        let page = any_page(&mut dice);
        let known = if k % 2 == 0 { stroke(&mut dice, 2.2) } else { ellipse(&mut dice, 2.2) };
        let touched = page.touched(&known.shape);
        let on: std::collections::HashSet<usize> = touched.rays().collect();
        assert!(
            touched.words().windows(2).all(|w| w[0].0 < w[1].0) && touched.words().iter().all(|w| w.1 != 0)
        );
        let [columns, rows] = page.size();
        let fine = [columns * FINE, rows * FINE];
        let corner = {
            let (a, b) = (middle(&page, fine, [0, 0]), middle(&page, fine, [1, 1]));
            0.5 * (a[0] - b[0]).hypot(a[1] - b[1])
        };
        for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
            let (word, bit) = page.bit(column, row);
            let is_on = on.contains(&(word * 64 + bit));
            // Of a pixel that is far away, or in the middle of the shape, its own middle tells enough.
            let far = (known.outside)(middle(&page, [columns, rows], [column, row]));
            if far < 0.0 || far > 2.0 * FINE as f64 * corner * known.unit {
                assert_eq!(is_on, far < 0.0);
                continue;
            }
            let least = (0..FINE * FINE)
                .map(|n| [column * FINE + n % FINE, row * FINE + n / FINE])
                .map(|cell| (known.outside)(middle(&page, fine, cell)))
                .fold(f64::INFINITY, f64::min);
            if is_on {
                assert!(least < corner * known.unit * 1.0001, "{k}: ({column}, {row}) is far: {least}");
                border += usize::from(least > 0.0);
            } else {
                assert!(least > -1e-9, "{k}: ({column}, {row}) is inside: {least}");
            }
        }
        assert!(on.iter().all(|n| n % 64 + n / 64 / 64 % columns.div_ceil(64) * 64 < columns));
    }
    assert!(border > 5, "pixels that are touched between the tried points");
}

#[test]
fn samples_are_covered_where_the_equation_holds() {
    let mut dice = Dice::new(12);
    for k in 0..10 {
        let page = any_page(&mut dice);
        let known = if k % 2 == 0 { stroke(&mut dice, 2.2) } else { ellipse(&mut dice, 2.2) };
        let on: std::collections::HashSet<usize> = page.sampled(&known.shape).rays().collect();
        let [columns, rows] = page.size();
        let fine = [columns * 8, rows * 8];
        let mut held = 0;
        for (x, y) in (0..fine[1]).flat_map(|y| (0..fine[0]).map(move |x| (x, y))) {
            let far = (known.outside)(middle(&page, fine, [x, y]));
            let ray = page.sampled_word(x / 8, y / 8) * 64 + y % 8 * 8 + x % 8;
            assert!(far.abs() < 1e-9 || (far < 0.0) == on.contains(&ray), "{k}: ({x}, {y}) {far}");
            held += usize::from(on.contains(&ray));
        }
        assert_eq!(held, on.len(), "samples outside of the page");
    }
}

/// A solid is seen as its shadow along z: the pixels that its triangles touch.
#[test]
fn solids_are_seen_from_the_front() {
    let page = Page::new([-2.0, -2.0], [2.0, 2.0], [40, 40]).unwrap();
    let cube = Shape::cuboid(vec3(0.25, -0.55, 9.0), vec3(1.0, 0.4, 3.0), &Look::default()).unwrap();
    let touched = page.touched(&cube);
    // From -0.25 to 0.75 and from -0.75 to -0.35, in pixels of 0.1: columns 17 to 27, rows 23 to 27.
    let on: Vec<usize> = touched.rays().collect();
    assert!(on.iter().all(|n| (17..=27).contains(&(n % 64)) && (23..=27).contains(&(n / 64))), "{on:?}");
    assert!(on.len() >= 10 * 4);
}

fn some_greys(dice: &mut Dice, [columns, rows]: [usize; 2]) -> Vec<u8> {
    let inside = |p: usize| {
        let (x, y) = ((p % columns) as f64 / columns as f64 - 0.5, (p / columns) as f64 / rows as f64 - 0.6);
        x * x + y * y < 0.1
    };
    (0..columns * rows).map(|p| if inside(p) { dice.below(255) as u8 } else { 255 }).collect()
}

/// The formulas of dissertation 6.5.2, pixel by pixel.
fn similarity_by_hand(greys: &[u8], [columns, rows]: [usize; 2], on: &[bool]) -> f64 {
    let value = |x: i64, y: i64| match x >= 0 && y >= 0 && x < columns as i64 && y < rows as i64 {
        true => f64::from(greys[y as usize * columns + x as usize]) / 255.0,
        false => 0.0,
    };
    let weight = |p: usize| {
        let (x, y) = ((p % columns) as i64, (p / columns) as i64);
        let (mut across, mut down) = (0.0, 0.0);
        for (d, w) in [(-1, 1.0), (0, 2.0), (1, 1.0)] {
            across += w * (value(x + 1, y + d) - value(x - 1, y + d));
            down += w * (value(x + d, y + 1) - value(x + d, y - 1));
        }
        if greys[p] == 255 { 1.0 } else { 2.0 / 3.0 + (across * across + down * down).sqrt() / 3.0 }
    };
    let all: f64 = (0..on.len()).map(weight).sum();
    let agree = |on: &dyn Fn(usize) -> bool| {
        (0..greys.len()).filter(|p| on(*p) == (greys[*p] < 255)).map(weight).sum::<f64>() / all
    };
    let blank = agree(&|_| false);
    (agree(&|p| on[p]) - blank) / (1.0 - blank)
}

fn any_primitive(dice: &mut Dice) -> Primitive {
    let shape = |dice: &mut Dice| match dice.below(9) {
        0 => any_shape(dice, 2.0),
        n if n < 5 => ellipse(dice, 2.4).shape,
        _ => stroke(dice, 2.4).shape,
    };
    let count = if dice.below(4) == 0 { 3 } else { 1 };
    Primitive::new((0..count).map(|_| shape(dice)).collect::<Vec<Shape>>())
}

/// Random additions, removals and copies; after each the sketch is the one of its primitives in another order.
fn history<T: Sketch + Clone + PartialEq>(
    dice: &mut Dice,
    start: &T,
    mut check: impl FnMut(&T, &[Primitive]),
) {
    let (mut sketch, mut held, mut copies) = (start.clone(), Vec::new(), Vec::new());
    for step in 0..60 {
        if step == 25 {
            sketch.expect_removals();
        }
        if held.is_empty() || dice.below(5) < 3 {
            let primitive = any_primitive(dice);
            sketch.add(&primitive);
            held.push(primitive);
        } else if step > 20 {
            let removed = held.swap_remove(dice.below(held.len()));
            assert!(sketch.remove(&removed));
        }
        if dice.below(6) == 0 {
            copies.push((sketch.clone(), sketch.log_score()));
        }
        let mut fresh = start.clone();
        held.iter().rev().for_each(|primitive| fresh.add(primitive));
        assert!(sketch == fresh, "step {step}");
        assert_eq!(sketch.log_score().to_bits(), fresh.log_score().to_bits());
        check(&sketch, &held);
    }
    assert!(!sketch.remove(&any_primitive(dice)));
    for primitive in held {
        assert!(sketch.remove(&primitive));
    }
    assert!(sketch == *start);
    assert!(copies.iter().all(|(copy, score)| copy.log_score().to_bits() == score.to_bits()));
}

#[test]
fn drawings_score_by_the_formula_for_any_history() {
    let mut dice = Dice::new(13);
    for _ in 0..3 {
        let page = any_page(&mut dice);
        let greys = some_greys(&mut dice, page.size());
        let drawing = Arc::new(Drawing::new(page.clone(), &greys).unwrap());
        let empty = DrawingMatch::new(drawing.clone(), 0.02);
        assert_eq!(empty.similarity(), 0.0);
        history(&mut dice, &empty, |sketch, held| {
            let mask = drawing.mask(held);
            let by_hand = similarity_by_hand(&greys, page.size(), &mask);
            assert!((sketch.similarity() - by_hand).abs() < 1e-5, "{} {by_hand}", sketch.similarity());
            let [_, on, outside] = sketch.measures().try_into().unwrap();
            assert_eq!(on.1, mask.iter().filter(|on| **on).count() as f64);
            let z = (sketch.similarity() - 1.0) / 0.02;
            let within = -0.5 * z * z - (0.02 * std::f64::consts::TAU.sqrt()).ln();
            if outside.1 == 0.0 {
                assert!((sketch.log_score() - within).abs() < 1e-9 * within.abs());
            } else {
                assert!(sketch.log_score() < within);
            }
        });
    }
}

#[test]
fn textures_score_by_the_formula_for_any_history() {
    let mut dice = Dice::new(14);
    for _ in 0..2 {
        let page = any_page(&mut dice);
        let [columns, rows] = page.size();
        let texture = Arc::new(Texture { page: page.clone(), share: 0.5, sigma: 0.01 });
        history(&mut dice, &TextureMatch::new(texture), |sketch, held| {
            let mut held_samples = vec![0_u64; page.sampled_words()];
            for cover in held.iter().flat_map(Primitive::shapes).map(|shape| page.sampled(shape)) {
                cover.words().iter().for_each(|(word, bits)| held_samples[*word as usize] |= bits);
            }
            let value = |x: i64, y: i64| match x >= 0 && y >= 0 && x < columns as i64 && y < rows as i64 {
                true => {
                    1.0 - f64::from(held_samples[page.sampled_word(x as usize, y as usize)].count_ones())
                        / 64.0
                }
                false => 0.0,
            };
            let (mut fill, mut edge) = (0.0, 0.0);
            for (x, y) in (0..rows as i64).flat_map(|y| (0..columns as i64).map(move |x| (x, y))) {
                fill += f64::from(u8::from(value(x, y) < 1.0));
                let (mut across, mut down) = (0.0, 0.0);
                for (d, w) in [(-1, 1.0), (0, 2.0), (1, 1.0)] {
                    across += w * (value(x + 1, y + d) - value(x - 1, y + d));
                    down += w * (value(x + d, y + 1) - value(x + d, y - 1));
                }
                edge += f64::hypot(across, down);
            }
            let pixels = (columns * rows) as f64;
            assert!((sketch.fill() - fill / pixels).abs() < 1e-12);
            assert!((sketch.edge() - edge / pixels).abs() < 1e-6);
        });
    }
}

#[test]
fn an_empty_page_has_the_edge_of_its_border() {
    let page = Page::new([0.0, 0.0], [24.0, 24.0], [50, 50]).unwrap();
    let empty = TextureMatch::new(Arc::new(Texture { page, share: 0.5, sigma: 0.01 }));
    // 4 on each of the 48 pixels of a side, 3 sqrt 2 on each corner.
    let edge = (4.0 * 48.0 * 4.0 + 4.0 * 18.0_f64.sqrt()) / 2500.0;
    assert!((empty.edge() - edge).abs() < 1e-6 && (edge - 0.314).abs() < 1e-3);
    assert_eq!((empty.fill(), empty.score()), (0.0, 0.0));
}

/// Dissertation 6.5.3: the axis of a stroke may reach the border, and 0.001 of the window outside costs a nat.
#[test]
fn reaching_out_of_the_window_costs_much() {
    let page = Page::new([0.0, 0.0], [24.0, 12.0], [48, 24]).unwrap();
    let mut greys = vec![255; 48 * 24];
    greys[300] = 0;
    let drawing = Arc::new(Drawing::new(page, &greys).unwrap());
    let spec = match_drawing(drawing, 1e6).unwrap();
    let line =
        |a: Vec3, b: Vec3| Primitive::new([Shape::stroke(a, b, (0.5, 0.5), &Look::default()).unwrap()]);
    let score = |primitives: &[Primitive]| {
        let mut sketch = spec.start();
        let empty = sketch.log_score();
        primitives.iter().for_each(|primitive| sketch.add(primitive));
        sketch.log_score() - empty
    };
    let on_border = line(vec3(0.0, 0.0, 0.0), vec3(24.0, 12.0, 0.0));
    assert!(score(std::slice::from_ref(&on_border)).abs() < 1e-6);
    let left = line(vec3(-0.024, 1.0, 0.0), vec3(1.0, 1.0, 0.0));
    assert!((score(&[on_border, left.clone()]) + 1.0).abs() < 1e-6);
    // Both sides of one direction add before they are squared.
    let right = line(vec3(24.024, 1.0, 0.0), vec3(23.0, 1.0, 0.0));
    assert!((score(&[left, right]) + 4.0).abs() < 1e-6);
    let disc =
        Primitive::new(
            [Shape::ellipse(vec3(5.0, 11.0, 0.0), (2.024, 2.024), 0.3, &Look::default()).unwrap()],
        );
    assert!((score(&[disc]) + 1.0).abs() < 1e-6);
}

#[test]
fn impossible_drawings_are_refused() {
    let page = |size| Page::new([0.0, 0.0], [1.0, 1.0], size);
    assert!(page([0, 5]).is_err() && Page::new([0.0, 0.0], [0.0, 1.0], [5, 5]).is_err());
    assert!(Page::new([0.0, 0.0], [f64::NAN, 1.0], [5, 5]).is_err());
    let four = page([2, 2]).unwrap();
    assert_eq!(Drawing::new(four.clone(), &[255; 3]).unwrap_err().code, "bad-image");
    assert_eq!(Drawing::new(four.clone(), &[255; 4]).unwrap_err().code, "image-one-color");
    assert_eq!(Drawing::new(four, &[254; 4]).unwrap_err().code, "image-one-color");
}
