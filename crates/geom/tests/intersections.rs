//! Intersection of solids agrees with a search for a common point, touching never counts, and the number of
//! intersecting pairs is that of all pairs, in any order.
//!
//! The search does not use separating axes: it minimises the depth `max over faces of (distance outside)` over
//! all points by the ellipsoid method (Groetschel, Lovasz & Schrijver 1988, 3.1). Negative means a common inside.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::intersect::{SOLID_TOLERANCE, axes};
use niwaki_geom::{
    Look, Mat3, NoSelfIntersection, Primitive, Rule, Shape, Sketch, Solid, TriMesh, Vec3, intersects, vec3,
};
use scenes::{Dice, any_shape, torus};
use std::sync::Arc;

/// Planes of a convex shape's triangles: unit outward normal and offset.
fn planes(shape: &Shape) -> Vec<(Vec3, f64)> {
    let plane = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).unit().map(|n| (n, n.dot(a)));
    shape.world_mesh().corners().filter_map(plane).collect()
}

/// Least over all points of how far the point is outside of the worst plane, to about 1e-6.
fn least_outside(planes: &[(Vec3, f64)], start: Vec3, radius: f64) -> f64 {
    let mut x = start;
    let mut p = Vec3::AXES.map(|a| a * (radius * radius));
    let mut best = f64::INFINITY;
    for _ in 0..500 {
        let outside = |(n, d): &(Vec3, f64)| n.dot(x) - d;
        let worst = planes.iter().max_by(|a, b| outside(a).total_cmp(&outside(b))).unwrap();
        best = best.min(outside(worst));
        let g = worst.0;
        let pg = vec3(p[0].dot(g), p[1].dot(g), p[2].dot(g));
        let scale = g.dot(pg).sqrt();
        if scale < 1e-8 {
            break;
        }
        let step = pg * (1.0 / scale);
        x = x - step * 0.25;
        for row in 0..3 {
            p[row] = (p[row] - step * (step[row] * 0.5)) * 1.125;
        }
    }
    best
}

fn depth(a: &Shape, b: &Shape) -> f64 {
    let all: Vec<(Vec3, f64)> = planes(a).into_iter().chain(planes(b)).collect();
    let around = a.aabb().union(b.aabb());
    least_outside(&all, around.center(), around.extent().norm())
}

fn convex(dice: &mut Dice) -> Shape {
    loop {
        let shape = any_shape(dice, 1.8);
        if shape.convex().is_some() {
            return shape;
        }
    }
}

#[test]
fn convex_solids_agree_with_a_search_for_a_common_point() {
    let mut dice = Dice::new(5);
    let (mut apart, mut overlapping) = (0, 0);
    for pair in 0..4000 {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        let depth = depth(&a, &b);
        let answer = intersects(&a, &b, Rule::Solid);
        assert_eq!(answer, intersects(&b, &a, Rule::Solid), "pair {pair}");
        assert_eq!(intersects(&a, &b, Rule::Surface), intersects(&b, &a, Rule::Surface), "pair {pair}");
        if depth.abs() > 1e-5 {
            assert_eq!(answer, depth < 0.0, "pair {pair}: {depth}\n{a:?}\n{b:?}");
            *(if answer { &mut overlapping } else { &mut apart }) += 1;
        }
    }
    assert!(apart > 800 && overlapping > 800, "{apart} {overlapping}");
}

#[test]
fn the_surface_rule_sees_all_overlaps_but_containment() {
    let mut dice = Dice::new(6);
    let (mut missed, mut seen) = (0, 0);
    for _ in 0..4000 {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        let (solid, surface) = (intersects(&a, &b, Rule::Solid), intersects(&a, &b, Rule::Surface));
        assert!(solid || !surface);
        let holds = |p: &Shape, q: &Shape| {
            let planes = planes(p);
            q.convex().unwrap().corners().iter().all(|c| planes.iter().all(|(n, d)| n.dot(*c) < d + 1e-6))
        };
        if solid && !holds(&a, &b) && !holds(&b, &a) && depth(&a, &b) < -1e-3 {
            seen += usize::from(surface);
            missed += usize::from(!surface);
        }
    }
    assert!(seen > 800 && missed == 0, "{seen} {missed}");
}

/// A box as long as wide, a beam or a plate, turned or not.
fn any_box(dice: &mut Dice, at: Vec3) -> Shape {
    let thin = [1.0, 1e-2, 1e-4];
    let size = vec3(1.0, thin[dice.below(3)], thin[dice.below(3)]) * dice.uniform(0.1, 3.0);
    let turn = match dice.below(4) {
        0 => None,
        // Nearly along the axes: products of edges that nearly vanish.
        1 => Some(Mat3::rotation(dice.point(1.0).unit().unwrap(), 10f64.powf(dice.uniform(-9.0, -2.0)))),
        _ => Some(Mat3::rotation(dice.point(1.0).unit().unwrap(), dice.uniform(0.0, 7.0))),
    };
    Shape::cuboid(at, size, &Look { rotation: turn, ..Look::default() }).unwrap()
}

#[test]
fn two_boxes_agree_with_the_code_for_all_convex_solids() {
    let mut dice = Dice::new(15);
    let (mut apart, mut overlapping, mut at_the_tolerance) = (0, 0, 0);
    for pair in 0..40_000 {
        let far = [0.0, 0.0, 30.0, 3e4][dice.below(4)];
        let middle = dice.point(1.0) * far;
        let a = any_box(&mut dice, middle);
        let other = middle + dice.point(1.2);
        let mut b = any_box(&mut dice, other);
        let general = |b: &Shape, share: f64| {
            let tolerance = share * a.thickness().min(b.thickness());
            let (p, q) = (a.convex().unwrap(), b.convex().unwrap());
            !axes::boxes_apart(a.aabb(), b.aabb(), tolerance) && axes::overlap(&p, &q, tolerance)
        };
        if pair % 2 == 0 && general(&b, SOLID_TOLERANCE) {
            // Moved until they hardly overlap.
            let (mut least, mut most) = (0.0, 10.0);
            let away = dice.point(1.0).unit().unwrap();
            let moved = |by: f64| {
                let Solid::Box(niwaki_geom::Cuboid { size }) = b.solid() else { panic!("a box") };
                let look = Look { rotation: Some(b.placement().rotation), ..Look::default() };
                Shape::cuboid(b.placement().translation + away * by, *size, &look).unwrap()
            };
            for _ in 0..dice.below(30) {
                let middle = 0.5 * (least + most);
                *(if general(&moved(middle), SOLID_TOLERANCE) { &mut least } else { &mut most }) = middle;
            }
            b = moved(if dice.below(2) == 0 { least } else { most });
        }
        let answer = intersects(&a, &b, Rule::Solid);
        assert_eq!(answer, intersects(&b, &a, Rule::Solid), "pair {pair}");
        // Corners are rounded to about 1e-16 of their distance from the origin, which is a share of the thinner box.
        let rounding = 1e-4 * SOLID_TOLERANCE + 3e-15 * (far + 3.0) / a.thickness().min(b.thickness());
        let [more, less] = [1.0, -1.0].map(|sign| general(&b, SOLID_TOLERANCE + sign * rounding));
        if more == less {
            assert_eq!(answer, more, "pair {pair}\n{a:?}\n{b:?}");
            *(if answer { &mut overlapping } else { &mut apart }) += 1;
        } else {
            at_the_tolerance += 1;
        }
    }
    assert!(apart > 5_000 && overlapping > 5_000, "{apart} {overlapping} {at_the_tolerance}");
    assert!(at_the_tolerance < 2_000, "{at_the_tolerance}");
}

#[test]
fn boxes_that_touch_in_any_direction_do_not_overlap() {
    let mut dice = Dice::new(16);
    for _ in 0..4000 {
        let turn = Mat3::rotation(dice.point(1.0).unit().unwrap(), dice.uniform(0.0, 7.0));
        let turn = if dice.below(2) == 0 { turn } else { Mat3::IDENTITY };
        let size =
            |dice: &mut Dice| vec3(dice.uniform(0.1, 3.0), dice.uniform(0.1, 3.0), dice.uniform(0.1, 3.0));
        let (p, q, at) = (size(&mut dice), size(&mut dice), dice.point(20.0));
        let look = Look { rotation: Some(turn), ..Look::default() };
        // Block by block along a side, shifted across it.
        let way = vec3(0.5 * (p.x + q.x), dice.uniform(-0.04, 0.04), dice.uniform(-0.04, 0.04));
        let a = Shape::cuboid(at, p, &look).unwrap();
        for (deeper, overlaps) in [(0.0, false), (1e-4, true), (-1e-4, false)] {
            let to = at + turn.apply(way - vec3(deeper, 0.0, 0.0));
            assert_eq!(intersects(&a, &Shape::cuboid(to, q, &look).unwrap(), Rule::Solid), overlaps);
        }
        // An edge on an edge across it: along their common normal the boxes touch there.
        let quarter = Mat3::rotation(Vec3::AXES[2], std::f64::consts::FRAC_PI_4);
        let crossed = turn.after(&Mat3::rotation(Vec3::AXES[1], std::f64::consts::FRAC_PI_2)).after(&quarter);
        let (low, high) = (turn.after(&quarter), crossed);
        let [a, b] = [(low, at), (high, at + turn.apply(vec3(0.0, 2f64.sqrt(), 0.0)))].map(|(turn, at)| {
            let look = Look { rotation: Some(turn), ..Look::default() };
            Shape::cuboid(at, vec3(1.0, 1.0, 3.0), &look).unwrap()
        });
        assert!(!intersects(&a, &b, Rule::Solid));
        let lower = at + turn.apply(vec3(0.0, 2f64.sqrt() - 1e-4, 0.0));
        let look = Look { rotation: Some(high), ..Look::default() };
        assert!(intersects(&a, &Shape::cuboid(lower, vec3(1.0, 1.0, 3.0), &look).unwrap(), Rule::Solid));
    }
}

/// A mesh shape of the coarse mesh of a shape.
fn copy(shape: &Shape) -> Shape {
    let mesh = Arc::new(shape.world_mesh().clone());
    Shape::mesh(&mesh, Vec3::ZERO, 1.0, &Look::default()).unwrap()
}

#[test]
fn the_order_does_not_matter_even_at_the_tolerance() {
    let mut dice = Dice::new(4);
    let mut overlapping = 0;
    for _ in 0..2000 {
        let turn = Mat3::rotation(dice.point(1.0).unit().unwrap(), dice.uniform(0.0, 7.0));
        let at = dice.point(3.0);
        // Overlap by a millionth of the size, give or take rounding.
        let a = cube(at, 1.0, Some(turn));
        let b = cube(at + turn.apply(vec3(1.0 - 1e-6, 0.2, 0.1)), 1.0, Some(turn));
        let answer = intersects(&a, &b, Rule::Solid);
        overlapping += usize::from(answer);
        assert_eq!(answer, intersects(&b, &a, Rule::Solid));
        let (p, q) = (copy(&a), copy(&b));
        for rule in [Rule::Solid, Rule::Surface] {
            assert_eq!(intersects(&p, &q, rule), intersects(&q, &p, rule));
        }
    }
    assert!(overlapping > 20 && overlapping < 1980, "{overlapping}");
}

#[test]
fn meshes_agree_with_the_convex_solids_they_copy() {
    let mut dice = Dice::new(8);
    let (mut apart, mut overlapping) = (0, 0);
    for pair in 0..1500 {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        // A pyramid's tip folds two faces into lines; thin slivers of overlap are below the samples' depth.
        if depth(&a, &b).abs() < 5e-3 {
            continue;
        }
        let answer = intersects(&a, &b, Rule::Solid);
        for (p, q) in [(copy(&a), b.clone()), (a.clone(), copy(&b)), (copy(&a), copy(&b))] {
            assert_eq!(intersects(&p, &q, Rule::Solid), answer, "pair {pair}");
            assert_eq!(intersects(&q, &p, Rule::Solid), answer, "pair {pair}");
        }
        *(if answer { &mut overlapping } else { &mut apart }) += 1;
    }
    assert!(apart > 300 && overlapping > 300, "{apart} {overlapping}");
}

fn cube(center: Vec3, size: f64, rotation: Option<Mat3>) -> Shape {
    Shape::cuboid(center, vec3(size, size, size), &Look { rotation, ..Look::default() }).unwrap()
}

#[test]
fn touching_is_not_intersecting() {
    for k in 0..200 {
        // The same scene at any place and rotation: flush to within rounding.
        let mut dice = Dice::new(k);
        let turn = Mat3::rotation(dice.point(1.0).unit().unwrap(), dice.uniform(0.0, 7.0));
        let (turn, at) =
            if k % 2 == 0 { (Mat3::IDENTITY, dice.point(10.0)) } else { (turn, dice.point(10.0)) };
        let place = |p: Vec3| at + turn.apply(p);
        let a = cube(place(Vec3::ZERO), 2.0, Some(turn));
        let face = cube(place(vec3(1.5, 0.3, 0.2)), 1.0, Some(turn));
        let edge = cube(place(vec3(1.5, 1.5, 0.2)), 1.0, Some(turn));
        let corner = cube(place(vec3(1.5, 1.5, 1.5)), 1.0, Some(turn));
        let look = Look { rotation: Some(turn), ..Look::default() };
        let rod = Shape::cylinder(place(vec3(1.5, 0.0, 0.0)), 0.5, 3.0, Vec3::AXES[2], None, &look).unwrap();
        for other in [&face, &edge, &corner, &rod] {
            for rule in [Rule::Solid, Rule::Surface] {
                assert!(!intersects(&a, other, rule), "{k} {rule:?} {other:?}");
            }
        }
        // Meshes have no face normals to test first: their triangles are compared.
        for other in [&face, &edge, &corner, &rod] {
            for rule in [Rule::Solid, Rule::Surface] {
                assert!(!intersects(&copy(&a), &copy(other), rule), "{k} {rule:?} {other:?}");
            }
        }
        let crossing = cube(place(vec3(1.4, 0.3, 0.2)), 1.0, Some(turn));
        assert!(intersects(&a, &crossing, Rule::Solid) && intersects(&a, &crossing, Rule::Surface));
    }
}

#[test]
fn containment_and_equal_cross_sections_are_seen_by_the_solid_rule_only() {
    let a = cube(Vec3::ZERO, 2.0, None);
    let inner = cube(vec3(0.1, 0.2, 0.3), 0.5, None);
    let shifted = cube(vec3(1.0, 0.0, 0.0), 2.0, None);
    for other in [&inner, &shifted, &a.clone()] {
        assert!(intersects(&a, other, Rule::Solid));
        assert!(!intersects(&a, other, Rule::Surface));
    }
    for other in [&inner, &shifted, &a] {
        assert!(intersects(&copy(&a), &copy(other), Rule::Solid));
    }
}

#[test]
fn a_ball_in_the_hole_of_a_ring_is_free() {
    let ring = Shape::mesh(&Arc::new(torus(2.0, 0.5, 32, 12)), Vec3::ZERO, 1.0, &Look::default()).unwrap();
    assert!(!intersects(&ring, &cube(Vec3::ZERO, 1.5, None), Rule::Solid));
    assert!(intersects(&ring, &cube(vec3(0.0, 0.0, 2.0), 0.3, None), Rule::Solid), "inside the tube");
    assert!(intersects(&ring, &cube(vec3(0.0, 0.0, 1.0), 1.5, None), Rule::Solid), "through the tube");
    let inside_out: Vec<[u32; 3]> =
        ring.world_mesh().triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let mesh = Arc::new(TriMesh::new(ring.world_mesh().vertices().to_vec(), inside_out).unwrap());
    let turned = Shape::mesh(&mesh, Vec3::ZERO, 1.0, &Look::default()).unwrap();
    assert!(intersects(&turned, &cube(vec3(0.0, 0.0, 2.0), 0.3, None), Rule::Solid));
}

#[test]
fn a_chain_of_bent_limbs_only_touches() {
    let mut dice = Dice::new(2);
    let (mut at, mut direction, mut radius) = (Vec3::ZERO, vec3(0.0, 1.0, 0.0), 1.0);
    let mut sketch = NoSelfIntersection::new(Rule::Solid);
    for _ in 0..12 {
        let next_direction = (direction + dice.point(0.25)).unit().unwrap();
        let (end, thinner) = (at + next_direction * (3.5 * radius), radius * 0.85);
        let limb = Shape::limb(
            at,
            end,
            (radius, thinner),
            (Some(direction), Some(next_direction)),
            &Look::default(),
        )
        .unwrap();
        sketch.add(&Primitive::new([limb]));
        (at, direction, radius) = (end, next_direction, thinner);
    }
    assert_eq!(sketch.pairs(), 0);
}

#[test]
fn pairs_are_counted_in_any_order_and_copies_are_apart() {
    let mut dice = Dice::new(9);
    for rule in [Rule::Solid, Rule::Surface] {
        let mut shape = || any_shape(&mut dice, 4.0);
        let primitives: Vec<Primitive> = (0..40).map(|_| Primitive::new([shape(), shape()])).collect();
        let meets = |a: &Primitive, b: &Primitive| {
            a.shapes().iter().any(|s| b.shapes().iter().any(|t| intersects(s, t, rule)))
        };
        let mut expected = 0;
        let (mut forward, mut backward) = (NoSelfIntersection::new(rule), NoSelfIntersection::new(rule));
        for (i, p) in primitives.iter().enumerate() {
            let fork = forward.clone();
            forward.add(p);
            expected += primitives[..i].iter().filter(|q| meets(q, p)).count() as u64;
            assert_eq!(forward.pairs(), expected);
            let mut undone = forward.clone();
            assert!(undone.remove(p) && undone == fork);
        }
        assert!(expected > 20, "{expected}");
        primitives.iter().rev().for_each(|p| backward.add(p));
        assert!(forward == backward);
        primitives.iter().for_each(|p| assert!(forward.remove(p)));
        assert!(forward == NoSelfIntersection::new(rule));
        assert_eq!(forward.log_score(), 0.0);
        assert_eq!(backward.log_score(), f64::NEG_INFINITY);
    }
}
