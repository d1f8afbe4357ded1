//! Voxels of every solid agree with a loop over all cells, and counts with adding and removing in any order.
//!
//! The loop tests each triangle against each cell and fills what they enclose. Cells that a solid misses or touches by
//! less than the tolerance of a test may or may not be filled, so the loop gives two results: with the solid shrunk and
//! grown by a ten-thousandth of a cell. The engine's result must lie between them.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

mod scenes;

use niwaki_geom::voxel::surface::touches;
use niwaki_geom::{
    CellWeight, Grid, Mat3, Primitive, Shape, Sketch, Target, TriMesh, Vec3, VolumeMatch, Voxels, vec3,
};
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
    assert_eq!(seen.len(), 10, "every kind of solid: {seen:?}");
    assert!(seen.values().all(|cells| *cells > 500), "{seen:?}");
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

/// Cells of both of the cells of either, by sets of cells; the log score of it, after any order of adding and removing.
#[test]
fn balanced_counts_only_cells_that_either_fills() {
    let mut dice = Dice::new(5);
    let target = target();
    let shapes: Vec<Shape> = (0..8).map(|_| any_shape(&mut dice, 1.5)).collect();
    let sets: Vec<Vec<bool>> = shapes.iter().map(|s| ours(s, target.grid())).collect();
    let [nx, ny, nz] = target.grid().dims();
    let (mut both, mut either) = (0, 0);
    for i in 0..nx * ny * nz {
        let (scene, goal) = (sets.iter().any(|s| s[i]), target.contains([i % nx, i / nx % ny, i / nx / ny]));
        both += usize::from(scene && goal);
        either += usize::from(scene || goal);
    }
    assert!(both > 0 && both < target.filled() && either > target.filled());
    let index = both as f64 / either as f64;
    let start = VolumeMatch::new(target.clone(), 0.02).weighted(CellWeight::Balanced);
    let mut sketch = start.clone();
    shapes.iter().for_each(|s| sketch.add(&Primitive::new([s.clone()])));
    assert_eq!(sketch.similarity(), index);
    let normal = |z: f64, sigma: f64| -0.5 * (z * z) - (sigma * std::f64::consts::TAU.sqrt()).ln();
    let by_hand = normal((index - 1.0) / 0.1, 0.1) + normal(sketch.overshoot() / 0.02, 0.02);
    assert!((sketch.log_score() - by_hand).abs() < 1e-9 * by_hand.abs(), "{} {by_hand}", sketch.log_score());
    // A copy in place has the weight of its source.
    let mut copy = VolumeMatch::new(target.clone(), 0.02);
    copy.clone_from(&sketch);
    assert_eq!(copy.log_score().to_bits(), sketch.log_score().to_bits());
    shapes.iter().for_each(|s| assert!(sketch.remove(&Primitive::new([s.clone()]))));
    assert!(sketch == start && sketch.similarity() == 0.0);
}

#[test]
fn copies_are_independent_and_share_unchanged_data() {
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

/// A prism over an outline, its ends cut by `cut` into triangles of the outline's corners (or of others, from `more`).
fn prism(outline: &[[f64; 2]], more: &[[f64; 2]], cut: &[[u32; 3]], turn: &Mat3) -> TriMesh {
    let count = outline.len() as u32;
    let all: Vec<[f64; 2]> = outline.iter().chain(more).copied().collect();
    let above = all.len() as u32;
    let level = |z: f64| all.iter().map(move |[x, y]| turn.apply(vec3(*x, *y, z)));
    let vertices = level(-0.7).chain(level(0.9)).collect();
    let mut faces: Vec<[u32; 3]> = cut.iter().map(|[a, b, c]| [*c, *b, *a]).collect();
    faces.extend(cut.iter().map(|t| t.map(|v| v + above)));
    for k in 0..count {
        let next = (k + 1) % count;
        faces.extend([[k, next, next + above], [k, next + above, k + above]]);
    }
    TriMesh::new(vertices, faces).unwrap()
}

fn fan(count: usize, first: usize) -> Vec<[u32; 3]> {
    let at = |k: usize| ((first + k) % count) as u32;
    (1..count - 1).map(|k| [at(0), at(k), at(k + 1)]).collect()
}

fn cells(mesh: &TriMesh, grid: &Grid) -> Vec<bool> {
    let [nx, ny, _] = grid.dims();
    let voxels = Voxels::of_mesh(mesh, grid).unwrap();
    (0..grid.len()).map(|i| voxels.contains([i % nx, i / nx % ny, i / nx / ny])).collect()
}

#[test]
fn cells_do_not_depend_on_how_a_polygon_is_cut() {
    // Stars around their middle: triangles from the middle cover them, a fan from a corner lies over itself.
    let mut dice = Dice::new(19);
    let (mut folded, mut beyond) = (0, 0);
    for scene in 0..150 {
        let count = 4 + dice.below(12);
        let reach: Vec<f64> = (0..count).map(|_| dice.uniform(0.3, 2.0)).collect();
        let corner = |k: usize| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            [reach[k] * cos, reach[k] * sin]
        };
        let outline: Vec<[f64; 2]> = (0..count).map(corner).collect();
        let middle: Vec<[u32; 3]> =
            (0..count).map(|k| [count as u32, k as u32, ((k + 1) % count) as u32]).collect();
        let axis = dice.point(1.0).unit().unwrap();
        let turn = Mat3::rotation(axis, if scene % 3 == 0 { 0.0 } else { dice.uniform(0.0, 6.0) });
        let whole = prism(&outline, &[[0.0, 0.0]], &middle, &turn);
        let grid = Grid::around(&whole.aabb(), dice.uniform(0.12, 0.4)).unwrap();
        let right = cells(&whole, &grid);
        for first in 0..count {
            let cut = fan(count, first);
            let mesh = prism(&outline, &[], &cut, &turn);
            assert!(cells(&mesh, &grid) == right, "scene {scene}, fan from {first} of {count}");
            let area = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|v| outline[v as usize]);
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            };
            folded += usize::from(cut.iter().any(|t| area(t) < -1e-3));
            if first == 0 {
                beyond += plainly(&mesh, &grid).iter().zip(&right).filter(|(p, r)| p != r).count();
            }
        }
    }
    // The triangles alone touch more.
    assert!(folded > 500 && beyond > 500, "{folded} {beyond}");
}

#[test]
fn a_placed_mesh_that_lies_over_itself_fills_the_cells_of_its_outline() {
    let outline = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [1.0, 3.0]];
    let right = Arc::new(prism(&outline, &[], &fan(4, 1), &Mat3::IDENTITY));
    let wrong = Arc::new(prism(&outline, &[], &fan(4, 0), &Mat3::IDENTITY));
    let mut dice = Dice::new(23);
    for _ in 0..40 {
        let rotation = Some(Mat3::rotation(dice.point(1.0).unit().unwrap(), dice.uniform(0.0, 6.0)));
        let look = niwaki_geom::Look { rotation, ..Default::default() };
        let (center, scale) = (dice.point(1.0), dice.uniform(0.3, 2.0));
        let grid = some_grid(&mut dice);
        let [a, b] =
            [&right, &wrong].map(|mesh| ours(&Shape::mesh(mesh, center, scale, &look).unwrap(), &grid));
        assert!(a == b && a.iter().any(|filled| *filled));
    }
}

#[test]
fn sheets_with_two_sides_and_faces_that_touch_are_kept() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    let corners: Vec<Vec3> = square.iter().map(|[x, y]| vec3(*x, *y, 0.3 * x)).collect();
    let front = vec![[0, 1, 2], [0, 2, 3]];
    let both: Vec<[u32; 3]> = front.iter().copied().chain([[1, 0, 3], [1, 3, 2]]).collect();
    let [sheet, leaf] = [front, both].map(|faces| TriMesh::new(corners.clone(), faces).unwrap());
    let grid = Grid::around(&sheet.aabb(), 0.11).unwrap();
    assert_eq!(cells(&sheet, &grid), plainly(&sheet, &grid));
    assert_eq!(cells(&leaf, &grid), cells(&sheet, &grid));
    // Two boxes share an edge and a part of a face: what is between them is inside.
    let cube =
        |low: Vec3, high: Vec3| Shape::cuboid((low + high) * 0.5, high - low, &Default::default()).unwrap();
    let boxes = [cube(Vec3::ZERO, vec3(1.0, 2.0, 1.0)), cube(vec3(1.0, 0.0, 0.0), vec3(2.0, 1.0, 1.0))];
    let mut joined = (Vec::new(), Vec::new());
    for shape in &boxes {
        let mesh = shape.world_mesh();
        joined.1.extend(mesh.triangles().iter().map(|t| t.map(|v| v + joined.0.len() as u32)));
        joined.0.extend_from_slice(mesh.vertices());
    }
    let joined = TriMesh::new(joined.0, joined.1).unwrap();
    let grid = Grid::around(&joined.aabb(), 0.13).unwrap();
    assert_eq!(cells(&joined, &grid), plainly(&joined, &grid));
}

/// A box around a smaller one that faces inwards, or outwards.
fn hollow(inwards: bool) -> TriMesh {
    let cube = |size: f64| {
        let shape = Shape::cuboid(Vec3::ZERO, vec3(size, size, size), &Default::default()).unwrap();
        (shape.world_mesh().vertices().to_vec(), shape.world_mesh().triangles().to_vec())
    };
    let ((mut vertices, mut faces), (inner, more)) = (cube(4.0), cube(2.4));
    let start = vertices.len() as u32;
    vertices.extend(inner);
    faces.extend(
        more.iter()
            .map(|[a, b, c]| [*a, *b, *c].map(|v| v + start))
            .map(|[a, b, c]| if inwards { [a, c, b] } else { [a, b, c] }),
    );
    TriMesh::new(vertices, faces).unwrap()
}

#[test]
fn a_cavity_is_filled_on_whichever_side_its_surface_faces() {
    // Above 2^24 cells as well, where a mesh beyond the domain is cut to it: here the domain is within the cavity.
    let within = Shape::cuboid(Vec3::ZERO, vec3(1.0, 1.0, 1.0), &Default::default()).unwrap();
    for (domain, voxel) in [(hollow(true).aabb(), 0.2), (*within.aabb(), 0.2), (*within.aabb(), 0.013)] {
        let grid = Grid::around(&domain, voxel).unwrap();
        let [inwards, outwards] = [true, false].map(|side| Voxels::of_mesh(&hollow(side), &grid).unwrap());
        assert_eq!(inwards.count(), outwards.count());
        let [nx, ny, nz] = grid.dims();
        assert!(inwards.contains([nx / 2, ny / 2, nz / 2]));
    }
}
