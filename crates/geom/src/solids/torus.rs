//! Rings: `torus`.

use super::measured::{Checks, Form, Measured, Tone};
use super::word::kinds::{Axis, Length, Point, Turn};
use super::word::{Word, direction, laid_along, placed, plain};
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, ROUND};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::ring::ring;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};

/// Sides of the coarse mesh around the axis, and around the tube.
const SIDES: (usize, usize) = (12, 8);

/// A ring about y.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Torus {
    /// From the axis to the middle of the tube.
    pub radius: f64,
    /// Radius of the tube.
    pub tube: f64,
}

impl Torus {
    /// Points with normals, by rows around the tube.
    fn points(&self, (around, across): (usize, usize)) -> impl Iterator<Item = (Vec3, Vec3)> + '_ {
        ring(around).flat_map(move |(sin, cos)| {
            ring(across).map(move |(up, out)| {
                let reach = self.radius + self.tube * out;
                (vec3(reach * sin, self.tube * up, reach * cos), vec3(out * sin, up, out * cos))
            })
        })
    }

    /// Corners of each quadrilateral, counter-clockwise seen from outside.
    fn quads((around, across): (usize, usize)) -> impl Iterator<Item = [u32; 4]> {
        let number = move |j: usize, k: usize| (j % around * across + k % across) as u32;
        (0..around * across).map(move |at| {
            let (j, k) = (at / across, at % across);
            [number(j, k), number(j + 1, k), number(j + 1, k + 1), number(j, k + 1)]
        })
    }
}

impl Measured for Torus {
    const KIND: &'static str = "torus";
    const FORM: Form = Form::Mesh;
    const TONE: Tone = Tone::Round;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.positive("radius", self.radius)?;
        checks.positive("tube radius", self.tube)?;
        match self.tube < self.radius {
            true => Ok(()),
            false => bad(format!(
                "the tube radius of a torus is {}, expected less than its radius, {}",
                self.tube, self.radius
            )),
        }
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        let vertices = self.points(SIDES).map(|(p, _)| placement.apply(p)).collect();
        TriMesh::new(vertices, Torus::quads(SIDES).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let sides = (ROUND, ROUND / 2);
        let mut mesh = FineMesh::default();
        for (p, normal) in self.points(sides) {
            mesh.point(p, normal);
        }
        Torus::quads(sides).for_each(|quad| mesh.quad(quad));
        mesh
    }
}

word! {
    /// A ring.
    "torus" TorusWord {
        /// Its middle.
        center: Point,
        /// From the axis to the middle of the tube, greater than 0.
        radius: Length,
        /// Radius of the tube, greater than 0 and less than `radius`.
        tube: Length,
        /// The axis of the ring: "x", "y", "z" or a direction.
        axis: Axis = "y",
        /// Turns it about its middle.
        rotation: Option<Turn>,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for TorusWord<S> {
    type Solid = Torus;

    fn solid(&self) -> Result<(Torus, Placement), GeomError> {
        let laid = Mat3::between(Vec3::AXES[1], direction(plain(self.axis), "axis")?);
        let torus = Torus { radius: self.radius.value(), tube: self.tube.value() };
        Ok((torus, placed(self.center, laid, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        laid_along(self.center, self.axis, self.rotation, self.tube)
    }
}

#[cfg(test)]
mod tests {
    //! A closed ring with its volume and a hole that a thing goes through.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;
    use std::f64::consts::PI;

    fn torus(radius: f64, tube: f64, axis: Vec3) -> Result<Shape, GeomError> {
        let laid = Mat3::between(Vec3::AXES[1], axis);
        Shape::placed(Torus { radius, tube }.into(), vec3(1.0, 2.0, 3.0), laid, &Look::default())
    }

    #[test]
    fn a_torus_has_its_volume_and_its_box() {
        for axis in Vec3::AXES {
            // Its middle is in the hole, and inside of its box.
            sound(&torus(2.0, 0.5, axis).unwrap(), 2.0 * PI * PI * 2.0 * 0.25, 0.02);
        }
        assert_eq!(torus(2.0, 0.5, Vec3::AXES[1]).unwrap().aabb().extent(), vec3(5.0, 1.0, 5.0));
        assert!(torus(1.0, 1.0, Vec3::AXES[1]).is_err());
    }

    #[test]
    fn a_rod_goes_through_the_hole() {
        let rod = |x: f64| {
            let look = Look::default();
            Shape::cylinder(vec3(x, 2.0, 3.0), 0.5, 4.0, Vec3::AXES[1], None, &look).unwrap()
        };
        let ring = torus(2.0, 0.5, Vec3::AXES[1]).unwrap();
        assert!(!intersects(&ring, &rod(1.0), Rule::Solid));
        assert!(intersects(&ring, &rod(2.5), Rule::Solid));
    }
}
