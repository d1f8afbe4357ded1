//! Crossing of two surfaces: triangle against triangle, by the intervals in which each cuts the other's plane
//! (Moeller 1997).
//!
//! A vertex close to the other triangle's plane counts as on it. Triangles in one plane never cross, and the
//! intervals on the common line must overlap by more than `1e-10`.

use crate::bounds::Aabb;
use crate::solids::shape::Shape;
use crate::vector::Vec3;

/// The rule by which a vertex counts as on a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing {
    /// The original's rule: within `1e-6`, measured with the unnormalised normal (twice the area times the distance).
    /// A triangle whose first vertex is on the plane never crosses it.
    Original,
    /// Within this distance, scene units.
    Deeper(f64),
}

const LINE: f64 = 1e-10;

type Corners = [Vec3; 3];

/// True when a triangle of one shape crosses a triangle of the other.
pub fn cross(a: &Shape, b: &Shape, crossing: Crossing) -> bool {
    let near_b = near(a, b.aabb(), crossing);
    if near_b.is_empty() {
        return false;
    }
    let reach = near_b.iter().fold(Aabb::EMPTY, |all, t| all.union(&t.aabb));
    let near_a = near(b, &reach, crossing);
    near_b.iter().any(|s| near_a.iter().any(|t| s.aabb.meets(&t.aabb) && s.crosses(t, crossing)))
}

struct Triangle {
    corners: Corners,
    aabb: Aabb,
    normal: Vec3,
}

/// Triangles of `shape` whose box meets `limits`.
fn near(shape: &Shape, limits: &Aabb, crossing: Crossing) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    let mut push = |corners: Corners| {
        let low = corners[0].min(corners[1]).min(corners[2]);
        let aabb = Aabb { low, high: corners[0].max(corners[1]).max(corners[2]) };
        if aabb.meets(limits) {
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let normal = match crossing {
                Crossing::Original => Some(normal),
                Crossing::Deeper(_) => normal.unit(),
            };
            // A triangle without area crosses nothing.
            triangles.extend(normal.map(|normal| Triangle { corners, aabb, normal }));
        }
    };
    match shape.convex() {
        Some(convex) => {
            let vertices = convex.vertices();
            convex.topology().triangles.iter().for_each(|t| push(t.map(|v| vertices[v as usize])));
        }
        None => shape.world_mesh().corners().for_each(push),
    }
    triangles
}

impl Triangle {
    fn crosses(&self, other: &Triangle, crossing: Crossing) -> bool {
        let Some(ours) = self.sides_of(&other.corners, crossing) else { return false };
        let Some(theirs) = other.sides_of(&self.corners, crossing) else { return false };
        // The planes' common line; its largest coordinate orders points on it.
        let line = self.normal.cross(other.normal);
        let size = line.to_array().map(f64::abs);
        let axis =
            if size[0] >= size[1] && size[0] >= size[2] { 0 } else { 1 + usize::from(size[2] > size[1]) };
        let (a, b) = (interval(&self.corners, theirs, axis), interval(&other.corners, ours, axis));
        a.1.min(b.1) - a.0.max(b.0) > LINE
    }

    /// Signed distances of `corners` from this triangle's plane; `None` when they do not cross it.
    #[inline]
    fn sides_of(&self, corners: &Corners, crossing: Crossing) -> Option<[f64; 3]> {
        let tolerance = match crossing {
            Crossing::Original => 1e-6,
            Crossing::Deeper(depth) => depth,
        };
        let d = corners.map(|p| {
            let d = self.normal.dot(p - self.corners[0]);
            if d.abs() < tolerance { 0.0 } else { d }
        });
        let crosses = match crossing {
            Crossing::Original => d[0] * d[1] < 0.0 || d[0] * d[2] < 0.0,
            Crossing::Deeper(_) => d.iter().any(|d| *d > 0.0) && d.iter().any(|d| *d < 0.0),
        };
        crosses.then_some(d)
    }
}

/// The interval in which a triangle cuts a plane, along coordinate `axis` of the line; `d` are its corners' distances.
fn interval(corners: &Corners, d: [f64; 3], axis: usize) -> (f64, f64) {
    // The corner alone on its side: both of its edges cross the plane.
    let lone = if d[0] * d[1] > 0.0 {
        2
    } else if d[0] * d[2] > 0.0 {
        1
    } else if d[1] * d[2] > 0.0 || d[0] != 0.0 {
        0
    } else {
        1 + usize::from(d[1] == 0.0)
    };
    let cut = |other: usize| {
        let t = d[lone] / (d[lone] - d[other]);
        corners[lone][axis] + t * (corners[other][axis] - corners[lone][axis])
    };
    let (p, q) = (cut((lone + 1) % 3), cut((lone + 2) % 3));
    (p.min(q), p.max(q))
}
