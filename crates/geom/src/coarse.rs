//! The coarse mesh of each convex solid: its corners, placed in the world, and the faces over them.
//!
//! Polygons are inscribed and have a vertex on each axis that they can, because parts are attached flush exactly
//! there. A frustum that ends in a point, and a limb whose rings cut each other's plane, take the general hull.

use crate::convex::{Coarse, Hull, cuboid};
use crate::hull::hull;
use crate::limb::band;
use crate::segment;
use crate::shape::{Placement, Solid};
use crate::topology::Topology;
use crate::vector::{Vec3, vec3};
use std::sync::Arc;

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

/// Sine and cosine of `2 pi k / sides`. Exact on the axes, where flush attachment needs it.
pub(crate) fn ring(sides: usize) -> impl Iterator<Item = (f64, f64)> {
    const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
    const OCTAGON: [(f64, f64); 8] =
        [(0.0, 1.0), (H, H), (1.0, 0.0), (H, -H), (0.0, -1.0), (-H, -H), (-1.0, 0.0), (-H, H)];
    (0..sides).map(move |k| match 8 * k % sides {
        0 => OCTAGON[8 * k / sides],
        _ => (std::f64::consts::TAU * k as f64 / sides as f64).sin_cos(),
    })
}
