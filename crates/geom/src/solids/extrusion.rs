//! Prisms over any polygon, also twisted and tapered: `extrude`.

use super::measured::{Checks, Form, Measured, frame_within};
use super::word::kinds::{Length, Letter, Number, Pairs, Point, Turn};
use super::word::{Word, boxed, images, placed};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, extrude};
use crate::mesh::TriMesh;
use crate::placement::Placement;
use crate::polygon::{MOST, Pair, check_section, counter_clockwise, is_convex, note_simple, triangles};
use crate::polytope::Hull as Polytope;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::Arc;

/// Rounding of edges whose shape gives none, as a share of the most that there is room for.
const BEVEL: f64 = 0.16;
/// The largest twist of one layer of the coarse mesh, radians.
const LAYER: f64 = PI / 12.0;
/// The largest twist, radians: four turns.
const TWIST: f64 = 8.0 * PI;

/// A prism from y = 0 up, whose section turns and grows linearly on the way.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Extrusion {
    /// Corners of the section, in x and z; in either direction.
    pub polygon: Box<[Pair]>,
    /// Length along y.
    pub height: f64,
    /// The angle by which the upper end is turned about y, radians.
    pub twist: f64,
    /// The scale of the upper end, about x = z = 0.
    pub taper: f64,
}

impl Extrusion {
    /// Corners in z and x, in which a counter-clockwise section faces up.
    fn corners(&self) -> Vec<Pair> {
        counter_clockwise(self.polygon.iter().map(|[x, z]| [*z, *x]).collect())
    }

    /// The closed surface, its points moved by `apply`. A twisted side has a point in its middle, so that it bulges neither in nor out.
    fn surface(&self, apply: impl Fn(Vec3) -> Vec3) -> Result<TriMesh, GeomError> {
        let corners = self.corners();
        let count = corners.len();
        let layers = ((self.twist.abs() / LAYER).ceil() as usize).max(1);
        let is_pointed = self.taper == 0.0;
        let section = extrude::Section::of(self.height, self.twist, self.taper);
        let at = |[z, x]: Pair, share: f64| {
            let [z, x] = section.at(share).apply([z, x]);
            apply(vec3(x, share * self.height, z))
        };
        let mut vertices = Vec::new();
        for layer in 0..=layers - usize::from(is_pointed) {
            vertices.extend(corners.iter().map(|p| at(*p, layer as f64 / layers as f64)));
        }
        let caps = triangles(&corners);
        let mut faces: Vec<[u32; 3]> = caps.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let number = |layer: usize, k: usize| (layer * count + k % count) as u32;
        let tip = is_pointed.then(|| {
            vertices.push(at([0.0; 2], 1.0));
            (vertices.len() - 1) as u32
        });
        for layer in 0..layers {
            for k in 0..count {
                let low = [number(layer, k), number(layer, k + 1)];
                if let Some(tip) = tip.filter(|_| layer + 1 == layers) {
                    faces.push([low[0], low[1], tip]);
                    continue;
                }
                let high = [number(layer + 1, k), number(layer + 1, k + 1)];
                if self.twist == 0.0 {
                    faces.extend([[low[0], low[1], high[1]], [low[0], high[1], high[0]]]);
                    continue;
                }
                let [a, b] = [corners[k], corners[(k + 1) % count]];
                let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                vertices.push(at(middle, (layer as f64 + 0.5) / layers as f64));
                let middle = (vertices.len() - 1) as u32;
                let around = [low[0], low[1], high[1], high[0]];
                faces.extend((0..4).map(|side| [around[side], around[(side + 1) % 4], middle]));
            }
        }
        if !is_pointed {
            faces.extend(caps.iter().map(|cap| cap.map(|k| number(layers, k as usize))));
        }
        TriMesh::new(vertices, faces)
    }
}

impl Measured for Arc<Extrusion> {
    const KIND: &'static str = "extrusion";
    const FORM: Form = Form::Mesh;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        let what = "polygon of an extrusion";
        check_section(what, &self.polygon, MOST)?;
        checks.positive("height", self.height)?;
        checks.not_negative("taper", self.taper)?;
        match self.twist.abs() <= TWIST {
            true => Ok(()),
            false => {
                bad(format!("the twist of an extrusion is {}, expected -8 pi to 8 pi (radians)", self.twist))
            }
        }
    }

    fn form(&self) -> Form {
        if self.twist == 0.0 && is_convex(&self.polygon) { Form::Convex } else { Form::Mesh }
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let section = extrude::Section::of(self.height, 0.0, self.taper);
        let ring = |share: f64, corners: &[Pair]| -> Vec<Vec3> {
            let turned = section.at(share);
            let at = |p: &Pair| {
                let [z, x] = turned.apply(*p);
                placement.apply(vec3(x, share * self.height, z))
            };
            corners.iter().map(at).collect()
        };
        let corners = self.corners();
        let upper = if self.taper == 0.0 { &[[0.0; 2]] } else { &corners[..] };
        Polytope::between(ring(0.0, &corners), &ring(1.0, upper)).map(Coarse::new)
    }

    fn bytes(&self) -> usize {
        size_of::<Extrusion>() + size_of_val(&*self.polygon)
    }

    fn mesh(&self, placement: &Placement) -> Result<TriMesh, GeomError> {
        self.surface(|p| placement.apply(p))
    }

    fn frame(&self, placement: &Placement) -> Placement {
        frame_within(self, placement)
    }

    fn mirrored(&self) -> Arc<Extrusion> {
        let polygon = self.polygon.iter().map(|[x, z]| [-x, *z]).collect();
        Arc::new(Extrusion { polygon, twist: -self.twist, ..**self })
    }

    fn fine(&self, bevel: Option<f64>) -> FineMesh {
        let section = extrude::Section::of(self.height, self.twist, self.taper);
        extrude::rounded(&self.corners(), &section, bevel.unwrap_or(BEVEL))
    }
}

word! {
    /// A prism over a polygon, which may be concave.
    "extrude" ExtrudeWord {
        /// Its corners in order, in either direction: pairs (x, z); with the axis "z" (x, y), with "x" (z, y).
        polygon: Pairs,
        /// Length along the axis, greater than 0.
        height: Length,
        /// Where the polygon's origin goes.
        center: Point = (0.0, 0.0, 0.0),
        /// The angle by which the far end is turned about the axis, in radians.
        twist: Number = 0.0,
        /// How much the far end is scaled about the polygon's origin; 0 for a tip.
        taper: Length = 1.0,
        /// "x", "y" or "z": where it goes from the polygon.
        axis: Letter = "y",
        /// Turns it about the polygon's origin.
        rotation: Option<Turn>,
        ..BEVELLED
    }
}

impl<S: Scalar> ExtrudeWord<S> {
    /// The polygon in x and z, before it is laid along the axis.
    fn lying(&self) -> Result<(Vec<[S; 2]>, Mat3), GeomError> {
        if self.axis > 2 {
            return bad(format!("the axis is {}, expected 0, 1 or 2", self.axis));
        }
        let laid = Mat3::between(Vec3::AXES[1], Vec3::AXES[self.axis]);
        let own = |[a, b]: &[S; 2]| match self.axis {
            0 => [-*b, *a],
            1 => [*a, *b],
            _ => [*a, -*b],
        };
        Ok((self.polygon.iter().map(own).collect(), laid))
    }
}

impl<S: Scalar> Word<S> for ExtrudeWord<S> {
    type Solid = Arc<Extrusion>;

    fn solid(&self) -> Result<(Arc<Extrusion>, Placement), GeomError> {
        note_simple(&self.polygon);
        let _ = self.twist.abs() <= S::from_f64(TWIST);
        let (polygon, laid) = self.lying()?;
        let extrusion = Extrusion {
            polygon: polygon.into_iter().map(|pair| pair.map(Scalar::value)).collect(),
            height: self.height.value(),
            twist: self.twist.value(),
            taper: self.taper.value(),
        };
        Ok((Arc::new(extrusion), placed(self.center, laid, self.rotation)))
    }

    fn at(&self) -> [[S; 3]; 4] {
        let (polygon, laid) = self.lying().unwrap_or_else(|_| (Vec::new(), Mat3::IDENTITY));
        let [x, y, z] = images(laid, self.rotation);
        boxed(&polygon, [S::from_f64(0.0), self.height], self.center, [x, z, y])
    }
}

#[cfg(test)]
mod tests {
    //! Prisms have the volume of their polygon times their height, whichever way it is given; a notch is free.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;

    const HOOK: [Pair; 6] = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [2.0, 3.0], [2.0, 1.0], [0.0, 1.0]];

    fn extruded(polygon: &[Pair], twist: f64, taper: f64, bevel: f64) -> Result<Shape, GeomError> {
        let solid = Extrusion { polygon: polygon.into(), height: 2.0, twist, taper };
        let look = Look { bevel: Some(bevel), ..Look::default() };
        Shape::placed(Arc::new(solid).into(), vec3(1.0, 2.0, 3.0), Mat3::IDENTITY, &look)
    }

    #[test]
    fn prisms_have_their_volume_and_their_box() {
        let back: Vec<Pair> = HOOK.into_iter().rev().collect();
        for (twist, taper, bevel, share) in [
            (0.0, 1.0, 0.0, 1.0),
            (0.0, 1.0, 0.4, 1.0),
            (0.0, 0.5, 0.2, 7.0 / 12.0),
            (0.0, 0.0, 0.0, 1.0 / 3.0),
            (0.0, 0.0, 0.3, 1.0 / 3.0),
            (2.5, 1.0, 0.0, 1.0),
            (-9.0, 1.5, 0.1, 19.0 / 12.0),
            (1.0, 0.0, 0.0, 1.0 / 3.0),
        ] {
            let shape = extruded(&HOOK, twist, taper, bevel).unwrap();
            sound(&shape, 5.0 * 2.0 * share, if bevel > 0.0 { 0.04 } else { 0.01 });
            let other = extruded(&back, twist, taper, bevel).unwrap();
            assert_eq!(*shape.world_mesh(), *other.world_mesh());
            assert_eq!(shape.fine_mesh(), other.fine_mesh());
            let coarse = shape.world_mesh();
            let inside: f64 = coarse.corners().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
            assert!((inside / (10.0 * share) - 1.0).abs() < 0.03, "{twist} {taper}: {inside}");
        }
        let shape = extruded(&HOOK, 0.0, 1.0, 0.0).unwrap();
        assert_eq!((shape.aabb().low, shape.aabb().high), (vec3(1.0, 2.0, 3.0), vec3(4.0, 4.0, 6.0)));
    }

    #[test]
    fn a_prism_over_a_convex_polygon_is_convex() {
        let gable = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 1.0]];
        for (twist, taper, is_convex, share) in [
            (0.0, 1.0, true, 1.0),
            (0.0, 0.0, true, 1.0 / 3.0),
            (0.0, 1.5, true, 19.0 / 12.0),
            (0.2, 1.0, false, 1.0),
        ] {
            let shape = extruded(&gable, twist, taper, 0.0).unwrap();
            assert_eq!(shape.is_convex(), is_convex);
            sound(&shape, 6.0 * share, 5e-3);
        }
        assert!(!extruded(&HOOK, 0.0, 1.0, 0.0).unwrap().is_convex());
        let shape = extruded(&gable, 0.0, 1.0, 0.0).unwrap();
        assert_eq!((shape.aabb().low, shape.aabb().high), (vec3(1.0, 2.0, 3.0), vec3(3.0, 4.0, 5.0)));
    }

    #[test]
    fn a_rounded_prism_stays_in_its_box() {
        let shape = extruded(&HOOK, 0.0, 1.0, 1.0).unwrap();
        for p in shape.fine_mesh().vertices {
            assert!(shape.aabb().grown(1e-12).contains(&crate::bounds::Aabb::around([p])));
        }
    }

    #[test]
    fn a_box_fits_into_the_notch() {
        let shape = extruded(&HOOK, 0.0, 1.0, 0.0).unwrap();
        let peg =
            |width: f64| Shape::cuboid(vec3(2.0, 3.0, 5.0), vec3(width, 4.0, 2.0), &Look::default()).unwrap();
        assert!(!intersects(&shape, &peg(2.0), Rule::Solid));
        assert!(intersects(&shape, &peg(2.1), Rule::Solid));
    }

    #[test]
    fn measures_that_no_prism_has_are_refused() {
        let message = |polygon: &[Pair], twist, taper| {
            extruded(polygon, twist, taper, 0.0).map_or_else(|error| error.message, |_| String::new())
        };
        assert!(message(&HOOK, 26.0, 1.0).contains("the twist of an extrusion is 26"));
        assert!(message(&HOOK, f64::NAN, 1.0).contains("the twist"));
        assert!(message(&HOOK, 0.0, -1.0).contains("the taper of a extrusion is -1"));
        let crossed = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(message(&crossed, 0.0, 1.0).contains(
            "crosses itself: the side from point 0 to point 1 meets the side from point 2 to point 3"
        ));
        let closed = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
        assert!(message(&closed, 0.0, 1.0).contains("the first and the last point"));
    }
}
