//! The coarse mesh of a solid: the corners of each convex one, placed in the world, and the faces over them.
//!
//! Polygons are inscribed and have a vertex on each axis that they can, because parts are attached flush exactly
//! there. A frustum that ends in a point, and a limb whose rings cut each other's plane, take the general hull.

use crate::bounds::Aabb;
use crate::convex::{Coarse, Convex, cuboid};
use crate::error::{GeomError, bad_shape};
use crate::hull::hull;
use crate::limb::band;
use crate::mesh::TriMesh;
use crate::plate;
use crate::polytope::Hull;
use crate::ring::ring;
use crate::segment;
use crate::solid::{Placement, Solid};
use crate::topology::Topology;
use crate::vector::{Vec3, vec3};
use std::sync::Arc;

/// The fault of a solid that lies in a plane.
#[cold]
pub(crate) fn no_inside<T>(solid: &Solid) -> Result<T, GeomError> {
    bad_shape(format!("{} has no inside", solid.kind()))
}

/// The smallest box in the world around a solid that needs no hull for it: around a box, a mesh, or the outline of a flat solid.
///
/// # Errors
/// `bad-shape` for a box without inside, and for a flat solid that is turned out of its plane.
#[inline]
pub(crate) fn aabb(solid: &Solid, placement: &Placement) -> Result<Aabb, GeomError> {
    match solid {
        Solid::Mesh(mesh) => Ok(Aabb::around(mesh.corners().flatten().map(|p| placement.apply(p)))),
        Solid::Box { size } => {
            let convex = Convex::cuboid(*size, placement);
            // A size that is lost in rounding beside the placement leaves the corners equal.
            if convex.width() <= 0.0 {
                return no_inside(solid);
            }
            Ok(Aabb::around(convex.corners().iter().copied()))
        }
        solid => {
            plate::check(solid, placement)?;
            Ok(plate::aabb(solid, placement).unwrap_or(Aabb::EMPTY))
        }
    }
}

/// The coarse mesh in the world; `convex` is the solid where that is convex.
///
/// # Errors
/// `bad-shape` for a solid without geometry.
pub(crate) fn mesh(
    solid: &Solid,
    placement: &Placement,
    convex: Option<Convex<'_>>,
) -> Result<TriMesh, GeomError> {
    match (solid, convex) {
        (Solid::Mesh(mesh), _) => Ok(mesh.placed(|p| placement.apply(p))),
        (solid, _) if solid.is_flat() => {
            plate::plate(solid, plate::COARSE).map(|mesh| mesh.map(|p| placement.apply(p)))
        }
        (_, Some(convex)) => TriMesh::new(convex.vertices().to_vec(), convex.topology().triangles.clone()),
        (_, None) => bad_shape("a solid without geometry".to_string()),
    }
}

/// The convex solid in the world; `None` for a box, a mesh, a flat solid, and for a solid without inside.
pub(crate) fn convex(solid: &Solid, placement: &Placement) -> Option<Coarse> {
    match solid {
        Solid::Segment(tube) => {
            let whole = Hull::nearly(segment::corners(tube)?, segment::tube())?;
            Some(Coarse::of_segment(whole, tube.is_welded()))
        }
        other => hull_of(other, placement).map(Coarse::new),
    }
}

fn hull_of(solid: &Solid, placement: &Placement) -> Option<Hull> {
    match solid {
        Solid::TaperedBox { size, taper } => {
            let vertices = cuboid(*size, *taper, placement).to_vec();
            if *taper > 0.0 { Hull::new(vertices, Topology::shared_cuboid()) } else { hulled(vertices) }
        }
        Solid::Cylinder { radius, length, sides } => prism(*radius, *radius, *length, *sides, placement),
        Solid::TaperedCylinder { radius, top_radius, length, sides } => {
            prism(*radius, *top_radius, *length, *sides, placement)
        }
        Solid::Limb { rings, sides } => {
            let points = rings.iter().flat_map(|ring| ring.vertices(*sides));
            let vertices: Vec<Vec3> = points.map(|p| placement.apply(p)).collect();
            match band(&vertices, *sides) {
                Some(topology) => Hull::new(vertices, Arc::new(topology)),
                None => hulled(vertices),
            }
        }
        Solid::Segment(_)
        | Solid::Box { .. }
        | Solid::Mesh(_)
        | Solid::Stroke { .. }
        | Solid::Ellipse { .. } => None,
    }
}

fn hulled(vertices: Vec<Vec3>) -> Option<Hull> {
    let topology = hull(&vertices)?;
    Hull::new(vertices, Arc::new(topology))
}

fn prism(bottom: f64, top: f64, length: f64, sides: usize, placement: &Placement) -> Option<Hull> {
    let half = 0.5 * length;
    let mut vertices = Vec::with_capacity(2 * sides + 2);
    vertices.extend(ring(sides).map(|(sin, cos)| placement.apply(vec3(sin * bottom, -half, cos * bottom))));
    if top == 0.0 {
        vertices.push(placement.apply(vec3(0.0, half, 0.0)));
        return hulled(vertices);
    }
    vertices.extend(ring(sides).map(|(sin, cos)| placement.apply(vec3(sin * top, half, cos * top))));
    vertices.extend([-half, half].map(|y| placement.apply(vec3(0.0, y, 0.0))));
    if top == bottom { Hull::prism(vertices, sides) } else { Hull::new(vertices, Topology::prism(sides)) }
}
