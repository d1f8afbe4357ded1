//! Voxels of every solid agree with a loop over all cells, and counts with adding and removing in any order.
//!
//! The loop tests each triangle against each cell and fills what they enclose. Cells that a solid misses or touches by
//! less than the tolerance of a test may or may not be filled, so the loop gives two results: with the solid shrunk and
//! grown by a ten-thousandth of a cell. The engine's result must lie between them.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::voxel::surface::touches;
use niwaki_geom::{Grid, Mat3, Primitive, Shape, Sketch, Target, TriMesh, Vec3, VolumeMatch, Voxels, vec3};
use scenes::{Dice, any_shape, torus};
use std::sync::Arc;

/// Filled cells by brute force: touched cells, and those that a flood from outside does not reach.
fn plainly(mesh: &TriMesh, grid: &Grid) -> Vec<bool> {
    // The loop's own grid has the whole mesh inside, so that the flood goes around it.
    let corners = || mesh.corners().map(|t| t.map(|p| grid.to_grid(p)));
    let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
    for p in corners().flatten() {
        for a in 0..3 {
            low[a] = low[a].min(p[a].floor() as i64 - 2);
            high[a] = high[a].max(p[a].floor() as i64 + 2);
        }
    }
    let size: [usize; 3] = std::array::from_fn(|a| (high[a] - low[a] + 1) as usize);
    let at = |c: [usize; 3]| (c[2] * size[1] + c[1]) * size[0] + c[0];
    let mut touched = vec![false; size.iter().product()];
    for t in corners() {
        for z in 0..size[2] {
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let cell = [x as i64 + low[0], y as i64 + low[1], z as i64 + low[2]];
                    // A quick look first: most cells are far from most triangles.
                    let near = (0..3).all(|a| {
                        let (lo, hi) = (t[0].min(t[1]).min(t[2])[a], t[0].max(t[1]).max(t[2])[a]);
                        lo <= cell[a] as f64 + 1.1 && hi >= cell[a] as f64 - 0.1
                    });
                    touched[at([x, y, z])] |= near && touches(&t, cell);
                }
            }
        }
    }
    let mut outside = vec![false; touched.len()];
    let mut stack = vec![[0usize; 3]];
    outside[0] = true;
    while let Some(cell) = stack.pop() {
        for a in 0..3 {
            for step in [usize::MAX, 1] {
                let mut next = cell;
                next[a] = next[a].wrapping_add(step);
                if next[a] < size[a] && !touched[at(next)] && !outside[at(next)] {
                    outside[at(next)] = true;
                    stack.push(next);
                }
            }
        }
    }
    let dims = grid.dims();
    let mut filled = Vec::new();
    for z in 0..dims[2] as i64 {
        for y in 0..dims[1] as i64 {
            for x in 0..dims[0] as i64 {
                let cell = [x - low[0], y - low[1], z - low[2]];
                let inside = (0..3).all(|a| cell[a] >= 0 && cell[a] < size[a] as i64);
                filled.push(inside && !outside[at(cell.map(|c| c as usize))]);
            }
        }
    }
    filled
}

fn ours(shape: &Shape, grid: &Grid) -> Vec<bool> {
    let [nx, ny, nz] = grid.dims();
    let voxels = Voxels::of(shape, grid);
    let cell = |i: usize| [i % nx, i / nx % ny, i / nx / ny];
    (0..nx * ny * nz).map(|i| voxels.as_ref().is_some_and(|v| v.contains(cell(i)))).collect()
}

fn some_grid(dice: &mut Dice) -> Grid {
    let mut side = || dice.uniform(1.5, 5.0);
    let half = vec3(side(), side(), side());
    let cube = Shape::cuboid(Vec3::ZERO, half * 2.0, &Default::default()).unwrap();
    Grid::around(cube.aabb(), dice.uniform(0.09, 0.6)).unwrap()
}

#[test]
fn every_solid_fills_the_cells_that_a_plain_loop_finds() {
    let mut dice = Dice::new(7);
    let mut seen = std::collections::BTreeMap::new();
    for scene in 0..400 {
        let grid = some_grid(&mut dice);
        let shape = any_shape(&mut dice, 4.0);
        let (ours, plain) = (ours(&shape, &grid), plainly(&shape.world_mesh(), &grid));
        let differ: Vec<usize> = (0..ours.len()).filter(|i| ours[*i] != plain[*i]).collect();
        *seen.entry(shape.kind()).or_insert(0) += plain.iter().filter(|f| **f).count();
        if !differ.is_empty() {
            let middle = shape.aabb().center();
            let scaled = |by: f64| {
                let moved = shape.world_mesh().map(|p| middle + (p - middle) * by);
                plainly(&moved, &grid)
            };
            let (less, more) = (scaled(1.0 - 1e-4), scaled(1.0 + 1e-4));
            for i in differ {
                assert!(ours[i] >= less[i] && ours[i] <= more[i], "scene {scene}: cell {i} of {shape:?}");
            }
        }
    }
    assert_eq!(seen.len(), 6, "every kind of solid: {seen:?}");
    assert!(seen.values().all(|cells| *cells > 1000), "{seen:?}");
}

#[test]
fn flush_and_degenerate_placements_touch_both_neighbours() {
    // A domain of 0..4 with cells of exactly one: a unit cube on cell borders touches 3 x 3 x 3 cells.
    let block = Shape::cuboid(vec3(2.0, 2.0, 2.0), vec3(3.8, 3.8, 3.8), &Default::default()).unwrap();
    let grid = Grid::around(block.aabb(), 1.0 + 1e-12).unwrap();
    assert_eq!(grid.dims(), [4, 4, 4]);
    let cube = |rotation| {
        let look = niwaki_geom::Look { rotation, ..Default::default() };
        Shape::cuboid(vec3(1.5, 1.5, 1.5), vec3(1.0, 1.0, 1.0), &look).unwrap()
    };
    let turned = Mat3::rotation(vec3(0.0, 1.0, 0.0), std::f64::consts::FRAC_PI_2);
    for shape in [cube(None), cube(Some(turned))] {
        assert_eq!(Voxels::of(&shape, &grid).unwrap().count(), 27);
        assert_eq!(Voxels::of_mesh(&shape.world_mesh(), &grid).unwrap().count(), 27);
    }
}

fn target() -> Arc<Target> {
    Arc::new(Target::new(torus(2.0, 0.9, 24, 12), 0.11).unwrap())
}

fn similarity_by_hand(target: &Target, shapes: &[Shape]) -> f64 {
    let grid = target.grid();
    let sets: Vec<Vec<bool>> = shapes.iter().map(|s| ours(s, grid)).collect();
    let [nx, ny, _] = grid.dims();
    let cell = |i: usize| [i % nx, i / nx % ny, i / nx / ny];
    let equal = (0..grid.len()).filter(|i| sets.iter().any(|s| s[*i]) == target.contains(cell(*i))).count();
    equal as f64 / grid.len() as f64
}

#[test]
fn counts_are_those_of_a_list_of_sets_in_any_order() {
    let mut dice = Dice::new(3);
    let target = target();
    let shapes: Vec<Shape> = (0..24).map(|_| any_shape(&mut dice, 1.0)).collect();
    let primitives: Vec<Primitive> = shapes.chunks(2).map(Primitive::new).collect();
    let (mut forward, mut backward) =
        (VolumeMatch::new(target.clone(), 0.02), VolumeMatch::new(target.clone(), 0.02));
    primitives.iter().for_each(|p| forward.add(p));
    primitives.iter().rev().for_each(|p| backward.add(p));
    assert!(forward == backward && forward.log_score().to_bits() == backward.log_score().to_bits());
    assert_eq!(forward.similarity(), similarity_by_hand(&target, &shapes));

    let [nx, ny, nz] = target.grid().dims();
    let sets: Vec<Vec<bool>> = shapes.iter().map(|s| ours(s, target.grid())).collect();
    let mut most = 0;
    for i in 0..nx * ny * nz {
        let count = sets.iter().filter(|s| s[i]).count() as u32;
        assert_eq!(forward.counters().get([i % nx, i / nx % ny, i / nx / ny]), count);
        most = most.max(count);
    }
    assert!(most > 7, "more than three planes are used: {most}");
    let mut filled = vec![false; nx * ny * nz];
    target.visit_filled(&shapes, |[x, y, z]| filled[(z * ny + y) * nx + x] = true);
    assert_eq!(filled, (0..filled.len()).map(|i| sets.iter().any(|s| s[i])).collect::<Vec<_>>());

    // Removing every other primitive leaves what adding only the rest gives, and then nothing.
    let mut rest = VolumeMatch::new(target.clone(), 0.02);
    for (i, p) in primitives.iter().enumerate() {
        if i % 2 == 0 {
            assert!(forward.remove(p));
            assert!(!forward.remove(p));
        } else {
            rest.add(p);
        }
    }
    assert!(forward == rest && forward.log_score().to_bits() == rest.log_score().to_bits());
    primitives.iter().skip(1).step_by(2).for_each(|p| assert!(forward.remove(p)));
    assert!(forward == VolumeMatch::new(target, 0.02));
}

#[test]
fn copies_do_not_see_each_other_and_share_the_rest() {
    let mut dice = Dice::new(11);
    let target = target();
    let mut trunk = VolumeMatch::new(target.clone(), 0.02);
    let shared: Vec<Primitive> = (0..6).map(|_| Primitive::new([any_shape(&mut dice, 2.0)])).collect();
    shared.iter().for_each(|p| trunk.add(p));
    let (before, mut left, mut right) = (trunk.clone(), trunk.clone(), trunk.clone());
    let small = |x: f64| {
        let at = vec3(x, 0.0, 0.0);
        Primitive::new([Shape::cuboid(at, vec3(0.2, 0.2, 0.2), &Default::default()).unwrap()])
    };
    left.add(&small(-2.0));
    right.add(&small(2.0));
    assert!(trunk == before && left != right && left != trunk);
    assert!(left.counters().shared_with(trunk.counters()) > 0);
    let mut alone = VolumeMatch::new(target, 0.02);
    alone.add(&small(-2.0));
    shared.iter().for_each(|p| alone.add(p));
    assert!(left == alone);
    assert!(left.remove(&small(-2.0)) && left == trunk);
}

#[test]
fn overshoot_is_the_sum_over_six_sides_and_comes_back() {
    let target = target();
    let domain = *target.grid().domain();
    let mut sketch = VolumeMatch::new(target, 0.02);
    assert_eq!(sketch.overshoot(), 0.0);
    let extent = domain.extent();
    let around = Shape::cuboid(domain.center(), extent * 1.5, &Default::default()).unwrap();
    let wide = Primitive::new([around]);
    sketch.add(&wide);
    assert!((sketch.overshoot() - 1.5).abs() < 1e-12);
    let long = vec3(0.1, 0.1, extent.z * 2.0);
    let rod = Primitive::new([Shape::cuboid(domain.center(), long, &Default::default()).unwrap()]);
    sketch.add(&rod);
    assert!((sketch.overshoot() - 2.0).abs() < 1e-12);
    sketch.remove(&wide);
    assert!((sketch.overshoot() - 1.0).abs() < 1e-12);
    sketch.remove(&rod);
    assert_eq!(sketch.overshoot(), 0.0);
}
