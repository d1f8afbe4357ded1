//! Shapes from bytes: every kind, of numbers that are mostly ordinary.

use crate::numbers::{below, near, ordinary, point, real, size};
use arbitrary::Unstructured;
use niwaki_geom::solids::{Extrusion, PointHull, Revolution, Solid, Sweep};
use niwaki_geom::{Frame, GeomError, Look, Mat3, Operation, Primitive, Shape, TriMesh, Vec3, vec3};
use std::sync::Arc;

/// A shape, where its numbers make one.
///
/// # Panics
/// When a shape is made of a number that is not one.
pub fn shape(u: &mut Unstructured<'_>) -> Option<Shape> {
    let strange = below(u, 4) == 0;
    let at = |u: &mut Unstructured<'_>| if strange { point(u) } else { near(u) };
    let length = |u: &mut Unstructured<'_>| if strange { real(u) } else { size(u) };
    let rotation = match below(u, 6) {
        0 => near(u).unit().map(|axis| Mat3::rotation(axis, ordinary(u))),
        1 => Some(Mat3::between(Vec3::AXES[1], near(u).unit().unwrap_or(Vec3::AXES[0]))),
        _ => None,
    };
    let look = Look { rotation, ..Look::default() };
    let made = match below(u, 14) {
        0 | 1 => Shape::cuboid(at(u), vec3(length(u), length(u), length(u)), &look),
        2 => {
            let (center, size) = (at(u), vec3(length(u), length(u), length(u)));
            Shape::tapered_box(center, size, length(u), below(u, 3), &look)
        }
        3 => Shape::cylinder(at(u), length(u), length(u), at(u), None, &look),
        4 => Shape::cylinder(at(u), length(u), length(u), at(u), Some(length(u)), &look),
        5 => {
            let normals = ((below(u, 2) == 0).then(|| at(u)), (below(u, 2) == 0).then(|| at(u)));
            Shape::limb(at(u), at(u), (length(u), length(u)), normals, &look)
        }
        6 => segment(u, &at, &length, &look),
        7 => match mesh(u, strange) {
            Ok(mesh) => Shape::mesh(&Arc::new(mesh), at(u), length(u), &look),
            Err(_) => return None,
        },
        8 => {
            let (a, b) = (at(u), at(u));
            let b = if strange { b } else { vec3(b.x, b.y, a.z) };
            Shape::stroke(a, b, (length(u), length(u)), &look)
        }
        9 => Shape::ellipse(at(u), (length(u), length(u)), ordinary(u), &look),
        kind => of_points(u, kind, &at, &length, &look),
    };
    let mut shape = made.ok()?;
    if below(u, 5) == 0 {
        let tool = Shape::cuboid(at(u), vec3(length(u), length(u), length(u)), &look).ok()?;
        let operation = [Operation::Difference, Operation::Intersection, Operation::Union][below(u, 3)];
        shape = Shape::combined(operation, &shape, &tool).ok()?;
    }
    let aabb = shape.aabb();
    assert!(aabb.low.is_finite() && aabb.high.is_finite(), "{shape:?}");
    Some(shape)
}

/// A solid of up to nine points.
fn of_points(
    u: &mut Unstructured<'_>,
    kind: usize,
    at: &dyn Fn(&mut Unstructured<'_>) -> Vec3,
    length: &dyn Fn(&mut Unstructured<'_>) -> f64,
    look: &Look,
) -> Result<Shape, GeomError> {
    let points: Box<[Vec3]> = (0..below(u, 10)).map(|_| at(u)).collect();
    // One time in two around the origin, which is a simple polygon more often.
    let around = below(u, 2) == 0;
    let pair = |(k, p): (usize, &Vec3)| {
        let (sin, cos) = (k as f64).sin_cos();
        if around { [cos * p.x.abs(), sin * p.x.abs()] } else { [p.x, p.y] }
    };
    let pairs: Box<[[f64; 2]]> = points.iter().enumerate().map(pair).collect();
    let solid: Solid = match kind {
        10 => Arc::new(Extrusion { polygon: pairs, height: length(u), twist: ordinary(u), taper: length(u) })
            .into(),
        11 => {
            let outside = pairs.iter().map(|[x, y]| [x.abs(), *y]).collect();
            Arc::new(Revolution { profile: outside }).into()
        }
        12 => {
            let path = (0..below(u, 6)).map(|_| at(u)).collect();
            Arc::new(Sweep { profile: pairs, path, scale: length(u) }).into()
        }
        _ => Arc::new(PointHull { points }).into(),
    };
    Shape::placed(solid, at(u), Mat3::IDENTITY, look)
}

fn segment(
    u: &mut Unstructured<'_>,
    at: &dyn Fn(&mut Unstructured<'_>) -> Vec3,
    length: &dyn Fn(&mut Unstructured<'_>) -> f64,
    look: &Look,
) -> Result<Shape, GeomError> {
    let mut frame = || {
        let forward = at(u).unit().unwrap_or(Vec3::AXES[1]);
        let up = forward.cross(at(u)).unit().unwrap_or(Vec3::AXES[0]);
        Frame { center: at(u), forward, up, radius: length(u) }
    };
    Shape::segment([frame(), frame(), frame()], None, look)
}

/// A mesh of up to twenty triangles, many of them degenerate, or a closed one.
///
/// # Errors
/// Numbers that make no mesh.
pub fn mesh(u: &mut Unstructured<'_>, strange: bool) -> Result<TriMesh, GeomError> {
    if below(u, 3) == 0 {
        let solid = Shape::cuboid(near(u), vec3(size(u), size(u), size(u)), &Look::default())?;
        return Ok(solid.world_mesh().clone());
    }
    let count = 1 + below(u, 12);
    let vertices = (0..count).map(|_| if strange { point(u) } else { near(u) }).collect();
    let corner = |u: &mut Unstructured<'_>| below(u, count) as u32;
    let triangles = (0..below(u, 20)).map(|_| [corner(u), corner(u), corner(u)]).collect();
    TriMesh::new(vertices, triangles)
}

/// One or two shapes that are emitted together.
pub fn primitive(u: &mut Unstructured<'_>) -> Option<Primitive> {
    let first = shape(u)?;
    let second = (below(u, 5) == 0).then(|| shape(u)).flatten();
    Some(Primitive::new([Some(first), second].into_iter().flatten().collect::<Vec<Shape>>()))
}
