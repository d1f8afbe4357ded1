//! Arches: `arch`.

use super::measured::{Checks, Form, Measured};
use super::word::kinds::{Length, Lengths, Point, Turn};
use super::word::{Word, placed, plain, turned};
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, crease};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// Pieces of the half ellipse in the coarse mesh, and in the one for pictures and files.
const PIECES: (usize, usize) = (8, 32);

/// A half ring on two legs, across x, as deep along z as its size says. The round part is as high as it is half wide, or as high
/// as there is room.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Arch {
    /// Full lengths along x, y (up) and z.
    pub size: Vec3,
    /// Width of the legs, and height of the middle stone.
    pub thickness: f64,
}

impl Arch {
    /// Height of the round part.
    fn rise(&self) -> f64 {
        self.size.y.min(0.5 * self.size.x)
    }

    /// Points of the outer and of the inner line, from the foot at -x over the top to the foot at +x.
    fn lines(&self, pieces: usize) -> [Vec<(f64, f64)>; 2] {
        let (low, rise) = (-0.5 * self.size.y, self.rise());
        let spring = 0.5 * self.size.y - rise;
        [0.0, self.thickness].map(|inset| {
            let (across, up) = (0.5 * self.size.x - inset, rise - inset);
            let mut line: Vec<(f64, f64)> = (0..=pieces)
                .map(|k| match (2 * k).cmp(&pieces) {
                    // The ends and the top are exact, because parts are attached there.
                    _ if k == 0 => (-across, spring),
                    _ if k == pieces => (across, spring),
                    std::cmp::Ordering::Equal => (0.0, spring + up),
                    _ => {
                        let (sin, cos) = (PI * k as f64 / pieces as f64 - FRAC_PI_2).sin_cos();
                        (across * sin, spring + up * cos)
                    }
                })
                .collect();
            if spring > low {
                line.insert(0, (-across, low));
                line.push((across, low));
            }
            line
        })
    }

    /// The closed surface, its points moved by `apply`.
    fn surface(&self, pieces: usize, apply: impl Fn(Vec3) -> Vec3) -> Result<TriMesh, GeomError> {
        let half = 0.5 * self.size.z;
        let lines = self.lines(pieces);
        let count = lines[0].len() as u32;
        let mut vertices = Vec::new();
        for z in [-half, half] {
            for line in &lines {
                vertices.extend(line.iter().map(|&(x, y)| apply(vec3(x, y, z))));
            }
        }
        // Back and front (0, 1), outside and inside (0, 1), along the line.
        let number = |front: u32, inside: u32, k: u32| (2 * front + inside) * count + k;
        let mut faces = Vec::new();
        let mut quad = |[a, b, c, d]: [u32; 4]| faces.extend([[a, b, c], [a, c, d]]);
        for k in 0..count - 1 {
            quad([number(1, 0, k), number(1, 1, k), number(1, 1, k + 1), number(1, 0, k + 1)]);
            quad([number(0, 0, k), number(0, 0, k + 1), number(0, 1, k + 1), number(0, 1, k)]);
            quad([number(0, 0, k), number(1, 0, k), number(1, 0, k + 1), number(0, 0, k + 1)]);
            quad([number(1, 1, k), number(0, 1, k), number(0, 1, k + 1), number(1, 1, k + 1)]);
        }
        quad([number(0, 0, 0), number(0, 1, 0), number(1, 1, 0), number(1, 0, 0)]);
        let last = count - 1;
        quad([number(1, 0, last), number(1, 1, last), number(0, 1, last), number(0, 0, last)]);
        TriMesh::new(vertices, faces)
    }
}

impl Measured for Arch {
    const KIND: &'static str = "arch";
    const FORM: Form = Form::Mesh;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        checks.sizes(self.size)?;
        checks.positive("thickness", self.thickness)?;
        match self.thickness < self.rise() {
            true => Ok(()),
            false => bad(format!(
                "the thickness of an arch is {}, expected less than half of its width and than its height ({})",
                self.thickness,
                self.rise()
            )),
        }
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        self.surface(PIECES.0, |p| placement.apply(p))
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        let mesh = self.surface(PIECES.1, |p| p);
        crease::creased(&mesh.expect("finite points and numbers of points"), crease::SHARP)
    }
}

word! {
    /// An arch: a half ring on two legs, as of a bridge or a door.
    "arch" ArchWord {
        /// The middle of the box around it.
        center: Point,
        /// The side lengths of this box, greater than 0: across, up, deep.
        size: Lengths,
        /// Width of the legs and height of the middle stone, greater than 0 and less than half of the width.
        thickness: Length,
        /// Turns it about its middle.
        rotation: Option<Turn>,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for ArchWord<S> {
    type Solid = Arch;

    fn solid(&self) -> Result<(Arch, Placement), GeomError> {
        let arch = Arch { size: plain(self.size), thickness: self.thickness.value() };
        Ok((arch, placed(self.center, Mat3::IDENTITY, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        turned(self.center, self.rotation, self.size)
    }
}

#[cfg(test)]
mod tests {
    //! Closed, with the area of a half ring and two legs; its opening is free.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;

    fn arch(size: Vec3, thickness: f64) -> Result<Shape, GeomError> {
        let center = vec3(1.0, 2.0, 3.0);
        Shape::placed(Arch { size, thickness }.into(), center, Mat3::IDENTITY, &Look::default())
    }

    /// Two legs, and between the half ellipses.
    fn volume(size: Vec3, t: f64) -> f64 {
        let (a, rise) = (0.5 * size.x, size.y.min(0.5 * size.x));
        (2.0 * t * (size.y - rise) + 0.5 * PI * (a * rise - (a - t) * (rise - t))) * size.z
    }

    #[test]
    fn an_arch_has_its_volume_and_its_box() {
        for (size, thickness) in
            [(vec3(4.0, 5.0, 1.0), 0.5), (vec3(4.0, 2.0, 1.0), 0.5), (vec3(8.0, 2.0, 3.0), 1.5)]
        {
            let shape = arch(size, thickness).unwrap();
            sound(&shape, volume(size, thickness), 0.02);
            assert_eq!((shape.aabb().center(), shape.aabb().extent()), (vec3(1.0, 2.0, 3.0), size));
        }
        for thickness in [0.0, 2.0, f64::NAN] {
            assert!(arch(vec3(4.0, 5.0, 1.0), thickness).is_err());
        }
    }

    #[test]
    fn a_box_fits_into_the_opening() {
        let shape = arch(vec3(4.0, 5.0, 1.0), 0.5).unwrap();
        let door =
            |width: f64| Shape::cuboid(vec3(1.0, 1.0, 3.0), vec3(width, 3.0, 1.0), &Look::default()).unwrap();
        assert!(!intersects(&shape, &door(3.0), Rule::Solid));
        assert!(intersects(&shape, &door(3.1), Rule::Solid));
    }
}
