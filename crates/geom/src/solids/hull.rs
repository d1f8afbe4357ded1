//! Convex hulls of given points: `hull`.

use super::measured::{Checks, Measured};
use super::word::kinds::Points;
use super::word::{Word, plain, spread};
use crate::bounds::Aabb;
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::hull::{far_apart, hull};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::polytope::Hull as Polytope;
use crate::vector::Vec3;
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The most points: each is held against every face.
const MOST: usize = 256;

/// The smallest convex solid around points, at their coordinates.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Hull {
    /// Points, of which some may be inside.
    pub points: Box<[Vec3]>,
}

impl Measured for Arc<Hull> {
    const KIND: &'static str = "hull";

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        let count = self.points.len();
        if !(4..=MOST).contains(&count) {
            return bad(format!("a hull has {count} points, expected 4 to {MOST}"));
        }
        for (k, p) in self.points.iter().enumerate() {
            checks.finite(&format!("point {k} of a hull"), *p)?;
        }
        match far_apart(&self.points) {
            None => bad("the points of a hull lie in a plane, expected a point outside of it".to_string()),
            Some(_) => Ok(()),
        }
    }

    fn bytes(&self) -> usize {
        size_of::<Hull>() + size_of_val(&*self.points)
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        Polytope::around(self.points.iter().map(|p| placement.apply(*p)).collect()).map(Coarse::new)
    }

    /// A frame in the middle of the points.
    fn frame(&self, placement: &Placement) -> Placement {
        let around = Aabb::around(self.points.iter().map(|p| placement.apply(*p)));
        Placement { translation: around.center(), ..*placement }
    }

    fn mirrored(&self) -> Arc<Hull> {
        Arc::new(Hull { points: self.points.iter().map(|point| point.mirrored()).collect() })
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let triangles = hull(&self.points).map(|topology| topology.triangles).unwrap_or_default();
        match TriMesh::new(self.points.to_vec(), triangles) {
            Ok(mesh) => crease::creased(&mesh, crease::SHARP),
            // Points that have a hull where they are placed may be within rounding of a plane here.
            Err(_) => FineMesh::default(),
        }
    }
}

word! {
    /// The convex hull of points.
    "hull" HullWord {
        /// At least four, not all in a plane; some may be inside.
        points: Points,
        ..PAINTED
    }
}

/// Notes in a recording that four of the points, which are far from each other, stay off a plane: so there is a hull.
fn note_inside<S: Scalar>(points: &[Vec3], varying: &[[S; 3]]) {
    let Some([origin, a, b, c]) = far_apart(points) else { return };
    let [a, b, c] = [a, b, c].map(|k| [0, 1, 2].map(|i| varying[k][i] - varying[origin][i]));
    let cross = [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
    let _ = cross[0] * c[0] + cross[1] * c[1] + cross[2] * c[2] > S::from_f64(0.0);
}

impl<S: Scalar> Word<S> for HullWord<S> {
    type Solid = Arc<Hull>;

    fn solid(&self) -> Result<(Arc<Hull>, Placement), GeomError> {
        let points: Box<[Vec3]> = self.points.iter().map(|p| plain(*p)).collect();
        if self.points.iter().flatten().any(|x| x.varies()) {
            note_inside(&points, &self.points);
        }
        Ok((Arc::new(Hull { points }), Placement::IDENTITY))
    }

    fn at(&self) -> [[S; 3]; 4] {
        spread(&self.points)
    }
}

#[cfg(test)]
mod tests {
    //! Hulls have the volume of their points' solid; points inside make no difference.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;
    use crate::vector::vec3;

    fn around(points: &[Vec3]) -> Result<Shape, GeomError> {
        let solid = Arc::new(Hull { points: points.into() });
        Shape::new(solid.into(), Placement::IDENTITY, &Look::default())
    }

    /// A roof over a square: two ends of a ridge, four corners, a point inside and one in a face.
    const ROOF: [Vec3; 8] = [
        vec3(0.0, 1.0, 0.0),
        vec3(4.0, 1.0, 0.0),
        vec3(0.0, 1.0, 2.0),
        vec3(4.0, 1.0, 2.0),
        vec3(2.0, 1.5, 1.0),
        vec3(0.0, 3.0, 1.0),
        vec3(4.0, 3.0, 1.0),
        vec3(2.0, 1.0, 1.0),
    ];

    #[test]
    fn hulls_have_their_volume_and_their_box() {
        let roof = around(&ROOF).unwrap();
        sound(&roof, 8.0, 1e-9);
        assert_eq!((roof.aabb().low, roof.aabb().high), (vec3(0.0, 1.0, 0.0), vec3(4.0, 3.0, 2.0)));
        assert_eq!(roof.convex().unwrap().topology().faces.len(), 5);
        let corners: Vec<Vec3> = ROOF.iter().copied().filter(|p| p.y != 1.5 && p.x != 2.0).collect();
        sound(&around(&corners).unwrap(), 8.0, 1e-9);
        sound(&around(&[ROOF[0], ROOF[1], ROOF[2], ROOF[5]]).unwrap(), 8.0 / 3.0, 1e-9);
    }

    #[test]
    fn a_hull_meets_what_is_below_its_ridge() {
        let roof = around(&ROOF).unwrap();
        let above = |y: f64| Shape::cuboid(vec3(2.0, y, 1.0), vec3(1.0, 1.0, 1.0), &Look::default()).unwrap();
        assert!(!intersects(&roof, &above(3.5), Rule::Solid));
        assert!(intersects(&roof, &above(3.4), Rule::Solid));
    }

    #[test]
    fn points_without_a_hull_are_refused() {
        let message = |points: &[Vec3]| around(points).map_or_else(|error| error.message, |_| String::new());
        assert!(message(&ROOF[..3]).contains("a hull has 3 points, expected 4 to 256"));
        assert!(message(&ROOF[..4]).contains("the points of a hull lie in a plane"));
        assert!(message(&[ROOF[0]; 5]).contains("the points of a hull lie in a plane"));
        let nowhere = [ROOF[0], ROOF[1], ROOF[2], vec3(0.0, f64::NAN, 0.0)];
        assert!(message(&nowhere).contains("point 3 of a hull is [0.0, NaN, 0.0]"));
    }
}
