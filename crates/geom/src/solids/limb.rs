//! Limbs: bent, tapered segments between two rings: `limb`.

use super::measured::{Checks, Measured, Tone};
use super::word::kinds::{Joint, Length, Point};
use super::word::{Word, between, direction, plain};
use crate::convex::Coarse;
use crate::error::{GeomError, bad_shape as bad};
use crate::fine::{FineMesh, limb};
use crate::limb::band;
use crate::placement::Placement;
use crate::polytope::Hull;
use crate::ring::Ring;
use crate::vector::{Mat3, Vec3, vec3};
use niwaki_math::Scalar;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Default number of sides.
const SIDES: usize = 10;

/// Convex hull of two rings, at their coordinates. Limbs that share a ring only touch, as long as each lies on its own side of
/// the ring's plane.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Limb {
    /// The rings at the start and the end.
    pub rings: Box<[Ring; 2]>,
    /// The number of sides of both rings.
    pub sides: usize,
    /// Whether it begins with a ball, at which it may bend away from the part that it begins in.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub round: bool,
}

impl Measured for Limb {
    const KIND: &'static str = "limb";
    const TONE: Tone = Tone::Bark;

    fn check(&self, checks: Checks) -> Result<(), GeomError> {
        for ring in self.rings.iter() {
            checks.positive("radius", ring.radius)?;
            checks.finite("centre of an end of a limb", ring.center)?;
            checks.unit("normal of an end of a limb", ring.normal)?;
        }
        checks.sides(self.sides)
    }

    fn bytes(&self) -> usize {
        size_of::<[Ring; 2]>()
    }

    fn hull(&self, placement: &Placement) -> Option<Coarse> {
        let points = self.rings.iter().flat_map(|ring| ring.vertices(self.sides));
        let vertices: Vec<Vec3> = points.map(|p| placement.apply(p)).collect();
        if self.round {
            let joint = self.joint().map(|p| placement.apply(p));
            return Hull::around(vertices.into_iter().chain(joint).collect()).map(Coarse::new);
        }
        let hull = match band(&vertices, self.sides) {
            Some(topology) => Hull::new(vertices, Arc::new(topology)),
            // The rings cut each other's plane.
            None => Hull::around(vertices),
        };
        hull.map(Coarse::new)
    }

    /// A frame in the middle of the first ring; y along its direction, by the shortest turn (Moller and Hughes 1999).
    fn frame(&self, placement: &Placement) -> Placement {
        let Ring { center, normal, .. } = self.rings[0];
        let [x, y, z] = normal.to_array();
        let columns = if y < -1.0 + 1e-12 {
            // A half turn, about x.
            [vec3(1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, -1.0)]
        } else {
            let h = 1.0 / (1.0 + y);
            [vec3(1.0 - h * x * x, -x, -h * x * z), normal, vec3(-h * x * z, -z, 1.0 - h * z * z)]
        };
        placement.after(&Placement { rotation: Mat3 { columns }, translation: center })
    }

    fn mirrored(&self) -> Limb {
        let mirrored =
            |ring: &Ring| Ring { center: ring.center.mirrored(), normal: ring.normal.mirrored(), ..*ring };
        Limb { rings: Box::new(self.rings.each_ref().map(mirrored)), ..self.clone() }
    }

    fn fine(&self, _bevel: Option<f64>) -> FineMesh {
        limb::domed(&self.rings[0], &self.rings[1], self.round)
    }
}

impl Limb {
    /// Points of the half ball below its first ring: a ring half way down, and the pole.
    fn joint(&self) -> impl Iterator<Item = Vec3> + '_ {
        const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
        let start = &self.rings[0];
        let down = start.normal * -start.radius;
        let low = Ring { center: start.center + down * H, radius: start.radius * H, ..*start };
        let points: Vec<Vec3> = low.vertices(self.sides).collect();
        points.into_iter().chain([start.center + down])
    }
}

/// A limb between two round ends; a normal left out is the direction from start to end.
pub(super) fn bent(
    start: Vec3,
    end: Vec3,
    radii: (f64, f64),
    normals: (Option<Vec3>, Option<Vec3>),
) -> Result<Limb, GeomError> {
    for (end_name, p) in [("start", start), ("end", end)] {
        if !p.is_finite() {
            return bad(format!("the {end_name} of a limb is {:?}, expected finite numbers", p.to_array()));
        }
    }
    let message = || format!("the start and the end of a limb are the same point, {:?}", start.to_array());
    let along = || (end - start).unit().ok_or_else(|| GeomError::new("bad-shape", message()));
    let normal = |normal: Option<Vec3>, name| normal.map_or_else(along, |normal| direction(normal, name));
    let start = Ring { center: start, normal: normal(normals.0, "start normal")?, radius: radii.0 };
    let end = Ring { center: end, normal: normal(normals.1, "end normal")?, radius: radii.1 };
    Ok(Limb { rings: Box::new([start, end]), sides: SIDES, round: false })
}

word! {
    /// A tapering, bending segment between two rings; limbs that share a ring only touch.
    "limb" LimbWord {
        /// Centres of the rings.
        start: Point,
        /// Centres of the rings.
        end: Point,
        /// Their radii, greater than 0.
        start_radius: Length,
        /// Their radii, greater than 0.
        end_radius: Length,
        /// Their directions; from `start` to `end` when left out.
        start_normal: Option<Point>,
        /// Their directions; from `start` to `end` when left out.
        end_normal: Option<Point>,
        /// "round": it begins with a ball, and may overlap the parts in which its start lies.
        joint: Option<Joint>,
        ..PAINTED
    }
}

impl<S: Scalar> Word<S> for LimbWord<S> {
    type Solid = Limb;

    fn solid(&self) -> Result<(Limb, Placement), GeomError> {
        let radii = (self.start_radius.value(), self.end_radius.value());
        let normals = (self.start_normal.map(plain), self.end_normal.map(plain));
        let limb = bent(plain(self.start), plain(self.end), radii, normals)?;
        Ok((Limb { round: self.joint.is_some(), ..limb }, Placement::IDENTITY))
    }

    fn at(&self) -> [[S; 3]; 4] {
        between(self.start, self.end)
    }
}

#[cfg(test)]
mod tests {
    //! Claim: a limb with a round joint may overlap the parts that it begins in, and no others.
    use super::super::shape::Shape;
    use super::super::testing::sound;
    use super::*;
    use crate::intersect::{Rule, intersects};
    use crate::look::Look;
    use std::f64::consts::PI;

    fn limb(start: Vec3, end: Vec3, round: bool) -> Shape {
        let limb = bent(start, end, (0.3, 0.3), (None, None)).unwrap();
        Shape::new(Limb { round, ..limb }.into(), Placement::IDENTITY, &Look::default()).unwrap()
    }

    #[test]
    fn a_round_joint_is_half_a_ball() {
        let shape = limb(vec3(1.0, 0.0, 0.0), vec3(1.0, 2.0, 0.0), true);
        let ends = 2.0 / 3.0 * PI * 0.027 * (1.0 + limb::DOME);
        sound(&shape, PI * 0.09 * 2.0 + ends, 0.02);
        assert!((shape.aabb().low.y + 0.3).abs() < 1e-12);
        sound(
            &limb(vec3(1.0, 0.0, 3.0), vec3(2.0, 2.0, 0.0), false),
            PI * 0.09 * 14_f64.sqrt() + ends - 2.0 / 3.0 * PI * 0.027,
            0.02,
        );
    }

    #[test]
    fn neighbours_bend_at_round_joints() {
        let [o, a, b] = [vec3(0.0, 0.0, 0.0), vec3(0.0, 2.0, 0.0), vec3(1.5, 2.5, 0.0)];
        let (trunk, low) = (limb(o, a, true), vec3(0.2, 0.5, 0.0));
        for rule in [Rule::Solid, Rule::Surface] {
            assert!(intersects(&trunk, &limb(a, b, false), rule), "{rule:?}");
            for branch in [limb(a, b, true), limb(vec3(0.2, 1.0, 0.0), b, true)] {
                assert!(!intersects(&trunk, &branch, rule) && !intersects(&branch, &trunk, rule));
            }
            // The end of a limb is no joint, and it begins beside the trunk.
            assert!(
                intersects(&trunk, &limb(b, low, true), rule)
                    && intersects(&limb(b, low, true), &trunk, rule)
            );
        }
        let cube = Shape::cuboid(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0), &Look::default()).unwrap();
        assert!(!intersects(&cube, &trunk, Rule::Solid));
        assert!(intersects(&cube, &limb(vec3(0.0, -1.0, 0.0), a, true), Rule::Solid));
    }

    #[test]
    fn frames_move_joints() {
        let frame =
            Placement { rotation: Mat3::rotation(Vec3::AXES[2], 0.7), translation: vec3(5.0, 1.0, 2.0) };
        let [a, b] = [vec3(0.0, 2.0, 0.0), vec3(1.5, 2.5, 0.0)];
        let placed = |shape: Shape| shape.in_frame(&frame).unwrap();
        let trunk = placed(limb(vec3(0.0, 0.0, 0.0), a, true));
        assert!(!intersects(&trunk, &placed(limb(a, b, true)), Rule::Solid));
        assert!(intersects(&trunk, &placed(limb(a, b, false)), Rule::Solid));
    }
}
