//! Obstacles, floors and boxes: what they forbid; adding then removing leaves their integers as they were.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::{
    Aabb, Avoid, Look, Primitive, Shape, Sketch, SketchSpec, Sketches, Target, TriMesh, Vec3, Voxels, avoid,
    floor, limits, no_overshoot, vec3,
};
use scenes::{Dice, any_shape, torus};
use std::sync::Arc;

fn cube(center: Vec3, size: f64) -> Primitive {
    Primitive::new([Shape::cuboid(center, vec3(size, size, size), &Look::default()).unwrap()])
}

fn wall() -> Arc<Target> {
    let mesh: TriMesh = cube(Vec3::ZERO, 2.0).shapes()[0].world_mesh().clone();
    Arc::new(Target::new(mesh, 0.2).unwrap())
}

fn score(spec: &Arc<dyn SketchSpec>, primitives: &[Primitive]) -> f64 {
    let mut sketch = spec.start();
    primitives.iter().for_each(|p| sketch.add(p));
    sketch.log_score()
}

#[test]
fn an_obstacle_forbids_shapes_in_its_cells() {
    let spec = avoid(wall());
    assert_eq!(score(&spec, &[]), 0.0);
    // Inside of the obstacle, across its border, around it: all forbidden.
    for (x, size) in [(0.0, 0.5), (1.0, 0.5), (0.0, 9.0)] {
        assert_eq!(score(&spec, &[cube(vec3(x, 0.0, 0.0), size)]), f64::NEG_INFINITY);
    }
    // Two cells away: allowed, with any other shapes.
    assert_eq!(score(&spec, &[cube(vec3(1.7, 0.0, 0.0), 0.5), cube(vec3(0.0, -1.7, 0.0), 0.5)]), 0.0);
    // The mutant that uses the obstacle's surface only would allow shapes inside of it.
    let hollow = wall();
    let inside = Voxels::of(&cube(Vec3::ZERO, 0.5).shapes()[0], hollow.grid()).unwrap();
    assert_eq!(hollow.shared_with(&inside), inside.count() as u64);
}

#[test]
fn shared_cells_are_those_of_a_loop_and_removing_undoes_adding() {
    let mut dice = Dice::new(4);
    let obstacle = Arc::new(Target::new(torus(2.0, 0.7, 24, 12), 0.15).unwrap());
    let primitives: Vec<Primitive> =
        (0..60).map(|_| Primitive::new([any_shape(&mut dice, 2.0), any_shape(&mut dice, 2.0)])).collect();
    let [nx, ny, nz] = obstacle.grid().dims();
    let by_hand = |primitive: &Primitive| {
        let voxels: Vec<Voxels> =
            primitive.shapes().iter().filter_map(|s| Voxels::of(s, obstacle.grid())).collect();
        let cells = (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]);
        let shared =
            |cell| voxels.iter().filter(|v| obstacle.contains(cell) && v.contains(cell)).count() as u64;
        cells.map(shared).sum::<u64>()
    };
    let empty = Avoid::new(obstacle.clone());
    let mut sketch = empty.clone();
    let mut allowed = 0;
    for p in &primitives {
        let before = sketch.shared();
        sketch.add(p);
        assert_eq!(sketch.shared() - before, by_hand(p));
        let mut alone = empty.clone();
        alone.add(p);
        assert_eq!(alone.log_score() == 0.0, by_hand(p) == 0);
        allowed += usize::from(alone.log_score() == 0.0);
    }
    assert!((5..55).contains(&allowed), "{allowed}");
    assert!(sketch.shared() > 1000);
    let mut backward = empty.clone();
    primitives.iter().rev().for_each(|p| backward.add(p));
    assert!(sketch == backward);
    primitives.iter().for_each(|p| assert!(sketch.remove(p) && !sketch.remove(p)));
    assert!(sketch == empty && sketch.log_score() == 0.0);
}

#[test]
fn a_shape_is_forbidden_exactly_when_it_shares_a_cell() {
    let mut dice = Dice::new(5);
    let obstacle = Arc::new(Target::new(torus(2.0, 0.5, 24, 12), 0.1).unwrap());
    let [mut allowed, mut near, mut forbidden] = [0; 3];
    for _ in 0..3000 {
        let shape = any_shape(&mut dice, 3.5);
        let cells = obstacle.grid().cells_of(shape.aabb());
        let shared = Voxels::of(&shape, obstacle.grid()).map_or(0, |v| obstacle.shared_with(&v));
        let mut sketch = Avoid::new(obstacle.clone());
        sketch.add(&Primitive::new([shape]));
        assert_eq!(sketch.log_score() == 0.0, shared == 0);
        assert_eq!(sketch.shared(), shared);
        let boxed = cells.is_some_and(|cells| obstacle.meets(&Voxels::block(cells)));
        forbidden += usize::from(shared > 0);
        near += usize::from(shared == 0 && boxed);
        allowed += usize::from(shared == 0 && !boxed);
    }
    assert!(allowed > 500 && near > 100 && forbidden > 500, "{allowed} {near} {forbidden}");
}

#[test]
fn a_floor_allows_shapes_that_touch_it() {
    let spec = floor(1.0).unwrap();
    assert_eq!(score(&spec, &[]), 0.0);
    assert_eq!(score(&spec, &[cube(vec3(0.0, 1.5, 0.0), 1.0)]), 0.0);
    assert_eq!(score(&spec, &[cube(vec3(0.0, 1.5 - 1e-9, 0.0), 1.0)]), 0.0);
    assert_eq!(score(&spec, &[cube(vec3(0.0, 1.49, 0.0), 1.0)]), f64::NEG_INFINITY);
    let mut sketch = spec.start();
    sketch.add(&cube(vec3(0.0, 0.0, 0.0), 1.0));
    sketch.add(&cube(vec3(0.0, 9.0, 0.0), 1.0));
    assert!(!sketch.remove(&cube(vec3(0.0, 2.0, 0.0), 1.0)));
    assert_eq!(sketch.measures(), [("below_floor", 1.0)]);
    assert!(sketch.remove(&cube(vec3(0.0, 0.0, 0.0), 1.0)));
    assert_eq!(sketch.log_score(), 0.0);
    assert!(floor(f64::NAN).is_err());
}

#[test]
fn overshoot_sums_lengths_outside_over_six_sides() {
    let domain = Aabb { low: vec3(-1.0, 0.0, -1.0), high: vec3(1.0, 4.0, 1.0) };
    let spec = no_overshoot(domain, 0.02).unwrap();
    let most = 2.993_084_6;
    assert!((score(&spec, &[]) - most).abs() < 1e-6);
    assert!((score(&spec, &[cube(vec3(0.0, 2.0, 0.0), 1.0)]) - most).abs() < 1e-6);
    // 0.1 beyond along +x and 0.2 below the box: 0.1 / 2 + 0.2 / 4.
    let mut sketch = spec.start();
    sketch.add(&cube(vec3(0.6, 2.0, 0.0), 1.0));
    sketch.add(&cube(vec3(0.0, 0.3, 0.0), 1.0));
    assert!((sketch.measures()[0].1 - 0.1).abs() < 1e-12);
    assert!((sketch.log_score() - (most - 0.5 * 25.0)).abs() < 1e-6);
    // Removing gives the extent of the rest back.
    assert!(sketch.remove(&cube(vec3(0.6, 2.0, 0.0), 1.0)));
    assert!((sketch.measures()[0].1 - 0.05).abs() < 1e-12);
    assert!(no_overshoot(Aabb { low: Vec3::ZERO, high: vec3(1.0, 0.0, 1.0) }, 0.02).is_err());
    assert!(no_overshoot(domain, 0.0).is_err());
}

#[test]
fn limits_cost_nothing_where_they_hold_and_a_step_with_a_square_beyond() {
    let domain = Aabb { low: vec3(-1.0, 0.0, -1.0), high: vec3(1.0, 4.0, 1.0) };
    let tall = limits(Some([1.0, 2.0]), None, 0.1).unwrap();
    assert_eq!(score(&tall, &[cube(vec3(0.0, 7.0, 0.0), 1.5)]), 0.0);
    assert_eq!(score(&tall, &[cube(vec3(0.0, 7.0, 0.0), 2.0 + 1e-12)]), 0.0);
    // A fifth above the largest height, a fifth below the least, and nothing at all.
    for (side, excess) in [(2.4, 0.2), (0.8, 0.2)] {
        let cost = 12.0 + 0.5 * (excess / 0.1f64).powi(2);
        assert!((score(&tall, &[cube(vec3(0.0, 7.0, 0.0), side)]) + cost).abs() < 1e-9);
    }
    assert!((score(&tall, &[]) + 62.0).abs() < 1e-9);
    let inside = limits(None, Some(domain), 0.1).unwrap();
    assert_eq!(score(&inside, &[]), 0.0);
    assert_eq!(score(&inside, &[cube(vec3(0.0, 2.0, 0.0), 1.0)]), 0.0);
    assert!((score(&inside, &[cube(vec3(0.6, 2.0, 0.0), 1.0)]) + 12.125).abs() < 1e-9);
    for height in [[2.0, 1.0], [-1.0, 1.0], [0.0, f64::INFINITY], [f64::NAN, 1.0]] {
        assert!(limits(Some(height), None, 0.1).is_err());
    }
    assert!(limits(None, Some(Aabb { low: Vec3::ZERO, high: vec3(1.0, 0.0, 1.0) }), 0.1).is_err());
    assert!(limits(None, None, 0.0).is_err());
}

#[test]
fn scores_multiply() {
    let specs = [
        floor(0.0).unwrap(),
        avoid(wall()),
        no_overshoot(Aabb { low: vec3(-9.0, 0.0, -9.0), high: vec3(9.0, 9.0, 9.0) }, 0.02).unwrap(),
    ];
    let mut scene = Sketches::start(&specs);
    assert_eq!(scene.add(&cube(vec3(4.0, 0.5, 0.0), 1.0)), None);
    assert_eq!(scene.add(&cube(vec3(0.0, 0.6, 0.0), 1.0)), Some("avoid"));
    assert_eq!(scene.add(&cube(vec3(4.0, -3.0, 0.0), 1.0)), Some("floor"));
    assert!(scene.remove(&cube(vec3(4.0, -3.0, 0.0), 1.0)));
    assert_eq!(scene.forbidden_by(), Some("avoid"));
    assert!(scene.remove(&cube(vec3(0.0, 0.6, 0.0), 1.0)));
    assert!(scene.log_score().is_finite());
}
