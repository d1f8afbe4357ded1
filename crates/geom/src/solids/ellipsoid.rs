//! Spheres and ellipsoids: `sphere`, `ellipsoid`.

use super::measured::{Checks, Measured, Tone};
use super::word::kinds::{Length, Lengths, Point, Turn};
use super::word::{Word, placed, plain, turned};
use crate::convex::Coarse;
use crate::error::GeomError;
use crate::fine::{FineMesh, ROUND};
use crate::once::Once;
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::ring::ring;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Sides of the coarse mesh around y. Of the sphere's volume it has 89 %.
const SIDES: usize = 12;
/// Sine and cosine of the latitudes of the rings between the poles: multiples of 30 degrees.
const RINGS: [(f64, f64); 5] = {
    const COS_30: f64 = 0.866_025_403_784_438_6;
    [(-COS_30, 0.5), (-0.5, COS_30), (0.0, 1.0), (0.5, COS_30), (COS_30, 0.5)]
};

/// An ellipsoid whose axes are those of the coordinates.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Ellipsoid {
    /// Full lengths along x, y and z.
    pub size: Vec3,
}

impl Measured for Ellipsoid {
    const KIND: &'static str = "ellipsoid";
    const TONE: Tone = Tone::Round;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.sizes(self.size)
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let half = self.size * 0.5;
        let vertices = points(SIDES, &RINGS).map(|p| placement.apply(scaled(p, half))).collect();
        Hull::new(vertices, topology()).map(Coarse::new)
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let (half, rows) = (self.size * 0.5, ROUND / 2);
        let inverse = vec3(1.0 / half.x, 1.0 / half.y, 1.0 / half.z);
        let latitude = |row: usize| (PI * (row as f64 / rows as f64 - 0.5)).sin_cos();
        let rings: Vec<(f64, f64)> = (1..rows).map(latitude).collect();
        let mut mesh = FineMesh::default();
        for p in points(ROUND, &rings) {
            mesh.point(scaled(p, half), scaled(p, inverse).unit().unwrap_or(p));
        }
        for face in faces(ROUND, rings.len()) {
            match face[..] {
                [a, b, c, d] => mesh.quad([a, b, c, d]),
                _ => mesh.face([face[0], face[1], face[2]]),
            }
        }
        mesh
    }
}

fn scaled(p: Vec3, factors: Vec3) -> Vec3 {
    vec3(p.x * factors.x, p.y * factors.y, p.z * factors.z)
}

/// Points of the sphere of radius 1: rings from -y to +y, given by height and radius, then the two poles.
fn points(sides: usize, rings: &[(f64, f64)]) -> impl Iterator<Item = Vec3> + '_ {
    let around = rings.iter().flat_map(move |&(height, radius)| {
        ring(sides).map(move |(sin, cos)| vec3(sin * radius, height, cos * radius))
    });
    around.chain([-1.0, 1.0].map(|height| vec3(0.0, height, 0.0)))
}

/// Faces over [`points`]: triangles at the poles, and quadrilaterals.
fn faces(sides: usize, rings: usize) -> Vec<Vec<u32>> {
    let number = |ring: usize, k: usize| (ring * sides + k % sides) as u32;
    let (south, north) = (number(rings, 0), number(rings, 1));
    let mut faces = Vec::new();
    for k in 0..sides {
        faces.push(vec![south, number(0, k + 1), number(0, k)]);
        for ring in 0..rings - 1 {
            faces.push(vec![
                number(ring, k),
                number(ring, k + 1),
                number(ring + 1, k + 1),
                number(ring + 1, k),
            ]);
        }
        faces.push(vec![north, number(rings - 1, k), number(rings - 1, k + 1)]);
    }
    faces
}

fn topology() -> Arc<Topology> {
    static SHARED: OnceLock<Arc<Topology>> = OnceLock::new();
    let build = || Arc::new(Topology::from_faces(SIDES * RINGS.len() + 2, faces(SIDES, RINGS.len())));
    SHARED.once(build).clone()
}

word! {
    /// A sphere.
    "sphere" SphereWord {
        /// Its middle.
        center: Point,
        /// Greater than 0.
        radius: Length,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for SphereWord<S> {
    type Solid = Ellipsoid;

    fn solid(&self) -> Result<(Ellipsoid, Placement), GeomError> {
        let size = 2.0 * self.radius.value();
        Ok((Ellipsoid { size: vec3(size, size, size) }, placed(self.center, Mat3::IDENTITY, None)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        turned(self.center, None, [self.radius; 3])
    }
}

word! {
    /// An ellipsoid: a sphere with a length along each axis.
    "ellipsoid" EllipsoidWord {
        /// Its middle.
        center: Point,
        /// Its three full lengths, greater than 0.
        size: Lengths,
        /// Turns it about its middle.
        rotation: Option<Turn>,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for EllipsoidWord<S> {
    type Solid = Ellipsoid;

    fn solid(&self) -> Result<(Ellipsoid, Placement), GeomError> {
        Ok((Ellipsoid { size: plain(self.size) }, placed(self.center, Mat3::IDENTITY, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        turned(self.center, self.rotation, self.size)
    }
}

#[cfg(test)]
mod tests {
    //! Meshes are closed and nearly as large as the solid; the coarse mesh touches its box on each axis.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::look::Look;

    #[test]
    fn ellipsoids_fill_their_box_and_have_their_volume() {
        let turn = Mat3::between(Vec3::AXES[1], vec3(0.6, 0.8, 0.0));
        for (size, laid) in [
            (vec3(2.0, 2.0, 2.0), Mat3::IDENTITY),
            (vec3(2.0, 1.0, 4.0), Mat3::IDENTITY),
            (vec3(1.0, 3.0, 0.5), turn),
        ] {
            let center = vec3(1.0, -2.0, 3.0);
            let shape = Shape::placed(Ellipsoid { size }.into(), center, laid, &Look::default()).unwrap();
            let volume = PI / 6.0 * size.x * size.y * size.z;
            sound(&shape, volume, 0.01);
            let coarse = shape.world_mesh();
            let inside: f64 = coarse.corners().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
            assert!((inside / volume - 0.89).abs() < 0.005, "{}", inside / volume);
            if laid == Mat3::IDENTITY {
                assert_eq!((shape.aabb().center(), shape.aabb().extent()), (center, size));
            }
        }
    }

    #[test]
    fn the_normals_of_an_ellipsoid_are_its_gradient() {
        let fine = Ellipsoid { size: vec3(2.0, 1.0, 4.0) }.fine(None);
        for (p, n) in fine.vertices.iter().zip(&fine.normals) {
            let gradient = vec3(p.x / 1.0, p.y / 0.25, p.z / 4.0).unit().unwrap();
            assert!((*n - gradient).norm() < 1e-9);
        }
    }
}
