//! Wedges, as of gable roofs: `wedge`.

use super::measured::{Checks, Measured};
use super::word::kinds::{Lengths, Number, Point, Turn};
use super::word::{Word, placed, plain, turned};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::mesh::TriMesh;
use crate::once::Once;
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::topology::Topology;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, OnceLock};

/// A box whose upper face is a ridge along x.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Wedge {
    /// Full lengths along x (the ridge), y (up) and z.
    pub size: Vec3,
    /// Where the ridge is between the edges at -z (-1) and +z (1).
    pub ridge: f64,
}

impl Wedge {
    fn corners(&self) -> [Vec3; 6] {
        let Vec3 { x, y, z } = self.size * 0.5;
        let ridge = self.ridge * z;
        [
            vec3(-x, -y, -z),
            vec3(-x, -y, z),
            vec3(x, -y, z),
            vec3(x, -y, -z),
            vec3(-x, y, ridge),
            vec3(x, y, ridge),
        ]
    }
}

impl Measured for Wedge {
    const KIND: &'static str = "wedge";

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.sizes(self.size)?;
        match (-1.0..=1.0).contains(&self.ridge) {
            true => Ok(()),
            false => bad(format!("the ridge of a wedge is {}, expected -1 to 1", self.ridge)),
        }
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let vertices = self.corners().map(|p| placement.apply(p)).to_vec();
        Hull::new(vertices, topology()).map(Coarse::new)
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let mesh = TriMesh::new(self.corners().to_vec(), topology().triangles.clone());
        crease::creased(&mesh.expect("finite corners and six vertices"), crease::SHARP)
    }
}

fn topology() -> Arc<Topology> {
    static SHARED: OnceLock<Arc<Topology>> = OnceLock::new();
    let build = || {
        let faces = [vec![0, 3, 2, 1], vec![1, 2, 5, 4], vec![3, 0, 4, 5], vec![0, 1, 4], vec![2, 3, 5]];
        Arc::new(Topology::from_faces(6, faces.to_vec()))
    };
    SHARED.once(build).clone()
}

word! {
    /// A wedge: a gable roof whose ridge runs along x.
    "wedge" WedgeWord {
        /// The middle of the box around it.
        center: Point,
        /// The side lengths of this box, greater than 0.
        size: Lengths,
        /// Turns it about its middle.
        rotation: Option<Turn>,
        /// Place of the ridge across: 0 in the middle, -1 and 1 above the edges at -z and +z (a ramp).
        ridge: Number = 0.0,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for WedgeWord<S> {
    type Solid = Wedge;

    fn solid(&self) -> Result<(Wedge, Placement), GeomError> {
        let wedge = Wedge { size: plain(self.size), ridge: self.ridge.value() };
        Ok((wedge, placed(self.center, Mat3::IDENTITY, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        turned(self.center, self.rotation, self.size)
    }
}

#[cfg(test)]
mod tests {
    //! Half of its box, with five faces, wherever the ridge is.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::look::Look;

    #[test]
    fn a_wedge_is_half_of_its_box() {
        let (center, size) = (vec3(1.0, 2.0, 3.0), vec3(4.0, 1.0, 2.0));
        for ridge in [-1.0, -0.3, 0.0, 1.0] {
            let shape = Shape::placed(Wedge { size, ridge }.into(), center, Mat3::IDENTITY, &Look::default());
            let shape = shape.unwrap();
            sound(&shape, 4.0, 1e-9);
            assert_eq!((shape.aabb().center(), shape.aabb().extent()), (center, size));
            assert_eq!(shape.convex().unwrap().topology().faces.len(), 5);
        }
        for ridge in [-1.1, f64::NAN] {
            assert!(
                Shape::placed(Wedge { size, ridge }.into(), center, Mat3::IDENTITY, &Look::default())
                    .is_err()
            );
        }
    }
}
