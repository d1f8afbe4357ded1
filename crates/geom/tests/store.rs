//! No result depends on the content of a store: geometry that is computed again has the same bits. A store keeps its limit,
//! and has nothing of dropped shapes.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::{
    Bark, Frame, Grid, Look, NoSelfIntersection, Primitive, Rule, Shape, Sketch, Vec3, Voxels, intersects,
    store, vec3,
};
use scenes::{Dice, any_shape, torus};
use std::sync::Arc;

/// A segment, half of them with a base on a bark.
fn segment(dice: &mut Dice, reach: f64) -> Shape {
    let (center, look) = (dice.point(reach), Look::default());
    let up = dice.point(1.0).unit().unwrap_or(Vec3::AXES[1]);
    let side = up.any_perpendicular();
    let frame = |at: f64, radius| Frame { center: center + up * at, forward: up, up: side, radius };
    let frames = [frame(0.0, 0.3), frame(0.2, 0.28), frame(dice.uniform(0.5, 1.5), 0.2)];
    let bark = |along: f64| center + up * -0.6 + side * along;
    let bark = Bark { low: bark(-0.4), low_radius: 0.6, high: bark(0.4), high_radius: 0.5 };
    Shape::segment(frames, (dice.below(2) == 0).then_some(bark), &look).unwrap()
}

fn shape(dice: &mut Dice, reach: f64) -> Shape {
    if dice.below(3) == 0 { segment(dice, reach) } else { any_shape(dice, reach) }
}

/// Everything that scores read of a shape, as text: a number has the same text only where it has the same bits, up to the
/// sign of zero.
fn geometry(shape: &Shape) -> String {
    let convex = shape.convex();
    let solid =
        convex.as_ref().map(|c| (c.vertices().to_vec(), c.normals().to_vec(), c.edges().to_vec(), c.width()));
    let pieces = convex.as_ref().and_then(|c| c.pieces()).map(|pieces| format!("{pieces:?}"));
    format!("{solid:?} {pieces:?} {:?} {}", *shape.world_mesh(), shape.thickness())
}

#[test]
fn geometry_computed_again_has_the_same_bits() {
    let mut dice = Dice::new(11);
    let mut segments = 0;
    for _ in 0..2000 {
        let shape = shape(&mut dice, 2.0);
        segments += usize::from(shape.convex().is_some_and(|c| c.pieces().is_some()));
        let first = geometry(&shape);
        store::empty();
        assert_eq!(geometry(&shape), first);
        // Another thread has a store of its own.
        assert_eq!(std::thread::scope(|scope| scope.spawn(|| geometry(&shape)).join().unwrap()), first);
    }
    assert!(segments > 300, "{segments}");
}

#[test]
fn results_do_not_depend_on_the_store() {
    let mut dice = Dice::new(12);
    let shapes: Vec<Shape> = (0..60).map(|_| shape(&mut dice, 2.0)).collect();
    let grid =
        Grid::around(&shapes.iter().fold(niwaki_geom::Aabb::EMPTY, |b, s| b.union(s.aabb())), 0.2).unwrap();
    let mut answers = [0; 2];
    for a in &shapes {
        let cells = Voxels::of(a, &grid).map(|voxels| voxels.count());
        store::empty();
        assert_eq!(Voxels::of(a, &grid).map(|voxels| voxels.count()), cells);
        for b in &shapes {
            for rule in [Rule::Solid, Rule::Surface] {
                let answer = intersects(a, b, rule);
                store::empty();
                assert_eq!(intersects(a, b, rule), answer);
                answers[usize::from(answer)] += 1;
            }
        }
    }
    assert!(answers[0] > 500 && answers[1] > 500, "{answers:?}");
}

#[test]
fn a_store_has_a_limit_and_forgets_dropped_shapes() {
    store::empty();
    let mut dice = Dice::new(13);
    // More shapes than a store has places, and more bytes than it may hold.
    let mut corners = Vec::new();
    let many = (0..20_000).map(|_| segment(&mut dice, 50.0));
    let many: Vec<Shape> = many.inspect(|s| corners.push(s.convex().unwrap().corners()[0])).collect();
    let held = store::held();
    assert!(held > 1 << 20 && held <= store::MOST, "{held}");
    // The oldest ones have left their places to others.
    assert!(many.iter().zip(&corners).all(|(s, first)| s.convex().unwrap().corners()[0] == *first));
    let ring = Arc::new(torus(1.0, 0.2, 100, 50));
    let rings = (0..200).map(|_| Shape::mesh(&ring, dice.point(9.0), 1.0, &Look::default()).unwrap());
    let rings: Vec<Shape> =
        rings.inspect(|ring| assert_eq!(ring.world_mesh().triangles().len(), 10_000)).collect();
    assert!(store::held() <= store::MOST);
    let mut scene = NoSelfIntersection::new(Rule::Solid);
    many.iter().take(1000).for_each(|shape| scene.add(&Primitive::new([shape.clone()])));
    drop((rings, many));
    assert!(store::held() <= 1000 * 20_000);
    drop(scene);
    assert_eq!(store::held(), 0);
}

#[test]
fn shapes_take_no_more_bytes_than_they_report() {
    let mut dice = Dice::new(14);
    for _ in 0..100 {
        assert!(segment(&mut dice, 1.0).bytes() <= 512);
    }
    assert!(Shape::cuboid(Vec3::ZERO, vec3(1.0, 1.0, 1.0), &Look::default()).unwrap().bytes() <= 256);
}
