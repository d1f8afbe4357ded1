//! The points of a receiver that a camera sees, each with its ray to the light.
//!
//! The points are computed once, before a run: the nearest triangle along each pixel's ray. A point is its triangle's
//! first corner plus shares of two edges, so that a floor at one height has points at exactly that height.

use super::camera::Camera;
use super::rays::{Projection, Ray, Rays};
use crate::error::GeomError;
use crate::mesh::TriMesh;
use crate::vector::Vec3;

/// The sine of the angle between light and surface below which the light passes along the surface.
const GRAZING: f64 = 1e-6;

/// A light from far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    direction: Vec3,
}

impl Light {
    /// Light that travels along `direction` (any length): a sun above shines along (0, -1, 0).
    ///
    /// # Errors
    /// `bad-setting` when it has no direction.
    pub fn new(direction: Vec3) -> Result<Light, GeomError> {
        let message = || format!("the light travels along {:?}, expected a direction", direction.to_array());
        let direction = Some(direction).filter(|d| d.is_finite()).and_then(Vec3::unit);
        direction.map(|direction| Light { direction }).ok_or_else(|| GeomError::new("bad-setting", message()))
    }

    /// Unit direction in which the light travels.
    pub fn direction(&self) -> Vec3 {
        self.direction
    }

    /// The projection to the plane across the light; depth grows towards the light.
    pub fn projection(&self) -> Projection {
        let forward = -self.direction;
        let right = forward.any_perpendicular();
        let up = right.cross(forward);
        Projection { origin: Vec3::ZERO, right, up, forward, perspective: false }
    }
}

/// The nearest point of `mesh` on the ray of each pixel that meets it.
pub fn seen_points(mesh: &TriMesh, camera: &Camera, size: [usize; 2]) -> Vec<Ray> {
    nearest(mesh, camera, size).into_iter().map(|(ray, _)| ray).collect()
}

/// The nearest point of `mesh` on the ray of each pixel that meets it, with the unit normal of its triangle.
fn nearest(mesh: &TriMesh, camera: &Camera, size: [usize; 2]) -> Vec<(Ray, Vec3)> {
    let rays = camera.rays(size);
    let projection = *camera.projection();
    let mut hits: Vec<Option<(f64, Vec3, Vec3)>> = vec![None; rays.len()];
    for corners in mesh.corners() {
        let [a, b, c] = corners;
        let Some(normal) = (b - a).cross(c - a).unit() else { continue };
        for number in rays.meeting_triangle(&corners).rays() {
            let ray = rays.ray(number);
            let Some((depth, point)) = on_triangle(&corners, ray.start, projection.direction(ray.at)) else {
                continue;
            };
            if hits[number].is_none_or(|(nearest, ..)| depth < nearest) {
                hits[number] = Some((depth, point, normal));
            }
        }
    }
    let points = hits.into_iter().enumerate().filter_map(|(number, hit)| hit.map(|(_, p, n)| (number, p, n)));
    points.map(|(number, start, normal)| (Ray { start, ..rays.ray(number) }, normal)).collect()
}

/// The distance to the plane of a triangle that the line through `start` along `direction` meets, and the point, clamped to
/// the triangle (Moeller & Trumbore 1997).
fn on_triangle([a, b, c]: &[Vec3; 3], start: Vec3, direction: Vec3) -> Option<(f64, Vec3)> {
    let (e, f) = (*b - *a, *c - *a);
    let across = direction.cross(f);
    let scale = e.dot(across);
    if scale == 0.0 {
        return None;
    }
    let from = start - *a;
    let turned = from.cross(e);
    let s = (from.dot(across) / scale).clamp(0.0, 1.0);
    let t = (direction.dot(turned) / scale).clamp(0.0, 1.0 - s);
    Some((f.dot(turned) / scale, *a + e * s + f * t))
}

/// The rays to the light from the points of `receiver` that the camera sees in a picture of `size`.
///
/// # Errors
/// `receiver-unseen` when no pixel sees the receiver; `light-grazes` when the light passes along the whole receiver, or
/// along its whole visible part.
pub fn shadow_rays(
    receiver: &TriMesh,
    camera: &Camera,
    light: &Light,
    size: [usize; 2],
) -> Result<Rays, GeomError> {
    let grazes = |normal: Vec3| normal.dot(light.direction).abs() < GRAZING;
    let grazed = || {
        let message = format!("light along {:?} passes along it", light.direction.to_array());
        GeomError::new("light-grazes", message)
    };
    if receiver.corners().filter_map(|[a, b, c]| (b - a).cross(c - a).unit()).all(grazes) {
        return Err(grazed());
    }
    let points = nearest(receiver, camera, size);
    if points.is_empty() {
        let depths = receiver.corners().flatten().map(|p| camera.projection().depth(p));
        let message = if depths.fold(f64::NEG_INFINITY, f64::max) < camera.near() {
            "it is behind the camera"
        } else {
            "it is outside of the camera's picture"
        };
        return Err(GeomError::new("receiver-unseen", message));
    }
    if points.iter().all(|(_, normal)| grazes(*normal)) {
        return Err(grazed());
    }
    let projection = light.projection();
    let toward = |(ray, _): &(Ray, Vec3)| Ray { at: projection.fall(ray.start), ..*ray };
    Ok(Rays::new(projection, None, points.iter().map(toward).collect()))
}
