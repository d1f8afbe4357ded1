//! Meshes of triangles that a person gives: `mesh`.

use super::measured::{Checks, Form, Measured};
use super::word::kinds::{Faces, Length, Point, Turn, Vertices};
use super::word::{Word, placed, turned};
use crate::bounds::Aabb;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::Mat3;
use niwaki_math::Scalar;
use std::sync::Arc;

impl Measured for Arc<TriMesh> {
    const KIND: &'static str = "mesh";
    const FORM: Form = Form::Mesh;

    fn check(&self, _checks: Checks) -> Result<(), GeomError> {
        Ok(())
    }

    /// The bytes of vertices and triangles.
    fn bytes(&self) -> usize {
        TriMesh::bytes(self)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        Ok(self.placed(|p| placement.apply(p)))
    }

    fn aabb(&self, placement: &Placement) -> Result<Aabb, GeomError> {
        Ok(Aabb::around(self.corners().flatten().map(|p| placement.apply(p))))
    }

    /// A frame at the origin of the mesh, or in its middle if the origin is far away.
    fn frame(&self, placement: &Placement) -> Placement {
        let Ok(around) = Measured::aabb(self, placement) else { return *placement };
        let origin = placement.translation;
        let is_far = Aabb { low: around.low - origin, high: around.high - origin }.is_far();
        Placement { translation: if is_far { around.center() } else { origin }, ..*placement }
    }

    fn mirrored(&self) -> Arc<TriMesh> {
        TriMesh::mirrored(self)
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        crease::creased(self, crease::SHARP)
    }
}

/// A mesh, scaled about its own origin; at a scale of 1 it is shared.
pub(super) fn scaled(mesh: &Arc<TriMesh>, scale: f64) -> Result<Arc<TriMesh>, GeomError> {
    if !(scale > 0.0 && scale.is_finite()) {
        return bad(format!("the scale is {scale}, expected a positive number"));
    }
    Ok(if scale == 1.0 { Arc::clone(mesh) } else { Arc::new(mesh.placed(|p| p * scale)) })
}

word! {
    /// A closed mesh of triangles.
    "mesh" MeshWord {
        /// (n, 3) numbers; data from outside of the model.
        vertices: Vertices,
        /// (m, 3) indices into `vertices`, counter-clockwise seen from outside; data from outside of the model.
        faces: Faces,
        /// Where the mesh's origin goes.
        center: Point = (0.0, 0.0, 0.0),
        /// Turns it about its origin.
        rotation: Option<Turn>,
        /// Factor on all lengths, greater than 0.
        scale: Length = 1.0,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for MeshWord<S> {
    type Solid = Arc<TriMesh>;

    fn solid(&self) -> Result<(Arc<TriMesh>, Placement), GeomError> {
        let mesh = scaled(&self.vertices, self.scale.value())?;
        Ok((mesh, placed(self.center, Mat3::IDENTITY, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        turned(self.center, self.rotation, [self.scale; 3])
    }
}
