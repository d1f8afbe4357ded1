//! Claims: the surface of a cut winds around the points of its tree and no others, with volumes that add up; it fills the
//! cells that its surface and its inside meet; faces that lie on one another leave no film; the order of leaves decides nothing.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

use niwaki_geom::Operation::{self, Difference, Intersection, Union};
use niwaki_geom::intersect::inside::contains;
use niwaki_geom::solids::Torus;
use niwaki_geom::voxel::surface::touches;
use niwaki_geom::{
    Aabb, Grid, Look, Mat3, Placement, Rule, Shape, Solid, TriMesh, Vec3, Voxels, intersects, vec3,
};

fn cuboid(center: [f64; 3], size: [f64; 3]) -> Shape {
    Shape::cuboid(center.into(), size.into(), &Look::default()).unwrap()
}

fn turned(center: [f64; 3], size: [f64; 3], angle: f64) -> Shape {
    let rotation = Some(Mat3::rotation(vec3(0.6, 0.0, 0.8), angle));
    Shape::cuboid(center.into(), size.into(), &Look { rotation, ..Look::default() }).unwrap()
}

fn cylinder(center: [f64; 3], radius: f64, height: f64) -> Shape {
    Shape::cylinder(center.into(), radius, height, vec3(0.0, 0.0, 1.0), None, &Look::default()).unwrap()
}

fn torus(center: [f64; 3], radius: f64, tube: f64) -> Shape {
    let placement = Placement { translation: center.into(), ..Placement::IDENTITY };
    Shape::new(Solid::Torus(Torus { radius, tube }), placement, &Look::default()).unwrap()
}

fn of(operation: Operation, a: &Shape, b: &Shape) -> Shape {
    Shape::combined(operation, a, b).unwrap()
}

fn volume(shape: &Shape) -> f64 {
    shape.world_mesh().corners().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// Numbers from 0 to 1, always the same.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self, reach: f64) -> Vec3 {
        let mut coordinate = || reach * (2.0 * self.roll() - 1.0);
        vec3(coordinate(), coordinate(), coordinate())
    }

    fn solid(&mut self) -> Shape {
        let center = self.point(0.6).to_array();
        let mut length = || 0.4 + 1.2 * self.roll();
        let size = [length(), length(), length()];
        match (8.0 * self.roll()) as usize {
            0 | 1 => cuboid(center, size),
            2 | 3 => turned(center, size, 3.0 * self.roll()),
            4 | 5 => cylinder(center, 0.5 * size[0], size[1]),
            6 => torus(center, 0.7 * size[0], 0.25 * size[0]),
            _ => {
                let mesh = torus([0.0; 3], 0.6 * size[1], 0.3 * size[1]).world_mesh().clone();
                Shape::mesh(&std::sync::Arc::new(mesh), center.into(), 1.0, &Look::default()).unwrap()
            }
        }
    }
}

#[test]
fn surfaces_wind_around_the_points_of_the_tree() {
    let mut dice = Dice(7);
    let (mut inside, mut empty) = (0, 0);
    for round in 0..40 {
        let solids: Vec<Shape> = (0..2 + round % 3).map(|_| dice.solid()).collect();
        let mut tree = solids[0].clone();
        let mut operations = Vec::new();
        let mut is_empty = false;
        for solid in &solids[1..] {
            let operation = [Difference, Intersection, Union][(3.0 * dice.roll()) as usize];
            match Shape::combined(operation, &tree, solid) {
                Ok(next) => tree = next,
                Err(error) => {
                    assert_eq!(error.message, "nothing is left of the solid");
                    is_empty = true;
                    break;
                }
            }
            operations.push(operation);
        }
        if is_empty {
            empty += 1;
            continue;
        }
        for _ in 0..60 {
            let p = dice.point(1.4);
            let mut is_inside = contains(&solids[0], p);
            for (operation, solid) in operations.iter().zip(&solids[1..]) {
                let there = contains(solid, p);
                is_inside = match operation {
                    Difference => is_inside && !there,
                    Intersection => is_inside && there,
                    Union => is_inside || there,
                };
            }
            assert_eq!(contains(&tree, p), is_inside, "round {round} at {p:?}");
            inside += usize::from(is_inside);
        }
    }
    assert!(inside > 100 && empty < 12, "{inside} {empty}");
}

#[test]
fn volumes_add_up() {
    let mut dice = Dice(3);
    for round in 0..40 {
        let (a, b) = (dice.solid(), dice.solid());
        let Ok(both) = Shape::combined(Intersection, &a, &b) else { continue };
        let (all, rest) = (of(Union, &a, &b), Shape::combined(Difference, &a, &b));
        let rest = rest.map_or(0.0, |rest| volume(&rest));
        let (va, vb, common) = (volume(&a), volume(&b), volume(&both));
        assert!(common > 0.0);
        assert!((volume(&all) + common - va - vb).abs() < 1e-9 * (va + vb), "round {round}");
        assert!((rest + common - va).abs() < 1e-9 * (va + vb), "round {round}");
    }
}

/// The cells that the surface of a shape touches, or whose middle it winds around, one by one.
fn cells_by_hand(shape: &Shape, grid: &Grid) -> Vec<[usize; 3]> {
    let [nx, ny, nz] = grid.dims();
    let mesh = shape.world_mesh();
    let triangles: Vec<[Vec3; 3]> = mesh.corners().map(|t| t.map(|p| grid.to_grid(p))).collect();
    let middle = |cell: [usize; 3]| grid.to_world(vec3(0.4, 0.6, 0.5) + Vec3::from(cell.map(|i| i as f64)));
    (0..nx * ny * nz)
        .map(|i| [i % nx, i / nx % ny, i / nx / ny])
        .filter(|cell| {
            triangles.iter().any(|t| touches(t, cell.map(|i| i as i64))) || contains(shape, middle(*cell))
        })
        .collect()
}

#[test]
fn cells_are_those_that_the_solid_meets() {
    let mut dice = Dice(11);
    let bounds = Aabb { low: vec3(-1.2, -1.1, -1.0), high: vec3(1.0, 1.2, 1.1) };
    let grid = Grid::around(&bounds, 0.21).unwrap();
    let mut filled = 0;
    let mut check = |shape: &Shape, title: &str| {
        let voxels = Voxels::of(shape, &grid);
        let [nx, ny, nz] = grid.dims();
        let all = (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]);
        let cells: Vec<[usize; 3]> =
            all.filter(|cell| voxels.as_ref().is_some_and(|voxels| voxels.contains(*cell))).collect();
        assert_eq!(cells, cells_by_hand(shape, &grid), "{title}");
        filled += cells.len();
    };
    for round in 0..14 {
        let (a, b, c) = (dice.solid(), dice.solid(), dice.solid());
        for operation in [Difference, Intersection, Union] {
            if let Ok(tree) = Shape::combined(operation, &a, &b) {
                check(&tree, &format!("{operation:?} {round}"));
                if let Ok(tree) = Shape::combined(Difference, &tree, &c) {
                    check(&tree, &format!("{operation:?}, Difference {round}"));
                }
            }
        }
    }
    // A room without a door is empty inside.
    let room = of(Difference, &cuboid([0.0; 3], [1.9; 3]), &cuboid([0.0; 3], [1.3; 3]));
    check(&room, "room");
    assert!(filled > 3000, "{filled}");
}

#[test]
fn a_hole_of_the_thickness_of_its_wall_is_open() {
    let wall = cuboid([0.0; 3], [4.0, 3.0, 0.25]);
    for (depth, angle) in [(0.25, 0.0), (0.26, 0.0), (1.0, 0.0)] {
        let hole = of(Difference, &wall, &cuboid([0.0; 3], [1.0, 1.0, depth]));
        assert!((volume(&hole) - (12.0 - 1.0) * 0.25).abs() < 1e-9, "{depth} {angle}");
        let grid = Grid::around(wall.aabb(), 0.1).unwrap();
        let voxels = Voxels::of(&hole, &grid).unwrap();
        let [nx, ny, nz] = grid.dims();
        assert!((0..nz).all(|z| !voxels.contains([nx / 2, ny / 2, z])), "no film");
        assert!(voxels.contains([nx / 8, ny / 2, nz / 2]));
        // Through the hole, a ray meets nothing.
        let through = hole.world_mesh().corners().any(|[a, b, c]| {
            let side = |p: Vec3, q: Vec3| p.x * q.y - p.y * q.x;
            let turns = [side(a, b), side(b, c), side(c, a)];
            turns.iter().all(|s| *s > 1e-9) || turns.iter().all(|s| *s < -1e-9)
        });
        assert!(!through);
    }
}

#[test]
fn faces_on_one_another_leave_nothing_between() {
    let (low, high) = (cuboid([0.0, 0.5, 0.0], [1.0, 1.0, 1.0]), cuboid([0.0, 1.5, 0.0], [1.0, 1.0, 1.0]));
    let tower = of(Union, &low, &high);
    let mesh = tower.world_mesh();
    let is_level = |t: &[Vec3; 3]| t.iter().all(|p| (p.y - 1.0).abs() < 1e-12);
    assert_eq!(mesh.corners().filter(is_level).count(), 0);
    assert!((volume(&tower) - 2.0).abs() < 1e-12);
    for (a, b) in [(&low, &low), (&low, &tower)] {
        assert!(Shape::combined(Difference, a, b).is_err());
        assert_eq!(volume(&of(Intersection, a, b)), 1.0);
    }
    assert!(Shape::combined(Intersection, &low, &high).is_err(), "they only touch");
    assert_eq!(volume(&of(Difference, &tower, &high)), 1.0);
    // The same solid twice has each face once.
    let twice = of(Union, &of(Union, &low, &low), &low);
    assert_eq!(volume(&twice), 1.0);
    assert!((volume(&of(Union, &twice, &tower)) - 2.0).abs() < 1e-12);
}

#[test]
fn a_frame_fits_into_its_opening() {
    for angle in [0.0, 0.4] {
        let bar = |center: [f64; 3], size: [f64; 3]| turned(center, size, angle);
        let opening = [1.2, 1.0, 0.6];
        let wall = of(Difference, &bar([0.0; 3], [4.0, 3.0, 0.3]), &bar([0.0; 3], opening));
        let frame = |outer: [f64; 2], depth: f64| {
            let [w, h] = outer;
            of(Difference, &bar([0.0; 3], [w, h, depth]), &bar([0.0; 3], [w - 0.2, h - 0.2, 2.0 * depth]))
        };
        for rule in [Rule::Solid] {
            let meets = |a: &Shape, b: &Shape| {
                assert_eq!(intersects(a, b, rule), intersects(b, a, rule));
                intersects(a, b, rule)
            };
            for depth in [0.1, 0.3, 0.5] {
                assert!(!meets(&wall, &frame([1.2, 1.0], depth)), "a frame of the size of the opening fits");
                assert!(!meets(&wall, &frame([1.1, 0.9], depth)), "a smaller one fits");
                assert!(meets(&wall, &frame([1.21, 1.0], depth)), "a larger one does not");
                assert!(meets(&wall, &frame([1.2, 1.01], depth)), "a larger one does not");
            }
            let pane = bar([0.0; 3], [1.0, 0.8, 0.02]);
            assert!(!meets(&frame([1.2, 1.0], 0.1), &pane) && !meets(&wall, &pane));
            // The pane has a common inside with the wall without its hole, and with the cutter.
            assert!(meets(&bar([0.0; 3], [4.0, 3.0, 0.3]), &pane));
        }
    }
}

#[test]
fn many_holes_move_together() {
    let wall = cuboid([0.0; 3], [4.0, 3.0, 0.3]);
    let mut holes = wall;
    for k in 0..30 {
        holes = of(Difference, &holes, &cylinder([0.1 * f64::from(k) - 1.4, 0.0, 0.0], 0.04, 1.0));
    }
    assert_eq!(holes.leaves().len(), 31);
    let moved =
        Placement { rotation: Mat3::rotation(vec3(0.0, 1.0, 0.0), 0.5), translation: vec3(3.0, 0.0, 1.0) };
    let look = Look::default();
    let placed = Shape::new(holes.solid().clone(), moved, &look).unwrap();
    assert!((volume(&placed) - volume(&holes)).abs() < 1e-9);
    assert!(
        (moved.apply(holes.world_mesh().vertices()[5]) - placed.world_mesh().vertices()[5]).norm() < 1e-9
    );
}

#[test]
fn the_fine_mesh_has_normals_and_the_paint_of_each_solid() {
    let red = Look { color: Some([0.8, 0.1, 0.1]), ..Look::default() };
    let wall = cuboid([0.0; 3], [4.0, 3.0, 0.3]);
    let hole = Shape::cylinder(Vec3::ZERO, 0.5, 1.0, vec3(0.0, 0.0, 1.0), None, &red).unwrap();
    let cut = of(Difference, &wall, &hole);
    let coats = cut.coats();
    assert_eq!(coats.iter().map(Shape::color).collect::<Vec<_>>(), [None, red.color]);
    assert_eq!(of(Difference, &wall, &cylinder([0.0; 3], 0.5, 1.0)).coats().len(), 1);
    let area = |shape: &Shape| {
        let fine = shape.fine_mesh();
        let corners = |face: &[u32; 3]| face.map(|v| fine.vertices[v as usize]);
        for (p, n) in fine.vertices.iter().zip(&fine.normals) {
            assert!((n.norm() - 1.0).abs() < 1e-9);
            if shape.color().is_some() {
                // The wall of the hole looks at its axis.
                assert!(
                    (p.x.hypot(p.y) - 0.5).abs() < 0.002 && n.dot(vec3(p.x, p.y, 0.0)) < -0.49,
                    "{p:?} {n:?}"
                );
            }
        }
        fine.faces.iter().map(corners).map(|[a, b, c]| (b - a).cross(c - a).norm() / 2.0).sum::<f64>()
    };
    let [faces, round] = [area(&coats[0]), area(&coats[1])];
    assert!((area(&cut) - faces - round).abs() < 1e-9);
    assert!((round - std::f64::consts::PI * 0.3).abs() < 0.002, "{round}");
    let mesh = cut.fine_mesh();
    let mesh = TriMesh::new(mesh.vertices, mesh.faces).unwrap();
    let volume: f64 = mesh.corners().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
    assert!((volume - (12.0 - std::f64::consts::PI / 4.0) * 0.3).abs() < 0.01);
}
